"""Runs the kernels so that failures are exceptions of the package and Ctrl-C works.

Between its parts, the work reports to Python; there signals are delivered, and what the caller's
progress function raises is kept until the work has ended.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from . import _kernels
from ._errors import FlipFreeError
from ._interrupt import Interrupt
from ._messages import escaped, with_names
from ._types import Progress


def run(
    work: Callable[[Callable[[float], bool]], Any],
    failure: type[FlipFreeError],
    wording: str,
    names: Mapping[str, str],
    progress: Progress | None = None,
) -> Any:
    """What `work` returns, which is given the function to report to.

    `wording` is the message of a failure, with {} for the kernels' own.
    """
    answer, message = None, ""
    with Interrupt() as interrupt:
        reporter = _Reporter(interrupt, progress)
        try:
            answer = work(reporter.report)
        except _kernels.Error as error:
            message = wording.format(error)
        except (ValueError, RuntimeError) as error:
            message = wording.format(escaped(str(error)))
    if reporter.exception is not None:
        raise reporter.exception
    if message:
        raise failure(with_names(message, names))
    return answer


class _Reporter:
    def __init__(self, interrupt: Interrupt, progress: Progress | None) -> None:
        self.interrupt = interrupt
        self.progress = progress
        self.exception: BaseException | None = None

    def report(self, fraction: float) -> bool:
        """Takes the fraction done, and returns whether to go on."""
        try:
            self.interrupt.deliver()
            if self.progress is not None and self.exception is None:
                self.progress(fraction)
        except BaseException as exception:  # pylint: disable=broad-except
            self.exception = exception
        return self.exception is None
