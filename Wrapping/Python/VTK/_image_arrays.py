"""Voxels as images and back, by VTK's own helpers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from vtkmodules.vtkCommonDataModel import vtkImageData

if TYPE_CHECKING:
    import numpy.typing as npt


def image_of(
    voxels: npt.NDArray[Any],
    spacing: Sequence[float],
    origin: Sequence[float],
    direction: Sequence[float],
) -> vtkImageData:
    """An image that shares the voxels, or has a copy of those that are not writable."""
    from vtkmodules.util.numpy_support import numpy_to_vtk

    if not voxels.flags.writeable:  # which an image cannot tell those who get it
        voxels = voxels.copy()
    image = vtkImageData()
    image.SetDimensions(voxels.shape[2], voxels.shape[1], voxels.shape[0])
    image.SetSpacing(spacing)
    image.SetOrigin(origin)
    image.SetDirectionMatrix(direction)
    if voxels.size:
        scalars = numpy_to_vtk(voxels.ravel())
        scalars.SetName("ImageScalars")
        image.GetPointData().SetScalars(scalars)
    return image


def voxels_in(image: vtkImageData) -> npt.NDArray[Any]:
    """The voxels as array[k, j, i], or [k, j, i, component]."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    scalars = image.GetPointData().GetScalars()
    if scalars is None:
        raise ValueError("image: it has no scalars, so there is nothing to make an array of")
    shape: tuple[int, ...] = image.GetDimensions()[::-1]
    if scalars.GetNumberOfComponents() > 1:
        shape = (*shape, scalars.GetNumberOfComponents())
    voxels: npt.NDArray[Any] = vtk_to_numpy(scalars).reshape(shape)
    return voxels
