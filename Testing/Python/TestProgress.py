"""Progress, and how a segmentation is stopped: by the callback, or by Ctrl-C."""

import contextlib
import io
import signal
import threading
import time
import unittest

import flipfree
from example import RADIUS, SEED, coarse_liver, image, needs_files, needs_vtk, start_python

ENDLESS = {"maximum_iterations": 100000, "change_tolerance": -1, "distance_tolerance": 0}

# For programs that get Ctrl-C in the midst of it, however busy the machine is: from themselves.
INTERRUPT_AT_50 = """
import os, signal
told = []
def tell(fraction):
    told.append(fraction)
    if len(told) == 50:
        os.kill(os.getpid(), signal.SIGINT)
"""


class Progress(unittest.TestCase):
    def test_is_told_from_0_to_1(self):
        told = []
        flipfree.segment(image(), SEED, RADIUS, progress=told.append, resolution=8)
        self.assertEqual((told[0], told[-1]), (0, 1))
        self.assertEqual(told, sorted(told))
        self.assertGreater(len(told), 50)

    def test_bar_comes_and_goes(self):
        screen = io.StringIO()
        with contextlib.redirect_stderr(screen):
            flipfree.segment(image(), SEED, RADIUS, progress=True, levels=1)
        lines = screen.getvalue().split("\r")
        self.assertIn("segmenting    [################################] 100 %", lines)
        self.assertEqual([lines[0], lines[-2].strip(), lines[-1]], ["", "", ""])

    def test_what_the_callback_raises_stops_it(self):
        told = []

        def stop(fraction):
            told.append(fraction)
            if len(told) == 50:
                raise LookupError("enough")

        with self.assertRaisesRegex(LookupError, "enough"):
            flipfree.segment(image(), SEED, RADIUS, progress=stop, **ENDLESS)
        self.assertEqual(len(told), 50)

    def test_bar_goes_when_it_fails(self):
        screen = io.StringIO()
        with contextlib.redirect_stderr(screen), self.assertRaises(flipfree.SegmentationError):
            flipfree.segment(image(), (-50, 0, 0), RADIUS, progress=True)
        self.assertEqual(screen.getvalue().split("\r")[-1], "")


class CtrlC(unittest.TestCase):
    def start(self, program):
        process = start_python(program)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def start_and_wait(self, program):
        process = self.start(program)
        self.assertEqual(process.stdout.readline(), "started\n")
        return process

    def test_raises_keyboard_interrupt(self):
        process = self.start(INTERRUPT_AT_50 + f"""
try:
    flipfree.segment(image(), SEED, RADIUS, progress=tell, **{ENDLESS})
except KeyboardInterrupt:
    print(len(told))
print(flipfree.segment(image(), SEED, RADIUS, resolution=8))
""")
        # The callback is told of nothing any more.
        self.assertEqual(process.communicate(timeout=200), (f"50\n{coarse_liver()!r}\n", ""))

    @needs_vtk
    def test_stops_the_work_promptly(self):
        """Within a few of the filter's own reports; thousands would follow."""
        process = self.start(INTERRUPT_AT_50 + f"""
organ = flipfree.vtkFlipFreeSegmentation()
organ.SetInputData(image())
organ.SetSeedCenter(SEED)
organ.SetSeedRadius(RADIUS)
for name, value in {ENDLESS}.items():
    getattr(organ, "Set" + name.title().replace("_", ""))(value)
reports = []
organ.AddObserver("ProgressEvent", lambda *_: reports.append(organ.GetProgress()))
try:
    flipfree.update(organ, progress=tell)
except KeyboardInterrupt:
    print(len(reports), organ.GetStopReasonAsString())
""")
        output, errors = process.communicate(timeout=200)
        self.assertRegex(output, r"^\d+ aborted\n$", errors)
        self.assertLessEqual(int(output.split()[0]), 55)

    def test_ends_a_program_that_does_not_expect_it(self):
        process = self.start_and_wait(f"""
print("started", flush=True)
flipfree.segment(image(), SEED, RADIUS, **{ENDLESS})
""")
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=60)
        self.assertEqual((output, process.returncode), ("", -signal.SIGINT))
        self.assertRegex(errors, r"^Traceback(.*\n)*KeyboardInterrupt\n$")

    def test_calls_the_programs_own_handler_and_goes_on(self):
        process = self.start(INTERRUPT_AT_50 + """
signal.signal(signal.SIGINT, lambda *_: print("handled after", len(told)))
organ = flipfree.segment(image(), SEED, RADIUS, progress=tell, resolution=8)
print(len(told) > 60, organ)
assert signal.getsignal(signal.SIGINT).__name__ == "<lambda>"
""")
        output, errors = process.communicate(timeout=200)
        self.assertEqual((output, errors), (f"handled after 50\nTrue {coarse_liver()!r}\n", ""))

    def test_any_signals_handler_may_raise(self):
        """As that of a timeout does."""
        process = self.start(INTERRUPT_AT_50.replace("SIGINT", "SIGALRM") + f"""
class Timeout(Exception):
    pass

def handle(number, frame):
    raise Timeout(signal.Signals(number).name)

signal.signal(signal.SIGALRM, handle)
try:
    flipfree.segment(image(), SEED, RADIUS, progress=tell, **{ENDLESS})
except Timeout as timeout:
    print(timeout, len(told))
assert signal.getsignal(signal.SIGALRM) is handle
assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
""")
        self.assertEqual(process.communicate(timeout=200), ("SIGALRM 50\n", ""))

    def test_signals_that_come_between_callbacks_are_not_lost(self):
        """Whichever instruction they come at: none of a hundred is swallowed."""
        process = self.start("""
import signal

class Timeout(Exception):
    pass

def handle(*_):
    raise Timeout

signal.signal(signal.SIGALRM, handle)
image()  # by modules that are imported with the first one, and imports do not survive a signal
raised = 0
for attempt in range(100):
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.002 + 0.0007 * attempt)
        while True:
            flipfree.segment(image(), SEED, RADIUS, levels=1, maximum_iterations=2, resolution=4)
    except Timeout:
        raised += 1
print(raised)
""")
        self.assertEqual(process.communicate(timeout=200), ("100\n", ""))

    @needs_files
    def test_while_a_file_is_read(self):
        process = self.start_and_wait("""
import os, tempfile
with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "abdomen.nii.gz")
    flipfree.write_image(image(), path)
    try:
        print("started", flush=True)
        while True:
            flipfree.read_image(path)
    except KeyboardInterrupt:
        print("stopped")
""")
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.communicate(timeout=60), ("stopped\n", ""))

    def test_handler_is_left_alone_in_other_threads(self):
        results = []
        thread = threading.Thread(
            target=lambda: results.append(flipfree.segment(image(), SEED, RADIUS, resolution=8)))
        thread.start()
        thread.join()
        self.assertEqual(repr(results[0]), repr(coarse_liver()))


if __name__ == "__main__":
    unittest.main()
