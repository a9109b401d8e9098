"""Points that correct a result: obeyed, whatever their order and history, and refused by name."""

import math
import unittest

import flipfree
import numpy
from example import RADIUS, SEED, SPACING, image, liver


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

    def test_a_stroke_is_an_array_of_points(self):
        stroke = numpy.linspace(self.outside, (66, 83, 167), 20)
        drawn = liver().corrected(outside=stroke)
        self.assertEqual(len(drawn.constraints), 20)
        listed = liver().corrected(outside=stroke[::-1].tolist())
        self.assertTrue(numpy.array_equal(drawn.points, listed.points))
        for place in stroke:
            i, j, k = (round(x / s) for x, s in zip(place, SPACING))
            self.assertEqual(drawn.labels[k, j, i], 0)
        with self.assertRaisesRegex(TypeError, r"^outside: a list of points is needed"):
            liver().corrected(outside=stroke[0])
        with self.assertRaisesRegex(ValueError, "^outside: 3 numbers are needed, not 2"):
            liver().corrected(outside=stroke[:, :2])

    def test_label_maps_obey(self):
        corrected = liver().corrected(outside=[self.outside], inside=[self.inside], boundary=[(99, 40, 167)])
        for place, expected in ((self.outside, 0), (self.inside, 1)):
            # The phantom's first voxel is at the origin.
            i, j, k = (round(x / s) for x, s in zip(place, SPACING))
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
                (flipfree.SegmentationError, r"the inside point \(nan, 1, 2\) mm is not a place; give three finite numbers", {"inside": [(math.nan, 1, 2)]})):
            with self.subTest(points), self.assertRaisesRegex(error, message):
                liver().corrected(**points)

    def test_points_that_contradict_each_other(self):
        x, y, z = self.outside
        with self.assertRaisesRegex(flipfree.SegmentationError, "the (in|out)side point .* and the (in|out)side point .* are in the "
                                                                "same place; remove one of them"):
            liver().corrected(inside=[self.outside], outside=[self.outside])
        # A cage of outside points around one that is inside.
        ball = flipfree.phantom("sphere", dimensions=(64, 64, 40), spacing=(1, 1, 1.6))
        (x, y, z), radius = ball.seeds[1]
        golden = (1 + math.sqrt(5)) / 2
        cage = [(x + 27 + 2 * a / golden, y + 2 * b / golden, z + 2 * c / golden) for s in (-1, 1) for t in (-golden, golden)
                for a, b, c in ((0, s, t), (s, t, 0), (t, 0, s))]
        with self.assertRaisesRegex(flipfree.SegmentationError, r"the inside point \(58.5, 31.5, 31.2\) mm cannot be obeyed: the "
                                                                "surface of one piece does not get there past the other points"):
            flipfree.segment(ball.image, (x, y, z), radius, inside=[(x + 27, y, z)], outside=cage, levels=1, resolution=8)


if __name__ == "__main__":
    unittest.main()
