"""Label maps in whatever form they come."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from ._files import read_image
from ._foreign import adopted, is_foreign
from ._image_arrays import voxels_in
from ._image_files import read_labels
from ._images import IMAGE_NAME, geometry_like, is_image
from ._messages import spelling, warn

if TYPE_CHECKING:
    from ._images import Image


def warn_of_other_labels(labels: Image, given: Any) -> None:
    """That label 1 is filled, where there are several and nobody has chosen."""
    import numpy

    voxels = voxels_in(labels)
    values = numpy.unique(voxels[voxels != 0]).tolist()  # few voxels are in an organ
    names = [str(int(value)) for value in values if value >= 1 and value == int(value)]
    if len(names) > 1 and len(names) == len(values):  # others have been warned of
        most = 20  # of a list that people read
        text = ", ".join(names[:most]) + (" and more" if names[most:] else "")
        name = f"'{os.fspath(given)}' has" if isinstance(given, (str, os.PathLike)) else "The start labels have"
        option = spelling.get().get("start_label", "start_label")
        warn(
            f"{name} the labels {text}; the surface fills label 1; to fill another one, set {option}."
        )


def require_label(name: str, label: int | str | None) -> None:
    """None, a segment's name, or a value from 0 on; `name` is the argument's."""
    if isinstance(label, bool) or not (label is None or isinstance(label, (int, str))):
        raise ValueError(f"{name}: {label!r} is neither a label nor the name of a segment")
    if label == "" or (isinstance(label, int) and label < 0):
        raise ValueError(f"{name}: {label!r} is not a label; 0 takes all nonzero voxels")


def label_map_of(
    name: str, label_map: Any, other: Any, label: int | str | None = None
) -> tuple[Image, int | None]:
    """As an image, and the value of its label; an array gets the geometry of the other image.

    `name` is the argument's. A text is the name of a segment, which a file has.
    """
    if isinstance(label_map, (str, os.PathLike)):
        return read_labels(os.fspath(label_map), "" if label is None else str(label))
    if isinstance(label, str):
        raise TypeError(
            f"{name}: {label!r} names a segment of a file (.seg.nrrd), and this is none; give the "
            "label's value"
        )
    if is_image(label_map):
        image: Image = label_map
        return image, label
    if is_foreign(label_map):
        return adopted(name, label_map), label
    if not hasattr(label_map, "__array__"):
        raise TypeError(
            f"{name}: a label map ({IMAGE_NAME}, array or name of a file) is needed, "
            f"not {label_map!r:.80}"
        )
    if isinstance(other, (str, os.PathLike)):
        other = read_image(other)
    if not is_image(other) and is_foreign(other):
        other = adopted("segmentation", other)
    if not is_image(other):
        raise TypeError(f"{name}: an array without geometry; use image_from_array(...)")
    shape = voxels_in(other).shape[:3]
    if getattr(label_map, "shape", None) != shape:
        raise ValueError(
            f"{name}: an array gets its geometry from the other image, of the shape {shape}, but has "
            f"the shape {getattr(label_map, 'shape', None)}; use image_from_array(...)"
        )
    return geometry_like(other, label_map), label
