"""Composes the method from its stages, and watches each iteration.

    python3 stages_by_hand.py --picture iterations.png

This is what vtkFlipFreeSegmentation does inside, from coarse to fine, with everything in sight: what the
organ's intensities are, how far the targets lie, how many vertices would have flipped.
"""

import flipfree
import inputs
import scene
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

RESOLUTIONS = (8, 16, 32)  # vertices along the side of the cube, level by level
MOST_ITERATIONS = 40  # at each level
SHOWN = (0, 2, 5, 20)  # iterations in the picture, and the last one

arguments = inputs.parse(__doc__)
image, seed, radius = inputs.image_and_seed(arguments)
voxel = max(image.GetSpacing())


def detached(surface):
    """A filter's output changes with its next update; this one stays."""
    copy = vtkPolyData()
    copy.ShallowCopy(surface)
    return copy


# The image, smoothed where the surface can get to.
smooth = flipfree.vtkSeedRegionDiffusion()
smooth.SetInputData(image)
smooth.SetSeedCenter(seed)
smooth.SetSeedRadius(radius)
smooth.SetReach(250)

# How well each voxel fits the organ, from 0 to 1: first by the intensities of the seed sphere.
feature = flipfree.vtkGMMFeatureFilter()
feature.SetInputConnection(smooth.GetOutputPort())
feature.SetSeedCenter(seed)
feature.SetSeedRadius(radius)
feature.SetClosingRadius(min(1.5, 2 * voxel))
feature.SetOpeningRadius(min(6, 2 * voxel))

# From each vertex along its normal to the boundary of the foreground.
search = flipfree.vtkCorrespondenceSearch()
search.SetFeatureConnection(feature.GetOutputPort())
search.SetEdgeConnection(smooth.GetOutputPort())
search.SetImageEndDistance(12)
search.SetMaximumDisplacement(8)

# Towards these targets, but never so that a face flips or the surface meets itself.
deform = flipfree.vtkFlipFreeDeform()
deform.SetInputConnection(search.GetOutputPort())

sphere = flipfree.vtkQuadSphereSource()
sphere.SetCenter(seed)
sphere.SetRadius(radius)
sphere.SetResolution(RESOLUTIONS[0])
sphere.Update()
iterates = [detached(sphere.GetOutput())]

for level, resolution in enumerate(RESOLUTIONS):
    if level > 0:
        refine = flipfree.vtkFlipFreeRefinement()
        refine.SetInputData(iterates[-1])
        refine.Update()
        iterates[-1] = detached(refine.GetOutput())
        # By now the surface knows the organ better than the seed did.
        feature.SetSurfaceData(iterates[-1])
    if resolution == RESOLUTIONS[-1]:
        search.SetEdgeWindow(min(3, 1.5 * voxel))  # the last millimetre: to the strongest edge
    feature.Update()
    means = vtk_to_numpy(feature.GetOutput().GetFieldData().GetArray("MixtureMeans"))
    print(f"\nlevel {level}: {iterates[-1].GetNumberOfPoints()} vertices; the organ's intensities "
          f"are around {', '.join(f'{mean:.0f}' for mean in means)}")
    print("iteration  mean distance, mm  matched  flipping  guarded")
    distances = []
    while len(distances) < MOST_ITERATIONS:
        search.SetInputData(iterates[-1])
        deform.Update()
        iterates.append(detached(deform.GetOutput()))
        targets, moved = search.GetOutput(), iterates[-1].GetFieldData()
        distances.append(targets.GetFieldData().GetArray("MeanDistance").GetValue(0))
        matched = vtk_to_numpy(targets.GetPointData().GetArray("Correspondence")) == 1
        print(f"{len(iterates) - 1:9} {distances[-1]:18.2f} {matched.sum():8} "
              f"{moved.GetArray('FlippingVertices').GetValue(0):9.0f} "
              f"{moved.GetArray('GuardedVertices').GetValue(0):8.0f}")
        if len(distances) > 5 and distances[-6] - distances[-1] < 0.02 * voxel:
            break

# Every iterate is a valid surface, not the last one alone.
validity = flipfree.vtkSurfaceValidity()
for iterate in iterates:
    validity.SetInputData(iterate)
    validity.Update()
    assert validity.GetMeasures().GetValueByName(0, "Valid").ToInt() == 1
print(f"\nall {len(iterates)} surfaces are closed and without self-intersections")

if arguments.picture:
    last = iterates[-1]
    rows = [[], []]
    for shown in (*SHOWN, len(iterates) - 1):
        surface = iterates[shown]
        rows[0].append(scene.slice_view(
            [scene.slice_actor(image, seed, scene.CORONAL),
             scene.contour_actor(surface, seed, scene.CORONAL)],
            last, scene.CORONAL, f"after {shown} iterations" if shown else "the seed"))
        rows[1].append(scene.space_view(
            [scene.surface_actor(surface, edges=True)], bounds=last.GetBounds(), zoom=1.3))
    scene.write_picture(arguments.picture, rows, size=360)
