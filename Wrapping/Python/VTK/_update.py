"""Updates VTK algorithms so that failures are exceptions and Ctrl-C works.

VTK calls observers from C++, which no exception can cross: one that leaves an observer is printed
and forgotten, and a KeyboardInterrupt ends the whole interpreter. So the observers here catch
every exception and abort the algorithm; the exception is raised again after its return.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from vtkmodules.vtkCommonCore import vtkInformationKeyLookup, vtkObject
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonMisc import vtkErrorCode

from ._errors import FlipFreeError
from ._interrupt import Interrupt
from ._messages import escaped, warn, with_names
from ._types import Progress


def update(
    algorithm: vtkAlgorithm,
    failure: type[FlipFreeError] = FlipFreeError,
    progress: Progress | None = None,
    run: Callable[[], Any] | None = None,
    names: Mapping[str, str] | None = None,
) -> None:
    """Updates a filter, and raises `failure` with VTK's message if it reports an error.

    VTK does not run a filter again that has not changed; one that has failed then fails again.

    For filters that are connected by hand. Only this filter is observed: in a pipeline, update each
    filter that may fail. `run` is called instead of Update(), if given. `names` maps properties to
    the arguments that set them, for use in messages; these then leave out ports.

    Progress is called with fractions from 0 to 1. An exception that it raises aborts the algorithm
    and is raised again, as is the KeyboardInterrupt of Ctrl-C, or whatever the program's own signal
    handler raises.

    >>> import flipfree
    >>> sphere = flipfree.vtkQuadSphereSource()
    >>> sphere.SetCenter(0, 0, float("nan"))
    >>> flipfree.update(sphere)
    Traceback (most recent call last):
      ...
    flipfree.FlipFreeError: ...
    """
    with _messages_on(), Interrupt() as interrupt, _Listener(
        algorithm, progress, interrupt
    ) as listener:
        (run or algorithm.Update)()
    if listener.exception is not None:
        raise listener.exception
    for text in listener.warnings:
        warn(with_names(text, names or {}))
    # The pipeline only reports that its algorithm failed.
    errors = listener.errors + listener.pipeline_errors
    if errors:
        raise failure(with_names(errors[0], names or {}))
    if algorithm.GetErrorCode() >= vtkErrorCode.UserError:
        raise failure(
            f"{algorithm.GetClassName()} failed in an earlier update and has not run again: nothing "
            "has changed, or a filter before it has failed; call Modified() to see its error again."
        )


class _Listener:
    """Observes an algorithm and its pipeline: progress, errors and warnings."""

    def __init__(
        self, algorithm: vtkAlgorithm, progress: Progress | None, interrupt: Interrupt
    ) -> None:
        self.algorithm = algorithm
        self.progress = progress
        self.interrupt = interrupt
        self.exception: BaseException | None = None
        self.errors: list[str] = []
        self.pipeline_errors: list[str] = []
        self.warnings: list[str] = []
        self._tags: list[tuple[vtkObject, int]] = []

    def __enter__(self) -> _Listener:
        executive = self.algorithm.GetExecutive()
        self._observe(self.algorithm, "ProgressEvent", self._on_progress)
        self._observe(self.algorithm, "ErrorEvent", _keeper_of_messages(self.errors))
        self._observe(self.algorithm, "WarningEvent", _keeper_of_messages(self.warnings))
        self._observe(executive, "ErrorEvent", _keeper_of_messages(self.pipeline_errors))
        self._observe(executive, "WarningEvent", _keeper_of_messages(self.warnings))
        return self

    def __exit__(self, *_: object) -> None:
        for observed, tag in self._tags:
            observed.RemoveObserver(tag)
        self.algorithm.AbortExecuteOff()

    def _observe(self, observed: vtkObject, event: str, call: Callable[..., None]) -> None:
        self._tags.append((observed, observed.AddObserver(event, call)))

    def _on_progress(self, algorithm: vtkAlgorithm, _event: str) -> None:
        try:
            self.interrupt.deliver()
            if self.progress is not None and self.exception is None:
                self.progress(algorithm.GetProgress())
        except BaseException as exception:  # pylint: disable=broad-except
            self.exception = exception
        if self.exception is not None:
            # Each time, because the pipeline forgets an abort before its start.
            algorithm.AbortExecuteOn()


def _keeper_of_messages(messages: list[str]) -> Callable[..., None]:
    def keep(observed: vtkObject, _event: str, text: str) -> None:
        messages.append(_message_of(observed) or escaped(_message_in(text)))

    keep.CallDataType = "string0"  # type: ignore[attr-defined]  # makes VTK pass the text
    return keep


def _message_of(observed: vtkObject) -> str | None:
    """What one of FlipFree's filters is reporting, with quantities in braces; None for others."""
    key = vtkInformationKeyLookup.Find("MESSAGE", "FlipFree")
    if key is None or not isinstance(observed, vtkAlgorithm):
        return None
    message: str | None = observed.GetInformation().Get(key)
    return message


def _message_in(text: str) -> str:
    """Without the source file and the object's address, which VTK puts in front.

    >>> _message_in("ERROR: In vtkReader.cxx, line 7\\nvtkReader (0x2a): No file: (none).\\n\\n")
    'No file: (none).'
    """
    return re.sub(r"\A\w+: In .*, line \d+\n\w+ \(\w+\): ", "", text).strip()


@contextmanager
def _messages_on() -> Iterator[None]:
    """If warnings are switched off globally, VTK reports no errors, either."""
    before = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOn()
    try:
        yield
    finally:
        vtkObject.SetGlobalWarningDisplay(before)
