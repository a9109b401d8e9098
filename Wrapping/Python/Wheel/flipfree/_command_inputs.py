"""What the command line gives the subcommands."""

from __future__ import annotations

import sys
from typing import Any

from ._coordinates import swap_lps_ras
from ._corrections import Constraint, constraints_of
from ._image import Image
from ._point_files import read_points


def lps(values: dict[str, Any], point: list[float]) -> list[float]:
    """A point of the command line."""
    return swap_lps_ras(point) if "ras" in values else point


def points_of(values: dict[str, Any]) -> list[Constraint]:
    """The corrections; those of the file first."""
    points = read_points(values["points"]) if "points" in values else []
    inside, outside, boundary = (
        [lps(values, point) for point in values.get(kind, ())]
        for kind in ("inside", "outside", "boundary")
    )
    return [*points, *constraints_of(inside, outside, boundary, ())]


def point_of(image: Image, voxel: list[int]) -> list[float]:
    """The center of a voxel."""
    import numpy

    point: list[float] = (numpy.array(image.origin) + image.steps @ numpy.array(voxel, float)).tolist()
    return point


def wants_bar(values: dict[str, Any]) -> bool:
    """Whether somebody looks at the terminal."""
    return "quiet" not in values and sys.stderr.isatty()
