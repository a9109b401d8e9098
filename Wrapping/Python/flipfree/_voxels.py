"""Arrays of voxels as the C++ code takes them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy.typing as npt

IDENTITY = (1, 0, 0, 0, 1, 0, 0, 0, 1)


def voxels_of(array: npt.ArrayLike) -> npt.NDArray[Any]:
    """The array itself if its voxels lie one behind the other and have a known type, or a copy."""
    import numpy

    voxels = numpy.asarray(array)
    if voxels.ndim != 3:
        raise ValueError(
            f"array: 3 axes (slices, rows, columns) are needed, not the {voxels.ndim} of shape "
            f"{voxels.shape}"
        )
    return numpy.ascontiguousarray(voxels, dtype=_known_type(voxels.dtype))


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
