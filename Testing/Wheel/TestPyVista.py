"""PyVista's accessor, and the filter for pipelines of VTK, with whatever VTK is installed."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import flipfree
import numpy
from example import RADIUS, SEED, coarse_liver, image, truth

try:
    import pyvista
    import vtkmodules
    from flipfree import pyvista as flipfree_pyvista
    from flipfree import vtk as flipfree_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline, vtkTrivialProducer
    from vtkmodules.vtkFiltersCore import vtkTriangleFilter
except ImportError as error:
    print(f"Skipped: {error}.")
    sys.exit(77)

print("VTK", vtkmodules.__version__, "PyVista", pyvista.__version__)
has_accessors = unittest.skipUnless(hasattr(pyvista, "register_dataset_accessor"), "PyVista is older than 0.48")


def dataset():
    return flipfree_pyvista.imagedata(image())


class Objects(unittest.TestCase):
    def test_image_keeps_its_place_and_memory(self):
        direction = numpy.array([[0, 0, -1], [1, 0, 0], [0, 1, 0.0]])
        ours = flipfree.image_from_array(numpy.arange(24.0).reshape(2, 3, 4), (1, 2, 3), (4, 5, 6), direction)
        theirs = flipfree_pyvista.imagedata(ours)
        self.assertEqual(theirs.dimensions, (4, 3, 2))
        place = [0.0] * 3
        theirs.TransformIndexToPhysicalPoint((1, 0, 0), place)  # PyVista's own points: without the direction before 0.45
        numpy.testing.assert_allclose(place, [4, 6, 6])
        self.assertTrue(numpy.shares_memory(theirs.active_scalars, ours.voxels))

    def test_surface_has_quads(self):
        surface = flipfree_pyvista.polydata(coarse_liver())
        self.assertEqual((surface.n_points, surface.n_cells), (384, 386))
        self.assertFalse(surface.is_all_triangles)
        numpy.testing.assert_array_equal(surface.points, coarse_liver().points)
        self.assertEqual(surface.n_open_edges, 0)
        self.assertEqual(set(surface.point_data), {"Displacement", "Correspondence", "Confidence"})
        self.assertEqual(surface.field_data["Certified"], [1])

    def test_surfaces_of_vtk_are_taken(self):
        """As a start, and to be scored."""
        ours, theirs = coarse_liver(), coarse_liver().surface
        self.assertEqual(flipfree.evaluate(theirs, truth(), reference_label=6),
                         flipfree.evaluate(ours, truth(), reference_label=6))
        points = [flipfree.segment(image(), SEED, RADIUS, start=start, levels=1, maximum_iterations=2).points
                  for start in (ours, theirs)]
        numpy.testing.assert_array_equal(*points)

    def test_extent_that_starts_elsewhere(self):
        cropped = vtkImageData()
        cropped.ShallowCopy(dataset())
        cropped.Crop((10, 109, 5, 75, 3, 45))
        organ = flipfree.segment(cropped, SEED, RADIUS, resolution=8, levels=1, maximum_iterations=3)
        whole = flipfree.segment(image(), SEED, RADIUS, resolution=8, levels=1, maximum_iterations=3)
        self.assertEqual(organ.label_map.origin, (30, 15, 18))
        self.assertLess(numpy.abs(organ.points - whole.points).max(), 1)


class Missing(unittest.TestCase):
    def test_says_how_to_install(self):
        for package, gone in (("pyvista", "pyvista"), ("vtk", "vtkmodules")):
            program = (f"import sys; sys.modules['{gone}'] = None\ntry: import flipfree.{package}\n"
                       "except ImportError as error: print(error)")
            output = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
            self.assertRegex(output, rf"^flipfree\.{package} needs {package}, which is not installed: pip install "
                                     r"'\.\[pyvista\]' in FlipFree's source folder, or pip install pyvista\n$")


@has_accessors
class Accessor(unittest.TestCase):
    def test_is_there_without_an_import(self):
        program = ("import pyvista, sys; image = pyvista.ImageData(dimensions=(2, 2, 2)); "
                   "assert 'flipfree' not in sys.modules; print(image.flipfree.segment.__doc__)")
        output = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
        self.assertIn("The organ around a seed sphere", output)

    def test_segments_the_active_scalars(self):
        ct = dataset()
        active = ct.active_scalars_name
        surface = ct.flipfree.segment(seed=SEED, radius=RADIUS, resolution=8, labels_as="liver")
        numpy.testing.assert_array_equal(surface.points, coarse_liver().points)
        numpy.testing.assert_array_equal(ct["liver"], coarse_liver().labels.ravel())
        self.assertEqual(ct.active_scalars_name, active)
        self.assertEqual(surface.field_data["stop_reason"][0], coarse_liver().stop_reason)
        reference = flipfree_pyvista.imagedata(truth())
        self.assertEqual(reference.flipfree.evaluate(surface, reference_label=6),
                         flipfree.evaluate(coarse_liver(), truth(), reference_label=6))

    def test_surfaces_of_a_label_map(self):
        walls = flipfree.surfaces(truth(), [2, 6], exact=True, iterations=5)
        blocks = flipfree_pyvista.imagedata(truth()).flipfree.surfaces([2, 6], exact=True, iterations=5)
        self.assertEqual(blocks.keys(), ["2", "6"])
        for label, surface in zip((2, 6), blocks):
            points, triangles = walls.surface(label)
            numpy.testing.assert_array_equal(surface.points, points)
            numpy.testing.assert_array_equal(surface.regular_faces, triangles)
            self.assertEqual((surface.n_open_edges, surface.field_data["Label"]), (0, [label]))
            self.assertEqual(surface.field_data["Certified"], [1])
            self.assertLess(abs(surface.volume / 1000 / walls.labels[label].volume - 1), 1e-3)

    def test_a_label_without_parts_has_no_surface(self):
        blocks = flipfree_pyvista.imagedata(truth()).flipfree.surfaces(smallest_part=100000)
        self.assertEqual([block.field_data["Label"][0] for block in blocks], [int(key) for key in blocks.keys()])
        self.assertIn("6", blocks.keys())
        self.assertLess(blocks.n_blocks, len(flipfree.surfaces(truth()).labels))

    def test_cells_are_refused(self):
        cells = pyvista.ImageData(dimensions=(5, 5, 5))
        cells.cell_data["values"] = numpy.zeros(64)
        with self.assertRaisesRegex(ValueError, r"^image: .*no scalars.*cells_to_points"):
            cells.flipfree.segment(seed=(1, 1, 1), radius=1)


class Plot(unittest.TestCase):
    def test_contours_and_surface(self):
        """Where the display has no OpenGL, VTK ends the program: so in one of its own."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.environ.get("FLIPFREE_PICTURE") or str(Path(folder) / "plot.png")
            program = ("from example import *; from flipfree import pyvista as ours\n"
                       "plotter = ours.plotter(ours.imagedata(image()), ours.polydata(coarse_liver()),"
                       " off_screen=True, window_size=(800, 800))\n"
                       f"plotter.screenshot({path!r})")
            process = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
            if not Path(path).exists():
                self.skipTest(f"nothing can be drawn here: {process.stderr[-200:]}")
            pixels = numpy.asarray(pyvista.read(path).active_scalars).astype(int)
        contour = (pixels[:, 0] > 200) & (abs(pixels[:, 1] - 190) < 40) & (pixels[:, 2] < 110)
        organ = (pixels[:, 0] > 1.5 * pixels[:, 1]) & (pixels[:, 0] > 80)
        gray = (abs(pixels[:, 0] - pixels[:, 1]) < 4) & (pixels[:, 0] > 60)
        self.assertGreater(contour.sum(), 800)
        self.assertGreater(organ.sum(), 15000)
        self.assertGreater(gray.sum(), 100000)

    def test_needs_a_surface(self):
        with self.assertRaisesRegex(ValueError, "^surfaces: at least one"):
            flipfree_pyvista.plotter(dataset())


class Pipeline(unittest.TestCase):
    def setUp(self):
        self.source = vtkTrivialProducer()
        self.source.SetOutput(dataset())
        self.filter = flipfree_vtk.FlipFreeSegmentation()
        self.filter.SetInputConnection(self.source.GetOutputPort())
        self.filter.SetSeedCenter(SEED)
        self.filter.SetSeedRadius(RADIUS)
        self.filter.SetResolution(8)

    def test_outputs(self):
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(self.filter.GetOutputPort())
        triangles.Update()
        self.assertEqual(triangles.GetOutput().GetNumberOfPolys(), 764)
        liver = coarse_liver()
        points = pyvista.wrap(self.filter.GetSurface()).points
        numpy.testing.assert_array_equal(points, liver.points)
        labels = pyvista.wrap(self.filter.GetLabelMap())
        numpy.testing.assert_array_equal(labels.active_scalars, liver.labels.ravel())
        self.assertEqual(labels.dimensions, liver.labels.shape[::-1])
        self.assertEqual(self.filter.GetConvergence().GetNumberOfRows(), len(liver.iterations["Iteration"]))
        questions = self.filter.GetQuestions()
        self.assertEqual((questions.GetNumberOfRows(), questions.GetNumberOfColumns()), (len(liver.questions), 6))
        self.assertEqual(self.filter.GetStopReasonAsString(), liver.stop_reason)

    def test_runs_only_when_something_has_changed(self):
        started = []
        self.filter.AddObserver("StartEvent", lambda *_: started.append(1))
        self.filter.SetMaximumIterations(1)
        for count in (1, 1):
            self.filter.Update()
            self.assertEqual(len(started), count)
        self.filter.SetMaximumIterations(2)
        self.filter.Update()
        self.assertEqual(len(started), 2)
        self.assertEqual(self.filter.GetMaximumIterations(), 2)

    def test_iterations_are_time_steps(self):
        self.filter.SetLevels(1)
        self.filter.SetMaximumIterations(3)
        self.filter.SetCarving(False)
        self.filter.Update()
        result = pyvista.wrap(self.filter.GetSurface()).points.copy()
        self.filter.SetKeepHistory(True)
        self.filter.Update()
        key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        information = self.filter.GetOutputInformation(0)
        self.assertEqual([information.Get(key, step) for step in range(information.Length(key))], [1, 2, 3])
        organ = flipfree.segment(image(), SEED, RADIUS, resolution=8, levels=1, maximum_iterations=3, carving=False,
                                 keep_history=True)
        for time, points in ((1, organ.history[0].points), (2, organ.history[1].points), (3, result)):
            self.filter.UpdateTimeStep(time)
            numpy.testing.assert_array_equal(pyvista.wrap(self.filter.GetSurface()).points, points)
        self.filter.SetMaximumIterations(2)
        self.filter.UpdateTimeStep(2)
        self.assertEqual(information.Length(key), 2)

    def test_start_surface(self):
        self.filter.SetStartData(coarse_liver().surface)
        self.filter.SetLevels(1)
        self.filter.SetMaximumIterations(2)
        self.filter.Update()
        again = flipfree.segment(image(), SEED, RADIUS, resolution=8, start=coarse_liver(), levels=1,
                                 maximum_iterations=2)
        numpy.testing.assert_array_equal(pyvista.wrap(self.filter.GetSurface()).points, again.points)

    def test_errors_are_exceptions(self):
        self.filter.SetSeedCenter(-50, 0, 0)
        with self.assertRaisesRegex(flipfree.SegmentationError, r"seed's center \(-50, 0, 0\) mm lies outside"):
            self.filter.Update()
        self.assertIsInstance(self.filter.GetSurface(), vtkPolyData)
        self.assertEqual(self.filter.GetSurface().GetNumberOfPoints(), 0)
        with self.assertRaisesRegex(ValueError, "^levels: 99 is out of range"):
            self.filter.SetLevels(99)
        self.filter.SetSeedCenter(SEED)
        self.filter.SetMaximumIterations(1)
        self.filter.Update()
        self.assertEqual(self.filter.GetSurface().GetNumberOfPoints(), 384)

    def test_abort(self):
        told = []

        def stop(caller, _event):
            told.append(caller.GetProgress())
            if caller.GetProgress() > 0.2:
                caller.SetAbortExecute(1)

        self.filter.AddObserver("ProgressEvent", stop)
        self.filter.Update()
        self.assertFalse([fraction for fraction in told if 0.5 < fraction < 1])  # VTK itself tells 1 at the end
        self.assertEqual(self.filter.GetSurface().GetNumberOfPoints(), 0)


if __name__ == "__main__":
    unittest.main()
