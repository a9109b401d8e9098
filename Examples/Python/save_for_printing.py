"""Saves an organ for a 3D printer (STL) and for volume meshing (OFF, and tetrahedra by TetGen).

    python3 save_for_printing.py --folder liver-files
    python3 save_for_printing.py ct.nii.gz --seed 83 -154 321 --radius 26 --folder liver-files

The surface needs no repair. What is left to see to is the file format: STL keeps single precision
only, and no neighborhoods, so the file is read back and checked as a printer's program will see
it.
"""

import argparse
import os
import shutil
import subprocess

import flipfree
import inputs
import numpy
import scene
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkPlane, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkMassProperties
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOGeometry import vtkSTLReader, vtkSTLWriter


def write_stl(surface, name):
    """Binary STL, in millimeters, which is what printing programs take the numbers for."""
    writer = vtkSTLWriter()
    writer.SetInputData(scene.triangles_of(surface))
    writer.SetFileName(name)
    writer.SetFileTypeToBinary()
    writer.Write()


def defects_of(stl):
    """What a printer's program would have to repair, as vtkSurfaceValidity counts it."""
    reader = vtkSTLReader()  # joins the vertices again
    reader.SetFileName(stl)
    validity = flipfree.vtkSurfaceValidity()
    validity.SetInputConnection(reader.GetOutputPort())
    validity.Update()
    row = validity.GetMeasures()
    return {name: row.GetValueByName(0, name).ToInt()
            for name in ("SelfIntersections", "BoundaryEdges", "NonManifoldEdges")}


def write_off(organ, name):
    """All digits of the vertices, and the very triangles that are certified."""
    with open(name, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(organ.points)} {len(organ.triangles)} 0\n")
        numpy.savetxt(file, organ.points, fmt="%.17g")
        numpy.savetxt(file, organ.triangles, fmt="3 %d %d %d")


def tetrahedra_of(off):
    """By TetGen, with well-shaped elements (-q) and no change to the surface (-Y)."""
    subprocess.run(["tetgen", "-pqYQ", off], check=True, capture_output=True)
    stem = os.path.splitext(off)[0] + ".1"
    nodes = numpy.loadtxt(stem + ".node", skiprows=1)[:, 1:4]
    corners = numpy.loadtxt(stem + ".ele", skiprows=1, dtype=int)[:, 1:5]
    return nodes, corners


def grid_of(nodes, corners):
    """As an object of VTK's."""
    points = vtkPoints()
    points.SetData(numpy_to_vtk(nodes, deep=True))
    cells = vtkCellArray()
    cells.SetData(4, numpy_to_vtkIdTypeArray(corners.ravel(), deep=True))
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.SetCells(VTK_TETRA, cells)
    return grid


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


parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--folder", default="organ-files", help="where to save (default: organ-files)")
arguments = inputs.parse(__doc__, parser)
image, seed, radius = inputs.image_and_seed(arguments)
organ = flipfree.segment(image, seed, radius)

os.makedirs(arguments.folder, exist_ok=True)
stl = os.path.join(arguments.folder, "organ.stl")
write_stl(organ.surface, stl)
low, high = organ.points.min(axis=0), organ.points.max(axis=0)
size = " x ".join(f"{extent:.0f}" for extent in high - low)
properties = vtkMassProperties()
properties.SetInputData(scene.triangles_of(organ.surface))
print(f"{stl}: {size} mm, {properties.GetVolume() / 1000:.0f} ml of material if it is solid")
print(", ".join(f"{name} {count}" for name, count in defects_of(stl).items()))

off = os.path.join(arguments.folder, "organ.off")
write_off(organ, off)
print(f"{off}: {len(organ.points)} vertices, {len(organ.triangles)} triangles")

views = [scene.space_view([scene.surface_actor(scene.triangles_of(organ.surface), edges=True)],
                          "to print", zoom=1.4)]
if shutil.which("tetgen"):
    nodes, corners = tetrahedra_of(off)
    print(f"TetGen: {len(corners)} tetrahedra")
    inside = cut_open(grid_of(nodes, corners), organ.surface.GetCenter())
    tetrahedra = scene.surface_actor(inside, edges=True)
    tetrahedra.GetProperty().SetInterpolationToFlat()
    views.append(scene.space_view([tetrahedra], "tetrahedra, cut open", zoom=1.4,
                                  bounds=organ.surface.GetBounds()))
else:
    print("tetgen is not installed, so there are no tetrahedra")

if arguments.picture:
    scene.write_picture(arguments.picture, [views], size=600)
