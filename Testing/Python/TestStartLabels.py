"""flipfree.segment with a label map in place of a seed."""

import os
import tempfile
import unittest
import warnings

import flipfree
import numpy
from example import RADIUS, SEED, abdomen, image, needs_files, truth

LIVER = flipfree.Organ.LIVER


def fill(labels=None, label=LIVER, **parameters):
    return flipfree.segment(image(), start_labels=truth() if labels is None else labels, start_label=label, **parameters)


def mask():
    voxels = flipfree.array_from_image(truth()) if hasattr(flipfree, "array_from_image") else truth().voxels
    return numpy.where(voxels == LIVER, 1, 0).astype(numpy.uint8)


def grid_of(volume):
    """Spacing and origin."""
    return (volume.GetSpacing(), volume.GetOrigin()) if hasattr(volume, "GetSpacing") else (volume.spacing, volume.origin)


def turned(voxels):
    """As an image without the first voxels along x, its axes z, x and y, the last one backwards."""
    (dx, dy, dz), (x, y, z) = grid_of(image())
    part = voxels[:, ::-1, 10:].transpose(1, 2, 0)
    return flipfree.image_from_array(part, (dz, dx, dy), (x + 10 * dx, y + (voxels.shape[1] - 1) * dy, z),
                                     [[0, 1, 0], [0, 0, -1], [1, 0, 0]])


class StartLabels(unittest.TestCase):
    def test_are_filled(self):
        liver = fill()
        self.assertEqual(liver.self_intersections, 0)
        self.assertEqual(flipfree.evaluate(liver, truth(), reference_label=LIVER).dice, 1)
        # However they come.
        numpy.testing.assert_array_equal(fill(mask(), 1).points, liver.points)
        numpy.testing.assert_array_equal(fill(mask() > 0, 0).points, liver.points)

    def test_of_several_the_first_is_taken_with_a_warning(self):
        words = "The start labels have the labels 1, 2, .*; the surface fills label 1; to fill another one, set start_label"
        with self.assertWarnsRegex(flipfree.FlipFreeWarning, words):
            spleen = flipfree.segment(image(), start_labels=truth(), resolution=8)
        numpy.testing.assert_array_equal(spleen.points, fill(label=1, resolution=8).points)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            flipfree.segment(image(), start_labels=mask(), resolution=8)
        self.assertFalse([warning for warning in caught if "the labels" in str(warning.message)])

    def test_may_be_cropped_and_in_another_order(self):
        labels = turned(mask())
        numpy.testing.assert_array_equal(fill(labels, 1, resolution=8).points, fill(mask(), 1, resolution=8).points)
        self.assertEqual(flipfree.evaluate(labels, truth(), reference_label=LIVER).dice, 1)
        self.assertEqual(flipfree.evaluate(truth(), labels, segmentation_label=LIVER).dice, 1)

    def test_that_are_beside_the_organ_give_a_warning(self):
        with self.assertWarnsRegex(flipfree.FlipFreeWarning, "^The result is doubtful: its confidence is"):
            fill(numpy.roll(mask(), 20, axis=2), 1)

    @needs_files
    def test_may_be_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "network.nii.gz")
            flipfree.write_image(truth(), path)
            numpy.testing.assert_array_equal(fill(path, resolution=8).points, fill(resolution=8).points)

    def test_are_corrected_by_points(self):
        voxel, place = (28, 28, 20), (60, 84, 168)  # axes k, j, i; LPS
        liver = fill(resolution=16)
        self.assertEqual(liver.labels[voxel], 1)
        better = liver.corrected(outside=[place])
        self.assertEqual(better.self_intersections, 0)
        self.assertEqual(better.labels[voxel], 0)

    def test_that_do_not_fit_are_refused(self):
        for arguments, kind, words in (
                ({"label": 99}, flipfree.SegmentationError, "have no voxels with the value 99; they have 1, 2.*: set start_label to a value that they have"),
                ({"label": -1}, ValueError, "start_label"),
                ({"label": 1.5}, ValueError, "start_label"),
                ({"labels": mask()[1:], "label": 1}, ValueError, "start_labels: an array gets its geometry from the other image, of the shape"),
                ({"label": ""}, ValueError, "start_label"),
                ({"label": "liver"}, TypeError, "start_labels: 'liver' names a segment of a file"),
                ({"labels": 7}, TypeError, "start_labels: a label map"),
                ({"seed": SEED}, TypeError, "takes the place of seed and radius"),
                ({"radius": RADIUS}, TypeError, "takes the place of seed and radius")):
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                fill(**arguments)
        with self.assertRaisesRegex(TypeError, "seed and radius are needed"):
            flipfree.segment(image())
        with self.assertRaisesRegex(TypeError, "seed and radius are needed"):
            flipfree.segment(abdomen().image, SEED)


if __name__ == "__main__":
    unittest.main()
