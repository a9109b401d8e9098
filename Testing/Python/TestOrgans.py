"""flipfree.segment_organs: several organs together."""

import copy
import functools
import pickle
import unittest

import flipfree
import numpy
from example import RADIUS, SEED, abdomen, image, surface_of, truth

SPLEEN = abdomen().seeds[flipfree.Organ.SPLEEN]
SPLEEN_RIM = numpy.add(SPLEEN[0], (0, 0, SPLEEN[1] + 8)).tolist()


def both(**parameters):
    return flipfree.segment_organs(image(), {"liver": (SEED, RADIUS), "spleen": SPLEEN}, resolution=16, **parameters)


class Organs(unittest.TestCase):
    def test_by_name(self):
        organs = both(label_value=3)
        self.assertEqual(list(organs), ["liver", "spleen"])
        self.assertEqual([organs.label_of(name) for name in organs], [3, 4])
        self.assertEqual(sorted(numpy.unique(organs.labels)), [0, 3, 4])
        for name, organ, dice in (("liver", flipfree.Organ.LIVER, 0.910), ("spleen", flipfree.Organ.SPLEEN, 0.893)):
            self.assertEqual(organs[name].self_intersections, 0)
            self.assertGreater(organs[name].confidence, 0.5)
            self.assertAlmostEqual(flipfree.evaluate(organs[name], truth(), reference_label=organ).dice, dice, delta=0.005)
        turned = flipfree.segment_organs(image(), {"spleen": SPLEEN, "liver": (SEED, RADIUS)}, resolution=16)
        numpy.testing.assert_array_equal(turned["liver"].points, organs["liver"].points)

    def test_points_and_surfaces_that_stay(self):
        place = (60, 84, 168)
        free = both()
        liver = {"seed": SEED, "radius": RADIUS, "outside": [place]}
        organs = flipfree.segment_organs(image(), {"liver": liver, "spleen": SPLEEN}, resolution=16)
        self.assertEqual(len(organs["liver"].constraints), 1)
        self.assertFalse(numpy.array_equal(organs["liver"].points, free["liver"].points))
        for surface in (free["liver"], surface_of(free["liver"])):
            beside = flipfree.segment_organs(image(), {"spleen": SPLEEN}, fixed=[surface], resolution=16)
            self.assertFalse(numpy.any((beside.labels == 1) & (free.labels == 1)))

    def test_are_corrected_together(self):
        outside, boundary = (60, 84, 168), (70, 84, 168)
        first = both()
        before = first.labels.copy(), first["liver"].points.copy()
        organs = first.corrected("liver", outside=[outside]).corrected("spleen", boundary=[SPLEEN_RIM])
        at_once = flipfree.segment_organs(
            image(), {"liver": {"seed": SEED, "radius": RADIUS, "outside": [outside]},
                      "spleen": {"seed": SPLEEN[0], "radius": SPLEEN[1], "boundary": [SPLEEN_RIM]}}, resolution=16)
        self.assertEqual([len(organs[name].constraints) for name in organs], [1, 1])
        numpy.testing.assert_array_equal(organs.labels, at_once.labels)
        for name in organs:
            numpy.testing.assert_array_equal(organs[name].points, at_once[name].points)
        # One alone is that of all.
        alone = first["liver"].corrected(outside=[outside]).corrected(boundary=[boundary])
        group = first.corrected("liver", outside=[outside]).corrected("liver", boundary=[boundary])
        self.assertEqual(len(alone.constraints), 2)
        numpy.testing.assert_array_equal(alone.points, group["liver"].points)
        self.assertEqual(len(first["liver"].constraints), 0)
        for found, kept in zip((first.labels, first["liver"].points), before):
            numpy.testing.assert_array_equal(found, kept)

    def test_copies_are_not_corrected(self):
        organs = both()
        for correct in (copy.copy(organs["liver"]).corrected,
                        functools.partial(pickle.loads(pickle.dumps(organs)).corrected, "liver")):
            with self.assertRaisesRegex(flipfree.FlipFreeError, "not a copy of it; call the function again with the points"):
                correct(inside=[SEED])
        with self.assertRaises(KeyError):
            organs.corrected("gut", inside=[SEED])

    def test_what_is_wrong_is_named(self):
        for organs, kind, words in (
                ([("liver", SEED)], TypeError, "organs: a dict"),
                ({"liver": SEED}, TypeError, "'liver' needs a pair of seed and radius"),
                ({"liver": {"seed": SEED}}, TypeError, "'liver': 'radius' is missing"),
                ({"liver": {"seed": SEED, "radius": 5, "point": 1}}, TypeError, "'liver': there is no key 'point'; its keys are"),
                ({"liver": {"seed": SEED, "radius": 5, "insde": []}}, TypeError, "no key 'insde'; did you mean 'inside'"),
                ({"liver": {"seed": SEED, "raduis": 5}}, TypeError, "'liver': there is no key 'raduis'; did you mean 'radius'"),
                ({"liver": ((1, 2), 5)}, ValueError, "seed"),
                ({}, flipfree.SegmentationError, "there is no organ"),
                ({"liver": (SEED, RADIUS), "gut": (SEED, 5)}, flipfree.SegmentationError, "overlap"),
                ({"1": (SEED, RADIUS), 1: SPLEEN}, flipfree.SegmentationError, "two organs are named '1'"),
                ({"liver": ((-500, 0, 0), 5)}, flipfree.SegmentationError, "'liver': the seed"),
                ({"Levels": ((-500, 0, 0), 5)}, flipfree.SegmentationError, "'Levels': the seed")):
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                flipfree.segment_organs(image(), organs)
        with self.assertRaisesRegex(TypeError, "fixed"):
            flipfree.segment_organs("nowhere.nii.gz", {"liver": (SEED, RADIUS)}, fixed=[1])
        with self.assertRaisesRegex(TypeError, "no parameter 'keep_history'"):
            both(keep_history=True)
        with self.assertRaisesRegex(TypeError, "fixed: a"):
            both(fixed=[1])
        with self.assertRaisesRegex(flipfree.SegmentationError, "switch guard and carving on"):
            both(guard=False)


if __name__ == "__main__":
    unittest.main()
