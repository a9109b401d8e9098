"""Files that are there as a whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from typing import Any

from . import _kernels
from ._errors import FileError
from ._types import PathName


@contextmanager
def replacing(path: PathName) -> Iterator[str]:
    """Gives the name to write to; the file takes its place if the block ends without an error.

    The name has the ending of the path's. Raises FileError for what the operating system refuses.
    """
    name = os.fspath(path)
    try:
        file = _kernels.AtomicFile(name)
        try:
            yield file.temporary_name
            file.flush()
            file.publish()
        finally:
            file.discard()
    except _kernels.NotWritten as error:
        raise FileError(str(error)) from None
    except FileError:
        raise
    except OSError as error:
        reason = error.strerror or error
        raise FileError(
            f"'{name}' cannot be written: {reason}. Free some disk space, or write elsewhere."
        ) from error


def write_to(files: ExitStack, path: str, write: Callable[[str], None]) -> None:
    """Writes under another name, which becomes the path's when `files` ends."""
    temporary = files.enter_context(replacing(path))
    try:
        write(temporary)
    except FileError as error:
        raise FileError(str(error).replace(temporary, path)) from error


def write_text(path: PathName, text: str) -> None:
    """Writes a text file as a whole."""
    with replacing(path) as temporary:
        with open(temporary, "w", encoding="utf-8", newline="") as file:
            file.write(text)


def write_table(path: PathName, columns: list[str], rows: list[list[Any]]) -> None:
    """Writes a table as CSV; None leaves a cell empty."""
    cells = [["" if cell is None else cell for cell in row] for row in rows]
    write_text(path, _kernels.table_text(columns, cells))


def make_folder(path: str) -> None:
    """Creates a folder, unless there is one."""
    _make(partial(os.makedirs, exist_ok=True), path)


def _make(make: Callable[[str], None], path: str) -> None:
    try:
        make(path)
    except OSError as error:
        if os.path.exists(path) and not os.path.isdir(path):
            raise FileError(f"'{path}' is not a folder. Choose another name.") from error
        raise FileError(
            f"The folder '{path}' cannot be created ({error.strerror}). Check the name and the "
            "permissions of its parent folder."
        ) from error


@contextmanager
def output_folder(path: str) -> Iterator[None]:
    """Creates a folder in one that there is, unless it is there; a new one into which nothing comes goes again."""
    is_new = not os.path.isdir(path)
    if is_new:
        _make(os.mkdir, path)
    try:
        yield
    finally:
        if is_new:
            with suppress(OSError):  # which it is, unless the folder is empty
                os.rmdir(path)
