"""Segments a vessel between points, and draws its surface, its centerline, and the vessel straightened.

    python3 trace_vessel.py                        # the aorta of the built-in phantom
    python3 trace_vessel.py ct.nii.gz --point 212 -143 480 --point 171 -168 228
"""

import argparse

import flipfree
import inputs
import numpy
import scene
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkTubeFilter

# In the phantom's aorta, above and below its branches.
AORTA = [(151.4, 153.0, 262.0), (151.4, 153.0, 84.0)]
STEP = 0.5  # of straightened cross-sections, mm

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("image", nargs="?", help="file or DICOM folder (default: the phantom)")
parser.add_argument("--point", nargs=3, type=float, action="append", metavar=("X", "Y", "Z"),
                    help="a point in the vessel, LPS mm; two or more")
parser.add_argument("--radius", type=float, default=0, help="about its radius, mm")
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
    radii = branch["radius"]
    print(f"branch {number}: {branch['length'][-1]:.0f} mm long, "
          f"radius {radii.min():.1f} to {radii.max():.1f} mm, {numpy.median(radii):.1f} mm as a rule")


def across(points):
    """An axis across a line at each of its points that turns little from one to the next."""
    tangents = numpy.gradient(points, axis=0)
    tangents /= numpy.linalg.norm(tangents, axis=1)[:, None]
    axis = numpy.array([1.0, 0, 0])
    axes = []
    for tangent in tangents:
        axis = axis - tangent * (axis @ tangent)
        axis /= numpy.linalg.norm(axis)
        axes.append(axis)
    return numpy.array(axes)


def straightened(branch, width):
    """The image along a branch, as if the vessel were straight: an image of one slice, head up."""
    points = branch["points"][numpy.argsort(branch["points"][[0, -1], 2])[0] * 0:]
    if points[0, 2] > points[-1, 2]:
        points = points[::-1]
    offsets = numpy.arange(-width, width + STEP, STEP)
    places = points[:, None, :] + offsets[None, :, None] * across(points)[:, None, :]
    voxels = flipfree.array_from_image(image)
    lattice = numpy.linalg.inv(direction_of(image) * numpy.array(image.GetSpacing()))
    index = numpy.rint((places - numpy.array(image.GetOrigin())) @ lattice.T).astype(int)
    index = numpy.clip(index, 0, numpy.array(voxels.shape[::-1]) - 1)
    values = voxels[index[..., 2], index[..., 1], index[..., 0]]
    step = branch["length"][-1] / (len(points) - 1)
    return flipfree.image_from_array(values[:, None, :], spacing=(STEP, 1, step),
                                     origin=(-width, 0, 0))


def direction_of(volume: vtkImageData):
    matrix = volume.GetDirectionMatrix()
    return numpy.array([[matrix.GetElement(row, column) for column in range(3)]
                        for row in range(3)])


if arguments.picture:
    tube = vtkTubeFilter()
    tube.SetInputData(vessel.centerline)
    tube.SetRadius(1)
    tube.SetNumberOfSides(12)
    tube.Update()
    line = scene.surface_actor(tube.GetOutput(), scene.YELLOW)
    surface = scene.surface_actor(vessel.surface, opacity=0.45)
    center = vessel.surface.GetCenter()
    coronal = [scene.slice_actor(image, center, scene.CORONAL),
               scene.contour_actor(vessel.surface, center, scene.CORONAL, scene.YELLOW)]
    straight = straightened(vessel.branches[0], 30)
    along = [scene.slice_actor(straight, straight.GetCenter(), scene.CORONAL)]
    scene.write_picture(arguments.picture, [[
        scene.slice_view(coronal, image, scene.CORONAL),
        scene.space_view([surface, line], "surface and centerline", zoom=1.2),
        scene.slice_view(along, straight, scene.CORONAL)]], size=560)
