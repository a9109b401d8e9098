"""How well a segmentation agrees with a reference."""

from __future__ import annotations

import os
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

from ._backend import EVALUATE_PARAMETERS, Metrics
from ._files import read_image
from ._foreign import adopted, is_foreign
from ._images import IMAGE_NAME, geometry_like, is_image, is_surface
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
    """Mean distance of the surfaces, over the pooled points of both."""
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
    gets the geometry of the other argument. Of a Segmentation the surface is measured. Raises EvaluationError if the two
    cannot be compared.

    >>> import flipfree
    >>> phantom = flipfree.phantom("abdomen")
    >>> liver = flipfree.segment(phantom.image, seed=(99.75, 83.75, 167), radius=28)
    >>> scores = flipfree.evaluate(liver, phantom.label_map, reference_label=flipfree.Organ.LIVER)
    >>> round(scores.dice, 2)
    0.93
    >>> scores.distance_of
    'mesh'
    """
    compared: Any = segmentation
    known: Any = segmentation
    if isinstance(segmentation, Segmentation):
        known = segmentation.label_map
    reference = _label_map("reference", reference, known)
    if not isinstance(compared, Segmentation) and not is_surface(compared):
        compared = _label_map("segmentation", compared, reference)
    metrics = Metrics()
    set_parameters("evaluate", metrics.settings, EVALUATE_PARAMETERS, parameters)
    values = metrics.run(compared, reference)
    return Scores(**{field.name: values[field.name] for field in fields(Scores)})


def _label_map(name: str, label_map: Any, other: Any) -> Image:
    """As an image; an array gets the geometry of the other one."""
    if isinstance(label_map, (str, os.PathLike)):
        return read_image(label_map)
    if is_image(label_map):
        return label_map
    if is_foreign(label_map):
        return adopted(name, label_map)
    if not hasattr(label_map, "__array__"):
        raise TypeError(
            f"{name}: a label map ({IMAGE_NAME}, array or name of a file) is needed, "
            f"not {label_map!r:.80}"
        )
    if isinstance(other, (str, os.PathLike)):
        other = read_image(other)
    if not is_image(other) and is_foreign(other):
        other = adopted("segmentation", other)
    if not is_image(other):
        raise TypeError(f"{name}: an array without geometry; use image_from_array(...)")
    return geometry_like(other, label_map)


# Help and completion show the parameters as if they were spelled out above.
evaluate.__doc__ = f"{evaluate.__doc__}\n    The other parameters:\n\n{described(EVALUATE_PARAMETERS)}\n"
_SIGNATURE = signature_with(evaluate, Metrics().settings, EVALUATE_PARAMETERS)
evaluate.__signature__ = _SIGNATURE  # type: ignore[attr-defined]
