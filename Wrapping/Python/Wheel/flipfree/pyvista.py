"""FlipFree in PyVista: `image.flipfree.segment(seed=..., radius=...)` on every pyvista.ImageData.

PyVista 0.48 and later finds this module by itself; for an earlier one, import it, and call its functions
with the image as the first argument.

    import pyvista

    ct = pyvista.ImageData(...)
    liver = ct.flipfree.segment(seed=(99.75, 83.75, 167), radius=28, labels_as="liver")
    ct.flipfree.plotter(liver).show()

In a plotter of 2 x 2 views of PyVista 0.49, `plotter.flipfree.open(ct)` has seeds and corrections
placed with the mouse.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from ._extras import missing

try:
    import pyvista
except ModuleNotFoundError as error:
    raise ImportError(missing("pyvista", "flipfree.pyvista", "pyvista", error)) from error

from ._evaluate import Scores
from ._evaluate import evaluate as evaluate_segmentation
from ._foreign import adopted
from ._files import read_image
from ._image import Image
from ._picture import CONTOUR, FRAME, INK, ORGAN, VIEWS, Region
from ._placing import Placing
from ._segment import segment as segment_organ
from ._segmentation import Segmentation, Surface, surface_of_label
from ._pyvista_views import add_contour, add_slice, look
from ._surfaces import surfaces as surfaces_of_labels
from ._types import PathName
from ._vtk_objects import imagedata_of, polydata_of


def polydata(surface: Segmentation | Surface) -> pyvista.PolyData:
    """A surface of quads (and a few triangles), with the toolkit's arrays, such as Confidence."""
    mesh = surface.mesh if isinstance(surface, Segmentation) else surface
    return pyvista.PolyData(polydata_of(mesh))


def imagedata(image: Image) -> pyvista.ImageData:
    """An image with its place in space, which shares the voxels of the other."""
    return pyvista.ImageData(imagedata_of(image))


def read(path: PathName, series: str | None = None) -> pyvista.ImageData:
    """A file or a folder of DICOM files, as flipfree.read_image reads it, with its place in space.

    PyVista's own readers of NIfTI and DICOM leave out the direction.
    """
    return imagedata(read_image(path, series=series))


def segment(
    image: pyvista.ImageData,
    seed: Sequence[float],
    radius: float,
    *,
    labels_as: str | None = None,
    **parameters: Any,
) -> pyvista.PolyData:
    """Segments the organ around a seed sphere in the active scalars of the image's points.

    Seed (x, y, z) and radius are in the image's millimeters. The surface consists of quads and has the
    field data `stop_reason`, `self_intersections`, `Certified` and `Confidence`. With `labels_as`, the label map
    becomes a point array of that name of the image; the active scalars stay as they are. The other
    parameters are those of flipfree.segment.
    """
    organ = segment_organ(adopted("image", image), seed, radius, **parameters)
    if labels_as is not None:
        active = image.active_scalars_name
        image.point_data.set_array(organ.labels.ravel(), labels_as)
        image.set_active_scalars(active)
    surface = polydata(organ)
    surface.field_data["stop_reason"] = [organ.stop_reason]
    surface.field_data["self_intersections"] = [organ.self_intersections]
    return surface


def evaluate(
    reference: pyvista.ImageData, segmentation: pyvista.PolyData | pyvista.ImageData, **parameters: Any
) -> Scores:
    """Compares a surface or a label map with a reference label map; parameters as of flipfree.evaluate."""
    return evaluate_segmentation(segmentation, reference, **parameters)


def surfaces(labels: pyvista.ImageData, only: Iterable[int] = (), **parameters: Any) -> pyvista.MultiBlock:
    """The surfaces of a label map, the active scalars, as flipfree.surfaces makes them.

    A block is the surface of a label, under the label's number, with the field data `Label`, `Name` and
    `Certified`; a label of which no part is left has none. Parameters as of flipfree.surfaces.
    """
    found = surfaces_of_labels(adopted("labels", labels), only, **parameters)
    blocks = pyvista.MultiBlock()
    for label, measures in found.labels.items():
        if measures.triangles:
            surface = polydata(surface_of_label(found, label))
            surface.field_data["Label"] = [label]
            surface.field_data["Name"] = [measures.name]
            blocks.append(surface, str(label))
    return blocks


def plotter(
    image: pyvista.ImageData,
    *surfaces: pyvista.PolyData,
    colors: Sequence[str] = (CONTOUR, "#5fb8ff", "#8be05e", "#ff7ab8"),
    **options: Any,
) -> pyvista.Plotter:
    """Axial, sagittal and coronal slices with the surfaces' contours, and the surfaces from the front.

    The slices go through the center of the first surface, and show LPS coordinates as radiologists do.
    Further options are those of pyvista.Plotter, such as off_screen=True.
    """
    import numpy

    if not surfaces:
        raise ValueError("surfaces: at least one is needed, whose contours the slices show")
    volume = adopted("image", image)
    region = Region(volume, numpy.asarray(surfaces[0].points))
    scene = pyvista.Plotter(shape=(2, 2), border=True, border_color=FRAME, **options)
    for place, view in enumerate(VIEWS):
        scene.subplot(place // 2, place % 2)
        right, up = numpy.array(view.right, float), numpy.array(view.up, float)
        add_slice(scene, volume, region, right, up)
        normal = numpy.cross(right, up)
        for surface, color in zip(surfaces, colors):
            add_contour(scene, surface, region, normal, color)
    scene.subplot(1, 1)
    scene.set_background(INK)
    for index, (surface, color) in enumerate(zip(surfaces, colors)):
        scene.add_mesh(surface, color=ORGAN if index == 0 else color, smooth_shading=True)
    look(scene, region, numpy.array([1.0, 0, 0]), numpy.array([0, 0, 1.0]), 0.75)
    return scene


class ImageAccessor:
    """`image.flipfree`: the functions of flipfree.pyvista, with the image as their first argument."""

    def __init__(self, image: pyvista.ImageData) -> None:
        self._image = image

    def segment(
        self,
        seed: Sequence[float],
        radius: float,
        *,
        labels_as: str | None = None,
        **parameters: Any,
    ) -> pyvista.PolyData:
        """The organ around a seed sphere; see flipfree.pyvista.segment."""
        return segment(self._image, seed, radius, labels_as=labels_as, **parameters)

    def evaluate(
        self, segmentation: pyvista.PolyData | pyvista.ImageData, **parameters: Any
    ) -> Scores:
        """The scores of a segmentation, with this image as the reference label map."""
        return evaluate(self._image, segmentation, **parameters)

    def surfaces(self, only: Iterable[int] = (), **parameters: Any) -> pyvista.MultiBlock:
        """The surfaces of this label map; see flipfree.pyvista.surfaces."""
        return surfaces(self._image, only, **parameters)

    def plotter(self, *surfaces: pyvista.PolyData, **options: Any) -> pyvista.Plotter:
        """Slices with contours, and the surfaces; see flipfree.pyvista.plotter."""
        return plotter(self._image, *surfaces, **options)


if hasattr(pyvista, "register_dataset_accessor"):
    pyvista.register_dataset_accessor("flipfree", pyvista.ImageData)(ImageAccessor)
if hasattr(pyvista, "register_plotter_component"):
    pyvista.register_plotter_component("flipfree")(Placing)
