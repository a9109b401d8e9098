"""Images from files and into them, with their orientation, by SimpleITK."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from ._atomic import replacing
from ._dicom import read_series
from ._errors import FileError
from ._extras import ARRAY_INSTEAD, simpleitk
from ._foreign import adopted
from ._image import Image
from ._progress import progress_of
from ._segments import ENDING, segment_fields
from ._types import PathName, ProgressOption

READ_ENDINGS = (".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd")
WRITE_ENDINGS = (".nii.gz", ".nii", ".nrrd", ".mha")


def read_image(
    path: PathName, *, series: str | None = None, progress: ProgressOption = None
) -> Image:
    """Reads a NIfTI, NRRD or MetaImage file, or a folder of DICOM files.

    A folder may hold several DICOM series; `series` is the Series Instance UID of the one to read,
    by default the one of most files. Coordinates are LPS millimeters. Needs SimpleITK, which
    `pip install '.[io]'` in the source folder brings along.

    >>> import flipfree
    >>> flipfree.read_image("nowhere.nii.gz")
    Traceback (most recent call last):
      ...
    flipfree.FileError: 'nowhere.nii.gz' does not exist or may not be read. Check its name and ...
    """
    name = os.fspath(path)
    if not os.access(name, os.R_OK):
        raise FileError(
            f"'{name}' does not exist or may not be read. Check its name and permissions."
        )
    with progress_of(progress, "reading") as tell:
        image = read_series(name, series) if os.path.isdir(name) else _read_file(name)
        if tell is not None:
            tell(1.0)
    return image


def write_image(
    image: Image,
    path: PathName,
    *,
    names: Mapping[int, str] | None = None,
    colors: Mapping[int, str] | None = None,
) -> None:
    """Writes a label map or a gray image: NIfTI (.nii, .nii.gz), NRRD (.nrrd), MetaImage (.mha).

    There is either the whole file afterwards or, after an error, none of it. Needs SimpleITK, which
    `pip install '.[io]'` in the source folder brings along.

    A path that ends on .seg.nrrd makes a label map a segmentation of 3D Slicer, in which each label has a
    name and a color: those of `names` and `colors` by label, {1: "liver"} and {1: "#ffd24a"}, or else
    the organs' names in what segment_organs() returns, or the file's name where there is one label.

    >>> import flipfree
    >>> flipfree.write_image(flipfree.phantom("sphere").label_map, "truth.jpg")
    Traceback (most recent call last):
      ...
    flipfree.FileError: The ending of 'truth.jpg' stands for no format known here. Use .nii.gz, ...
    """
    name = os.fspath(path)
    if not isinstance(image, Image):
        raise TypeError(
            f"image: a flipfree.Image is needed, not {image!r:.80}; image_from_array makes one"
        )
    _require_ending(name, WRITE_ENDINGS)
    sitk = simpleitk(name)
    itk_image = sitk.GetImageFromArray(image.voxels)
    itk_image.SetSpacing(image.spacing)
    itk_image.SetOrigin(image.origin)
    itk_image.SetDirection(image.direction)
    if name.lower().endswith(ENDING):
        known = dict(image.names if names is None else names)
        for key, value in segment_fields(image.voxels, name, known, colors or {}).items():
            itk_image.SetMetaData(key, value)
    with replacing(name) as temporary:
        try:
            sitk.WriteImage(itk_image, temporary, useCompression=True)
            # Not every writer notices a full disk.
            whole = sitk.ReadImage(temporary).GetSize() == itk_image.GetSize()
        except RuntimeError as error:
            raise FileError(f"'{name}' cannot be written: {_last_line(error)}") from error
        if not whole:
            raise FileError(f"'{name}' cannot be written completely. Make room on the disk.")


def _read_file(name: str) -> Image:
    _require_ending(name, READ_ENDINGS)
    sitk: Any = simpleitk(name, ARRAY_INSTEAD)
    try:
        image = sitk.ReadImage(name)
        return adopted("image", image)
    except RuntimeError as error:
        raise FileError(
            f"'{name}' cannot be read: it is damaged, or of another format than its ending says "
            f"({_last_line(error)})."
        ) from error
    except ValueError as error:
        raise FileError(f"'{name}': {str(error).partition(': ')[2]}") from error


def _require_ending(name: str, endings: tuple[str, ...]) -> None:
    if not name.lower().endswith(endings):
        raise FileError(
            f"The ending of '{name}' stands for no format known here. Use "
            f"{', '.join(endings[:-1])} or {endings[-1]}."
        )


def _last_line(error: Exception) -> str:
    """What ITK says, without where in its source."""
    return str(error).strip().splitlines()[-1].partition("): ")[2].strip(" .") or "no reason given"
