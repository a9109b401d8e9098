"""Points in the cells of a cohort's table: a list, or the name of a file."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterable
from typing import Any, Union

from ._corrections import Constraint
from ._errors import FileError
from ._point_files import ENDINGS, arguments_of, read_places, read_points

CORRECTIONS = ("inside", "outside", "boundary", "corrections")
# The points themselves, or the name of their file.
Cell = Union[list[tuple[float, ...]], str]


def finite(text: str) -> float:
    """A finite number as float() takes it, or NaN.

    >>> finite("-1.5e1"), finite("1_0"), finite("inf"), finite("wide")
    (-15.0, 10.0, nan, nan)
    """
    try:
        number = float(text)
    except ValueError:
        return math.nan
    return number if math.isfinite(number) else math.nan


def decimal(text: str) -> float:
    """A number as tables of points have it, or NaN.

    >>> decimal("-1.5e1"), decimal("1_0"), decimal("inf"), decimal("1e999")
    (-15.0, nan, nan, nan)
    """
    return finite(text) if re.fullmatch("[0-9+.eE-]+", text) else math.nan


def text_of(value: Any) -> str:
    """A cell of a list of mappings or of a data frame as text; points one behind the other."""
    if hasattr(value, "tolist"):  # numpy's
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        items = [item.tolist() if hasattr(item, "tolist") else item for item in value]
        if any(isinstance(item, (list, tuple)) for item in items):
            return "; ".join(text_of(item) for item in items)
        return " ".join(map(text_of, items))
    missing = value is None or (isinstance(value, float) and math.isnan(value))
    return "" if missing else str(value)


def cell_of(column: str, text: str, folder: str) -> Cell:
    """The points of a cell, or the path of their file; ValueError begins with the column."""
    if text.lower().endswith(ENDINGS) and column in ("points", "corrections"):
        return os.path.normpath(os.path.join(folder, text))
    if column == "corrections":
        raise ValueError(f"{column}: a file of points (.csv or .mrk.json) is needed, not '{text:.60}'")
    points = [tuple(map(decimal, words)) for words in _words_of(text)]
    if not all(len(point) == 3 and all(map(math.isfinite, point)) for point in points):
        files = (
            ", or a file of points (.csv or .mrk.json)"
            if column == "points"
            else "; the column corrections takes a file"
        )
        raise ValueError(
            f"{column}: '{text:.60}' is not a list of points; give x y z of each in LPS mm, with a semicolon "
            f"between points: 1 2 3; 4 5 6{files}"
        )
    if column == "points" and len(points) < 2:
        raise ValueError(f"{column}: a vessel needs at least two points, not {len(points)}; give one at each end")
    return points


def vessel_of(cell: Cell) -> list[tuple[float, ...]]:
    """The points in a vessel; ValueError if the file will not do."""
    points = _from_file("points", read_places, cell) if isinstance(cell, str) else cell
    if len(points) < 2:
        raise ValueError(
            f"points: '{cell}' holds {len(points)} points, and a vessel needs at least two; give one at each end"
        )
    return points


def corrections_of(cells: dict[str, Cell]) -> dict[str, Any]:
    """The arguments of segment(); ValueError if the file will not do."""
    found: list[Constraint] = []
    if "corrections" in cells:
        found = _from_file("corrections", read_points, cells["corrections"])
    arguments = arguments_of(found)
    for name in ("inside", "outside", "boundary"):
        arguments[name] += cells.get(name, [])
    return {name: points for name, points in arguments.items() if points}


def _from_file(column: str, read: Any, path: Any) -> Any:
    try:
        return read(path)
    except FileError as error:
        raise ValueError(f"{column}: {error} Correct the file, or the cell.") from error


def _words_of(text: str) -> Iterable[list[str]]:
    """Of each point; lists as Python and JSON print them are read, too."""
    if "[" in text or "(" in text:
        # Brackets around points are as good as semicolons between them.
        inner = re.findall(r"[\[(]([^\[\]()]*)[\])]", text)
        rest = re.sub(r"[\[(][^\[\]()]*[\])]", "", text)
        if re.search(r"[^\s,;\[\]()]", rest):
            return [["?"]]
        return [part.replace(",", " ").split() for part in inner]
    return [part.replace(",", " ").split() for part in text.split(";") if part.strip()]
