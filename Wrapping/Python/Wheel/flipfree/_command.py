"""The command `flipfree` of the package that pip installs: segment, trace, surfaces, evaluate, series, phantom,
cohort."""

from __future__ import annotations

import difflib
import os
import select
import signal
import sys
import warnings
from collections.abc import Callable, Sequence
from typing import Any

from . import _commands
from ._backend import SEGMENT_PARAMETERS, SURFACES_PARAMETERS, TRACE_PARAMETERS
from ._errors import FlipFreeError, FlipFreeWarning
from ._messages import spelling
from ._options import Entry, WrongUsage, destination, help_of, parser_of, table

PARAMETERS = {
    "segment": SEGMENT_PARAMETERS,
    "surfaces": SURFACES_PARAMETERS,
    "trace": TRACE_PARAMETERS,
}
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
            _run(words)
            sys.stdout.flush()
        except WrongUsage as error:
            _complain("error", f"{_sentence(str(error))} See '{_help_for(words)}'.")
            status = WRONG_USAGE
        except FlipFreeError as error:
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


def _run(words: list[str]) -> None:
    commands = table()
    if words and words[0] in ("-h", "--help", "--version"):
        from . import __version__

        print(f"flipfree {__version__}" if words[0] == "--version" else help_of(commands[0], commands))
        return
    if not words:
        raise WrongUsage("A subcommand is required")
    entry = next((entry for entry in commands[1:] if entry["name"] == words[0]), None)
    if entry is None:
        kind = "option" if words[0].startswith("-") else "subcommand"
        near = _suggestion(words[0], [str(entry["name"]) for entry in commands[1:]])
        raise WrongUsage(f"There is no {kind} '{words[0]}'{near}")
    if "-h" in words or "--help" in words:
        print(help_of(entry, commands))
        return
    parser = parser_of(entry, PARAMETERS.get(entry["name"], {}))
    values, unknown = parser.parse_known_args(words[1:])
    if unknown:
        option = next((word for word in unknown if word.startswith("-")), None)
        if option is None:
            raise WrongUsage(f"Unexpected argument '{unknown[0]}'")
        known = [name for one in entry["options"] for name in one["names"] if name.startswith("--")]
        raise WrongUsage(f"There is no option '{option}'{_suggestion(option.partition('=')[0], known)}")
    _do(entry, vars(values))


def _do(entry: Entry, values: dict[str, Any]) -> None:
    """Runs a subcommand; messages call keywords by the options that stand for them."""
    names = {destination(option): option["names"] for option in entry["options"]}
    options = {name: next(o for o in spelled if o.startswith("--")) for name, spelled in names.items()}
    run: Callable[[dict[str, Any]], None] = getattr(_commands, entry["name"])
    lps = {kind: f"an {kind} point in LPS at" for kind in ("inside", "outside")}
    token = spelling.set({**options, **(lps if "ras" in values else {})})
    try:
        run(values)
    except (TypeError, ValueError) as error:
        name, separator, rest = str(error).partition(": ")
        if name not in options:
            raise FlipFreeError(str(error)) from error
        raise WrongUsage(f"{options[name]}{separator}{rest}") from error
    finally:
        spelling.reset(token)


def _suggestion(word: str, known: list[str]) -> str:
    """What may have been meant, as a sentence after another; empty if nothing is near."""
    near = difflib.get_close_matches(word, known, n=1)
    return f". Did you mean '{near[0]}'?" if near else ""


def _help_for(words: list[str]) -> str:
    known = [entry["name"] for entry in table()[1:]]
    return "flipfree " + (f"{words[0]} " if words and words[0] in known else "") + "--help"


def _sentence(text: str) -> str:
    text = " ".join(text.split())
    return text if text.endswith((".", "?")) else text + "."


def _complain(kind: str, text: str) -> None:
    print(f"flipfree: {kind}: {text}", file=sys.stderr, flush=True)


def _show_warning(message: Warning | str, *_: Any) -> None:
    _complain("warning", _sentence(str(message)))
