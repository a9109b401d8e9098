"""Arrays of voxels as the C++ code takes them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy.typing as npt

IDENTITY = (1, 0, 0, 0, 1, 0, 0, 0, 1)


def voxels_of(array: npt.ArrayLike, masked: float = math.nan) -> npt.NDArray[Any]:
    """The array itself if its voxels lie one behind the other and have a known type, or a copy.

    What a masked array masks gets a value of its own: NaN is no data, 0 no label.
    """
    import numpy

    voxels = _unmasked(array, masked)
    if voxels.ndim != 3:
        raise ValueError(
            f"array: 3 axes (slices, rows, columns) are needed, not the {voxels.ndim} of shape "
            f"{voxels.shape}"
        )
    return numpy.ascontiguousarray(voxels, dtype=_known_type(voxels.dtype))


def _unmasked(array: npt.ArrayLike, value: float) -> npt.NDArray[Any]:
    """Where something is masked, a copy; of integers as floats if need be."""
    import numpy

    if not isinstance(array, numpy.ma.MaskedArray):
        return numpy.asarray(array)
    voxels: npt.NDArray[Any] = array.data
    mask = numpy.broadcast_to(numpy.asarray(array.mask), voxels.shape)
    if not mask.any():
        return voxels
    kind: Any = numpy.float32 if math.isnan(value) and voxels.dtype.kind in "biu" else voxels.dtype
    voxels = voxels.astype(kind)
    voxels[mask] = value
    return voxels


def _known_type(dtype: Any) -> Any:
    """Numbers of 8 to 64 bits in the machine's own byte order."""
    import numpy

    if dtype == numpy.bool_:
        return numpy.uint8
    if dtype == numpy.float16:
        return numpy.float32
    if dtype.kind not in "iuf" or dtype.itemsize > 8:
        raise TypeError(
            f"array: voxels of type {dtype}; integers or floats of up to 64 bits are needed"
        )
    return dtype.newbyteorder("=")
