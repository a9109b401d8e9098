"""`flipfree surfaces`."""

from __future__ import annotations

import contextlib
import os
from dataclasses import replace
from typing import Any

from . import _kernels
from ._atomic import output_folder, write_table
from ._backend import set_threads
from ._command import say
from ._command_outputs import wants_bar, write_to
from ._errors import FileError
from ._image_files import read_labels
from ._segmentation import surface_of_label
from ._surface_files import write_surface
from ._surfaces import LabelSurfaces
from ._surfaces import surfaces as make_surfaces
from ._text_files import read_text

# The columns of the table, and the fields of LabelMeasures in them.
COLUMNS = {
    "Label": "label",
    "Name": "name",
    "Milliliters": "volume",
    "Voxels": "voxels",
    "VoxelMilliliters": "voxel_volume",
    "WrongVoxels": "wrong_voxels",
    "Area": "area",
    "EulerNumber": "euler_number",
    "Triangles": "triangles",
}


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
    """Makes the surfaces, and writes them and the table."""
    table = os.path.join(request.folder, "surfaces.csv")
    _kernels.require_place("--output", table, [request.labels])
    image, _ = read_labels(request.labels, "")
    if request.names:
        image = replace(image, names=_names_in(request.names))
    found = make_surfaces(image, request.only, progress=wants_bar(request), **request.parameters)
    files = {label: _file_of(found, label, request.format) for label in found.labels}
    inputs = [request.labels, *([request.names] if request.names else [])]
    with contextlib.ExitStack() as written:
        for label, file in files.items():
            if not file:
                continue
            path = os.path.join(request.folder, file)
            _kernels.require_place("--output", path, inputs)
            surface = surface_of_label(found, label)
            write_to(written, path, lambda name, mesh=surface: write_surface(mesh, name))  # type: ignore[misc]
    rows = [
        [*(getattr(found.labels[label], field) for field in COLUMNS.values()), file]
        for label, file in files.items()
    ]
    write_table(table, [*COLUMNS, "File"], rows)
    return found


def _file_of(found: LabelSurfaces, label: int, ending: str) -> str:
    """Empty for a label of which no part is left."""
    if found.labels[label].triangles == 0:
        return ""
    name = _kernels.file_name_part(found.labels[label].name)
    return f"{label}-{name}.{ending}" if name else f"{label}.{ending}"


def _names_in(path: str) -> dict[int, str]:
    try:
        names: dict[int, str] = _kernels.read_label_names(path, read_text(path))
    except _kernels.FileProblem as problem:
        raise FileError(str(problem)) from None
    return names
