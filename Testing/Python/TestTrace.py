"""Vessels from Python: arrays, the same as from the filter, progress, errors, types."""

import math
import unittest

import flipfree
import numpy as np

SIZE, SPACING = 64, 1.5


def point_at(place):
    """On the axis of the vessel phantom, which ends at -1 and 1."""
    center = (SIZE - 1) / 2 * SPACING
    return (center + 36 * place, center + 16 * math.sin(math.pi * place),
            center + 10 * math.cos(0.8 * math.pi * place + 0.5))


class TestTrace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.phantom = flipfree.phantom("vessel", dimensions=(SIZE,) * 3, spacing=(SPACING,) * 3)
        cls.points = [point_at(-0.95), point_at(0.95)]
        cls.vessel = flipfree.trace(cls.phantom.image, cls.points)

    def test_surface_labels_and_branches(self):
        vessel = self.vessel
        self.assertEqual(vessel.self_intersections, 0)
        self.assertEqual(vessel.points.shape[1], 3)
        self.assertGreater(flipfree.evaluate(vessel, self.phantom.label_map).dice, 0.9)
        (branch,) = vessel.branches
        self.assertEqual(len(branch["points"]), len(branch["radius"]))
        self.assertTrue(np.all(np.diff(branch["length"]) > 0))
        self.assertAlmostEqual(float(np.median(branch["radius"])), 4, delta=0.4)
        np.testing.assert_allclose(branch["points"][[0, -1]].round(-1).sum(), np.round(self.points, -1).sum(), atol=30)

    def test_an_array_gives_the_same(self):
        told = []
        again = flipfree.trace(flipfree.array_from_image(self.phantom.image), self.points, spacing=(SPACING,) * 3,
                               origin=self.phantom.image.GetOrigin(),
                               progress=lambda part, *_: told.append(part))
        np.testing.assert_array_equal(again.points, self.vessel.points)
        np.testing.assert_array_equal(again.labels, self.vessel.labels)
        self.assertGreater(len(told), 3)

    def test_bad_arguments(self):
        image = self.phantom.image
        for points, kind, words in ((self.points[:1], flipfree.SegmentationError, "two points"),
                                    ([*self.points, (500, 0, 0)], flipfree.SegmentationError, "outside"),
                                    ([(1, 2), (3, 4)], (TypeError, ValueError), "points"),
                                    ("abc", (TypeError, ValueError), "points")):
            with self.subTest(points=points), self.assertRaisesRegex(kind, words):
                flipfree.trace(image, points)
        with self.assertRaisesRegex(TypeError, "radios"):
            flipfree.trace(image, self.points, radios=4)
        with self.assertRaisesRegex(ValueError, "wall_thickness"):
            flipfree.trace(image, self.points, wall_thickness=50)


if __name__ == "__main__":
    unittest.main()
