"""Compares two settings on one organ: with the guard, which is the default, and without.

    python3 compare_settings.py --picture compared.png
    python3 compare_settings.py ct.nii.gz --seed 83 -154 321 --radius 26 --truth by-hand.nii.gz

Both find the phantom's esophagus, and score alike. But one surface passes through itself: a
mesher or a printer will refuse it. Change SETTINGS to compare others, anything that
flipfree.segment takes.
"""

import argparse
import time
import warnings

import flipfree
import inputs
import scene

# Some surfaces intersect themselves on purpose.
warnings.simplefilter("ignore", flipfree.FlipFreeWarning)

SETTINGS = {
    "with the guard": {"guard": True},
    "without": {"guard": False},
}
COLORS = [scene.YELLOW, scene.BLUE]

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--truth", help="label map to compare with")
arguments = inputs.parse(__doc__, parser)
if arguments.image:
    image, seed, radius = inputs.image_and_seed(arguments)
    truth, label = arguments.truth, -1
else:
    source = inputs.phantom()
    label = source.ESOPHAGUS
    image, truth = source.GetOutput(), source.GetLabelMap()
    seed, radius = inputs.seed_in(source, label)

organs = {}
measures = "    Dice  mean distance, mm" if truth else ""
print(f"{'':14} seconds  iterations  self-intersections{measures}")
for name, settings in SETTINGS.items():
    start = time.perf_counter()
    organs[name] = organ = flipfree.segment(image, seed, radius, **settings)
    seconds = time.perf_counter() - start
    iterations = organ.convergence.GetNumberOfRows()
    row = f"{name:14} {seconds:7.1f} {iterations:11} {organ.self_intersections:19}"
    if truth:
        # Label maps, because a surface that intersects itself has no well-defined inside.
        scores = flipfree.evaluate(organ.label_map, truth, reference_label=label)
        row += f"  {scores.dice:6.3f} {scores.asd:18.2f}"
    print(row)


def with_defects(organ):
    """The surface with its self-intersecting faces in red."""
    validity = flipfree.vtkSurfaceValidity()
    validity.SetInputData(organ.surface)
    validity.Update()
    return scene.defect_actor(validity.GetOutput(), (0.78, 0.74, 0.68), validity.SELF_INTERSECTING)


if arguments.picture:
    slices = []
    for plane in (scene.AXIAL, scene.CORONAL):
        actors = [scene.slice_actor(image, seed, plane)]
        for (name, organ), color in zip(organs.items(), COLORS):
            # The first one is the wider, so that it is to be seen where they agree.
            width = 4 if name == next(iter(organs)) else 1.6
            actors.append(scene.contour_actor(organ.surface, seed, plane, color, width))
        shown = next(iter(organs.values())).surface
        slices.append(scene.slice_view(actors, shown, plane, list(zip(organs, COLORS))))
    # From the left and behind, where the phantom's defects are.
    surfaces = [scene.space_view([with_defects(organ)],
                                 f"{name}: {organ.self_intersections} self-intersections",
                                 toward=(1, 0.6, 0.5), zoom=1.1)
                for name, organ in organs.items()]
    scene.write_picture(arguments.picture, [slices, surfaces], size=520)
