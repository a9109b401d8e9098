"""Questions about parts of which a segmentation is not sure."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

# Of tables of questions.
COLUMNS = ("x", "y", "z", "volume_ml", "included", "margin")


@dataclass(frozen=True)
class Question:
    """Is this a part of the organ? Yes is an inside point at its place, no an outside point."""

    place: tuple[float, float, float]
    """Where the part is deepest, in the image's millimeters."""

    volume: float
    """Of the part, in ml."""

    included: bool
    """Whether the segmentation has it in the organ."""

    margin: float
    """By how much the contrary costs more, per mm³: the smaller, the more doubtful."""

    def __str__(self) -> str:
        """The question in words.

        >>> print(Question((83.75, -42.0, 7.0), 410.2, included=False, margin=1.1))
        Is the part of 410 ml at (84, -42, 7) mm organ? It is left out.
        """
        place = ", ".join(f"{round(x)}" for x in self.place)
        state = "included" if self.included else "left out"
        return f"Is the part of {self.volume:.0f} ml at ({place}) mm organ? It is {state}."

    def row(self) -> list[Any]:
        """As in tables."""
        return [*self.place, self.volume, int(self.included), self.margin]


def questions_of(columns: Mapping[str, Iterable[Any]]) -> tuple[Question, ...]:
    """The rows of a table, given by its columns."""
    rows = zip(*(columns[name] for name in COLUMNS))
    return tuple(
        Question((float(x), float(y), float(z)), float(volume), bool(included), float(margin))
        for x, y, z, volume, included, margin in rows
    )
