"""Sessions at ParaView's window: the filter from the quick launch, the seed placed by mouse and key, Apply, and undo;
a point that corrects the result, placed likewise; and the end of a vessel, dragged by its handle. Pictures, of failures
too, are left in the folder FLIPFREE_GUI_PICTURES, if that is set."""

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
WITHIN_VIEW = (800, 500)  # in a window of this size


def is_near_seed(place):
    """Beside the middle of the slices, where the pointer is."""
    return math.dist(place, (99, 84.5, 168.5)) < 14


class Window(unittest.TestCase):
    SCENES = {"test_place_apply_undo": "organ", "test_correct_by_a_handle": "correction",
              "test_drag_the_end_of_a_vessel": "vessel"}

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="flipfree-test-")
        self.addCleanup(shutil.rmtree, self.folder)
        self.note = os.path.join(self.folder, "note.json")
        self.log = open(os.path.join(self.folder, "log"), "w+", encoding="utf-8")
        self.addCleanup(self.log.close)
        self.desk = Desk()
        # Without the settings of whoever runs this.
        self.paraview = subprocess.Popen(
            [PARAVIEW, "--dr", "--script=" + os.path.join(HERE, "gui_setup.py")],
            stdin=subprocess.DEVNULL, stdout=self.log, stderr=subprocess.STDOUT,
            env={**os.environ, "HOME": self.folder, "XDG_RUNTIME_DIR": self.folder,
                 "FLIPFREE_GUI_EXAMPLE": EXAMPLE, "FLIPFREE_GUI_NOTE": self.note,
                 "FLIPFREE_GUI_SCENE": self.SCENES[self._testMethodName]})
        self.addCleanup(self.stop)
        self.wait_for(lambda: [window for window in self.desk.windows() if window[0] > 800], "ParaView's window")
        self.window = self.desk.windows()[0][2]
        self.wait_for(lambda: self.state(), "a first drawing")
        width = self.state()["view"]
        self.desk.fill_screen(self.window, WIDTH, HEIGHT)
        self.desk.focus(self.window)
        self.wait_for(lambda: self.state()["view"] != width, "the window to fill the screen")
        self.middle = self.find_middle()

    def stop(self):
        self.paraview.kill()
        self.paraview.wait()

    def state(self):
        """What gui_setup.py has last noted."""
        try:
            with open(self.note, encoding="utf-8") as file:
                return json.load(file)
        except FileNotFoundError:
            return {}

    def wait_for(self, condition, what, seconds=120):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end or self.paraview.poll() is not None:
                self.keep_picture("failed")
                self.log.seek(0)
                self.fail(f"waited in vain for {what}; it is {self.state()}; {self.log.read()[-3000:]}")
            time.sleep(0.3)

    def wait_for_state(self, **expected):
        self.wait_for(lambda: {**self.state(), **expected} == self.state(), expected)

    def find_middle(self):
        """The view's middle on the screen, at which the camera looks. Where it is differs between versions, with the
        width of panels, by more than a handle; so the view tells where it sees the pointer."""
        self.desk.move(WITHIN_VIEW[0] - 1, WITHIN_VIEW[1])
        self.desk.settle(1)
        before = self.state().get("pointer")
        self.desk.move(*WITHIN_VIEW)
        self.wait_for(lambda: self.state().get("pointer") not in (None, before), "the view to see the pointer")
        across, down = self.state()["pointer"]
        return WITHIN_VIEW[0] - across, WITHIN_VIEW[1] - down

    def keep_picture(self, name):
        folder = os.environ.get("FLIPFREE_GUI_PICTURES")
        if folder:
            os.makedirs(folder, exist_ok=True)
            self.desk.settle(3)  # the window draws after its note
            self.desk.picture(WIDTH, HEIGHT).save(os.path.join(folder, f"gui-{name}.png"))

    def add_filter(self, keys):
        """From the quick launch."""
        self.desk.move(*self.middle)
        self.desk.key("space", "Control_L")
        self.wait_for(lambda: len(self.desk.windows()) > 1, "the quick launch")
        self.desk.settle(1)
        self.desk.focus(self.desk.windows()[-1][2])
        for key in (*keys, "Return"):
            self.desk.key(key)
        self.wait_for(lambda: len(self.desk.windows()) == 1, "the end of the quick launch")
        self.desk.focus(self.window)
        self.desk.settle(1)

    def is_placed(self, is_there=is_near_seed):
        """Presses the key, again should the widget not have been ready yet, and waits a little."""
        self.desk.key("p")
        for _ in range(15):
            if is_there(self.state()["placed"]):
                return True
            time.sleep(0.3)
        return False

    def test_place_apply_undo(self):
        self.add_filter(["f", "l", "i", "p", "space", "s", "e", "g"])  # "flip" alone is the organ group first
        self.desk.move(self.middle[0] + 1, self.middle[1])
        self.wait_for_state(center=[163.5, 127.5, 135], points=0)  # the image's middle
        self.wait_for(self.is_placed, "the sphere's place")
        self.keep_picture("placed")

        self.desk.key("a", "Alt_L")
        self.wait_for_state(points=6144, intersections=0, visible=["Axial", "Coronal", "FlipFreeSegmentation1"])
        self.assertTrue(is_near_seed(self.state()["center"]), self.state())
        self.keep_picture("applied")

        self.desk.key("z", "Control_L")
        self.wait_for_state(center=[163.5, 127.5, 135], visible=["Axial", "Coronal"])

    def test_correct_by_a_handle(self):
        self.wait_for_state(point=[10, 10, 10], points=1536, label=0)
        # On the slice, in the liver, to the patient's right of the seed.
        self.desk.move(self.middle[0] - 60, self.middle[1] - 8)
        self.wait_for(lambda: self.is_placed(lambda place: math.dist(place, (60, 84.5, 168.5)) < 14),
                      "the point's place")
        self.keep_picture("point-placed")
        # Until it is applied, its place is the organ's.
        state = self.state()
        self.assertEqual([state["point"], state["label"]], [[10, 10, 10], 1], state)

        self.desk.key("a", "Alt_L")
        self.wait_for(lambda: self.state()["point"] != [10, 10, 10] and self.state()["label"] == 0, "a correction")
        self.keep_picture("point-applied")
        state = self.state()
        self.assertEqual([state["point"], state["intersections"]], [state["placed"], 0], state)

    def test_drag_the_end_of_a_vessel(self):
        before = self.state()
        first, second = before["points"]
        goal = before["way"][-1]
        self.assertGreater(math.dist(second, goal), 20)
        self.assertEqual([before["placed"], before["label"]], [before["points"], 1], before)
        self.keep_picture("vessel")

        self.desk.drag([(self.middle[0] + across, self.middle[1] + down) for across, down in before["seen_way"]])
        self.wait_for(lambda: math.dist(self.state()["placed"][1], goal) < 2, "the handle's place")
        self.keep_picture("vessel-dragged")
        # The other handle has stayed; and until it is applied, so has the vessel.
        state = self.state()
        self.assertEqual({**state, "placed": before["placed"], "pointer": before["pointer"]}, before)
        self.assertEqual(state["placed"][0], first)

        self.desk.key("a", "Alt_L")
        self.wait_for(lambda: self.state()["points"] != before["points"] and self.state()["label"] == 0, "a new end")
        self.keep_picture("vessel-applied")
        after = self.state()
        self.assertEqual([after["points"], after["intersections"]], [state["placed"], 0], after)
        self.assertLess(math.dist(after["ends"][0], before["ends"][0]), 1, after)
        self.assertLess(math.dist(after["ends"][1], goal), 3, after)


if __name__ == "__main__":
    unittest.main(verbosity=2)
