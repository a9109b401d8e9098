"""The surfaces of all labels of a label map, with shared walls."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from ._backend import SURFACES_PARAMETERS, SurfacesAlgorithm
from ._labels import label_map_of
from ._parameters import described, set_parameters, signature_with
from ._progress import progress_of
from ._types import ProgressOption

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._images import AnyImage


@dataclass(frozen=True)
class LabelMeasures:
    """What the surface of a label is like. Volumes are in ml, the area is in square millimeters."""

    label: int
    name: str
    """Empty where the label map's file does not name it."""
    volume: float
    voxels: int
    voxel_volume: float
    """Of the label map's voxels."""
    wrong_voxels: int
    """Those inside that have another label, and those of the label that are not inside."""
    area: float
    euler_number: int
    """2 for each piece and each cavity, less 2 for each tunnel."""
    triangles: int
    """0 if all its parts are smaller than smallest_part: then it has no surface."""

    COLUMNS: ClassVar[dict[str, str]] = {
        "Label": "label",
        "Name": "name",
        "Milliliters": "volume",
        "Voxels": "voxels",
        "VoxelMilliliters": "voxel_volume",
        "WrongVoxels": "wrong_voxels",
        "Area": "area",
        "EulerNumber": "euler_number",
        "Triangles": "triangles",
    }
    """The columns of tables, and the fields in them."""


@dataclass(frozen=True, eq=False, repr=False)
class LabelSurfaces:
    """The walls between labels, and the surface of each label. Coordinates are physical millimeters."""

    points: npt.NDArray[Any]
    """The vertices of all walls as rows (x, y, z), numbers that single precision holds."""

    triangles: npt.NDArray[Any]
    """The corners of all triangles as rows, counter-clockwise seen from the second label."""

    boundary_labels: npt.NDArray[Any]
    """The labels on both sides of each triangle; background, 0, is the second, or else the greater one."""

    labels: dict[int, LabelMeasures]
    """The measures of each label."""

    wrong_voxels: int
    """How many voxels have a label in whose surface they are not."""

    greatest_distance: float
    """Of a vertex from the nearest corner of voxels of different labels, in mm."""

    collapse_distance: float
    """Between the walls before and after edges were collapsed, in mm: of all vertices, and of the
    middles of the edges and triangles that are left."""

    def surface(self, label: int) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
        """The points and the triangles of a label, closed and counter-clockwise seen from outside.

        >>> import flipfree
        >>> found = flipfree.surfaces(flipfree.phantom("sphere").label_map)
        >>> points, triangles = found.surface(1)
        >>> points.shape[1], int(triangles.max()) + 1 == len(points)
        (3, True)
        """
        import numpy

        if label not in self.labels or not self.labels[label].triangles:
            raise ValueError(f"label: {label!r} has no surface; there are {self._present()}")
        is_first, is_second = (self.boundary_labels == label).T
        triangles = numpy.where(is_second[:, None], self.triangles[:, ::-1], self.triangles)
        used, corners = numpy.unique(triangles[is_first | is_second], return_inverse=True)
        return self.points[used], corners.reshape(-1, 3).astype(numpy.int32)

    def _present(self) -> list[int]:
        return [label for label, measures in self.labels.items() if measures.triangles]

    def __repr__(self) -> str:
        return f"<LabelSurfaces: {len(self._present())} labels, {len(self.triangles)} triangles>"


def surfaces(
    labels: AnyImage,
    only: Iterable[int] = (),
    *,
    progress: ProgressOption = None,
    **parameters: Any,
) -> LabelSurfaces:
    """Makes a closed surface for each label of a label map; two labels have one wall between them.

    Each surface is a 2-manifold without self-intersections, whatever the labels are. With exact=True,
    each voxel center stays on the side of its own label, so that the voxels in the surfaces are the
    label map again.

    labels
        An image, also of SimpleITK or nibabel, or the name of a file. Of whole numbers; 0 is background.
    only
        The labels that get surfaces, all others being background; by default, all get one.
    progress
        As for segment().

    Raises FlipFreeError if it is no label map, FileError if the file cannot be read.

    >>> import flipfree
    >>> phantom = flipfree.phantom("abdomen")
    >>> found = flipfree.surfaces(phantom.label_map, exact=True)
    >>> found.wrong_voxels
    0
    >>> liver = found.labels[flipfree.Organ.LIVER]
    >>> abs(liver.volume / liver.voxel_volume - 1) < 0.005
    True
    """
    algorithm = SurfacesAlgorithm()
    set_parameters("surfaces", algorithm.settings, SURFACES_PARAMETERS, parameters)
    image, _ = label_map_of("labels", labels, None)
    with progress_of(progress, "surfaces") as tell:
        answer = algorithm.run(image, [int(label) for label in only], tell)
    rows = answer.pop("rows")
    columns = LabelMeasures.COLUMNS
    measures = [LabelMeasures(**{field: row[name] for name, field in columns.items()}) for row in rows]
    return LabelSurfaces(labels={one.label: one for one in measures}, **answer)


# Help and completion show the parameters as if they were spelled out above.
surfaces.__doc__ = f"{surfaces.__doc__}\n    The other parameters:\n\n{described(SURFACES_PARAMETERS)}\n"
_SIGNATURE = signature_with(surfaces, SurfacesAlgorithm().settings, SURFACES_PARAMETERS)
surfaces.__signature__ = _SIGNATURE  # type: ignore[attr-defined]
