"""How well a segmentation agrees with a reference."""

from __future__ import annotations

import os
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkPolyData

from ._arrays import image_from_array
from ._errors import EvaluationError
from ._files import read_image
from ._parameters import (
    described,
    names_of,
    parameters_of,
    set_parameters,
    signature_with,
    snake_case,
)
from ._segmentation import Segmentation
from ._update import update
from .FlipFreeEvaluation import vtkSegmentationMetrics

if TYPE_CHECKING:
    from ._types import Image

PARAMETERS = parameters_of(vtkSegmentationMetrics())


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
    segmentation: Segmentation | vtkPolyData | Image, reference: Image, **parameters: Any
) -> Scores:
    """Compares a segmentation with a reference label map.

    A label map may be a vtkImageData, the name of a file or an array, which gets the geometry of the
    other argument. Of a Segmentation the surface is measured. Raises EvaluationError if the two
    cannot be compared.

    >>> import flipfree
    >>> phantom = flipfree.vtkPhantomSource()
    >>> phantom.SetShapeToAbdomen()
    >>> phantom.Update()
    >>> liver = flipfree.segment(phantom.GetOutput(), seed=(99.75, 83.75, 167), radius=28)
    >>> scores = flipfree.evaluate(liver, phantom.GetLabelMap(), reference_label=phantom.LIVER)
    >>> round(scores.dice, 2)
    0.93
    >>> scores.distance_of
    'mesh'
    """
    compared: Any = segmentation
    known: Any = segmentation
    if isinstance(segmentation, Segmentation):
        compared, known = segmentation.surface, segmentation.label_map
    reference = _label_map("reference", reference, known)
    if not isinstance(compared, vtkPolyData):
        compared = _label_map("segmentation", compared, reference)
    algorithm = vtkSegmentationMetrics()
    set_parameters("evaluate", algorithm, PARAMETERS, parameters)
    algorithm.SetInputDataObject(compared)
    algorithm.SetReferenceData(reference)
    update(algorithm, EvaluationError, names=names_of(PARAMETERS))
    row = algorithm.GetOutput()
    columns = {snake_case(row.GetColumnName(i)): i for i in range(row.GetNumberOfColumns())}
    return Scores(**{field.name: _value(row, columns[field.name]) for field in fields(Scores)})


def _label_map(name: str, label_map: Any, other: Any) -> vtkImageData:
    """As an image; an array gets the geometry of the other one."""
    if isinstance(label_map, (str, os.PathLike)):
        return read_image(label_map)
    if isinstance(label_map, vtkImageData):
        return label_map
    if not hasattr(label_map, "__array__"):
        raise TypeError(
            f"{name}: a label map (vtkImageData, array or name of a file) is needed, "
            f"not {label_map!r:.80}"
        )
    if isinstance(other, (str, os.PathLike)):
        other = read_image(other)
    if not isinstance(other, vtkImageData):
        raise TypeError(f"{name}: an array without geometry; use image_from_array(...)")
    direction = other.GetDirectionMatrix()
    axes = [direction.GetElement(row, column) for row in range(3) for column in range(3)]
    image = image_from_array(label_map, other.GetSpacing(), other.GetOrigin(), axes)
    extent = other.GetExtent()
    if image.GetDimensions() == other.GetDimensions():
        image.SetExtent(extent)
    return image


def _value(row: vtkDataObject, column: int) -> Any:
    value = row.GetValue(0, column)
    return value.ToDouble() if value.IsNumeric() else value.ToString()


# Help and completion show the parameters as if they were spelled out above.
evaluate.__doc__ = f"{evaluate.__doc__}\n    The other parameters:\n\n{described(PARAMETERS)}\n"
_SIGNATURE = signature_with(evaluate, vtkSegmentationMetrics(), PARAMETERS)
evaluate.__signature__ = _SIGNATURE  # type: ignore[attr-defined]
