"""Points that correct a segmentation, as files: tables, and markups of 3D Slicer."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from typing import Any

from ._corrections import SEED, Constraint
from ._errors import FileError

ENDINGS = (".csv", ".mrk.json")
KINDS = ("outside", "inside", "boundary", "seed")
SCHEMA = (
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
    "Schema/markups-schema-v1.0.3.json#"
)


class _Wrong(Exception):
    """What is wrong in a file."""


def read_points(path: str) -> dict[str, list[Any]]:
    """The arguments of segment(): inside, outside, boundary, and seeds."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            text = file.read()
    except (OSError, UnicodeDecodeError) as error:
        raise FileError(f"'{path}' cannot be read. Check the name and the permissions.") from error
    read = _read_table if path.lower().endswith(".csv") else _read_markups
    points: dict[str, list[Any]] = {"inside": [], "outside": [], "boundary": [], "seeds": []}
    try:
        for kind, place, radius in read(text):
            points["seeds" if kind == "seed" else kind].append((place, radius) if kind == "seed" else place)
    except _Wrong as error:
        raise FileError(f"'{path}', {error}.") from error
    except (LookupError, TypeError, AttributeError, json.JSONDecodeError) as error:
        raise FileError(
            f"'{path}' does not hold markups of 3D Slicer. Give a file of control points that it has "
            "saved, or a table (.csv) with the columns kind, x, y, z and radius."
        ) from error
    return points


def write_points(path: str, constraints: tuple[Constraint, ...]) -> None:
    """Writes all of them."""
    text = _table(constraints) if path.lower().endswith(".csv") else _markups(constraints)
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(text)


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise _Wrong(f"'{text}' is no number")
    return number


def _proper(kind: str, place: list[float], radius: float) -> tuple[str, list[float], float]:
    if kind not in KINDS:
        raise _Wrong(f"the kind is '{kind}'; it can be outside, inside, boundary or seed")
    if kind == "seed" and not radius > 0:
        raise _Wrong("a seed has no radius")
    return kind, place, radius


def _read_table(text: str) -> list[tuple[str, list[float], float]]:
    points = []
    for number, row in enumerate(csv.reader(io.StringIO(text)), 1):
        cells = [cell.strip() for cell in row]
        if not any(cells) or (number == 1 and cells[0].lower() == "kind"):
            continue
        try:
            if len(cells) not in (4, 5):
                raise _Wrong(f"there are {len(cells)} cells; there are kind, x, y, z and, of a seed, radius")
            radius = _number(cells[4]) if len(cells) == 5 and cells[4] else 0.0
            points.append(_proper(cells[0].lower(), [_number(cell) for cell in cells[1:4]], radius))
        except _Wrong as error:
            raise _Wrong(f"line {number}: {error}") from error
    return points


def _read_markups(text: str) -> list[tuple[str, list[float], float]]:
    points = []
    for group in json.loads(text)["markups"]:
        # Files before version 1.0.1 have a number: 0 for RAS.
        system = str(group.get("coordinateSystem", "LPS"))
        if system not in ("LPS", "RAS", "0", "1"):
            raise _Wrong(f"the coordinate system is {system}; it can be LPS or RAS")
        sign = -1.0 if system in ("RAS", "0") else 1.0
        for control in group["controlPoints"]:
            # 3D Slicer numbers its points: inside-1.
            words = control["label"].split() or [""]
            place = [float(x) for x in control["position"]]
            place = [sign * place[0], sign * place[1], place[2]]
            try:
                if not all(map(math.isfinite, place)):
                    raise _Wrong("its position is not finite")
                radius = _number(words[1]) if len(words) > 1 else 0.0
                points.append(_proper(re.split("[-_]", words[0])[0].lower(), place, radius))
            except _Wrong as error:
                raise _Wrong(
                    f'control point "{control["label"]}": {error}; its label begins with its kind'
                ) from error
    return points


def _table(constraints: tuple[Constraint, ...]) -> str:
    lines = ["kind,x,y,z,radius"]
    for one in constraints:
        radius = f"{one.radius:.17g}" if one.kind == SEED else ""
        lines.append(",".join([KINDS[one.kind], *(f"{x:.17g}" for x in one.place), radius]))
    return "\n".join(lines) + "\n"


def _markups(constraints: tuple[Constraint, ...]) -> str:
    controls = [
        {
            "id": str(number),
            "label": KINDS[one.kind] + (f" {one.radius:.17g}" if one.kind == SEED else ""),
            "position": list(one.place),
            "selected": True,
            "locked": False,
            "visibility": True,
            "positionStatus": "defined",
        }
        for number, one in enumerate(constraints, 1)
    ]
    fiducials = {
        "type": "Fiducial",
        "coordinateSystem": "LPS",
        "coordinateUnits": "mm",
        "controlPoints": controls,
    }
    return json.dumps({"@schema": SCHEMA, "markups": [fiducials]}, indent=2) + "\n"
