"""Sessions at ParaView's window: the filter from the quick launch, the sphere placed and sized by mouse and keyboard,
Apply, undo, and the iterations as frames; and the ready trace of Examples/ParaView, loaded. Pictures, of failures too,
are left in the folder FLIPFREE_GUI_PICTURES, if that is set."""

import json
import math
import os
import shutil
import subprocess
import tempfile
import time
import unittest

from desk import Desk

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLE = os.path.join(HERE, "..", "..", "Examples", "ParaView", "segment-organ.py")
PARAVIEW = os.path.join(os.environ["FLIPFREE_BUILD"] + "-prefix", "usr", "bin", "paraview")
WIDTH, HEIGHT = 1280, 860
# Of a window of this size: the seam between panels and view, and where it is drawn to, so that the panels show all; the
# middle of the view that is left, where the camera looks at the liver; the box "Keep History"; the button for the last
# frame.
SEAM, WIDER = range(294, 299), 400
MIDDLE = (842, 512)
KEEP_HISTORY = (16, 786)
LAST_FRAME = (658, 42)


class Window(unittest.TestCase):
    """ParaView's window, started with options."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="flipfree-test-")
        self.addCleanup(shutil.rmtree, self.folder)
        self.note = os.path.join(self.folder, "note.json")
        self.log = open(os.path.join(self.folder, "log"), "w+", encoding="utf-8")
        self.addCleanup(self.log.close)
        self.desk = Desk()

    def start(self, option):
        """With a script or state, after which there are notes."""
        # Without the settings of whoever runs this.
        self.paraview = subprocess.Popen(
            [PARAVIEW, "--dr", option], stdin=subprocess.DEVNULL, stdout=self.log, stderr=subprocess.STDOUT,
            env={**os.environ, "HOME": self.folder, "XDG_RUNTIME_DIR": self.folder,
                 "PYTHONPATH": HERE + os.pathsep + os.environ.get("PYTHONPATH", ""),
                 "FLIPFREE_GUI_EXAMPLE": EXAMPLE, "FLIPFREE_GUI_NOTE": self.note})
        self.addCleanup(self.stop)
        self.wait_for(lambda: [window for window in self.desk.windows() if window[0] > 800], "ParaView's window")
        self.window = self.desk.windows()[0][2]
        self.wait_for(lambda: self.state()["view"][0] > 0, "a first drawing")

    def stop(self):
        self.paraview.kill()
        self.paraview.wait()

    def wait_for(self, condition, what, seconds=120):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end or self.paraview.poll() is not None:
                self.keep_picture(self.id().rpartition(".")[2] + "-failed")
                self.log.seek(0)
                self.fail(f"waited in vain for {what}; it is {self.state()}; {self.log.read()[-3000:]}")
            time.sleep(0.3)

    def wait_for_state(self, **expected):
        """Until the notes are so: values, or functions that tell whether a value is right."""
        def is_so(value, wanted):
            return wanted(value) if callable(wanted) else value == wanted

        self.wait_for(lambda: all(is_so(value, expected[name]) for name, value in self.state().items()
                                  if name in expected), expected)

    def keep_picture(self, name):
        folder = os.environ.get("FLIPFREE_GUI_PICTURES")
        if folder:
            os.makedirs(folder, exist_ok=True)
            self.desk.picture(WIDTH, HEIGHT).save(os.path.join(folder, f"gui-{name}.png"))

    def state(self):
        state = {"view": [0, 0], "points": -1, "radius": -1, "center": [0, 0, 0], "stop": "", "intersections": -1,
                 "placed": [0, 0, 0], "sized": [-1], "history": -1, "times": [0, 0], "visible": []}
        try:
            with open(self.note, encoding="utf-8") as file:
                state.update(json.load(file))
        except FileNotFoundError:
            pass
        return state


def is_near_seed(place):
    """Beside the middle of the slices, where the pointer is."""
    return math.dist(place, (99.75, 83.75, 167)) < 14


class Session(Window):
    def setUp(self):
        super().setUp()
        self.start("--script=" + os.path.join(HERE, "gui_setup.py"))
        self.desk.fill_screen(self.window, WIDTH, HEIGHT)
        self.desk.focus(self.window)
        self.wait_for(self.view_is_wide, "the window to fill the screen")
        self.wait_for(self.widen_panels, "the panels to become wide")

    def view_is_wide(self):
        return self.state()["view"][0] > WIDTH - SEAM.stop - 10

    def widen_panels(self):
        """Draws the seam to the right, wherever exactly it is; true once the view has become smaller."""
        for x in SEAM:
            self.desk.drag((x, 600), (WIDER, 600), steps=20)
        self.desk.settle(1)
        return not self.view_is_wide()

    def add_filter(self, letters):
        """From the quick launch."""
        self.desk.move(*MIDDLE)
        self.desk.key("space", "Control_L")
        self.wait_for(lambda: len(self.desk.windows()) > 1, "the quick launch")
        self.desk.settle(1)
        self.desk.focus(self.desk.windows()[-1][2])
        for letter in letters:
            self.desk.key(letter)
        self.desk.key("Return")
        self.wait_for(lambda: len(self.desk.windows()) == 1, "the end of the quick launch")
        self.desk.focus(self.window)
        self.desk.settle(1)

    def place_seed(self):
        """Into the liver; gives the default that it had."""
        self.add_filter("flip")
        self.desk.move(MIDDLE[0] + 1, MIDDLE[1])
        self.wait_for_state(radius=lambda radius: radius > 0, center=[164.25, 126.75, 133.5])  # the image's middle
        default = self.state()
        # Again, should the sphere not have been ready yet.
        self.wait_for(lambda: self.press_until("p", lambda: is_near_seed(self.state()["placed"])), "the sphere's place")
        # The right button scales the sphere.
        self.desk.drag((MIDDLE[0] + 8, MIDDLE[1] - 8), (MIDDLE[0] + 8, MIDDLE[1] - 38), number=3)
        self.wait_for_state(sized=lambda sized: sized[0] > default["radius"] + 3, placed=is_near_seed, points=0)
        self.keep_picture("placed")
        return default

    def press_until(self, key, condition, seconds=5):
        self.desk.key(key)
        end = time.monotonic() + seconds
        while not condition() and time.monotonic() < end:
            time.sleep(0.3)
        return condition()

    def apply(self):
        self.desk.key("a", "Alt_L")

    def test_place_apply_undo(self):
        default = self.place_seed()
        self.apply()
        self.wait_for_state(
            points=6144, stop="at rest", intersections=0, visible=["Axial", "Coronal", "FlipFreeSegmentation1"],
            center=is_near_seed,
            radius=lambda radius: default["radius"] + 3 < radius < 45)
        self.keep_picture("applied")

        self.desk.key("z", "Control_L")
        self.wait_for_state(radius=default["radius"], visible=["Axial", "Coronal"])

    def test_history_becomes_frames(self):
        self.place_seed()
        self.desk.click(*KEEP_HISTORY)
        self.apply()
        self.wait_for_state(history=1, points=384,  # of the coarsest level
                            times=lambda times: times[0] == 1 and times[1] > 20)
        self.desk.click(*LAST_FRAME)
        self.wait_for_state(points=6144)


class ReadyTrace(Window):
    def test_loads_as_a_state(self):
        """As File > Load State does it, which takes no script besides; so the watch is behind the trace's last line."""
        state = os.path.join(self.folder, "state.py")
        with open(EXAMPLE, encoding="utf-8") as trace, open(state, "w", encoding="utf-8") as file:
            file.write(trace.read() + "\nimport gui_note\ngui_note.watch(VIEWS[0])\n")
        self.start("--state=" + state)
        self.wait_for_state(points=6144, stop="at rest", intersections=0, center=[99.75, 83.75, 167], radius=28,
                            visible=["Axial", "Coronal", "Organ"])
        self.keep_picture("trace")


if __name__ == "__main__":
    unittest.main(verbosity=2)
