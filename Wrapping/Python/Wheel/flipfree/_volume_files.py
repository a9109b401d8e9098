"""Volumes that are one file, or a header and its voxels: NIfTI, NRRD, MetaImage.

The kernels understand headers, for this package as for the toolkit; here bytes are read and inflated.
"""

from __future__ import annotations

import gzip
import math
import os
import stat
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from . import _kernels
from ._arrays import image_from_array
from ._atomic import replacing
from ._errors import FileError
from ._image import Image
from ._inflated import InflatedFile, is_packed
from ._messages import warn
from ._types import Progress

if TYPE_CHECKING:
    import numpy.typing as npt

VOXELS_AT_A_TIME = 1 << 19


def read_volume(name: str, tell: Progress | None, label: str = "") -> tuple[Image, int | None]:
    """The image; of a label map, the one that holds a label, and the value that is chosen.

    Raises FileError for what is none.
    """
    if os.path.exists(name) and not os.path.isfile(name):
        raise FileError(
            f"'{name}' is not a regular file. Give a file, or the folder of a DICOM series."
        )
    try:
        header = _open(name)
        for warning in header.warnings:
            warn(warning)
        layer, value = _kernels.choose_label(header, label)
        names = _kernels.label_names(header, layer)
        voxels = _voxels_of(header, tell)
        if header.layers > 1:
            axis = 1 if header.are_interleaved else 0
            shape = (-1, header.layers) if header.are_interleaved else (header.layers, -1)
            voxels = voxels.reshape(shape).take(layer, axis)
    except _kernels.FileProblem as problem:
        raise FileError(str(problem)) from None
    except FileError:
        raise
    except OSError as error:
        raise FileError(f"'{error.filename or name}' cannot be read ({error.strerror}).") from error
    image = image_from_array(
        voxels.reshape(header.size[::-1]), header.spacing, header.origin, header.direction
    )
    return (replace(image, names=names) if names else image), value


def write_nifti(image: Image, name: str) -> None:
    """A .nii.gz or .nii file."""
    import numpy

    voxels = numpy.ascontiguousarray(image.voxels, dtype=image.voxels.dtype.newbyteorder("="))
    try:
        header = _kernels.nifti_header(
            name,
            str(voxels.dtype),
            voxels.shape[::-1],
            image.spacing,
            image.origin,
            image.direction,
        )
    except _kernels.FileProblem as problem:
        raise FileError(str(problem)) from None
    opener: Any = gzip.open if name.lower().endswith(".gz") else open
    with replacing(name) as temporary:
        with opener(temporary, "wb") as file:
            file.write(header)
            file.write(voxels.data.cast("B"))


def _open(name: str) -> Any:
    """The header, with paths of files that are there and large enough."""
    found = [file for file in _kernels.header_files(name) if os.path.isfile(file)]
    file = found[0] if found else name
    with InflatedFile(file, file, is_packed(file)) as beginning:
        header = _kernels.VolumeFileHeader(file, beginning.read(_kernels.HEADER_BYTES))
    folder = os.path.dirname(file)
    # The header may have the names in any encoding.
    parts = [os.fsdecode(part) for part in header.files]
    files = [os.path.join(folder, part) if part else file for part in parts]
    if header.may_be_packed:
        (voxels,) = files
        if not os.path.exists(voxels) and os.path.exists(voxels + ".gz"):
            voxels += ".gz"
        files = [voxels]
        if os.path.isfile(voxels) and is_packed(voxels):
            header.take_packed()
    header.files = [os.fsencode(part) for part in files]
    header.require_files([_size_of(part) for part in files])
    return header


def _size_of(path: str) -> float:
    try:
        status = os.stat(path)
    except OSError:
        return float(_kernels.MISSING_FILE)
    return float(status.st_size if stat.S_ISREG(status.st_mode) else _kernels.IRREGULAR_FILE)


def _voxels_of(header: Any, tell: Progress | None) -> npt.NDArray[Any]:
    """All voxels of all layers, one behind the other."""
    import numpy

    values = numpy.empty(math.prod(header.size) * header.layers, dtype=header.value_type)
    count = values.size // len(header.files)
    done = 0
    for path in map(os.fsdecode, header.files):
        offset = header.offset
        if header.is_at_end:
            offset = max(0, os.path.getsize(path) - count * header.voxel_bytes)
        with InflatedFile(path, header.name, header.form == "deflated", offset) as file:
            file.skip_lines(header.lines)
            file.skip(header.skipped)
            if header.form in ("text", "hex"):
                header.decode_digits(file.rest(), values)
                return values
            for first in range(0, count, VOXELS_AT_A_TIME):
                wanted = min(VOXELS_AT_A_TIME, count - first) * header.voxel_bytes
                stored = file.read(wanted)
                if len(stored) < wanted:
                    file.require_end()
                    raise FileError(_kernels.too_few_voxels(header.name))
                header.decode(stored, values, done + first)
                if tell is not None:
                    tell((done + first) / values.size)
            file.require_end()
        done += count
    return values
