"""Files by SimpleITK."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from ._atomic import replacing
from ._completeness import require_complete
from ._dicom import read_series
from ._errors import FileError
from ._extras import ARRAY_INSTEAD, simpleitk
from ._foreign import adopted
from ._image import Image
from ._messages import listed
from ._segments import ENDING, segment_fields
from ._types import Progress

READ_ENDINGS = (".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd")
WRITE_ENDINGS = (".nii.gz", ".nii", ".nrrd", ".mha")


def read(name: str, series: str | None, tell: Progress | None) -> Image:
    """The image of a file, or of a folder's DICOM series."""
    if not os.access(name, os.R_OK):
        raise FileError(
            f"'{name}' does not exist or cannot be read. Check its name and permissions."
        )
    image = read_series(name, series, tell) if os.path.isdir(name) else _read_file(name)
    if tell is not None:
        tell(1.0)
    return image


def write(
    image: Image, name: str, names: Mapping[int, str] | None, colors: Mapping[int, str]
) -> None:
    """Writes an image; without names, its labels have its own."""
    _require_ending(name, WRITE_ENDINGS)
    sitk = simpleitk(name)
    itk_image = sitk.GetImageFromArray(image.voxels)
    itk_image.SetSpacing(image.spacing)
    itk_image.SetOrigin(image.origin)
    itk_image.SetDirection(image.direction)
    if name.lower().endswith(ENDING):
        known = dict(image.names if names is None else names)
        for key, value in segment_fields(image.voxels, name, known, colors).items():
            itk_image.SetMetaData(key, value)
    with replacing(name) as temporary:
        try:
            sitk.WriteImage(itk_image, temporary, useCompression=True)
            # Not every writer notices a full disk.
            whole = sitk.ReadImage(temporary).GetSize() == itk_image.GetSize()
        except RuntimeError as error:
            raise FileError(f"'{name}' cannot be written: {_last_line(error) or error}") from error
        if not whole:
            raise FileError(f"'{name}' cannot be written completely. Free some disk space.")


def _read_file(name: str) -> Image:
    _require_ending(name, READ_ENDINGS)
    sitk: Any = simpleitk(name, ARRAY_INSTEAD)
    try:
        image = sitk.ReadImage(name)
    except RuntimeError as error:
        reason = _last_line(error)
        raise FileError(
            f"'{name}' cannot be read: it is damaged, or its format does not match its extension"
            + (f" ({reason})." if reason else ".")
        ) from error
    require_complete(name, image)
    try:
        return adopted("image", image)
    except ValueError as error:
        raise FileError(f"'{name}': {str(error).partition(': ')[2]}") from error


def _require_ending(name: str, endings: tuple[str, ...]) -> None:
    if not name.lower().endswith(endings):
        raise FileError(
            f"The file extension of '{name}' is not supported. Use {listed(endings, 'or')}."
        )


def _last_line(error: Exception) -> str:
    """What ITK says, without where in its source."""
    return str(error).strip().splitlines()[-1].partition("): ")[2].strip(" .")
