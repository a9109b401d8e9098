"""Vessels from points: every output, and whatever may be wrong."""

import csv
import math
import os
import shutil
import tempfile
import unittest

import command
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

SIZE, SPACING = 64, 1.5


def point_at(place):
    """On the axis of the vessel phantom, which ends at -1 and 1."""
    center = (SIZE - 1) / 2 * SPACING
    return (center + 36 * place, center + 16 * math.sin(math.pi * place),
            center + 10 * math.cos(0.8 * math.pi * place + 0.5))


class TestTrace(command.CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.inputs = tempfile.mkdtemp(prefix="flipfree-test-")
        cls.addClassCleanup(shutil.rmtree, cls.inputs)
        seeds = command.make_phantom(cls.inputs, "vessel", "--size", SIZE, SIZE, SIZE, "--spacing", SPACING, SPACING, SPACING)
        cls.volume = os.path.join(cls.inputs, "vessel.nii.gz")
        cls.truth = os.path.join(cls.inputs, "vessel-truth.nii.gz")
        cls.printed = seeds["object, from end to end"]
        cls.points = ("--point", *point_at(-0.95), "--point", *point_at(0.95))

    def trace(self, *arguments, volume=None):
        return command.run("trace", volume or self.volume, *arguments)

    def test_points_that_the_phantom_prints(self):
        self.assertEqual((self.printed.count("--point"), len(self.printed)), (2, 8))
        process = self.trace(*self.printed, "-o", self.result("vessel.vtp"))
        self.assert_succeeds(process)
        self.assertIn("1 branch, ", process.stdout)

    def test_every_output(self):
        names = {option: self.result("vessel" + ending) for option, ending in
                 (("--output", ".stl"), ("--labels", ".nii.gz"), ("--centerline", ".vtp"), ("--convergence", ".csv"))}
        process = self.trace(*self.points, *(word for pair in names.items() for word in pair))
        self.assert_succeeds(process)
        self.assertRegex(process.stdout, r"1 branch, \d+ vertices, .*, 0 self-intersections, support (0[.]9\d|1[.]00); path \d+\.\d+ s")
        for name in (names["--output"], names["--labels"]):
            scores = command.run("evaluate", name, self.truth)
            self.assert_succeeds(scores)
            self.assertGreater(command.dice_of(scores.stdout), 0.9)
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(names["--centerline"])
        reader.Update()
        line = reader.GetOutput()
        self.assertEqual(line.GetNumberOfLines(), 1)
        radii = vtk_to_numpy(line.GetPointData().GetArray("Radius"))
        self.assertTrue(3 < radii.min() and radii.max() < 5, radii)
        with open(names["--convergence"], newline="") as file:
            self.assertGreater(len(list(csv.DictReader(file))), 3)

    def test_the_volume_may_come_last(self):
        name = self.result("last.vtp")
        self.assert_succeeds(command.run("trace", "-q", "--levels", 1, "-o", name, *self.points, self.volume))

    def test_the_same_as_of_a_point_more_on_the_way(self):
        names = self.result("two.nii.gz"), self.result("three.nii.gz")
        for name, more in zip(names, ((), ("--point", *point_at(0.2)))):
            self.assert_succeeds(self.trace(*self.points, *more, "--quiet", "--labels", name))
        self.assertGreater(command.dice_of(command.run("evaluate", *names).stdout), 0.95)

    def test_corrections(self):
        """A point that was missed is in the label map, one too much is not; the file repeats both."""
        x, y, z = point_at(0)
        lines = self.result("points.csv")
        names = self.result("plain.nii.gz"), self.result("corrected.nii.gz"), self.result("again.nii.gz")
        points = ("--inside", x, y, z + 6.5, "--outside", *(a + b for a, b in zip(point_at(0.5), (0, 0, 2.5))))
        self.assert_succeeds(self.trace(*self.points, "-q", "--labels", names[0]))
        self.assert_succeeds(self.trace(*self.points, "-q", "--labels", names[1], *points, "--save-points", lines))
        self.assert_succeeds(self.trace(*self.points, "-q", "--labels", names[2], "--points", lines))
        dice = [command.dice_of(command.run("evaluate", names[1], name).stdout) for name in (names[0], names[2])]
        self.assertTrue(0.85 < dice[0] < 1, dice)
        self.assertEqual(dice[1], 1)
        ras = [("--point", -point_at(place)[0], -point_at(place)[1], point_at(place)[2]) for place in (-0.95, 0.95)]
        self.assert_succeeds(self.trace("--ras", *ras[0], *ras[1], "-q", "--labels", names[2]))
        self.assertEqual(command.dice_of(command.run("evaluate", names[0], names[2]).stdout), 1)

    def test_bad_corrections(self):
        output = ("-o", self.result("out.vtp"))
        seeds = os.path.join(self.inputs, "seeds.csv")
        with open(seeds, "w") as file:
            file.write("kind,x,y,z,radius\nseed,40,40,40,5\n")
        for status, points, patterns in (
                (2, ("--inside", 1, 2), ("--inside",)), (2, ("--outside", "nan", 0, 0), ("--outside", "finite")),
                (2, ("--points", "points.txt"), ("--points", ".csv")),
                (1, ("--points", seeds), ("a seed is of no use to a vessel",)),
                (1, ("--inside", 500, 0, 0), (r"the inside point \(500, 0, 0\) mm lies outside",)),
                (1, ("--outside", *point_at(0.95)), (r"the outside point \(.*\) mm lies at the vessel's point \(.*\) mm; move one of them",))):
            with self.subTest(points=points):
                self.assert_refused(self.trace(*self.points, *points, *output), status, *patterns)

    def test_bad_points(self):
        output = ("-o", self.result("out.vtp"))
        first = self.points[:4]
        for status, points, patterns in (
                (2, (), ("two points", "--point X Y Z")), (2, first, ("two points",)),
                (2, (*first, "--point", 1, 2), ("--point", "coordinate is missing")), (2, ("--point", 1, 2), ("--point", "value is missing")), (2, (*first, "--point", "nan", 0, 0), ("--point", "finite")),
                (1, (*first, "--point", 500, 0, 0), (r"\(500, 0, 0\) mm lies outside the image, which spans \(.*\) to \(.*\) mm; .* \(LPS\)",)),
                (1, (*first, *first), (r"points \(.*\) and \(.*\) mm are closer than 3 mm; keep one",)),
                (1, (*first, "--point", 40, 90, 90),
                 (r"path .* \(.*\) mm; put all points into the (same )?vessel",))):
            with self.subTest(points=points):
                self.assert_refused(self.trace(*points, *output), status, *patterns)

    def test_bad_options(self):
        for option, value in (("--radius", -1), ("--radius", 1000), ("--radius", "nan"), ("--wall-thickness", 9),
                              ("--modality", 3), ("--levels", 0), ("--iterations", -1), ("--label-value", 0), ("--threads", "all")):
            with self.subTest(option=option, value=value):
                self.assert_refused(self.trace(*self.points, "-o", self.result("out.vtp"), option, value), 2, option)

    def test_a_vessel_of_which_nothing_is_left(self):
        process = self.trace(*self.points, "-o", self.result("out.vtp"), "--wall-thickness", -5)
        self.assert_refused(process, 1, r"a --wall-thickness of -5 mm leaves less than 0.5 mm of a branch with a mean radius of \d\.\d mm; raise")

    def test_a_file_is_the_result_of_one_option(self):
        one = self.result("out.vtp")
        other = os.path.join(self.results, ".", "out.vtp")
        for arguments, words in ((("-o", one, "--centerline", one), "--output and --centerline name the same file"),
                                 (("-o", one, "--centerline", other), "--output and --centerline name the same file"),
                                 (("--convergence", "a.csv", "--save-points", "a.csv"), "--convergence and --save-points"),
                                 (("--points", "a.csv", "--convergence", "a.csv"), "'a.csv' is an input")):
            with self.subTest(arguments=arguments):
                self.assert_refused(self.trace(*self.points, *arguments), 2, words)

    def test_results_are_checked_before_any_work(self):
        self.assert_refused(self.trace(*self.points), 2, "--output", "--centerline")
        for option, name in (("-o", "out.vtk"), ("--labels", "out.png"), ("--centerline", "out.stl")):
            with self.subTest(name=name):
                process = self.trace(*self.points, option, self.result(name), volume="/nowhere/ct.nii.gz")
                self.assert_refused(process, 2, name, "Use ")


if __name__ == "__main__":
    unittest.main()
