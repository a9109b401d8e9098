"""3D Slicer: nodes in, segments out, with the real classes of MRML (slicer-core)."""

import contextlib
import dataclasses
import inspect
import os
import re
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock
from pathlib import Path

import flipfree
import numpy

try:
    import flipfree.slicer as ours
    import slicer
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkCommonMath import vtkMatrix4x4
    from vtkmodules.vtkCommonTransforms import vtkThinPlateSplineTransform
    from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter
except ImportError as error:
    print(f"Skipped: {error}.")
    sys.exit(77)

RAS = numpy.diag([-1, -1, 1, 1.0])
COARSE = {"resolution": 8}
# Anisotropic, permuted, oblique and left-handed axes; and sheared ones, as of a tilted gantry.
OBLIQUE = numpy.array([[0, -0.8, 0.6, 12], [0, 0.6, 0.8, -30], [1.5, 0, 0, 7], [0, 0, 0, 1]])
SHEARED = numpy.array([[1, 0, 0, 5], [0, 1, 0.4, -8], [0, 0, 1, 3], [0, 0, 0, 1.0]])


def matrix_of(array):
    matrix = vtkMatrix4x4()
    matrix.DeepCopy(numpy.ravel(array))
    return matrix


class SlicerTest(unittest.TestCase):
    """A scene with a ball in a volume, whose voxels a matrix takes to RAS."""

    def setUp(self):
        self.scene = slicer.vtkMRMLScene()

    def node(self, kind, name):
        return self.scene.AddNewNodeByClass(f"vtkMRML{kind}Node", name)

    def volume(self, matrix=RAS, phantom="sphere", size=40, name="ct", start=(0, 0, 0)):
        self.phantom = flipfree.phantom(phantom, dimensions=(size, size, size))
        data = vtkImageData()
        data.SetExtent(*(index for first in start for index in (first, first + size - 1)))
        data.GetPointData().SetScalars(numpy_to_vtk(self.phantom.image.voxels.ravel(), deep=True))
        volume = self.node("ScalarVolume", name)
        volume.SetAndObserveImageData(data)
        volume.SetIJKToRASMatrix(matrix_of(matrix))
        self.matrix, self.start = matrix, start
        return volume

    def ras(self, *index):
        """Of a voxel, counted from the first."""
        return (self.matrix @ [*numpy.add(index, self.start), 1])[:3]

    def markups(self, kind, name, *points, label=""):
        node = self.node(f"Markups{kind}", name)
        for point in points:
            node.AddControlPointWorld(point, label)
        return node

    def seed(self, label="seed 6"):
        return self.markups("Fiducial", "seeds", self.ras(20, 20, 20), label=label)

    def transform(self, matrix):
        node = self.node("LinearTransform", "moved")
        node.SetMatrixTransformToParent(matrix_of(matrix))
        return node

    def labels(self, found, volume):
        """The segment's voxels as those of the volume."""
        image = slicer.vtkOrientedImageData()
        found.segmentationNode.GetBinaryLabelmapRepresentation(found.segmentID, image)
        ijk = vtkMatrix4x4()
        image.GetImageToWorldMatrix(ijk)
        expected = vtkMatrix4x4()
        volume.GetIJKToRASMatrix(expected)
        numpy.testing.assert_allclose([ijk.GetElement(i, j) for i in range(4) for j in range(4)],
                                      [expected.GetElement(i, j) for i in range(4) for j in range(4)], atol=1e-9)
        size = volume.GetImageData().GetDimensions()
        voxels = numpy.zeros(size[::-1], bool)
        first = volume.GetImageData().GetExtent()[::2]
        low, high = (numpy.subtract(image.GetExtent()[at::2], first) for at in (0, 1))
        part = vtk_to_numpy(image.GetPointData().GetScalars()).reshape((high - low + 1)[::-1])
        voxels[low[2]:high[2] + 1, low[1]:high[1] + 1, low[0]:high[0] + 1] = part != 0
        return voxels

    def surface(self, found):
        return found.segmentationNode.GetClosedSurfaceInternalRepresentation(found.segmentID)

    def dice(self, found, volume):
        labels, truth = self.labels(found, volume), self.phantom.label_map.voxels == 1
        return 2 * (labels & truth).sum() / (labels.sum() + truth.sum())


class Geometry(SlicerTest):
    def test_label_map_and_surface_are_where_the_organ_is(self):
        center = numpy.mean(numpy.argwhere(flipfree.phantom("sphere", dimensions=(40, 40, 40)).label_map.voxels == 1), axis=0)
        for matrix in (RAS, OBLIQUE, SHEARED):
            with self.subTest(matrix=matrix.tolist()):
                volume = self.volume(matrix)
                found = ours.segment(volume, self.seed(), **COARSE)
                self.assertGreater(self.dice(found, volume), 0.95)
                points = vtk_to_numpy(self.surface(found).GetPoints().GetData())
                numpy.testing.assert_allclose(points * [-1, -1, 1], found.result.points, atol=1e-9)
                numpy.testing.assert_allclose(points.mean(axis=0), self.ras(*center[::-1]), atol=0.5)

    def test_first_index_need_not_be_zero(self):
        volume = self.volume(OBLIQUE, start=(3, -2, 5))
        found = ours.segment(volume, self.seed(), **COARSE)
        self.assertGreater(self.dice(found, volume), 0.95)
        center = [0.0] * 3
        found.segmentationNode.GetSegmentCenterRAS(found.segmentID, center)
        numpy.testing.assert_allclose(center, self.ras(19.5, 19.5, 19.5), atol=1)

    def test_surface_is_the_result_and_faces_outward(self):
        volume = self.volume()
        found = ours.segment(volume, self.seed(), **COARSE)
        found.segmentationNode.CreateClosedSurfaceRepresentation()  # as showing it in 3D does
        surface = self.surface(found)
        self.assertEqual((surface.GetNumberOfPoints(), surface.GetNumberOfPolys()), (384, 386))
        self.assertEqual(surface.GetFieldData().GetArray("Certified").GetTuple1(0), 1)
        triangles, mass = vtkTriangleFilter(), vtkMassProperties()
        triangles.SetInputData(surface)
        mass.SetInputConnection(triangles.GetOutputPort())
        mass.Update()
        self.assertAlmostEqual(mass.GetVolume() / found.result.labels.sum(), 1, delta=0.02)
        corners = numpy.asarray(found.result.points * [-1, -1, 1])[found.result.triangles]
        self.assertGreater(numpy.linalg.det(corners - corners.mean(axis=(0, 1))).sum(), 0)

    def test_seeds(self):
        """A sphere by each kind of node is the same sphere."""
        volume = self.volume(OBLIQUE)
        center = self.ras(20, 20, 20)
        roi = self.node("MarkupsROI", "roi")
        roi.SetCenterWorld(center)
        roi.SetSizeWorld(20, 12, 16)
        line = self.markups("Line", "line", center, center + [0, 6, 0])
        unlabeled = self.markups("Fiducial", "F", center)
        expected = ours.segment(volume, self.seed(), **COARSE).result.points
        for seeds, radius in ((roi, None), (line, None), (unlabeled, 6), (unlabeled, numpy.float64(6))):
            points = ours.segment(volume, seeds, radius=radius, **COARSE).result.points
            numpy.testing.assert_allclose(points, expected, atol=1e-6)
        several = self.markups("Fiducial", "F", center, center + [0, 0, 3])
        self.assertEqual([one.radius for one in ours.segment(volume, several, radius=5, **COARSE).result.constraints], [5])

    def test_corrections(self):
        volume = self.volume()
        inside = self.markups("Fiducial", "inside", label="inside-1")
        inside.AddControlPointWorld(self.ras(34, 20, 20), "inside-1")
        inside.AddControlPointWorld(self.ras(1, 1, 1), "inside-2")
        inside.UnsetNthControlPointPosition(1)  # not placed
        outside = self.markups("Fiducial", "x", self.ras(12, 20, 20), label="Outside")
        found = ours.segment(volume, self.seed(), corrections=[inside, outside], **COARSE)
        labels = self.labels(found, volume)
        self.assertTrue(labels[20, 20, 34])
        self.assertFalse(labels[20, 20, 12])
        self.assertEqual(len(found.result.constraints), 2)


class Transforms(SlicerTest):
    def setUp(self):
        super().setUp()
        self.turned = numpy.array([[0, -1, 0, 50], [1, 0, 0, -20], [0, 0, 1, 9], [0, 0, 0, 1.0]])

    def test_volume_and_points_move_together(self):
        """The result is that of the volume unmoved, and where the volume is now."""
        volume = self.volume(OBLIQUE)
        expected = ours.segment(volume, self.seed(), **COARSE).result.points
        volume.SetAndObserveTransformNodeID(self.transform(self.turned).GetID())
        seed = (self.turned @ [*self.ras(20, 20, 20), 1])[:3]
        moved = self.markups("Fiducial", "F", seed, label="seed 6")
        found = ours.segment(volume, moved, **COARSE)
        numpy.testing.assert_allclose(found.result.points, expected, atol=1e-6)
        center = [0.0] * 3
        found.segmentationNode.GetSegmentCenterRAS(found.segmentID, center)
        numpy.testing.assert_allclose(center, seed, atol=2)
        self.assertGreater(self.dice(found, volume), 0.95)

    def test_points_of_a_moved_node(self):
        volume = self.volume()
        place = (numpy.linalg.inv(self.turned) @ [*self.ras(20, 20, 20), 1])[:3]
        seeds = self.node("MarkupsFiducial", "F")
        seeds.SetAndObserveTransformNodeID(self.transform(self.turned).GetID())
        seeds.AddControlPoint(place, "seed 6")
        self.assertGreater(self.dice(ours.segment(volume, seeds, **COARSE), volume), 0.95)

    def test_volume_that_is_warped(self):
        """Points go through the inverse of what warps it; the segmentation is warped with it."""
        volume = self.volume()
        warp = self.node("Transform", "warp")
        spline = vtkThinPlateSplineTransform()
        for side, shift in ((spline.SetSourceLandmarks, 0), (spline.SetTargetLandmarks, 5)):
            corners = vtkPoints()
            for x in (-40, 0):
                for y in (-40, 0):
                    for z in (0, 40):
                        corners.InsertNextPoint(x + shift * (z > 0), y, z)
            side(corners)
        spline.SetBasisToR()
        warp.SetAndObserveTransformToParent(spline)
        volume.SetAndObserveTransformNodeID(warp.GetID())
        world = spline.TransformPoint(self.ras(20, 20, 20))
        found = ours.segment(volume, self.markups("Fiducial", "F", world, label="seed 6"), **COARSE)
        self.assertGreater(self.dice(found, volume), 0.95)
        self.assertIs(found.segmentationNode.GetParentTransformNode(), warp)

    def test_other_transform_is_refused(self):
        volume = self.volume()
        found = ours.segment(volume, self.seed(), **COARSE)
        volume.SetAndObserveTransformNodeID(self.transform(self.turned).GetID())
        with self.assertRaisesRegex(flipfree.FlipFreeError, "'ct segmentation' is not under the transform of 'ct'; put"):
            ours.segment(volume, self.seed(), found.segmentationNode, **COARSE)


class Segments(SlicerTest):
    def test_names_and_colors(self):
        volume = self.volume()
        first = ours.segment(volume, self.seed(), name="liver", **COARSE)
        node = first.segmentationNode
        second = ours.segment(volume, self.seed(), node, name="tumor", color=(1, 0, 0), **COARSE)
        again = ours.segment(volume, self.seed(), node, name="liver", color=(0, 0, 1), levels=1, **COARSE)
        segmentation = node.GetSegmentation()
        self.assertEqual(segmentation.GetNumberOfSegments(), 2)
        self.assertEqual(first.segmentID, again.segmentID)
        self.assertEqual(segmentation.GetSegment(second.segmentID).GetColor(), (1, 0, 0))
        color = segmentation.GetSegment(first.segmentID).GetColor()
        numpy.testing.assert_allclose(color, (1, 0xd2 / 255, 0x4a / 255))
        self.assertEqual(self.labels(again, volume).sum(), again.result.labels.sum())
        self.assertEqual(self.labels(second, volume).sum(), second.result.labels.sum())
        self.assertEqual(node.GetNodeReference("referenceImageGeometryRef"), volume)

    def test_undo_and_redo(self):
        volume = self.volume()
        found = ours.segment(volume, self.seed(), **COARSE)
        node, count = found.segmentationNode, found.result.labels.sum()
        corrections = self.markups("Fiducial", "F", self.ras(34, 20, 20), label="inside")
        more = ours.segment(volume, self.seed(), node, corrections, **COARSE).result.labels.sum()
        self.assertGreater(more, count)
        self.assertTrue(ours.undo(node))
        self.assertEqual(self.labels(found, volume).sum(), count)
        self.assertTrue(ours.redo(node))
        self.assertEqual(self.labels(found, volume).sum(), more)
        self.assertFalse(ours.redo(node))
        self.assertTrue(ours.undo(node))
        self.assertTrue(ours.undo(node))
        self.assertEqual(node.GetSegmentation().GetNumberOfSegments(), 0)
        self.assertFalse(ours.undo(node))

    def test_undo_of_the_scene(self):
        """Where it is on, and the node takes part in it."""
        volume = self.volume()
        found = ours.segment(volume, self.seed(), **COARSE)
        self.scene.SetUndoOn()
        found.segmentationNode.UndoEnabledOn()
        corrections = self.markups("Fiducial", "F", self.ras(34, 20, 20), label="inside")
        ours.segment(volume, self.seed(), found.segmentationNode, corrections, **COARSE)
        self.assertNotEqual(self.labels(found, volume).sum(), found.result.labels.sum())
        self.scene.Undo()
        self.assertEqual(self.labels(found, volume).sum(), found.result.labels.sum())

    def test_surfaces(self):
        volume = self.volume()
        first = ours.segment(volume, self.seed(), name="ball", **COARSE)
        node = first.segmentationNode
        rest = slicer.vtkOrientedImageData()
        rest.DeepCopy(node.GetBinaryLabelmapInternalRepresentation(first.segmentID))
        ball = first.result.labels != 0
        shell = numpy.roll(ball, 6, axis=2) & ~ball
        rest.GetPointData().SetScalars(numpy_to_vtk(shell.astype("uint8").ravel(), deep=True))
        second = node.AddSegmentFromBinaryLabelmapRepresentation(rest, "shell", [0, 1, 0])
        found = ours.surfaces(node, exact=True)
        self.assertEqual([one.name for one in found.labels.values()], ["ball", "shell"])
        self.assertEqual([one.voxels for one in found.labels.values()], [ball.sum(), shell.sum()])
        self.assertEqual(found.wrong_voxels, 0)
        for label, identifier in ((1, first.segmentID), (2, second)):
            surface = node.GetClosedSurfaceInternalRepresentation(identifier)
            points = vtk_to_numpy(surface.GetPoints().GetData())
            numpy.testing.assert_array_equal(points, found.surface(label)[0] * [-1, -1, 1])

    def test_segments_that_overlap_are_refused(self):
        volume = self.volume()
        found = ours.segment(volume, self.seed(), name="a", **COARSE)
        ours.segment(volume, self.seed(), found.segmentationNode, name="b", **COARSE)
        with self.assertRaisesRegex(flipfree.FlipFreeError, "segments of 'ct segmentation' overlap.*subtract one"):
            ours.surfaces(found.segmentationNode)
        with self.assertRaisesRegex(flipfree.FlipFreeError, "has no segment with voxels"):
            ours.surfaces(self.node("Segmentation", "empty"))


class Vessels(SlicerTest):
    def test_trace(self):
        volume = self.volume(phantom="vessel", size=96)
        ends = self.markups("Curve", "ends", *([-x, -y, z] for x, y, z in self.phantom.ends))
        found = ours.trace(volume, ends)
        self.assertGreater(self.dice(found, volume), 0.8)
        line = found.centerlineNode
        self.assertEqual(line.GetName(), "vessel centerline")
        points = vtk_to_numpy(line.GetPolyData().GetPoints().GetData())
        numpy.testing.assert_allclose(points * [-1, -1, 1], found.result.branches[0].points)
        again = ours.trace(volume, ends, found.segmentationNode)
        self.assertIs(again.centerlineNode, line)
        seed = self.markups("Fiducial", "F", self.ras(20, 20, 20), label="seed 6")
        with self.assertRaisesRegex(ValueError, "^corrections: a seed is of no use to a vessel"):
            ours.trace(volume, ends, corrections=seed)


class Questions(SlicerTest):
    def test_answer_becomes_a_correction(self):
        volume = self.volume()
        volume.SetAndObserveTransformNodeID(self.transform(OBLIQUE).GetID())
        world = [0.0] * 3
        volume.TransformPointToWorld(self.ras(20, 20, 20), world)
        found = ours.segment(volume, self.markups("Fiducial", "F", world, label="seed 6"), **COARSE)
        asked = flipfree.Question((34.0, 20.0, 20.0), 3.4, included=False, margin=1.0)
        found = _asking(found, (asked, asked))
        node = ours.questions(found)
        self.assertEqual(ours.questions(found, node), node)
        self.assertEqual(node.GetNumberOfControlPoints(), 2)
        self.assertEqual(node.GetNthControlPointLabel(0), "3 ml, out")
        place = [0.0] * 3
        volume.TransformPointToWorld(self.ras(34, 20, 20), place)
        self.assertEqual(node.GetNthControlPointDescription(0), str(dataclasses.replace(asked, place=place)))
        corrections = self.node("MarkupsFiducial", "corrections")
        ours.answer(node, 0, True, corrections)
        self.assertEqual((node.GetNumberOfControlPoints(), corrections.GetNthControlPointLabel(0)), (1, "inside"))
        seed = self.markups("Fiducial", "F", world, label="seed 6")
        again = ours.segment(volume, seed, found.segmentationNode, corrections, **COARSE)
        numpy.testing.assert_allclose(again.result.constraints[0].place, asked.place, atol=1e-6)
        self.assertTrue(self.labels(again, volume)[20, 20, 34])
        with self.assertRaisesRegex(ValueError, "there is no question 1; there are 1"):
            ours.answer(node, 1, False, corrections)


class Panel(SlicerTest):
    """The module's panel, whose widgets are stand-ins: the application itself does not run here."""

    def setUp(self):
        super().setUp()
        self.clicks, self.errors = {}, []
        scene = self.scene

        class Chooser(unittest.mock.MagicMock):
            def connect(self, signal, slot):
                self.slot = slot

            def setCurrentNode(self, node):
                self.currentNode.return_value = node
                _signal(self.slot, node)

            def addNode(self):
                self.setCurrentNode(scene.AddNewNodeByClass(self.nodeTypes[0], self.baseName))

        def button(text):
            widget = unittest.mock.MagicMock()
            widget.clicked.connect.side_effect = lambda action: self.clicks.__setitem__(
                text, lambda: _signal(action, False) if widget.enabled else self.fail(f"{text} cannot be pressed"))
            return widget

        def chooser():
            widget = Chooser(slot=lambda: None)
            widget.currentNode.return_value = None
            return widget

        base = types.SimpleNamespace(ScriptedLoadableModule=object, ScriptedLoadableModuleWidget=type(
            "Base", (), {"setup": lambda self: setattr(self, "layout", unittest.mock.MagicMock())}))
        qt = unittest.mock.MagicMock(QPushButton=button, QLineEdit=lambda text: types.SimpleNamespace(text=text))

        @contextlib.contextmanager
        def shown(message, show=True, waitCursor=False):
            del show, waitCursor
            try:
                yield
            except Exception as error:  # pylint: disable=broad-except
                self.errors.append(f"{message} {error}")

        util = types.SimpleNamespace(tryWithErrorDisplay=shown)
        modules = {"ctk": unittest.mock.MagicMock(), "qt": qt, "slicer.ScriptedLoadableModule": base}
        self.jumps = unittest.mock.MagicMock()
        for patch in (unittest.mock.patch.dict(sys.modules, modules),
                      unittest.mock.patch.multiple(slicer, create=True, qMRMLNodeComboBox=chooser, mrmlScene=scene, util=util,
                                                   app=unittest.mock.MagicMock(), modules=self.jumps)):
            patch.start()
            self.addCleanup(patch.stop)
        path = Path(os.environ["FLIPFREE_PYTHON_SOURCE"]).parent / "Slicer" / "FlipFree" / "FlipFree.py"
        self.panel = types.ModuleType("FlipFree")
        exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), self.panel.__dict__)

    def enabled(self, widget):
        return [button.enabled for button in (widget.runs, *widget.steps, *widget.answers)]

    def chosen(self):
        """The panel with a ball and a seed, and a question after each run."""
        widget = self.panel.FlipFreeWidget()
        widget.setup()
        widget.volume.setCurrentNode(self.volume())
        widget.seeds.setCurrentNode(self.seed("F-1"))
        widget.radius.value = 6
        asked = (flipfree.Question((34.0, 20.0, 20.0), 3.4, included=False, margin=1.0),)
        patch = unittest.mock.patch.object(
            ours, "segment", lambda *a, **k: _asking(self.segment(*a, **k, **COARSE), asked))
        patch.start()
        self.addCleanup(patch.stop)
        return widget

    def test_no_is_no(self):
        widget = self.chosen()
        self.clicks["Run"]()
        self.clicks["No"]()
        self.assertEqual(widget.outside.currentNode().GetNthControlPointLabel(0), "outside")
        self.assertIsNone(widget.inside.currentNode())
        self.assertEqual(self.errors, [])

    def test_buttons_wait_for_what_they_need(self):
        widget = self.panel.FlipFreeWidget()
        widget.setup()
        self.assertEqual(self.enabled(widget), [False] * 5)
        volume = self.volume()
        widget.volume.setCurrentNode(volume)
        self.assertFalse(widget.runs.enabled)
        widget = self.chosen()
        self.assertEqual(self.enabled(widget), [True, False, False, False, False])
        self.clicks["Run"]()
        self.assertEqual(self.enabled(widget), [True] * 5)
        widget.volume.setCurrentNode(volume)  # of which it has not asked
        self.assertEqual((self.enabled(widget), widget.question.text), ([True] * 3 + [False] * 2, ""))
        widget.volume.setCurrentNode(None)
        widget.segmentation.setCurrentNode(None)
        self.assertEqual(self.enabled(widget), [False] * 5)

    def test_undone_results_ask_no_more(self):
        widget = self.chosen()
        for name in ("Undo", "Redo"):
            self.clicks["Run"]()
            if name == "Redo":
                ours.undo(widget.segmentation.currentNode())
            self.assertNotEqual(widget.question.text, "")
            self.clicks[name]()
            self.assertEqual((widget.question.text, self.enabled(widget)[3:]), ("", [False, False]))
            self.assertEqual(widget.questions.GetNumberOfControlPoints(), 0)

    def test_errors_are_shown(self):
        widget = self.chosen()
        widget.seeds.setCurrentNode(self.node("MarkupsFiducial", "F"))
        self.clicks["Run"]()
        self.assertEqual(self.errors, ["No segmentation. seeds: 'F' has no points; place one within the organ"])
        widget.segmentation.setCurrentNode(self.node("Segmentation", "S"))
        with unittest.mock.patch.object(ours, "undo", side_effect=flipfree.FlipFreeError("lost")):
            self.clicks["Undo"]()
        widget.seeds.setCurrentNode(self.seed("F-1"))
        self.clicks["Run"]()
        with unittest.mock.patch.object(ours, "answer", side_effect=flipfree.FlipFreeError("lost")):
            self.clicks["Yes"]()
        self.assertEqual(self.errors[1:], ["No undo. lost", "No answer. lost"])

    def test_run_answer_undo(self):
        widget = self.chosen()
        self.assertEqual(list(self.clicks), ["Run", "Undo", "Redo", "Yes", "No"])
        volume = widget.volume.currentNode()
        self.clicks["Run"]()
        node = widget.segmentation.currentNode()
        count = self.labels(widget.found, volume).sum()
        self.assertEqual(widget.question.text, "Is the part of 3 ml at (-34, -20, 20) mm organ? It is left out.")
        self.jumps.markups.logic().JumpSlicesToLocation.assert_called_with(*self.ras(34, 20, 20), True)
        self.clicks["Yes"]()
        self.assertEqual(widget.inside.currentNode().GetNthControlPointLabel(0), "inside")
        more = self.labels(widget.found, volume).sum()
        self.assertGreater(more, count)
        self.clicks["Undo"]()
        self.assertEqual(self.labels(widget.found, volume).sum(), count)
        self.clicks["Redo"]()
        self.assertEqual((self.labels(widget.found, volume).sum(), node.GetSegmentation().GetNumberOfSegments()), (more, 1))
        self.assertEqual(self.errors, [])

    segment = staticmethod(ours.segment)


def _signal(slot, argument):
    """As PythonQt calls a slot: with the argument, if it takes one by its position."""
    kinds = [parameter.kind for parameter in inspect.signature(slot).parameters.values()]
    positional = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.VAR_POSITIONAL)
    slot(*([argument] if any(kind in positional for kind in kinds) else []))


def _asking(found, questions):
    """The ball itself raises no question."""
    return dataclasses.replace(found, result=dataclasses.replace(found.result, questions=questions))


class Guide(unittest.TestCase):
    def test_lines(self):
        """They print what the page says."""
        source = Path(os.environ["FLIPFREE_PYTHON_SOURCE"]).parents[1]
        page = (source / "Examples" / "Guide" / "slicer.md").read_text(encoding="utf-8")
        [(program, printed)] = re.findall(r"(?s)```python\n(.*?)```\n\nIt prints:\n\n```\n(.*?)```", page)
        with tempfile.TemporaryDirectory() as folder:
            process = subprocess.run([sys.executable, "-c", program], cwd=folder, capture_output=True, text=True, check=True)
        numbers = r"\d+(?= iterations)|[\d.]+(?= ml)|(?<=confidence )[\d.]+"  # another processor may round otherwise
        self.assertEqual(re.sub(numbers, "", process.stdout), re.sub(numbers, "", printed))


class Errors(SlicerTest):
    def test_messages(self):
        volume = self.volume()
        empty = self.node("ScalarVolume", "nothing")
        colors = self.volume(name="colors")
        colors.GetImageData().AllocateScalars(3, 3)
        bad = self.markups("Fiducial", "points", self.ras(1, 1, 1), label="F-1")
        for arguments, keywords, message in (
                ((empty, self.seed()), {}, "^volumeNode: 'nothing' has no voxels; load a volume"),
                ((colors, self.seed()), {}, "^volumeNode: 'colors' has 3 components"),
                ((volume, None), {}, "^seeds: a markups node is needed, not None"),
                ((volume, volume), {}, "^seeds: a markups node is needed"),
                ((volume, (20, 20, 20)), {}, r"^seeds: a markups node is needed, not \(20, 20, 20\)"),
                ((volume, bad), {"radius": "big"}, "^radius: "),
                ((volume, self.node("MarkupsFiducial", "F")), {}, "^seeds: 'F' has no points"),
                ((volume, bad), {}, "^radius: it is needed for seeds that are points"),
                ((volume, self.seed("seed big")), {}, """^'seeds', control point "seed big": 'big' is not a number"""),
                ((volume, self.seed()), {"corrections": bad}, """^'points', control point "F-1": the kind is 'f'"""),
                ((volume, self.seed()), {"level": 2}, "^segment.. has no parameter 'level'; did you mean 'levels'")):
            with self.subTest(message), self.assertRaisesRegex((TypeError, ValueError), message):
                ours.segment(*arguments, **keywords)


if __name__ == "__main__":
    unittest.main()
