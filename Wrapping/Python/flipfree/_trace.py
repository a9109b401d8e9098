"""Vessels as one function."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ._backend import TRACE_PARAMETERS, VesselAlgorithm
from ._boundary_found import require_vessel_boundary
from ._corrections import Constraint, Points, constraints_of, places_of
from ._parameters import described, set_parameters, signature_with
from ._progress import progress_of
from ._segmentation import Vessel
from ._types import ProgressOption

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._images import AnyImage


def trace(
    image: AnyImage,
    points: Points | npt.NDArray[Any],
    *,
    series: str | None = None,
    inside: Points = (),
    outside: Points = (),
    boundary: Points = (),
    spacing: Sequence[float] | None = None,
    origin: Sequence[float] | None = None,
    direction: npt.ArrayLike | None = None,
    progress: ProgressOption = None,
    **parameters: Any,
) -> Vessel:
    """Segments a vessel, or a tree of vessels, between points.

    image
        As for segment(): an image, the name of a file, or an array[k, j, i] with its spacing (mm)
        and, if wanted, its origin (mm) and direction (3 x 3).
    points
        A list of points (x, y, z) in mm, or an array of shape (n, 3), of two points or more. They lie
        in the vessel: one at each end, more along it or at the ends of its branches, in any
        order. Points 5 mm off do little harm. Coordinates are the image's physical ones, LPS for files.
    inside, outside, boundary
        Lists of points (x, y, z) in mm that correct the result: the surface obeys them as that of
        segment() does, and the path keeps 3 mm away from points outside, where it can. corrected()
        of the result adds more.
    series, spacing, origin, direction, progress
        As for segment().

    Raises SegmentationError if there is no segmentation, FileError if the file cannot be read,
    TypeError and ValueError for parameters that do not exist or are out of range. Issues a
    FlipFreeWarning if the result is doubtful.

    >>> import flipfree
    >>> phantom = flipfree.phantom("vessel")
    >>> aorta = flipfree.trace(phantom.image, [(13.3, 44.6, 44.5), (82, 50.4, 37.6)])
    >>> (branch,) = aorta.branches
    >>> branch, branch.points.shape == (len(branch.radius), 3)
    (<Branch: 99 mm long, radius 4.2 mm>, True)
    >>> aorta.labels.shape, aorta.self_intersections
    ((96, 96, 96), 0)
    >>> thicker = aorta.corrected(inside=[(47.5, 47.5, 62.8)])
    >>> len(thicker.constraints), thicker.volume > aorta.volume
    (1, True)
    >>> flipfree.trace(phantom.image, [(13.3, 44.6, 44.5)])
    Traceback (most recent call last):
      ...
    flipfree.SegmentationError: No segmentation: a vessel needs at least two points, not 1; ...
    """
    from ._segment import _image_of  # not in its type stub

    algorithm = VesselAlgorithm()
    set_parameters("trace", algorithm.settings, TRACE_PARAMETERS, parameters)
    places = places_of("points", points)
    constraints = constraints_of(inside, outside, boundary, ())
    volume = _image_of(image, series, spacing, origin, direction, progress)

    def run(corrections: tuple[Constraint, ...], progress: ProgressOption) -> Vessel:
        with progress_of(progress, "tracing") as tell:
            result = algorithm.run(volume, places, corrections, tell)
        require_vessel_boundary(result)
        return replace(result, constraints=corrections, _again=run)

    return run(constraints, progress)


# Help and completion show the parameters as if they were spelled out above.
trace.__doc__ = f"{trace.__doc__}\n    The other parameters:\n\n{described(TRACE_PARAMETERS)}\n"
_SIGNATURE = signature_with(trace, VesselAlgorithm().settings, TRACE_PARAMETERS)
trace.__signature__ = _SIGNATURE  # type: ignore[attr-defined]
