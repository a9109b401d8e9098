"""What the command line gives the subcommands."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Sequence
from typing import Any

from ._coordinates import swap_lps_ras
from ._corrections import Constraint, constraints_of
from ._command_outputs import require_ending
from ._image import Image
from ._options import WrongUsage
from ._point_files import ENDINGS, read_points


def lps(values: dict[str, Any], point: list[float]) -> list[float]:
    """A point of the command line."""
    return swap_lps_ras(point) if "ras" in values else point


def require_coordinates(option: str, points: Iterable[list[float]]) -> None:
    """Checks the values of an option that takes a point each time."""
    if not all(math.isfinite(x) for point in points for x in point):
        raise WrongUsage(
            f"{option}: a coordinate is not a finite number. Give three numbers, in millimeters"
        )


def require_sense_of_corrections(values: dict[str, Any]) -> None:
    """Checks the options that correct a segmentation."""
    for kind in ("inside", "outside", "boundary"):
        require_coordinates(f"--{kind}", values.get(kind, ()))
    if "points" in values:
        require_ending("--points", values["points"], ENDINGS)


def points_of(values: dict[str, Any]) -> list[Constraint]:
    """The corrections; those of the file first."""
    points = read_points(values["points"]) if "points" in values else []
    inside, outside, boundary = (
        [lps(values, point) for point in values.get(kind, ())]
        for kind in ("inside", "outside", "boundary")
    )
    return [*points, *constraints_of(inside, outside, boundary, ())]


def point_of(image: Image, voxel: Sequence[float]) -> list[float]:
    """Where a voxel's center is, or a place between voxels."""
    import numpy

    point: list[float] = (numpy.array(image.origin) + image.steps @ numpy.array(voxel, float)).tolist()
    return point


def input_title(values: dict[str, Any], quote: str = "") -> str:
    """How messages call the volume: the file, or the folder and the series in it."""
    series = f", series {values['series']}" if values.get("series") else ""
    return f"{quote}{values['input']}{quote}{series}"


def wants_bar(values: dict[str, Any]) -> bool:
    """Whether somebody looks at the terminal."""
    return "quiet" not in values and sys.stderr.isatty()
