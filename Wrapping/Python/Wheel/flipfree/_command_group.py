"""`flipfree segment` with several organs, which are segmented together."""

from __future__ import annotations

import contextlib
import math
import time
from functools import partial
from typing import Any

from ._backend import GROUP_PARAMETERS, set_threads
from ._command_inputs import lps
from ._command_outputs import (
    OUTPUTS,
    SHARED,
    require_ending,
    require_files,
    require_outputs,
    require_place,
    write_output,
    write_text,
    write_to,
)
from ._errors import FlipFreeError
from ._files import read_image, write_image
from ._messages import confidence_text
from ._options import WrongUsage
from ._segment import default_parameters
from ._segment_organs import segment_organs
from ._session import Session, file_beside, name_for, require_image_of
from ._session_record import OriginNames, named, session_text
from ._surface_files import ENDINGS, read_surface


def segment_group(
    values: dict[str, Any],
    organs: dict[str, dict[str, Any]],
    colors: dict[str, str],
    session: Session | None,
    progress: bool,
) -> None:
    """`flipfree segment --organ`."""
    outputs = {}
    for organ in organs:
        for name in OUTPUTS.keys() & values.keys() - set(SHARED):
            outputs[organ, name] = name_for(_file_name(organ), values[name])
    given = {name: values[name] for name in OUTPUTS if name in values}
    require_outputs(given)
    shared = {name: path for name, path in given.items() if name in SHARED}
    for path in (*outputs.values(), *shared.values()):
        require_place(path, [values["input"], *values.get("fixed", ())])
    require_files(values, shared)
    names = OriginNames(
        values["input"],
        fixed=values.get("fixed", ()),
        organs=list(organs),
        colors=[colors.get(name, "") for name in organs],
    )
    parameters = {**default_parameters(values.get("preset", "default")), **values}
    set_threads(values.get("threads", 0))
    start = time.perf_counter()
    fixed = [read_surface(name) for name in values.get("fixed", ())]
    image = read_image(values["input"], series=values.get("series"), progress=progress)
    reading = time.perf_counter() - start
    if session:
        require_image_of(session, values["input"], image)
    try:
        found = segment_organs(
            image,
            organs,
            fixed=fixed,
            progress=progress or None,
            **{name: value for name, value in parameters.items() if name in GROUP_PARAMETERS},
        )
    except FlipFreeError as error:
        raise type(error)(f"'{values['input']}': {error}") from error
    working = time.perf_counter() - start - reading
    with contextlib.ExitStack() as files:  # either all files or none
        for organ, result in found.items():
            if result.stop_reason == "no boundary found":
                raise FlipFreeError(
                    f"'{values['input']}', {organ}: no boundary of the organ was found, so nothing is "
                    "written."
                )
        for (name, output), path in outputs.items():
            write_to(files, path, partial(write_output, output, found[name], image, names))
        if "labels" in values:
            shades = {found.label_of(name): color for name, color in colors.items()}
            write_to(
                files,
                values["labels"],
                lambda name: write_image(found.label_map, name, colors=shades),
            )
        if "save_session" in values:
            text = session_text([named(next(iter(found.values())).provenance, names)])
            write_to(files, values["save_session"], partial(write_text, text))
    if "quiet" not in values:
        for organ, result in found.items():
            print(
                f"{values['input']}, {organ}: label {found.label_of(organ)}, volume {result.volume:.1f} "
                f"ml, {len(result.iterations['Iteration'])} iterations, {result.stop_reason}, "
                f"{result.self_intersections} self-intersections, "
                f"confidence {confidence_text(result.confidence)}"
            )
        print(
            f"{values['input']}: organs do not meet; reading {reading:.2f} s, segmenting "
            f"{working:.2f} s"
        )


def segment_together(session: Session, values: dict[str, Any], progress: bool) -> None:
    """`flipfree segment --session` of organs that were segmented together."""
    first = session.organs[0]
    organs = {
        organ.title: {"seed": organ.seed, "radius": organ.radius, **organ.corrections}
        for organ in session.organs
    }
    fixed = [file_beside(session, name, "The fixed surface") for name in session.fixed]
    colors = {organ.title: organ.color for organ in session.organs}
    values = {"preset": first.preset, **first.parameters, **values, "fixed": fixed}
    segment_group(values, organs, colors, session, progress)


def organs_of(values: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Seeds and points by the names of the organs; points belong to the organ before them."""
    if "organ" not in values:
        raise WrongUsage("--fixed is for organs that are given by --organ. Give one or more")
    if {"seed", "seed_voxel", "radius", "session", "start_labels"} & values.keys():
        raise WrongUsage(
            "--organ has the seed. Leave out --seed, --seed-voxel, --radius, --session and "
            "--start-labels"
        )
    if {"points", "save_points"} & values.keys():
        raise WrongUsage(
            "--points and --save-points are for one organ. Give the points of several by --inside, "
            "--outside and --boundary, after the organ that they belong to"
        )
    if "input" not in values:
        raise WrongUsage("INPUT is required: a volume, or a folder of a DICOM series")
    for name in values.get("fixed", ()):
        require_ending("--fixed", name, ENDINGS)
    organs: dict[str, dict[str, Any]] = {}
    files: dict[str, str] = {}
    for option, given in values["order"]:
        if option == "organ":
            name, *numbers = given
            if not name:
                raise WrongUsage("--organ: a name is empty. Give each organ one of its own")
            other = files.setdefault(_file_name(name), name)
            if name in organs or other != name:
                raise WrongUsage(
                    f"--organ: '{other}' and '{name}' are the same in names of files. Give each organ "
                    "a name of its own"
                )
            x, y, z, radius = (_number_of(name, text) for text in numbers)
            if radius <= 0:
                raise WrongUsage(
                    f"--organ {name}: the radius must be a positive number of millimeters. The sphere "
                    "should lie within the organ"
                )
            organs[name] = {"seed": lps(values, [x, y, z]), "radius": radius}
        elif option in ("inside", "outside", "boundary"):
            if not organs:
                raise WrongUsage(
                    f"--{option}: the point comes before the first --organ. Give it after its own organ"
                )
            points = organs[next(reversed(organs))].setdefault(option, [])
            points.append(lps(values, given))
    return organs


def _number_of(organ: str, text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise WrongUsage(
            f"--organ {organ}: '{text}' is not a finite number. Give a name, the seed's center, and "
            "its radius: NAME X Y Z MM"
        )
    return number


def _file_name(organ: str) -> str:
    """As it can stand in names of files."""
    return "".join(c if c.isalnum() or not c.isascii() else "-" for c in organ)
