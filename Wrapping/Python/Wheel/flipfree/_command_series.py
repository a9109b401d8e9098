"""`flipfree series`."""

from __future__ import annotations

from typing import Any

from . import _kernels
from ._atomic import write_table
from ._command import say
from ._command_outputs import wants_bar
from ._messages import warn
from ._series import Series
from ._series import series as list_series

COLUMNS = (
    *("number", "uid", "description", "modality", "slices"),
    *("spacing_x", "spacing_y", "spacing_z", "problem"),
)
UNREADABLE = (0.0, 0.0, 0.0)  # in place of the spacing


def series(request: Any) -> None:
    """`flipfree series`."""
    found = list_series(request.folder, progress=wants_bar(request))
    if request.csv:
        write_table(request.csv, list(COLUMNS), [_row_of(one) for one in found])
    if not request.quiet:
        rows = [
            (one.number, one.uid, one.modality, one.slices, one.spacing or UNREADABLE, one.description)
            for one in found
        ]
        say(_kernels.series_text(rows))
    for one in found:
        if one.problem:
            warn(one.problem)


def _row_of(one: Series) -> list[Any]:
    names = [one.number, one.uid, one.description, one.modality, one.slices]
    return [*names, *(one.spacing or UNREADABLE), one.problem]
