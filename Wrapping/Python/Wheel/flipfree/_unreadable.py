"""What the user reads where a file does not open, whatever it was to hold."""

from __future__ import annotations

import os

from ._errors import FileError


def unreadable(path: str) -> FileError:
    if os.path.exists(path):
        return FileError(f"'{path}' cannot be read. Check the name and the permissions.")
    return FileError(f"There is no file '{path}'. Check the name and the folder.")
