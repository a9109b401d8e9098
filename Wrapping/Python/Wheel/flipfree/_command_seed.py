"""Seeds of the command line in millimeters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._command_inputs import lps, point_of
from ._errors import FlipFreeError

if TYPE_CHECKING:
    from ._image import Image


def seeds_in(image: Image, values: dict[str, Any]) -> list[list[float]]:
    """The centers of the seeds; an error names the option for a voxel outside the volume."""
    if "seed" in values:
        return [lps(values, seed) for seed in values["seed"]]
    size = image.voxels.shape[::-1]
    for voxel in values["seed_voxel"]:
        if not all(0 <= index < count for index, count in zip(voxel, size)):
            text = ", ".join(map(str, voxel))
            raise FlipFreeError(
                f"--seed-voxel: ({text}) lies outside '{values['input']}', which has {size[0]} x {size[1]} x "
                f"{size[2]} voxels. The indices of a voxel count from 0."
            )
    return [point_of(image, voxel) for voxel in values["seed_voxel"]]
