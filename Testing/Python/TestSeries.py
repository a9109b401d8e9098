"""A folder of DICOM files: what is in it, and which series is read."""

import json
import os
import sys
import tempfile
import unittest
from pathlib import Path

import numpy

import flipfree

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Support"))

import dicom  # pylint: disable=wrong-import-position

FIRST, SECOND = "1.2.826.0.1.3680043.2.1143.80.1", "1.2.826.0.1.3680043.2.1143.80.2"
SPACING, ORIGIN = (0.75, 0.5, 3.0), (-20.0, 12.0, 40.0)


class TestSeries(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.volume = numpy.arange(5 * 6 * 8).reshape(5, 6, 8) - 100
        dicom.write_series(self.folder, self.volume, SPACING, ORIGIN, FIRST, "a")
        dicom.write_series(self.folder, self.volume[:4] + 7, SPACING, ORIGIN, SECOND, "b")

    def test_the_list(self):
        first, second = flipfree.series(self.folder)
        self.assertEqual(first, flipfree.Series(FIRST, "", "", "CT", 5, SPACING, ""))
        self.assertEqual((second.uid, second.slices), (SECOND, 4))
        os.remove(self.folder / "b002")
        damaged = flipfree.series(self.folder)[1]
        self.assertIsNone(damaged.spacing)
        self.assertIn("1 slice is missing", damaged.problem)

    def test_each_is_read_by_its_name(self):
        for name, expected in ((None, self.volume), (FIRST, self.volume), (SECOND, self.volume[:4] + 7)):
            with self.subTest(name):
                image = flipfree.read_image(self.folder, series=name)
                numpy.testing.assert_array_equal(flipfree.array_from_image(image), expected)
        with self.assertRaisesRegex(flipfree.FileError, f"no series '9.9'. It holds {FIRST}"):
            flipfree.read_image(self.folder, series="9.9")

    def test_of_a_segmentation(self):
        """It is chosen by its name, and the result says which it was."""
        ball = flipfree.phantom("sphere", dimensions=(48, 48, 32), spacing=(1, 1, 1.6))
        voxels = flipfree.array_from_image(ball.image)
        with tempfile.TemporaryDirectory() as folder:
            dicom.write_series(folder, voxels, (1, 1, 1.6), (0, 0, 0), FIRST, "a")
            dicom.write_series(folder, voxels[:-1] + 300, (1, 1, 1.6), (0, 0, 0), SECOND, "b")
            seed = ((23.5, 23.5, 24.8), 8)
            small = {"resolution": 8, "levels": 1}
            for name, read in ((None, FIRST), (SECOND, SECOND)):
                organ = flipfree.segment(folder, *seed, series=name, **small)
                self.assertEqual(json.loads(organ.provenance)["image"]["series"], read)
                better = organ.corrected(inside=[seed[0]])
                self.assertEqual(json.loads(better.provenance)["image"]["series"], read)
            organs = flipfree.segment_organs(folder, {"ball": seed}, series=SECOND, **small)
            self.assertEqual(json.loads(organs["ball"].provenance)["image"]["series"], SECOND)
            with self.assertRaisesRegex(flipfree.FileError, "no series '9.9'"):
                flipfree.segment(folder, *seed, series="9.9")
        with self.assertRaisesRegex(TypeError, "^series: it chooses what is read of a folder"):
            flipfree.segment(ball.image, *seed, series=FIRST)
        self.assertNotIn("series", json.loads(flipfree.segment(ball.image, *seed, **small).provenance)["image"])

    def test_of_other_files_there_is_none(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "ball.nii.gz")
            flipfree.write_image(flipfree.phantom("sphere", dimensions=(8, 8, 8)).image, path)
            with self.assertRaisesRegex(flipfree.FileError, "ball.nii.gz' holds no DICOM series"):
                flipfree.read_image(path, series=FIRST)

    def test_what_is_left_out_is_a_warning(self):
        (self.folder / "page.dcm").write_text("<html>")
        with self.assertWarnsRegex(flipfree.FlipFreeWarning, "1 file is left out: 1 not DICOM"):
            flipfree.read_image(self.folder)

    def test_progress_can_stop_it(self):
        def stop(fraction):
            raise ZeroDivisionError(str(fraction))

        with self.assertRaises(ZeroDivisionError):
            flipfree.series(self.folder, progress=stop)

    def test_refusals(self):
        with self.assertRaisesRegex(flipfree.FileError, "is not a folder"):
            flipfree.series(self.folder / "a001")
        with self.assertRaisesRegex(flipfree.FileError, "holds no DICOM image"):
            flipfree.series(self.folder.parent / self.folder.name / "..")


if __name__ == "__main__":
    unittest.main()
