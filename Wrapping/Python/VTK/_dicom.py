"""Folders of DICOM files by the filter that reads them."""

from __future__ import annotations

from typing import Any

from ._errors import FileError
from ._image_files import imaging_class
from ._types import Progress
from ._update import update


def series_in(folder: str, tell: Progress | None) -> list[tuple[Any, ...]]:
    """The fields of each Series."""
    reader = imaging_class("vtkMedicalImageReader")
    reader.SetFileName(folder)
    update(reader, FileError, tell, reader.FindSeries)
    return [_row_of(reader, index) for index in range(reader.GetNumberOfSeries())]


def _row_of(reader: Any, index: int) -> tuple[Any, ...]:
    spacing = [0.0, 0.0, 0.0]
    reader.GetSeriesSpacing(index, spacing)
    problem = reader.GetSeriesProblem(index)
    return (
        reader.GetSeriesUID(index),
        reader.GetSeriesNumber(index),
        reader.GetSeriesDescription(index),
        reader.GetSeriesModality(index),
        reader.GetSeriesNumberOfSlices(index),
        None if problem else tuple(spacing),
        problem,
    )
