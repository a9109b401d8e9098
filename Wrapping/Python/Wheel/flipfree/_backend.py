"""The package over the kernels alone."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _kernels
from ._branches import Branch
from ._corrections import SEED, Constraint, GivenOrgan
from ._errors import EvaluationError, FlipFreeError, SegmentationError
from ._image import Image
from ._messages import warn, with_names
from ._parameters import ARGUMENTS, names_of, of_several_organs, snake_case
from ._provenance import with_series
from ._questions import questions_of
from ._run import run
from ._segmentation import Segmentation, Surface, Vessel
from ._settings import settings_of
from ._types import Preset, Progress

if TYPE_CHECKING:
    from ._images import AnySurface

SEGMENT_PARAMETERS = settings_of(
    _kernels.SegmentationSettings,
    (
        "vtkFlipFreeSegmentation",
        "vtkSeedRegionDiffusion",
        "vtkGMMFeatureFilter",
        "vtkCorrespondenceSearch",
        "vtkFlipFreeDeform",
    ),
)
NAMES = {**names_of(SEGMENT_PARAMETERS), **ARGUMENTS}
GROUP_PARAMETERS = of_several_organs(SEGMENT_PARAMETERS)
TRACE_PARAMETERS = settings_of(
    _kernels.VesselSettings, ("vtkVesselAlgorithm", "vtkFlipFreeVesselSegmentation")
)
EVALUATE_PARAMETERS = settings_of(_kernels.ScoreSettings, ("vtkSegmentationMetrics",))
# By the fields of Scores: the columns of tables and their units, "" for fractions and texts.
SCORE_COLUMNS: dict[str, tuple[str, str]] = {
    snake_case(name): (name, unit) for name, unit in _kernels.score_columns()
}
SURFACES_PARAMETERS = settings_of(_kernels.LabelSurfaceSettings, ("vtkFlipFreeLabelSurfaces",))
# The shape is an argument of its own.
PHANTOM_PARAMETERS = settings_of(
    _kernels.PhantomSettings, ("vtkPhantomSource",), without=("Shape",)
)

# The least and the greatest radius of a seed.
RADII: tuple[float, float] = _kernels.SEED_RADII

if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_kernels.forget_threads)


def threads() -> int:
    """How many threads the work is shared among; by default, as many as the machine has.

    >>> import flipfree
    >>> flipfree.threads() >= 1
    True
    """
    return int(_kernels.threads())


def set_threads(number: int) -> None:
    """Sets the number of threads from the next work on; 0: as many as the machine has.

    Results are the same bits for any number.

    >>> import flipfree
    >>> flipfree.set_threads(1)
    >>> flipfree.threads()
    1
    >>> flipfree.set_threads(0)
    """
    if number < 0:
        raise ValueError(f"number: {number!r} is negative; 0 takes as many as the machine has")
    _kernels.set_threads(number)


class SegmentationAlgorithm:
    """One run of the whole method."""

    def __init__(self, preset: Preset) -> None:
        self.settings = _kernels.SegmentationSettings(preset)
        self._center = [0.0, 0.0, 0.0]
        self._radius = 0.0
        self._start: Surface | None = None
        self._labels: Image | None = None
        self._label = 1

    def set_seed(self, center: list[float], radius: float) -> None:
        nearest = min(max(radius, RADII[0]), RADII[1])
        if radius == radius and radius != nearest:
            raise ValueError(
                f"radius: {radius!r} is out of range; give {RADII[0]:g} to {RADII[1]:g}"
            )
        self._center, self._radius = center, radius

    def set_start(self, start: AnySurface) -> None:
        self._start = _given("start", start)

    def set_start_labels(self, labels: Image, label: int) -> None:
        self._labels, self._label = labels, label

    def clear_start(self) -> None:
        """The sphere is the start again."""
        self._start = None

    def keep_for_corrections(self) -> None:
        """Nothing is kept: every run begins anew."""

    def run(
        self, image: Image, constraints: tuple[Constraint, ...], tell: Progress | None
    ) -> Segmentation:
        start = self._start
        answer = _segmented(
            lambda report: _kernels.segment(
                *_volume_of(image),
                self._center,
                self._radius,
                start and _arrays_of(start),
                self._labels and _volume_of(self._labels),
                self._label,
                _rows_of(constraints),
                self.settings,
                report,
            ),
            NAMES,
            tell,
        )
        for text in answer["warnings"]:
            warn(with_names(text, NAMES))
        certified = bool(self.settings.get("Guard")[0])
        return Segmentation(
            **_found(answer, image, certified),
            label_map=_labels_of(answer, image),
            questions=questions_of(answer["questions"]),
            history=tuple(
                Surface(**surface, certified=certified) for surface in answer["history"]
            ),
        )


class GroupAlgorithm:
    """Runs of several organs."""

    def __init__(self) -> None:
        self.settings = _kernels.SegmentationSettings("default")
        self._fixed: list[Surface] = []

    def add_fixed(self, fixed: AnySurface) -> None:
        self._fixed.append(_given("fixed", fixed))

    def first_label(self) -> int:
        """The first organ's value in the label map."""
        return int(self.settings.get("LabelValue")[0])

    def run(
        self, image: Image, given: Sequence[GivenOrgan], tell: Progress | None
    ) -> tuple[list[Segmentation], Image]:
        rows = [
            (name, center, radius, _rows_of(points)) for name, center, radius, points in given
        ]
        answer = _segmented(
            lambda report: _kernels.segment_organs(
                *_volume_of(image),
                rows,
                [_arrays_of(surface) for surface in self._fixed],
                self.settings,
                report,
            ),
            NAMES,
            tell,
        )
        names = {label: organ.name for label, organ in enumerate(given, self.first_label())}
        label_map = _labels_of(answer, image, names)
        organs = []
        seconds = tuple(map(sum, zip(*(organ["stage_seconds"] for organ in answer["organs"]))))
        for organ, found in zip(given, answer["organs"]):
            for text in found["warnings"]:
                warn(f"'{organ.name}': {with_names(text, NAMES)}")
            organs.append(
                Segmentation(
                    **{**_found(found, image, certified=True), "stage_seconds": seconds},
                    label_map=label_map,
                    constraints=organ.points,
                    questions=questions_of(found["questions"]),
                )
            )
        return organs, label_map


class VesselAlgorithm:
    """One vessel between points."""

    def __init__(self) -> None:
        self.settings = _kernels.VesselSettings()

    def run(
        self,
        image: Image,
        points: list[tuple[float, ...]],
        constraints: tuple[Constraint, ...],
        tell: Progress | None,
    ) -> Vessel:
        if any(one.kind == SEED for one in constraints):
            raise SegmentationError(
                "No segmentation: a vessel takes no further seeds; give a point along it."
            )
        names = names_of(TRACE_PARAMETERS)
        rows = [(one.kind, *one.place) for one in constraints]
        answer = _segmented(
            lambda report: _kernels.trace(*_volume_of(image), points, rows, self.settings, report),
            names,
            tell,
        )
        for text in answer["warnings"]:
            warn(with_names(text, names))
        return Vessel(
            **_found(answer, image, certified=True),
            label_map=_labels_of(answer, image),
            branches=[Branch(**branch) for branch in answer["branches"]],
            support=answer["support"],
            confidence=answer["confidence"],
        )


class Metrics:
    """One comparison."""

    def __init__(self) -> None:
        self.settings = _kernels.ScoreSettings()

    def run(self, compared: Segmentation | Surface | Image, reference: Image) -> dict[str, Any]:
        names = names_of(EVALUATE_PARAMETERS)
        if isinstance(compared, Image):
            score, arguments = _kernels.score_labels, [_volume_of(compared)]
        else:
            score, arguments = _kernels.score_surface, list(_arrays_of(_mesh_of(compared)))
        answer: dict[str, Any] = run(
            lambda report: score(*arguments, _volume_of(reference), self.settings, report),
            EvaluationError,
            "The segmentation and the reference cannot be compared: {}.",
            names,
        )
        for warning in answer["warnings"]:
            warn(with_names(warning, names))
        return {field: answer[name] for field, (name, _) in SCORE_COLUMNS.items()}


def score_summary(scores: Mapping[str, Any]) -> str:
    """What people read of the fields of Scores, in a few lines."""
    columns = {name: scores[field] for field, (name, _) in SCORE_COLUMNS.items()}
    return str(_kernels.score_summary(columns))


def validity_summary(surface: Surface) -> str:
    """A line that says whether a surface is valid, its open edges, Euler number and self-intersections."""
    return str(
        run(
            lambda report: _kernels.validity_summary(*_arrays_of(surface), report),
            EvaluationError,
            "{}",
            {},
        )
    )


class SurfacesAlgorithm:
    """The surfaces of one label map."""

    def __init__(self) -> None:
        self.settings = _kernels.LabelSurfaceSettings()

    def run(self, labels: Image, only: list[int], tell: Progress | None) -> dict[str, Any]:
        answer: dict[str, Any] = run(
            lambda report: _kernels.make_surfaces(*_volume_of(labels), only, self.settings, report),
            FlipFreeError,
            "No surfaces of labels: {}.",
            {**names_of(SURFACES_PARAMETERS), "Labels": "only"},
            tell,
        )
        for row in answer["rows"]:
            row["Name"] = labels.names.get(row["Label"], "")
        return answer


class PhantomAlgorithm:
    """One phantom."""

    def __init__(self, shape: int) -> None:
        self.settings = _kernels.PhantomSettings()
        self.settings.set("Shape", [shape])

    def run(self) -> tuple[Image, Image, dict[int, Any], tuple[Any, ...]]:
        answer = run(
            lambda report: _kernels.make_phantom(self.settings, report),
            FlipFreeError,
            "No phantom: {}.",
            names_of(PHANTOM_PARAMETERS),
        )
        geometry = (tuple(answer["spacing"]), tuple(answer["origin"]), tuple(answer["direction"]))
        seeds = {label: (tuple(ball[:3]), ball[3]) for label, ball in answer["seeds"].items()}
        return (
            Image(answer["intensities"], *geometry),
            Image(answer["labels"], *geometry),
            seeds,
            tuple(answer["ends"]),
        )


def is_surface(thing: Any) -> bool:
    """Whether it is one, of this package or of VTK, other than a Segmentation's."""
    return isinstance(thing, Surface) or hasattr(thing, "GetPolys")


def _segmented(
    work: Callable[[Callable[[float], bool]], Any],
    names: Mapping[str, str],
    tell: Progress | None,
) -> dict[str, Any]:
    """The kernels' answer, or a SegmentationError."""
    answer: dict[str, Any] = run(work, SegmentationError, "No segmentation: {}.", names, tell)
    return answer


def _found(answer: Mapping[str, Any], image: Image, certified: bool) -> dict[str, Any]:
    """What the kernels say of every organ and vessel, as fields of a Segmentation."""
    surface = answer["surface"]
    provenance = with_series(surface["provenance"], image.series)
    return {
        "mesh": Surface(**{**surface, "provenance": provenance}, certified=certified),
        "iterations": answer["iterations"],
        "stop_reason": answer["stop_reason"],
        "boundary_found": answer["boundary_found"],
        "self_intersections": answer["self_intersections"],
        "stage_seconds": tuple(answer["stage_seconds"]),
        "_image": image,
    }


def _labels_of(
    answer: Mapping[str, Any], image: Image, names: Mapping[int, str] | None = None
) -> Image:
    """The label map, which has the image's geometry."""
    return Image(answer["labels"], image.spacing, image.origin, image.direction, names or {})


def _rows_of(constraints: Iterable[Constraint]) -> list[tuple[Any, ...]]:
    """As the kernels take them: kind, x, y, z, radius."""
    return [(one.kind, *one.place, one.radius) for one in constraints]


def _given(name: str, surface: Any) -> Surface:
    """The surface of an argument of that name."""
    if not is_surface(surface) and not isinstance(surface, Segmentation):
        raise TypeError(
            f"{name}: a flipfree.Surface or a Segmentation is needed, not {surface!r:.80}"
        )
    return _mesh_of(surface)


def _mesh_of(surface: Any) -> Surface:
    if isinstance(surface, (Segmentation, Surface)):
        return surface.mesh if isinstance(surface, Segmentation) else surface
    from ._vtk_objects import surface_of_vtk

    return surface_of_vtk(surface)


def _arrays_of(surface: Surface) -> tuple[Any, Any, Any]:
    """As the kernels take it; arrays that are not theirs any more are copied."""
    import numpy

    return (
        numpy.ascontiguousarray(surface.points, dtype=numpy.float64),
        numpy.ascontiguousarray(surface.corners, dtype=numpy.int32),
        numpy.ascontiguousarray(surface.offsets, dtype=numpy.int32),
    )


def _volume_of(image: Image) -> tuple[Any, Any, Any, Any]:
    return image.voxels, image.spacing, image.origin, image.direction
