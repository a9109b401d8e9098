"""Progress as the caller wants it: told to a function, drawn as a bar, or not at all."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from ._types import Progress, ProgressOption

WIDTH = 32


@contextmanager
def progress_of(option: ProgressOption, title: str) -> Iterator[Progress | None]:
    """What to tell fractions from 0 to 1; a bar is taken away at the end, whatever happened."""
    if callable(option):
        yield option
    elif option is True:
        bar = Bar(title)
        try:
            yield bar
        finally:
            bar.clear()
    elif option is None or option is False:
        yield None
    else:
        raise TypeError(f"progress: a function, True for a bar, or None, not {option!r}")


class Bar:
    """A line on the terminal that is drawn again whenever its percentage changes.

    >>> Bar.line("segmenting", 0.5)
    'segmenting    [################................]  50 %'
    """

    def __init__(self, title: str) -> None:
        self.title = title
        self.shown = ""

    def __call__(self, fraction: float) -> None:
        line = self.line(self.title, fraction)
        if line != self.shown:
            self._write("\r" + line)
            self.shown = line

    def clear(self) -> None:
        """Leaves the line empty, for what is printed next."""
        if self.shown:
            self._write("\r" + " " * len(self.shown) + "\r")

    @staticmethod
    def line(title: str, fraction: float) -> str:
        """The bar as text."""
        part = min(max(fraction, 0.0), 1.0)
        full = int(part * WIDTH)
        return f"{title:<14}[{'#' * full:.<{WIDTH}}] {int(100 * part):3d} %"

    @staticmethod
    def _write(text: str) -> None:
        if sys.stderr is not None:  # there is none under pythonw
            sys.stderr.write(text)
            sys.stderr.flush()
