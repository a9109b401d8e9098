"""The columns and rows of tables as spreadsheet programs write them; the kernels part their cells."""

from __future__ import annotations

import re
from collections.abc import Collection

from . import _kernels
from ._errors import FileError, FlipFreeError
from ._text_files import read_text

# What spreadsheets and pandas call a column without a name.
NAMELESS = re.compile(r"(Unnamed: \d+)?")

Rows = list[dict[str, str]]


def read_csv(name: str) -> tuple[list[str], Rows, bool]:
    """The columns and rows of a file, and whether its numbers may have decimal commas."""
    try:
        lines, separator = _kernels.read_table(name, read_text(name))
    except _kernels.FileProblem as problem:
        raise FileError(str(problem)) from None
    columns = lines[0] if lines else []
    for number, cells in enumerate(lines[1:], 1):
        nameless = [cell for at, cell in enumerate(cells) if at >= len(columns) or not columns[at]]
        if any(nameless):
            raise FileError(
                f"'{name}': row {number} has more cells than there are columns: {cells}. Separate them alike, and "
                "give cells in which the separator occurs quotes."
            )
    rows = [dict(zip(columns, [*cells, *[""] * len(columns)])) for cells in lines[1:]]
    return columns, rows, separator != ","


def tidied(
    name: str, columns: list[str], rows: Rows, known: Collection[str]
) -> tuple[list[str], Rows]:
    """Without empty columns that have no name; columns of the known names have them in lower case."""
    names: dict[str, str] = {}
    for column in columns:
        if NAMELESS.fullmatch(column) and not any(row.get(column, "").strip() for row in rows):
            continue
        own = column.lower() if column.lower() in known else column
        if own in names.values() or columns.count(column) > 1:
            raise FlipFreeError(f"'{name}': there are two columns '{own}'. Rename one, or leave it out.")
        names[column] = own
    return list(names.values()), [
        {own: row[column] for column, own in names.items() if column in row} for row in rows
    ]


def set_decimal_points(name: str, rows: Rows, numeric: Collection[str]) -> None:
    """In place of decimal commas; refuses a table that has both, where a comma may part thousands."""
    places = [(row, column) for row in rows for column in numeric if column in row]
    try:
        cells = _kernels.with_decimal_points(name, [row[column] for row, column in places])
    except _kernels.FileProblem as problem:
        raise FlipFreeError(str(problem)) from None
    for (row, column), cell in zip(places, cells):
        row[column] = cell
