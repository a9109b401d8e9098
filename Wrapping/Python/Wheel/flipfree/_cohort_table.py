"""The table of a cohort: a row is an organ in a volume, with all that its segmentation needs."""

from __future__ import annotations

import csv
import difflib
import hashlib
import math
import os
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, get_args

from ._backend import SEGMENT_PARAMETERS
from ._errors import FileError, FlipFreeError
from ._types import PathName, Preset

SEED = ("seed_x", "seed_y", "seed_z", "radius")
REQUIRED = ("volume", *SEED)
OPTIONAL = ("case", "organ", "reference", "reference_label", "preset")
# What a segmentation adds to a row, and of which type it is.
RESULTS: dict[str, type] = {
    "status": str,
    "message": str,
    "confidence": float,
    "segmented_ml": float,
    "iterations": int,
    "stop_reason": str,
    "self_intersections": int,
    "dice": float,
    "jaccard": float,
    "asd_mm": float,
    "hd95_mm": float,
    "seconds_reading": float,
    "seconds": float,
    "surface": str,
    "labels": str,
    "picture": str,
    "worker": str,
}


@dataclass(frozen=True)
class Row:
    """One organ to segment; `problem` says why it cannot be."""

    name: str
    """Of its folder; no other row has it."""
    cells: dict[str, str]
    """As they stand in the table."""
    volume: str = ""
    seed: tuple[float, float, float] = (0.0, 0.0, 0.0)
    radius: float = 0.0
    reference: str = ""
    reference_label: int = -1
    parameters: dict[str, Any] = field(default_factory=dict)
    problem: str = ""


def rows_of(table: PathName | Iterable[Mapping[str, Any]]) -> list[Row]:
    """The rows of a CSV file, a list of mappings or a data frame; files are found from the table's folder."""
    if isinstance(table, (str, os.PathLike)):
        name = os.fspath(table)
        columns, rows = _read(name)
        folder = os.path.dirname(os.path.abspath(name))
    else:
        name, folder = "table", os.getcwd()
        records = table.to_dict("records") if hasattr(table, "to_dict") else list(table)
        rows = [{key: _text(value) for key, value in record.items()} for record in records]
        columns = list(dict.fromkeys(column for row in rows for column in row))
    _require_columns(name, columns)
    if not rows:
        raise FlipFreeError(f"'{name}' has no rows. Give one row per organ.")
    made = [_row(cells, folder) for cells in rows]
    _require_distinct(name, made)
    return made


def _read(name: str) -> tuple[list[str], list[dict[str, str]]]:
    try:
        with open(name, encoding="utf-8-sig", newline="") as file:
            reader = csv.DictReader(file, restkey="", restval="")
            rows = [row for row in reader if any(row.values())]
            columns = list(reader.fieldnames or [])
    except OSError as error:
        raise FileError(
            f"'{name}' cannot be read ({error.strerror}). Check its name and permissions."
        ) from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise FileError(f"'{name}' is no CSV file in UTF-8 ({error}). Save the table as one.") from error
    long = next((row for row in rows if "" in row), None)
    if long is not None:
        raise FileError(f"'{name}': a row has more cells than there are columns: {list(long.values())}.")
    return columns, rows


def _text(value: Any) -> str:
    missing = value is None or (isinstance(value, float) and math.isnan(value))
    return "" if missing else str(value)


def _require_columns(name: str, columns: list[str]) -> None:
    lacking = [column for column in REQUIRED if column not in columns]
    if lacking:
        raise FlipFreeError(
            f"'{name}' lacks the columns {', '.join(lacking)}; it has {', '.join(columns) or 'none'}."
        )
    taken = [column for column in columns if column in RESULTS]
    if taken:
        raise FlipFreeError(
            f"'{name}': the column '{taken[0]}' has the name of a result. Rename it or leave it out."
        )
    known = [*REQUIRED, *OPTIONAL, *SEGMENT_PARAMETERS]
    for column in columns:
        near = difflib.get_close_matches(column, known, n=1, cutoff=0.85)
        if column not in known and near:
            raise FlipFreeError(
                f"'{name}': the column '{column}' is nearly '{near[0]}'. Correct it, or rename it if it "
                "is something else."
            )


def _row(cells: Mapping[str, str], folder: str) -> Row:
    given = {column: text.strip() for column, text in cells.items() if text and text.strip()}
    name = _name(given)
    try:
        return Row(
            name=name,
            cells=dict(cells),
            volume=_path(folder, _cell(given, "volume")),
            seed=(_number(given, "seed_x"), _number(given, "seed_y"), _number(given, "seed_z")),
            radius=_number(given, "radius"),
            reference=_path(folder, given.get("reference", "")),
            reference_label=int(_number(given, "reference_label")) if "reference_label" in given else -1,
            parameters=_parameters(given),
        )
    except ValueError as error:
        return Row(name=name, cells=dict(cells), problem=str(error))


def _name(given: Mapping[str, str]) -> str:
    """Case and organ, or else the volume's name and a few letters that stand for its seed."""
    words = [given[column] for column in ("case", "organ") if column in given]
    if "case" not in given:
        stem = re.sub(r"\.(nii|nii\.gz|nrrd|nhdr|mha|mhd)$", "", os.path.basename(given.get("volume", "")))
        seed = " ".join(given.get(column, "") for column in REQUIRED)
        words = [stem or "row", *words, hashlib.sha256(seed.encode()).hexdigest()[:6]]
    return re.sub(r"[^\w.-]+", "_", "-".join(words)).strip("._") or "row"


def _require_distinct(name: str, rows: list[Row]) -> None:
    seen: set[str] = set()
    for row in rows:
        if row.name.lower() in seen:
            raise FlipFreeError(
                f"'{name}': two rows are called '{row.name}'. Give each its own pair of case and organ."
            )
        seen.add(row.name.lower())


def _parameters(given: Mapping[str, str]) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for column, text in given.items():
        if column in SEGMENT_PARAMETERS:
            values[column] = _value(given, column, SEGMENT_PARAMETERS[column].type)
        elif column == "preset":
            if text not in get_args(Preset):
                raise ValueError(f"preset: '{text}' does not exist; there are {', '.join(get_args(Preset))}")
            values[column] = text
    return values


def _value(given: Mapping[str, str], column: str, kind: type) -> Any:
    if kind is tuple:
        return tuple(_float(column, word) for word in given[column].split())
    if kind is bool:
        words = {"true": True, "1": True, "yes": True, "false": False, "0": False, "no": False}
        if given[column].lower() not in words:
            raise ValueError(f"{column}: true or false is needed, not '{given[column]}'")
        return words[given[column].lower()]
    number = _number(given, column)
    if kind is int and not number.is_integer():
        raise ValueError(f"{column}: a whole number is needed, not '{given[column]}'")
    return kind(number)


def _number(given: Mapping[str, str], column: str) -> float:
    return _float(column, _cell(given, column))


def _float(column: str, text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"{column}: a number is needed, not '{text}'")
    return number


def _cell(given: Mapping[str, str], column: str) -> str:
    if column not in given:
        raise ValueError(f"{column}: the cell is empty")
    return given[column]


def _path(folder: str, name: str) -> str:
    return os.path.normpath(os.path.join(folder, name)) if name else ""
