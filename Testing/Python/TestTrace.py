"""Vessels from Python: arrays, the same as from the filter, progress, errors, types."""

import math
import os
import tempfile
import unittest

import flipfree
import numpy as np
from example import needs_wheel

SIZE, SPACING = 64, 1.5


def point_at(place):
    """On the axis of the vessel phantom, which ends at -1 and 1."""
    center = (SIZE - 1) / 2 * SPACING
    return (center + 36 * place, center + 16 * math.sin(math.pi * place),
            center + 10 * math.cos(0.8 * math.pi * place + 0.5))


def winding_number(vessel, point):
    """How often the surface winds around a point: 1 inside, 0 outside."""
    a, b, c = (vessel.points[corners].astype(float) - point for corners in vessel.triangles.T)
    la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    rest = (la * lb * lc + np.einsum("ij,ij->i", a, b) * lc + np.einsum("ij,ij->i", b, c) * la
            + np.einsum("ij,ij->i", c, a) * lb)
    return round(np.arctan2(volume, rest).sum() / (2 * math.pi))


class TestTrace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.phantom = flipfree.phantom("vessel", dimensions=(SIZE,) * 3, spacing=(SPACING,) * 3)
        cls.points = [point_at(-0.95), point_at(0.95)]
        cls.vessel = flipfree.trace(cls.phantom.image, cls.points)

    def test_ends_of_the_phantom(self):
        self.assertEqual(len(self.phantom.ends), 2)
        self.assertEqual(len(flipfree.trace(self.phantom.image, self.phantom.ends).branches), 1)
        self.assertEqual(flipfree.phantom("sphere", dimensions=(16,) * 3).ends, ())

    def test_surface_labels_and_branches(self):
        vessel = self.vessel
        self.assertEqual(vessel.self_intersections, 0)
        self.assertEqual(vessel.points.shape[1], 3)
        self.assertGreater(flipfree.evaluate(vessel, self.phantom.label_map).dice, 0.9)
        (branch,) = vessel.branches
        self.assertEqual(len(branch.points), len(branch.radius))
        self.assertTrue(np.all(np.diff(branch.length) > 0))
        self.assertAlmostEqual(float(np.median(branch.radius)), 4, delta=0.4)
        np.testing.assert_allclose(branch.points[[0, -1]].round(-1).sum(), np.round(self.points, -1).sum(), atol=30)
        self.assertEqual(branch.parent, -1)
        self.assertEqual(branch.points.shape, (len(branch.radius), 3))
        self.assertEqual(len(vessel.stage_seconds), 4)
        self.assertTrue(0.9 < vessel.support <= 1, vessel.support)
        self.assertTrue(0.6 < vessel.confidence <= vessel.support, vessel.confidence)
        self.assertRegex(repr(vessel), r"^<Vessel: [\d.]+ ml, confidence [01][.]\d\d, \d+ vertices, 0 self-intersections, '")

    def test_centerline_is_vtks(self):
        """Of the package without VTK, too, where there is one."""
        try:
            line = self.vessel.centerline
        except flipfree.FlipFreeError as error:
            self.assertRegex(str(error), r"^centerline: .*pip install vtk.*\.branches")
            self.skipTest("VTK is not installed")
        (branch,) = self.vessel.branches
        self.assertEqual((line.GetNumberOfLines(), line.GetNumberOfPoints()), (1, len(branch.points)))
        last = line.GetNumberOfPoints() - 1
        self.assertEqual(line.GetPoint(last), tuple(branch.points[-1]))
        self.assertEqual(line.GetPointData().GetArray("Radius").GetTuple1(last), branch.radius[-1])
        self.assertEqual(line.GetPointData().GetArray("ArcLength").GetTuple1(last), branch.length[-1])
        self.assertEqual(line.GetCellData().GetArray("Parent").GetTuple1(0), -1)

    @needs_wheel
    def test_centerline_as_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "line.vtp")
            flipfree.write_centerline(self.vessel, path)
            try:
                from vtkmodules.util.numpy_support import vtk_to_numpy
                from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
            except ImportError:
                self.skipTest("VTK is not installed")
            reader = vtkXMLPolyDataReader()
            reader.SetFileName(path)
            reader.Update()
            line = reader.GetOutput()
        (branch,) = self.vessel.branches
        np.testing.assert_array_equal(vtk_to_numpy(line.GetPoints().GetData()), branch.points)
        for name, column in (("Radius", "radius"), ("ArcLength", "length")):
            np.testing.assert_array_equal(vtk_to_numpy(line.GetPointData().GetArray(name)), getattr(branch, column))
        self.assertEqual(line.GetCellData().GetArray("Parent").GetTuple1(0), -1)
        with self.assertRaisesRegex(flipfree.FileError, "Use .vtp"):
            flipfree.write_centerline(self.vessel, "line.stl")
        with self.assertRaisesRegex(TypeError, r"^vessel: what trace\(\) has returned"):
            flipfree.write_centerline(self.vessel.mesh, "line.vtp")

    def test_corrections(self):
        """They are obeyed, whether given at once or later, and taking them away leaves no trace."""
        x, y, z = point_at(0)
        beside, within = (x, y, z + 6.5), tuple(a + b for a, b in zip(point_at(0.5), (0, 0, 2)))
        border = tuple(a + b for a, b in zip(point_at(-0.5), (0, 0, 7)))

        def gap_at(vessel, point):
            return np.linalg.norm(vessel.points - point, axis=1).min()

        def label_at(vessel, point):
            i, j, k = (round(a / SPACING) for a in point)
            return vessel.labels[k, j, i]

        self.assertEqual([label_at(self.vessel, point) for point in (beside, within)], [0, 1])
        self.assertEqual([winding_number(self.vessel, point) for point in (beside, within)], [0, 1])
        self.assertGreater(gap_at(self.vessel, border), 1.8)
        once = flipfree.trace(self.phantom.image, self.points, inside=[beside], outside=[within], boundary=[border])
        later = self.vessel.corrected(inside=[beside]).corrected(outside=[within], boundary=[border])
        self.assertEqual(label_at(once, beside), 1)
        self.assertEqual([winding_number(once, point) for point in (beside, within)], [1, 0])
        self.assertLess(gap_at(once, border), 1.5)  # the surface is within 0.75 mm, a vertex near that
        self.assertEqual(once.self_intersections, 0)
        self.assertEqual(len(later.constraints), 3)
        np.testing.assert_array_equal(once.points, later.points)
        np.testing.assert_array_equal(self.vessel.corrected().points, self.vessel.points)

    def test_bad_corrections(self):
        for parameters, words in (({"boundary": [(500, 0, 0)]}, r"the boundary point \(500, 0, 0\) mm lies outside"),
                                  ({"outside": [self.points[0]]}, "the outside point .* lies at the vessel's point"),
                                  ({"seeds": [((40, 40, 40), 5)]}, "no further seeds")):
            with self.subTest(words=words), self.assertRaisesRegex(flipfree.SegmentationError, words):
                self.vessel.corrected(**parameters)
        with self.assertRaisesRegex(TypeError, "^inside: a list"):
            flipfree.trace(self.phantom.image, self.points, inside=7)

    def test_points_may_be_an_array_in_any_order(self):
        again = flipfree.trace(self.phantom.image, np.array(self.points[::-1]))
        self.assertEqual(len(again.branches), 1)
        self.assertGreater(flipfree.evaluate(again, self.vessel.label_map).dice, 0.97)

    def test_users_say_what_the_scale_of_the_gray_values_is(self):
        """A contrast of 10 is a vessel's in MR, but not in CT."""
        weak = flipfree.array_from_image(self.phantom.image) / 10
        for modality in ({}, {"modality": 0}, {"modality": 2}):
            found = flipfree.trace(weak, self.points, spacing=(SPACING,) * 3, **modality)
            self.assertGreater(found.support, 0.95)
            self.assertIn(f'"modality":{modality.get("modality", 0)}', found.provenance)
        with self.assertRaisesRegex(flipfree.SegmentationError, "no path|no vessel boundary"):
            flipfree.trace(weak, self.points, spacing=(SPACING,) * 3, modality=1)
        with self.assertRaisesRegex(ValueError, "modality: 3 is out of range"):
            flipfree.trace(weak, self.points, spacing=(SPACING,) * 3, modality=3)

    def test_ctrl_c_and_a_failing_progress_end_it(self):
        for error in (KeyboardInterrupt, ZeroDivisionError):
            def tell(_part, error=error):
                raise error

            with self.assertRaises(error):
                flipfree.trace(self.phantom.image, self.points, progress=tell)

    def test_an_array_gives_the_same(self):
        told = []
        again = flipfree.trace(flipfree.array_from_image(self.phantom.image), self.points, spacing=(SPACING,) * 3,
                               origin=(0, 0, 0),
                               progress=lambda part, *_: told.append(part))
        np.testing.assert_array_equal(again.points, self.vessel.points)
        np.testing.assert_array_equal(again.labels, self.vessel.labels)
        self.assertGreater(len(told), 3)

    def test_bad_arguments(self):
        image = self.phantom.image
        for points, kind, words in ((self.points[:1], flipfree.SegmentationError, "two points"),
                                    ([*self.points, (500, 0, 0)], flipfree.SegmentationError, "outside"),
                                    ([(1, 2), (3, 4)], (TypeError, ValueError), "points"),
                                    ([*self.points, (math.nan, 0, 0)], flipfree.SegmentationError, "finite numbers"),
                                    ([*self.points, self.points[0]], flipfree.SegmentationError,
                                     r"the points \(.*\) and \(.*\) mm are closer than 3 mm; keep one"),
                                    ([self.points[0], (40, 90, 90)], flipfree.SegmentationError,
                                     r"path .* \(.*\) mm; put all points into the (same )?vessel"),
                                    ((1, 2, 3), TypeError, r"^points: a list of points is needed: \[\(x, y, z\)\]"),
                                    (7, TypeError, "^points: a list is needed, not 7"),
                                    ("abc", (TypeError, ValueError), "points")):
            with self.subTest(points=points), self.assertRaisesRegex(kind, words):
                flipfree.trace(image, points)
        with self.assertRaisesRegex(TypeError, "radios"):
            flipfree.trace(image, self.points, radios=4)
        with self.assertRaisesRegex(ValueError, "wall_thickness"):
            flipfree.trace(image, self.points, wall_thickness=50)
        with self.assertRaisesRegex(flipfree.SegmentationError, "the value of radius is not a number"):
            flipfree.trace(image, self.points, radius=math.nan)
        with self.assertRaisesRegex(TypeError, "^levels: a whole number is needed, not 1.5$"):
            flipfree.trace(image, self.points, levels=1.5)
        with self.assertRaisesRegex(flipfree.SegmentationError, "^No segmentation: the image has no voxels; give one"):
            flipfree.trace(np.zeros((0, 3, 3)), self.points, spacing=(1, 1, 1))


if __name__ == "__main__":
    unittest.main()
