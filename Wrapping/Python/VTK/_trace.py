"""Vessels as one function."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

from ._errors import SegmentationError
from ._parameters import described, floats, names_of, set_parameters, signature_with
from ._progress import progress_of
from ._properties import properties_of
from ._segmentation import Segmentation
from ._types import ProgressOption
from ._update import update
from .FlipFreeSegmentation import vtkFlipFreeVesselSegmentation

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._images import AnyImage

TRACE_PARAMETERS = properties_of(vtkFlipFreeVesselSegmentation())


@dataclass(frozen=True, repr=False)
class Vessel(Segmentation):
    """A vessel, or a tree of vessels. Coordinates are the image's physical millimeters."""

    centerline: vtkPolyData = None  # type: ignore[assignment]
    """A poly line per branch, with the point arrays `Radius` and `ArcLength`."""

    @property
    def branches(self) -> list[dict[str, npt.NDArray[Any]]]:
        """Per branch the `points` (x, y, z) of its centerline, and `radius` and `length` at each."""
        from vtkmodules.util.numpy_support import vtk_to_numpy

        points = vtk_to_numpy(self.centerline.GetPoints().GetData())
        data = self.centerline.GetPointData()
        radius = vtk_to_numpy(data.GetArray("Radius"))
        length = vtk_to_numpy(data.GetArray("ArcLength"))
        offsets = vtk_to_numpy(self.centerline.GetLines().GetOffsetsArray())
        return [
            {"points": points[a:b], "radius": radius[a:b], "length": length[a:b]}
            for a, b in zip(offsets[:-1], offsets[1:])
        ]


def trace(
    image: AnyImage,
    points: Sequence[Sequence[float]],
    *,
    spacing: Sequence[float] | None = None,
    origin: Sequence[float] | None = None,
    direction: npt.ArrayLike | None = None,
    progress: ProgressOption = None,
    **parameters: Any,
) -> Vessel:
    """Segments a vessel, or a tree of vessels, between points.

    The points (x, y, z), in millimeters, lie in the vessel: one at either end, more on its way or at
    the ends of its branches, in any order. Points 5 mm off do little harm. Coordinates are the
    image's physical ones, LPS for files.

    image, spacing, origin, direction, progress
        As for segment().

    Raises SegmentationError if there is no segmentation, FileError if the file cannot be read,
    TypeError and ValueError for parameters that do not exist or are out of range. Issues a
    FlipFreeWarning if the result is doubtful.

    >>> import flipfree
    >>> phantom = flipfree.phantom("vessel")
    >>> (center, radius), = phantom.seeds.values()
    >>> flipfree.trace(phantom.image, [center])
    Traceback (most recent call last):
      ...
    flipfree.SegmentationError: No segmentation: a vessel needs two points or more, not 1; ...
    """
    from ._segment import _image_of  # not in its type stub

    algorithm = vtkFlipFreeVesselSegmentation()
    set_parameters("trace", algorithm, TRACE_PARAMETERS, parameters)
    for point in points:
        algorithm.AddPoint(*floats("points", point, 3))
    volume: vtkImageData = _image_of(image, spacing, origin, direction, progress)
    algorithm.SetInputData(volume)
    with progress_of(progress, "tracing") as tell:
        update(algorithm, SegmentationError, tell, names=names_of(TRACE_PARAMETERS))
    return Vessel(
        surface=algorithm.GetSurface(),
        label_map=algorithm.GetLabelMap(),
        convergence=algorithm.GetConvergence(),
        stop_reason=algorithm.GetStopReasonAsString(),
        self_intersections=algorithm.GetNumberOfSelfIntersections(),
        centerline=algorithm.GetCenterline(),
    )


# Help and completion show the parameters as if they were spelled out above.
trace.__doc__ = f"{trace.__doc__}\n    The other parameters:\n\n{described(TRACE_PARAMETERS)}\n"
_SIGNATURE = signature_with(trace, vtkFlipFreeVesselSegmentation(), TRACE_PARAMETERS)
trace.__signature__ = _SIGNATURE  # type: ignore[attr-defined]
