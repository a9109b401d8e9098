"""`flipfree segment`."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterable
from functools import partial
from typing import Any

from ._atomic import write_text
from ._backend import SEGMENT_PARAMETERS, set_threads
from ._command_ask import ask, require_answers, say_nothing_to_ask
from ._command_group import organs_of, segment_group, segment_together
from ._command_inputs import (
    POINTS,
    input_title,
    points_of,
    require_coordinates,
    require_sense_of_corrections,
    wants_bar,
)
from ._command_outputs import (
    OUTPUTS,
    SHARED,
    STROKES,
    require_files,
    require_outputs,
    write_output,
    write_to,
)
from ._command_seed import seeds_in
from ._corrections import Constraint, answers_of
from ._dicom import may_hold_series
from ._errors import FileError, FlipFreeError
from ._files import read_image, write_image
from ._image import Image
from ._messages import confidence_text, warn
from ._options import WrongUsage
from ._point_files import arguments_of, write_points
from ._seed_radius import is_seed_radius, seed_radius_rule
from ._segment import segment as segment_organ
from ._segmentation import Segmentation, Vessel
from ._session import Session, SessionOrgan, image_beside, read_session, require_image_of, runs_of
from ._session_record import OriginNames, named, organ_of_file, session_text
from ._trace import trace as trace_vessel


def segment(values: dict[str, Any]) -> None:
    """`flipfree segment`."""
    progress = wants_bar(values)
    require_sense_of_corrections(values)
    if "ask" in values:
        require_answers(values)
    if {"organ", "fixed"} & values.keys():
        segment_group(values, organs_of(values), {}, None, progress)
        return
    session = _session_of(values)
    if session and "input" not in values:
        values = {**values, "input": image_beside(session)}
    if session and session.series and "series" not in values and may_hold_series(values["input"]):
        values = {**values, "series": session.series}
    if session and session.together:
        segment_together(session, values, progress)
        return
    own = [name for name in OUTPUTS if name not in SHARED]
    runs = runs_of(session, values, own) if session else [values]
    for run in runs:
        outputs = {name: run[name] for name in OUTPUTS if name in run}
        require_outputs(outputs)
        require_files(run, outputs)
    points = [] if session else points_of(values)  # a session's organs have their own
    set_threads(values.get("threads", 0))
    start = time.perf_counter()
    image = read_image(values["input"], series=values.get("series"), progress=progress)
    reading = time.perf_counter() - start
    if session:
        require_image_of(session, values["input"], image)
    runs = [{**run, "series": image.series} for run in runs]
    with contextlib.ExitStack() as files:  # either all files or none
        found = [_segment_one(run, image, points, files, progress) for run in runs]
        _write_shared(values, runs, [organ for organ, _ in found], files)
    for run, (organ, working) in zip(runs, found):
        _report(run, organ, reading, working)


def _session_of(values: dict[str, Any]) -> Session | None:
    """The session of the command line; checks that there is one, or else an image and a seed."""
    if "session" not in values:
        _require_start(values)
        return None
    if "start_labels" in values:
        raise WrongUsage("--session has the seed. Leave out --start-labels")
    given = {"seed", "seed_voxel", "radius"} & values.keys()
    if given or values.get("preset", "default") != "default":
        raise WrongUsage(
            "--session has the seed and the preset. Leave out --seed, --seed-voxel, --radius and "
            "--preset"
        )
    if {*POINTS, *STROKES, "points", "save_points", "ras"} & values.keys():
        raise WrongUsage(
            "--session cannot be corrected by points. Give the image, --seed and --radius in its place"
        )
    return read_session(values["session"])


def _require_start(values: dict[str, Any]) -> None:
    """There is an image, and either a label map or a seed."""
    if "start_labels" in values and {"seed", "seed_voxel", "radius"} & values.keys():
        raise WrongUsage(
            "--start-labels takes the place of the seed. Leave out --seed, --seed-voxel and "
            "--radius; points correct the result"
        )
    if "input" not in values:
        raise WrongUsage("INPUT is required: a volume, or a folder of a DICOM series")
    if "start_labels" not in values:
        _require_seed(values)


def _require_seed(values: dict[str, Any]) -> None:
    """There are seeds, each with a radius."""
    if ("seed" in values) == ("seed_voxel" in values):
        raise WrongUsage(
            "Both --seed and --seed-voxel are given. Give only one of them"
            if "seed" in values
            else "There is no seed. Give a point deep inside the organ: --seed X Y Z (LPS mm) or "
            "--seed-voxel I J K; or a label map to fill: --start-labels FILE; or several organs: "
            "--organ NAME X Y Z MM"
        )
    require_coordinates("--seed", values.get("seed", ()))
    radii = values.get("radius", ())
    if not radii:
        raise WrongUsage(
            "--radius is missing. The seed is a sphere within the organ: give its radius in "
            "millimeters, --radius MM"
        )
    for radius in radii:
        if not is_seed_radius(radius):
            raise WrongUsage(f"--radius {seed_radius_rule(radius)}")
    seeds = len(values.get("seed", ())) + len(values.get("seed_voxel", ()))
    if len(radii) != seeds:
        raise WrongUsage(
            f"There are {'more' if len(radii) > seeds else 'fewer'} radii ({len(radii)}) than seeds "
            f"({seeds}). Give a --radius for each seed, in the same order"
        )


def _segment_one(
    values: dict[str, Any],
    image: Image,
    points: list[Constraint],
    files: contextlib.ExitStack,
    progress: bool,
) -> tuple[Segmentation, float]:
    """What was found and in how many seconds; its own files are written."""
    start = time.perf_counter()
    title = _title_of(values)
    if {"seed", "seed_voxel"} & values.keys():
        values = {**values, "centers": seeds_in(image, values)}
    try:
        organ = _found(values, image, points, progress)
    except FileError:
        raise  # it names its own file
    except FlipFreeError as error:
        raise type(error)(f"{title}: {error}") from error
    working = time.perf_counter() - start
    if "ask" in values:
        if not organ.questions:
            say_nothing_to_ask(values)
        answers = ask(organ.questions)
        points = [*points, *answers_of(organ.questions, answers)]
        organ = organ.answered(answers, progress=progress or None) if answers else organ
    for name in OUTPUTS:
        if name == "questions" and isinstance(organ, Vessel):
            continue
        if name in values and name == "save_points":
            write_to(files, values[name], lambda path: write_points(path, points))
        elif name in values and name not in SHARED:
            write = partial(write_output, name, organ, image, names_of(values))
            write_to(files, values[name], write)
    return organ, working


def _found(
    values: dict[str, Any], image: Image, points: list[Constraint], progress: bool
) -> Segmentation:
    repeated: SessionOrgan | None = values.get("repeated")
    if repeated and repeated.points:
        given: dict[str, Any] = {**repeated.corrections, **repeated.parameters}
        given["label_value"] = values["label_value"]
        return trace_vessel(image, repeated.points, progress=progress or None, **given)
    return segment_organ(
        image,
        **_start_of(values, points),
        preset=values.get("preset", "default"),
        progress=progress or None,
        **{name: value for name, value in values.items() if name in SEGMENT_PARAMETERS},
    )


def _write_shared(
    values: dict[str, Any],
    runs: list[dict[str, Any]],
    organs: list[Segmentation],
    files: contextlib.ExitStack,
) -> None:
    """The files that hold all organs."""
    names = [names_of(run) for run in runs]
    if "labels" in values:
        first = values.get("label_value", 1)
        write = partial(
            write_image,
            _label_map(organs),
            names={label: one.organs[0] for label, one in enumerate(names, first)},
            colors={label: one.colors[0] for label, one in enumerate(names, first)},
        )
        write_to(files, values["labels"], write)
    if "save_session" in values:
        text = session_text([named(organ.provenance, one) for organ, one in zip(organs, names)])
        write_to(files, values["save_session"], lambda path: write_text(path, text))


def _title_of(values: dict[str, Any], quote: str = "'") -> str:
    """How messages call what is segmented."""
    organ = f", {values['organ']}" if "organ" in values else ""
    return f"{input_title(values, quote)}{organ}"


def names_of(
    values: dict[str, Any], outputs: Iterable[str] = ("output", "labels", "convergence")
) -> OriginNames:
    """What files say of an organ, or of one of a session, apart from how it was found."""
    repeated: SessionOrgan | None = values.get("repeated")
    files = (values[name] for name in (*outputs, "save_session") if name in values)
    return OriginNames(
        values["input"],
        values.get("series", ""),
        values.get("start_labels", ""),
        values.get("start_label", ""),
        organs=[repeated.title if repeated else organ_of_file(next(files, ""))],
        colors=[repeated.color if repeated else ""],
    )


def _start_of(values: dict[str, Any], points: list[Constraint]) -> dict[str, Any]:
    """The seed, or the label map in its place, and the corrections with all further seeds."""
    repeated: SessionOrgan | None = values.get("repeated")
    corrections = repeated.corrections if repeated else arguments_of(points)
    if "start_labels" in values:
        given: set[str] = {"start_labels", "start_label"} & values.keys()
        return {**{name: values[name] for name in given}, **corrections}
    (seed, radius), *more = zip(values["centers"], values["radius"])
    return {
        "seed": seed,
        "radius": radius,
        **corrections,
        "seeds": [*more, *corrections.get("seeds", ())],
    }


def _label_map(organs: list[Segmentation]) -> Image:
    """One label map of all organs. A voxel in several belongs to the first of them."""
    merged = organs[0].label_map
    for organ in organs[1:]:
        free = merged.voxels == 0
        merged.voxels[free] = organ.label_map.voxels[free]
    return merged


def _report(values: dict[str, Any], organ: Segmentation, reading: float, working: float) -> None:
    if not organ.mesh.certified and organ.self_intersections == 0:
        warn("The surface is not certified: --guard is off. It does not intersect itself, though.")
    if "quiet" not in values:
        trust = (
            f"support {organ.support:.2f}"
            if isinstance(organ, Vessel)
            else f"confidence {confidence_text(organ.confidence)}"
        )
        print(
            f"{_title_of(values, '')}: volume {organ.volume:.1f} ml, "
            f"{len(organ.iterations['Iteration'])} iterations, {organ.stop_reason}, "
            f"{organ.self_intersections} self-intersections, {trust}; reading {reading:.2f} s, "
            f"segmenting {working:.2f} s"
        )
