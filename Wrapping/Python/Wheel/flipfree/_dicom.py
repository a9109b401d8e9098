"""Folders of DICOM files.

The kernels understand them, for this package as for the toolkit; zlib inflates, and SimpleITK
decodes compressed pixels.
"""

from __future__ import annotations

import os
import tempfile
import zlib
from collections.abc import Callable
from typing import Any, TypeVar

from . import _kernels
from ._errors import FileError
from ._extras import ARRAY_INSTEAD, simpleitk
from ._image import Image
from ._messages import warn
from ._run import run
from ._types import Progress

T = TypeVar("T")


def may_hold_series(path: str) -> bool:
    """Whether it is a folder, or a DICOM file of several frames."""
    return os.path.isdir(path) or bool(_kernels.dicom_files(path))


def series_in(folder: str, tell: Progress | None) -> list[tuple[Any, ...]]:
    """The fields of each Series."""

    def list_series(report: Callable[[float], bool]) -> list[tuple[Any, ...]]:
        found = _opened(folder, report)
        if found is None:
            return []
        found.require_volumes()
        return [
            (*names, None if spacing is None else tuple(spacing), problem)
            for *names, spacing, problem in found.list()
        ]

    if not may_hold_series(folder):
        raise FileError(f"'{folder}' is not a folder. Give the folder of DICOM files.")
    return _run(list_series, tell)


def read_series(folder: str, series: str | None, tell: Progress | None) -> Image:
    """Reads the volume that `series` names, or else the one of most slices."""

    def read(report: Callable[[float], bool]) -> Any:
        found = _opened(folder, report)
        return found and found.read(series or "", report)

    answer = _run(read, tell)
    for warning in filter(None, answer["warnings"]):
        warn(warning)
    shape = answer["shape"]
    voxels = answer["words"].view(answer["type"])[: shape[0] * shape[1] * shape[2]].reshape(shape)
    return Image(
        voxels,
        tuple(answer["spacing"]),
        tuple(answer["origin"]),
        tuple(answer["direction"]),
        series=answer["series"],
    )


def _opened(folder: str, report: Callable[[float], bool]) -> Any:
    """What the kernels know of a folder; None where the report has stopped them."""
    found = _kernels.DicomFolder(folder, _inflated, lambda file: _decoded(folder, file), report)
    return None if found.was_stopped() else found


def _run(work: Callable[[Callable[[float], bool]], T], tell: Progress | None) -> T:
    try:
        answer: T = run(work, FileError, "{}", {}, tell)
    except _kernels.FileProblem as problem:
        raise FileError(str(problem)) from None
    return answer


def _inflated(packed: bytes, most: int) -> bytes:
    """As far as it is sound, and up to `most` bytes."""
    stream = zlib.decompressobj(-zlib.MAX_WBITS)
    plain = bytearray()
    step = 1024  # Where bytes are damaged, zlib gives nothing of what it was called with.
    try:
        for start in range(0, len(packed), step):
            if stream.eof or len(plain) >= most:
                break
            plain += stream.decompress(packed[start : start + step], most - len(plain))
    except zlib.error:
        pass
    return bytes(plain)


def _decoded(folder: str, file: bytes) -> bytes:
    """The pixels of a minimal DICOM file; none where they are damaged."""
    sitk = simpleitk(folder, "compressed DICOM", ARRAY_INSTEAD)
    with tempfile.TemporaryDirectory() as place:
        name = os.path.join(place, "compressed.dcm")
        with open(name, "wb") as stream:
            stream.write(file)
        try:
            image = sitk.ReadImage(name)
        except RuntimeError:
            return b""
    return bytes(sitk.GetArrayViewFromImage(image).tobytes())
