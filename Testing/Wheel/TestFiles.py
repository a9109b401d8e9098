"""Files, and images of SimpleITK and nibabel: every voxel is where the toolkit's own reader has it."""

import gzip
import itertools
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import flipfree
import numpy

try:
    import nibabel
    import SimpleITK
except ImportError:
    print("Skipped: SimpleITK and nibabel are not installed.")
    sys.exit(77)

SPACING, ORIGIN = (0.8, 1.25, 3.0), (-19.5, 25.0, 100.25)

READ_BY_VTK = """
import json, sys
import flipfree
for path in sys.argv[1:]:
    image = flipfree.read_image(path)
    matrix = image.GetDirectionMatrix()
    print(json.dumps({
        "spacing": image.GetSpacing(), "origin": image.GetOrigin(),
        "direction": [matrix.GetElement(row, column) for row in range(3) for column in range(3)],
        "voxels": flipfree.array_from_image(image).tolist()}))
"""


def turned(angle, axis):
    """A rotation about a coordinate axis."""
    matrix = numpy.eye(3)
    a, b = (axis + 1) % 3, (axis + 2) % 3
    matrix[a, a] = matrix[b, b] = numpy.cos(angle)
    matrix[a, b], matrix[b, a] = -numpy.sin(angle), numpy.sin(angle)
    return matrix


OBLIQUE = turned(0.3, 0) @ turned(-0.7, 1) @ turned(1.1, 2)
DIRECTIONS = {
    "identity": numpy.eye(3),
    "oblique": OBLIQUE,
    "left-handed": OBLIQUE @ numpy.diag([1, 1, -1]),
    "permuted": numpy.array([[0, 0, 1], [1, 0, 0], [0, 1, 0.0]]),
}


def example(direction):
    voxels = numpy.random.default_rng(5).integers(-1000, 1000, (4, 5, 6)).astype(numpy.int16)
    return flipfree.image_from_array(voxels, SPACING, ORIGIN, direction)


def read_by_vtk(*paths):
    """What the toolkit's reader makes of files."""
    process = subprocess.run([os.environ["FLIPFREE_VTK_PYTHON"], "-c", READ_BY_VTK, *map(str, paths)], text=True,
                             env={**os.environ, "PYTHONPATH": os.environ["FLIPFREE_VTK_PACKAGE"]},
                             stdout=subprocess.PIPE, check=True, timeout=120)
    return [json.loads(line) for line in process.stdout.splitlines()]


class FileTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def assert_same(self, image, other, tolerance=1e-5):
        if isinstance(other, flipfree.Image):
            other = {name: getattr(other, name) for name in ("spacing", "origin", "direction", "voxels")}
        for name in ("spacing", "origin", "direction"):
            numpy.testing.assert_allclose(getattr(image, name), other[name], atol=tolerance, err_msg=name)
        numpy.testing.assert_array_equal(image.voxels, other["voxels"])


class Files(FileTest):
    def test_every_format_and_direction(self):
        paths, images = [], []
        for (name, direction), ending in itertools.product(DIRECTIONS.items(), (".nii.gz", ".nii", ".nrrd", ".mha")):
            path = self.folder / f"{name}{ending}"
            flipfree.write_image(example(direction), path)
            image = flipfree.read_image(path)
            with self.subTest(path.name):
                self.assertEqual(image.voxels.dtype, numpy.int16)
                self.assert_same(image, example(direction))
            paths.append(path)
            images.append(image)
        for path, image, other in zip(paths, images, read_by_vtk(*paths)):
            with self.subTest("by the toolkit's reader", path=path.name):
                self.assert_same(image, other)
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(path.name for path in paths))

    def write_series(self, direction, shear=0.0, without=(), compressed=""):
        """Slices as a scanner stores them; with a tilted gantry, each one is shifted along its rows."""
        image = example(direction)
        axes = numpy.reshape(direction, (3, 3))
        for k, plane in enumerate(image.voxels):
            if k in without:
                continue
            written = SimpleITK.GetImageFromArray(plane[None])
            written.SetSpacing(SPACING)
            written.SetDirection(axes.ravel())
            place = numpy.array(ORIGIN) + k * (SPACING[2] * axes[:, 2] + shear * axes[:, 1])
            written.SetOrigin(place)
            tags = {"0008|0060": "CT", "0020|000e": "1.2.3", "0020|000d": "1.2", "0008|0018": f"1.2.3.{k + 1}",
                    "0008|0016": "1.2.840.10008.5.1.4.1.1.2", "0020|0013": str(k + 1),
                    "0020|0032": "\\".join(f"{x:.8f}" for x in place),
                    "0020|0037": "\\".join(f"{x:.8f}" for x in axes[:, :2].T.ravel())}
            for tag, value in tags.items():
                written.SetMetaData(tag, value)
            writer = SimpleITK.ImageFileWriter()
            writer.KeepOriginalImageUIDOn()
            if compressed:
                writer.UseCompressionOn()
                writer.SetCompressor(compressed)
            writer.SetFileName(str(self.folder / f"{k}.dcm"))
            writer.Execute(written)
        return image

    def test_dicom(self):
        for name, shear in (("oblique", 0.0), ("oblique", 0.9)):
            with self.subTest(name, shear=shear):
                image = self.write_series(DIRECTIONS[name], shear)
                read = flipfree.read_image(self.folder)
                numpy.testing.assert_array_equal(read.voxels, image.voxels)
                self.assert_same(read, read_by_vtk(self.folder)[0])
                self.assert_same(flipfree.read_image(self.folder, series="1.2.3"), read)
        with self.assertRaisesRegex(flipfree.FileError, "holds no series '9'. It holds 1.2.3"):
            flipfree.read_image(self.folder, series="9")

    def test_dicom_with_a_slice_missing(self):
        self.write_series(numpy.eye(3), without=(2,))
        with self.assertRaisesRegex(flipfree.FileError, "1 slice is missing, at least between '1.dcm' and '3.dcm'"):
            flipfree.read_image(self.folder)

    def test_compressed_dicom(self):
        """SimpleITK decodes the pixels alone."""
        self.write_series(DIRECTIONS["oblique"])
        plain = flipfree.read_image(self.folder)
        size = (self.folder / "0.dcm").stat().st_size
        self.write_series(DIRECTIONS["oblique"], compressed="JPEG")
        self.assertNotEqual((self.folder / "0.dcm").stat().st_size, size)
        self.assert_same(flipfree.read_image(self.folder), plain)

    def test_what_is_wrong_is_said(self):
        (self.folder / "text.nii.gz").write_text("no volume")
        (self.folder / "text.nrrd").write_text("NRRD0004\nno volume")
        (self.folder / "empty").mkdir()
        SimpleITK.WriteImage(SimpleITK.Image([4, 4], SimpleITK.sitkInt16), str(self.folder / "flat.mha"))
        for name, message in (("text.nii.gz", "does not begin as its file extension requires"), ("text.nrrd", "not valid NRRD"),
                              ("empty", "holds no DICOM image"), ("flat.mha", "of 2 dimensions"),
                              ("nowhere.nii", "does not exist"), (".", "holds no DICOM image")):
            with self.subTest(name), self.assertRaisesRegex(flipfree.FileError, message):
                flipfree.read_image(self.folder / name)
        (self.folder / "ct.jpg").write_text("")
        with self.assertRaisesRegex(flipfree.FileError, r"unknown. Known are NIfTI"):
            flipfree.read_image(self.folder / "ct.jpg")
        with self.assertRaisesRegex(flipfree.FileError, "cannot be written: there is no folder .*Create it first"):
            flipfree.write_image(example(OBLIQUE), self.folder / "nowhere" / "a.nii")

    def test_damaged_files_are_refused(self):
        """None is read with zeros in place of what is missing."""
        voxels = numpy.random.default_rng(0).integers(0, 1000, (20, 30, 40)).astype(numpy.int16)
        image = SimpleITK.GetImageFromArray(voxels)
        data_of = {"packed.mhd": "packed.zraw", "plain.mhd": "plain.raw", "packed.nhdr": "packed.raw.gz"}
        for stem, packs in (("packed", True), ("plain", False)):
            for ending in (".nii.gz", ".nii", ".mha", ".mhd", ".nrrd", ".nhdr")[0 if packs else 1:]:
                SimpleITK.WriteImage(image, str(self.folder / (stem + ending)), useCompression=packs)
        scaled = nibabel.Nifti1Image(voxels, numpy.eye(4))
        scaled.header.set_slope_inter(0.5, 3)  # of another type in memory than in the file
        nibabel.save(scaled, self.folder / "plain.scaled.nii")
        heads = sorted(path for path in self.folder.iterdir()
                       if path.suffix in (".nii", ".gz", ".mha", ".mhd", ".nrrd", ".nhdr") and ".raw" not in path.suffixes)
        self.assertGreater(len(heads), 10)
        for head in heads:
            flipfree.read_image(head)
            data = self.folder / data_of.get(head.name, head.name)
            whole = data.read_bytes()
            damaged = {"cut": whole[:int(0.6 * len(whole))], "ends early": whole[:-20]}
            # What is not compressed has no checksum; SimpleITK packs no plain .nii.
            if head.name.startswith("packed") and head.name != "packed.nii":
                middle = len(whole) // 2
                damaged["overwritten"] = whole[:middle] + bytes(200) + whole[middle + 200:]
            for damage, content in damaged.items():
                data.write_bytes(content)
                with self.subTest(head.name, damage=damage), self.assertRaisesRegex(
                        flipfree.FileError, "truncated or damaged|truncated, damaged|the file is damaged"):
                    flipfree.read_image(head)
            data.write_bytes(whole)
        # A stream that is whole, but too short.
        whole = gzip.decompress((self.folder / "packed.nii.gz").read_bytes())
        (self.folder / "short.nii.gz").write_bytes(gzip.compress(whole[:-2000]))
        with self.assertRaisesRegex(flipfree.FileError, "fewer voxels than its header says"):
            flipfree.read_image(self.folder / "short.nii.gz")
        half = len(whole) // 2
        (self.folder / "members.nii.gz").write_bytes(gzip.compress(whole[:half]) + gzip.compress(whole[half:]))
        flipfree.read_image(self.folder / "members.nii.gz")

    def test_padding_behind_a_compressed_file(self):
        image = example(OBLIQUE)
        flipfree.write_image(image, self.folder / "plain.nii.gz")
        packed = (self.folder / "plain.nii.gz").read_bytes()
        for padding in (bytes(1000), b"junk", b"\x1f"):
            (self.folder / "padded.nii.gz").write_bytes(packed + padding)
            with self.subTest(padding=padding[:4]):
                self.assert_same(flipfree.read_image(self.folder / "padded.nii.gz"), image)

    def write_nrrd(self, name, fields, voxels=bytes(120)):
        path = self.folder / name
        path.write_bytes(b"NRRD0005\ntype: uint8\ndimension: 3\nsizes: 4 5 6\nencoding: raw\nspace: LPS\n"
                         b"space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n" + fields + b"\n\n" + voxels)
        return path

    def test_text_in_any_encoding(self):
        path = self.write_nrrd("latin.nrrd", b"name:=caf\xe9")
        self.assertEqual(flipfree.read_image(path).voxels.shape, (6, 5, 4))
        path = self.write_nrrd("latin.nhdr", b"data file: caf\xe9.raw", b"")
        with self.assertRaisesRegex(flipfree.FileError, "There is no file '.*caf\xe9.raw', which has the voxels"):
            flipfree.read_image(path)
        (self.folder / os.fsdecode(b"caf\xe9.raw")).write_bytes(bytes(120))
        self.assertEqual(flipfree.read_image(path).voxels.shape, (6, 5, 4))

    def test_lines_before_the_voxels_are_not_compressed(self):
        voxels = bytes(range(120))
        path = self.write_nrrd("lines.nrrd", b"line skip: 2\nbyte skip: 3", b"one\ntwo\nabc" + voxels)
        self.assertEqual(flipfree.read_image(path).voxels.tobytes(), voxels)
        packed = path.read_bytes().replace(b"raw", b"gzip").partition(b"one")[0]
        path.write_bytes(packed + b"one\ntwo\n" + gzip.compress(b"abc" + voxels))
        self.assertEqual(flipfree.read_image(path).voxels.tobytes(), voxels)

    def test_more_lines_than_there_are(self):
        path = self.write_nrrd("lines.nrrd", b"line skip: 2000000000")
        with self.assertRaisesRegex(flipfree.FileError, "fewer voxels"):
            flipfree.read_image(path)

    def test_simpleitk_may_be_missing(self):
        program = ("import sys; sys.modules['SimpleITK'] = None; import flipfree\n"
                   "try: flipfree.read_image('.')\nexcept flipfree.FileError as error: print(error)")
        self.write_series(numpy.eye(3), compressed="JPEG")
        output = subprocess.run([sys.executable, "-c", program], cwd=self.folder, capture_output=True, text=True, check=True).stdout
        self.assertRegex(output, r"^'\.': compressed DICOM needs SimpleITK, which is not installed: pip install '\.\[io\]' in FlipFree's source "
                                 r"folder, or pip install SimpleITK; or give an array")

    def test_simpleitk_may_be_missing_to_write(self):
        program = ("import sys; sys.modules['SimpleITK'] = None; import flipfree\n"
                   "try: flipfree.write_image(flipfree.phantom('sphere').image, 'a.mha')\n"
                   "except flipfree.FileError as error: print(error)")
        output = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
        self.assertRegex(output, r"^'a\.mha': an image file needs SimpleITK.*or pip install SimpleITK\n$")


class SaysOfItself(FileTest):
    """What a file says twice, or not at all; places by nibabel, which reads headers by code of its own."""

    def read(self, name, warns=None):
        if warns is None:
            return flipfree.read_image(self.folder / name)
        with self.assertWarnsRegex(flipfree.FlipFreeWarning, warns):
            return flipfree.read_image(self.folder / name)

    def assert_as_nibabel(self, name, warns=None):
        image, other = self.read(name, warns), nibabel.load(self.folder / name)
        index = numpy.array([[i, j, k, 1] for i in (0, 5) for j in (0, 4) for k in (0, 3)]).T
        places = (numpy.diag([-1, -1, 1, 1]) @ other.affine @ index)[:3]
        own = numpy.array(image.origin)[:, None] + image.steps @ index[:3]
        self.assertLess(numpy.abs(own - places).max(), 1e-3)
        numpy.testing.assert_array_equal(image.voxels, numpy.asanyarray(other.dataobj).T)
        return image

    def save(self, name, sform=None, qform=None, codes=(1, 1), **fields):
        """A file of 6 x 5 x 4 voxels; by default both orientations are the same."""
        affine = numpy.diag([-2.0, -1.5, 3, 1])
        affine[:3, 3] = 40, 150, 300
        image = nibabel.Nifti1Image(numpy.arange(120, dtype=numpy.int16).reshape(6, 5, 4), affine)
        image.set_qform(affine if qform is None else qform, codes[0])
        image.set_sform(affine if sform is None else sform, codes[1])
        image.header.set_xyzt_units("mm", "sec")
        for field, value in fields.items():
            image.header[field] = value
        nibabel.save(image, self.folder / name)
        return affine

    def test_sheared(self):
        affine = self.save("plain.nii.gz")
        sheared = affine @ numpy.array([[1, 0, 0.1, 0], [0, 1, -0.4, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
        self.save("sheared.nii.gz", sform=sheared)
        image = self.assert_as_nibabel("sheared.nii.gz", "up to .* mm apart. The sform was taken")
        flipfree.write_image(image, self.folder / "again.nii.gz")
        self.assert_as_nibabel("again.nii.gz")
        header = nibabel.load(self.folder / "again.nii.gz").header
        self.assertEqual((header["qform_code"], header["sform_code"]), (0, 1))
        flipfree.write_image(flipfree.read_image(self.folder / "plain.nii.gz"), self.folder / "again.nii.gz")
        header = nibabel.load(self.folder / "again.nii.gz").header
        self.assertEqual((header["qform_code"], header["sform_code"]), (1, 1))

    def test_twice(self):
        moved = self.save("plain.nii")
        moved[0, 3] += 30
        self.save("moved.nii", sform=moved, codes=(1, 2))
        self.assert_as_nibabel("moved.nii", "The sform was taken")
        self.save("qform.nii", sform=moved, codes=(1, 0))
        self.assert_as_nibabel("qform.nii")

    def test_not_at_all(self):
        self.save("nowhere.nii", codes=(0, 0))
        self.read("nowhere.nii", "neither a qform nor an sform")

    def test_no_number(self):
        image = flipfree.image_from_array(numpy.full((4, 5, 6), numpy.nan, numpy.float32), SPACING, ORIGIN)
        flipfree.write_image(image, self.folder / "nan.nii.gz")
        self.assertTrue(numpy.isnan(flipfree.read_image(self.folder / "nan.nii.gz").voxels).all())

    def test_second_version(self):
        affine = numpy.diag([-2.0, -1.5, 3, 1])
        image = nibabel.Nifti2Image(numpy.arange(120, dtype=numpy.float32).reshape(6, 5, 4), affine)
        nibabel.save(image, self.folder / "two.nii.gz")
        self.assert_as_nibabel("two.nii.gz")

    def test_scaled(self):
        image = nibabel.Nifti1Image(numpy.arange(120, dtype=numpy.int16).reshape(6, 5, 4), numpy.diag([2.0, 2, 3, 1]))
        image.header.set_slope_inter(0.5, -3)
        nibabel.save(image, self.folder / "scaled.nii")
        self.assertEqual(self.assert_as_nibabel("scaled.nii").voxels.dtype, numpy.float32)


class OtherImages(FileTest):
    def test_simpleitk(self):
        """Scores of a label map of its own against SimpleITK's are perfect only if both are in one place."""
        for name, direction in DIRECTIONS.items():
            image = SimpleITK.GetImageFromArray(example(direction).voxels)
            image.SetSpacing(SPACING)
            image.SetOrigin(ORIGIN)
            image.SetDirection(numpy.ravel(direction))
            with self.subTest(name):
                self.assert_same(adopted(image), example(direction))

    def test_nibabel(self):
        """Its affine is in RAS; the toolkit's reader says where the voxels of its files are in LPS."""
        paths, images = [], []
        for name, direction in DIRECTIONS.items():
            image = example(direction)
            affine = numpy.eye(4)
            affine[:3, :3] = direction * numpy.array(SPACING)
            affine[:3, 3] = ORIGIN
            affine = numpy.diag([-1, -1, 1, 1]) @ affine
            paths.append(self.folder / f"{name}.nii.gz")
            nibabel.save(nibabel.Nifti1Image(numpy.ascontiguousarray(image.voxels.T), affine), paths[-1])
            images.append(adopted(nibabel.load(paths[-1])))
            with self.subTest(name):
                self.assert_same(images[-1], image)
        for path, image, other in zip(paths, images, read_by_vtk(*paths)):
            with self.subTest("by the toolkit's reader", path=path.name):
                self.assert_same(image, other)

    def test_micrometers(self):
        image = nibabel.Nifti1Image(numpy.zeros((3, 4, 5), numpy.int16), numpy.diag([500.0, 700, 900, 1]))
        image.header.set_xyzt_units("micron")
        path = self.folder / "small.nii"
        nibabel.save(image, path)
        self.assert_same(adopted(nibabel.load(path)), read_by_vtk(path)[0])

    def test_are_refused_by_name(self):
        wrong = nibabel.spatialimages.SpatialImage(numpy.zeros((3, 4, 5), numpy.int16), numpy.diag([1.0, 1, 0, 1]))
        series = nibabel.Nifti1Image(numpy.zeros((3, 4, 5, 2), numpy.int16), numpy.eye(4))
        vector = SimpleITK.Image([3, 3, 3], SimpleITK.sitkVectorUInt8, 3)
        for image, message in ((wrong, "^image: its affine cannot be inverted"), (series, r"of shape \(3, 4, 5, 2\)"),
                               (vector, "3 dimensions and 3 components")):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                flipfree.segment(image, (1, 1, 1), 1)

    def test_organ_is_found_where_it_is(self):
        """A segmentation of the same organ, turned in space, is the same in its voxels."""
        ball = flipfree.phantom("sphere", dimensions=(40, 40, 40), spacing=(1, 1, 1.5))
        center, radius = ball.seeds[1]
        index = (numpy.array(center) - ball.image.origin) / ball.image.spacing
        direction = DIRECTIONS["left-handed"]
        seed = numpy.array(ORIGIN) + direction @ (index * ball.image.spacing)
        image = SimpleITK.GetImageFromArray(ball.image.voxels)
        image.SetSpacing(ball.image.spacing)
        image.SetOrigin(ORIGIN)
        image.SetDirection(direction.ravel())
        path = str(self.folder / "ball.nii")
        SimpleITK.WriteImage(image, path)
        truth = SimpleITK.GetImageFromArray(ball.label_map.voxels)
        truth.CopyInformation(image)
        found = [flipfree.segment(given, seed, radius, resolution=16) for given in (image, nibabel.load(path), path)]
        for organ in found:
            self.assertGreater(flipfree.evaluate(organ, truth).dice, 0.95)
            self.assertLess(numpy.abs(organ.points - found[0].points).max(), 0.05)


def adopted(image):
    """As segment() takes it."""
    from flipfree._foreign import adopted as adopt

    return adopt("image", image)


if __name__ == "__main__":
    unittest.main()
