"""What goes wrong is an exception with the message from below, or a warning, and nothing is printed."""

import dataclasses
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
from flipfree import _boundary_found
from example import (HAS_VTK, RADIUS, SEED, SPACING, image, liver, needs_files, needs_vtk, start_python, surface_of,
                     truth)

if HAS_VTK:
    from vtkmodules.vtkCommonCore import vtkObject
    from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData


class Failures(unittest.TestCase):
    def refuse(self, error, message, *arguments, **parameters):
        with self.subTest(parameters or message), self.assertRaisesRegex(error, message):
            flipfree.segment(*(arguments or (image(), SEED, RADIUS)), **parameters)

    def test_parameters(self):
        for error, message, parameters in (
                (TypeError, "no parameter 'resolutoin'; did you mean 'resolution'",
                 {"resolutoin": 8}),
                (TypeError, "no parameter 'x'; help", {"x": 8}),
                (ValueError, "^levels: 99 is out of range; give 1 to 6$", {"levels": 99}),
                (ValueError, "^fairing: 2 is out of range; give 0 to 1$", {"fairing": 2}),
                (TypeError, "^levels: a whole number is needed, not 2.5$", {"levels": 2.5}),
                (TypeError, "^levels: a whole number is needed, not 'two'$", {"levels": "two"}),
                (TypeError, "^fairing: a number is needed, not '0.5'$", {"fairing": "0.5"}),
                (TypeError, "^fairing: a number is needed, not None$", {"fairing": None}),
                (TypeError, "^guard: True or False is needed, not 'no'$", {"guard": "no"}),
                (TypeError, "^start_center_offset: 3 is not accepted", {"start_center_offset": 3}),
                (flipfree.SegmentationError, "change_tolerance is not a number", {"change_tolerance": math.nan}),
                (flipfree.SegmentationError, "search_distance is not a number", {"search_distance": math.nan}),
                (flipfree.SegmentationError, "opening_scale is not a number", {"opening_scale": math.nan}),
                (ValueError, "^preset: 'fast' does not exist; there are d", {"preset": "fast"}),
                (TypeError, "^progress: a function", {"progress": 5}),
                (TypeError, "^start: a (vtkPolyData|flipfree.Surface) or a Seg", {"start": "sphere"})):
            self.refuse(error, message, **parameters)

    @needs_vtk
    def test_a_filter_that_has_failed_fails_until_it_changes(self):
        sphere = flipfree.vtkQuadSphereSource()
        sphere.SetCenter(0, 0, math.nan)
        for words in ("Center", "vtkQuadSphereSource failed in an earlier update and has not run again: .*call Modified"):
            with self.assertRaisesRegex(flipfree.FlipFreeError, words):
                flipfree.update(sphere)
        sphere.Modified()
        with self.assertRaisesRegex(flipfree.FlipFreeError, "Center"):
            flipfree.update(sphere)
        sphere.SetCenter(0, 0, 0)
        flipfree.update(sphere)
        self.assertGreater(sphere.GetOutput().GetNumberOfPoints(), 0)

    @needs_vtk
    def test_empty_objects_of_vtk(self):
        self.refuse(flipfree.SegmentationError, "the start surface ", start=vtkPolyData())
        self.refuse(flipfree.SegmentationError, ".", vtkImageData(), SEED, RADIUS)

    def test_seeds_and_points_without_data(self):
        array = flipfree.array_from_image(image())
        for bad in (math.nan, math.inf, 1e300):
            voxels = array.astype(float)
            voxels[28, 28, 33] = bad
            self.refuse(flipfree.SegmentationError,
                        r"the seed sphere touches a voxel without data \(not a finite number\), at \(99, 84, 168\) mm",
                        voxels, SEED, RADIUS, spacing=SPACING)
        masked = numpy.ma.array(array, mask=False)
        masked[28, 28, 33] = numpy.ma.masked
        self.refuse(flipfree.SegmentationError, r"the seed sphere touches a voxel without data", masked, SEED, RADIUS,
                    spacing=SPACING)
        masked = numpy.ma.array(array, mask=False)
        masked[:, :, 60:] = numpy.ma.masked
        for kind in ("inside", "boundary"):
            self.refuse(flipfree.SegmentationError,
                        rf"the {kind} point \(200, 80, 167\) mm touches a voxel without data", masked, SEED, RADIUS,
                        spacing=SPACING, **{kind: [(200, 80, 167)]})

    def test_seed_and_radius(self):
        for error, message, seed, radius in (
                (ValueError, "^seed: 3 numbers are needed, not 2$", (1, 2), RADIUS),
                (TypeError, "^seed: 3 numbers are needed, not", ("99", "84", "167"), RADIUS),
                (TypeError, "^seed: 3 numbers are needed, not b'222'$", b"222", RADIUS),
                (TypeError, "^radius: a number is needed, not '28'$", SEED, "28"),
                (TypeError, "^seed: 3 numbers are needed, not 5$", 5, RADIUS),
                (TypeError, "^radius: a number is needed, not", SEED, "wide"),
                (ValueError, r"^radius: nan is not a number \(NaN\); give the radius", SEED, math.nan),
                (ValueError, "^radius: -1 is not positive; give the radius", SEED, -1),
                (ValueError, "^radius: 0.0 is not positive; give the radius", SEED, 0.0),
                (ValueError, r"^radius: 1000000000.0 is out of range; give 1e-06 to 1e\+06$", SEED, 1e9),
                (flipfree.SegmentationError, r"radius of 1e-05 mm is below a voxel of the image \(", SEED, 1e-5),
                (flipfree.SegmentationError, r"^No segmentation: the seed's center \(-50, 0, 0\) mm lies outside .*\.$",
                 (-50, 0, 0), RADIUS),
                (flipfree.SegmentationError, "; with x and y negated it would lie inside: check whether it is LPS or RAS",
                 (-99.75, -83.75, 167), RADIUS)):
            self.refuse(error, message, image(), seed, radius)

    def test_an_organ_without_a_boundary(self):
        words = "^No segmentation: no boundary of the organ was found; check that the seed sphere .* raise search_distance"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.refuse(flipfree.SegmentationError, words, image(), SEED, 9, resolution=8, search_distance=1, levels=1,
                        maximum_iterations=1, carving=False)

    def test_a_surface_without_a_boundary_is_known_by_its_state_not_its_words(self):
        self.assertTrue(liver().boundary_found)
        for require in (_boundary_found.require_boundary, _boundary_found.require_vessel_boundary):
            with self.assertRaisesRegex(flipfree.SegmentationError, "no boundary of the (organ|vessel) was found"):
                require(dataclasses.replace(liver(), stop_reason="in other words", boundary_found=False))
            require(dataclasses.replace(liver(), stop_reason="no boundary found"))

    def test_images(self):
        array = flipfree.array_from_image(image())
        unit = {"spacing": (1, 1, 1)}
        for error, message, volume, geometry in (
                (TypeError, "^spacing: an array needs it", array, {}),
                (ValueError, "^array: 3 axes", array[0], unit),
                (TypeError, "^array: voxels of type complex128", array * 1j, unit),
                (ValueError, "^direction: 9 numbers are needed, not 3", array, {**unit, "direction": (1, 1, 1)}),
                (TypeError, "belong to arrays", image(), unit),
                (TypeError, "^image: a (vtkImageData|flipfree.Image), an array or the name", None, {}),
                (flipfree.SegmentationError, ".", numpy.zeros((0, 3, 3)), unit)):
            self.refuse(error, message, volume, SEED, RADIUS, **geometry)

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
        for error, message, arguments, parameters in (
                (flipfree.EvaluationError, "empty", (liver(), empty), {}),
                (ValueError, "^reference: an array gets its geometry from the other image", (liver(), empty[:5]), {}),
                (TypeError, "did you mean 'reference_label'", (liver(), truth()), {"reference_labels": 6}),
                (TypeError, "^reference: an array without geometry", (surface_of(liver()), empty), {}),
                (TypeError, "^segmentation: a label map", (None, truth()), {})):
            with self.subTest(message), self.assertRaisesRegex(error, message):
                flipfree.evaluate(*arguments, **parameters)

    @needs_vtk
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

    @unittest.skipUnless(sys.platform == "linux", "limits memory as Linux does")
    def test_no_memory_is_said_with_what_to_do(self):
        program = start_python("""
import resource
def segment(size):
    ball = flipfree.phantom("sphere", dimensions=(size,) * 3)
    ((center, radius),) = ball.seeds.values()
    pages = int(open("/proc/self/statm").read().split()[0])
    limit = pages * resource.getpagesize() + 20_000_000
    if size > 100:
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    flipfree.segment(ball.image, center, radius, levels=1, resolution=8)
segment(48)  # loads all that is needed
try:
    segment(240)
except (flipfree.SegmentationError, MemoryError) as error:
    print(error)
""")
        output, errors = program.communicate(timeout=200)
        self.assertRegex(output, r"(?i)^(no segmentation: )?out of memory; crop the volume, or use a machine with more "
                                 r"memory\.?\n\Z", errors)

    def test_exceptions_can_be_pickled(self):
        for name in ("SegmentationError", "EvaluationError", "FileError"):
            error = pickle.loads(pickle.dumps(getattr(flipfree, name)("why")))
            self.assertIsInstance(error, flipfree.FlipFreeError)
            self.assertEqual((type(error).__name__, str(error)), (name, "why"))


class Warnings(unittest.TestCase):
    def test_name_what_the_caller_wrote_and_point_to_the_callers_line(self):
        for radius, parameters, words in ((RADIUS, {"reach": 30}, r"raise reach where the organ is that large\.$"),
                                          (160, {"maximum_iterations": 0, "resolution": 8, "carving": False}, r"lower radius or move seed\.$")):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                flipfree.segment(image(), SEED, radius, **parameters)
            self.assertEqual([(warning.category, warning.filename) for warning in caught][:1],
                             [(flipfree.FlipFreeWarning, __file__)])
            self.assertRegex(str(caught[0].message), words)

    def test_can_be_an_error(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(flipfree.FlipFreeWarning):
                flipfree.segment(image(), SEED, RADIUS, reach=30)


@needs_vtk
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
                                         r"9\.\d.*vtkmodules is of VTK 9\.99\.1")


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
