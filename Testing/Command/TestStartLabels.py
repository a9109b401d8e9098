"""A label map in place of a seed: it is filled, corrected by points, and refused where it does not fit."""

import os
import shutil
import unittest

import command
import labelmaps

SPACING = (1, 1, 1.6)


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

    def same(self, one, other):
        with open(self.result(one), "rb") as first, open(self.result(other), "rb") as second:
            self.assertEqual(first.read(), second.read())

    def test_may_be_cropped_and_in_another_order(self):
        size, voxels = labelmaps.read_nifti(self.truth)
        turned = os.path.join(self.inputs, "turned.nrrd")
        labelmaps.write_turned(turned, size, SPACING, voxels)
        self.assert_succeeds(command.run("segment", self.volume, "--start-labels", turned, "-o", self.result("a.stl")))
        self.assert_succeeds(self.fill("-o", self.result("b.stl")))
        self.same("a.stl", "b.stl")
        for files in ((turned, self.truth), (self.truth, turned)):
            process = command.run("evaluate", *files, "--label", 1)
            self.assert_succeeds(process)
            self.assertEqual(command.dice_of(process.stdout), 1)

    def test_may_be_a_segment_of_a_layer(self):
        size, voxels = labelmaps.read_nifti(self.truth)
        half = bytes(value if number % size[0] < 32 else 0 for number, value in enumerate(voxels))
        layers = os.path.join(self.inputs, "layers.seg.nrrd")
        labelmaps.write_layers(layers, size, SPACING, [({1: "Half", 2: "left kidney"}, half), ({1: "Ball"}, voxels)])

        def fill(*arguments):
            return command.run("segment", self.volume, "--start-labels", layers, *arguments)

        self.assert_succeeds(fill("--start-label", "ball", "-o", self.result("a.stl"), "--save-session",
                                  os.path.join(self.inputs, "layers.json")))
        self.assert_succeeds(self.fill("-o", self.result("b.stl")))
        self.same("a.stl", "b.stl")
        # The session's label is the name: a value would be of two segments.
        self.assert_succeeds(command.run("segment", self.volume, "--session", os.path.join(self.inputs, "layers.json"),
                                         "-o", self.result("c.stl")))
        self.same("a.stl", "c.stl")
        for label, dice in (("Ball", 1.0), ("half", 0.7)):
            process = command.run("evaluate", self.truth, layers, "--reference-label", label)
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertAlmostEqual(command.dice_of(process.stdout), dice, delta=0.05)
        for name in os.listdir(self.results):
            os.remove(self.result(name))
        out = ("-o", self.result("a.stl"))
        for process, status, *words in (
                (fill(*out), 1, "has 2 layers of segments that may overlap: 'Half', 'left kidney', 'Ball'. Choose one segment by its name"),
                (fill("--start-label", "bal", *out), 1, "has no segment 'bal'. Did you mean 'Ball'\\? There are 'Half', 'left kidney', 'Ball'"),
                (fill("--start-label", 1, *out), 1, "has 2 segments called '1': 'Half', 'Ball'"),
                (fill("--start-label", 2, *out), 1, "have no voxels with the value 2"),
                (self.fill("--start-label", "ball", *out), 1, "sphere-truth.nii.gz' names no segments"),
                (self.fill("--start-label", 1.5, *out), 2, "--start-label: '1.5' is no label"),
                (command.run("evaluate", layers, self.truth), 1, "has 2 layers of segments"),
                (command.run("evaluate", self.truth, layers, "--label", "balls"), 1, "names no segments")):
            with self.subTest(words):
                self.assert_refused(process, status, *words)

    def test_that_is_hollow_stays_so(self):
        size, voxels = labelmaps.read_nifti(self.truth)
        plane, row = size[0] * size[1], size[0]
        steps = [step * distance for step in (1, row, plane) for distance in (-4, 4)]
        hollow = bytes(value if value and not all(voxels[number + step] for step in steps) else 0
                       for number, value in enumerate(voxels))
        path = os.path.join(self.inputs, "hollow.nrrd")
        labelmaps.write_nrrd(path, size, [(1, 0, 0), (0, 1, 0), (0, 0, 1.6)], (0, 0, 0), hollow)
        self.assert_succeeds(command.run("segment", self.volume, "--start-labels", path, "-o", self.result("a.stl")),
                             may_be_doubtful=True)
        process = command.run("evaluate", self.result("a.stl"), path)
        self.assert_succeeds(process)
        self.assertEqual(command.dice_of(process.stdout), 1)

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
                 "the spacings of the start labels .* differ; resample one onto the grid of the other"),
                (command.run("segment", self.volume, "--start-labels", copy, "--labels", copy), 2, r"copy\.nii\.gz")):
            with self.subTest(words):
                self.assert_refused(process, status, *words)


if __name__ == "__main__":
    unittest.main()
