"""What the command line gives the subcommands."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Sequence
from typing import Any

from ._coordinates import swap_lps_ras
from ._corrections import Constraint, constraints_of
from ._command_outputs import STROKES, require_ending
from ._image import Image
from ._options import WrongUsage
from ._point_files import ENDINGS, read_points, read_stroke

# What corrects a segmentation, by the options.
POINTS = ("inside", "outside", "boundary")


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
    for kind in POINTS:
        require_coordinates(f"--{kind}", values.get(kind, ()))
    for option in STROKES:
        for path in values.get(option, ()):
            require_ending(f"--{option.replace('_', '-')}", path, ENDINGS)
    if "points" in values:
        require_ending("--points", values["points"], ENDINGS)


def points_of(values: dict[str, Any]) -> list[Constraint]:
    """The corrections; those of the file first."""
    takers = "--inside-stroke or --outside-stroke"
    points = read_points(values["points"], takers) if "points" in values else []
    given: dict[str, Any] = {kind: [] for kind in POINTS}
    for option in (*POINTS, *STROKES):
        for value in values.get(option, ()):
            kind, places = places_of_option(values, option, value)
            given[kind] += places
    return [*points, *constraints_of(**given, seeds=())]


def places_of_option(
    values: dict[str, Any], option: str, value: Any
) -> tuple[str, list[Sequence[float]]]:
    """The kind of what a value of one of POINTS or STROKES gives, and its places."""
    if option in STROKES:
        return option.partition("_")[0], [*read_stroke(value)]
    return option, [lps(values, value)]


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
