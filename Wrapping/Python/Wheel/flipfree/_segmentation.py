"""The result of a segmentation as numpy arrays."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ._corrections import Constraint, Correctable
from ._errors import FlipFreeError
from ._faces import Faces
from ._image import Image
from ._questions import Question

if TYPE_CHECKING:
    import numpy.typing as npt


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


@dataclass(frozen=True, eq=False, repr=False)
class Segmentation(Faces, Correctable):
    """An organ. Coordinates are the image's physical millimeters."""

    mesh: Surface

    label_map: Image
    """Has the image's geometry; label_value inside, 0 outside; of several organs, that of all."""

    iterations: dict[str, npt.NDArray[Any]]
    """The columns of the convergence table: Iteration, MeanDistance and so on."""

    stop_reason: str
    """Such as 'converged'."""

    boundary_found: bool
    """Whether any vertex found the boundary.

    Where none did, segment(), segment_organs() and trace() raise an error.
    """

    self_intersections: int
    """Pairs of faces that intersect for some way to cut them: 0, unless the guard was switched off."""

    history: tuple[Surface, ...] = ()
    """The surface after each iteration, with keep_history."""

    constraints: tuple[Constraint, ...] = ()
    """The points that the surface obeys, and further seeds."""

    questions: tuple[Question, ...] = ()
    """Parts of which the segmentation is not sure, those first where an answer is worth most.

    There are at most five; answered() answers them. A vessel has none.
    """

    _again: Any = field(default=None, compare=False)

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

    def __repr__(self) -> str:
        return (
            f"<{type(self).__name__}: {len(self.points)} vertices, "
            f"{self.self_intersections} self-intersections, '{self.stop_reason}' after "
            f"{len(self.iterations['Iteration'])} iterations>"
        )


@dataclass(frozen=True, eq=False, repr=False)
class Vessel(Segmentation):
    """A vessel, or a tree of vessels. Coordinates are the image's physical millimeters."""

    branches: list[dict[str, Any]] = field(default_factory=list)
    """Per branch the `points` (n, 3) of its center, and `radius` (n,) and `length` (n,) up to each, in mm.

    `parent` is the index of the branch that it begins on, -1 for the first.
    """

    stage_seconds: tuple[float, ...] = ()
    """Of path and outline, start surface, deformation, label map."""

    support: float = math.nan
    """The mean contrast across the outline, of 25 gray values (HU; MR scaled to CT), 0 to 1."""

    confidence: float = math.nan
    """How far the vessel can be trusted, where least, 0 to 1: how well the image shows its outline, and how
    like the vessel is what the path runs through. Doubtful below 0.45, which a FlipFreeWarning says."""

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
