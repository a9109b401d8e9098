"""Questions: their file, their warning, and their answers at a terminal."""

import csv
import os
import pty
import re
import subprocess
import sys
import unittest

import command

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Support"))
import lobed_ball  # pylint: disable=wrong-import-position

LEFT_OUT = r"flipfree: warning: Is the part of \d\d ml at \((\d+), (\d+), (\d+)\) mm organ\? --inside \1 \2 \3 adds it\.\n"
HEADER = 'x,y,z,volume_ml,included,margin\n'


class TestQuestions(command.CommandTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.unsure, cls.cut = (cls.write(name, brighter) for name, brighter in (("unsure", 0), ("cut", 6)))

    @classmethod
    def write(cls, name, brighter):
        path = os.path.join(cls.inputs, name + ".nrrd")
        fields = ("NRRD0004", "type: short", "dimension: 3", "space: left-posterior-superior", "endian: little",
                  "sizes: {} {} {}".format(*lobed_ball.SIZE), "space directions: (2,0,0) (0,2,0) (0,0,2)",
                  "kinds: domain domain domain", "space origin: (0,0,0)", "encoding: raw")
        voxels = lobed_ball.lobed_ball(brighter)
        if sys.byteorder == "big":
            voxels.byteswap()
        with open(path, "wb") as file:
            file.write("\n".join(fields).encode() + b"\n\n" + voxels.tobytes())
        return path

    def arguments(self, volume, *more):
        return ("segment", volume, "--seed", *lobed_ball.SEED, "--radius", lobed_ball.RADIUS, "--resolution", 16, *more)

    def questions(self, name="questions.csv"):
        with open(self.result(name), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def surface_bytes(self, name):
        with open(self.result(name), "rb") as file:
            return file.read()

    def test_file_and_warning(self):
        process = command.run(*self.arguments(self.unsure, "--questions", self.result("questions.csv")))
        self.assertEqual(process.returncode, 0, process.stderr)
        question, = self.questions()
        place = [float(question[axis]) for axis in "xyz"]
        for found, expected in zip(place, lobed_ball.LOBE):
            self.assertLess(abs(found - expected), 8)
        self.assertGreater(float(question["volume_ml"]), 20)
        self.assertLess(float(question["volume_ml"]), 45)
        self.assertEqual(question["included"], "1")
        numbers = [f"{x:.0f}" for x in place]
        self.assertEqual(process.stderr, f"flipfree: warning: Is the part of {float(question['volume_ml']):.0f} ml at "
                         f"({', '.join(numbers)}) mm organ? --outside {' '.join(numbers)} removes it.\n")
        # Points of the message are LPS.
        ras = ("--seed", -lobed_ball.SEED[0], -lobed_ball.SEED[1], lobed_ball.SEED[2], "--radius", lobed_ball.RADIUS)
        process = command.run("segment", self.unsure, *ras, "--ras", "--resolution", 16, "-q", "-o", self.result("a.stl"))
        self.assertIn(f"organ? an outside point in LPS at {' '.join(numbers)} removes it.", process.stderr)
        # Answered, it is not asked again, and nobody is warned.
        process = command.run(*self.arguments(self.unsure, "--inside", *numbers, "--questions", self.result("b.csv")))
        self.assert_succeeds(process)
        with open(self.result("b.csv"), encoding="utf-8") as file:
            self.assertEqual(file.read().replace("\r", ""), HEADER)

    def test_columns_alone_where_nothing_is_asked(self):
        process = command.run("segment", self.volume, *self.seed, "--resolution", 8, "-q", "--questions", self.result("q.csv"))
        self.assert_succeeds(process)
        self.assertEqual(self.surface_bytes("q.csv"), HEADER.encode())

    def test_files_of_several(self):
        x, y, z, *_ = self.seed[1:]
        process = command.run("segment", self.volume, "--organ", "ball", x, y, z, 8, "--resolution", 8, "-q",
                              "--questions", self.result("q.csv"))
        self.assert_succeeds(process)
        self.assertEqual(self.surface_bytes("q-ball.csv"), HEADER.encode())

    def at_a_terminal(self, answers, *arguments):
        """The volume and what was shown; to each prompt, one of the answers."""
        try:
            ours, theirs = pty.openpty()
        except OSError as error:  # a chroot without /dev/pts
            self.skipTest(f"no pseudo-terminal: {error}")
        with subprocess.Popen([command.PROGRAM, *map(str, arguments)], stdin=theirs, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as process:
            os.close(theirs)
            shown = b""
            sent = 0
            while data := process.stderr.read1(4096):
                shown += data
                while sent < min(len(answers), shown.count(b"skip] ")):
                    os.write(ours, answers[sent])
                    sent += 1
            volume = re.search(rb"volume (\S+) ml", process.stdout.read())
        os.close(ours)
        self.assertEqual(process.returncode, 0, shown)
        return float(volume[1]), shown.decode()

    def test_answers_at_a_terminal(self):
        at_once = self.arguments(self.cut, "--ask", "-o", self.result("yes.stl"), "--save-points", self.result("yes.csv"),
                                 "--questions", self.result("left.csv"))
        volume, shown = self.at_a_terminal([b"perhaps\n", b"Y\n"], *at_once)
        self.assertGreater(volume, 140)
        prompt = r"Is the part of \d\d ml at \(\1, \2, \3\) mm organ\? It is left out\. \[y/n, Enter: skip\] "
        self.assertRegex(shown, rf"\A{LEFT_OUT}{prompt}{prompt}\Z")
        self.assertEqual(self.questions("left.csv"), [])
        with open(self.result("yes.csv"), encoding="utf-8") as file:
            kind, *place = file.read().splitlines()[1].split(",")[:4]
        self.assertEqual(kind, "inside")
        # As if the answer had been a point from the start.
        self.assert_succeeds(command.run(*self.arguments(self.cut, "--inside", *place, "-o", self.result("point.stl"))))
        self.assertEqual(self.surface_bytes("yes.stl"), self.surface_bytes("point.stl"))

    def test_skipped_and_ended_input(self):
        process = command.run(*self.arguments(self.cut, "-o", self.result("free.stl")))
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertRegex(process.stderr, rf"\A{LEFT_OUT}\Z")
        for name, answer in (("skipped", b"\n"), ("ended", b"\x04")):
            volume, _ = self.at_a_terminal([answer], *self.arguments(self.cut, "--ask", "-o", self.result(name + ".stl")))
            self.assertLess(volume, 120)
            self.assertEqual(self.surface_bytes(name + ".stl"), self.surface_bytes("free.stl"))

    def test_nothing_to_ask(self):
        labels = self.result("labels.nii.gz")
        process = command.run(*self.arguments(self.cut, "--labels", labels))
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertRegex(process.stderr, rf"\A{LEFT_OUT}\Z")
        for arguments, why in (((*self.arguments(self.cut), "--no-carving"), "questions come with --carving"),
                               (("segment", self.cut, "--start-labels", labels, "--resolution", 8),
                                "a start from labels has no questions"),
                               (("segment", self.volume, *self.seed, "--resolution", 8), "no part alone is in doubt")):
            _, shown = self.at_a_terminal([], *arguments, "--ask", "-o", self.result("a.stl"))
            self.assertIn(f"--ask: there is nothing to ask; {why}.\n", shown)

    def test_help_names_the_tables_of_several(self):
        text = " ".join(command.run("segment", "--help").stdout.split())
        self.assertIn("Of several organs, each has a table with its name", text)

    def test_refusals(self):
        out = ("-o", self.result("a.stl"))
        self.assert_refused(command.run(*self.arguments(self.cut, "--ask", *out)), 2,
                            "--ask needs a terminal to ask at.*--questions.*--inside and --outside")
        self.assert_refused(command.run("segment", self.volume, "--organ", "a", 1, 2, 3, 4, "--ask", *out), 2, "--ask is for one organ")
        self.assert_refused(command.run(*self.arguments(self.cut, "--questions", self.result("q.txt"))), 2, "--questions.*[.]csv")
        self.assert_refused(command.run(*self.arguments(self.cut)), 2, "--convergence, --questions, --snapshot")


if __name__ == "__main__":
    unittest.main()
