"""A picture of a segmentation: three slices with its contour, and the surface, by matplotlib."""

from __future__ import annotations

import io
import os
from typing import TYPE_CHECKING, Any, NamedTuple

from ._atomic import replacing
from ._errors import FlipFreeError
from ._extras import needed
from ._image import Image as Volume
from ._segmentation import Segmentation
from ._types import PathName

if TYPE_CHECKING:
    import numpy.typing as npt


class View(NamedTuple):
    """How a slice is seen: to the right and up, in LPS, and the patient's sides at two edges."""

    right: tuple[int, int, int]
    up: tuple[int, int, int]
    left_side: str
    upper_side: str


# Axial from the feet, sagittal from the patient's left, coronal from the front.
VIEWS = (
    View((1, 0, 0), (0, -1, 0), "R", "A"),
    View((0, 1, 0), (0, 0, 1), "A", "S"),
    View((1, 0, 0), (0, 0, 1), "R", "S"),
)
# Left and lower edges of the slices and of the surface, and their width, of the picture's.
PLACES, WIDTH = ((0, 0.5025), (0.5025, 0.5025), (0, 0), (0.5025, 0)), 0.4975
# The side of a slice, of the surface's greatest extent; in mm at the least; and in points.
ROOM, LEAST_SIDE, SLICE_POINTS = 1.8, 60.0, 400
INK, CONTOUR, LETTER, ORGAN = "#0b0d0f", "#ffc233", "#d9dbe0", (0.86, 0.42, 0.33)
FRAME = "#292b33"
# The contour where the image does not support it: where a vertex has a lower confidence.
DOUBT, DOUBTFUL = "#4099ff", 0.5


def require_matplotlib() -> None:
    """Raises an error that says how to install it."""
    needed("matplotlib", "a picture", "plot")


def write_picture(path: PathName, image: Volume, organ: Segmentation, size: int = 1200) -> None:
    """Writes a .png or .jpg file: axial, sagittal and coronal slices through the surface's center.

    The contour is blue where the image does not support it.
    """
    require_matplotlib()
    if not os.fspath(path).lower().endswith((".png", ".jpg")):
        raise FlipFreeError(f"'{path}': pictures are .png or .jpg files")
    with replacing(path) as temporary:
        _drawn(image, organ, size).save(temporary, optimize=True)


def png_of(image: Volume, organ: Segmentation, size: int) -> bytes:
    """The same picture as the bytes of a .png file, with a palette, which makes it smaller."""
    file = io.BytesIO()
    _drawn(image, organ, size).quantize(256, dither=0).save(file, "png", optimize=True)
    return file.getvalue()


def _drawn(image: Volume, organ: Segmentation, size: int) -> Any:
    """As an image of PIL."""
    import numpy
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image

    figure = Figure(figsize=(size / 100, size / 100), dpi=100, facecolor=FRAME)
    canvas = FigureCanvasAgg(figure)
    region = Region(image, organ.points)
    *slices, body = (_empty_axes(figure, left, bottom) for left, bottom in PLACES)
    for axes, view in zip(slices, VIEWS):
        _draw_slice(axes, image, organ, region, view, max(size / 1200, 0.8))
    _draw_surface(body, organ, region)
    canvas.draw()
    pixels = numpy.asarray(canvas.buffer_rgba())[..., :3]
    return Image.fromarray(numpy.ascontiguousarray(pixels))


class Region:
    """What the slices show: a square around the surface, and the window of gray values."""

    def __init__(self, image: Volume, points: npt.NDArray[Any]) -> None:
        low, high = points.min(axis=0), points.max(axis=0)
        self.center: npt.NDArray[Any] = (low + high) / 2
        self.side = float(max(ROOM * (high - low).max(), LEAST_SIDE))
        self.window = _window_of(image)

    def plane(
        self, right: npt.NDArray[Any], up: npt.NDArray[Any], steps: npt.NDArray[Any]
    ) -> npt.NDArray[Any]:
        """Points of space [row, column, axis], `steps` (mm) from the center along both directions."""
        points: npt.NDArray[Any] = (
            self.center + steps[None, :, None] * right + steps[:, None, None] * up
        )
        return points


def _window_of(image: Volume) -> tuple[float, float]:
    """The gray values that are black and white."""
    import numpy

    some = image.voxels.ravel()[:: max(1, image.voxels.size // 1000000)]
    bottom, top = numpy.quantile(some[numpy.isfinite(some)], (0.01, 0.99))
    # A CT is known by its air, which other scales have elsewhere.
    if -4096 <= bottom < -700 and top > 100:
        return -150.0, 250.0
    return bottom, top if top > bottom else bottom + 1


def _empty_axes(figure: Any, left: float, bottom: float) -> Any:
    axes = figure.add_axes((left, bottom, WIDTH, WIDTH), facecolor=INK)
    axes.set(xticks=[], yticks=[], aspect="equal")
    for spine in axes.spines.values():
        spine.set_visible(False)
    return axes


def _draw_slice(
    axes: Any, image: Volume, organ: Segmentation, region: Region, view: View, scale: float
) -> None:
    import numpy
    from matplotlib.collections import LineCollection

    right, up = numpy.array(view.right, float), numpy.array(view.up, float)
    half = region.side / 2
    steps = (numpy.arange(SLICE_POINTS) + 0.5) / SLICE_POINTS * region.side - half
    axes.imshow(
        sampled(image, region.plane(right, up, steps), region.window[0]),
        extent=(-half, half, -half, half),
        origin="lower",
        cmap="gray",
        vmin=region.window[0],
        vmax=region.window[1],
        interpolation="bilinear",
    )
    segments, doubtful = cut(organ, region.center, numpy.cross(right, up))
    around = segments - region.center
    flat: npt.NDArray[Any] = numpy.stack([around @ right, around @ up], axis=-1)
    for color, width, lines in (
        (INK, 4.5, flat),
        (CONTOUR, 2.2, flat[~doubtful]),
        (DOUBT, 2.2, flat[doubtful]),
    ):
        axes.add_collection(
            LineCollection(lines, colors=color, linewidths=width * scale, capstyle="round")
        )
    axes.set(xlim=(-half, half), ylim=(-half, half))
    style = {"color": LETTER, "ha": "center", "va": "center", "fontsize": 13 * scale}
    for letter, place in ((view.left_side, (0.035, 0.5)), (view.upper_side, (0.5, 0.965))):
        axes.text(*place, letter, transform=axes.transAxes, **style)


def sampled(image: Volume, points: npt.NDArray[Any], outside: float) -> npt.NDArray[Any]:
    """The gray values at points of space, between voxels linear; `outside` beyond the image."""
    import numpy

    index = (points - numpy.array(image.origin)) @ numpy.linalg.inv(image.steps).T
    last = numpy.array(image.voxels.shape[::-1]) - 1
    inside = ((index >= -0.5) & (index <= last + 0.5)).all(axis=-1)
    index = numpy.clip(index, 0, last)
    low = numpy.minimum(index.astype(int), numpy.maximum(last - 1, 0))
    part = index - low
    high = numpy.minimum(low + 1, last)
    values = numpy.zeros(points.shape[:-1])
    for corner in range(8):
        takes_high = [corner >> axis & 1 for axis in range(3)]
        i, j, k = ((high if upper else low)[..., axis] for axis, upper in enumerate(takes_high))
        weight = numpy.prod(
            [part[..., a] if upper else 1 - part[..., a] for a, upper in enumerate(takes_high)],
            axis=0,
        )
        values += weight * image.voxels[k, j, i]
    return numpy.where(inside, values, outside)


def cut(
    organ: Segmentation, point: npt.NDArray[Any], normal: npt.NDArray[Any]
) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Where the triangles meet a plane: segments [n, 2, 3], and which of them are doubtful."""
    import numpy

    corners = organ.points[organ.triangles]
    confidence = organ.vertex_confidence
    doubtful = numpy.zeros(len(corners), bool)
    if confidence is not None:
        doubtful = confidence[organ.triangles].mean(axis=1) < DOUBTFUL
    height = (corners - point) @ normal
    height = numpy.where(height == 0, 1e-12, height)  # no vertex lies on the plane
    above = height > 0
    crossing = above.any(axis=1) & ~above.all(axis=1)
    corners, height, above = corners[crossing], height[crossing], above[crossing]
    # The corner that is alone on its side, and the two others.
    alone = numpy.where(above.sum(axis=1) == 1, above.argmax(axis=1), above.argmin(axis=1))
    rows = numpy.arange(len(alone))
    ends = []
    for step in (1, 2):
        other = (alone + step) % 3
        part = height[rows, alone] / (height[rows, alone] - height[rows, other])
        ends.append(
            corners[rows, alone] + part[:, None] * (corners[rows, other] - corners[rows, alone])
        )
    segments: npt.NDArray[Any] = numpy.stack(ends, axis=1)
    return segments, doubtful[crossing]


def _draw_surface(axes: Any, organ: Segmentation, region: Region) -> None:
    """From the front, the farthest triangles first."""
    import numpy
    from matplotlib.collections import PolyCollection

    corners = organ.points[organ.triangles] - region.center
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    seen = numpy.flatnonzero(normals[:, 1] < 0)
    seen = seen[numpy.argsort(-corners[seen, :, 1].mean(axis=1))]
    light = numpy.array([-0.4, -0.8, 0.45])
    bright = 0.25 + 0.75 * numpy.clip(normals[seen] @ light, 0, 1)
    colors = bright[:, None] * numpy.array(ORGAN)
    flat = corners[seen][:, :, [0, 2]]
    axes.add_collection(
        PolyCollection(flat, facecolors=colors, edgecolors=colors, linewidths=0.3)
    )
    half = 0.6 * region.side / ROOM * 1.1
    axes.set(xlim=(-half, half), ylim=(-half, half))
