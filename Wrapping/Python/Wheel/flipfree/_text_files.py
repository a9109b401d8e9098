"""Files of text: tables, markups."""

from __future__ import annotations

from ._errors import FileError
from ._unreadable import unreadable


def read_text(path: str) -> str:
    """Without the mark that some programs put in front of UTF-8; raises FileError."""
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            text = file.read()
    except OSError as error:
        raise unreadable(path) from error
    except UnicodeDecodeError:
        text = "\0"
    if "\0" in text:
        raise FileError(f"'{path}' is not UTF-8 text. Save it as UTF-8.")
    return text
