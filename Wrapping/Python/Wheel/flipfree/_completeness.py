"""Whether a file holds all of its voxels: SimpleITK reads missing ones as zeros."""

from __future__ import annotations

import math
import os
import re
import struct
import zlib
from typing import Any, BinaryIO, NamedTuple

from ._errors import FileError

CHUNK = 1 << 20


class _Voxels(NamedTuple):
    """Where voxels are in a file."""

    name: str
    offset: int
    deflated: bool
    """By zlib or gzip, from the offset on."""

    size: int
    """In bytes, inflated."""


def require_complete(name: str, image: Any) -> None:
    """Raises FileError where the file, from which SimpleITK has read the image, breaks off.

    Files that a header lists one by one are not looked at: of these, ITK notices the end.
    """
    count = (
        image.GetNumberOfPixels()
        * image.GetNumberOfComponentsPerPixel()
        * image.GetSizeOfPixelComponent()
    )
    lower = name.lower()
    if lower.endswith((".nii", ".nii.gz")):
        voxels = _in_nifti(name)
    elif lower.endswith((".mha", ".mhd")):
        voxels = _in_meta_image(name, count)
    else:
        voxels = _in_nrrd(name, count)
    if voxels is None:
        return
    with open(voxels.name, "rb") as file:
        file.seek(voxels.offset)
        if voxels.deflated:
            _require_stream(name, file, voxels.size)
        elif os.path.getsize(voxels.name) < voxels.offset + voxels.size:
            raise _incomplete(name, "it holds fewer voxels than its header says")


def _in_nifti(name: str) -> _Voxels | None:
    """By the header, not the image: SimpleITK gives scaled voxels another type."""
    with open(name, "rb") as file:
        deflated = file.read(2) == b"\x1f\x8b"
        file.seek(0)
        start = file.read(4096)
    if deflated:
        try:
            start = zlib.decompressobj(zlib.MAX_WBITS + 32).decompress(start)
        except zlib.error:
            raise _incomplete(name, "its compressed stream is damaged") from None
    for order in "<>":
        if struct.unpack_from(order + "i", start)[0] == 348:  # ITK reads the first version alone
            dimensions = struct.unpack_from(order + "8h", start, 40)
            bits = struct.unpack_from(order + "h", start, 72)[0]
            begin = int(struct.unpack_from(order + "f", start, 108)[0])
            count = math.prod(dimensions[1 : dimensions[0] + 1]) * bits // 8
            return _Voxels(name, 0, True, begin + count) if deflated else _Voxels(name, begin, False, count)
    return None


def _in_meta_image(name: str, count: int) -> _Voxels | None:
    """Only compressed voxels: of others, ITK notices the end."""
    header = _header(name, rb"^ElementDataFile *= *[^\n]*\n?")
    if not re.search(r"^CompressedData *= *True", header, re.MULTILINE | re.IGNORECASE):
        return None
    data = re.search(r"^ElementDataFile *= *(.*?)\s*$", header, re.MULTILINE)
    if data is None or data[1] in ("LIST", "") or "%" in data[1]:
        return None
    if data[1] == "LOCAL":
        return _Voxels(name, len(header), True, count)
    return _Voxels(os.path.join(os.path.dirname(name), data[1]), 0, True, count)


def _in_nrrd(name: str, count: int) -> _Voxels | None:
    """Only compressed voxels: of others, ITK notices the end."""
    header = _header(name, rb"^\r?\n")
    if not re.search(r"^encoding: *(gz|gzip)\s*$", header, re.MULTILINE | re.IGNORECASE) or re.search(
        r"^(line|byte) ?skip: *[^0 ]", header, re.MULTILINE
    ):
        return None
    data = re.search(r"^data ?file: *(.*?)\s*$", header, re.MULTILINE)
    if data is None:
        return _Voxels(name, len(header), True, count)
    if data[1].startswith("LIST") or "%" in data[1]:
        return None
    return _Voxels(os.path.join(os.path.dirname(name), data[1]), 0, True, count)


def _header(name: str, end: bytes) -> str:
    """A header of text, up to and with a line that matches; the whole file if none does."""
    with open(name, "rb") as file:
        start = file.read(CHUNK)
    found = re.search(end, start, re.MULTILINE)
    return start[: found.end() if found else len(start)].decode("latin-1")


def _require_stream(name: str, file: BinaryIO, wanted: int) -> None:
    """Inflates to the end, of several gzip members one after the other, a part at a time."""
    found = 0
    inflating = zlib.decompressobj(zlib.MAX_WBITS + 32)
    packed = file.read(CHUNK)
    while packed:
        try:
            found += len(inflating.decompress(packed, CHUNK))
        except zlib.error:
            break
        packed = inflating.unconsumed_tail or inflating.unused_data or file.read(CHUNK)
        if inflating.eof and found >= wanted:
            return
        if inflating.eof and not packed:
            raise _incomplete(name, "it holds fewer voxels than its header says")
        if inflating.eof:
            inflating = zlib.decompressobj(zlib.MAX_WBITS + 32)
    raise _incomplete(name, "its compressed stream breaks off or fails its checksum")


def _incomplete(name: str, what: str) -> FileError:
    return FileError(
        f"The voxels of '{name}' cannot be read: {what}. The file is truncated or damaged. Download "
        "or copy it again."
    )
