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


def warn(text: str) -> None:
    """Issues a warning that points to the caller of the package."""
    warnings.warn(text, FlipFreeWarning, stacklevel=_level_of_caller())


def with_names(text: str, names: Mapping[str, str] | None) -> str:
    """Calls properties by the caller's arguments, and leaves out ports.

    >>> with_names("the image on port 0 ends here; raise Reach", {"Reach": "reach"})
    'the image ends here; raise reach'
    """
    if not names:
        return text
    options = spelling.get()
    spelled = {name: options.get(keyword, keyword) for name, keyword in names.items()}
    text = re.sub(r" on port \d\b| \(port \d\)", "", text)
    return re.sub(rf"\b({'|'.join(spelled)})\b", lambda name: spelled[name.group()], text)


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
