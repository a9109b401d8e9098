"""The bytes of a file, inflated where they are packed by gzip or zlib."""

from __future__ import annotations

import zlib
from typing import Any

from . import _kernels
from ._errors import FileError

CHUNK = 1 << 20


class InflatedFile:
    """Reads what stands from `offset` on; a context manager.

    `name` is the file's in messages: of the header that tells of the voxels.
    """

    def __init__(self, path: str, name: str, packed: bool, offset: int = 0) -> None:
        self.name = name
        self._file = open(path, "rb")
        self._file.seek(offset)
        self._inflating: Any = zlib.decompressobj(zlib.MAX_WBITS + 32) if packed else None
        self._packed = b""

    def __enter__(self) -> InflatedFile:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def read(self, size: int) -> bytes:
        """So many bytes, or fewer at the end."""
        if self._inflating is None:
            return self._file.read(size)
        parts = []
        while size > 0:
            part = self._inflate(size)
            if not part:
                break
            parts.append(part)
            size -= len(part)
        return b"".join(parts)

    def skip(self, size: int) -> None:
        """Past so many bytes."""
        while size > 0:
            part = len(self.read(min(size, CHUNK)))
            size = size - part if part else 0

    def skip_lines(self, lines: int) -> None:
        """Past the ends of so many lines, as they are stored; before anything is read."""
        while lines > 0:
            part = self._file.readline(CHUNK)
            if not part:
                break
            lines -= part.endswith(b"\n")

    def rest(self) -> bytes:
        """All that follows."""
        return self.read(1 << 62) if self._inflating is not None else self._file.read()

    def require_end(self) -> None:
        """Raises FileError unless the stream, or the part that has been begun, is whole."""
        while self._inflating is not None and not self._inflating.eof:
            if not self._inflate(CHUNK) and not self._inflating.eof:
                raise self.broken()

    def broken(self) -> FileError:
        return FileError(_kernels.broken_stream(self.name))

    def _inflate(self, size: int) -> bytes:
        """Some bytes; none at the end. Of several gzip members, one after the other.

        What stands behind a member and is none is padding.
        """
        while True:
            if not self._packed:
                self._packed = self._file.read(CHUNK)
            if self._inflating.eof:
                if len(self._packed) < len(_kernels.PACKED_MARK):
                    self._packed += self._file.read(CHUNK)
                if not self._packed.startswith(_kernels.PACKED_MARK):
                    return b""
                self._inflating = zlib.decompressobj(zlib.MAX_WBITS + 32)
            ended = not self._packed
            try:
                part: bytes = self._inflating.decompress(self._packed, min(size, CHUNK))
            except zlib.error:
                raise self.broken() from None
            self._packed = self._inflating.unconsumed_tail or self._inflating.unused_data
            if part or ended or (self._inflating.eof and not self._packed):
                return part


def is_packed(path: str) -> bool:
    """Whether the file begins with the mark of gzip."""
    with open(path, "rb") as file:
        return bool(file.read(2) == _kernels.PACKED_MARK)
