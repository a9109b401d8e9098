"""Images from files and into them, with their orientation."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING

from ._errors import FileError
from ._image_files import read, write
from ._images import IMAGE_NAME, is_image, series_of
from ._messages import spelling
from ._progress import progress_of
from ._types import PathName, ProgressOption

if TYPE_CHECKING:
    from ._images import Image


def read_image(
    path: PathName, *, series: str | None = None, progress: ProgressOption = None
) -> Image:
    """Reads a NIfTI, NRRD or MetaImage file, a folder of DICOM files, or a multi-frame DICOM file.

    A folder may hold several DICOM series; `series` is the Series Instance UID of the one to read,
    by default the one of most slices. A series may hold several volumes (times, echoes, stacks):
    "UID#1", "UID#2" and so on. flipfree.series() lists them. Coordinates are LPS millimeters. What a
    file does not say, or says twice, is a FlipFreeWarning. The package without VTK needs SimpleITK
    for compressed DICOM files, which `pip install '.[io]'` in the source folder brings along.

    >>> import flipfree
    >>> flipfree.read_image("nowhere.nii.gz")
    Traceback (most recent call last):
      ...
    flipfree.FileError: 'nowhere.nii.gz' does not exist or cannot be read. Check its name and ...
    """
    with progress_of(progress, "reading") as tell:
        image = read(os.fspath(path), series, tell)
    if series and not series_of(image):
        raise FileError(
            f"'{os.fspath(path)}' holds no DICOM series of which {spelling.get().get('series', 'series')} "
            "could choose one. Give the folder of DICOM files, or leave it out."
        )
    return image


def write_image(
    image: Image,
    path: PathName,
    *,
    names: Mapping[int, str] | None = None,
    colors: Mapping[int, str] | None = None,
) -> None:
    """Writes a label map or a gray image: NIfTI (.nii, .nii.gz), NRRD (.nrrd), MetaImage (.mha).

    There is either the whole file afterward or, after an error, none of it. The package without VTK
    needs SimpleITK for NRRD and MetaImage.

    A path that ends on .seg.nrrd makes a label map a segmentation of 3D Slicer, in which each label
    has a name and a color: those of `names` and `colors` by label, {1: "liver"} and {1: "#ffd24a"},
    or else the organs' names in what segment_organs() returns, or the file's name where there is one
    label.

    >>> import flipfree
    >>> flipfree.write_image(flipfree.phantom("sphere").label_map, "truth.jpg")
    Traceback (most recent call last):
      ...
    flipfree.FileError: The file extension of 'truth.jpg' is not supported. Use .nii.gz, ...
    """
    if not is_image(image):
        raise TypeError(
            f"image: a {IMAGE_NAME} is needed, not {image!r:.80}; image_from_array makes one"
        )
    write(image, os.fspath(path), names, colors or {})
