"""A folder of DICOM files: what is in it, and which series is read."""

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
