"""`flipfree trace`."""

from __future__ import annotations

import contextlib
from functools import partial
from typing import Any

from . import _kernels
from ._atomic import write_to
from ._backend import set_threads
from ._command import say
from ._command_outputs import wants_bar, write_output
from ._errors import FlipFreeError
from ._files import read_image
from ._picture import require_matplotlib
from ._point_files import arguments_of, constraints_in, write_points
from ._trace import trace as trace_vessel


def trace(request: Any) -> None:
    """`flipfree trace`."""
    progress = wants_bar(request)
    points = constraints_in(request.points)
    corrections = arguments_of(points)
    del corrections["seeds"]
    if "--snapshot" in request.files:
        require_matplotlib()
    set_threads(request.threads)
    image = read_image(request.input, series=request.series or None, progress=progress)
    request.series = image.series
    with contextlib.ExitStack() as files:  # either all files or none
        try:
            vessel = trace_vessel(
                image, request.places, progress=progress or None, **corrections, **request.parameters
            )
        except FlipFreeError as error:
            title = _kernels.input_title(f"'{request.input}'", request.series)
            raise type(error)(f"{title}: {error}") from error
        for option, path in request.files.items():
            if option == "--save-points":
                write_to(files, path, lambda path: write_points(path, points))
            else:
                write_to(files, path, partial(write_output, option, vessel, image, request.names))
    if not request.quiet:
        text = _kernels.trace_text(
            _kernels.input_title(request.input, request.series),
            len(vessel.branches),
            len(vessel.points),
            vessel.stop_reason,
            vessel.self_intersections,
            vessel.support,
            vessel.stage_seconds,
        )
        say(text)
