"""Messages of the C++ code in the words of Python, and warnings at the line of who called."""

from __future__ import annotations

import math
import re
import sys
import warnings
from collections.abc import Iterable, Mapping
from contextvars import ContextVar

from ._errors import FlipFreeWarning


# How the caller spells keywords, if not as in Python: the command has options.
spelling: ContextVar[Mapping[str, str]] = ContextVar("spelling", default={})

# Apostrophes are within a word or at its end.
_QUOTED = r"(?<!\w)'.*?'(?!\w)"


def warn(text: str) -> None:
    """Issues a warning that points to the caller of the package."""
    warnings.warn(text, FlipFreeWarning, stacklevel=_level_of_caller())


def with_names(text: str, names: Mapping[str, str] | None) -> str:
    """Calls properties by the caller's arguments, and leaves out ports.

    What is quoted is the caller's, and stays as it is.

    >>> with_names("the image on port 0 ends here; raise Reach", {"Reach": "reach"})
    'the image ends here; raise reach'
    >>> with_names("the organ's Reach, as that of 'Reach', is too low", {"Reach": "reach"})
    "the organ's reach, as that of 'Reach', is too low"
    """
    if not names:
        return text
    options = spelling.get()
    spelled = {name: options.get(keyword, keyword) for name, keyword in names.items()}
    pattern = rf"({_QUOTED})|( on port \d\b| \(port \d\))|\b({'|'.join(spelled)})\b"
    return re.sub(
        pattern,
        lambda part: part[1] or ("" if part[2] else spelled[part[3]]),
        text,
        flags=re.DOTALL,
    )


def confidence_text(confidence: float) -> str:
    """With two digits, rounded down as in the warning of a low confidence.

    >>> confidence_text(0.8499)
    '0.84'
    """
    return f"{math.floor(100 * confidence) / 100:.2f}"


def listed(words: Iterable[str], joint: str = "and") -> str:
    """Words one after the other.

    >>> listed(["a", "b", "c"]), listed(["a", "b"], "or"), listed(["a"])
    ('a, b and c', 'a or b', 'a')
    """
    *first, last = words
    return f"{', '.join(first)} {joint} {last}" if first else last


def _level_of_caller() -> int:
    """The stack level of the first caller outside the package, as warnings.warn counts it."""
    level = 1
    frame = sys._getframe(1)  # pylint: disable=protected-access
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        frame = frame.f_back
        level += 1
    return level
