"""numpy arrays as images and back, by VTK's own helpers.

An array's axes are slices, rows and columns: array[k, j, i] is the voxel (i, j, k). Spacing and
origin go by x, y, z as everywhere in VTK and ITK. numpy is imported only where it is used: the
filters themselves need none.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from vtkmodules.vtkCommonDataModel import vtkImageData

from ._parameters import floats
from ._voxels import IDENTITY, voxels_of

if TYPE_CHECKING:
    import numpy.typing as npt


def image_from_array(
    array: npt.ArrayLike,
    spacing: Sequence[float],
    origin: Sequence[float] = (0, 0, 0),
    direction: npt.ArrayLike | None = None,
) -> vtkImageData:
    """An image of the voxels array[k, j, i].

    Spacing (mm), origin (mm, of the center of the first voxel) and direction (3 x 3, the axes as
    columns; default the identity) are as SimpleITK, nibabel and pydicom users know them, in LPS
    coordinates. Where VTK knows the array's type, its voxels lie one behind the other and may be
    written to, the image shares its memory; otherwise it has a copy.

    >>> import flipfree, numpy
    >>> volume = numpy.zeros((20, 64, 48), dtype=numpy.int16)   # 20 slices, 64 rows, 48 columns
    >>> image = flipfree.image_from_array(volume, spacing=(0.8, 0.8, 3), origin=(-19, -25, 100))
    >>> image.GetDimensions()
    (48, 64, 20)
    >>> volume[19, 0, 0] = 7
    >>> image.GetScalarComponentAsDouble(0, 0, 19, 0)
    7.0
    """
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk

    voxels = voxels_of(array)
    if not voxels.flags.writeable:  # which an image cannot tell those who get it
        voxels = voxels.copy()
    image = vtkImageData()
    image.SetDimensions(voxels.shape[2], voxels.shape[1], voxels.shape[0])
    image.SetSpacing(floats("spacing", spacing, 3))
    image.SetOrigin(floats("origin", origin, 3))
    axes = IDENTITY if direction is None else direction
    image.SetDirectionMatrix(floats("direction", numpy.ravel(axes), 9))
    if voxels.size:
        scalars = numpy_to_vtk(voxels.ravel())
        scalars.SetName("ImageScalars")
        image.GetPointData().SetScalars(scalars)
    return image


def array_from_image(image: vtkImageData) -> npt.NDArray[Any]:
    """The voxels of an image as array[k, j, i], without copying them.

    >>> import flipfree
    >>> phantom = flipfree.vtkPhantomSource()
    >>> phantom.SetDimensions(40, 30, 20)
    >>> phantom.Update()
    >>> flipfree.array_from_image(phantom.GetOutput()).shape
    (20, 30, 40)
    """
    from vtkmodules.util.numpy_support import vtk_to_numpy

    scalars = image.GetPointData().GetScalars()
    if scalars is None:
        raise ValueError("image: it has no scalars, so there is nothing to make an array of")
    shape: tuple[int, ...] = image.GetDimensions()[::-1]
    if scalars.GetNumberOfComponents() > 1:
        shape = (*shape, scalars.GetNumberOfComponents())
    voxels: npt.NDArray[Any] = vtk_to_numpy(scalars).reshape(shape)
    return voxels
