"""`flipfree trace`."""

from __future__ import annotations

import contextlib
from functools import partial
from typing import Any

from ._backend import TRACE_PARAMETERS, VesselAlgorithm, set_threads
from ._command_inputs import (
    input_title,
    lps,
    points_of,
    require_coordinates,
    require_sense_of_corrections,
    wants_bar,
)
from ._command_outputs import (
    TRACE_OUTPUTS,
    require_files,
    require_outputs,
    write_output,
    write_to,
)
from ._command_segment import names_of
from ._corrections import BOUNDARY, INSIDE, OUTSIDE, SEED
from ._errors import FlipFreeError
from ._files import read_image
from ._options import WrongUsage
from ._point_files import write_points
from ._trace import trace as trace_vessel


def trace(values: dict[str, Any]) -> None:
    """`flipfree trace`."""
    progress = wants_bar(values)
    outputs = {name: values[name] for name in TRACE_OUTPUTS if name in values}
    _require_sense_of_trace(values, outputs)
    corrections = points_of(values)
    if any(one.kind == SEED for one in corrections):
        raise FlipFreeError(
            "--points: a seed is of no use to a vessel. Give a further --point along it"
        )
    set_threads(values.get("threads", 0))
    image = read_image(values["input"], series=values.get("series"), progress=progress)
    values = {**values, "series": image.series}
    with contextlib.ExitStack() as files:  # either all files or none
        try:
            vessel = trace_vessel(
                image,
                [lps(values, point) for point in values["point"]],
                inside=[one.place for one in corrections if one.kind == INSIDE],
                outside=[one.place for one in corrections if one.kind == OUTSIDE],
                boundary=[one.place for one in corrections if one.kind == BOUNDARY],
                progress=progress or None,
                **{name: value for name, value in values.items() if name in TRACE_PARAMETERS},
            )
        except FlipFreeError as error:
            title = input_title(values, "'")
            raise type(error)(f"{title}: {error}") from error
        for name, path in outputs.items():
            if name == "save_points":
                write_to(files, path, lambda path: write_points(path, corrections))
            else:
                names = names_of(values, ("output", "labels", "centerline"))
                write_to(files, path, partial(write_output, name, vessel, image, names))
    if "quiet" not in values:
        count = len(vessel.branches)
        stages = ("path", "start", "deformation", "label map")
        seconds = ", ".join(f"{name} {used:.2f} s" for name, used in zip(stages, vessel.stage_seconds))
        print(
            f"{input_title(values)}: {count} {'branch' if count == 1 else 'branches'}, "
            f"{len(vessel.points)} vertices, {vessel.stop_reason}, "
            f"{vessel.self_intersections} self-intersections, support {vessel.support:.2f}; {seconds}"
        )


def _require_sense_of_trace(values: dict[str, Any], outputs: dict[str, str]) -> None:
    """Checks all that can be checked before the volume is read."""
    points = values.get("point", [])
    require_coordinates("--point", points)
    if len(points) < 2:
        raise WrongUsage(
            "A vessel needs at least two points. Give one at each end: --point X Y Z --point X Y Z "
            "(LPS mm)"
        )
    require_sense_of_corrections(values)
    require_outputs(outputs, TRACE_OUTPUTS)
    radius, wall = values.get("radius", 0), values.get("wall_thickness", 0)
    if not 0 <= radius <= 100:
        raise WrongUsage(f"--radius must be a number of millimeters, 0 to 100, not {radius:g}. 0 finds it")
    if not -5 <= wall <= 5:
        raise WrongUsage(f"--wall-thickness must be a number of millimeters, -5 to 5, not {wall:g}")
    settings = VesselAlgorithm().settings
    for name in TRACE_PARAMETERS.keys() & values.keys():
        TRACE_PARAMETERS[name].set(settings, values[name])
    require_files(values, outputs)
