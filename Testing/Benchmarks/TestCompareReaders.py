"""What the comparison of readers says of a folder of images: what differs, and which files cannot be read."""

import gzip
import struct
import sys
import tempfile
import unittest
from pathlib import Path

import flipfree
import numpy

try:
    import nibabel
    import SimpleITK  # pylint: disable=unused-import

    import CompareReaders
except ImportError as error:
    print(f"Skipped: {error}")
    sys.exit(77)

# In a NIfTI header: a short, and three floats. With this code, ITK takes the qform.
SFORM_CODE, ALIGNED = 254, 2
QOFFSET = 268


def by_another(path, _series):
    """A reader that only knows one of the files, and has its first axis last, and brighter by 7."""
    if path.name != "plain.nii.gz":
        raise CompareReaders.Unknown
    own = CompareReaders.own_grid(flipfree.read_image(path))
    return CompareReaders.Grid(own.first, own.steps[:, [1, 2, 0]], own.voxels.transpose(1, 2, 0).astype(float) + 7)


class Table(unittest.TestCase):
    def test_says_how_much_differs(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            voxels = numpy.random.default_rng(1).integers(0, 9999, (6, 7, 8), dtype=numpy.int16)
            image = flipfree.image_from_array(voxels, spacing=(1, 2, 3), origin=(10, -20, 30))
            flipfree.write_image(image, folder / "plain.nii.gz")
            header = bytearray(gzip.decompress((folder / "plain.nii.gz").read_bytes()))
            struct.pack_into("<h", header, SFORM_CODE, ALIGNED)
            struct.pack_into("<f", header, QOFFSET, struct.unpack_from("<f", header, QOFFSET)[0] - 30)
            (folder / "moved.nii.gz").write_bytes(gzip.compress(header))
            (folder / "half.nii").write_bytes(header[:500])
            CompareReaders.READERS["types"] = by_another  # under the name of some module
            self.addCleanup(CompareReaders.READERS.pop, "types")
            rows = [line.strip("| ").split(" | ") for line in CompareReaders.table([folder], ["nibabel", "SimpleITK", "types"])]
        self.assertEqual(rows[0][2], f"nibabel {nibabel.__version__}")
        half, moved, plain, counts = rows[2:]
        self.assertRegex(half[1], "^refuses: The voxels of 'half.nii' cannot be read: .* truncated")
        self.assertRegex(half[2], "^cannot read: [A-Z]")  # SimpleITK reads more than there is
        self.assertEqual(half[4], "-")
        self.assertEqual(moved, ["moved.nii.gz", "8 x 7 x 6, warns", "same", "30 mm", "-"])
        self.assertEqual(plain, ["plain.nii.gz", "8 x 7 x 6", "same", "same", "10 values by up to 7"])
        self.assertEqual(counts[1:], ["2 read", "2 same, 0 differ, 0 cannot be read", "1 same, 1 differ, 0 cannot be read",
                                      "0 same, 1 differ, 0 cannot be read"])


if __name__ == "__main__":
    unittest.main()
