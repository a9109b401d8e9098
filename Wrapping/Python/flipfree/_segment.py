"""The whole method as one function."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, get_args

from ._arrays import image_from_array
from ._backend import SEGMENT_PARAMETERS, SegmentationAlgorithm
from ._files import read_image
from ._foreign import adopted, is_foreign
from ._images import IMAGE_NAME, is_image
from ._parameters import described, floats, set_parameters, signature_with
from ._progress import progress_of
from ._segmentation import Segmentation
from ._types import Preset, ProgressOption

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._images import AnyImage, AnySurface, Image


def segment(
    image: AnyImage,
    seed: Sequence[float],
    radius: float,
    *,
    spacing: Sequence[float] | None = None,
    origin: Sequence[float] | None = None,
    direction: npt.ArrayLike | None = None,
    start: AnySurface | None = None,
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
        An image (a vtkImageData, or in a package without VTK a flipfree.Image), of SimpleITK or of
        nibabel (whose RAS coordinates become LPS); the name of a file or of a folder of DICOM files;
        or an array of voxels array[k, j, i] with its spacing (mm) and, unless they are zero and the
        identity, its origin (mm) and direction (3 x 3, the axes as columns).
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
    >>> phantom = flipfree.phantom("abdomen")
    >>> liver = flipfree.segment(phantom.image, seed=(99.75, 83.75, 167), radius=28)
    >>> liver.points.shape, liver.faces.shape, liver.labels.shape
    ((6144, 3), (6146, 4), (90, 170, 220))
    >>> liver.self_intersections
    0
    >>> flipfree.segment(phantom.image, seed=(-50, 0, 0), radius=28)
    Traceback (most recent call last):
      ...
    flipfree.SegmentationError: No segmentation: the seed's center (-50, 0, 0) mm lies outside ...
    >>> flipfree.segment(phantom.image, seed=(99.75, 83.75, 167), radius=28, level=2)
    Traceback (most recent call last):
      ...
    TypeError: segment() has no parameter 'level'; did you mean 'levels'? help(flipfree.segment) ...
    """
    algorithm = _with_preset(preset)
    set_parameters("segment", algorithm.settings, SEGMENT_PARAMETERS, parameters)
    algorithm.set_seed(floats("seed", seed, 3), floats("radius", [radius], 1)[0])
    if start is not None:
        algorithm.set_start(start)
    volume = _image_of(image, spacing, origin, direction, progress)
    with progress_of(progress, "segmenting") as tell:
        return algorithm.run(volume, tell)


def default_parameters(preset: Preset = "default") -> dict[str, Any]:
    """The parameters of segment() and the values that they have unless given.

    >>> import flipfree
    >>> flipfree.default_parameters()["levels"], flipfree.default_parameters("published")["levels"]
    (3, 1)
    """
    algorithm = _with_preset(preset)
    return {
        name: parameter.get(algorithm.settings) for name, parameter in SEGMENT_PARAMETERS.items()
    }


def _with_preset(preset: Preset) -> SegmentationAlgorithm:
    if preset not in get_args(Preset):
        raise ValueError(
            f"preset: {preset!r} does not exist; there are {', '.join(get_args(Preset))}"
        )
    return SegmentationAlgorithm(preset)


def _image_of(
    image: AnyImage,
    spacing: Sequence[float] | None,
    origin: Sequence[float] | None,
    direction: npt.ArrayLike | None,
    progress: ProgressOption,
) -> Image:
    has_geometry = not (spacing is None and origin is None and direction is None)
    foreign = not is_image(image) and is_foreign(image)
    if foreign or is_image(image) or isinstance(image, (str, os.PathLike)):
        if has_geometry:
            raise TypeError(
                "spacing, origin and direction belong to arrays; images and files have theirs"
            )
        if foreign:
            return adopted("image", image)
        if is_image(image):
            return image
        return read_image(image, progress=progress if progress is True else None)
    if not hasattr(image, "__array__"):
        raise TypeError(
            f"image: a {IMAGE_NAME}, an array or the name of a file is needed, not {image!r:.80}"
        )
    if spacing is None:
        raise TypeError(
            "spacing: an array needs it, as (x, y, z) in mm; its axes are array[k, j, i]"
        )
    return image_from_array(image, spacing, (0, 0, 0) if origin is None else origin, direction)


# Help and completion show the parameters as if they were spelled out above.
segment.__doc__ = f"{segment.__doc__}\n    The other parameters:\n\n{described(SEGMENT_PARAMETERS)}\n"
_SIGNATURE = signature_with(
    segment, SegmentationAlgorithm("default").settings, SEGMENT_PARAMETERS
)
segment.__signature__ = _SIGNATURE  # type: ignore[attr-defined]
