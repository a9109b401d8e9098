"""Images from files and into them, with their orientation."""

from __future__ import annotations

import os
from typing import Any

from vtkmodules.vtkCommonDataModel import vtkImageData

from ._errors import FileError
from ._progress import progress_of
from ._types import PathName, ProgressOption
from ._update import update


def read_image(
    path: PathName, *, series: str | None = None, progress: ProgressOption = None
) -> vtkImageData:
    """Reads a NIfTI, NRRD or MetaImage file, or a folder of DICOM files.

    A folder may hold several DICOM series; `series` is the Series Instance UID of the one to read,
    by default the one of most files. Coordinates are LPS millimeters.

    >>> import flipfree
    >>> flipfree.read_image("nowhere.nii.gz")
    Traceback (most recent call last):
      ...
    flipfree.FileError: 'nowhere.nii.gz' does not exist or may not be read. Check its name and ...
    """
    reader = _imaging_class("vtkMedicalImageReader")
    reader.SetFileName(os.fspath(path))
    reader.SetSeriesUID(series)
    with progress_of(progress, "reading") as tell:
        update(reader, FileError, tell)
    return reader.GetOutput()


def write_image(image: vtkImageData, path: PathName) -> None:
    """Writes a label map or a gray image: NIfTI (.nii, .nii.gz), NRRD (.nrrd), MetaImage (.mha).

    There is either the whole file afterwards or, after an error, none of it.

    >>> import flipfree, os, tempfile
    >>> phantom = flipfree.vtkPhantomSource()
    >>> phantom.Update()
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "truth.nii.gz")
    ...     flipfree.write_image(phantom.GetLabelMap(), path)
    ...     flipfree.read_image(path).GetDimensions()
    (96, 96, 96)
    """
    if not isinstance(image, vtkImageData):
        raise TypeError(f"image: a vtkImageData is needed, not {image!r:.80}; image_from_array makes one")
    writer = _imaging_class("vtkMedicalImageWriter")
    writer.SetInputDataObject(image)
    writer.SetFileName(os.fspath(path))
    update(writer, FileError, run=writer.Write)


def _imaging_class(name: str) -> Any:
    import flipfree

    if not hasattr(flipfree, name):
        raise FileError(
            "This flipfree was built without ITK and reads and writes no files: build it with "
            "FLIPFREE_USE_ITK, or use VTK's readers and image_from_array."
        )
    return getattr(flipfree, name)()
