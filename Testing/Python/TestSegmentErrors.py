"""What goes wrong is an exception with VTK's message, or a warning, and nothing is printed."""

import math
import os
import pickle
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings
from pathlib import Path

import flipfree
import numpy
from example import RADIUS, SEED, image, liver, needs_files, start_python, truth
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData


class Failures(unittest.TestCase):
    def refuse(self, error, message, *arguments, **parameters):
        with self.assertRaisesRegex(error, message):
            flipfree.segment(*arguments, **parameters)

    def test_seed_outside(self):
        self.refuse(flipfree.SegmentationError,
                    r"^No segmentation: the seed's center \(-50, 0, 0\) mm lies outside .*\.$",
                    image(), (-50, 0, 0), RADIUS)

    def test_empty_image(self):
        self.refuse(flipfree.SegmentationError, ".", vtkImageData(), SEED, RADIUS)
        self.refuse(flipfree.SegmentationError, ".", numpy.zeros((0, 3, 3)), SEED, RADIUS,
                    spacing=(1, 1, 1))

    def test_start_that_will_not_do(self):
        self.refuse(flipfree.SegmentationError, "the start surface ", image(), SEED, RADIUS,
                    start=vtkPolyData())
        self.refuse(TypeError, "^start: a vtkPolyData", image(), SEED, RADIUS, start="sphere")

    def test_parameters(self):
        for error, message, parameters in (
                (TypeError, "no parameter 'resolutoin'; did you mean 'resolution'",
                 {"resolutoin": 8}),
                (TypeError, "no parameter 'x'; help", {"x": 8}),
                (ValueError, "^levels: 99 is out of range; the nearest is 6$", {"levels": 99}),
                (TypeError, "^levels: 2.5 will not do; integer", {"levels": 2.5}),
                (TypeError, "^levels: 'two' will not do", {"levels": "two"}),
                (TypeError, "^guard: True or False is needed, not 'no'$", {"guard": "no"}),
                (TypeError, "^start_center_offset: 3 will not do", {"start_center_offset": 3}),
                (flipfree.SegmentationError, "change_tolerance is not a number",
                 {"change_tolerance": float("nan")}),
                (ValueError, "^preset: 'fast' does not exist; there are d", {"preset": "fast"}),
                (TypeError, "^progress: a function", {"progress": 5})):
            with self.subTest(parameters):
                self.refuse(error, message, image(), SEED, RADIUS, **parameters)

    def test_seed_and_radius(self):
        self.refuse(ValueError, "^seed: 3 numbers are needed, not 2$", image(), (1, 2), RADIUS)
        self.refuse(TypeError, "^seed: 3 numbers are needed, not 5$", image(), 5, RADIUS)
        self.refuse(TypeError, "^radius: a number is needed, not", image(), SEED, "wide")
        self.refuse(ValueError, "^radius: -1.0 is out of range", image(), SEED, -1)
        self.refuse(ValueError, "^radius: 1000000000.0 is out of range", image(), SEED, 1e9)

    def test_images(self):
        array = flipfree.array_from_image(image())
        self.refuse(TypeError, "^spacing: an array needs it", array, SEED, RADIUS)
        self.refuse(ValueError, "^array: 3 axes", array[0], SEED, RADIUS, spacing=(1, 1, 1))
        self.refuse(TypeError, "^array: voxels of type complex128", array * 1j, SEED, RADIUS,
                    spacing=(1, 1, 1))
        self.refuse(ValueError, "^direction: 9 numbers are needed, not 3", array, SEED, RADIUS,
                    spacing=(1, 1, 1), direction=(1, 1, 1))
        self.refuse(TypeError, "belong to arrays", image(), SEED, RADIUS, spacing=(1, 1, 1))
        self.refuse(TypeError, "^image: a vtkImageData, an array or the name", None, SEED, RADIUS)

    @needs_files
    def test_files(self):
        self.refuse(flipfree.FileError, "'nowhere.nii' does not exist", "nowhere.nii", SEED, RADIUS)
        with self.assertRaises(OSError):
            flipfree.read_image("nowhere.nii")
        with tempfile.TemporaryDirectory() as folder:
            self.refuse(flipfree.FileError, "no DICOM image", Path(folder), SEED, RADIUS)
            with self.assertRaisesRegex(flipfree.FileError, r"'\.jpg'|jpg"):
                flipfree.write_image(image(), Path(folder) / "abdomen.jpg")
            for no_image in (None, liver().labels):
                with self.assertRaisesRegex(TypeError, "^image: a vtkImageData is needed, not"):
                    flipfree.write_image(no_image, Path(folder) / "abdomen.nii")
            self.assertEqual(list(Path(folder).iterdir()), [])

    def test_evaluation(self):
        empty = numpy.zeros_like(liver().labels)
        with self.assertRaisesRegex(flipfree.EvaluationError, "empty"):
            flipfree.evaluate(liver(), empty)
        with self.assertRaises(flipfree.EvaluationError):
            flipfree.evaluate(liver(), empty[:5])
        with self.assertRaisesRegex(TypeError, "did you mean 'reference_label'"):
            flipfree.evaluate(liver(), truth(), reference_labels=6)
        with self.assertRaisesRegex(TypeError, "^reference: an array without a geometry"):
            flipfree.evaluate(liver().surface, empty)
        with self.assertRaisesRegex(TypeError, "^segmentation: a label map"):
            flipfree.evaluate(None, truth())

    def test_where_vtks_warnings_are_switched_off(self):
        vtkObject.GlobalWarningDisplayOff()
        self.addCleanup(vtkObject.GlobalWarningDisplayOn)
        self.refuse(flipfree.SegmentationError, "outside", image(), (-50, 0, 0), RADIUS)
        self.assertEqual(vtkObject.GetGlobalWarningDisplay(), 0)

    def test_in_another_thread(self):
        caught = []

        def run():
            try:
                flipfree.segment(image(), (-50, 0, 0), RADIUS)
            except flipfree.SegmentationError as error:
                caught.append(str(error))

        thread = threading.Thread(target=run)
        thread.start()
        thread.join()
        self.assertIn("outside", caught[0])

    def test_exceptions_can_be_pickled(self):
        for name in ("SegmentationError", "EvaluationError", "FileError"):
            error = pickle.loads(pickle.dumps(getattr(flipfree, name)("why")))
            self.assertIsInstance(error, flipfree.FlipFreeError)
            self.assertEqual((type(error).__name__, str(error)), (name, "why"))


class Warnings(unittest.TestCase):
    def test_points_to_the_callers_line(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            flipfree.segment(image(), SEED, RADIUS, reach=30)
        self.assertEqual([warning.category for warning in caught], [flipfree.FlipFreeWarning])
        self.assertRegex(str(caught[0].message), r"^The surface has got to the end.*raise reach where the organ is that large\.$")
        self.assertEqual(caught[0].filename, __file__)

    def test_names_what_the_caller_wrote(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            flipfree.segment(image(), SEED, 500, maximum_iterations=0)
        self.assertRegex(str(caught[0].message), r"lower radius or move seed\.$")
        for keywords, words in (({"radius": 1e-5}, "seed's radius of 1e-05 mm is below a voxel of the image ("),
                                ({"search_distance": math.nan}, "the property search_distance is not a number")):
            with self.subTest(keywords), self.assertRaises(flipfree.SegmentationError) as caught:
                flipfree.segment(image(), **{"seed": SEED, "radius": RADIUS, **keywords})
            self.assertIn(words, str(caught.exception))

    def test_can_be_an_error(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(flipfree.FlipFreeWarning):
                flipfree.segment(image(), SEED, RADIUS, reach=30)


class OtherVTK(unittest.TestCase):
    def test_is_refused_before_it_crashes(self):
        with tempfile.TemporaryDirectory() as folder:
            package = Path(folder, "vtkmodules")
            package.mkdir()
            for module in ("__init__", "vtkCommonDataModel", "vtkCommonExecutionModel"):
                (package / f"{module}.py").touch()
            (package / "vtkCommonCore.py").write_text(
                "class vtkVersion:\n    GetVTKVersion = staticmethod(lambda: '9.99.1')\n")
            paths = [folder, str(Path(flipfree.__file__).parent.parent)]
            program = subprocess.run([sys.executable, "-c", "import flipfree"], capture_output=True,
                                     text=True, env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)})
        self.assertEqual(program.returncode, 1)
        self.assertRegex(program.stderr, r"ImportError: flipfree works with the vtkmodules package of VTK "
                                         r"9\.1.*vtkmodules is of VTK 9\.99\.1")


class Printed(unittest.TestCase):
    def test_nothing_by_vtk_or_itk(self):
        program = start_python("""
import tempfile, pathlib, warnings
warnings.simplefilter("ignore")
flipfree.segment(image(), SEED, RADIUS, reach=30)
broken = pathlib.Path(tempfile.mkdtemp()) / "broken.nii"
broken.write_bytes(b"nothing of the kind")
def stop(fraction):
    raise ZeroDivisionError
for image, seed, options in ((image(), (-50, 0, 0), {}), (image(), SEED, {"progress": stop}),
                             (broken, SEED, {})):
    try:
        flipfree.segment(image, seed, RADIUS, **options)
    except (flipfree.FlipFreeError, ZeroDivisionError) as error:
        print(type(error).__name__)
broken.unlink()
broken.parent.rmdir()
""")
        output, errors = program.communicate(timeout=120)
        self.assertEqual(errors, "")
        self.assertEqual(output, "SegmentationError\nZeroDivisionError\nFileError\n")


if __name__ == "__main__":
    unittest.main()
