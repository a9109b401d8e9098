"""Files by the filters that read and write them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkFieldData, vtkImageData

from ._errors import FileError
from ._types import Progress
from ._update import update


def read(name: str, series: str | None, tell: Progress | None) -> vtkImageData:
    """The image of a file, or of a folder's DICOM series."""
    reader = imaging_class("vtkMedicalImageReader")
    reader.SetFileName(name)
    reader.SetSeriesUID(series)
    update(reader, FileError, tell)
    return reader.GetOutput()


def read_labels(name: str, label: str) -> tuple[vtkImageData, int | None]:
    """The label map that holds a label, by a segment's name or by its value; and the value.

    Without a choice, "", there may be but one label map in the file, and no value.
    """
    reader = imaging_class("vtkMedicalImageReader")
    reader.SetFileName(name)
    reader.SetSegment(label)
    update(reader, FileError)
    return reader.GetOutput(), reader.GetSegmentLabel() if label else None


def write(
    image: vtkImageData, name: str, names: Mapping[int, str] | None, colors: Mapping[int, str]
) -> None:
    """Writes an image; without names, its labels have those of its field data."""
    writer = imaging_class("vtkMedicalImageWriter")
    writer.SetInputDataObject(image if names is None else _named(image, names, colors))
    writer.SetFileName(name)
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


def imaging_class(name: str) -> Any:
    """A filter of the module that needs ITK."""
    import flipfree

    if not hasattr(flipfree, name):
        raise FileError(
            "This flipfree was built without ITK and reads and writes no files: build it with "
            "FLIPFREE_USE_ITK, or use VTK's readers and image_from_array."
        )
    return getattr(flipfree, name)()
