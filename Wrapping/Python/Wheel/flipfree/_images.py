"""What images and surfaces are: this package's own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Union

from ._backend import is_surface as is_surface
from ._image import Image as Image
from ._image_arrays import image_of
from ._segmentation import Segmentation
from ._segmentation import Surface as Surface
from ._types import PathName
from ._voxels import voxels_of

IMAGE_NAME = "flipfree.Image"
AnySurface = Union[Surface, Segmentation]

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._foreign import ForeignImage

    AnyImage = Union[Image, npt.NDArray[Any], PathName, ForeignImage]


def is_image(thing: Any) -> bool:
    """Whether it is one, other than an array or the name of a file."""
    return isinstance(thing, Image)


def series_of(image: Image) -> str:
    """The DICOM series that was read; empty for any other image."""
    return image.series


def geometry_like(other: Image, array: Any) -> Image:
    """The voxels of an array as an image with the geometry of another."""
    return image_of(voxels_of(array, masked=0), other.spacing, other.origin, other.direction)
