"""How far a surface can be trusted, from the image alone."""

from __future__ import annotations

from typing import Any

from ._image import Image
from ._picture import sampled
from ._segmentation import Segmentation

# Standard deviations that a gray value of the organ may be off.
OWN = 2.0
# How far from the surface gray values are taken, in voxels.
DISTANCE = 1.5


def confidence_of(image: Image, organ: Segmentation) -> float:
    """The share of the surface, from 0 to 1, that separates the organ from something else.

    There, the gray value just inside the surface is one of the organ's, and the one just outside is not: the
    organ's are known by their median and their spread (1.48 times the median deviation) inside the
    surface. A surface that has leaked lies in tissue of the same kind in part, or encloses other tissue.
    """
    import numpy

    inside = image.voxels[organ.labels != 0]
    if inside.size == 0:
        return 0.0
    median = float(numpy.median(inside))
    spread = max(1.4826 * float(numpy.median(numpy.abs(inside - median))), 1e-12)
    normals, areas = normals_of(organ)
    axes = numpy.reshape(image.direction, (3, 3)) * image.spacing
    # A voxel's length along the normal.
    steps = DISTANCE / numpy.maximum(numpy.abs(normals @ numpy.linalg.inv(axes).T).max(axis=1), 1e-12)

    def is_own(side: float) -> Any:
        points = organ.points + (side * steps)[:, None] * normals
        return numpy.abs(sampled(image, points, numpy.inf) - median) <= OWN * spread

    return float((areas * (is_own(-1.0) & ~is_own(1.0))).sum() / areas.sum())


def normals_of(organ: Segmentation) -> tuple[Any, Any]:
    """Of each vertex, the outward unit normal and the area that belongs to it."""
    import numpy

    corners = organ.points[organ.triangles]
    doubled = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals, areas = numpy.zeros(organ.points.shape), numpy.zeros(len(organ.points))
    for corner in range(3):
        numpy.add.at(normals, organ.triangles[:, corner], doubled)
        numpy.add.at(areas, organ.triangles[:, corner], numpy.linalg.norm(doubled, axis=1) / 6)
    return normals / numpy.maximum(numpy.linalg.norm(normals, axis=1, keepdims=True), 1e-30), areas
