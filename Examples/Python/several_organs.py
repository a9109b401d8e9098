"""Segments several organs together, so that they never meet, into one scene and one label map.

    python3 several_organs.py                      # five organs of the built-in phantom
    python3 several_organs.py ct.nii.gz --organ liver 83 -154 321 26 --organ spleen -92 -128 340 18
"""

import argparse

import flipfree
import inputs
import scene
from vtkmodules.vtkCommonDataModel import vtkBoundingBox

COLORS = [(0.86, 0.42, 0.33), (0.72, 0.48, 0.80), (0.95, 0.72, 0.30), (0.95, 0.90, 0.45),
           (0.45, 0.75, 0.50), (0.40, 0.60, 0.85)]

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("image", nargs="?", help="file or DICOM folder (default: the phantom)")
parser.add_argument("--organ", nargs=5, action="append", metavar=("NAME", "X", "Y", "Z", "R"))
parser.add_argument("--labels", help="file for the label map of all organs: 1, 2, 3, ...")
parser.add_argument("--picture", help="PNG to draw the result into")
arguments = parser.parse_args()
if arguments.picture:
    scene.require_display()  # before anything is segmented

if arguments.image:
    if not arguments.organ:
        parser.error("an image needs --organ NAME X Y Z R, once for each organ")
    image = flipfree.read_image(arguments.image)
    seeds = {name: ([float(x), float(y), float(z)], float(radius))
             for name, x, y, z, radius in arguments.organ}
else:
    source = inputs.phantom()
    image = source.GetOutput()
    seeds = {name: inputs.seed_in(source, label) for name, label in (
        ("liver", source.LIVER), ("spleen", source.SPLEEN), ("right kidney", source.RIGHT_KIDNEY),
        ("left kidney", source.LEFT_KIDNEY))}

organs = flipfree.segment_organs(image, seeds)
for name, organ in organs.items():
    print(f"{name}: {organ}")

if arguments.labels:
    flipfree.write_image(organs.label_map, arguments.labels)

if arguments.picture:
    center = next(iter(organs.values())).surface.GetCenter()
    axial = [scene.slice_actor(image, center, scene.AXIAL)]
    surfaces = []
    for organ, color in zip(organs.values(), COLORS):
        axial.append(scene.contour_actor(organ.surface, center, scene.AXIAL, color))
        surfaces.append(scene.surface_actor(organ.surface, color))
    # The spine behind the organs tells where they lie.
    back = max(organ.surface.GetBounds()[3] for organ in organs.values())
    spine = scene.slice_actor(image, [center[0], back, center[2]], scene.CORONAL)
    box = vtkBoundingBox()
    for organ in organs.values():
        box.AddBounds(organ.surface.GetBounds())
    bounds = [0.0] * 6
    box.GetBounds(bounds)
    legend = list(zip(organs, COLORS))[::-1]
    scene.write_picture(arguments.picture, [[
        scene.slice_view(axial, image, scene.AXIAL, legend, margin=1.02),
        scene.space_view([spine, *surfaces], "from the front", zoom=1.2, bounds=bounds),
        scene.space_view(surfaces, "from behind", toward=(0.35, 1, 0.3), bounds=bounds)]],
        size=560)
