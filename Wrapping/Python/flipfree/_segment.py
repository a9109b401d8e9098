"""The whole method as one function."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, get_args

from ._arrays import image_from_array
from ._backend import SEGMENT_PARAMETERS, SegmentationAlgorithm
from ._boundary_found import require_boundary
from ._corrections import Constraint, Points, Seeds, constraints_of
from ._files import read_image
from ._foreign import adopted, is_foreign
from ._images import IMAGE_NAME, is_image
from ._labels import label_map_of, require_label, warn_of_other_labels
from ._parameters import described, floats, radius_of, set_parameters, signature_with
from ._progress import progress_of
from ._segmentation import Segmentation
from ._types import Preset, ProgressOption

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._images import AnyImage, AnySurface, Image


def segment(
    image: AnyImage,
    seed: Sequence[float] | None = None,
    radius: float | None = None,
    *,
    series: str | None = None,
    spacing: Sequence[float] | None = None,
    origin: Sequence[float] | None = None,
    direction: npt.ArrayLike | None = None,
    start: AnySurface | None = None,
    start_labels: AnyImage | None = None,
    start_label: int | str | None = None,
    inside: Points = (),
    outside: Points = (),
    boundary: Points = (),
    seeds: Seeds = (),
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
        identity, its origin (mm) and direction (3 x 3, the axes as columns). Voxels that are not
        finite, or that a masked array masks, have no data: no surface goes there.
    series
        Of a folder of DICOM files, the series to read, as read_image() takes it. The provenance of the
        result names the series that was read.
    start
        A surface to start from instead of the sphere: closed, without self-intersections. Unless every
        vertex has four neighbors, it is the mesh of the midpoints of its edges, whose vertices all have
        them. It is refined to about as many vertices as the sphere.
    start_labels, start_label
        A label map with the image's voxels, cropped or not, its axes in any order (of a network, an
        atlas, an earlier result; an image, an array or the name of a file) that the surface fills, in
        place of a seed, a radius and a start: its voxels of the value start_label, by default 1, or
        with 0 all nonzero voxels; in a file of 3D Slicer (.seg.nrrd) also a segment, by its name. The
        surface has the center of every voxel on its side. Points correct the result as always.
    inside, outside, boundary
        Lists of points (x, y, z) in mm that the surface obeys: they end inside it, outside it, and
        within half the smallest spacing of it. An array of n rows, such as a painted stroke, is such
        a list. Their order means nothing. corrected() of the result adds more.
    seeds
        Further spheres within the organ, as pairs of center and radius. The surface starts from the
        largest one.
    preset
        The values of the parameters that are not given: 'default', 'published' (the paper's own
        method) or 'naive' (the same without flip avoidance). With the last two, the surface may
        intersect itself.
    progress
        A function that is called with fractions from 0 to 1, or True for a bar. An exception that
        it raises ends the segmentation and is raised again, as is the KeyboardInterrupt of Ctrl-C or
        what the handler of another signal raises (a timeout).

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
    >>> masked = flipfree.segment(phantom.image, start_labels=phantom.label_map, start_label=flipfree.Organ.LIVER)
    >>> round(flipfree.evaluate(masked, phantom.label_map, reference_label=flipfree.Organ.LIVER).dice, 2)
    1.0
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
    if start_labels is None:
        if seed is None or radius is None:
            raise TypeError("seed and radius are needed, a sphere within the organ, or start_labels")
        algorithm.set_seed(floats("seed", seed, 3), radius_of("radius", radius))
    elif seed is not None or radius is not None:
        raise TypeError("start_labels takes the place of seed and radius; leave these out")
    if start is not None:
        algorithm.set_start(start)
    constraints = constraints_of(inside, outside, boundary, seeds)
    volume = _image_of(image, series, spacing, origin, direction, progress)
    labels: Image | None = None
    if start_labels is not None:
        require_label("start_label", start_label)
        labels, label = label_map_of("start_labels", start_labels, volume, start_label)
        algorithm.set_start_labels(labels, 1 if label is None else label)

    def run(points: tuple[Constraint, ...], progress: ProgressOption) -> Segmentation:
        with progress_of(progress, "segmenting") as tell:
            result = algorithm.run(volume, points, tell)
        require_boundary(result)
        return replace(result, constraints=points, _again=again)

    def again(points: tuple[Constraint, ...], progress: ProgressOption) -> Segmentation:
        algorithm.keep_for_corrections()
        return run(points, progress)

    result = run(constraints, progress)
    if labels is not None and start_label is None:
        warn_of_other_labels(labels, start_labels)
    return result


def default_parameters(preset: Preset = "default") -> dict[str, Any]:
    """The parameters of segment() and the values that they have unless given.

    >>> import flipfree
    >>> flipfree.default_parameters()["levels"], flipfree.default_parameters("published")["levels"]
    (4, 1)
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
    series: str | None,
    spacing: Sequence[float] | None,
    origin: Sequence[float] | None,
    direction: npt.ArrayLike | None,
    progress: ProgressOption,
) -> Image:
    is_path = isinstance(image, (str, os.PathLike))
    if series is not None and not is_path:
        raise TypeError("series: it chooses what is read of a folder of DICOM files, and this is an image")
    has_geometry = not (spacing is None and origin is None and direction is None)
    foreign = not is_image(image) and is_foreign(image)
    if foreign or is_image(image) or is_path:
        if has_geometry:
            raise TypeError(
                "spacing, origin and direction belong to arrays; images and files have theirs"
            )
        if foreign:
            return adopted("image", image)
        if is_image(image):
            return image
        return read_image(image, series=series, progress=progress if progress is True else None)
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
