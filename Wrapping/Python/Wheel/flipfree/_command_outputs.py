"""The files that subcommands write: checked before the work is done, then written, all or none."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from ._atomic import replacing, write_table, write_text
from ._dicom import may_hold_series
from ._errors import FileError
from ._files import write_image
from ._image import Image
from ._image_files import WRITE_ENDINGS
from ._messages import listed
from ._options import WrongUsage
from ._point_files import ENDINGS as POINT_ENDINGS
from ._questions import COLUMNS
from ._segmentation import Segmentation, Vessel
from ._session_record import OriginNames, named, session_text
from ._surface_files import ENDINGS, write_centerline, write_surface
from ._unreadable import unreadable

# Of vessels, in the order of the options, and what they may end on.
TRACE_OUTPUTS = {
    "output": ENDINGS,
    "labels": WRITE_ENDINGS,
    "centerline": (".vtp",),
    "convergence": (".csv",),
    "snapshot": (".png",),
    "save_session": (".json",),
    "save_points": POINT_ENDINGS,
}
# Of organs.
OUTPUTS = {
    **{name: TRACE_OUTPUTS[name] for name in ("output", "labels", "convergence")},
    "questions": (".csv",),
    **{name: TRACE_OUTPUTS[name] for name in ("snapshot", "save_session", "save_points")},
}
# Of all organs of a session, one each.
SHARED = ("labels", "save_session")
# Options of files that no output replaces.
STROKES = ("inside_stroke", "outside_stroke")


def require_outputs(
    outputs: dict[str, str], endings: dict[str, tuple[str, ...]] = OUTPUTS
) -> None:
    """There are some, of endings that can be written, each with a name of its own."""
    options = {name: f"--{name.replace('_', '-')}" for name in endings}
    if not set(outputs) - {"save_points"}:
        results = [option for name, option in options.items() if name != "save_points"]
        raise WrongUsage(f"No output is requested. Give at least one of {listed(results)}")
    places: dict[str, str] = {}
    for name, path in outputs.items():
        require_ending(options[name], path, endings[name])
        other = places.setdefault(os.path.realpath(path), options[name])
        if other != options[name]:
            raise WrongUsage(
                f"{other} and {options[name]} name the same file, '{path}'. Give each one of its own"
            )


def require_files(values: dict[str, Any], outputs: dict[str, str]) -> None:
    """The input is there, and the outputs can be written."""
    for name, path in outputs.items():
        # Points may take the place of those that were given.
        others = ("input", "start_labels", "session", *(() if name == "save_points" else ("points",)))
        inputs = [values[other] for other in others if other in values]
        require_place(path, [*inputs, *strokes_of(values)])
    if not os.path.exists(values["input"]):
        raise unreadable(values["input"])
    if "series" in values and not may_hold_series(values["input"]):
        raise WrongUsage(
            f"--series selects a series of a DICOM folder, but '{values['input']}' is a file. Omit the "
            "option, or give the folder"
        )
    if "start_label" in values and "start_labels" not in values:
        raise WrongUsage("--start-label selects a value of --start-labels. Give that file, too")
    if "snapshot" in outputs:
        from ._picture import require_matplotlib

        require_matplotlib()


def strokes_of(values: dict[str, Any]) -> list[str]:
    """The files of strokes."""
    return [path for option in STROKES for path in values.get(option, ())]


def require_ending(option: str, name: str, endings: tuple[str, ...]) -> None:
    """A file of that name can be written, or read."""
    if not name.lower().endswith(endings):
        raise WrongUsage(
            f"{option}: the file extension of '{name}' is not supported. Use "
            f"{listed(endings, 'or')}"
        )


def require_place(path: str, inputs: list[str]) -> None:
    """A file can be put there, and no input is there."""
    if any(os.path.realpath(path) == os.path.realpath(name) for name in inputs):
        raise WrongUsage(
            f"'{path}' is an input, which would be overwritten. Give the result another name"
        )
    folder = os.path.dirname(os.path.realpath(path))
    if os.path.exists(folder) and not os.path.isdir(folder):
        raise FileError(f"'{path}' cannot be written: '{folder}' is not a folder. Write elsewhere.")
    if os.path.exists(path) and not os.path.isfile(path):
        raise FileError(f"'{path}' cannot be written: it is no regular file. Give another name.")
    if not os.access(folder, os.W_OK):
        raise FileError(
            f"'{path}' cannot be written: its folder does not exist or is not writable. Write elsewhere."
        )


def write_to(files: contextlib.ExitStack, path: str, write: Callable[[str], None]) -> None:
    """Writes under another name, which becomes the path's when `files` ends."""
    temporary = files.enter_context(replacing(path))
    try:
        write(temporary)
    except FileError as error:
        raise FileError(str(error).replace(temporary, path)) from error


def write_output(
    name: str, organ: Segmentation, image: Image, names: OriginNames, path: str
) -> None:
    """Writes the file that an option asks for."""
    provenance = named(organ.provenance, names)
    if name == "output":
        # The other formats have it without names: the same surface is the same bytes.
        is_vtp = path.lower().endswith(".vtp")
        write_surface(replace(organ.mesh, provenance=provenance) if is_vtp else organ, path)
    elif name == "save_session":
        write_text(path, session_text([provenance]))
    elif name == "labels":
        label = int(organ.label_map.voxels.max())
        write_image(organ.label_map, path, names={label: names.organs[0]})
    elif name == "centerline" and isinstance(organ, Vessel):
        write_centerline(organ, path)
    elif name == "convergence":
        columns = organ.iterations
        rows = zip(*(values.tolist() for values in columns.values()))
        write_table(path, list(columns), [list(row) for row in rows])
    elif name == "questions":
        write_table(path, list(COLUMNS), [question.row() for question in organ.questions])
    else:
        from ._picture import write_picture

        write_picture(path, image, organ)
