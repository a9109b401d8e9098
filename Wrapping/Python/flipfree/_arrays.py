"""numpy arrays as images and back.

An array's axes are slices, rows and columns: array[k, j, i] is the voxel (i, j, k). Spacing and
origin go by x, y, z as everywhere in VTK and ITK. numpy is imported only where it is used: filters
need none.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ._image_arrays import image_of, voxels_in
from ._parameters import floats
from ._voxels import IDENTITY, voxels_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._images import Image


def image_from_array(
    array: npt.ArrayLike,
    spacing: Sequence[float],
    origin: Sequence[float] = (0, 0, 0),
    direction: npt.ArrayLike | None = None,
) -> Image:
    """An image of the voxels array[k, j, i].

    Spacing (mm), origin (mm, of the center of the first voxel) and direction (3 x 3, the axes as
    columns; default the identity) are as SimpleITK, nibabel and pydicom users know them, in LPS
    coordinates. Where the array is of integers or floats of up to 64 bits and its voxels lie one
    behind the other, the image shares its memory (over VTK, only if the array is writable);
    otherwise it has a copy.

    Voxels that are not finite numbers have no data: nothing is learned from them, and no surface
    goes there. So are those that a masked array masks; the image then has a copy in which they are
    NaN, and integers are floats of 32 bits.

    >>> import flipfree, numpy
    >>> volume = numpy.zeros((20, 64, 48), dtype=numpy.int16)   # 20 slices, 64 rows, 48 columns
    >>> image = flipfree.image_from_array(volume, spacing=(0.8, 0.8, 3), origin=(-19, -25, 100))
    >>> volume[19, 0, 0] = 7
    >>> int(flipfree.array_from_image(image)[19, 0, 0])
    7
    """
    import numpy

    voxels = voxels_of(array)
    axes = IDENTITY if direction is None else direction
    return image_of(
        voxels,
        floats("spacing", spacing, 3),
        floats("origin", origin, 3),
        floats("direction", numpy.ravel(axes), 9),
    )


def array_from_image(image: Image) -> npt.NDArray[Any]:
    """The voxels of an image as array[k, j, i], without copying them.

    >>> import flipfree
    >>> phantom = flipfree.phantom("sphere", dimensions=(40, 30, 20))
    >>> flipfree.array_from_image(phantom.image).shape
    (20, 30, 40)
    """
    return voxels_in(image)
