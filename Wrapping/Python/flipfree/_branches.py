"""Branches of a vessel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy
    import numpy.typing as npt


@dataclass(frozen=True, eq=False, repr=False)
class Branch:
    """A vessel's center from one end, or from the branch that it begins on, to the other."""

    points: npt.NDArray[numpy.float64]
    """Its center as rows (x, y, z), in the image's millimeters."""

    radius: npt.NDArray[numpy.float64]
    """The vessel's radius at each point, in mm."""

    length: npt.NDArray[numpy.float64]
    """How long the center is up to each point, in mm."""

    parent: int
    """The index of the branch that it begins on, -1 for the first."""

    def __repr__(self) -> str:
        return f"<Branch: {self.length[-1]:.0f} mm long, radius {self.radius.mean():.1f} mm>"
