"""What images and surfaces are: VTK's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias, Union

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

from ._image_arrays import image_of
from ._segmentation import Segmentation
from ._types import PathName
from ._voxels import voxels_of

Image: TypeAlias = vtkImageData
IMAGE_NAME = "vtkImageData"
Surface: TypeAlias = vtkPolyData
AnySurface = Union[vtkPolyData, Segmentation]

if TYPE_CHECKING:  # numpy need not be there
    import numpy.typing as npt

    from ._foreign import ForeignImage

    AnyImage = Union[vtkImageData, npt.NDArray[Any], PathName, ForeignImage]


def is_image(thing: Any) -> bool:
    """Whether it is one, other than an array or the name of a file."""
    return isinstance(thing, vtkImageData)


def is_surface(thing: Any) -> bool:
    """Whether it is one, other than a Segmentation's."""
    return isinstance(thing, vtkPolyData)


def series_of(image: vtkImageData) -> str:
    """The DICOM series that was read; empty for any other image."""
    series = image.GetFieldData().GetAbstractArray("SeriesUID")
    return str(series.GetValue(0)) if series is not None and series.GetNumberOfValues() else ""


def geometry_like(other: vtkImageData, array: Any) -> vtkImageData:
    """The voxels of an array as an image with the geometry of another."""
    direction = other.GetDirectionMatrix()
    axes = [direction.GetElement(row, column) for row in range(3) for column in range(3)]
    image = image_of(voxels_of(array, masked=0), other.GetSpacing(), other.GetOrigin(), axes)
    if image.GetDimensions() == other.GetDimensions():
        image.SetExtent(other.GetExtent())
    return image
