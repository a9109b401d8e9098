"""The plugin in Python, over the wheel, in ParaView without the plugin in C++."""

import contextlib
import io
import os
import re
import sys

# Behind all that ParaView brings along, numpy and VTK included.
sys.path.append(os.environ["FLIPFREE_WHEEL_SITE"])

import flipfree
import flipfree.paraview_plugin
import numpy
import session
from paraview import servermanager, simple
from session import column, fetch, points, voxels
from vtkmodules.vtkCommonCore import vtkVersion

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
