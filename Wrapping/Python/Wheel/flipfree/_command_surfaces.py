"""`flipfree surfaces`."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import Any

from . import _kernels
from ._atomic import output_folder
from ._backend import set_threads
from ._command import say
from ._command_outputs import wants_bar
from ._errors import FileError
from ._image_files import read_labels
from ._label_files import TABLE, write_label_surfaces
from ._surfaces import LabelSurfaces
from ._surfaces import surfaces as make_surfaces
from ._text_files import read_text


def surfaces(request: Any) -> None:
    """`flipfree surfaces`."""
    set_threads(request.threads)
    with output_folder(request.folder):
        found = _written(request)
    if not request.quiet:
        rows = [
            (one.label, one.name, one.volume, one.euler_number, one.triangles, one.wrong_voxels)
            for one in found.labels.values()
        ]
        is_coarse = any(request.parameters.get(name) for name in ("edge_length", "triangles"))
        collapse = (len(found.triangles), found.collapse_distance) if is_coarse else None
        say(_kernels.surfaces_text(rows, found.wrong_voxels, found.greatest_distance, collapse))


def _written(request: Any) -> LabelSurfaces:
    _kernels.require_place("--output", os.path.join(request.folder, TABLE), [request.labels])
    image, _ = read_labels(request.labels, "")
    if request.names:
        image = replace(image, names=_names_in(request.names))
    found = make_surfaces(image, request.only, progress=wants_bar(request), **request.parameters)
    inputs = [request.labels, *([request.names] if request.names else [])]
    write_label_surfaces(
        found, request.folder, request.format, lambda path: _kernels.require_place("--output", path, inputs)
    )
    return found


def _names_in(path: str) -> dict[int, str]:
    try:
        names: dict[int, str] = _kernels.read_label_names(path, read_text(path))
    except _kernels.FileProblem as problem:
        raise FileError(str(problem)) from None
    return names
