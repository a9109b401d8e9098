"""`flipfree series`."""

from __future__ import annotations

from typing import Any

from ._atomic import write_table
from ._command_inputs import wants_bar
from ._command_outputs import require_ending, require_place
from ._messages import warn
from ._series import Series
from ._series import series as list_series

COLUMNS = (
    *("number", "uid", "description", "modality", "slices"),
    *("spacing_x", "spacing_y", "spacing_z", "problem"),
)


def series(values: dict[str, Any]) -> None:
    """`flipfree series`."""
    if "csv" in values:
        require_ending("--csv", values["csv"], (".csv",))
        require_place(values["csv"], [])
    found = list_series(values["folder"], progress=wants_bar(values))
    if "csv" in values:
        write_table(values["csv"], list(COLUMNS), [_row_of(one) for one in found])
    if "quiet" not in values:
        _print(found)
    for one in found:
        if one.problem:
            warn(one.problem)


def _row_of(one: Series) -> list[Any]:
    names = [one.number, one.uid, one.description, one.modality, one.slices]
    return [*names, *(one.spacing or (0.0, 0.0, 0.0)), one.problem]


def _print(found: list[Series]) -> None:
    widest = max(3, *(len(one.uid) for one in found))
    heading = ("Number", "UID", "Modality", "Slices", "Spacing (mm)", "Description")
    rows = [heading]
    for one in found:
        spacing = " x ".join(f"{length:g}" for length in one.spacing) if one.spacing else "-"
        rows.append((one.number, one.uid, one.modality, str(one.slices), spacing, one.description))
    for number, uid, modality, slices, spacing, description in rows:
        names = f"{number:>6}  {uid:<{widest}}  {modality:<8}"
        print(f"{names}  {slices:>6}  {spacing:<24}  {description}")
