"""Tetrahedra by TetGen, and as objects of VTK's."""

import contextlib
import os
import subprocess

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkPlane, vtkUnstructuredGrid
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality


def write_off(points, triangles, name):
    """All digits of the points."""
    with open(name, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        numpy.savetxt(file, points, fmt="%.17g")
        numpy.savetxt(file, triangles, fmt="3 %d %d %d")


class Refused(Exception):
    """TetGen does not fill these surfaces."""


def fill(name):
    """The points, the tetrahedra, and the number of the region of each.

    Elements are well shaped (-q), and the surfaces stay as they are (-Y).
    """
    stem = os.path.splitext(name)[0] + ".1"
    with contextlib.suppress(FileNotFoundError):
        os.remove(stem + ".ele")
    try:
        subprocess.run(["tetgen", "-pqAYQ", name], check=True, capture_output=True, timeout=600)
        with open(stem + ".ele", encoding="ascii") as file:
            if int(file.readline().split()[0]) == 0:  # what is not closed encloses nothing
                raise Refused(f"'{name}' encloses nothing")
            elements = numpy.loadtxt(file, dtype=int, ndmin=2)
    except (subprocess.CalledProcessError, FileNotFoundError) as error:
        raise Refused(f"TetGen does not fill '{name}'") from error
    points = numpy.loadtxt(stem + ".node", skiprows=1)[:, 1:4]
    return points, elements[:, 1:5], elements[:, 5]


def grid_of(points, tetrahedra, labels=None):
    """As vtkUnstructuredGrid; the labels, if any, are an array of its cells."""
    grid_points = vtkPoints()
    grid_points.SetData(numpy_to_vtk(points, deep=True))
    cells = vtkCellArray()
    cells.SetData(4, numpy_to_vtkIdTypeArray(tetrahedra.ravel(), deep=True))
    grid = vtkUnstructuredGrid()
    grid.SetPoints(grid_points)
    grid.SetCells(VTK_TETRA, cells)
    if labels is not None:
        array = numpy_to_vtk(labels.astype(numpy.int32), deep=True)
        array.SetName("Label")
        grid.GetCellData().SetScalars(array)
    return grid


def shapes_of(grid):
    """Three times the radius of the inscribed sphere over that of the circumscribed one: 1 at best."""
    quality = vtkMeshQuality()
    quality.SetInputData(grid)
    quality.SetTetQualityMeasureToRadiusRatio()
    quality.Update()
    return 1 / vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality"))


def cut_open(grid, center):
    """The tetrahedra behind a coronal plane, whole ones, and what one sees of them."""
    plane = vtkPlane()
    plane.SetOrigin(center)
    plane.SetNormal(0, -1, 0)
    behind = vtkExtractGeometry()
    behind.SetInputData(grid)
    behind.SetImplicitFunction(plane)
    behind.ExtractInsideOn()
    outside = vtkGeometryFilter()
    outside.SetInputConnection(behind.GetOutputPort())
    outside.Update()
    return outside.GetOutput()
