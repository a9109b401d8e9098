"""The result of a segmentation as VTK objects and as numpy arrays."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData, vtkTable

from ._branches import Branch
from ._image_arrays import voxels_in
from ._result import GIVEN, Result, VesselMeasures

if TYPE_CHECKING:
    import numpy.typing as npt


def columns_of(table: vtkTable) -> dict[str, npt.NDArray[Any]]:
    """The columns of a table of numbers by their names."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    columns = (table.GetColumn(i) for i in range(table.GetNumberOfColumns()))
    return {column.GetName(): vtk_to_numpy(column) for column in columns}


@dataclass(frozen=True, repr=False)
class Segmentation(Result):
    """An organ. Coordinates are the image's physical millimeters."""

    label_map: vtkImageData

    surface: vtkPolyData = GIVEN
    """Closed, with the point arrays `Displacement`, `Correspondence` and, for an organ, `Confidence`."""

    convergence: vtkTable = GIVEN
    """A row per iteration; `iterations` has its columns as arrays."""

    @property
    def points(self) -> npt.NDArray[Any]:
        """The vertices as rows (x, y, z)."""
        from vtkmodules.util.numpy_support import vtk_to_numpy

        points: npt.NDArray[Any] = vtk_to_numpy(self.surface.GetPoints().GetData())
        return points

    @property
    def confidence(self) -> float:
        """How far the result can be trusted, 0 to 1; doubtful below 0.85, which a FlipFreeWarning says."""
        confidence = self.surface.GetFieldData().GetArray("Confidence")
        return math.nan if confidence is None else float(confidence.GetTuple1(0))

    @property
    def vertex_confidence(self) -> npt.NDArray[Any] | None:
        """How well the image supports the surface at each vertex, 0 to 1; None for a vessel."""
        from vtkmodules.util.numpy_support import vtk_to_numpy

        confidence = self.surface.GetPointData().GetArray("Confidence")
        return None if confidence is None else vtk_to_numpy(confidence)

    @property
    def provenance(self) -> str:
        """Where the surface comes from, as JSON: version, image grid, seeds, points and all parameters.

        In a file, it is a session that `flipfree segment IMAGE --session FILE` repeats, bit for bit.
        """
        text = self.surface.GetFieldData().GetAbstractArray("Provenance")
        return "" if text is None else str(text.GetValue(0))

    @property
    def labels(self) -> npt.NDArray[Any]:
        """The voxels of the label map as labels[k, j, i]."""
        return voxels_in(self.label_map)

    @property
    def iterations(self) -> dict[str, npt.NDArray[Any]]:
        """The columns of the convergence table: Iteration, MeanDistance and so on."""
        return columns_of(self.convergence)

    def cells(self) -> tuple[Any, Any]:
        from vtkmodules.util.numpy_support import vtk_to_numpy

        cells = self.surface.GetPolys()
        return vtk_to_numpy(cells.GetConnectivityArray()), vtk_to_numpy(cells.GetOffsetsArray())


@dataclass(frozen=True, repr=False)
class Vessel(VesselMeasures, Segmentation):
    """A vessel, or a tree of vessels. Coordinates are the image's physical millimeters."""

    centerline: vtkPolyData = GIVEN
    """A poly line per branch, with the point arrays `Radius` and `ArcLength`, in mm."""

    @property
    def branches(self) -> list[Branch]:
        """The centerline as numpy arrays. Of a tree, each branch but the first begins on another."""
        from vtkmodules.util.numpy_support import vtk_to_numpy

        points = vtk_to_numpy(self.centerline.GetPoints().GetData())
        data = self.centerline.GetPointData()
        radius = vtk_to_numpy(data.GetArray("Radius"))
        length = vtk_to_numpy(data.GetArray("ArcLength"))
        parents = vtk_to_numpy(self.centerline.GetCellData().GetArray("Parent")).tolist()
        offsets = vtk_to_numpy(self.centerline.GetLines().GetOffsetsArray())
        return [
            Branch(points[a:b], radius[a:b], length[a:b], parent)
            for a, b, parent in zip(offsets[:-1], offsets[1:], parents)
        ]
