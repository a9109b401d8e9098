"""Phantom, segmentation, evaluation: what a user does first, in every format."""

import csv
import gzip
import os
import pty
import resource
import struct
import subprocess
import sys
import unittest

import command
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

# Colors, as intervals of red, green and blue.
CONTOUR = ((200, 255), (140, 220), (0, 100))
LETTER = ((200, 255), (200, 255), (200, 255))
ORGAN = ((90, 255), (0, 130), (0, 120))


class TestWorkflow(command.CommandTest):
    def segment(self, *arguments):
        process = command.run("segment", self.volume, *self.seed, *arguments)
        self.assert_succeeds(process)
        return process.stdout

    def dice(self, name):
        process = command.run("evaluate", self.result(name), self.truth)
        self.assert_succeeds(process)
        return command.dice_of(process.stdout)

    def rows(self, *arguments):
        """The convergence table of a run, and what the run prints."""
        text = self.segment("--convergence", self.result("sphere.csv"), *arguments)
        with open(self.result("sphere.csv"), newline="") as file:
            return list(csv.DictReader(file)), text

    def test_every_format_is_read_back(self):
        for surface, labels in (("a.vtp", "a.nii"), ("a.stl", "a.nii.gz"), ("a.ply", "a.nrrd"), ("a.obj", "a.mha")):
            with self.subTest(surface=surface, labels=labels):
                printed = self.segment("--quiet", "--resolution", 16, "-o", self.result(surface), "--labels", self.result(labels))
                self.assertEqual(printed, "")
                self.assertGreater(min(self.dice(surface), self.dice(labels)), 0.96)
        text = command.run("evaluate", self.result("a.vtp"), self.truth).stdout
        self.assertRegex(text, r"surface +valid: closed, Euler number 2, self-intersections 0")

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

    def test_summary_and_convergence(self):
        rows, text = self.rows()
        self.assertEqual(text.count("\n"), 1)
        self.assertRegex(text, rf"volume \d+\.\d ml, {len(rows)} iterations, [a-z ]+, 0 self-intersections, confidence 0\.9\d; "
                               r"reading \d+\.\d+ s, smoothing \d+\.\d+ s, feature \d+\.\d+ s")
        self.assertTrue(all(float(row["MeanDistance"]) >= 0 for row in rows))

    def test_parameters_reach_the_filter_and_win_over_the_preset_in_any_order(self):
        to_the_end = ("--change-tolerance", -1, "--distance-tolerance", 0)
        rows, _ = self.rows("--levels", 1, "--resolution", 8, "--iterations", 3, "--no-carving", *to_the_end)
        self.assertEqual([int(row["Vertices"]) for row in rows], 3 * [6 * 8 * 8])
        rows, _ = self.rows("--levels", 1, "--resolution", 8, "--iterations", 3, *to_the_end)
        self.assertEqual(len(rows), 2 * 3)  # carving runs them a second time
        rows, _ = self.rows("--iterations", 2, "--preset", "published", "--guard", *to_the_end)
        self.assertEqual(len(rows), 2)

    def test_parameters_of_the_stages_reach_them(self):
        distances = set()
        for options in ((), ("--noise-widening", 2), ("--maximum-displacement", 2), ("--fairing", 1)):
            rows, _ = self.rows("--iterations", 4, "--levels", 1, "--resolution", 8, "--no-carving", *options)
            distances.add(rows[-1]["MeanDistance"])
        self.assertEqual(len(distances), 4)

    def test_warnings_name_options(self):
        large = ("--seed", 40, 32, 32, "--radius", 31)
        for seed, options, words in ((large, (), "lower --radius or move --seed"),
                                     (self.seed, ("--reach", 16), "raise --reach ")):
            process = command.run("segment", self.volume, *seed, *options, "-o",
                                  self.result("sphere.vtp"))
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertRegex(process.stderr, r"\Aflipfree: warning: [^\n]*" + words)

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
            self.segment("--threads", threads, "--resolution", 16, "-o", self.result("%d.ply" % threads))
        with open(self.result("1.ply"), "rb") as one, open(self.result("2.ply"), "rb") as two:
            self.assertEqual(one.read(), two.read())

    @unittest.skipUnless(sys.platform == "linux", "limits threads as Linux does")
    def test_where_the_system_starts_no_threads(self):
        """As in a container that limits processes; root is not limited, so that it becomes somebody else."""
        self.segment("-q", "--resolution", 16, "-o", self.result("free.stl"))
        for folder in (self.inputs, self.results):
            os.chmod(folder, 0o777)

        def limit():
            resource.setrlimit(resource.RLIMIT_NPROC, (1, 1))
            if os.getuid() == 0:
                os.setuid(65534)

        try:
            process = command.run("segment", self.volume, *self.seed, "-q", "--resolution", 16, "-o",
                                  self.result("limited.stl"), preexec_fn=limit)
        except PermissionError:
            self.skipTest("the command is where others cannot read it")
        self.assert_succeeds(process)
        with open(self.result("free.stl"), "rb") as free, open(self.result("limited.stl"), "rb") as limited:
            self.assertEqual(free.read(), limited.read())

    def test_labels_of_an_abdomen(self):
        seeds = command.make_phantom(self.results, "abdomen", "--size", 55, 43, 23, "--spacing", 6, 6, 12)
        self.assertIn("liver (label 6)", seeds)
        self.assertIn("spleen (label 1)", seeds)
        process = command.run("segment", self.result("abdomen.nii.gz"), *seeds["liver (label 6)"],
                              "--resolution", 16, "--label-value", 6, "--labels", self.result("liver.nrrd"))
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
        several = command.run("evaluate", self.result("abdomen-truth.nii.gz"), self.result("liver.nrrd"),
                              "--reference-label", 6)
        self.assertEqual(several.returncode, 0)
        self.assertRegex(several.stderr, r"\Aflipfree: warning: The segmentation has the labels 1, 2, 3, .*"
                                         r"set --segmentation-label\.\n\Z")
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
                other = "object, from end to end" if name == "vessel" else "object, from outside"
                self.assertEqual(set(seeds), {"object (label 1)", other})
                with gzip.open(self.result(name + "-truth.nii.gz")) as file:
                    header = file.read(352)
                    labels = file.read()
                self.assertEqual(struct.unpack("<3h", header[42:48]), (48, 48, 48))
                x, y, z = (round(float(value)) for value in seeds["object (label 1)"][1:4])
                self.assertEqual(labels[x + 48 * (y + 48 * z)], 1)

    @unittest.skipIf(command.SLOWNESS > 1, "repeats at length what shorter tests do")
    def test_the_printed_options_find_cup_and_u_tube_from_outside(self):
        for name in ("cup", "u-tube"):
            with self.subTest(phantom=name):
                seeds = command.make_phantom(self.results, name)
                surface = self.result(name + ".ply")
                process = command.run("segment", self.result(name + ".nii.gz"),
                                      *seeds["object, from outside"], "-o", surface)
                self.assert_succeeds(process, may_be_doubtful=True)  # a tube reaches far for its volume
                scores = command.run("evaluate", surface, self.result(name + "-truth.nii.gz"))
                self.assertGreaterEqual(command.dice_of(scores.stdout), 0.97)

    def test_a_surface_that_intersects_itself_warns(self):
        seeds = command.make_phantom(self.results, "cup", "--size", 48, 48, 48, "--spacing", 2, 2, 2)
        process = command.run("segment", self.result("cup.nii.gz"), *seeds["object (label 1)"],
                              "--preset", "naive", "-o", self.result("cup.ply"))
        self.assertEqual(process.returncode, 0)
        self.assertRegex(process.stderr, r"\Aflipfree: warning: The surface is not certified.* in [1-9]\d* pairs of")

    def test_an_existing_file_is_replaced_and_nothing_else_is_left(self):
        with open(self.result("sphere.stl"), "w") as file:
            file.write("an older result")
        self.segment("-o", self.result("sphere.stl"))
        self.assertGreater(os.path.getsize(self.result("sphere.stl")), 10000)
        self.assertEqual(os.listdir(self.results), ["sphere.stl"])

    @unittest.skipUnless(command.HAS_DISPLAY, "no display, and no xvfb-run to make one")
    def test_snapshot(self):
        picture = self.result("sphere.png")
        process = command.with_display("segment", self.volume, *self.seed, "--snapshot", picture)
        self.assertEqual(process.returncode, 0, process.stderr)
        reader = vtkPNGReader()
        reader.SetFileName(picture)
        reader.Update()
        self.assertEqual(reader.GetOutput().GetDimensions(), (1200, 1200, 1))
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(1200, 1200, -1)[::-1]

        def count(color, top, left, height=600, width=600):
            part = pixels[top:top + height, left:left + width]
            low, high = zip(*color)
            return ((part >= low) & (part <= high)).all(axis=2).sum()

        # The contour in each of the slices, with letters for the sides on the left and at the top; the organ in the
        # fourth view.
        for name, top, left in (("axial", 0, 0), ("sagittal", 0, 600), ("coronal", 600, 0)):
            with self.subTest(name):
                self.assertGreater(count(CONTOUR, top, left), 300)
                self.assertGreater(count(LETTER, top + 280, left + 2, 40, 38), 8)
                self.assertGreater(count(LETTER, top + 2, left + 280, 38, 40), 8)
        self.assertGreater(count(ORGAN, 600, 600), 20000)


if __name__ == "__main__":
    unittest.main()
