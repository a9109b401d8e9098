"""Segments a vessel between points, and draws its surface, its centerline, and the vessel straightened.

    python3 trace_vessel.py                        # the aorta of the built-in phantom
    python3 trace_vessel.py ct.nii.gz --point 212 -143 480 --point 171 -168 228
"""

import argparse

import flipfree
import inputs
import numpy
import scene
from vtkmodules.vtkFiltersCore import vtkTubeFilter

AORTA = [(170.5, 150.2, 45), (177.5, 151, 250)]  # of the phantom, LPS mm
STEP = 0.5  # of straightened cross-sections, mm

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("image", nargs="?", help="file or DICOM folder (default: the phantom)")
parser.add_argument("--point", nargs=3, type=float, action="append", metavar=("X", "Y", "Z"),
                    help="a point in the vessel, LPS mm; two or more")
parser.add_argument("--radius", type=float, default=0, help="about the vessel's, mm; 0: found")
parser.add_argument("--picture", help="PNG to draw the result into")
arguments = parser.parse_args()
if bool(arguments.image) != bool(arguments.point):
    parser.error("an image and points go together")
if arguments.picture:
    scene.require_display()  # before anything is segmented

image = flipfree.read_image(arguments.image) if arguments.image else inputs.phantom().GetOutput()
vessel = flipfree.trace(image, arguments.point or AORTA, radius=arguments.radius)
print(vessel)
for number, branch in enumerate(vessel.branches):
    radius = branch.radius
    print(f"branch {number}: {branch.length[-1]:.0f} mm long, radius {numpy.median(radius):.1f} mm"
          f" ({radius.min():.1f} to {radius.max():.1f})")


def straightened(volume, branch, width):
    """A volume along a branch as if the vessel were straight: an image of a single row, head up."""
    points = branch.points
    if points[0, 2] > points[-1, 2]:
        points = points[::-1]
    tangents = numpy.gradient(points, axis=0)
    right = numpy.cross(numpy.cross(tangents, scene.CORONAL[0]), tangents)  # as far as it can
    right /= numpy.linalg.norm(right, axis=1)[:, None]
    offsets = numpy.arange(-width, width + STEP, STEP)
    places = points[:, None, :] + offsets[None, :, None] * right[:, None, :]
    matrix = volume.GetDirectionMatrix()
    axes = [[matrix.GetElement(i, j) for j in range(3)] for i in range(3)]
    indices = (places - volume.GetOrigin()) @ numpy.linalg.inv(axes).T / volume.GetSpacing()
    voxels = flipfree.array_from_image(volume)
    i, j, k = numpy.clip(numpy.rint(indices), 0, numpy.array(voxels.shape[::-1]) - 1).astype(int).T
    step = branch.length[-1] / (len(points) - 1)
    return flipfree.image_from_array(voxels[k, j, i].T[:, None, :], spacing=(STEP, 1, step))


if arguments.picture:
    tube = vtkTubeFilter()
    tube.SetInputData(vessel.centerline)
    tube.SetRadius(1)
    tube.SetNumberOfSides(12)
    tube.Update()
    line = scene.surface_actor(tube.GetOutput(), scene.YELLOW)
    center = vessel.surface.GetCenter()
    coronal = [scene.slice_actor(image, center, scene.CORONAL),
               scene.contour_actor(vessel.surface, center, scene.CORONAL)]
    straight = straightened(image, vessel.branches[0], 40)
    along = scene.slice_actor(straight, straight.GetCenter(), scene.CORONAL)
    scene.write_picture(arguments.picture, [[
        scene.slice_view(coronal, vessel.surface, scene.CORONAL),
        scene.space_view([scene.surface_actor(vessel.surface, opacity=0.4), line], zoom=0.95),
        scene.slice_view([along], straight, scene.CORONAL, "straightened", margin=1.05)]], size=420)
