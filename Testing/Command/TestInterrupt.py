"""Ctrl-C and SIGTERM: the command ends at once, with status 130 and no file."""

import os
import resource
import signal
import subprocess
import time
import unittest

import command


def processor_seconds(process):
    with open("/proc/%d/stat" % process.pid) as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def catches(process, sent):
    """Whether the process has a handler of its own; before, a signal would just end it."""
    with open("/proc/%d/status" % process.pid) as file:
        [mask] = [line.split()[1] for line in file if line.startswith("SigCgt:")]
    return int(mask, 16) >> (sent - 1) & 1


def processor_seconds_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class TestInterrupt(command.CommandTest):
    def wait_until(self, condition, process):
        end = time.monotonic() + 60
        while not condition():
            self.assertIsNone(process.poll(), "it ended before it could be stopped")
            self.assertLess(time.monotonic(), end, "it does nothing")
            time.sleep(0.02)

    def assert_stops(self, work, sent, *arguments):
        """Stopped when it has worked for so many seconds of the processor, it ends."""
        others = processor_seconds_of_children()
        process = subprocess.Popen([command.PROGRAM, *map(str, arguments)],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        self.wait_until(lambda: catches(process, sent), process)
        self.wait_until(lambda: processor_seconds(process) >= work, process)
        before = processor_seconds(process)
        process.send_signal(sent)
        output, errors = process.communicate(timeout=60)
        # Of the processor's time, not the clock's: machines that run tests are busy.
        self.assertLess(processor_seconds_of_children() - others - before, command.SLOWNESS)
        self.assertEqual((process.returncode, output, errors), (130, "", ""))
        self.assertEqual(os.listdir(self.results), [])

    def endless(self):
        return ("segment", self.volume, *self.seed, "--iterations", 100000, "--change-tolerance",
                -1, "--distance-tolerance", 0, "-o", self.result("out.vtp"), "--labels",
                self.result("out.nii.gz"))

    def test_ctrl_c_while_segmenting(self):
        for work in (0, 0.5, 1.5):
            self.assert_stops(work, signal.SIGINT, *self.endless())

    def test_sigterm_while_segmenting(self):
        self.assert_stops(0.5, signal.SIGTERM, *self.endless())

    def test_ctrl_c_while_drawing_a_phantom(self):
        self.assert_stops(0.3, signal.SIGINT, "phantom", "abdomen", "-o", self.results, "--size",
                          600, 500, 300)


if __name__ == "__main__":
    unittest.main()
