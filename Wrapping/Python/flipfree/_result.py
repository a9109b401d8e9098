"""What results have in common, whatever the backend keeps them in."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ._corrections import Constraint, Correctable
from ._faces import Faces
from ._messages import confidence_text, counted
from ._questions import Question

if TYPE_CHECKING:
    import numpy.typing as npt

# The default of fields that are always given: those of the base class have defaults.
GIVEN: Any = None


@dataclass(frozen=True, eq=False, repr=False)
class Result(Faces, Correctable):
    """An organ. Coordinates are the image's physical millimeters."""

    label_map: Any
    """Has the image's geometry; label_value inside, 0 outside; of several organs, that of all."""

    stop_reason: str
    """Such as 'converged'."""

    boundary_found: bool
    """Whether any vertex found the boundary.

    Where none did, segment(), segment_organs() and trace() raise an error.
    """

    self_intersections: int
    """Pairs of faces that intersect for some way to cut them: 0, unless the guard was switched off."""

    history: tuple[Any, ...] = ()
    """The surface after each iteration, with keep_history."""

    constraints: tuple[Constraint, ...] = ()
    """The points that the surface obeys, and further seeds."""

    questions: tuple[Question, ...] = ()
    """Parts of which the segmentation is not sure, those first where an answer is worth most.

    There are at most five; answered() answers them. A vessel has none.
    """

    stage_seconds: tuple[float, ...] = ()
    """Of smoothing, feature, deformation and label map, for organs together of all; of a vessel of path and
    outline, start surface, deformation and label map."""

    _again: Any = field(default=None, compare=False)

    if TYPE_CHECKING:

        @property
        def confidence(self) -> float: ...
        @property
        def points(self) -> npt.NDArray[Any]: ...
        @property
        def iterations(self) -> dict[str, npt.NDArray[Any]]: ...

    def __repr__(self) -> str:
        known = "" if math.isnan(self.confidence) else f"confidence {confidence_text(self.confidence)}, "
        return (
            f"<{type(self).__name__}: {self.volume:.1f} ml, {known}{len(self.points)} vertices, "
            f"{counted(self.self_intersections, 'self-intersection')}, '{self.stop_reason}' after "
            f"{counted(len(self.iterations['Iteration']), 'iteration')}>"
        )


@dataclass(frozen=True, eq=False, repr=False)
class VesselMeasures:
    """What results have in common that are vessels."""

    support: float = math.nan
    """The mean contrast across the outline, of 25 gray values (HU; MR scaled to CT), 0 to 1."""

    confidence: float = math.nan
    """How far the vessel can be trusted, where least, 0 to 1: how well the image shows its outline, and how
    like the vessel is what the path runs through. Doubtful below 0.45, which a FlipFreeWarning says."""
