"""Points as files: tables, which the kernels read, and markups of 3D Slicer.

The toolkit's command reads markups that correct a segmentation, too (PointFile.cxx); a test holds the two
together.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from . import _kernels
from ._atomic import write_text
from ._coordinates import swap_lps_ras
from ._corrections import SEED, Constraint
from ._errors import FileError
from ._messages import listed, warn
from ._text_files import read_text

ENDINGS = (".csv", ".mrk.json")
KINDS = ("outside", "inside", "boundary", "seed")
SCHEMA = (
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
    "Schema/markups-schema-v1.0.3.json#"
)
SAME_PLACE = 1e-3  # mm; points of a stroke that are nearer than this are one
# Millimeters per unit, by UCUM's codes: a factor, and a divisor, so that whole micrometers are exact.
UNITS = {
    "nm": (1.0, 1e6),
    "um": (1.0, 1e3),
    "mm": (1.0, 1.0),
    "cm": (10.0, 1.0),
    "dm": (100.0, 1.0),
    "m": (1000.0, 1.0),
    "[in_i]": (25.4, 1.0),
}


class _Wrong(Exception):
    """What is wrong in a file."""


def read_points(path: str, what_takes_places: str = "") -> list[Constraint]:
    """The points that correct a segmentation, in the file's order; raises FileError.

    Of a table of x, y and z alone, the error says what takes it, if anything.
    """
    of_table = partial(_constraints_of_table, what_takes_places)
    found = _read(path, of_table, _constraint_of_control, "kind, x, y, z and radius")
    if not found:
        warn(f"'{path}' holds no points, so nothing is corrected by it.")
    return found


def read_places(path: str) -> list[tuple[float, ...]]:
    """Points of one kind: a table of x, y, z, or control points of any label; raises FileError."""
    return _read(path, _places_of_table, _place_of_control, "x, y and z")


def read_stroke(path: str) -> list[tuple[float, ...]]:
    """The distinct places of a stroke, which has some; raises FileError."""
    places: list[tuple[float, ...]] = []
    for place in read_places(path):  # a closed curve comes back to its first
        if all(math.dist(place, other) >= SAME_PLACE for other in places):
            places.append(place)
    if not places:
        raise FileError(f"'{path}' holds no points. Draw the stroke, or leave the option out.")
    return places


def arguments_of(constraints: Sequence[Constraint]) -> dict[str, Any]:
    """The arguments of segment(): inside, outside, boundary, and seeds."""
    arguments: dict[str, Any] = {"outside": [], "inside": [], "boundary": [], "seeds": []}
    for one, values in ((one, list(arguments.values())[one.kind]) for one in constraints):
        values.append((one.place, one.radius) if one.kind == SEED else one.place)
    return arguments


def write_points(path: str, constraints: Sequence[Constraint]) -> None:
    """Writes all of them."""
    text = _table(constraints) if path.lower().endswith(".csv") else _markups(constraints)
    write_text(path, text)


def _read(
    path: str,
    of_table: Callable[[str, str], list[Any]],
    of_control: Callable[[str, list[float]], Any],
    columns: str,
) -> list[Any]:
    text = read_text(path)
    try:
        if path.lower().endswith(".csv"):
            return of_table(path, text)
        return _of_markups(text, of_control)
    except _kernels.FileProblem as problem:
        raise FileError(str(problem)) from None
    except _Wrong as error:
        raise FileError(f"'{path}', {error}.") from error
    except (LookupError, TypeError, AttributeError, ValueError, RecursionError) as error:
        raise FileError(
            f"'{path}' does not hold markups of 3D Slicer. Give a file of control points that it has "
            f"saved, or a table (.csv) with the columns {columns}."
        ) from error


def _constraints_of_table(what_takes_places: str, path: str, text: str) -> list[Constraint]:
    rows = _kernels.read_constraint_table(path, text, what_takes_places)
    return [Constraint(kind, tuple(place), radius) for kind, place, radius in rows]


def _places_of_table(path: str, text: str) -> list[tuple[float, ...]]:
    return [tuple(place) for place in _kernels.read_place_table(path, text)]


def _of_markups(text: str, of_control: Callable[[str, list[float]], Any]) -> list[Any]:
    found = []
    content = json.loads(text, parse_float=_json_float, parse_int=_json_int, parse_constant=_json_float)
    _dumped(content).encode()  # not all that JSON can spell is text
    for group in _list(content["markups"]):
        is_ras, unit = _frame(group)
        for number, control in enumerate(_list(group["controlPoints"]), 1):
            if not _is_placed(control):
                continue
            label = control.get("label", "")
            if not isinstance(label, str):
                raise TypeError("label")
            position = _list(control["position"])
            try:
                if len(position) != 3 or not all(type(x) in (int, float) for x in position):
                    raise _Wrong("its position is not three numbers")
                place = [float(x) * UNITS[unit][0] / UNITS[unit][1] for x in position]
                found.append(of_control(label, swap_lps_ras(place) if is_ras else place))
            except _Wrong as error:
                raise _Wrong(f"control point {_dumped(label) if label else number}: {error}") from error
    return found


def _frame(group: dict[str, Any]) -> tuple[bool, str]:
    """Whether the coordinates are RAS, and their unit."""
    # Files before version 1.0.1 have a number: 0 for RAS.
    system = group.get("coordinateSystem", "LPS")
    name = system if isinstance(system, str) else _dumped(system)
    if name not in ("LPS", "RAS", "0", "1"):
        raise _Wrong(f"the coordinate system is {_dumped(system)}; it can be LPS or RAS")
    # From version 1.0.4 on, the code is the first word of a coded entry.
    unit = group.get("coordinateUnits", "mm")
    unit = unit[0] if isinstance(unit, list) and unit else unit
    if not isinstance(unit, str) or unit not in UNITS:
        raise _Wrong(f"the unit of coordinates is {_dumped(unit)}; it can be {listed(tuple(UNITS), 'or')}")
    return name in ("RAS", "0"), unit


def _is_placed(control: dict[str, Any]) -> bool:
    """3D Slicer also saves points that are yet to be placed, with or without a position."""
    return bool(control.get("positionStatus", "defined") == "defined" and control["position"] != "")


def _constraint_of_control(label: str, place: list[float]) -> Constraint:
    words = [*re.findall(r"[^ \t\n\v\f\r]+", label), "", ""]
    # 3D Slicer numbers its points: inside-1.
    kind = _lower(re.split("[-_]", words[0])[0])
    try:
        return _constraint(kind, place, _number(words[1]) if kind == "seed" and words[1] else 0.0)
    except _Wrong as error:
        raise _Wrong(f"{error}; its label begins with its kind") from error


def _place_of_control(_label: str, place: list[float]) -> tuple[float, ...]:
    return tuple(place)


def _constraint(kind: str, place: list[float], radius: float) -> Constraint:
    if kind not in KINDS:
        raise _Wrong(f"the kind is '{kind}'; it can be outside, inside, boundary or seed")
    if kind == "seed" and not radius > 0:
        raise _Wrong("a seed has no radius")
    return Constraint(KINDS.index(kind), tuple(place), radius if kind == "seed" else 0.0)


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
    """A number as tables have it, or NaN.

    >>> decimal("-1.5e1"), decimal("1_0"), decimal("inf"), decimal("1e999")
    (-15.0, nan, nan, nan)
    """
    return finite(text) if re.fullmatch("[0-9+.eE-]+", text) else math.nan


def _number(text: str) -> float:
    number = decimal(text)
    if math.isnan(number):
        raise _Wrong(f"'{text}' is not a number")
    return number


def _json_float(text: str) -> float:
    """A number of JSON; NaN, Infinity and 1e999 are none."""
    number = finite(text)
    if math.isnan(number):
        raise ValueError(text)
    return number


def _json_int(text: str) -> float:
    return int(text) if len(text) < 19 else _json_float(text)


def _list(value: Any) -> list[Any]:
    if not isinstance(value, list):
        raise TypeError("no list")
    return value


def _lower(text: str) -> str:
    """Of letters from A to Z."""
    return re.sub("[A-Z]+", lambda letters: letters[0].lower(), text)


def _dumped(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"), sort_keys=True)


def _table(constraints: Sequence[Constraint]) -> str:
    lines = ["kind,x,y,z,radius"]
    for one in constraints:
        radius = f"{one.radius:.17g}" if one.kind == SEED else ""
        lines.append(",".join([KINDS[one.kind], *(f"{x:.17g}" for x in one.place), radius]))
    return "\n".join(lines) + "\n"


def _markups(constraints: Sequence[Constraint]) -> str:
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
    content = {"@schema": SCHEMA, "markups": [fiducials]}
    return json.dumps(content, indent=2, sort_keys=True) + "\n"
