"""Phantom, segmentation, evaluation: what a user does first, in every format."""

import csv
import gzip
import os
import pty
import struct
import subprocess
import unittest
import zlib

import command


class TestWorkflow(command.CommandTest):
    def segment(self, *arguments):
        process = command.run("segment", self.volume, *self.seed, *arguments)
        self.assert_succeeds(process)
        return process.stdout

    def dice(self, name):
        process = command.run("evaluate", self.result(name), self.truth)
        self.assert_succeeds(process)
        return command.dice_of(process.stdout)

    def test_every_surface_format_is_read_back(self):
        for ending in ("vtp", "stl", "ply", "obj"):
            with self.subTest(ending=ending):
                name = "sphere." + ending
                self.segment("-o", self.result(name))
                self.assertGreater(self.dice(name), 0.96)

    def test_every_label_format_is_read_back(self):
        for ending in ("nii", "nii.gz", "nrrd", "mha"):
            with self.subTest(ending=ending):
                name = "sphere." + ending
                self.segment("--labels", self.result(name))
                self.assertGreater(self.dice(name), 0.96)

    def test_a_surface_is_valid(self):
        self.segment("-o", self.result("sphere.vtp"))
        text = command.run("evaluate", self.result("sphere.vtp"), self.truth).stdout
        self.assertRegex(text, r"surface +valid: closed, Euler number 2, self-intersections 0")

    def test_summary(self):
        text = self.segment("-o", self.result("sphere.vtp"))
        self.assertEqual(text.count("\n"), 1)
        self.assertRegex(text, r"volume \d+\.\d ml, \d+ iterations, [a-z ]+, 0 self-intersections; "
                               r"reading \d+\.\d+ s, smoothing \d+\.\d+ s, feature \d+\.\d+ s")

    def test_quiet(self):
        self.assertEqual(self.segment("--quiet", "-o", self.result("sphere.vtp")), "")

    def test_progress_bar_on_a_terminal_only(self):
        try:
            ours, theirs = pty.openpty()
        except OSError as error:  # a chroot without /dev/pts
            self.skipTest("no pseudo-terminal: %s" % error)
        process = subprocess.Popen([command.PROGRAM, "segment", self.volume, *self.seed, "-o",
                                    self.result("sphere.vtp")], stdout=subprocess.DEVNULL,
                                   stderr=theirs)
        os.close(theirs)
        shown = b""
        try:
            while data := os.read(ours, 4096):
                shown += data
        except OSError:  # the terminal's way to say that nobody writes any more
            pass
        os.close(ours)
        self.assertEqual(process.wait(), 0)
        self.assertRegex(shown, rb"\rsegmenting +\[#+\.+\] +\d+ %")
        self.assertTrue(shown.endswith(b"\r\x1b[K"))  # and it is gone in the end

    def test_convergence(self):
        text = self.segment("--convergence", self.result("sphere.csv"))
        with open(self.result("sphere.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertIn(", %d iterations," % len(rows), text)
        self.assertTrue(all(float(row["MeanDistance"]) >= 0 for row in rows))

    def test_parameters_reach_the_filter(self):
        self.segment("--convergence", self.result("sphere.csv"), "--levels", 1, "--resolution", 8,
                     "--iterations", 3, "--change-tolerance", -1, "--distance-tolerance", 0)
        with open(self.result("sphere.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([int(row["Vertices"]) for row in rows], 3 * [6 * 8 * 8])

    def test_options_win_over_the_preset_in_any_order(self):
        self.segment("--iterations", 2, "--preset", "published", "--change-tolerance", -1,
                     "--distance-tolerance", 0, "--convergence", self.result("sphere.csv"))
        with open(self.result("sphere.csv"), newline="") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 2)

    def test_seed_voxel_is_the_same_place(self):
        at = self.seed.index("--seed")
        point = [float(value) for value in self.seed[at + 1:at + 4]]
        voxel = [round(point[0]), round(point[1]), round(point[2] / 1.6)]
        radius = self.seed[-1]
        self.segment("-o", self.result("a.vtp"))
        process = command.run("segment", self.volume, "--seed-voxel", *voxel, "--radius", radius,
                              "--labels", self.result("b.nii.gz"))
        self.assert_succeeds(process)
        self.assertGreater(self.dice("b.nii.gz"), 0.96)

    def test_threads_change_nothing(self):
        for threads in (1, 2):
            self.segment("--threads", threads, "-o", self.result("%d.ply" % threads))
        with open(self.result("1.ply"), "rb") as one, open(self.result("2.ply"), "rb") as two:
            self.assertEqual(one.read(), two.read())

    def test_labels_of_an_abdomen(self):
        seeds = command.make_phantom(self.results, "abdomen", "--size", 110, 85, 45, "--spacing",
                                     3, 3, 6)
        self.assertIn("liver (label 6)", seeds)
        self.assertIn("spleen (label 1)", seeds)
        process = command.run("segment", self.result("abdomen.nii.gz"), *seeds["liver (label 6)"],
                              "--label-value", 6, "--labels", self.result("liver.nrrd"))
        self.assert_succeeds(process)
        both = command.run("evaluate", self.result("liver.nrrd"),
                           self.result("abdomen-truth.nii.gz"), "--label", 6)
        one = command.run("evaluate", self.result("liver.nrrd"),
                          self.result("abdomen-truth.nii.gz"), "--reference-label", 6)
        self.assert_succeeds(both)
        self.assertEqual(both.stdout, one.stdout)
        self.assertGreater(command.dice_of(both.stdout), 0.8)
        self.assertEqual(both.stderr, "")
        none = command.run("evaluate", self.result("liver.nrrd"), self.result("abdomen-truth.nii.gz"))
        self.assertEqual(none.returncode, 0)
        self.assertRegex(none.stderr, r"\Aflipfree: warning: The reference has the labels 1, 2, 3, .*"
                                      r"set --reference-label\.\n\Z")
        wrong = command.run("evaluate", self.result("liver.nrrd"), self.result("abdomen-truth.nii.gz"),
                            "--reference-label", 99)
        self.assertEqual(wrong.returncode, 1)
        self.assertRegex(wrong.stderr, "the label 99; set --reference-label to one of 1, 2, 3")

    def test_scores_as_csv(self):
        process = command.run("evaluate", self.truth, self.truth, "--csv",
                              self.result("scores.csv"))
        self.assert_succeeds(process)
        with open(self.result("scores.csv"), newline="") as file:
            row, = csv.DictReader(file)
        self.assertEqual((row["Segmentation"], row["Reference"]), (self.truth, self.truth))
        self.assertEqual(float(row["Dice"]), 1)
        self.assertAlmostEqual(float(row["ASD"]), 0)

    def test_every_phantom_has_seeds_in_its_object(self):
        for name in ("sphere", "cube", "cup", "u-tube", "vessel"):
            with self.subTest(phantom=name):
                seeds = command.make_phantom(self.results, name, "--size", 48, 48, 48)
                outside = set() if name == "vessel" else {"object, from outside"}
                self.assertEqual(set(seeds), {"object (label 1)"} | outside)
                with gzip.open(self.result(name + "-truth.nii.gz")) as file:
                    header = file.read(352)
                    labels = file.read()
                self.assertEqual(struct.unpack("<3h", header[42:48]), (48, 48, 48))
                x, y, z = (round(float(value)) for value in seeds["object (label 1)"][1:4])
                self.assertEqual(labels[x + 48 * (y + 48 * z)], 1)

    def test_the_printed_options_find_cup_and_u_tube_from_outside(self):
        for name in ("cup", "u-tube"):
            with self.subTest(phantom=name):
                seeds = command.make_phantom(self.results, name)
                surface = self.result(name + ".ply")
                process = command.run("segment", self.result(name + ".nii.gz"),
                                      *seeds["object, from outside"], "-o", surface)
                self.assert_succeeds(process)
                scores = command.run("evaluate", surface, self.result(name + "-truth.nii.gz"))
                self.assertGreaterEqual(command.dice_of(scores.stdout), 0.97)

    def test_a_surface_that_intersects_itself_warns(self):
        seeds = command.make_phantom(self.results, "cup")
        process = command.run("segment", self.result("cup.nii.gz"), *seeds["object (label 1)"],
                              "--preset", "naive", "-o", self.result("cup.ply"))
        self.assertEqual(process.returncode, 0)
        self.assertRegex(process.stderr, r"\Aflipfree: warning: The surface intersects itself in \d+ ")

    def test_an_existing_file_is_replaced_and_nothing_else_is_left(self):
        with open(self.result("sphere.stl"), "w") as file:
            file.write("an older result")
        self.segment("-o", self.result("sphere.stl"))
        self.assertGreater(os.path.getsize(self.result("sphere.stl")), 10000)
        self.assertEqual(os.listdir(self.results), ["sphere.stl"])

    @unittest.skipUnless(command.HAS_DISPLAY, "no display, and no xvfb-run to make one")
    def test_snapshot(self):
        process = command.with_display("segment", self.volume, *self.seed, "--snapshot",
                                       self.result("sphere.png"))
        self.assertEqual(process.returncode, 0, process.stderr)
        with open(self.result("sphere.png"), "rb") as file:
            data = file.read()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">2I", data[16:24]), (1200, 1200))
        pixels = self.pixels(data)
        # The contour's color in each of the slices, with letters for the sides on the left and at the top; the
        # organ's in the fourth view.
        for name, rows, columns in (("axial", (0, 600), (0, 600)), ("sagittal", (0, 600), (600, 1200)),
                                    ("coronal", (600, 1200), (0, 600))):
            self.assertGreater(self.count(pixels, rows, columns, self.is_contour), 300, name)
            middle, center = sum(rows) // 2, sum(columns) // 2
            for side, place in (("left", ((middle - 20, middle + 20), (columns[0] + 2, columns[0] + 40))),
                                ("top", ((rows[0] + 2, rows[0] + 40), (center - 20, center + 20)))):
                self.assertGreater(self.count(pixels, *place, self.is_letter), 8, f"{name}, {side}")
        self.assertGreater(self.count(pixels, (600, 1200), (600, 1200), self.is_organ), 20000)

    @staticmethod
    def is_contour(r, g, b):
        return r > 200 and 140 < g < 220 and b < 100

    @staticmethod
    def is_letter(r, g, b):
        return min(r, g, b) > 200

    @staticmethod
    def is_organ(r, g, b):
        return r > 90 and r > 1.5 * g and r > 1.5 * b

    @staticmethod
    def count(pixels, rows, columns, test):
        return sum(test(*pixels[y][3 * x:3 * x + 3])
                   for y in range(*rows) for x in range(*columns))

    @staticmethod
    def pixels(data):
        """The rows of an RGB picture, from the bytes of a PNG file."""
        at, packed = 8, b""
        while at < len(data):
            length, kind = struct.unpack(">I4s", data[at:at + 8])
            packed += data[at + 8:at + 8 + length] if kind == b"IDAT" else b""
            at += length + 12
        raw, rows, above = zlib.decompress(packed), [], bytearray(3600)
        for y in range(1200):
            kind, row = raw[3601 * y], bytearray(raw[3601 * y + 1:3601 * (y + 1)])
            for i in range(3600):
                left = row[i - 3] if i >= 3 else 0
                corner = above[i - 3] if i >= 3 else 0
                if kind == 4:
                    p = left + above[i] - corner
                    near = min((abs(p - left), 0, left), (abs(p - above[i]), 1, above[i]),
                               (abs(p - corner), 2, corner))[2]
                else:
                    near = (0, left, above[i], (left + above[i]) // 2)[kind]
                row[i] = (row[i] + near) & 255
            rows.append(bytes(row))
            above = row
        return rows


if __name__ == "__main__":
    unittest.main()
