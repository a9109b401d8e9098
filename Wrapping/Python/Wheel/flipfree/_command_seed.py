"""Seeds of the command line: in millimeters, and within the volume."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._command_inputs import lps, point_of
from ._errors import FlipFreeError

if TYPE_CHECKING:
    from ._image import Image


def seeds_in(image: Image, values: dict[str, Any]) -> list[list[float]]:
    """The centers of the seeds; an error names the option, the volume, and what RAS does."""
    if "seed" in values:
        seeds = [lps(values, seed) for seed in values["seed"]]
        given = [f"--seed: {_text_of(seed)} mm" for seed in seeds]
        hint = "Coordinates are LPS: viewers that use RAS show x and y with opposite signs."
    else:
        seeds = [point_of(image, voxel) for voxel in values["seed_voxel"]]
        given = [f"--seed-voxel: {_text_of(voxel)}" for voxel in values["seed_voxel"]]
        hint = "The indices of a voxel count from 0."
    for seed, text in zip(seeds, given):
        _require_inside(image, seed, f"{text} lies outside '{values['input']}'", hint)
    return seeds


def _require_inside(image: Image, seed: list[float], complaint: str, hint: str) -> None:
    import numpy

    size = numpy.array(image.voxels.shape[::-1])
    index = numpy.linalg.solve(image.steps, numpy.array(seed) - image.origin)
    if ((index >= -0.5) & (index <= size - 0.5)).all():
        return
    middle = point_of(image, ((size - 1) / 2).tolist())
    raise FlipFreeError(
        f"{complaint}, which has {size[0]} x {size[1]} x {size[2]} voxels centered at "
        f"{_text_of(middle)} mm. {hint}"
    )


def _text_of(numbers: Any) -> str:
    return f"({', '.join(f'{number:g}' for number in numbers)})"
