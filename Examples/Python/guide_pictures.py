"""Draws the pictures of the guide: what changes with the seed and with each parameter.

    python3 guide_pictures.py folder

All show the abdomen phantom: the truth in blue, the segmentation in yellow.
"""

import argparse
import functools
import warnings
from pathlib import Path

import flipfree
import inputs
import scene
from corrections import INSIDE, Corrections
from three_views import letter_at
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersGeneral import vtkDiscreteFlyingEdges3D

# Some of the settings are bad on purpose.
warnings.simplefilter("ignore", flipfree.FlipFreeWarning)

PHANTOM = inputs.phantom()
LIVER, SPLEEN, KIDNEY = PHANTOM.LIVER, PHANTOM.SPLEEN, PHANTOM.RIGHT_KIDNEY

# By picture: the organ, the plane of the slices, and a caption and parameters for each view; the
# seed is moved by `move`, in millimeters, and its radius multiplied by `scale`.
PICTURES = {
    "seed": (LIVER, scene.AXIAL, [
        ("deep in the organ", {}),
        ("small", {"scale": 0.25}),
        ("halfway to the edge", {"move": (-24, 0, 0), "scale": 0.5}),
        ("on the edge", {"move": (-52, 0, 0), "scale": 0.7})]),
    "leak": (KIDNEY, scene.CORONAL, [
        ("not smoothed", {"diffusion_iterations": 0}),
        ("reach=60", {"diffusion_iterations": 0, "reach": 60}),
        ("foreground_mass=0.9", {"diffusion_iterations": 0, "foreground_mass": 0.9}),
        ("smoothed", {})]),
    "mass": (LIVER, scene.CORONAL, [
        ("foreground_mass=0.5", {"foreground_mass": 0.5, "reestimate_intensities": False}),
        ("foreground_mass=0.95", {"foreground_mass": 0.95, "reestimate_intensities": False}),
        ("foreground_mass=0.999", {"foreground_mass": 0.999, "reestimate_intensities": False})]),
    "search": (LIVER, scene.CORONAL, [
        ("search_distance=5", {"search_distance": 5}),
        ("0: 1.6 radii, the default", {}),
        ("search_distance=100", {"search_distance": 100})]),
}
# The same for whole surfaces of the liver.
SURFACES = {
    "resolution": [
        ("resolution=8, levels=1", {"resolution": 8, "levels": 1}),
        ("32, 4, the defaults", {}),
        ("resolution=64, levels=5", {"resolution": 64, "levels": 5})],
    "shape": [
        ("uniform_weight=0.05", {"uniform_weight": 0.05}),
        ("1, the default", {}),
        ("fairing=1", {"fairing": 1})],
}
NAMES = [*PICTURES, *SURFACES, "question"]


def truth_of(label):
    boundary = vtkDiscreteFlyingEdges3D()
    boundary.SetInputData(PHANTOM.GetLabelMap())
    boundary.SetValue(0, label)
    boundary.Update()
    return boundary.GetOutput()


@functools.lru_cache(maxsize=None)  # the defaults are in several pictures
def segment(label, move=(0, 0, 0), scale=1, **parameters):
    """The seed, the organ, and how well it agrees with the truth."""
    seed, radius = inputs.seed_in(PHANTOM, label)
    seed = [place + step for place, step in zip(seed, move)]
    organ = flipfree.segment(PHANTOM.GetOutput(), seed, radius * scale, **parameters)
    scores = flipfree.evaluate(organ.label_map, PHANTOM.GetLabelMap(), reference_label=label)
    sphere = flipfree.vtkQuadSphereSource()
    sphere.SetCenter(seed)
    sphere.SetRadius(radius * scale)
    sphere.Update()
    return sphere.GetOutput(), organ, scores.dice


def draw_slices(path, label, plane, views):
    truth = truth_of(label)
    center, _ = inputs.seed_in(PHANTOM, label)
    row = []
    for caption, parameters in views:
        seed, organ, dice = segment(label, **parameters)
        print(f"{path.stem}: {caption}: Dice {dice:.2f}")
        actors = [scene.slice_actor(PHANTOM.GetOutput(), center, plane),
                  scene.contour_actor(truth, center, plane, scene.BLUE, 3.2),
                  scene.contour_actor(organ.surface, center, plane, scene.YELLOW, 1.6)]
        if path.stem == "seed":
            actors.append(scene.contour_actor(seed, center, plane, (1, 1, 1), 1.2))
        row.append(scene.slice_view(actors, truth, plane, f"{caption}: Dice {dice:.2f}"))
    scene.write_picture(path, [row], size=340)


def draw_surfaces(path, label, views):
    row = []
    for caption, parameters in views:
        _, organ, dice = segment(label, **parameters)
        print(f"{path.stem}: {caption}: Dice {dice:.2f}")
        row.append(scene.space_view([scene.surface_actor(organ.surface, edges=True)],
                                    f"{caption}: Dice {dice:.2f}"))
    scene.write_picture(path, [row], size=340)


def draw_question(path):
    """A liver in more noise, what its first question asks about, and the liver by the answer."""
    phantom, truth = inputs.phantom(noisy=True), truth_of(LIVER)
    image = phantom.GetOutput()
    asked = Corrections(image, *inputs.seed_in(phantom, LIVER))
    question = asked.questions()[0]
    row = []

    def show(caption, *marks):
        surface = vtkPolyData()
        surface.DeepCopy(asked.surface)  # which the answer changes
        contours = [scene.contour_actor(truth, question.place, scene.AXIAL, scene.BLUE, 3.2),
                    scene.contour_actor(surface, question.place, scene.AXIAL, scene.YELLOW, 1.6)]
        scores = flipfree.evaluate(asked.filter.GetLabelMap(), phantom.GetLabelMap(),
                                   reference_label=LIVER)
        caption = f"{caption}: Dice {scores.dice:.3f}"
        print(f"{path.stem}: {caption}")
        picture = scene.slice_actor(image, question.place, scene.AXIAL)
        row.append(scene.slice_view([picture, *marks, *contours], truth, scene.AXIAL, caption))

    show("as found")
    part = vtkImageData()
    asked.preview(INSIDE, question.place, part)
    show(f"are these {question.volume:.0f} ml liver?",
         scene.mask_actor(part, question.place, scene.AXIAL, (0.3, 0.8, 0.35)),
         letter_at(question.place, "?", (1, 1, 1)))
    asked.do(INSIDE, [question.place])
    show("yes")
    scene.write_picture(path, [row], size=440)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the pictures go")
    parser.add_argument("--only", choices=NAMES, action="append")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for name in arguments.only or NAMES:
        path = arguments.folder / f"{name}.png"
        if name in PICTURES:
            draw_slices(path, *PICTURES[name])
        elif name in SURFACES:
            draw_surfaces(path, LIVER, SURFACES[name])
        else:
            draw_question(path)


if __name__ == "__main__":
    main()
