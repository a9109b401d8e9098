"""FlipFree in 3D Slicer: the nodes of a scene in, segments of a segmentation node out.

    import flipfree.slicer

    found = flipfree.slicer.segment(volumeNode, seeds=roiNode, name="liver")
    questionsNode = flipfree.slicer.questions(found)
    flipfree.slicer.answer(questionsNode, 0, True, corrections=correctionsNode)
    found = flipfree.slicer.segment(volumeNode, seeds=roiNode, name="liver",
                                    corrections=correctionsNode,
                                    segmentationNode=found.segmentationNode)
    flipfree.slicer.undo(found.segmentationNode)

Points are taken from where they are in the world, through all transforms of their node and of the
volume; a segmentation is under the volume's own transform. Nodes are RAS, as always in 3D Slicer,
results are LPS, as always in this package, in the volume's own space. It runs in 3D Slicer's Python
and in any Python with `pip install slicer-core`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from ._coordinates import swap_lps_ras
from ._corrections import Constraint
from ._errors import FlipFreeError
from ._extras import missing
from ._foreign import image_from_affine
from ._image import Image
from ._parameters import radius_of
from ._point_files import arguments_of, points_of_controls
from ._segment import segment as segment_organ
from ._segmentation import Segmentation, Surface, Vessel, surface_of_label
from ._segments import COLORS
from ._surfaces import LabelSurfaces
from ._surfaces import surfaces as surfaces_of_labels
from ._trace import trace as trace_vessel

try:
    import slicer
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkIntArray, vtkStringArray
    from vtkmodules.vtkCommonMath import vtkMatrix4x4

    from ._vtk_objects import polydata_of, polylines_of
except ModuleNotFoundError as error:
    raise ImportError(missing("slicer", "flipfree.slicer", "slicer", error)) from error

# Between the LPS of results and the RAS of nodes.
SIGNS = (-1.0, -1.0, 1.0)
CLOSED_SURFACE = slicer.vtkSegmentationConverter.GetSegmentationClosedSurfaceRepresentationName()
BINARY_LABELMAP = slicer.vtkSegmentationConverter.GetSegmentationBinaryLabelmapRepresentationName()
_FACTORY = slicer.vtkSegmentationConverterFactory.GetInstance()
if _FACTORY.ConstructRepresentationObjectByRepresentation(CLOSED_SURFACE) is None:
    # Without the application, nobody has registered the kinds of representations yet.
    slicer.vtkSlicerSegmentationsModuleLogic().SetMRMLScene(slicer.vtkMRMLScene())


@dataclass(frozen=True)
class Found:
    """A result and the segment that shows it."""

    result: Segmentation
    """What flipfree.segment or flipfree.trace has returned, in LPS mm of the volume's own space."""

    volumeNode: Any
    segmentationNode: Any
    segmentID: str
    centerlineNode: Any = None
    """Of a vessel, a model of a line per branch."""


def segment(
    volumeNode: Any,
    seeds: Any,
    segmentationNode: Any = None,
    corrections: Any = None,
    *,
    radius: float | None = None,
    name: str = "organ",
    color: Sequence[float] | None = None,
    **parameters: Any,
) -> Found:
    """Segments the organ around seeds; the segment of that name is replaced, or a new one is added.

    seeds
        A markups ROI, whose greatest sphere is the seed; a line from the center of the seed to its
        rim; or points, each the center of a sphere of `radius` mm, or of the radius in its label,
        `seed 12`.
    segmentationNode
        Where the segment goes; a new node unless given. It has to be under the volume's transform.
    corrections
        A markups node, or several, of points whose labels begin with inside, outside, boundary, or
        with seed and a radius: so do those of lists that have these names.
    name, color
        Of the segment; color is red, green and blue, 0 to 1. A segment that is there keeps its own.

    The segment's closed surface is the result's, not one that 3D Slicer makes of the label map. The
    other parameters are those of flipfree.segment. undo() takes the step back.
    """
    _require_same_transform(volumeNode, segmentationNode)
    spheres = _spheres_of(volumeNode, seeds, radius)
    points = arguments_of(_constraints_of(volumeNode, corrections))
    points["seeds"] = spheres[1:] + points["seeds"]
    center, size = spheres[0]
    result = segment_organ(_image_of(volumeNode), center, size, **points, **parameters)
    node, identifier = _shown(volumeNode, segmentationNode, result, name, color)
    return Found(result, volumeNode, node, identifier)


def trace(
    volumeNode: Any,
    points: Any,
    segmentationNode: Any = None,
    corrections: Any = None,
    *,
    name: str = "vessel",
    color: Sequence[float] | None = None,
    **parameters: Any,
) -> Found:
    """Segments a vessel between the control points of a markups node, such as a list or a curve.

    The centerline becomes a model of the name with ` centerline`, new or there already, which
    undo() leaves as it is. Nodes are as in segment(); the other parameters are those of
    flipfree.trace.
    """
    _require_same_transform(volumeNode, segmentationNode)
    places = [place for _, place in _controls_of(volumeNode, "points", points)]
    kinds = arguments_of(_constraints_of(volumeNode, corrections))
    if kinds.pop("seeds"):
        raise ValueError(
            "corrections: a seed is of no use to a vessel; add a point along it to points"
        )
    result = trace_vessel(_image_of(volumeNode), places, **kinds, **parameters)
    node, identifier = _shown(volumeNode, segmentationNode, result, name, color)
    return Found(result, volumeNode, node, identifier, _centerline_of(volumeNode, result, name))


def surfaces(segmentationNode: Any, **parameters: Any) -> LabelSurfaces:
    """Makes a closed surface of each segment; two segments have one wall between them.

    They take the place of the surfaces that 3D Slicer makes. The labels of the answer, in LPS, are
    the numbers of the segments, from 1 on. Segments must not overlap. The parameters are those of
    flipfree.surfaces.
    """
    segmentation = segmentationNode.GetSegmentation()
    _require_apart(segmentationNode)
    identifiers, values, merged = vtkStringArray(), vtkIntArray(), slicer.vtkOrientedImageData()
    names = {}
    for index in range(segmentation.GetNumberOfSegments()):
        identifiers.InsertNextValue(segmentation.GetNthSegmentID(index))
        values.InsertNextValue(index + 1)
        names[index + 1] = segmentation.GetNthSegment(index).GetName()
    effective = slicer.vtkSegmentation.EXTENT_UNION_OF_EFFECTIVE_SEGMENTS
    if not names or not segmentationNode.GenerateMergedLabelmapForAllSegments(
        merged, effective, None, identifiers, values
    ):
        raise FlipFreeError(
            f"segmentationNode: '{segmentationNode.GetName()}' has no segment with voxels"
        )
    matrix = vtkMatrix4x4()
    merged.GetImageToWorldMatrix(matrix)
    labels = replace(_image_at("segmentationNode", merged, matrix), names=names)
    found = surfaces_of_labels(labels, **parameters)
    _save_state(segmentationNode)
    for label, measures in found.labels.items():
        one = segmentation.GetNthSegment(label - 1)
        one.RemoveRepresentation(CLOSED_SURFACE)
        if measures.triangles:
            one.AddRepresentation(CLOSED_SURFACE, _in_ras(surface_of_label(found, label)))
    _show(segmentationNode)
    return found


def questions(found: Found, markupsNode: Any = None) -> Any:
    """The questions of a result as a list of points: a new one, or that given, emptied.

    A label says how large the part is and whether it is in, a description asks, in RAS. answer()
    answers one.
    """
    scene = found.volumeNode.GetScene()
    node = markupsNode or scene.AddNewNodeByClass("vtkMRMLMarkupsFiducialNode", "questions")
    node.RemoveAllControlPoints()
    for question in found.result.questions:
        place = [0.0] * 3
        found.volumeNode.TransformPointToWorld(swap_lps_ras(question.place), place)
        asked = replace(question, place=(place[0], place[1], place[2]))
        state = "in" if question.included else "out"
        index = node.AddControlPointWorld(place, f"{question.volume:.0f} ml, {state}")
        node.SetNthControlPointDescription(index, str(asked))
    return node


def answer(questionsNode: Any, number: int, yes: bool, corrections: Any) -> None:
    """Yes, it is a part of the organ, or no: the question, from 0 on, becomes a correction.

    segment() with these corrections gives the segmentation with the answer; to take it back, remove
    the point.
    """
    count = questionsNode.GetNumberOfControlPoints()
    if number not in range(count):
        raise ValueError(f"number: there is no question {number!r}; there are {count}")
    place = [0.0] * 3
    questionsNode.GetNthControlPointPositionWorld(number, place)
    index = corrections.AddControlPointWorld(place, "inside" if yes else "outside")
    corrections.SetNthControlPointDescription(
        index, questionsNode.GetNthControlPointDescription(number)
    )
    questionsNode.RemoveNthControlPoint(number)


def undo(segmentationNode: Any) -> bool:
    """Takes back what the last call has changed in the segmentation; False if there is nothing."""
    history = _history_of(segmentationNode)
    return bool(history.IsRestorePreviousStateAvailable() and history.RestorePreviousState())


def redo(segmentationNode: Any) -> bool:
    """Makes again what undo() has taken back; False if there is nothing."""
    history = _history_of(segmentationNode)
    return bool(history.IsRestoreNextStateAvailable() and history.RestoreNextState())


def _image_of(volumeNode: Any) -> Image:
    data = volumeNode.GetImageData()
    if data is None or data.GetPointData().GetScalars() is None:
        raise ValueError(f"volumeNode: '{volumeNode.GetName()}' has no voxels; load a volume")
    if data.GetNumberOfScalarComponents() != 1:
        raise ValueError(
            f"volumeNode: '{volumeNode.GetName()}' has {data.GetNumberOfScalarComponents()} "
            "components; a scalar volume is needed (Vector to Scalar Volume makes one)"
        )
    return _image_at("volumeNode", data, _matrix_of(volumeNode))


def _matrix_of(volumeNode: Any) -> Any:
    matrix = vtkMatrix4x4()
    volumeNode.GetIJKToRASMatrix(matrix)
    return matrix


def _image_at(name: str, data: Any, matrix: Any) -> Image:
    """The voxels of a vtkImageData; the matrix takes indices, whose first need not be 0, to RAS."""
    import numpy

    affine = numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
    affine[:3, 3] = (affine @ [*data.GetExtent()[::2], 1])[:3]
    voxels = vtk_to_numpy(data.GetPointData().GetScalars()).reshape(data.GetDimensions()[::-1])
    return image_from_affine(name, voxels, affine)


def _require_same_transform(volumeNode: Any, segmentationNode: Any) -> None:
    if segmentationNode is None or not segmentationNode.GetSegmentation().GetNumberOfSegments():
        return  # it will be put there
    if segmentationNode.GetParentTransformNode() is not volumeNode.GetParentTransformNode():
        raise FlipFreeError(
            f"segmentationNode: '{segmentationNode.GetName()}' is not under the transform of "
            f"'{volumeNode.GetName()}'; put both under the same one, or harden their transforms"
        )


def _require_apart(segmentationNode: Any) -> None:
    """Segments that share a layer do not overlap: those of a copy that will not share one do."""
    copy = slicer.vtkSegmentation()
    copy.DeepCopy(segmentationNode.GetSegmentation())
    copy.CollapseBinaryLabelmaps(False)
    if copy.GetNumberOfLayers(BINARY_LABELMAP) > 1:
        raise FlipFreeError(
            f"segmentationNode: segments of '{segmentationNode.GetName()}' overlap, or differ in "
            "their grids; subtract one from the other (Segment Editor > Logical operators)"
        )


def _in_volume(volumeNode: Any, world: Sequence[float]) -> tuple[float, ...]:
    """A point of the world (RAS) in LPS millimeters of the volume's own space."""
    place = [0.0] * 3
    volumeNode.TransformPointFromWorld(world, place)
    return tuple(swap_lps_ras(place))


def _require_markups(name: str, node: Any) -> None:
    if not hasattr(node, "GetNthControlPointPositionWorld"):
        raise TypeError(f"{name}: a markups node is needed, not {node!r:.80}")


def _controls_of(
    volumeNode: Any, name: str, markupsNode: Any
) -> list[tuple[str, tuple[float, ...]]]:
    """Labels and places of the control points that have been placed."""
    _require_markups(name, markupsNode)
    controls = []
    for index in range(markupsNode.GetNumberOfControlPoints()):
        if markupsNode.GetNthControlPointPositionStatus(index) == markupsNode.PositionDefined:
            world = [0.0] * 3
            markupsNode.GetNthControlPointPositionWorld(index, world)
            label = markupsNode.GetNthControlPointLabel(index)
            controls.append((label, _in_volume(volumeNode, world)))
    return controls


def _spheres_of(
    volumeNode: Any, seeds: Any, radius: float | None
) -> list[tuple[tuple[float, ...], float]]:
    """Centers and radii, in the volume's own space."""
    import math

    _require_markups("seeds", seeds)
    if seeds.IsA("vtkMRMLMarkupsROINode"):
        rims, center, sizes = [], [0.0] * 3, [0.0] * 3
        seeds.GetCenterWorld(center)
        seeds.GetSizeWorld(sizes)
        for axis, size in enumerate(sizes):
            direction = [0.0] * 3
            seeds.GetAxisWorld(axis, direction)
            rims.append([c + size / 2 * d for c, d in zip(center, direction)])
        middle = _in_volume(volumeNode, center)
        return [(middle, min(math.dist(middle, _in_volume(volumeNode, rim)) for rim in rims))]
    controls = _controls_of(volumeNode, "seeds", seeds)
    if not controls:
        raise ValueError(f"seeds: '{seeds.GetName()}' has no points; place one within the organ")
    if seeds.IsA("vtkMRMLMarkupsLineNode") and len(controls) == 2:
        (_, middle), (_, rim) = controls
        return [(middle, math.dist(middle, rim))]
    labels = [label for label, _ in controls]
    if radius is not None:
        size = radius_of("radius", radius)
        labels = [label if label.startswith("seed ") else f"seed {size!r}" for label in labels]
    elif not all(label.startswith("seed ") for label in labels):
        raise TypeError(
            "radius: it is needed for seeds that are points, in mm; or label each 'seed 12', "
            "or place an ROI"
        )
    places = [place for _, place in controls]
    return [(one.place, one.radius) for one in points_of_controls(seeds.GetName() or "", zip(labels, places))]


def _constraints_of(volumeNode: Any, corrections: Any) -> list[Constraint]:
    several = corrections if isinstance(corrections, (list, tuple)) else [corrections]
    constraints: list[Constraint] = []
    for node in several:
        if node is not None:
            controls = _controls_of(volumeNode, "corrections", node)
            constraints += points_of_controls(node.GetName() or "", controls)
    return constraints


def _shown(
    volumeNode: Any,
    segmentationNode: Any,
    result: Segmentation,
    name: str,
    color: Sequence[float] | None,
) -> tuple[Any, str]:
    """The segmentation node, and the identifier of the segment that has the result now."""
    node = segmentationNode or volumeNode.GetScene().AddNewNodeByClass(
        "vtkMRMLSegmentationNode", f"{volumeNode.GetName()} segmentation"
    )
    segmentation = node.GetSegmentation()
    if not segmentation.GetNumberOfSegments():
        node.SetReferenceImageGeometryParameterFromVolumeNode(volumeNode)
        parent = volumeNode.GetParentTransformNode()
        node.SetAndObserveTransformNodeID(parent.GetID() if parent else None)
    _save_state(node)
    labels = _oriented(result.label_map, volumeNode)
    identifier: str = segmentation.GetSegmentIdBySegmentName(name)
    if identifier:
        slicer.vtkSlicerSegmentationsModuleLogic.SetBinaryLabelmapToSegment(
            labels, node, identifier
        )
    else:
        next_color = COLORS[segmentation.GetNumberOfSegments() % len(COLORS)]
        default = [int(next_color[at : at + 2], 16) / 255 for at in (1, 3, 5)]
        identifier = node.AddSegmentFromBinaryLabelmapRepresentation(labels, name, color or default)
    segmentation.GetSegment(identifier).AddRepresentation(CLOSED_SURFACE, _in_ras(result.mesh))
    _show(node)
    return node, identifier


def _oriented(labels: Image, volumeNode: Any) -> Any:
    """With the volume's indices, of which the first need not be 0."""
    image = slicer.vtkOrientedImageData()
    image.SetExtent(volumeNode.GetImageData().GetExtent())
    image.SetImageToWorldMatrix(_matrix_of(volumeNode))
    image.GetPointData().SetScalars(numpy_to_vtk(labels.voxels.ravel(), deep=True))
    return image


def _in_ras(mesh: Surface) -> Any:
    turned = replace(mesh, points=mesh.points * SIGNS, displacements=mesh.displacements * SIGNS)
    return polydata_of(turned)


def _centerline_of(volumeNode: Any, vessel: Vessel, name: str) -> Any:
    scene = volumeNode.GetScene()
    name = f"{name} centerline"
    node = scene.GetFirstNode(name, "vtkMRMLModelNode") or scene.AddNewNodeByClass(
        "vtkMRMLModelNode", name
    )
    branches = [replace(branch, points=branch.points * SIGNS) for branch in vessel.branches]
    node.SetAndObservePolyData(polylines_of(branches))
    parent = volumeNode.GetParentTransformNode()
    node.SetAndObserveTransformNodeID(parent.GetID() if parent else None)
    node.CreateDefaultDisplayNodes()
    return node


def _show(segmentationNode: Any) -> None:
    """With the surfaces in 3D."""
    segmentationNode.CreateDefaultDisplayNodes()
    display = segmentationNode.GetDisplayNode()
    if display is not None:
        display.SetPreferredDisplayRepresentationName3D(CLOSED_SURFACE)


def _history_of(segmentationNode: Any) -> Any:
    """As long as the node lives."""
    history = getattr(segmentationNode, "flipfree_history", None)
    if history is None:
        history = slicer.vtkSegmentationHistory()
        history.SetSegmentation(segmentationNode.GetSegmentation())
        segmentationNode.flipfree_history = history
    return history


def _save_state(segmentationNode: Any) -> None:
    """For undo(), and for that of the scene, where it is on."""
    _history_of(segmentationNode).SaveState()
    segmentationNode.GetScene().SaveStateForUndo()
