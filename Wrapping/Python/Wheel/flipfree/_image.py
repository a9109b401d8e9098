"""Volumes with their place in space, where there is no VTK."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy.typing as npt


@dataclass(frozen=True, eq=False, repr=False)
class Image:
    """Voxels and their geometry; image_from_array makes one."""

    voxels: npt.NDArray[Any]
    """array[k, j, i] is the voxel (i, j, k)."""

    spacing: tuple[float, ...]
    """Distance of voxel centers along each axis, in mm."""

    origin: tuple[float, ...]
    """Center of the first voxel, in mm."""

    direction: tuple[float, ...]
    """The axes in space, as the columns of a 3 x 3 matrix given row by row."""

    names: Mapping[int, str] = field(default_factory=dict)
    """What the labels of a label map are called, for files that hold it (.seg.nrrd)."""

    series: str = ""
    """The DICOM series that was read, as read_image(..., series=...) takes it."""

    @property
    def steps(self) -> npt.NDArray[Any]:
        """From a voxel to the next along each axis, in mm, as the columns of a 3 x 3 matrix."""
        import numpy

        steps: npt.NDArray[Any] = numpy.reshape(self.direction, (3, 3)) * self.spacing
        return steps

    def __repr__(self) -> str:
        columns, rows, slices = self.voxels.shape[::-1]
        spacing = " x ".join(f"{length:g}" for length in self.spacing)
        return f"<Image: {columns} x {rows} x {slices} {self.voxels.dtype} voxels of {spacing} mm>"

    def __array__(self, dtype: Any = None, copy: Any = None) -> npt.NDArray[Any]:
        import numpy

        return numpy.array(self.voxels, dtype=dtype, copy=bool(copy)) if copy else numpy.asarray(
            self.voxels, dtype=dtype
        )
