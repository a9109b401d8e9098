"""Points that correct a result: obeyed, whatever their order and history, and refused by name."""

import math
import unittest

import flipfree
import numpy
from example import RADIUS, SEED, image, liver


class Corrections(unittest.TestCase):
    outside = (60, 83, 167)
    inside = (150, 100, 170)

    def test_the_set_of_points_alone_counts(self):
        free = liver()
        before = free.points.copy()
        smaller = free.corrected(outside=[self.outside])
        both = smaller.corrected(inside=[self.inside])
        self.assertEqual([one.kind for one in both.constraints], [0, 1])
        self.assertEqual(both.self_intersections, 0)
        self.assertTrue(numpy.array_equal(free.points, before))
        self.assertGreater(abs(smaller.points - before).max(), 5)
        at_once = flipfree.segment(image(), SEED, RADIUS, inside=[self.inside], outside=[self.outside])
        self.assertTrue(numpy.array_equal(at_once.points, both.points))
        self.assertTrue(numpy.array_equal(at_once.labels, both.labels))

    def test_label_maps_obey(self):
        corrected = liver().corrected(outside=[self.outside], inside=[self.inside], boundary=[(99, 40, 167)])
        for place, expected in ((self.outside, 0), (self.inside, 1)):
            # The phantom's voxels are 1.5 x 1.5 x 3 mm, the first one at the origin.
            i, j, k = (round(x / s) for x, s in zip(place, (1.5, 1.5, 3)))
            self.assertEqual(corrected.labels[k, j, i], expected)
        distance = numpy.linalg.norm(corrected.points - (99, 40, 167), axis=1).min()
        self.assertLess(distance, 4)

    def test_bad_points(self):
        for error, message, points in (
                (TypeError, r"^inside: a list of points is needed: \[\(x, y, z\)\], not", {"inside": (1, 2, 3)}),
                (TypeError, "^outside: a list is needed", {"outside": 5}),
                (TypeError, r"^corrected\(\) has no parameter 'outsid'; did you mean 'outside'. there are inside, outside, ",
                 {"outsid": [self.outside]}),
                (ValueError, "^boundary: 3 numbers are needed, not 2$", {"boundary": [(1, 2)]}),
                (TypeError, "^inside: 3 numbers are needed", {"inside": ["here"]}),
                (TypeError, "^seeds: pairs of a center and a radius", {"seeds": [(1, 2, 3)]}),
                (flipfree.SegmentationError, r"the inside point \(500, 0, 0\) mm lies outside the image",
                 {"inside": [(500, 0, 0)]}),
                (flipfree.SegmentationError, "the outside point .* inner half of the seed", {"outside": [SEED]}),
                (flipfree.SegmentationError, "lies outside the image", {"inside": [(math.nan, 1, 2)]})):
            with self.subTest(points), self.assertRaisesRegex(error, message):
                liver().corrected(**points)


if __name__ == "__main__":
    unittest.main()
