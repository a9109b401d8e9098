"""Watches each iteration of the method, put together from its stages in growth.py.

    python3 stages_by_hand.py --picture iterations.png
"""

import flipfree
import inputs
import scene
from growth import Growth

SHOWN = (0, 2, 5, 20)  # iterations in the picture, and the last one

arguments = inputs.parse(__doc__)
image, seed, radius = inputs.image_and_seed(arguments)

growth = Growth(image, seed, radius)
surfaces = [growth.surface]
print("iteration  level  vertices  mean distance, mm  matched  flipping  guarded")
while not growth.has_converged():
    done = growth.step()
    surfaces.append(growth.surface)
    print(f"{len(surfaces) - 1:9} {done.level:6} {growth.surface.GetNumberOfPoints():9} "
          f"{done.mean_distance:18.2f} {done.matched:8} {done.flipping:9} {done.guarded:8}")

# Every iterate is a valid surface, not the last one alone.
validity = flipfree.vtkSurfaceValidity()
for surface in surfaces:
    validity.SetInputData(surface)
    validity.Update()
    assert validity.GetMeasures().GetValueByName(0, "Valid").ToInt() == 1
print(f"all {len(surfaces)} surfaces are closed and without self-intersections")

if arguments.picture:
    rows = [[], []]
    for shown in (*SHOWN, len(surfaces) - 1):
        rows[0].append(scene.slice_view(
            [scene.slice_actor(image, seed, scene.CORONAL),
             scene.contour_actor(surfaces[shown], seed, scene.CORONAL)],
            growth.surface, scene.CORONAL, f"after {shown} iterations" if shown else "the seed"))
        rows[1].append(scene.space_view(
            [scene.surface_actor(surfaces[shown], edges=True)],
            bounds=growth.surface.GetBounds(), zoom=1.3))
    scene.write_picture(arguments.picture, rows, size=360)
