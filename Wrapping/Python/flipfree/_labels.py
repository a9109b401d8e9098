"""Label maps in whatever form they come."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from ._files import read_image
from ._foreign import adopted, is_foreign
from ._image_arrays import voxels_in
from ._images import IMAGE_NAME, geometry_like, is_image
from ._messages import spelling, warn

if TYPE_CHECKING:
    from ._images import Image


def warn_of_other_labels(labels: Image, given: Any) -> None:
    """That label 1 is filled, where there are several and nobody has chosen."""
    import numpy

    voxels = voxels_in(labels)
    values = numpy.unique(voxels[voxels > 0]).tolist()  # few voxels are in an organ
    names = [str(int(value)) for value in values if value >= 1 and value == int(value)]
    if len(names) > 1:
        most = 20  # of a list that people read
        text = ", ".join(names[:most]) + (" and more" if names[most:] else "")
        name = f"'{os.fspath(given)}' has" if isinstance(given, (str, os.PathLike)) else "The start labels have"
        option = spelling.get().get("start_label", "start_label")
        warn(
            f"{name} the labels {text}; the surface fills label 1; to fill another one, set {option}."
        )


def label_map_of(name: str, label_map: Any, other: Any) -> Image:
    """As an image; an array gets the geometry of the other one. `name` is the argument's."""
    if isinstance(label_map, (str, os.PathLike)):
        return read_image(label_map)
    if is_image(label_map):
        image: Image = label_map
        return image
    if is_foreign(label_map):
        return adopted(name, label_map)
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
    return geometry_like(other, label_map)
