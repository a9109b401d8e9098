"""The options of the command, from the toolkit's table: both commands have the same, with the same words but for OURS."""

from __future__ import annotations

import argparse
import re
from collections.abc import Mapping
from typing import Any, NoReturn

from . import _kernels
from ._parameters import Parameter

Entry = Mapping[str, Any]

COLUMN = 30
MOST_THREADS = 1024
# Of values that are not the keywords of a function.
INTEGERS = {"N", "I", "J", "K", "NX", "NY", "NZ"}
TEXTS = {"FILE", "DIR", "UID", "NAME", "ADDRESS", "TABLE", "FORMAT"}

# Of the toolkit's help, what is not true of this command, and what is.
OURS = {
    "it needs a\ndisplay (or xvfb-run -a).": "it needs\nmatplotlib, which the extra plot installs, and no display.",
}

COHORT: Entry = {
    "name": "cohort",
    "description": "Segment the organs and vessels of many volumes, several at a time",
    "footer": "TABLE is a CSV file with a row per organ or vessel. Its columns: volume (a file or a DICOM\n"
    "folder) and, where the folder holds several, series (as 'flipfree series' lists them); of an organ\n"
    "seed_x, seed_y, seed_z and radius in LPS millimeters, and if wanted inside, outside and boundary\n"
    "(points: 1 2 3; 4 5 6) and corrections (a file of points, .csv or .mrk.json); of a vessel points (a\n"
    "list or a file) in place of these; if wanted, case and organ (names), reference and reference_label\n"
    "(a label map to compare with), and any parameter of flipfree.segment or flipfree.trace. Files are\n"
    "found from the table's folder. In DIR there are then cohort.csv, cohort.parquet, report.html and a\n"
    "folder with files for each row. The same command again does only what is missing or has changed.\n"
    "\n"
    "Examples:\n"
    "  flipfree cohort livers.csv -o results\n"
    "  flipfree cohort livers.csv -o results --scheduler tcp://10.0.0.5:8786\n",
    "positionals": [
        {"names": [], "values": ["TABLE"], "choices": [], "description": "Rows to segment (.csv)",
         "default": "", "group": "Options", "required": True},
    ],
    "options": [
        {"names": names, "values": values, "choices": [], "description": description,
         "default": default, "group": "Options", "required": default == "required"}
        for names, values, description, default in (
            (["-h", "--help"], [], "Print this help message and exit", ""),
            (["-o", "--output"], ["DIR"], "Folder of the results; created if absent", "required"),
            (["--scheduler"], ["ADDRESS"], "Dask scheduler to use; by default, workers are started here",
             ""),
            (["--workers"], ["N"], "Number of workers to start; 0: as many as processors and memory allow",
             "0"),
            (["--threads"], ["N"], "Number of threads of each worker", "1"),
            (["-q", "--quiet"], [], "Print nothing but errors and warnings", ""),
        )
    ],
}


class WrongUsage(Exception):
    """The command line is wrong; found before any work is done."""


class Parser(argparse.ArgumentParser):
    """Messages as those of the toolkit's command."""

    def error(self, message: str) -> NoReturn:
        text = re.sub(r"^argument (\S+?)(?:/\S+)?: ", r"\1: ", message)
        raise WrongUsage(text[0].upper() + text[1:])


class Repeated(argparse.Action):
    """An option that can be repeated: a list of its values.

    `order` has names and values of all such options as they came.
    """

    def __call__(self, parser: Any, namespace: Any, values: Any, option_string: Any = None) -> None:
        setattr(namespace, self.dest, [*getattr(namespace, self.dest, ()), values])
        namespace.order = [*getattr(namespace, "order", ()), (self.dest, values)]


def table() -> list[Entry]:
    """The program and its subcommands."""
    entries = _kernels.commands()
    for entry in entries:
        for theirs, ours in OURS.items():
            entry["footer"] = entry["footer"].replace(theirs, ours)
    return [*entries, COHORT]


def parser_of(entry: Entry, parameters: Mapping[str, Parameter]) -> Parser:
    """A parser of a subcommand; options that are not given are not in its answer."""
    parser = Parser(
        prog=f"flipfree {entry['name']}",
        add_help=False,
        allow_abbrev=False,
        argument_default=argparse.SUPPRESS,
    )
    # Also 1e-3 and the like are negative numbers rather than options.
    parser._negative_number_matcher = re.compile(r"^-(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")
    for positional in entry["positionals"]:
        name = positional["values"][0]
        parser.add_argument(name.lower(), metavar=name, nargs=None if positional["required"] else "?")
    for option in entry["options"]:
        _add(parser, option, parameters)
    return parser


def destination(option: Entry) -> str:
    """The keyword of a parameter, or what else an option's value is called."""
    names = [name for name in option["names"] if not name.startswith("--no-")]
    return str(names[-1]).lstrip("-").replace("-", "_")


def is_label(text: str) -> bool:
    """Whether a text can choose a label: whatever is not a number other than a value."""
    try:
        float(text)
    except ValueError:
        return bool(text)
    return text.isascii() and text.isdigit() and int(text) < 2**31


def _label(text: str) -> str:
    if not is_label(text):
        raise argparse.ArgumentTypeError(
            f"'{text}' is no label: give a segment's name, or a whole number from 0 on"
        )
    return text


def _threads(text: str) -> int:
    number = int(text)
    if not 0 <= number <= MOST_THREADS:
        raise argparse.ArgumentTypeError(f"{number} is out of range. Give 0 to {MOST_THREADS}")
    return number


def _add(parser: Parser, option: Entry, parameters: Mapping[str, Parameter]) -> None:
    name = destination(option)
    on = [spelled for spelled in option["names"] if not spelled.startswith("--no-")]
    off = [spelled for spelled in option["names"] if spelled.startswith("--no-")]
    if not option["values"]:
        parser.add_argument(*on, dest=name, action="store_const", const=True)
        if off:
            parser.add_argument(*off, dest=name, action="store_const", const=False)
        return
    unit = option["values"][0]
    known = parameters[name].type if name in parameters else None
    kind: Any = float
    if name == "threads":
        kind = _threads
    elif known is int or (known is None and unit in INTEGERS):
        kind = int
    elif known is None and unit in TEXTS:
        kind = str
    elif unit == "LABEL":
        kind = _label
    count = len(option["values"])
    parser.add_argument(
        *on,
        dest=name,
        action=Repeated if option.get("repeats") else "store",
        type=kind,
        nargs=count if count > 1 else None,
        choices=option["choices"] or None,
        required=option["required"],
    )


def help_of(entry: Entry, commands: list[Entry]) -> str:
    """What --help prints."""
    is_program = entry["name"] == "flipfree"
    positionals = " ".join(
        positional["values"][0] if positional["required"] else f"[{positional['values'][0]}]"
        for positional in entry["positionals"]
    )
    usage = "[OPTIONS] SUBCOMMAND" if is_program else f"{entry['name']} [OPTIONS] {positionals}"
    parts = [f"{entry['description']}\nUsage: flipfree {usage}\n"]
    if entry["positionals"]:
        parts.append(_group("Positionals", entry["positionals"]))
    groups = [
        _group(name, [option for option in entry["options"] if option["group"] == name])
        for name in dict.fromkeys(option["group"] for option in entry["options"])
    ]
    if is_program:
        lines = [_line(command["name"], command["description"]) for command in commands[1:]]
        groups.append("Subcommands:\n" + "".join(lines))
    parts.append("\n\n".join(groups))
    return "\n".join([*parts, entry["footer"]])


def _group(name: str, options: list[Entry]) -> str:
    lines = []
    for option in options:
        names = ",".join(option["names"])
        left = " ".join([names, *option["values"]]).strip()
        text = option["description"]
        if option["default"] and not option["required"]:
            text += f" [{option['default']}]"
        if option["required"] and option["names"]:
            text += " (required)"
        lines.append(_line(left, text))
    return f"{name}:\n" + "".join(lines)


def _line(left: str, text: str) -> str:
    wrapped, length = "", 0
    for word in text.split():
        if wrapped:
            wrapped += "\n" if length + len(word) > 100 - COLUMN else " "
            length = 0 if wrapped.endswith("\n") else length
        wrapped += word
        length += len(word) + 1
    left = f"  {left}".ljust(COLUMN)
    first = left if len(left) <= COLUMN and left.endswith(" ") else left + "\n" + " " * COLUMN
    return first + wrapped.replace("\n", "\n" + " " * COLUMN) + "\n"
