"""A label map in place of a seed: it is filled, corrected by points, and refused where it does not fit."""

import os
import shutil
import unittest

import command


class TestStartLabels(command.CommandTest):
    def fill(self, *arguments):
        return command.run("segment", self.volume, "--start-labels", self.truth, *arguments)

    def dice(self, segmentation):
        process = command.run("evaluate", segmentation, self.truth)
        self.assert_succeeds(process)
        return command.dice_of(process.stdout), process.stdout

    def test_is_filled(self):
        self.assert_succeeds(self.fill("-o", self.result("a.stl"), "--labels", self.result("a.nii")))
        self.assertGreater(self.dice(self.result("a.nii"))[0], 0.98)
        dice, scores = self.dice(self.result("a.stl"))
        self.assertGreater(dice, 0.98)
        self.assertRegex(scores, r"surface +valid: closed, .* self-intersections 0")
        # The sphere has the only label, so all that are not 0 are the same.
        self.assert_succeeds(self.fill("--start-label", 0, "-o", self.result("b.stl")))
        with open(self.result("a.stl"), "rb") as one, open(self.result("b.stl"), "rb") as other:
            self.assertEqual(one.read(), other.read())

    def test_of_several_the_first_is_taken_with_a_warning(self):
        volume, _ = command.make_small_abdomen(self.inputs)
        truth = volume.replace(".nii.gz", "-truth.nii.gz")
        given = ("--start-labels", truth, "--resolution", 8)
        process = command.run("segment", volume, *given, "-o", self.result("a.stl"))
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertRegex(process.stderr, r"warning: '.*truth\.nii\.gz' has the labels 1, 2, .*, 11; the surface fills label 1; "
                                         r"to fill another one, set --start-label\.\n\Z")
        self.assert_succeeds(command.run("segment", volume, *given, "--start-label", 1, "-o", self.result("b.stl")))
        with open(self.result("a.stl"), "rb") as one, open(self.result("b.stl"), "rb") as other:
            self.assertEqual(one.read(), other.read())

    def test_is_corrected_by_points(self):
        self.assert_succeeds(self.fill("-q", "--labels", self.result("a.nii")))
        self.assert_succeeds(self.fill("-q", "--outside", 32, 50, 32, "--labels", self.result("b.nii")))
        self.assertLess(self.dice(self.result("b.nii"))[0], self.dice(self.result("a.nii"))[0])

    def test_misuse_is_refused(self):
        out = ("-o", self.result("a.stl"))
        other = command.make_phantom(os.path.join(self.inputs, "other"), "cube", "--size", 20, 20, 20)
        self.assertTrue(other)
        coarse = os.path.join(self.inputs, "other", "cube-truth.nii.gz")
        copy = os.path.join(self.inputs, "copy.nii.gz")
        shutil.copy(self.truth, copy)
        for process, status, *words in (
                (self.fill(*self.seed, *out), 2, "--start-labels takes the place of the seed"),
                (self.fill("--radius", 5, *out), 2, "--start-labels takes the place of the seed"),
                (self.fill("--session", "s.json", *out), 2, "--session has the seed"),
                (command.run("segment", self.volume, *self.seed, "--start-label", 6, *out), 2, "--start-labels"),
                (self.fill("--start-label", -1, *out), 2, "--start-label"),
                (command.run("segment", self.volume, *out), 2, "--start-labels FILE|--radius"),
                (self.fill("--start-label", 6, *out), 1, "the start labels have no voxels with the value 6; they have 1: set --start-label to a value that they have"),
                (command.run("segment", self.volume, "--start-labels", self.result("no.nii"), *out), 1, r"no\.nii"),
                (command.run("segment", self.volume, "--start-labels", coarse, *out), 1,
                 "the dimensions of the start labels .* differ; resample one onto the grid of the other"),
                (command.run("segment", self.volume, "--start-labels", copy, "--labels", copy), 2, r"copy\.nii\.gz")):
            with self.subTest(words):
                self.assert_refused(process, status, *words)


if __name__ == "__main__":
    unittest.main()
