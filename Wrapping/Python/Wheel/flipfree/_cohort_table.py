"""The table of a cohort: a row is an organ or a vessel in a volume, with all that its segmentation needs, or a
label map that gets surfaces."""

from __future__ import annotations

import difflib
import hashlib
import math
import os
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, get_args

from ._backend import SCORE_COLUMNS, SEGMENT_PARAMETERS, SURFACES_PARAMETERS, TRACE_PARAMETERS
from ._cohort_csv import read_csv, set_decimal_points, tidied
from ._cohort_points import CORRECTIONS, Cell, cell_of, finite, text_of
from ._errors import FlipFreeError
from ._messages import listed
from ._parameters import Parameter
from ._types import PathName, Preset

SEED = ("seed_x", "seed_y", "seed_z", "radius")
REQUIRED = ("volume", *SEED)
OPTIONAL = ("label_map", "series", "case", "organ", "reference", "reference_label", "preset", "points", *CORRECTIONS)
# Known in tables with label maps alone. Of a segmentation, `iterations` is a result.
LABEL_PARAMETERS = {name: entry for name, entry in SURFACES_PARAMETERS.items() if name != "iterations"}
KNOWN = (*REQUIRED, *OPTIONAL, *SEGMENT_PARAMETERS, *TRACE_PARAMETERS)
# All but the texts are numbers, or lists of them.
TEXTS = ("volume", "label_map", "series", "case", "organ", "reference", "preset", "corrections")
NUMERIC = tuple(column for column in KNOWN if column not in TEXTS)
# The scores in a row and their columns, which name the unit: asd_mm.
SCORES = {
    name: "_".join(filter(None, (name, unit)))
    for name, (_, unit) in SCORE_COLUMNS.items()
    if name in ("dice", "jaccard", "asd", "hd95")
}
# Shorter words are near many others.
SHORTEST_SLIP = 5
# What a segmentation adds to a row, and of which type it is.
RESULTS: dict[str, type] = {
    "status": str,
    "message": str,
    "series_read": str,
    "confidence": float,
    "questions": int,
    "first_question": str,
    "segmented_ml": float,
    "iterations": int,
    "stop_reason": str,
    "self_intersections": int,
    **dict.fromkeys(SCORES.values(), float),
    "seconds_reading": float,
    "seconds": float,
    "surface": str,
    "labels": str,
    "centerline": str,
    "surfaces": str,
    "picture": str,
    "worker": str,
}


@dataclass(frozen=True)
class Row:
    """One organ or vessel to segment, or a label map; `problem` says why it cannot be done."""

    name: str
    """Of its folder; no other row has it."""
    cells: dict[str, str]
    """As they stand in the table."""
    volume: str = ""
    """Or the label map."""
    is_label_map: bool = False
    series: str = ""
    """Of a folder of DICOM files, as read_image() takes it."""
    seed: tuple[float, float, float] = (0.0, 0.0, 0.0)
    radius: float = 0.0
    reference: str = ""
    reference_label: int = -1
    parameters: dict[str, Any] = field(default_factory=dict)
    points: dict[str, Cell] = field(default_factory=dict)
    """By the columns that are given: points, or inside, outside, boundary and corrections."""
    number: int = 0
    """Of the row below the table's header; the first is 1."""
    problem: str = ""

    @property
    def is_vessel(self) -> bool:
        """Whether it is found between points and not from a seed."""
        return "points" in self.points


def rows_of(table: PathName | Iterable[Mapping[str, Any]]) -> list[Row]:
    """The rows of a CSV file, a list of mappings or a data frame; files are found from the table's folder."""
    may_have_commas = False
    if isinstance(table, (str, os.PathLike)):
        name = os.fspath(table)
        columns, rows, may_have_commas = read_csv(name)
        folder = os.path.dirname(os.path.abspath(name))
    else:
        name, folder = "table", os.getcwd()
        records = table.to_dict("records") if hasattr(table, "to_dict") else list(table)
        texts = [{str(key): text_of(value) for key, value in record.items()} for record in records]
        rows = [row for row in texts if any(text.strip() for text in row.values())]
        columns = list(dict.fromkeys(column for row in rows for column in row))
    columns, rows = tidied(name, columns, rows, {*KNOWN, *_known_beside(column.lower() for column in columns), *RESULTS})
    _require_columns(name, columns)
    if may_have_commas:
        set_decimal_points(name, rows, (*NUMERIC, *_known_beside(columns)))
    if not rows:
        raise FlipFreeError(f"'{name}' has no rows. Give one row per organ, vessel or label map.")
    made = [_row(cells, folder, number) for number, cells in enumerate(rows, 1)]
    _require_distinct(name, made)
    return made


def _require_columns(name: str, columns: list[str]) -> None:
    # Vessels have no seed, and label maps no volume.
    required = () if "label_map" in columns else ("volume",) if "points" in columns else REQUIRED
    lacking = [column for column in required if column not in columns]
    if lacking:
        raise FlipFreeError(
            f"'{name}' lacks the {'columns' if lacking[1:] else 'column'} {', '.join(lacking)}; it has {', '.join(columns) or 'none'}."
            + (" Vessels have points in their place, and label maps the column label_map." if set(lacking) & set(SEED) else "")
            + (" Separate cells by commas, semicolons or tabs." if not set(columns) & set(KNOWN) else "")
        )
    taken = [column for column in columns if column in RESULTS]
    if taken:
        raise FlipFreeError(
            f"'{name}': the column '{taken[0]}' has the name of a result. Rename it or leave it out."
        )
    all_known = (*KNOWN, *_known_beside(columns))
    for column in columns:
        near = difflib.get_close_matches(column.lower(), all_known, n=1, cutoff=0.85)
        near = near or [known for known in all_known if _is_slip(column.lower(), known)]
        if column not in all_known and near:
            raise FlipFreeError(
                f"'{name}': the column '{column}' is nearly '{near[0]}'. Correct it, or rename it if it "
                "is something else."
            )


def _known_beside(columns: Iterable[str]) -> tuple[str, ...]:
    """What a table of label maps knows besides."""
    return tuple(LABEL_PARAMETERS) if "label_map" in columns else ()


def _is_slip(word: str, known: str) -> bool:
    """Whether a word of some length has a letter more, less or instead, or two letters exchanged."""
    start = len(os.path.commonprefix([word, known]))
    rests = [word[start:], known[start:]]
    end = len(os.path.commonprefix([rest[::-1] for rest in rests]))
    one, other = (rest[: len(rest) - end] for rest in rests)
    return len(word) >= SHORTEST_SLIP and (
        max(len(one), len(other)) == 1 or (len(one) == 2 and one == other[::-1])
    )


def _row(cells: Mapping[str, str], folder: str, number: int = 1) -> Row:
    unknown = set(LABEL_PARAMETERS) - {*KNOWN, *_known_beside(cells)}
    given = {
        column: text.strip() for column, text in cells.items() if text and text.strip() and column not in unknown
    }
    row = Row(name=_name(given), cells=dict(cells), number=number)
    try:
        make = _label_map if "label_map" in given else _vessel if "points" in given else _organ
        return replace(row, **make(given, folder))
    except ValueError as error:
        return replace(row, problem=f"row {number}, column {error}")


def _organ(given: Mapping[str, str], folder: str) -> dict[str, Any]:
    if not any(column in given for column in SEED[:3]):
        raise ValueError("seed_x: the cell is empty; a row needs a seed, or points in a vessel, or a label map")
    return {
        **_files(given, folder),
        "seed": (_number(given, "seed_x"), _number(given, "seed_y"), _number(given, "seed_z")),
        "radius": _number(given, "radius"),
        "parameters": _parameters(given, "an organ", SEGMENT_PARAMETERS),
        "points": {name: cell_of(name, given[name], folder) for name in CORRECTIONS if name in given},
    }


def _vessel(given: Mapping[str, str], folder: str) -> dict[str, Any]:
    for column in ("seed_x", "seed_y", "seed_z", "preset", *CORRECTIONS):
        if column in given:
            raise ValueError(
                f"{column}: a row with points is a vessel, which has none; empty this cell, or that of points"
            )
    return {
        **_files(given, folder),
        "parameters": _parameters(given, "a vessel", TRACE_PARAMETERS),
        "points": {"points": cell_of("points", given["points"], folder)},
    }


def _label_map(given: Mapping[str, str], folder: str) -> dict[str, Any]:
    for column in (*REQUIRED, "series", "reference", "reference_label", "preset", "points", *CORRECTIONS):
        if column in given:
            raise ValueError(
                f"{column}: a row with a label map takes no volume, reference, seed or points; empty this cell, or that "
                "of label_map"
            )
    return {
        "volume": _path(folder, given["label_map"]),
        "is_label_map": True,
        "parameters": _parameters(given, "a label map", LABEL_PARAMETERS),
    }


def _files(given: Mapping[str, str], folder: str) -> dict[str, Any]:
    label = _whole(given, "reference_label") if "reference_label" in given else -1
    return {
        "volume": _path(folder, _cell(given, "volume")),
        "series": given.get("series", ""),
        "reference": _path(folder, given.get("reference", "")),
        "reference_label": label,
    }


def _name(given: Mapping[str, str]) -> str:
    """Case and organ, or else the volume's name and a few letters that stand for its seed or points."""
    words = [given[column] for column in ("case", "organ") if column in given]
    if "case" not in given:
        file = os.path.basename(given.get("volume", given.get("label_map", "")))
        stem = re.sub(r"\.(nii|nii\.gz|nrrd|nhdr|mha|mhd)$", "", file)
        seed = " ".join(
            [
                *(given.get(column, "") for column in REQUIRED),
                *(word for column in ("points", "series", "label_map") for word in given.get(column, "").split()),
            ]
        )
        words = [stem or "row", *words, hashlib.sha256(seed.encode()).hexdigest()[:6]]
    return re.sub(r"[^\w.-]+", "_", "-".join(words)).strip("._") or "row"


def _require_distinct(name: str, rows: list[Row]) -> None:
    numbers: dict[str, list[int]] = {}
    for row in rows:
        numbers.setdefault(row.name.lower(), []).append(row.number)
    for row in rows:
        same = numbers[row.name.lower()]
        if len(same) > 1:
            raise FlipFreeError(
                f"'{name}': rows {listed(map(str, same))} are all called '{row.name}'. Give each its own pair of "
                "case and organ, or remove what is there twice."
            )


def _parameters(
    given: Mapping[str, str], what: str, own: Mapping[str, Parameter]
) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for column in given:
        # An organ's radius is its seed's.
        if column in own:
            values[column] = _value(given, column, own[column].type)
        elif column == "preset":
            if given[column] not in get_args(Preset):
                raise ValueError(
                    f"preset: '{given[column]}' does not exist; there are {', '.join(get_args(Preset))}"
                )
            values[column] = given[column]
        elif column in (*SEGMENT_PARAMETERS, *TRACE_PARAMETERS, *LABEL_PARAMETERS) and column not in SEED:
            raise ValueError(f"{column}: {what} has no such parameter; empty the cell")
    return values


def _value(given: Mapping[str, str], column: str, kind: type) -> Any:
    if kind is tuple:
        return tuple(_float(column, word) for word in given[column].split())
    if kind is bool:
        words = {"true": True, "1": True, "yes": True, "false": False, "0": False, "no": False}
        if given[column].lower() not in words:
            raise ValueError(f"{column}: true or false is needed, not '{given[column]}'")
        return words[given[column].lower()]
    return _whole(given, column) if kind is int else kind(_number(given, column))


def _whole(given: Mapping[str, str], column: str) -> int:
    number = _number(given, column)
    if not number.is_integer():
        raise ValueError(f"{column}: a whole number is needed, not '{given[column]}'")
    return int(number)


def _number(given: Mapping[str, str], column: str) -> float:
    return _float(column, _cell(given, column))


def _float(column: str, text: str) -> float:
    number = finite(text)
    if math.isnan(number):
        raise ValueError(f"{column}: a number is needed, not '{text}'")
    return number


def _cell(given: Mapping[str, str], column: str) -> str:
    if column not in given:
        needed = "a file or a folder of DICOM files" if column == "volume" else "a number"
        raise ValueError(f"{column}: the cell is empty; {needed} is needed")
    return given[column]


def _path(folder: str, name: str) -> str:
    return os.path.normpath(os.path.join(folder, name)) if name else ""
