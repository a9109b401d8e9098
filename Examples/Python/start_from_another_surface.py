"""Starts from another surface than a sphere: from any closed mesh of triangles or polygons.

    python3 start_from_another_surface.py --start atlas.stl ct.nii.gz --seed 83 -154 321 --radius 26

The method needs four neighbors at every vertex. Where a mesh has others, it takes the mesh of the
midpoints of its edges, which has them everywhere: each edge lies on two faces, and in each of them
it has a neighbor on either side. Without --start, an ellipsoid serves as the other mesh.
"""

import argparse

import flipfree
import inputs
import numpy
import scene
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkPlatonicSolidSource
from vtkmodules.vtkIOGeometry import vtkSTLReader


def turned_outwards(surface):
    """Faces counter-clockwise seen from outside, whatever the program that made them thought."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(surface)
    normals.SplittingOff()
    normals.ConsistencyOn()
    normals.AutoOrientNormalsOn()
    normals.Update()
    return normals.GetOutput()


def read_stl(name):
    """STL repeats its vertices in every triangle; the reader joins them again."""
    reader = vtkSTLReader()
    reader.SetFileName(name)
    clean = vtkCleanPolyData()
    clean.SetInputConnection(reader.GetOutputPort())
    clean.Update()
    return clean.GetOutput()


def ellipsoid(center, radii):
    """A mesh like any other, from a refined icosahedron: five or six triangles at its vertices."""
    solid = vtkPlatonicSolidSource()
    solid.SetSolidTypeToIcosahedron()
    fine = vtkLinearSubdivisionFilter()
    fine.SetInputConnection(solid.GetOutputPort())
    fine.SetNumberOfSubdivisions(2)
    fine.Update()
    surface = fine.GetOutput()
    points = vtk_to_numpy(surface.GetPoints().GetData())  # a view
    points /= numpy.linalg.norm(points, axis=1, keepdims=True)
    points[:] = center + points * radii
    return surface


parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--start", help="STL file of a closed surface, in the image's coordinates")
arguments = inputs.parse(__doc__, parser)
image, seed, radius = inputs.image_and_seed(arguments)
start = turned_outwards(read_stl(arguments.start) if arguments.start
                        else ellipsoid(seed, (45, 30, 35)))

# The seed still tells what the organ looks like. The surface is refined to about 6,144 vertices, as
# many as one that starts from a sphere has; `resolution` sets their number.
organ = flipfree.segment(image, seed, radius, start=start)
print(f"start from {start.GetNumberOfCells()} faces")
print(organ)

if arguments.picture:
    def view(surface, caption):
        return scene.space_view([scene.surface_actor(surface, edges=True)], caption,
                                bounds=organ.surface.GetBounds(), zoom=1.3)

    plane = scene.CORONAL
    scene.write_picture(arguments.picture, [[
        view(start, "the start"),
        view(organ.surface, "the organ"),
        scene.slice_view([scene.slice_actor(image, seed, plane),
                          scene.contour_actor(start, seed, plane, scene.BLUE),
                          scene.contour_actor(organ.surface, seed, plane)],
                         organ.surface, plane, [("organ", scene.YELLOW), ("start", scene.BLUE)])]],
        size=420)
