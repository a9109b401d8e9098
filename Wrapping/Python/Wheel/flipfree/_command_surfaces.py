"""`flipfree surfaces`."""

from __future__ import annotations

import contextlib
import os
from dataclasses import replace
from typing import Any

from . import _kernels
from ._atomic import output_folder, write_table
from ._backend import SURFACES_PARAMETERS, set_threads
from ._command_inputs import wants_bar
from ._command_outputs import require_place, write_to
from ._errors import FileError
from ._image_files import read_labels
from ._options import WrongUsage
from ._segmentation import Surface
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


def surfaces(values: dict[str, Any]) -> None:
    """`flipfree surfaces`."""
    if "exact" in values and "distance" in values:
        raise WrongUsage("--exact excludes --distance")
    set_threads(values.get("threads", 0))
    with output_folder(values["output"]):
        found = _written(values, values["output"])
    if "quiet" not in values:
        _print(found, is_coarse=any(values.get(name) for name in ("edge_length", "triangles")))


def _written(values: dict[str, Any], folder: str) -> LabelSurfaces:
    """Makes the surfaces, and writes them and the table."""
    table = os.path.join(folder, "surfaces.csv")
    require_place(table, [values["labels"]])
    image, _ = read_labels(values["labels"], "")
    if "names" in values:
        image = replace(image, names=_names_in(values["names"]))
    parameters = {name: values[name] for name in SURFACES_PARAMETERS if name in values}
    found = make_surfaces(image, values.get("label", ()), progress=wants_bar(values), **parameters)
    files = {label: _file_of(found, label, values.get("format", "stl")) for label in found.labels}
    with contextlib.ExitStack() as written:
        for label, file in files.items():
            if not file:
                continue
            path = os.path.join(folder, file)
            require_place(path, [values["labels"], values.get("names", values["labels"])])
            surface = _surface_of(found, label)
            write_to(written, path, lambda name, mesh=surface: write_surface(mesh, name))  # type: ignore[misc]
    rows = [
        [*(getattr(found.labels[label], field) for field in COLUMNS.values()), file]
        for label, file in files.items()
    ]
    write_table(table, [*COLUMNS, "File"], rows)
    return found


def _surface_of(found: LabelSurfaces, label: int) -> Surface:
    import numpy

    points, triangles = found.surface(label)
    return Surface(
        points=points,
        corners=triangles.ravel(),
        offsets=numpy.arange(0, triangles.size + 1, 3, dtype=numpy.int32),
        displacements=numpy.zeros(points.shape),
        correspondence=numpy.zeros(len(points), numpy.uint8),
        certified=True,
    )


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


def _print(found: LabelSurfaces, is_coarse: bool) -> None:
    heading = ("Label", "Name", "Milliliters", "Euler", "Triangles", "Wrong voxels")
    print("{:>10}  {:<24}  {:>11}  {:>6}  {:>9}  {:>12}".format(*heading))
    for one in found.labels.values():
        counts = f"{one.euler_number:6d}  {one.triangles:9d}  {one.wrong_voxels:12d}"
        print(f"{one.label:10d}  {one.name:<24}  {one.volume:11.3f}  {counts}")
    print(
        f"{found.wrong_voxels} voxels on the wrong side; vertices lie at most "
        f"{found.greatest_distance:.2f} mm from the corners where voxels of different labels meet"
    )
    if is_coarse:
        print(
            f"{len(found.triangles)} triangles; walls lie at most {found.collapse_distance:.2f} mm "
            "from where they were before edges were collapsed"
        )
