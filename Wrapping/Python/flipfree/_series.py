"""What a folder of DICOM files holds."""

from __future__ import annotations

import os
from dataclasses import dataclass

from ._dicom import series_in
from ._progress import progress_of
from ._types import PathName, ProgressOption


@dataclass(frozen=True)
class Series:
    """A volume in a folder of DICOM files."""

    uid: str
    """What read_image(..., series=...) takes: the Series Instance UID, and #n after it where the
    series holds several volumes."""

    number: str
    """Series Number, as the scanner counts them."""

    description: str
    """Series Description."""

    modality: str
    """CT, MR and so on."""

    slices: int
    """Number of slices."""

    spacing: tuple[float, ...] | None
    """Distance of voxel centers along each axis, in mm; None if the volume cannot be read."""

    problem: str
    """Why the volume cannot be read; empty if it can."""


def series(folder: PathName, *, progress: ProgressOption = None) -> list[Series]:
    """Lists the series in a folder of DICOM files, the one of the greatest volume first.

    Reports, contours, scouts and other files that are no slices are not listed.

    >>> import flipfree
    >>> flipfree.series("nowhere")
    Traceback (most recent call last):
      ...
    flipfree.FileError: 'nowhere' is not a folder. Give the folder of DICOM files.
    """
    with progress_of(progress, "reading") as tell:
        rows = series_in(os.fspath(folder), tell)
    return [Series(*row) for row in rows]
