"""`flipfree segment` with several organs, which are segmented together."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Mapping
from functools import partial
from typing import Any

from ._atomic import write_text
from ._backend import GROUP_PARAMETERS, set_threads
from ._command_inputs import POINTS, input_title, lps, places_of_option, require_coordinates
from ._command_outputs import (
    OUTPUTS,
    SHARED,
    STROKES,
    require_ending,
    require_files,
    require_outputs,
    require_place,
    strokes_of,
    write_output,
    write_to,
)
from ._errors import FlipFreeError
from ._files import read_image, write_image
from ._image import Image
from ._messages import confidence_text
from ._options import WrongUsage
from ._segment import default_parameters
from ._segment_organs import SegmentedOrgans, segment_organs
from ._seed_radius import is_seed_radius, seed_radius_rule
from ._segmentation import Surface
from ._session import Session, file_beside, name_for, require_image_of
from ._session_record import OriginNames, file_name_of, named, session_text
from ._surface_files import ENDINGS, read_surface

# By name, what segment_organs() takes.
Organs = dict[str, dict[str, Any]]


def segment_group(
    values: dict[str, Any],
    organs: Organs,
    colors: Mapping[str, str],
    session: Session | None,
    progress: bool,
) -> None:
    """`flipfree segment --organ`."""
    outputs = _outputs_of(values, organs)
    parameters = {**default_parameters(values.get("preset", "default")), **values}
    set_threads(values.get("threads", 0))
    start = time.perf_counter()
    fixed = [read_surface(name) for name in values.get("fixed", ())]
    image = read_image(values["input"], series=values.get("series"), progress=progress)
    reading = time.perf_counter() - start
    if session:
        require_image_of(session, values["input"], image)
    values = {**values, "series": image.series}
    found = _found(image, organs, fixed, parameters, progress)
    working = time.perf_counter() - start - reading
    _write(values, found, image, outputs, colors)
    if "quiet" not in values:
        _report(input_title(values), found, reading, working)


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


def _outputs_of(values: dict[str, Any], organs: Organs) -> dict[tuple[str, str], str]:
    """Each organ's own files, by its name and the option; those of all organs are checked, too."""
    given = {name: values[name] for name in OUTPUTS if name in values}
    require_outputs(given)
    shared = {name: path for name, path in given.items() if name in SHARED}
    outputs = {
        (organ, name): name_for(file_name_of(organ), path)
        for organ in organs
        for name, path in given.items()
        if name not in SHARED
    }
    session = [values["session"]] if "session" in values else []
    inputs = [values["input"], *values.get("fixed", ()), *session, *strokes_of(values)]
    for path in (*outputs.values(), *shared.values()):
        require_place(path, inputs)
    require_files(values, shared)
    return outputs


def _found(
    image: Image,
    organs: Organs,
    fixed: list[Surface],
    parameters: dict[str, Any],
    progress: bool,
) -> SegmentedOrgans:
    keywords = {name: value for name, value in parameters.items() if name in GROUP_PARAMETERS}
    try:
        return segment_organs(image, organs, fixed=fixed, progress=progress or None, **keywords)
    except FlipFreeError as error:
        raise type(error)(f"'{parameters['input']}': {error}") from error


def _write(
    values: dict[str, Any],
    found: SegmentedOrgans,
    image: Image,
    outputs: dict[tuple[str, str], str],
    colors: Mapping[str, str],
) -> None:
    names = OriginNames(
        values["input"],
        values["series"],
        fixed=values.get("fixed", ()),
        organs=list(found),
        colors=[colors.get(organ, "") for organ in found],
    )
    with contextlib.ExitStack() as files:  # either all files or none
        for (organ, name), path in outputs.items():
            write_to(files, path, partial(write_output, name, found[organ], image, names))
        if "labels" in values:
            shades = {found.label_of(organ): color for organ, color in colors.items()}
            write = partial(write_image, found.label_map, colors=shades)
            write_to(files, values["labels"], write)
        if "save_session" in values:
            text = session_text([named(next(iter(found.values())).provenance, names)])
            write_to(files, values["save_session"], lambda path: write_text(path, text))


def _report(volume: str, found: SegmentedOrgans, reading: float, working: float) -> None:
    for organ, result in found.items():
        print(
            f"{volume}, {organ}: label {found.label_of(organ)}, volume {result.volume:.1f} ml, "
            f"{len(result.iterations['Iteration'])} iterations, {result.stop_reason}, "
            f"{result.self_intersections} self-intersections, "
            f"confidence {confidence_text(result.confidence)}"
        )
    print(
        f"{volume}: organs do not meet; reading {reading:.2f} s, segmenting {working:.2f} s"
    )


def organs_of(values: dict[str, Any]) -> Organs:
    """Seeds and points by the names of the organs; points belong to the organ before them."""
    _require_sense_of_group(values)
    organs: Organs = {}
    for option, given in values["order"]:
        if option == "organ":
            name, *numbers = given
            _require_name(name, organs)
            organs[name] = _seed_of(values, name, numbers)
        elif option in (*POINTS, *STROKES):
            if not organs:
                raise WrongUsage(
                    f"--{option.replace('_', '-')}: the point comes before the first --organ. Give it "
                    "after its own organ"
                )
            kind, places = places_of_option(values, option, given)
            organs[next(reversed(organs))].setdefault(kind, []).extend(places)
    return organs


def _require_sense_of_group(values: dict[str, Any]) -> None:
    """Checks the options beside the organs."""
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


def _require_name(name: str, organs: Organs) -> None:
    if not name:
        raise WrongUsage("--organ: a name is empty. Give each organ one of its own")
    file_name = file_name_of(name)
    other = next((organ for organ in organs if file_name_of(organ) == file_name), None)
    if other is not None:
        raise WrongUsage(
            f"--organ: '{other}' and '{name}' would give the same file name; choose distinct names"
        )


def _seed_of(values: dict[str, Any], name: str, numbers: list[str]) -> dict[str, Any]:
    *center, radius = (_number_of(name, text) for text in numbers)
    require_coordinates(f"--organ {name}", [center])
    if not is_seed_radius(radius):
        raise WrongUsage(f"--organ {name}: the radius {seed_radius_rule(radius)}")
    return {"seed": lps(values, center), "radius": radius}


def _number_of(organ: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise WrongUsage(
            f"--organ {organ}: '{text}' is not a number. Give a name, the seed's center, and its "
            "radius: NAME X Y Z MM"
        ) from None
