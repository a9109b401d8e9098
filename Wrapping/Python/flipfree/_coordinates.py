"""Coordinates of the patient: LPS millimeters are the package's; some viewers and files have RAS."""

from __future__ import annotations

from typing import Any


def swap_lps_ras(rows: Any) -> list[Any]:
    """An LPS point as RAS, or the other way; also the three rows of a matrix.

    >>> swap_lps_ras([1.0, -2.0, 3.0])
    [-1.0, 2.0, 3.0]
    """
    return [-rows[0], -rows[1], rows[2]]
