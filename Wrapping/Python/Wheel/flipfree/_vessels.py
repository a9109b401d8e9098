"""Vessels between points, which sessions hold; they are traced as by the toolkit's command."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from . import _kernels
from ._backend import segmentation_of
from ._errors import FlipFreeError, SegmentationError
from ._image import Image
from ._progress import progress_of
from ._run import run
from ._segmentation import Segmentation
from ._types import ProgressOption


def vessel_settings(parameters: Mapping[str, Sequence[float]]) -> Any:
    """By the kernels' names. Raises FlipFreeError that names the parameter that is none or out of range."""
    settings = _kernels.VesselSettings()
    known = {name: count for name, _, count in settings.parameters()}
    for name, values in parameters.items():
        if name not in known:
            *first, last = known
            raise FlipFreeError(
                f"there is no parameter '{name}' of a vessel; there are {', '.join(first)} and {last}"
            )
        if len(values) == known[name]:
            settings.set(name, list(values))
        if settings.get(name) != list(values):
            raise FlipFreeError(f"the parameter '{name}' is out of its range")
    return settings


def trace_vessel(
    image: Image,
    points: Sequence[Sequence[float]],
    parameters: Mapping[str, Sequence[float]],
    label: int,
    progress: ProgressOption,
) -> Segmentation:
    """The vessel that joins the points."""
    settings = vessel_settings(parameters)
    with progress_of(progress, "tracing") as tell:
        answer = run(
            lambda report: _kernels.trace(
                image.voxels,
                image.spacing,
                image.origin,
                image.direction,
                [tuple(point) for point in points],
                label,
                settings,
                report,
            ),
            SegmentationError,
            "No segmentation: {}.",
            {},
            tell,
        )
    return segmentation_of(answer, image, True)
