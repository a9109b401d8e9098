"""The result of a segmentation as VTK objects and as numpy arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData, vtkTable

from ._arrays import array_from_image

if TYPE_CHECKING:
    import numpy.typing as npt


@dataclass(frozen=True, repr=False)
class Segmentation:
    """An organ. Coordinates are the image's physical millimeters."""

    surface: vtkPolyData
    """Closed, with the point arrays `Displacement` and `Correspondence`."""

    label_map: vtkImageData
    """Has the image's geometry; label_value inside, 0 outside."""

    convergence: vtkTable
    """A row per iteration; `iterations` has its columns as arrays."""

    stop_reason: str
    """Such as 'at rest'; vtkFlipFreeSegmentation.GetStopReasonAsString() lists them."""

    self_intersections: int
    """Pairs of faces that intersect for some way to cut them: 0, unless the guard was switched off."""

    history: tuple[vtkPolyData, ...] = ()
    """The surface after each iteration, with keep_history."""

    @property
    def points(self) -> npt.NDArray[Any]:
        """The vertices as rows (x, y, z)."""
        from vtkmodules.util.numpy_support import vtk_to_numpy

        points: npt.NDArray[Any] = vtk_to_numpy(self.surface.GetPoints().GetData())
        return points

    @property
    def faces(self) -> npt.NDArray[Any]:
        """The faces as rows of indices of points, counter-clockwise seen from outside.

        Most are quads; the eight triangles of a quad sphere repeat their last vertex.
        """
        import numpy

        corners, starts, sizes = self._cells()
        columns = numpy.arange(sizes.max(initial=0))
        faces: npt.NDArray[Any] = corners[
            starts[:, None] + numpy.minimum(columns, sizes[:, None] - 1)
        ]
        return faces

    @property
    def triangles(self) -> npt.NDArray[Any]:
        """The triangles as rows of indices of points.

        Each face is a fan around its first vertex. The absence of self-intersections is certified
        for every other triangulation of the faces, too.
        """
        import numpy

        corners, starts, sizes = self._cells()
        starts = numpy.repeat(starts, sizes - 2)
        # The second corner of each triangle within its face: 1, 2, ... up to the last but one.
        second = 1 + numpy.concatenate([numpy.arange(size - 2) for size in sizes] or [sizes])
        triangles: npt.NDArray[Any] = numpy.stack(
            [corners[starts], corners[starts + second], corners[starts + second + 1]], axis=1
        )
        return triangles

    @property
    def labels(self) -> npt.NDArray[Any]:
        """The voxels of the label map as labels[k, j, i]."""
        return array_from_image(self.label_map)

    @property
    def iterations(self) -> dict[str, npt.NDArray[Any]]:
        """The columns of the convergence table: Iteration, MeanDistance and so on."""
        from vtkmodules.util.numpy_support import vtk_to_numpy

        columns = (
            self.convergence.GetColumn(i) for i in range(self.convergence.GetNumberOfColumns())
        )
        return {column.GetName(): vtk_to_numpy(column) for column in columns}

    def __repr__(self) -> str:
        return (
            f"<Segmentation: {self.surface.GetNumberOfPoints()} vertices, "
            f"{self.self_intersections} self-intersections, '{self.stop_reason}' after "
            f"{self.convergence.GetNumberOfRows()} iterations>"
        )

    def _cells(self) -> tuple[Any, Any, Any]:
        """The corners of all faces, where each face starts, and its number of corners."""
        from vtkmodules.util.numpy_support import vtk_to_numpy

        cells = self.surface.GetPolys()
        offsets = vtk_to_numpy(cells.GetOffsetsArray())
        return vtk_to_numpy(cells.GetConnectivityArray()), offsets[:-1], offsets[1:] - offsets[:-1]
