"""Points as files: tables, and markups of 3D Slicer; the toolkit's command has the same readers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from . import _kernels
from ._atomic import write_text
from ._corrections import SEED, Constraint
from ._errors import FileError

ENDINGS = (".csv", ".mrk.json")


def constraints_in(rows: Sequence[tuple[int, Sequence[float], float]]) -> list[Constraint]:
    """As the extension has them: kind, place, radius."""
    return [Constraint(kind, tuple(place), radius if kind == SEED else 0.0) for kind, place, radius in rows]


def read_points(path: str) -> list[Constraint]:
    """The points that correct a segmentation, in the file's order; raises FileError."""
    try:
        return constraints_in(_kernels.read_points(path, ""))
    except _kernels.Failure as failure:
        raise FileError(str(failure)) from None


def points_of_controls(name: str, controls: Iterable[tuple[str, Sequence[float]]]) -> list[Constraint]:
    """The points that labels and places of a list of control points mean; raises ValueError."""
    try:
        return constraints_in(_kernels.points_of_controls(name, list(controls)))
    except _kernels.Failure as failure:
        raise ValueError(str(failure)) from None


def read_places(path: str) -> list[tuple[float, ...]]:
    """Points of one kind: a table of x, y, z, or control points of any label; raises FileError."""
    try:
        return [tuple(place) for place in _kernels.read_places(path)]
    except _kernels.Failure as failure:
        raise FileError(str(failure)) from None


def arguments_of(constraints: Sequence[Constraint]) -> dict[str, Any]:
    """The arguments of segment(): inside, outside, boundary, and seeds."""
    arguments: dict[str, Any] = {"outside": [], "inside": [], "boundary": [], "seeds": []}
    for one, values in ((one, list(arguments.values())[one.kind]) for one in constraints):
        values.append((one.place, one.radius) if one.kind == SEED else one.place)
    return arguments


def write_points(path: str, constraints: Sequence[Constraint]) -> None:
    """Writes all of them."""
    rows = [(one.kind, one.place, one.radius) for one in constraints]
    write_text(path, _kernels.points_text(path, rows))
