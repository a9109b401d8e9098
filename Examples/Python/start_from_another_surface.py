"""Starts from another surface than a sphere: from any closed mesh of triangles or polygons.

    python3 start_from_another_surface.py --start atlas.stl ct.nii.gz --seed 83 -154 321 --radius 26

The method needs four neighbors at every vertex. The mesh whose vertices are the midpoints of
another one's edges has them everywhere: each edge lies on two faces, and in each of them it has a
neighbor on either side. Without --start, an ellipsoid serves as the other mesh.
"""

import argparse

import flipfree
import inputs
import numpy
import scene
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkPlatonicSolidSource
from vtkmodules.vtkIOGeometry import vtkSTLReader


def midpoint_mesh(surface):
    """The mesh of the midpoints of edges: a face in each old face and one around each vertex."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    faces = vtkCellArray()
    midpoints = {}  # by the two ends of the edge
    following = {}  # around each vertex: from the midpoint of one edge to that of the next

    def midpoint(a, b):
        edge = (min(a, b), max(a, b))
        if edge not in midpoints:
            ends = surface.GetPoint(a), surface.GetPoint(b)
            midpoints[edge] = points.InsertNextPoint([(p + q) / 2 for p, q in zip(*ends)])
        return midpoints[edge]

    def add(face):
        faces.InsertNextCell(len(face), face)

    for cell in range(surface.GetNumberOfCells()):
        ids = surface.GetCell(cell).GetPointIds()
        corners = [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
        # Corner b between its neighbors a and c, all the way round.
        triples = list(zip(corners[-1:] + corners[:-1], corners, corners[1:] + corners[:1]))
        add([midpoint(b, c) for _, b, c in triples])
        for a, b, c in triples:
            following.setdefault(b, {})[midpoint(b, c)] = midpoint(a, b)
    for ring in following.values():
        face = [next(iter(ring))]
        while ring[face[-1]] != face[0]:
            face.append(ring[face[-1]])
        add(face)

    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(faces)
    return mesh


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
other = turned_outwards(read_stl(arguments.start) if arguments.start
                        else ellipsoid(seed, (45, 30, 35)))
start = midpoint_mesh(other)

# The seed still tells what the organ looks like. The surface is refined to about 6,144 vertices, as
# many as one that starts from a sphere has; `resolution` sets their number.
organ = flipfree.segment(image, seed, radius, start=start)
print(f"{other.GetNumberOfCells()} faces given; start from {start.GetNumberOfPoints()} midpoints")
print(organ)

if arguments.picture:
    def view(surface, caption):
        return scene.space_view([scene.surface_actor(surface, edges=True)], caption,
                                bounds=organ.surface.GetBounds(), zoom=1.3)

    plane = scene.CORONAL
    scene.write_picture(arguments.picture, [[
        view(other, "the mesh given"),
        view(start, "its edge midpoints"),
        view(organ.surface, "the organ"),
        scene.slice_view([scene.slice_actor(image, seed, plane),
                          scene.contour_actor(start, seed, plane, scene.BLUE),
                          scene.contour_actor(organ.surface, seed, plane)],
                         organ.surface, plane, [("organ", scene.YELLOW), ("start", scene.BLUE)])]],
        size=420)
