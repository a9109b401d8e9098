"""Surfaces of labels by other software, for MeasureLabelSurfaces --peers: VTK's surface nets, as
vtkSurfaceNets3D makes them by default, and zmesh's marching cubes, also simplified.

    pip install "vtk>=9.7" zmesh SimpleITK
    python label_surface_peers.py LABELS FOLDER

writes FOLDER/WAY/LABEL.stl and FOLDER/WAY/seconds (in memory, without files) for each way.
"""
import pathlib
import sys
import time

import numpy
import SimpleITK
import vtk
import zmesh
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy


def by_surface_nets(voxels, spacing):
    """All labels at once. Beyond the border lies background, so that surfaces are closed there."""
    image = vtk.vtkImageData()
    image.SetDimensions(voxels.shape[::-1])
    image.SetSpacing(*spacing)
    image.GetPointData().SetScalars(numpy_to_vtk(voxels.ravel(), deep=False))
    nets = vtk.vtkSurfaceNets3D()
    nets.SetInputData(image)
    labels = [int(label) for label in numpy.unique(voxels) if label]
    for place, label in enumerate(labels):
        nets.SetValue(place, label)
    nets.SetOutputMeshTypeToTriangles()
    nets.Update()
    walls = nets.GetOutput()
    points = vtk_to_numpy(walls.GetPoints().GetData())
    triangles = vtk_to_numpy(walls.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    sides = vtk_to_numpy(walls.GetCellData().GetArray("BoundaryLabels"))
    surfaces = {}
    for label in labels:
        front = triangles[sides[:, 0] == label]
        back = triangles[sides[:, 1] == label][:, ::-1]
        surfaces[label] = points, numpy.concatenate([front, back])
    return surfaces


def by_zmesh(voxels, spacing, fewer=0):
    """Each label for itself, with so many times fewer triangles."""
    mesher = zmesh.Mesher(tuple(spacing))
    # zmesh takes the axes in the order of the array's.
    mesher.mesh(numpy.asfortranarray(voxels.T))
    surfaces = {}
    for label in mesher.ids():
        mesh = mesher.get(label, normals=False, reduction_factor=fewer)
        surfaces[int(label)] = mesh.vertices, mesh.faces
        mesher.erase(label)
    return surfaces


def write(surface, place, name):
    """In the label map's own space. As binary STL by numpy, which drops no triangle, unlike VTK."""
    points, triangles = surface
    corners = (points @ place[:3, :3].T + place[:3, 3])[triangles]
    facet = numpy.zeros(len(triangles), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    facet["corners"] = corners
    with open(name, "wb") as file:
        file.write(bytes(80))
        file.write(numpy.uint32(len(triangles)).tobytes())
        facet.tofile(file)


def main():
    labels, folder = sys.argv[1:]
    image = SimpleITK.ReadImage(labels)
    spacing = image.GetSpacing()
    voxels = numpy.pad(SimpleITK.GetArrayFromImage(image).astype(numpy.int32), 1)
    place = numpy.eye(4)
    place[:3, :3] = numpy.reshape(image.GetDirection(), (3, 3))
    place[:3, 3] = image.TransformIndexToPhysicalPoint((0, 0, 0)) - place[:3, :3] @ spacing
    ways = {
        "surface nets": by_surface_nets,
        "zmesh": by_zmesh,
        "zmesh, simplified": lambda *volume: by_zmesh(*volume, fewer=10),
    }
    for way, make in ways.items():
        target = pathlib.Path(folder, way)
        target.mkdir(parents=True, exist_ok=True)
        begin = time.perf_counter()
        surfaces = make(voxels, spacing)
        target.joinpath("seconds").write_text(str(time.perf_counter() - begin))
        for label, surface in surfaces.items():
            write(surface, place, target / f"{label}.stl")


if __name__ == "__main__":
    main()
