"""Faces and triangles of a surface, as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy.typing as npt


class Faces:
    """What a surface has that knows its points and its faces' corners."""

    @property
    def volume(self) -> float:
        """What the closed surface holds, in ml.

        >>> import flipfree
        >>> ball = flipfree.phantom("sphere")
        >>> round(flipfree.segment(ball.image, *ball.seeds[1]).volume)
        113
        """
        import numpy

        corners = numpy.asarray(self.points)[self.triangles]
        normals = numpy.cross(corners[:, 1], corners[:, 2])
        return float(numpy.einsum("ij,ij->", corners[:, 0], normals)) / 6000

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

    if TYPE_CHECKING:

        @property
        def points(self) -> npt.NDArray[Any]: ...

    def cells(self) -> tuple[Any, Any]:
        """The corners of all faces in a row, where each face starts, and where the last ends."""
        raise NotImplementedError

    def _cells(self) -> tuple[Any, Any, Any]:
        """The corners of all faces, where each face starts, and its number of corners."""
        corners, offsets = self.cells()
        return corners, offsets[:-1], offsets[1:] - offsets[:-1]
