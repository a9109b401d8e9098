"""Voxels as images and back."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ._image import Image

if TYPE_CHECKING:
    import numpy.typing as npt


def image_of(
    voxels: npt.NDArray[Any],
    spacing: Sequence[float],
    origin: Sequence[float],
    direction: Sequence[float],
) -> Image:
    """An image that shares the voxels."""
    return Image(voxels, tuple(spacing), tuple(origin), tuple(direction))


def voxels_in(image: Image) -> npt.NDArray[Any]:
    """The voxels as array[k, j, i]."""
    if image.voxels.size == 0:
        raise ValueError("image: it has no voxels, so there is nothing to make an array of")
    return image.voxels
