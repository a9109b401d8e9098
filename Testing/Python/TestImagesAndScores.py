"""Images from arrays and files and back, and flipfree.evaluate."""

import math
import tempfile
import unittest
from pathlib import Path

import flipfree
import numpy
from example import abdomen, axes_of, liver, needs_files, needs_vtk, needs_wheel, surface_of, truth

LIVER = flipfree.Organ.LIVER


class Arrays(unittest.TestCase):
    def test_round_trip_for_every_type(self):
        for name in ("bool", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64",
                     "float16", "float32", "float64", ">i2", ">f4"):
            with self.subTest(name):
                array = (numpy.arange(24).reshape(2, 3, 4) % 2).astype(name)
                back = flipfree.array_from_image(flipfree.image_from_array(array, (1, 2, 3)))
                numpy.testing.assert_array_equal(back, array)

    def test_what_is_masked_has_no_data(self):
        for name in ("int16", "uint8", "float32", "float64"):
            with self.subTest(name):
                voxels = numpy.arange(24).reshape(2, 3, 4).astype(name)
                masked = numpy.ma.array(voxels, mask=voxels % 5 == 0)
                back = flipfree.array_from_image(flipfree.image_from_array(masked, (1, 2, 3)))
                self.assertEqual(back.dtype, "float64" if name == "float64" else "float32")
                numpy.testing.assert_array_equal(numpy.isnan(back), masked.mask)
                numpy.testing.assert_array_equal(back[~masked.mask], voxels[~masked.mask])
                numpy.testing.assert_array_equal(voxels, numpy.arange(24).reshape(2, 3, 4))
                for nothing in (False, numpy.zeros(voxels.shape, bool)):
                    whole = numpy.ma.array(voxels, mask=nothing)
                    back = flipfree.array_from_image(flipfree.image_from_array(whole, (1, 2, 3)))
                    self.assertTrue(numpy.shares_memory(back, voxels))

    def test_what_is_masked_has_no_label(self):
        labels = flipfree.array_from_image(truth())
        other = numpy.where(labels == LIVER, labels, LIVER)
        masked = numpy.ma.array(other, mask=labels != LIVER)
        self.assertEqual(flipfree.evaluate(truth(), masked, segmentation_label=LIVER, reference_label=LIVER).dice, 1)

    @needs_vtk
    def test_geometry(self):
        image = flipfree.image_from_array(numpy.zeros((2, 3, 4)), (1, 2, 3), (4, 5, 6),
                                          [[0, 1, 0], [0, 0, 1], [1, 0, 0]])
        self.assertEqual(image.GetDimensions(), (4, 3, 2))
        self.assertEqual(image.GetSpacing(), (1, 2, 3))
        point = [0.0] * 3
        image.TransformIndexToPhysicalPoint([1, 0, 0], point)
        self.assertEqual(point, [4, 5, 7])

    @needs_vtk
    def test_memory_is_shared_and_outlives_the_array(self):
        array = numpy.arange(24.0).reshape(2, 3, 4)
        image = flipfree.image_from_array(array, (1, 1, 1))
        array[1, 2, 3] = -1
        self.assertTrue(numpy.shares_memory(flipfree.array_from_image(image), array))
        del array
        self.assertEqual(image.GetScalarRange(), (-1, 22))

    @needs_vtk
    def test_what_may_not_be_written_to_is_copied(self):
        array = numpy.arange(24.0).reshape(2, 3, 4)
        array.setflags(write=False)
        image = flipfree.image_from_array(array, (1, 1, 1))
        image.SetScalarComponentFromDouble(0, 0, 0, 0, 77)
        self.assertEqual(array[0, 0, 0], 0)

    def test_image_without_scalars(self):
        flat = flipfree.image_from_array(numpy.zeros((0, 3, 4)), (1, 1, 1))
        with self.assertRaisesRegex(ValueError, "^image: it has no (scalars|voxels)"):
            flipfree.array_from_image(flat)


@needs_wheel
class Images(unittest.TestCase):
    def test_geometry_and_memory_are_the_arrays(self):
        array = numpy.arange(24.0).reshape(2, 3, 4)
        image = flipfree.image_from_array(array, (1, 2, 3), (4, 5, 6), numpy.diag([1, -1, 1]))
        self.assertEqual((image.spacing, image.origin), ((1, 2, 3), (4, 5, 6)))
        self.assertEqual(axes_of(image)[1, 1], -1)
        self.assertTrue(numpy.shares_memory(image.voxels, array))
        self.assertTrue(numpy.shares_memory(numpy.asarray(image), array))
        self.assertEqual(repr(image), "<Image: 4 x 3 x 2 float64 voxels of 1 x 2 x 3 mm>")

    def test_arrays_that_may_not_be_written_to_are_read(self):
        array = numpy.array(flipfree.array_from_image(truth()))
        array.setflags(write=False)
        self.assertEqual(flipfree.evaluate(liver(), array, reference_label=LIVER),
                         flipfree.evaluate(liver(), truth(), reference_label=LIVER))


class Phantoms(unittest.TestCase):
    def test_have_their_organs_and_seeds(self):
        for shape, label in (("sphere", 1), ("vessel", 1), ("abdomen", LIVER)):
            phantom = flipfree.phantom(shape)
            labels = flipfree.array_from_image(phantom.label_map)
            spacing = (1.5, 1.5, 3) if shape == "abdomen" else (1, 1, 1)
            i, j, k = (numpy.array(phantom.seeds[label][0]) / spacing).round().astype(int)
            self.assertEqual(labels[k, j, i], label)

    def test_parameters(self):
        phantom = flipfree.phantom("cube", dimensions=(20, 30, 40), noise_standard_deviation=0, foreground=7)
        voxels = flipfree.array_from_image(phantom.image)
        self.assertEqual((voxels.shape, voxels.max()), ((40, 30, 20), 7))
        with self.assertRaisesRegex(ValueError, "^shape: 'star' does not exist"):
            flipfree.phantom("star")
        with self.assertRaisesRegex(TypeError, "no parameter 'noise'"):
            flipfree.phantom("cube", noise=3)
        with self.assertRaisesRegex(flipfree.FlipFreeError, "^No phantom: .*foreground"):
            flipfree.phantom("cube", foreground=1e6)

    @needs_vtk
    def test_labels_are_the_filters(self):
        for organ in flipfree.Organ:
            self.assertEqual(getattr(flipfree.vtkPhantomSource, organ.name), organ)


@needs_files
class Files(unittest.TestCase):
    def test_round_trip(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.nii.gz", "a.nrrd", "a.mha"):
                path = Path(folder) / name
                flipfree.write_image(liver().label_map, path)
                read = flipfree.read_image(path)
                self.assertEqual(read.GetSpacing(), liver().label_map.GetSpacing())
                numpy.testing.assert_array_equal(flipfree.array_from_image(read), liver().labels)


class Evaluation(unittest.TestCase):
    @needs_vtk
    def test_is_the_filters(self):
        metrics = flipfree.vtkSegmentationMetrics()
        metrics.SetInputDataObject(liver().surface)
        metrics.SetReferenceData(truth())
        metrics.SetReferenceLabel(LIVER)
        metrics.Update()
        scores = flipfree.evaluate(liver(), truth(), reference_label=LIVER)
        for name, value in vars(scores).items():
            getter = "".join(word.capitalize() for word in name.split("_"))
            for short in ("asd", "rms", "hd95", "hd"):
                getter = short.upper() if name == short else getter
            self.assertEqual(value, getattr(metrics, "Get" + getter)(), name)
        row = metrics.GetOutput()
        self.assertEqual([row.GetColumnName(i).lower() for i in range(row.GetNumberOfColumns())],
                         [name.replace("_", "") for name in vars(scores)])
        self.assertAlmostEqual(scores.dice, 0.914, delta=0.005)

    def test_takes_arrays(self):
        reference = numpy.uint8(flipfree.array_from_image(truth()) == LIVER)
        expected = flipfree.evaluate(liver().label_map, truth(), reference_label=LIVER)
        scores = flipfree.evaluate(liver().labels, truth(), reference_label=LIVER)
        self.assertEqual(scores, expected)
        self.assertEqual(flipfree.evaluate(liver().label_map, reference), expected)
        self.assertEqual(flipfree.evaluate(liver(), reference).dice, expected.dice)

    @needs_files
    def test_takes_files(self):
        reference = numpy.uint8(flipfree.array_from_image(truth()) == LIVER)
        expected = flipfree.evaluate(liver().label_map, reference)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "liver.nii.gz"
            flipfree.write_image(liver().label_map, path)
            scores = flipfree.evaluate(path, reference)
            self.assertTrue(math.isclose(scores.asd, expected.asd, rel_tol=1e-5))
            self.assertEqual(scores.dice, expected.dice)

    def test_says_which_labels_there_are(self):
        with self.assertWarnsRegex(flipfree.FlipFreeWarning, r"^The reference has the labels 1, 2, .*reference_label\.$"):
            flipfree.evaluate(liver(), truth())
        with self.assertRaisesRegex(flipfree.EvaluationError, r"label 99; set reference_label to one of 1, 2, "):
            flipfree.evaluate(liver(), truth(), reference_label=99)

    def test_refuses_gray_values_as_labels(self):
        for reference in (abdomen().image, flipfree.array_from_image(truth()) / 2):
            for label in ({}, {"reference_label": 1}):
                with self.assertRaisesRegex(flipfree.EvaluationError, "the reference is not a label map; it contains .* give it"):
                    flipfree.evaluate(liver(), reference, **label)

    def test_takes_surfaces(self):
        expected = flipfree.evaluate(liver().label_map, truth(), reference_label=LIVER)
        self.assertEqual(flipfree.evaluate(surface_of(liver()), truth(), reference_label=LIVER,
                                           score_voxelization=True).asd, expected.asd)


if __name__ == "__main__":
    unittest.main()
