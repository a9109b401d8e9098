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


def with_names(message: str, names: Mapping[str, str]) -> str:
    """A message of the C++ code, which names quantities in braces, in the caller's words.

    Without names, the properties and the ports of VTK's filters are named.

    >>> with_names("the image{ on port 0} ends here; raise {Reach}", {"Reach": "reach"})
    'the image ends here; raise reach'
    >>> with_names("the image{ on port 0} ends here; raise {Reach}", {})
    'the image on port 0 ends here; raise Reach'
    >>> with_names("what encloses nothing, as { or {}, stays", {"Reach": "reach"})
    'what encloses nothing, as { or {}, stays'
    """
    options = spelling.get()

    def worded(part: re.Match[str]) -> str:
        quantity = part[1]
        if quantity is None:
            return part[0][0]
        if quantity.startswith(" "):  # a port
            return "" if names else quantity
        keyword = names.get(quantity, quantity)
        return options.get(keyword, keyword)

    return re.sub(r"\{\{|\}\}|\{([^{}]+)\}", worded, message)


def escaped(text: str) -> str:
    """A text to be part of a message: its braces doubled.

    >>> with_names(escaped("'{Reach}' stays"), {"Reach": "reach"})
    "'{Reach}' stays"
    """
    return text.replace("{", "{{").replace("}", "}}")


def counted(count: int, noun: str) -> str:
    """A number and what it counts.

    >>> counted(1, "iteration"), counted(0, "iteration")
    ('1 iteration', '0 iterations')
    """
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


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
