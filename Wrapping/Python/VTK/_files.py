"""Images from files and into them, with their orientation."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkFieldData, vtkImageData

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


def write_image(
    image: vtkImageData,
    path: PathName,
    *,
    names: Mapping[int, str] | None = None,
    colors: Mapping[int, str] | None = None,
) -> None:
    """Writes a label map or a gray image: NIfTI (.nii, .nii.gz), NRRD (.nrrd), MetaImage (.mha).

    There is either the whole file afterwards or, after an error, none of it.

    A path that ends on .seg.nrrd makes a label map a segmentation of 3D Slicer, in which each label has a
    name and a color: those of `names` and `colors` by label, {1: "liver"} and {1: "#ffd24a"}, or else
    the organs' names in what segment_organs() returns, or the file's name where there is one label.

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
    writer.SetInputDataObject(image if names is None else _named(image, names, colors or {}))
    writer.SetFileName(os.fspath(path))
    update(writer, FileError, run=writer.Write)


def _named(
    image: vtkImageData, names: Mapping[int, str], colors: Mapping[int, str]
) -> vtkImageData:
    """The same image with field data that name its labels."""
    labels, texts, shades = vtkDoubleArray(), vtkStringArray(), vtkStringArray()
    for label, name in names.items():
        labels.InsertNextValue(label)
        texts.InsertNextValue(name)
        shades.InsertNextValue(colors.get(label, ""))
    named = vtkImageData()
    named.ShallowCopy(image)
    fields = vtkFieldData()
    fields.ShallowCopy(image.GetFieldData())
    for array, title in ((labels, "Labels"), (texts, "Names"), (shades, "Colors")):
        array.SetName(f"Segment{title}")
        fields.AddArray(array)
    named.SetFieldData(fields)
    return named


def _imaging_class(name: str) -> Any:
    import flipfree

    if not hasattr(flipfree, name):
        raise FileError(
            "This flipfree was built without ITK and reads and writes no files: build it with "
            "FLIPFREE_USE_ITK, or use VTK's readers and image_from_array."
        )
    return getattr(flipfree, name)()
