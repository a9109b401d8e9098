"""The methods that are compared."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Method:
    """As RunMethod calls it, and as tables do."""

    key: str
    title: str
    ours: bool = False
    plane: bool = False
    """Outlines the seed's slice alone, and is scored there."""


METHODS = (
    Method("flipfree", "FlipFree", ours=True),
    Method("published", "FlipFree, as published", ours=True),
    Method("naive", "FlipFree, naive", ours=True),
    Method("level-set-threshold", "level set, threshold"),
    Method("level-set-geodesic", "level set, geodesic"),
    Method("graph-cut-volume", "graph cut, 3D"),
    Method("graph-cut-slices", "graph cut, slices"),
    Method("region-growing", "region growing"),
    Method("simplex-mesh", "simplex mesh"),
    Method("gvf-snake", "GVF snake, one slice", plane=True),
)
