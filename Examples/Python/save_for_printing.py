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

import flipfree
import inputs
import scene
import tetrahedra
from vtkmodules.vtkFiltersCore import vtkMassProperties
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

# The very triangles that are certified.
off = os.path.join(arguments.folder, "organ.off")
tetrahedra.write_off(organ.points, organ.triangles, off)
print(f"{off}: {len(organ.points)} vertices, {len(organ.triangles)} triangles")

views = [scene.space_view([scene.surface_actor(scene.triangles_of(organ.surface), edges=True)],
                          "to print", zoom=1.4)]
if shutil.which("tetgen"):
    points, corners, _ = tetrahedra.fill(off)
    print(f"TetGen: {len(corners)} tetrahedra")
    inside = tetrahedra.cut_open(tetrahedra.grid_of(points, corners), organ.surface.GetCenter())
    actor = scene.surface_actor(inside, edges=True)
    actor.GetProperty().SetInterpolationToFlat()
    views.append(scene.space_view([actor], "tetrahedra, cut open", zoom=1.4,
                                  bounds=organ.surface.GetBounds()))
else:
    print("tetgen is not installed, so there are no tetrahedra")

if arguments.picture:
    scene.write_picture(arguments.picture, [views], size=600)
