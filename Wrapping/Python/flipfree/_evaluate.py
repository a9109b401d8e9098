"""How well a segmentation agrees with a reference."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

from ._backend import EVALUATE_PARAMETERS, Metrics
from ._images import is_surface
from ._labels import label_map_of
from ._parameters import described, set_parameters, signature_with
from ._segmentation import Segmentation

if TYPE_CHECKING:
    from ._images import AnyImage, Image, Surface


@dataclass(frozen=True)
class Scores:
    """Overlaps and relative volume as fractions, distances in mm, volumes in ml."""

    dice: float
    jaccard: float
    relative_volume_difference: float
    """Negative where the segmentation is smaller than the reference."""
    asd: float
    """Mean distance of the surfaces over the area of both, not over border voxels as elsewhere."""
    rms: float
    hd95: float
    hd: float
    segmentation_volume: float
    reference_volume: float
    overlap_of: str
    """'label map' or 'voxelized mesh'"""
    distance_of: str
    """'surface of label map', 'mesh' or 'surface of voxelized mesh'"""


def evaluate(
    segmentation: Segmentation | Surface | AnyImage, reference: AnyImage, **parameters: Any
) -> Scores:
    """Compares a segmentation with a reference label map.

    A label map may be an image, also of SimpleITK or nibabel, the name of a file, or an array, which
    gets the geometry of the other argument. Its voxels must be those of the reference, cropped or not,
    its axes in any order: what lies outside the grid of one of the two counts as not in it. In a file
    of 3D Slicer (.seg.nrrd), the label may be a segment's name. Of a Segmentation the surface is
    measured. Raises EvaluationError if the two cannot be compared.

    >>> import flipfree
    >>> phantom = flipfree.phantom("abdomen")
    >>> liver = flipfree.segment(phantom.image, seed=(99.75, 83.75, 167), radius=28)
    >>> scores = flipfree.evaluate(liver, phantom.label_map, reference_label=flipfree.Organ.LIVER)
    >>> round(scores.dice, 2)
    0.95
    >>> scores.distance_of
    'mesh'
    """
    compared: Any = segmentation
    known: Any = segmentation
    if isinstance(segmentation, Segmentation):
        known = segmentation.label_map
    reference = _with_label("reference", reference, known, parameters)
    if not isinstance(compared, Segmentation) and not is_surface(compared):
        compared = _with_label("segmentation", compared, reference, parameters)
    metrics = Metrics()
    set_parameters("evaluate", metrics.settings, EVALUATE_PARAMETERS, parameters)
    values = metrics.run(compared, reference)
    return Scores(**{field.name: values[field.name] for field in fields(Scores)})


def _with_label(name: str, label_map: Any, other: Any, parameters: dict[str, Any]) -> Image:
    """The label map; its label among the parameters becomes a value."""
    given = parameters.get(f"{name}_label", -1)
    chosen = given if isinstance(given, str) or (isinstance(given, int) and given >= 0) else None
    image, label = label_map_of(name, label_map, other, chosen)
    if isinstance(given, str):
        parameters[f"{name}_label"] = label
    return image


# Help and completion show the parameters as if they were spelled out above.
evaluate.__doc__ = f"{evaluate.__doc__}\n    The other parameters:\n\n{described(EVALUATE_PARAMETERS)}\n"
_SIGNATURE = signature_with(evaluate, Metrics().settings, EVALUATE_PARAMETERS)
evaluate.__signature__ = _SIGNATURE  # type: ignore[attr-defined]
