"""Tables as spreadsheet programs write them: their separators, decimal commas, and empty rows and columns."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Collection

from ._errors import FileError, FlipFreeError

SEPARATORS = (",", ";", "\t")
# What spreadsheets and pandas call a column without a name.
NAMELESS = re.compile(r"(Unnamed: \d+)?")

Rows = list[dict[str, str]]


def read_csv(name: str) -> tuple[list[str], Rows, bool]:
    """The columns and rows of a file, and whether its numbers may have decimal commas."""
    try:
        with open(name, encoding="utf-8-sig", newline="") as file:
            text = file.read()
        lines, separator = _lines_of(text)
    except OSError as error:
        raise FileError(
            f"'{name}' cannot be read ({error.strerror}). Check its name and permissions."
        ) from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise FileError(f"'{name}' is not a CSV file in UTF-8 ({error}). Save the table as CSV in UTF-8.") from error
    columns = [cell.strip() for cell in lines[0]] if lines else []
    for number, cells in enumerate(lines[1:], 1):
        nameless = [cell for at, cell in enumerate(cells) if at >= len(columns) or not columns[at]]
        if any(cell.strip() for cell in nameless):
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
    cells = [(row, column) for row in rows for column in numeric if column in row]
    commas = [(row, column) for row, column in cells if _has_mark(",", row[column])]
    points = [row[column] for row, column in cells if _has_mark(".", row[column])]
    if commas and points:
        row, column = commas[0]
        raise FlipFreeError(
            f"'{name}': some numbers have a decimal point ({points[0]:.40}), and others a comma ({row[column]:.40}). "
            "Write all of them alike."
        )
    for row, column in commas:
        row[column] = row[column].replace(",", ".")


def _has_mark(mark: str, text: str) -> bool:
    """Whether it is a number, or several as in a list of points, with this decimal mark."""
    number = re.compile(rf"[+-]?(\d+([{mark}]\d*)?|[{mark}]\d+)([eE][+-]?\d+)?")
    words = [word for word in re.split(r"[\s;]+", text) if word]
    return mark in text and all(number.fullmatch(word) for word in words)


def _lines_of(text: str) -> tuple[list[list[str]], str]:
    """The cells of lines that are not empty, and what separates them."""
    first, _, rest = text.partition("\n")
    # Some programs say it in a line of its own.
    said = re.fullmatch(r'"?sep=([^\w\s"]|\t)"?[\s,;]*', first, re.IGNORECASE)
    if said:
        return _lines_by(said[1], rest), said[1]
    # Names of columns have none of them.
    tried = [(separator, _lines_by(separator, text)) for separator in SEPARATORS]
    separator, lines = max(tried, key=lambda one: len(one[1][0]) if one[1] else 0)
    return lines, separator


def _lines_by(separator: str, text: str) -> list[list[str]]:
    lines = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    return [cells for cells in lines if any(cell.strip() for cell in cells)]
