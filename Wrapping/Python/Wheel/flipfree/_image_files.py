"""Images from files and into them."""

from __future__ import annotations

import os
from collections.abc import Mapping

from . import _kernels
from ._atomic import replacing
from ._dicom import may_hold_series, read_series
from ._errors import FileError
from ._extras import simpleitk
from ._image import Image
from ._messages import listed
from ._segments import ENDING, segment_fields
from ._types import Progress
from ._volume_files import read_volume, write_nifti

NIFTI_ENDINGS = (".nii.gz", ".nii")
WRITE_ENDINGS = (*NIFTI_ENDINGS, ".nrrd", ".mha")


def read(name: str, series: str | None, tell: Progress | None) -> Image:
    """The image of a file, or of a folder's DICOM series."""
    if not os.access(name, os.R_OK):
        raise FileError(
            f"'{name}' does not exist or cannot be read. Check its name and permissions."
        )
    if may_hold_series(name):
        image = read_series(name, series, tell)
    else:
        image = read_volume(name, tell)[0]
    if tell is not None:
        tell(1.0)
    return image


def read_labels(name: str, label: str) -> tuple[Image, int | None]:
    """The label map that holds a label, by a segment's name or by its value; and the value.

    Without a choice, "", there may be but one label map in the file, and no value.
    """
    if os.access(name, os.R_OK) and not may_hold_series(name):
        return read_volume(name, None, label)
    image = read(name, None, None)  # a series, or why there is nothing
    try:
        return image, _kernels.choose_value(label, name)
    except _kernels.FileProblem as problem:
        raise FileError(str(problem)) from None


def write(
    image: Image, name: str, names: Mapping[int, str] | None, colors: Mapping[int, str]
) -> None:
    """Writes an image; without names, its labels have its own."""
    if not name.lower().endswith(WRITE_ENDINGS):
        raise FileError(
            f"The file extension of '{name}' is not supported. Use {listed(WRITE_ENDINGS, 'or')}."
        )
    if name.lower().endswith(NIFTI_ENDINGS):
        write_nifti(image, name)
    else:
        _write_by_simpleitk(image, name, dict(image.names if names is None else names), colors)


def _write_by_simpleitk(
    image: Image, name: str, names: Mapping[int, str], colors: Mapping[int, str]
) -> None:
    """NRRD and MetaImage."""
    sitk = simpleitk(name)
    itk_image = sitk.GetImageFromArray(image.voxels)
    itk_image.SetSpacing(image.spacing)
    itk_image.SetOrigin(image.origin)
    itk_image.SetDirection(image.direction)
    if name.lower().endswith(ENDING):
        for key, value in segment_fields(image.voxels, name, names, colors).items():
            itk_image.SetMetaData(key, value)
    with replacing(name) as temporary:
        try:
            sitk.WriteImage(itk_image, temporary, useCompression=True)
            # Not every writer notices a full disk.
            whole = sitk.ReadImage(temporary).GetSize() == itk_image.GetSize()
        except RuntimeError as error:
            reason = str(error).strip().splitlines()[-1].partition("): ")[2].strip(" .")
            raise FileError(f"'{name}' cannot be written: {reason or error}") from error
        if not whole:
            raise FileError(f"'{name}' cannot be written completely. Free some disk space.")
