"""The command `flipfree` of the package that pip installs: segment, trace, surfaces, evaluate, series, phantom,
cohort.

Options, help, checks, sessions, files of points and what is printed are those of the toolkit's command, from the
same code (Wrapping/Command/Request), which is part of the extension. Here is what the subcommands do.
"""

from __future__ import annotations

import os
import select
import signal
import sys
import warnings
from collections.abc import Callable, Sequence
from typing import Any

from . import _kernels
from ._errors import FlipFreeError, FlipFreeWarning
from ._messages import spelling

SUCCESS, FAILURE, WRONG_USAGE, INTERRUPTED = 0, 1, 2, 130
NOBODY_READS = 128 + signal.SIGPIPE  # as shells say of the toolkit's, which the signal ends


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; gives its exit status."""
    _open_standard_streams()
    words = list(sys.argv[1:] if arguments is None else arguments)
    status = SUCCESS
    with warnings.catch_warnings():
        warnings.showwarning = _show_warning  # type: ignore[assignment]
        warnings.simplefilter("ignore")  # those of other packages
        warnings.simplefilter("always", FlipFreeWarning)
        try:
            say(_run(words))
        except _kernels.WrongUsage as error:
            _complain("error", str(error))
            status = WRONG_USAGE
        except (FlipFreeError, _kernels.Failure, _kernels.NotWritten) as error:
            _complain("error", _sentence(str(error)))
            status = FAILURE
        except MemoryError:
            _complain("error", "Out of memory. Crop the volume, or use a machine with more memory.")
            status = FAILURE
        except OSError as error:
            if isinstance(error, BrokenPipeError) and _nobody_reads():
                _discard_output()
                status = NOBODY_READS
            else:
                _complain("error", f"Writing failed ({error.strerror or error}).")
                status = FAILURE
        except KeyboardInterrupt:
            status = INTERRUPTED
    return status


def _open_standard_streams() -> None:
    """Those that the caller has closed (2>&-) lead nowhere; else files that are opened would take their places."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # the lowest number that is free
    if sys.stdout is None:
        sys.stdout = open(1, "w", encoding="utf-8", closefd=False)
    if sys.stderr is None:
        sys.stderr = open(2, "w", encoding="utf-8", closefd=False)


def say(text: str) -> None:
    """Prints it at once."""
    try:
        print(text, end="", flush=True)
    except BrokenPipeError:
        raise
    except OSError as error:
        _discard_output()
        raise FlipFreeError(
            f"Writing to the standard output failed ({error.strerror}). Check where it is redirected to."
        ) from error


def _nobody_reads() -> bool:
    """Whether a standard stream is a pipe that is broken; pipes of other files may be, too."""
    streams = select.poll()
    for number in (1, 2):
        streams.register(number, select.POLLOUT)
    return any(event & (select.POLLERR | select.POLLHUP) for _, event in streams.poll(0))


def _discard_output() -> None:
    """What is still to be written goes nowhere; else Python complains of it when it ends."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)


def _run(words: list[str]) -> str:
    """Does what is asked for; gives the text of --help or --version."""
    from . import __version__

    for word in words:
        if any("\ud800" <= letter <= "\udfff" for letter in word):  # as Python has bytes that are no text
            raise FlipFreeError(f"{ascii(word)} is not in UTF-8. Rename the file.")
    text, name, request = _kernels.parse(words, __version__)
    if name:
        _do(name, request)
    return str(text)


def _do(name: str, request: Any) -> None:
    """Runs a subcommand; messages call keywords by the options that stand for them."""
    from . import _subcommands

    run: Callable[[Any], None] = getattr(_subcommands, name)
    options = {**_kernels.spelling(name), "only": "--label"}
    lps = {kind: f"an {kind} point in LPS at" for kind in ("inside", "outside")}
    token = spelling.set({**options, **(lps if getattr(request, "is_ras", False) else {})})
    try:
        run(request)
    except (TypeError, ValueError) as error:
        keyword, separator, rest = str(error).partition(": ")
        if keyword not in options:
            raise FlipFreeError(str(error)) from error
        text = _sentence(f"{options[keyword]}{separator}{rest}")
        raise _kernels.WrongUsage(f"{text} See 'flipfree {name} --help'.") from error
    finally:
        spelling.reset(token)


def _sentence(text: str) -> str:
    text = " ".join(text.split())
    return text if text.endswith((".", "?")) else text + "."


def _complain(kind: str, text: str) -> None:
    print(f"flipfree: {kind}: {text}", file=sys.stderr, flush=True)


def _show_warning(message: Warning | str, *_: Any) -> None:
    _complain("warning", _sentence(str(message)))
