"""Surfaces and images as VTK's objects and back, for any VTK; to import this needs one."""

from __future__ import annotations

from typing import Any

from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData

from ._branches import Branch
from ._image import Image
from ._segmentation import Surface, joined


def polydata_of(mesh: Surface, surface: Any = None) -> Any:
    """A vtkPolyData, a new one unless given, with the arrays of the toolkit's filter."""
    surface = vtkPolyData() if surface is None else surface
    points, polys = vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(mesh.points))
    polys.SetData(
        numpy_to_vtkIdTypeArray(mesh.offsets.astype("int64"), deep=True),
        numpy_to_vtkIdTypeArray(mesh.corners.astype("int64"), deep=True),
    )
    surface.SetPoints(points)
    surface.SetPolys(polys)
    numbers = {"Certified": float(mesh.certified)}
    arrays = {"Displacement": mesh.displacements, "Correspondence": mesh.correspondence}
    if mesh.vertex_confidence is not None:
        arrays["Confidence"] = mesh.vertex_confidence
        numbers["Confidence"] = mesh.confidence
    for name, values in arrays.items():
        array = numpy_to_vtk(values)
        array.SetName(name)
        surface.GetPointData().AddArray(array)
    for name, number in numbers.items():
        field = vtkDoubleArray()
        field.SetName(name)
        field.InsertNextValue(number)
        surface.GetFieldData().AddArray(field)
    if mesh.provenance:
        text = vtkStringArray()
        text.SetName("Provenance")
        text.InsertNextValue(mesh.provenance)
        surface.GetFieldData().AddArray(text)
    return surface


def polylines_of(branches: list[Branch]) -> Any:
    """The centerline of a vessel as a vtkPolyData, with the arrays of the toolkit's filter."""
    import numpy

    line, points, lines = vtkPolyData(), vtkPoints(), vtkCellArray()
    columns = joined(branches)
    points.SetData(numpy_to_vtk(columns["points"], deep=True))
    lines.SetData(
        numpy_to_vtkIdTypeArray(columns["ends"].astype("int64"), deep=True),
        numpy_to_vtkIdTypeArray(numpy.arange(len(columns["points"]), dtype="int64"), deep=True),
    )
    line.SetPoints(points)
    line.SetLines(lines)
    for data, name, values in (
        (line.GetPointData(), "Radius", columns["radius"]),
        (line.GetPointData(), "ArcLength", columns["length"]),
        (line.GetCellData(), "Parent", columns["parent"]),
    ):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.AddArray(array)
    return line


def imagedata_of(image: Image, data: Any = None) -> Any:
    """A vtkImageData, a new one unless given, which shares the voxels."""
    data = vtkImageData() if data is None else data
    data.SetDimensions(*image.voxels.shape[::-1])
    data.SetSpacing(image.spacing)
    data.SetOrigin(image.origin)
    data.SetDirectionMatrix(*image.direction)
    scalars = numpy_to_vtk(image.voxels.ravel())
    scalars.SetName("ImageScalars")
    data.GetPointData().SetScalars(scalars)
    return data


def surface_of_vtk(data: Any) -> Surface:
    """The polygons of a vtkPolyData, such as a pyvista.PolyData; triangles in place of its strips."""
    import numpy

    corners, offsets = _cells_of(data.GetPolys())
    strips = _triangles_of_strips(*_cells_of(data.GetStrips()))
    ends = len(corners) + 3 * numpy.arange(1, len(strips) + 1)
    has_points = data.GetNumberOfPoints() > 0
    points = vtk_to_numpy(data.GetPoints().GetData()) if has_points else numpy.zeros((0, 3))
    certified = data.GetFieldData().GetArray("Certified")
    return Surface(
        points=points.astype(numpy.float64),
        corners=numpy.concatenate([corners, numpy.ravel(strips)]).astype(numpy.int32),
        offsets=numpy.concatenate([offsets, ends]).astype(numpy.int32),
        displacements=numpy.zeros((len(points), 3)),
        correspondence=numpy.zeros(len(points), numpy.uint8),
        certified=certified is not None and certified.GetTuple1(0) == 1,
    )


def _cells_of(cells: Any) -> tuple[Any, Any]:
    return vtk_to_numpy(cells.GetConnectivityArray()), vtk_to_numpy(cells.GetOffsetsArray())


def _triangles_of_strips(corners: Any, offsets: Any) -> list[tuple[int, int, int]]:
    """Every other triangle of a strip is turned round."""
    triangles = []
    for begin, end in zip(offsets[:-1], offsets[1:]):
        strip = corners[begin:end].tolist()
        for turn, (a, b, c) in enumerate(zip(strip, strip[1:], strip[2:])):
            triangles.append((b, a, c) if turn % 2 else (a, b, c))
    return triangles
