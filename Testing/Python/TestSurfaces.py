"""flipfree.surfaces: all labels of a label map as closed surfaces with shared walls."""

import tempfile
import unittest
from pathlib import Path

import flipfree
import numpy
from example import needs_files


def blocks(kind=numpy.int32):
    """Two boxes that share a wall, and one that touches the border of the image."""
    voxels = numpy.zeros((12, 18, 20), kind)
    voxels[2:8, 3:11, 3:9] = 1
    voxels[2:8, 3:11, 9:16] = 70000 if numpy.iinfo(kind).max > 70000 else 7
    voxels[9:, 14:, :] = 3
    return voxels


def image_of(voxels):
    return flipfree.image_from_array(voxels, (1, 1.5, 2), (-10, 20, 300))


def is_closed(triangles):
    """Each edge is on two triangles, which traverse it in opposite directions."""
    edges = numpy.concatenate([triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    forward, backward = ({tuple(edge) for edge in some} for some in (edges, edges[:, ::-1]))
    return len(forward) == len(edges) and forward == backward


class Surfaces(unittest.TestCase):
    def test_are_closed_and_share_walls(self):
        found = flipfree.surfaces(image_of(blocks()), exact=True)
        self.assertEqual(list(found.labels), [1, 3, 70000])
        self.assertEqual(found.wrong_voxels, 0)
        total = 0
        for label, measures in found.labels.items():
            points, triangles = found.surface(label)
            total += len(triangles)
            self.assertTrue(is_closed(triangles))
            self.assertEqual((measures.label, measures.euler_number, measures.triangles), (label, 2, len(triangles)))
            a, b, c = points[triangles].swapaxes(0, 1)
            volume = (a * numpy.cross(b, c)).sum() / 6000
            self.assertAlmostEqual(volume, measures.volume, 9)
            self.assertAlmostEqual(volume / measures.voxel_volume, 1, 2)
            numpy.testing.assert_array_equal(points, points.astype(numpy.float32))
        shared = ((found.boundary_labels == (1, 70000)).all(1)).sum()
        self.assertGreater(shared, 50)
        self.assertEqual(total, len(found.triangles) + shared)
        self.assertRegex(repr(found), r"<LabelSurfaces: 3 labels, \d+ triangles>")

    def test_parameters_are_obeyed(self):
        image = image_of(blocks(numpy.uint8))
        steps = flipfree.surfaces(image, iterations=0)
        smooth = flipfree.surfaces(image, only=[1, 7], distance=1)
        self.assertEqual(list(smooth.labels), [1, 7])
        self.assertLess(smooth.labels[1].area, steps.labels[1].area)
        self.assertGreater(smooth.greatest_distance, 0)
        told = []
        flipfree.surfaces(image, progress=told.append)
        self.assertEqual((sorted(told), told[-1]), (told, 1))

    def test_parts_and_triangles_may_be_fewer(self):
        voxels = blocks()
        voxels[0, 0, 0] = 5  # a speck of 3 mm3
        voxels[4, 6, 5] = 0  # a cavity
        voxels[2:8, 6, 12] = 0  # a tunnel
        fine = flipfree.surfaces(image_of(voxels), exact=True)
        found = flipfree.surfaces(
            image_of(voxels), exact=True, smallest_part=4, fill_cavities=True, fill_tunnels=2, triangles=1
        )
        self.assertEqual((fine.labels[1].euler_number, found.labels[1].euler_number), (4, 2))
        self.assertEqual((fine.labels[70000].euler_number, found.labels[70000].euler_number), (0, 2))
        self.assertEqual((found.labels[5].triangles, found.wrong_voxels, fine.collapse_distance), (0, 3, 0))
        self.assertLess(5 * len(found.triangles), len(fine.triangles))
        self.assertTrue(0 < found.collapse_distance <= 0.5)
        for label in (1, 3, 70000):
            self.assertTrue(is_closed(found.surface(label)[1]))
        self.assertRegex(repr(found), "<LabelSurfaces: 3 labels")
        with self.assertRaisesRegex(ValueError, r"label: 5 has no surface; there are \[1, 3, 70000\]"):
            found.surface(5)

    def test_what_is_wrong_is_said(self):
        image = image_of(blocks())
        for error, text, call in (
            (flipfree.FlipFreeError, "no voxel with label 5; change only", lambda: flipfree.surfaces(image, only=[5])),
            (flipfree.FlipFreeError, "has no labels", lambda: flipfree.surfaces(image_of(0 * blocks()))),
            (flipfree.FlipFreeError, "the value -1 at voxel", lambda: flipfree.surfaces(image_of(-(blocks() == 1).astype(int)))),
            (flipfree.FlipFreeError, "no part of any label has 1e.06 mm3; lower smallest_part", lambda: flipfree.surfaces(image, smallest_part=1e6)),
            (ValueError, "distance: 3 is out of range; give 0.5 to 1", lambda: flipfree.surfaces(image, distance=3)),
            (TypeError, "surfaces.. has no parameter 'exakt'", lambda: flipfree.surfaces(image, exakt=True)),
            (TypeError, "image_from_array", lambda: flipfree.surfaces(blocks())),
            (ValueError, "label: 2 has no surface", lambda: flipfree.surfaces(image).surface(2)),
        ):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                call()

    @needs_files
    def test_files_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "labels.nii.gz"
            flipfree.write_image(image_of(blocks(numpy.uint8)), path)
            one, other = flipfree.surfaces(path), flipfree.surfaces(image_of(blocks(numpy.uint8)))
            numpy.testing.assert_array_equal(one.points, other.points)
            numpy.testing.assert_array_equal(one.triangles, other.triangles)


if __name__ == "__main__":
    unittest.main()
