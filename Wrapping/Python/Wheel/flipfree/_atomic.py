"""Files that are there as a whole or not at all."""

from __future__ import annotations

import csv
import io
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

from ._errors import FileError
from ._types import PathName


@contextmanager
def replacing(path: PathName) -> Iterator[str]:
    """Gives the name to write to; the file takes its place if the block ends without an error.

    The name has the ending of the path's. Raises FileError for what the operating system refuses.
    """
    name = os.fspath(path)
    # Of a symbolic link, what it leads to is replaced.
    target = os.path.realpath(name)
    try:
        folder = tempfile.mkdtemp(prefix=".flipfree-", dir=os.path.dirname(target))
    except OSError as error:
        raise _refusal(name, error) from error
    try:
        temporary = os.path.join(folder, os.path.basename(name))
        yield temporary
        with open(temporary, "rb+") as file:
            os.fsync(file.fileno())
        if os.path.isfile(target):
            shutil.copymode(target, temporary)
        os.replace(temporary, target)
    except FileError:
        raise
    except OSError as error:
        raise _refusal(name, error) from error
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def write_text(path: PathName, text: str) -> None:
    """Writes a text file as a whole."""
    with replacing(path) as temporary:
        with open(temporary, "w", encoding="utf-8", newline="") as file:
            file.write(text)


def write_table(path: PathName, columns: list[str], rows: list[list[Any]]) -> None:
    """Writes a table as CSV."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    write_text(path, text.getvalue())


def make_folder(path: str) -> None:
    """Creates a folder, unless there is one."""
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        raise FileError(
            f"The folder '{path}' cannot be created ({error.strerror}). Check the name and the "
            "permissions of its parent folder."
        ) from error


@contextmanager
def output_folder(path: str) -> Iterator[None]:
    """Creates a folder, unless there is one; a new one into which nothing comes goes again."""
    is_new = not os.path.isdir(path)
    make_folder(path)
    try:
        yield
    finally:
        if is_new:
            with suppress(OSError):  # which it is, unless the folder is empty
                os.rmdir(path)


def _refusal(name: str, error: OSError) -> FileError:
    return FileError(
        f"'{name}' cannot be written ({error.strerror or error}). Check that its folder exists, is "
        "writable and has free space."
    )
