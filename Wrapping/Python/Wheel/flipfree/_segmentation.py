"""The result of a segmentation as numpy arrays."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ._branches import Branch
from ._errors import FlipFreeError
from ._faces import Faces
from ._image import Image
from ._result import GIVEN, Result, VesselMeasures

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._surfaces import LabelSurfaces


# Width and height of a result's picture in a notebook.
NOTEBOOK_PIXELS = 600


@dataclass(frozen=True, eq=False, repr=False)
class Surface(Faces):
    """A closed surface of polygons. Coordinates are the image's physical millimeters."""

    points: npt.NDArray[Any]
    """The vertices as rows (x, y, z)."""

    corners: npt.NDArray[Any]
    """The indices of the corners of all faces, one face behind the other."""

    offsets: npt.NDArray[Any]
    """Where each face starts among the corners, and the end."""

    displacements: npt.NDArray[Any]
    """From each vertex to where the last search wanted it, in mm; zero where it found nothing."""

    correspondence: npt.NDArray[Any]
    """Of each vertex in the last search: 0 solitary, 1 matched, 2 flipping."""

    certified: bool = False
    """Whether the guard was on, so that no two faces can intersect."""

    confidence: float = math.nan
    """How far the surface can be trusted, 0 to 1; nan unless it is a result."""

    vertex_confidence: npt.NDArray[Any] | None = None
    """How well the image supports the surface at each vertex, 0 to 1; None unless it is a result."""

    provenance: str = ""
    """Where it comes from, see Segmentation.provenance; empty unless it is a result."""

    def cells(self) -> tuple[Any, Any]:
        return self.corners, self.offsets

    def __repr__(self) -> str:
        return f"<Surface: {len(self.points)} vertices, {len(self.offsets) - 1} faces>"


def surface_of_label(found: LabelSurfaces, label: int) -> Surface:
    """The surface of one label, of several that have been made together."""
    import numpy

    points, triangles = found.surface(label)
    return Surface(
        points=points,
        corners=triangles.ravel(),
        offsets=numpy.arange(0, triangles.size + 1, 3, dtype=numpy.int32),
        displacements=numpy.zeros(points.shape),
        correspondence=numpy.zeros(len(points), numpy.uint8),
        certified=True,
    )


@dataclass(frozen=True, eq=False, repr=False)
class Segmentation(Result):
    """An organ. Coordinates are the image's physical millimeters."""

    label_map: Image

    mesh: Surface = GIVEN

    iterations: dict[str, npt.NDArray[Any]] = GIVEN
    """The columns of the convergence table: Iteration, MeanDistance and so on."""

    _image: Any = field(default=None, compare=False)

    @property
    def points(self) -> npt.NDArray[Any]:
        """The vertices as rows (x, y, z)."""
        return self.mesh.points

    @property
    def confidence(self) -> float:
        """How far the result can be trusted, 0 to 1; doubtful below 0.85, which a FlipFreeWarning says."""
        return self.mesh.confidence

    @property
    def vertex_confidence(self) -> npt.NDArray[Any] | None:
        """How well the image supports the surface at each vertex, 0 to 1."""
        return self.mesh.vertex_confidence

    @property
    def provenance(self) -> str:
        """Where the surface comes from, as JSON: version, image grid, seeds, points and all parameters.

        In a file, it is a session that `flipfree segment IMAGE --session FILE` repeats, bit for bit.
        """
        return self.mesh.provenance

    @property
    def labels(self) -> npt.NDArray[Any]:
        """The voxels of the label map as labels[k, j, i]."""
        return self.label_map.voxels

    @property
    def surface(self) -> Any:
        """A vtkPolyData, where VTK is installed: `pip install vtk`."""
        try:
            from ._vtk_objects import polydata_of
        except ImportError as error:
            raise FlipFreeError(
                "surface: it is an object of VTK, which is not installed (pip install vtk); "
                ".points, .faces and .triangles have the same as numpy arrays"
            ) from error
        return polydata_of(self.mesh)

    def cells(self) -> tuple[Any, Any]:
        return self.mesh.cells()

    def __getstate__(self) -> dict[str, Any]:
        return {**super().__getstate__(), "_image": None}  # it would be copied with every result

    def _repr_png_(self) -> bytes | None:
        """How a notebook shows it: three slices with the contour, of a copy those of the label map, and the surface."""
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            return None  # then it is shown as text
        from ._picture import png_of

        return png_of(self.label_map if self._image is None else self._image, self, NOTEBOOK_PIXELS)


def joined(branches: list[Branch]) -> dict[str, npt.NDArray[Any]]:
    """The columns `points`, `radius`, `length` of all branches, where these begin and end, and `parent`."""
    import numpy

    names = ("points", "radius", "length")
    return {
        **{name: numpy.concatenate([getattr(one, name) for one in branches]) for name in names},
        "ends": numpy.cumsum([0, *(len(one.points) for one in branches)]),
        "parent": numpy.array([one.parent for one in branches], numpy.int32),
    }


@dataclass(frozen=True, eq=False, repr=False)
class Vessel(VesselMeasures, Segmentation):
    """A vessel, or a tree of vessels. Coordinates are the image's physical millimeters."""

    branches: list[Branch] = field(default_factory=list)
    """The centerline as numpy arrays. Of a tree, each branch but the first begins on another."""

    @property
    def centerline(self) -> Any:
        """A vtkPolyData, a poly line per branch, where VTK is installed: `pip install vtk`."""
        try:
            from ._vtk_objects import polylines_of
        except ImportError as error:
            raise FlipFreeError(
                "centerline: it is an object of VTK, which is not installed (pip install vtk); "
                ".branches has the same as numpy arrays, and write_centerline() writes it"
            ) from error
        return polylines_of(self.branches)
