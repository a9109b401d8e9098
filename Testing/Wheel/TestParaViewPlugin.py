"""The plugin in Python, over the wheel, in ParaView without the plugin in C++."""

import contextlib
import inspect
import io
import os
import re
import subprocess
import sys
import unittest.mock

# Behind all that ParaView brings along, numpy and VTK included.
sys.path.append(os.environ["FLIPFREE_WHEEL_SITE"])

import flipfree
import flipfree.paraview_plugin
import numpy
import session
from paraview import servermanager, simple
from session import column, fetch, points, voxels
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkDataObject

PVPYTHON = os.path.join(f"{os.environ['FLIPFREE_BUILD']}-prefix", "usr", "bin", "pvpython")
DIRECTION = (0, -1, 0, 1, 0, 0, 0, 0, 1)


class Plugin(session.SessionTest):
    def setUp(self):
        super().setUp()
        flipfree.paraview_plugin.load()
        phantom = flipfree.phantom("sphere", dimensions=(40, 40, 40), direction=DIRECTION)
        self.seed = phantom.seeds[1]
        self.expected = flipfree.segment(phantom.image, *self.seed, resolution=8)
        flipfree.write_image(phantom.image, self.file("ball.nii"))
        self.image = simple.OpenDataFile(self.file("ball.nii"))
        self.organ = simple.FlipFreeSegmentationPython(Input=self.image, SeedCenter=self.seed[0], SeedRadius=self.seed[1],
                                                       Resolution=8)
        self.addCleanup(self.forget)

    def forget(self):
        simple.Delete(self.organ)
        simple.Delete(self.image)
        del self.organ, self.image

    def test_reader_keeps_the_direction(self):
        matrix = fetch(self.image).GetDirectionMatrix()
        self.assertEqual([matrix.GetElement(i, j) for i in range(3) for j in range(3)], list(DIRECTION))
        self.assertEqual(self.image.GetDataInformation().GetBounds(), (-39, 0, 0, 39, 0, 39))

    def test_direction_is_announced(self):
        reader = flipfree.paraview_plugin.FlipFreeReaderPython()
        reader.SetFileName(self.file("ball.nii"))
        reader.UpdateInformation()
        announced = reader.GetOutputInformation(0)
        self.assertEqual([announced.Get(vtkDataObject.DIRECTION(), index) for index in range(9)], list(DIRECTION))

    def test_files_that_cannot_be_read_are_one_message(self):
        with open(self.file("damaged.nii"), "wb") as file:
            file.write(b"no image")
        for name in ("damaged.nii", "missing.nii"):
            reader = flipfree.paraview_plugin.FlipFreeReaderPython()
            reader.SetFileName(self.file(name))
            with unittest.mock.patch.object(flipfree.paraview_plugin, "vtkLogger") as logger:
                self.assertEqual(reader.RequestInformation(None, None, None), 0)
                self.assertEqual(reader.RequestData(None, None, None), 0)  # ParaView asks for it all the same
            [call] = logger.Log.call_args_list
            self.assertRegex(call.args[3], f"^FlipFreeReaderPython: '.*{name}'")

    def test_outputs_are_those_of_the_package(self):
        self.assert_same(points(fetch(self.organ)), self.expected.points)
        labels = fetch(self.organ, 1)
        self.assert_same(voxels(labels), self.expected.labels.ravel())
        self.assertEqual(labels.GetDirectionMatrix().GetElement(0, 1), -1)
        self.assertEqual(len(column(fetch(self.organ, 2), "Iteration")), len(self.expected.iterations["Iteration"]))
        self.assertEqual(fetch(self.organ, 3).GetNumberOfColumns(), 6)

    def test_every_parameter_is_a_property(self):
        defaults = flipfree.default_parameters()
        for name, parameter in flipfree._backend.SEGMENT_PARAMETERS.items():
            if name != "resolution":
                stored = self.organ.GetProperty(parameter.property).SMProperty
                value = [stored.GetElement(index) for index in range(stored.GetNumberOfElements())]
                numpy.testing.assert_allclose(value, numpy.ravel(defaults[name]), err_msg=name)
        domain = self.organ.GetProperty("Levels").SMProperty.GetDomain("range")
        self.assertEqual((domain.GetMinimum(0), domain.GetMaximum(0)), (1, 6))
        self.organ.Levels = 1
        self.organ.Carving = 0
        self.organ.Modality = "MR"
        again = flipfree.segment(flipfree.read_image(self.file("ball.nii")), *self.seed, resolution=8, levels=1, carving=False,
                                 modality=2)
        self.assert_same(points(fetch(self.organ)), again.points)

    def test_apply_shows_the_surface_in_the_image(self):
        """By hints for the window, which else hides the image and opens a table view for each table."""
        hints = self.organ.SMProxy.GetHints()
        views = {}
        for element in map(hints.GetNestedElement, range(hints.GetNumberOfNestedElements())):
            if element.GetName() == "View":
                views[element.GetAttribute("port")] = element.GetAttribute("type")
        self.assertEqual(views, {"1": "None", "2": "None", "3": "None"})
        self.assertEqual(hints.FindNestedElementByName("Visibility").GetAttribute("replace_input"), "0")
        self.assertEqual(hints.FindNestedElementByName("ShowInMenu").GetAttribute("category"), "FlipFree")

    def test_seed_is_a_sphere_in_the_view(self):
        group = self.organ.SMProxy.GetPropertyGroup(0)
        self.assertEqual((group.GetPanelWidget(), group.GetNumberOfProperties()), ("InteractiveSphere", 2))
        self.image.UpdatePipeline()
        elsewhere = simple.FlipFreeSegmentationPython(Input=self.image)
        self.assertEqual(list(elsewhere.SeedCenter), [-19.5, 19.5, 19.5])  # the middle of the image
        simple.Delete(elsewhere)

    def test_iterations_are_time_steps(self):
        self.organ.MaximumIterations = 5
        result = points(fetch(self.organ))
        self.organ.KeepHistory = 1
        rows = column(fetch(self.organ, 2), "Iteration")
        self.organ.UpdatePipelineInformation()
        times = list(self.organ.TimestepValues)
        self.assertEqual(times, list(range(1, len(rows) + 1)))
        view = self.view()
        simple.Show(self.organ, view)
        simple.Render(view)
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        self.assertEqual([scene.StartTime, scene.EndTime], [1, len(rows)])
        radii = []
        for time in (1, 2, times[-1], 1):
            self.organ.UpdatePipeline(time)
            shown = points(servermanager.Fetch(self.organ))
            radii.append(numpy.linalg.norm(shown - self.seed[0], axis=1).mean())
        self.assertGreater(radii[1], radii[0] + 0.1)
        self.assertEqual(radii[3], radii[0])
        self.organ.UpdatePipeline(times[-1])
        self.assert_same(points(servermanager.Fetch(self.organ)), result)

    def test_start_surface(self):
        sphere = simple.Sphere(Center=self.seed[0], Radius=9, ThetaResolution=16, PhiResolution=16)
        self.organ.StartSurface = sphere
        self.assertGreater(fetch(self.organ).GetNumberOfPoints(), 384)
        self.organ.StartSurface = None
        self.assert_same(points(fetch(self.organ)), self.expected.points)


class Loading(session.SessionTest):
    """Of the file by itself, as ParaView does, in a process of its own."""

    def load(self, before=""):
        program = f"""
import inspect, os, runpy, sys
sys.path[:] = [path for path in sys.path if os.path.realpath(path) != os.path.realpath(os.environ["FLIPFREE_WHEEL_SITE"])]
sys.path.insert(0, {self.folder!r})
{before}
runpy.run_path(os.path.join(os.environ["FLIPFREE_WHEEL_SITE"], "flipfree", "paraview_plugin.py"))
print(sys.modules["flipfree"].__file__)
print(*(inspect.getargspec(lambda a, b=1: a) if hasattr(inspect, "getargspec") else "none"))
"""
        path = self.file("load.py")
        with open(path, "w", encoding="utf-8") as file:
            file.write(program)
        return subprocess.run([PVPYTHON, path], capture_output=True, text=True, check=False)

    def test_package_is_the_one_of_the_file(self):
        """Not the toolkit's own, which is before it on the path."""
        os.mkdir(self.file("flipfree"))
        with open(self.file("flipfree/__init__.py"), "w", encoding="utf-8") as file:
            file.write("__version__ = 'another'\n")
        process = self.load()
        own = os.path.join(os.path.realpath(os.environ["FLIPFREE_WHEEL_SITE"]), "flipfree", "__init__.py")
        self.assertEqual(process.stdout.splitlines()[:1], [own], process)
        process = self.load("import flipfree")
        another = re.escape(os.path.join(os.path.realpath(self.folder), "flipfree"))
        self.assertRegex(process.stderr, f"ImportError: another flipfree has been imported already, from '{another}'")

    @unittest.skipIf(sys.version_info < (3, 11), "this Python has it")
    def test_getargspec_is_added_only_where_it_is_needed(self):
        """And has four fields."""
        source = inspect.getsource(sys.modules["paraview.detail.pythonalgorithm"])
        is_needed = "import getargspec" in source
        added = "['a', 'b'] None None (1,)" if is_needed else "n o n e"
        self.assertEqual(self.load().stdout.splitlines()[1:], [added])
        # As in a ParaView that does without.
        before = "inspect.getargspec = inspect.getfullargspec\nimport paraview.util.vtkAlgorithm\ndel inspect.getargspec"
        self.assertEqual(self.load(before).stdout.splitlines()[1:], ["n o n e"])


class Guide(session.SessionTest):
    def test_lines(self):
        page = os.path.join(os.environ["FLIPFREE_PYTHON_SOURCE"], "..", "..", "Examples", "Guide", "paraview.md")
        with open(page, encoding="utf-8") as file:
            section = file.read().partition("\n## The plugin in Python\n")[2].partition("\n## ")[0]
        program = "\n".join(re.findall(r"(?s)```python\n(.*?)```", section))
        program, count = re.subn('"/home/you/[^"]*"', repr(os.environ["FLIPFREE_WHEEL_SITE"]), program)
        self.assertEqual(count, 1)
        os.mkdir(self.file("try"))
        coarse = flipfree.phantom("abdomen", dimensions=(110, 85, 45), spacing=(3, 3, 6)).image
        flipfree.write_image(coarse, self.file("try/abdomen.nii.gz"))
        self.addCleanup(os.chdir, os.getcwd())
        self.addCleanup(lambda: simple.Delete(simple.GetActiveView()))
        os.chdir(self.folder)
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            exec(program, {})
        self.assertEqual(printed.getvalue(), "6144 vertices\n")
        self.assertGreater(os.path.getsize(self.file("liver.png")), 10000)


if __name__ == "__main__":
    print("ParaView", simple.GetParaViewVersion(), "VTK", vtkVersion.GetVTKVersion(), "numpy", numpy.__version__)
    session.main()
