"""Fills all organs of a label map with tetrahedra: one mesh, in which neighbors share their walls.

    python3 mesh_organs.py --compare --picture organs.png
    python3 mesh_organs.py labels.nii.gz --edge-length 3 --folder organs

A simulation finds neither gaps nor overlaps between organs. The folder gets organs.vtu, whose cells
have their labels, and the walls, as TetGen (walls.smesh) and gmsh (organs.geo, for `gmsh -3`) read
them. With --compare, the usual chain of flying edges and windowed sinc makes a surface of each label,
too, and TetGen fills those as far as it can.
"""

import argparse
import os
import shutil

import flipfree
import inputs
import numpy
import scene
import tetrahedra
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkWindowedSincPolyDataFilter
from vtkmodules.vtkFiltersGeneral import vtkDiscreteFlyingEdges3D
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter


def write_points(points, first, file):
    """Lines of a number, counted from `first`, and the coordinates."""
    numbers = numpy.arange(first, first + len(points))
    numpy.savetxt(file, numpy.column_stack([numbers, points]), fmt="%d %.17g %.17g %.17g")


def write_for_tetgen(walls, name):
    """Points and facets; no holes, and no regions, since TetGen numbers these itself."""
    with open(name, "w", encoding="ascii") as file:
        file.write(f"{len(walls.points)} 3 0 0\n")
        write_points(walls.points, 0, file)
        file.write(f"{len(walls.triangles)} 0\n")
        numpy.savetxt(file, walls.triangles, fmt="3 %d %d %d")
        file.write("0\n0\n")


def write_for_gmsh(walls, folder):
    """A surface for each pair of labels, and volumes that these enclose."""
    pairs, surface = numpy.unique(walls.boundary_labels, axis=0, return_inverse=True)
    surface = surface.ravel() + 1
    with open(os.path.join(folder, "walls.msh"), "w", encoding="ascii") as file:
        file.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(walls.points)}\n")
        write_points(walls.points, 1, file)
        file.write(f"$EndNodes\n$Elements\n{len(walls.triangles)}\n")
        numbers = numpy.arange(1, len(walls.triangles) + 1)
        elements = numpy.column_stack([numbers, surface, surface, walls.triangles + 1])
        numpy.savetxt(file, elements, fmt="%d 2 2 %d %d %d %d %d")  # triangles with two tags
        file.write("$EndElements\n")
    with open(os.path.join(folder, "organs.geo"), "w", encoding="ascii") as file:
        file.write('Merge "walls.msh";\n')
        around = {}
        for number, pair in enumerate(pairs.tolist(), 1):
            for label in pair:
                around.setdefault(label, []).append(str(number))
        for label in sorted(set(around) - {0}):
            file.write(f"Surface Loop({label}) = {{{', '.join(around[label])}}};\n"
                       f"Volume({label}) = {{{label}}};\nPhysical Volume({label}) = {{{label}}};\n")


def labels_at(image, points):
    """Of the nearest voxels; 0 outside of the image."""
    to_index = image.GetPhysicalToIndexMatrix()
    matrix = numpy.array([[to_index.GetElement(row, column) for column in range(4)] for row in range(3)])
    index = numpy.rint(points @ matrix[:, :3].T + matrix[:, 3]).astype(int) - image.GetExtent()[::2]
    size = numpy.array(image.GetDimensions())
    within = ((index >= 0) & (index < size)).all(axis=1)
    voxels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(size[::-1])
    labels = numpy.zeros(len(points), int)
    labels[within] = voxels[tuple(index[within, ::-1].T)]
    return labels


def labels_of_regions(image, points, corners, regions):
    """The label of each tetrahedron: the one in which most centers of its region lie."""
    here = labels_at(image, points[corners].mean(axis=1))
    pairs, counts = numpy.unique(numpy.stack([regions, here]), axis=1, return_counts=True)
    order = numpy.argsort(counts)  # of a region, the most frequent label comes last, and stays
    label_of = dict(pairs[:, order].T.tolist())
    return numpy.array([label_of[region] for region in regions.tolist()])


def usual_surface(image, label):
    """What most programs make of a label."""
    edges = vtkDiscreteFlyingEdges3D()
    edges.SetInputData(image)
    edges.SetValue(0, label)
    smooth = vtkWindowedSincPolyDataFilter()
    smooth.SetInputConnection(edges.GetOutputPort())
    smooth.NormalizeCoordinatesOn()
    smooth.SetPassBand(0.05)
    smooth.Update()
    points = vtk_to_numpy(smooth.GetOutput().GetPoints().GetData())
    return points, vtk_to_numpy(smooth.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)


def fill_usual_surfaces(image, labels, folder):
    """The shapes of the tetrahedra of all labels, and the labels that TetGen does not fill."""
    shapes, refused = [], []
    for label in labels:
        name = os.path.join(folder, f"usual-{label}.off")
        tetrahedra.write_off(*usual_surface(image, label), name)
        try:
            points, corners, _ = tetrahedra.fill(name)
            shapes.append(tetrahedra.shapes_of(tetrahedra.grid_of(points, corners)))
        except tetrahedra.Refused:
            refused.append(label)
    return numpy.concatenate(shapes) if shapes else numpy.zeros(0), refused


def told(shapes):
    least, low, median = numpy.quantile(shapes, (0, 0.01, 0.5))
    return f"shapes {least:.3f} at least, {low:.2f} for 99 %, {median:.2f} in the median (1 is regular)"


parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("labels", nargs="?", help="label map (default: that of the phantom)")
parser.add_argument("--edge-length", type=float, default=5, help="of the walls, mm (default: 5)")
parser.add_argument("--folder", default="organs", help="where to save (default: organs)")
parser.add_argument("--compare", action="store_true", help="with surfaces of the usual chain")
parser.add_argument("--picture", help="PNG to draw the result into")
arguments = parser.parse_args()
if arguments.picture:
    scene.require_display()
if not shutil.which("tetgen"):
    raise SystemExit("tetgen is not installed; on Debian: apt-get install tetgen")

image = flipfree.read_image(arguments.labels) if arguments.labels else inputs.phantom().GetLabelMap()
walls = flipfree.surfaces(image, exact=True, edge_length=arguments.edge_length)
os.makedirs(arguments.folder, exist_ok=True)
smesh = os.path.join(arguments.folder, "walls.smesh")
write_for_tetgen(walls, smesh)
write_for_gmsh(walls, arguments.folder)
try:
    points, corners, regions = tetrahedra.fill(smesh)
except tetrahedra.Refused as refusal:
    raise SystemExit(f"{refusal}; try another --edge-length") from refusal
labels = labels_of_regions(image, points, corners, regions)
is_organ = labels != 0  # background that organs enclose is filled, too
if not is_organ.any():
    raise SystemExit("no organ is large enough for its tetrahedra to be told from background; try a lower --edge-length")
grid = tetrahedra.grid_of(points, corners[is_organ], labels[is_organ])
writer = vtkXMLUnstructuredGridWriter()
writer.SetInputData(grid)
writer.SetFileName(os.path.join(arguments.folder, "organs.vtu"))
writer.Write()

edges = points[corners[:, 1:]] - points[corners[:, :1]]
volumes = numpy.abs(numpy.linalg.det(edges)) / 6000
for label, measures in walls.labels.items():
    print(f"label {label:3}: {(labels == label).sum():6} tetrahedra of {volumes[labels == label].sum():7.1f} ml, "
          f"voxels of {measures.voxel_volume:7.1f} ml")
print(f"one mesh: {is_organ.sum()} tetrahedra, {told(tetrahedra.shapes_of(grid))}")
if arguments.compare:
    shapes, refused = fill_usual_surfaces(image, walls.labels, arguments.folder)
    print(f"the usual chain, label by label: TetGen refuses {len(refused)} of {len(walls.labels)}"
          + (f"; {told(shapes)}" if len(shapes) else ""))

if arguments.picture:
    inside = tetrahedra.cut_open(grid, grid.GetCenter())
    actor = scene.surface_actor(inside, edges=True)
    actor.GetProperty().SetInterpolationToFlat()
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarRange(grid.GetCellData().GetScalars().GetRange())
    scene.write_picture(arguments.picture, [[scene.space_view([actor], "one mesh, cut open", zoom=1.4)]], size=640)
