"""Ctrl-C and SIGTERM: the command ends at once wherever it is, with status 130 and no file."""

import fcntl
import gzip
import os
import resource
import signal
import struct
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
        end = time.monotonic() + 60 * command.SLOWNESS  # as the work that is waited for
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

    def assert_ends(self, ready, *arguments, signals=(signal.SIGINT,), **options):
        """Stopped once it is `ready`, it ends, although what it does cannot be aborted."""
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
        process = subprocess.Popen([command.PROGRAM, *map(str, arguments)], **options)
        self.addCleanup(process.kill)
        self.wait_until(lambda: catches(process, signals[0]) and ready(process), process)
        for sent in signals:
            process.send_signal(sent)
        output, errors = process.communicate(timeout=60)
        self.assertEqual((process.returncode, output or b"", errors), (130, b"", b""))
        self.assertEqual(os.listdir(self.results), [])

    def large_volume(self):
        """Takes seconds to inflate; packed in parts, so that packing it does not."""
        size = (512, 512, 300)
        header = bytearray(352)
        struct.pack_into("<i", header, 0, 348)
        struct.pack_into("<4h", header, 40, 3, *size)
        struct.pack_into("<2h", header, 70, 4, 16)
        struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 0, 0, 0, 0)
        struct.pack_into("<f", header, 108, 352)
        struct.pack_into("<h", header, 254, 1) # an sform
        struct.pack_into("<12f", header, 280, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)
        header[344:348] = b"n+1\0"
        name = os.path.join(self.inputs, "large.nii.gz")
        slices = gzip.compress(b"\1\0" * (size[0] * size[1] * 20), 1)
        with open(name, "wb") as file:
            file.write(gzip.compress(bytes(header)) + slices * (size[2] // 20))
        return name

    def test_while_reading(self):
        volume = self.large_volume()
        for work in (0, 0.1): # a fast machine has read it after 0.3 s
            self.assert_ends(lambda process: processor_seconds(process) >= work,
                             "segment", volume, *self.seed, "-o", self.result("out.vtp"))

    def test_while_evaluating(self):
        volume = self.large_volume()
        for work in (0.3, 2):
            self.assert_ends(lambda process: processor_seconds(process) >= work * command.SLOWNESS,
                             "evaluate", volume, volume, "--csv", self.result("out.csv"))

    def test_while_writing(self):
        def writes(_):
            return any(files for _, _, files in os.walk(self.results))
        for sent in (signal.SIGINT, signal.SIGTERM):
            self.assert_ends(writes, "phantom", "sphere", "-o", self.results, "--size", 400, 400, 200,
                             signals=(sent,))

    def test_where_nothing_moves(self):
        """Its output goes into a pipe that is full and that nobody reads."""
        for signals in ((signal.SIGINT,), (signal.SIGTERM,), (signal.SIGINT, signal.SIGINT)):
            reading, writing = os.pipe()
            self.addCleanup(os.close, reading)
            self.addCleanup(os.close, writing)
            os.write(writing, bytes(fcntl.fcntl(writing, fcntl.F_GETPIPE_SZ)))

            def blocks(process):
                with open("/proc/%d/stat" % process.pid) as file:
                    return file.read().rpartition(")")[2].split()[0] == "S"
            self.assert_ends(blocks, "segment", "--help", signals=signals, stdout=writing)


if __name__ == "__main__":
    unittest.main()
