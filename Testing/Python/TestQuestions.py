"""Questions of a result: what it is not sure of, and what answers change."""

import os
import pickle
import sys
import unittest

import flipfree
import numpy

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Support"))
from lobed_ball import LOBE, RADIUS, SEED, SIZE, SPACING, lobed_ball  # pylint: disable=wrong-import-position


def segmented(brighter, **more):
    voxels = numpy.frombuffer(lobed_ball(brighter), numpy.int16).reshape(SIZE[::-1])
    return flipfree.segment(voxels, SEED, RADIUS, spacing=SPACING, resolution=16, **more)


class Questions(unittest.TestCase):
    def test_first_question_is_the_warning(self):
        with self.assertWarnsRegex(flipfree.FlipFreeWarning,
                                   r"^Is the part of \d+ ml at \(\d+, \d+, \d+\) mm organ\? outside \d+ \d+ \d+ removes it\.$"):
            organ = segmented(0)
        question, = organ.questions
        self.assertIsInstance(question, flipfree.Question)
        self.assertLess(numpy.abs(numpy.subtract(question.place, LOBE)).max(), 8)
        self.assertLess(abs(question.volume - 32), 12)
        self.assertIs(question.included, True)
        self.assertGreater(question.margin, 0)
        self.assertRegex(str(question), r"^Is the part of \d+ ml at \(\d+, \d+, \d+\) mm organ\? It is included\.$")
        self.assertEqual(pickle.loads(pickle.dumps(organ)).questions, organ.questions)

        without = organ.answered({0: False})
        self.assertEqual(without.questions, ())
        self.assertLess(without.volume, organ.volume - 20)
        again = segmented(0, outside=[question.place])
        self.assertTrue(numpy.array_equal(again.points, without.points))

    def test_yes_brings_what_was_left_out(self):
        with self.assertWarnsRegex(flipfree.FlipFreeWarning,
                                   r"^Is the part of \d+ ml at \(\d+, \d+, \d+\) mm organ\? inside \d+ \d+ \d+ adds it\.$"):
            organ = segmented(6)
        question, = organ.questions
        self.assertIs(question.included, False)
        self.assertRegex(str(question), "It is left out.$")
        with_lobe = organ.answered({0: True})
        self.assertGreater(with_lobe.volume, organ.volume + 20)
        self.assertEqual(with_lobe.questions, ())
        self.assertEqual([(one.kind, one.place) for one in with_lobe.constraints], [(1, question.place)])
        self.assertEqual(organ.constraints, ())
        for error, message, answers in (
                (ValueError, "^answers: there is no question 1; there are 1$", {1: True}),
                (ValueError, "^answers: there is no question -1; there are 1$", {-1: True}),
                (ValueError, "^answers: there is no question 'first'", {"first": True}),
                (TypeError, "^answers: question 0 is answered by True or False, not 'yes'$", {0: "yes"}),
                (TypeError, r"^answers: a dict is needed, such as {0: True} for the first question, not \[True\]$", [True])):
            with self.subTest(answers), self.assertRaisesRegex(error, message):
                organ.answered(answers)

    def test_a_seed_that_is_not_within_the_organ_asks_nothing_and_gives_no_confidence(self):
        # Beside the ball, and in a corner of the image.
        for place, radius, message in (((78, 47, 20), 12, "of the surface found no boundary"),
                                       ((20, 12, 12), 8, "lies at the image's border")):
            voxels = numpy.frombuffer(lobed_ball(0), numpy.int16).reshape(SIZE[::-1])
            with self.subTest(place), self.assertWarnsRegex(flipfree.FlipFreeWarning, message):
                organ = flipfree.segment(voxels, place, radius, spacing=SPACING, resolution=16)
                self.assertEqual(organ.questions, ())
                self.assertLess(organ.confidence, 0.85)

    def test_a_seed_that_reaches_out_of_the_organ_is_made_smaller(self):
        image = flipfree.phantom("abdomen").image  # an aorta, and the tissue around it
        message = "^The seed sphere of 14 mm seems to reach out .*; a sphere of 8.96 mm was used in its place"
        with self.assertWarnsRegex(flipfree.FlipFreeWarning, message):
            organ = flipfree.segment(image, (168.75, 148.75, 139), 14)
        self.assertGreater(organ.confidence, 0.25)
        with self.assertWarnsRegex(flipfree.FlipFreeWarning, "inner half; lower radius or move seed"):
            organ = flipfree.segment(image, (168.75, 148.75, 139), 14, carving=False)
        self.assertEqual(organ.questions, ())
        self.assertLess(organ.confidence, 0.25)

    def test_organs_of_a_group_have_theirs(self):
        voxels = numpy.frombuffer(lobed_ball(0), numpy.int16).reshape(SIZE[::-1])
        with self.assertWarnsRegex(flipfree.FlipFreeWarning, "^'ball': Is the part of"):
            organs = flipfree.segment_organs(voxels, {"ball": (SEED, RADIUS)}, spacing=SPACING, resolution=16)
        self.assertEqual(len(organs["ball"].questions), 1)
        answered = organs.answered("ball", {0: False})
        self.assertEqual(answered["ball"].questions, ())
        self.assertLess(answered["ball"].volume, organs["ball"].volume - 20)
        numpy.testing.assert_array_equal(organs["ball"].answered({0: False}).points, answered["ball"].points)

    def test_vessels_have_none(self):
        vessel = flipfree.trace(flipfree.phantom("vessel").image, [(13.3, 44.6, 44.5), (82, 50.4, 37.6)])
        self.assertEqual(vessel.questions, ())


if __name__ == "__main__":
    unittest.main()
