"""The whole method as one function."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, get_args

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

from ._arrays import image_from_array
from ._errors import SegmentationError
from ._files import read_image
from ._parameters import (
    Parameter,
    described,
    floats,
    names_of,
    parameters_of,
    set_parameters,
    signature_with,
)
from ._progress import progress_of
from ._segmentation import Segmentation
from ._types import Preset, ProgressOption
from ._update import update
from .FlipFreeSegmentation import vtkFlipFreeSegmentation

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._types import Image

# The seed has arguments of its own; the stages know two parameters by other names than the method.
PARAMETERS = parameters_of(
    vtkFlipFreeSegmentation(),
    without=("seed_center", "seed_radius", "number_of_iterations", "threshold"),
)
RADIUS = Parameter("radius", "SeedRadius", float, "")
NAMES = {**names_of(PARAMETERS), "SeedCenter": "seed", "SeedRadius": "radius"}


def segment(
    image: Image,
    seed: Sequence[float],
    radius: float,
    *,
    spacing: Sequence[float] | None = None,
    origin: Sequence[float] | None = None,
    direction: npt.ArrayLike | None = None,
    start: vtkPolyData | Segmentation | None = None,
    preset: Preset = "default",
    progress: ProgressOption = None,
    **parameters: Any,
) -> Segmentation:
    """Segments the organ around a seed sphere.

    The seed sphere, center (x, y, z) and radius in millimeters, should lie within the organ and have
    at least half the radius of the largest sphere that fits there: the organ's intensities are
    learned from its voxels, and the surface starts from it. Coordinates are the image's physical
    ones, LPS for files.

    image
        A vtkImageData; the name of a file or of a folder of DICOM files; or an array of voxels
        array[k, j, i] with its spacing (mm) and, unless they are zero and the identity, its origin
        (mm) and direction (3 x 3, the axes as columns).
    start
        A surface to start from instead of the sphere: closed, with four neighbors at every vertex,
        without self-intersections.
    preset
        The values of the parameters that are not given: 'default', 'published' (the paper's own
        method) or 'naive' (the same without flip avoidance). With the last two, the surface may
        intersect itself.
    progress
        A function that is called with fractions from 0 to 1, or True for a bar. An exception that
        it raises ends the segmentation and is raised again, as is the KeyboardInterrupt of Ctrl-C.

    Raises SegmentationError if there is no segmentation, FileError if the file cannot be read,
    TypeError and ValueError for parameters that do not exist or are out of range. Issues a
    FlipFreeWarning if the result is doubtful.

    >>> import flipfree
    >>> phantom = flipfree.vtkPhantomSource()
    >>> phantom.SetShapeToAbdomen()
    >>> phantom.Update()
    >>> liver = flipfree.segment(phantom.GetOutput(), seed=(99.75, 83.75, 167), radius=28)
    >>> liver.points.shape, liver.faces.shape, liver.labels.shape
    ((6144, 3), (6146, 4), (90, 170, 220))
    >>> liver.self_intersections
    0
    >>> flipfree.segment(phantom.GetOutput(), seed=(-50, 0, 0), radius=28)
    Traceback (most recent call last):
      ...
    flipfree.SegmentationError: No segmentation: the seed's center (-50, 0, 0) mm lies outside ...
    >>> flipfree.segment(phantom.GetOutput(), seed=(99.75, 83.75, 167), radius=28, level=2)
    Traceback (most recent call last):
      ...
    TypeError: segment() has no parameter 'level'; did you mean 'levels'? help(flipfree.segment) ...
    """
    algorithm = _with_preset(preset)
    set_parameters("segment", algorithm, PARAMETERS, parameters)
    algorithm.SetSeedCenter(floats("seed", seed, 3))
    RADIUS.set(algorithm, floats("radius", [radius], 1)[0])
    if start is not None:
        algorithm.SetStartData(_surface_of(start))
    algorithm.SetInputData(_image_of(image, spacing, origin, direction, progress))
    with progress_of(progress, "segmenting") as tell:
        update(algorithm, SegmentationError, tell, names=NAMES)
    return Segmentation(
        surface=algorithm.GetSurface(),
        label_map=algorithm.GetLabelMap(),
        convergence=algorithm.GetConvergence(),
        stop_reason=algorithm.GetStopReasonAsString(),
        self_intersections=algorithm.GetNumberOfSelfIntersections(),
        history=_history_of(algorithm),
    )


def default_parameters(preset: Preset = "default") -> dict[str, Any]:
    """The parameters of segment() and the values that they have unless given.

    >>> import flipfree
    >>> flipfree.default_parameters()["levels"], flipfree.default_parameters("published")["levels"]
    (3, 1)
    """
    algorithm = _with_preset(preset)
    return {name: parameter.get(algorithm) for name, parameter in PARAMETERS.items()}


def _with_preset(preset: Preset) -> vtkFlipFreeSegmentation:
    if preset not in get_args(Preset):
        raise ValueError(
            f"preset: {preset!r} does not exist; there are {', '.join(get_args(Preset))}"
        )
    algorithm = vtkFlipFreeSegmentation()
    getattr(algorithm, f"Use{preset.capitalize()}Parameters")()
    return algorithm


def _image_of(
    image: Image,
    spacing: Sequence[float] | None,
    origin: Sequence[float] | None,
    direction: npt.ArrayLike | None,
    progress: ProgressOption,
) -> vtkImageData:
    has_geometry = not (spacing is None and origin is None and direction is None)
    if isinstance(image, (vtkImageData, str, os.PathLike)):
        if has_geometry:
            raise TypeError(
                "spacing, origin and direction belong to arrays; images and files have theirs"
            )
        if isinstance(image, vtkImageData):
            return image
        return read_image(image, progress=progress if progress is True else None)
    if not hasattr(image, "__array__"):
        raise TypeError(
            f"image: a vtkImageData, an array or the name of a file is needed, not {image!r:.80}"
        )
    if spacing is None:
        raise TypeError(
            "spacing: an array needs it, as (x, y, z) in mm; its axes are array[k, j, i]"
        )
    return image_from_array(image, spacing, (0, 0, 0) if origin is None else origin, direction)


def _surface_of(start: vtkPolyData | Segmentation) -> vtkPolyData:
    surface = start.surface if isinstance(start, Segmentation) else start
    if not isinstance(surface, vtkPolyData):
        raise TypeError(f"start: a vtkPolyData or a Segmentation is needed, not {start!r:.80}")
    return surface


def _history_of(algorithm: vtkFlipFreeSegmentation) -> tuple[vtkPolyData, ...]:
    """The surfaces after each iteration, which are the time steps of the first output."""
    if not algorithm.GetKeepHistory():
        return ()
    history = []
    for iteration in range(1, algorithm.GetConvergence().GetNumberOfRows() + 1):
        algorithm.UpdateTimeStep(iteration)
        surface = vtkPolyData()
        surface.ShallowCopy(algorithm.GetSurface())
        history.append(surface)
    return tuple(history)


# Help and completion show the parameters as if they were spelled out above.
segment.__doc__ = f"{segment.__doc__}\n    The other parameters:\n\n{described(PARAMETERS)}\n"
_SIGNATURE = signature_with(segment, vtkFlipFreeSegmentation(), PARAMETERS)
segment.__signature__ = _SIGNATURE  # type: ignore[attr-defined]
