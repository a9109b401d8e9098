"""Slices and contours in plotters of PyVista."""

from __future__ import annotations

from typing import Any

import pyvista

from ._image import Image
from ._picture import INK, SLICE_POINTS, Region, sampled


def add_slice(
    scene: pyvista.Plotter, volume: Image, region: Region, right: Any, up: Any, **options: Any
) -> Any:
    """The slice through the region's center in the present view, which looks at it; its actor."""
    import numpy

    steps = ((numpy.arange(SLICE_POINTS) + 0.5) / SLICE_POINTS - 0.5) * region.side
    black, white = region.window
    values = sampled(volume, region.plane(right, up, steps), black)
    gray = (numpy.clip((values - black) / (white - black), 0, 1) * 255).astype(numpy.uint8)
    # One square with a texture: a cell per value takes a second to draw where there is no graphics card.
    ends = numpy.array([-0.5, 0.5]) * region.side
    square = pyvista.PolyData(region.plane(right, up, ends).reshape(4, 3), [4, 0, 1, 3, 2])
    square.active_texture_coordinates = numpy.array([[0, 0], [1, 0], [0, 1], [1, 1.0]])
    texture = pyvista.Texture(numpy.repeat(gray[::-1, :, None], 3, axis=2))
    texture.interpolate = True
    scene.set_background(INK)
    actor = scene.add_mesh(square, texture=texture, lighting=False, **options)
    look(scene, region, right, up, 1.0)
    return actor


def add_contour(
    scene: pyvista.Plotter, surface: pyvista.PolyData, region: Region, normal: Any, color: str, **options: Any
) -> None:
    """Where the surface meets the slice through the region's center, if it does."""
    contour = surface.slice(normal=normal, origin=region.center)
    if contour.n_points:
        contour.points = contour.points + normal * (1e-3 * region.side)  # before the slice
        scene.add_mesh(contour, color=color, line_width=3, lighting=False, **options)


def look(scene: pyvista.Plotter, region: Region, right: Any, up: Any, zoom: float) -> None:
    """Along the normal of a slice, at the region's center."""
    import numpy

    toward = numpy.cross(right, up)
    scene.camera_position = [region.center + 3 * region.side * toward, region.center, up]
    scene.enable_parallel_projection()
    scene.camera.parallel_scale = zoom * region.side / 2
