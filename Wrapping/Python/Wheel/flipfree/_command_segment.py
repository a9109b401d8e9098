"""`flipfree segment`."""

from __future__ import annotations

import contextlib
import time
from functools import partial
from typing import Any

from . import _kernels
from ._atomic import write_text, write_to
from ._backend import set_threads
from ._command import say
from ._command_ask import ask
from ._command_outputs import SHARED, wants_bar, write_output
from ._corrections import Constraint, answers_of
from ._errors import FileError, FlipFreeError
from ._files import read_image, write_image
from ._image import Image
from ._messages import warn
from ._picture import require_matplotlib
from ._point_files import arguments_of, constraints_in, write_points
from ._segment import default_parameters
from ._segment import segment as segment_organ
from ._segment_organs import SegmentedOrgans, segment_organs
from ._segmentation import Segmentation, Vessel
from ._surface_files import read_surface
from ._trace import trace as trace_vessel


def segment(plan: Any) -> None:
    """`flipfree segment`."""
    if "--snapshot" in plan.given.files:
        require_matplotlib()
    set_threads(plan.given.threads)
    (_segment_together if plan.group else _segment_alone)(plan, wants_bar(plan.given))


def _read(plan: Any, progress: bool) -> tuple[Image, float]:
    """The image, and in how many seconds it was read."""
    start = time.perf_counter()
    image = read_image(plan.given.input, series=plan.given.series or None, progress=progress)
    plan.require_image(image.voxels.shape[::-1], image.spacing, image.origin, image.direction)
    return image, time.perf_counter() - start


def _segment_alone(plan: Any, progress: bool) -> None:
    """One after the other."""
    image, reading = _read(plan, progress)
    found: list[Segmentation] = []
    lines = []
    requests = list(plan.organs)
    with contextlib.ExitStack() as files:  # either all files or none
        for request in requests:
            request.series = image.series
            points = constraints_in(request.points)
            organ = _found(request, image, points, progress)
            if request.asks:
                answers = _answers_to(request, organ)
                points += answers_of(organ.questions, answers)
                organ = organ.answered(answers, progress=progress or None) if answers else organ
            _write_own(request, organ, image, points, files)
            found.append(organ)
            lines.append(_summary(request, organ, reading))
        _write_shared(plan.given, requests, found, files)
    for organ, line in zip(found, lines):
        if not organ.mesh.certified and organ.self_intersections == 0:
            warn(_kernels.NOT_CERTIFIED)
        if not plan.given.quiet:
            say(line)


def _found(request: Any, image: Image, points: list[Constraint], progress: bool) -> Segmentation:
    try:
        if request.vessel_points:
            return _vessel_found(request, image, points, progress)
        return segment_organ(
            image,
            **_start_of(request, image, points),
            preset=request.preset,
            label_value=request.label_value,
            progress=progress or None,
            **request.parameters,
        )
    except FileError:
        raise  # it names its own file
    except FlipFreeError as error:
        title = request.title("'")
        raise type(error)(f"{title}: {error}") from error


def _vessel_found(
    request: Any, image: Image, points: list[Constraint], progress: bool
) -> Vessel:
    corrections = arguments_of(points)
    del corrections["seeds"]
    given = {**corrections, **request.parameters, "label_value": request.label_value}
    return trace_vessel(image, request.vessel_points, progress=progress or None, **given)


def _start_of(request: Any, image: Image, points: list[Constraint]) -> dict[str, Any]:
    """The seed, or the label map in its place, and the corrections with all further seeds."""
    corrections = arguments_of(points)
    if request.start_labels:
        label = {"start_label": request.start_label} if request.start_label else {}
        return {"start_labels": request.start_labels, **label, **corrections}

    def place_of(voxel: Any) -> list[float]:
        import numpy

        place: list[float] = (numpy.array(image.origin) + image.steps @ numpy.array(voxel, float)).tolist()
        return place

    seeds = [(place, radius) for _, place, radius in request.seeds(image.voxels.shape[::-1], place_of)]
    (seed, radius), *more = seeds
    return {"seed": seed, "radius": radius, **corrections, "seeds": [*more, *corrections["seeds"]]}


def _answers_to(request: Any, organ: Segmentation) -> dict[int, bool]:
    carving = {**default_parameters(request.preset), **request.parameters}["carving"]
    return ask(organ.questions, _kernels.nothing_to_ask_text(bool(request.start_labels), carving))


def _write_own(
    request: Any,
    organ: Segmentation,
    image: Image,
    points: list[Constraint],
    files: contextlib.ExitStack,
) -> None:
    """The files of an organ, but for those of all."""
    for option, path in request.files.items():
        if option == "--save-points":
            write_to(files, path, lambda path: write_points(path, points))
        elif option not in SHARED and not (option == "--questions" and isinstance(organ, Vessel)):
            write_to(files, path, partial(write_output, option, organ, image, request.names))


def _write_shared(
    given: Any, requests: list[Any], organs: list[Segmentation], files: contextlib.ExitStack
) -> None:
    """The files that hold all organs."""
    names = [request.names for request in requests]
    if "--labels" in given.files:
        write = partial(
            write_image,
            _label_map(organs),
            names={label: one.organs[0] for label, one in enumerate(names, given.label_value)},
            colors={label: one.colors[0] for label, one in enumerate(names, given.label_value)},
        )
        write_to(files, given.files["--labels"], write)
    if "--save-session" in given.files:
        path = given.files["--save-session"]
        texts = [_kernels.named_provenance(organ.provenance, one) for organ, one in zip(organs, names)]
        write_to(files, path, lambda name: write_text(name, _kernels.session_text(path, texts)))


def _label_map(organs: list[Segmentation]) -> Image:
    """One label map of all organs. A voxel in several belongs to the first of them."""
    merged = organs[0].label_map
    for organ in organs[1:]:
        free = merged.voxels == 0
        merged.voxels[free] = organ.label_map.voxels[free]
    return merged


def _summary(request: Any, organ: Segmentation, reading: float) -> str:
    summary = _summary_of(request.title(""), organ)
    if isinstance(organ, Vessel):
        return str(_kernels.vessel_text(summary, organ.support, reading, organ.stage_seconds))
    return str(_kernels.organ_text(summary, organ.confidence, reading, organ.stage_seconds))


def _summary_of(title: str, organ: Segmentation) -> Any:
    iterations = len(organ.iterations["Iteration"])
    return _kernels.OrganSummary(title, organ.volume, iterations, organ.stop_reason, organ.self_intersections)


def _segment_together(plan: Any, progress: bool) -> None:
    """`--organ`, or a session of organs that were segmented so."""
    given = plan.given
    fixed = [read_surface(name) for name in plan.fixed]
    image, reading = _read(plan, progress)
    organs: dict[str, dict[str, Any]] = {}
    for name, seed, radius, points, _, _ in plan.group:
        corrections = arguments_of(constraints_in(points))
        organs[name] = {"seed": seed, "radius": radius, **corrections}
    # Here presets are values of parameters.
    parameters = {**default_parameters(given.preset), **given.parameters, "label_value": given.label_value}
    del parameters["keep_history"]  # is of one organ
    try:
        found = segment_organs(image, organs, fixed=fixed, progress=progress or None, **parameters)
    except FlipFreeError as error:
        raise type(error)(f"'{given.input}': {error}") from error
    _write_group(plan, found, image)
    if not given.quiet:
        title = _kernels.input_title(given.input, image.series)
        for name, organ in found.items():
            summary = _summary_of(title, organ)
            say(_kernels.group_text(summary, name, found.label_of(name), organ.confidence))
        seconds = next(iter(found.values())).stage_seconds
        say(_kernels.group_end_text(title, reading, seconds))


def _write_group(plan: Any, found: SegmentedOrgans, image: Image) -> None:
    given = plan.given
    names = _kernels.OriginNames()
    names.image, names.series, names.fixed = given.input, image.series, plan.fixed
    names.organs, names.colors = list(found), [color for *_, color, _ in plan.group]
    with contextlib.ExitStack() as files:  # either all files or none
        for name, *_, own in plan.group:
            for option, path in own.items():
                write_to(files, path, partial(write_output, option, found[name], image, names))
        if "--labels" in given.files:
            colors = {found.label_of(name): color for name, *_, color, _ in plan.group if color}
            write_to(files, given.files["--labels"], partial(write_image, found.label_map, colors=colors))
        if "--save-session" in given.files:
            path = given.files["--save-session"]
            text = _kernels.named_provenance(next(iter(found.values())).provenance, names)
            write_to(files, path, lambda name: write_text(name, _kernels.session_text(path, [text])))
