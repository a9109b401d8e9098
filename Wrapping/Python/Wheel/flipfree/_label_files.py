"""The files of a label map's surfaces: one for each label, and a table."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import ExitStack

from . import _kernels
from ._atomic import write_table, write_to
from ._segmentation import surface_of_label
from ._surface_files import write_surface
from ._surfaces import LabelMeasures, LabelSurfaces

TABLE = "surfaces.csv"


def write_label_surfaces(
    found: LabelSurfaces, folder: str, ending: str, check: Callable[[str], None] = lambda _: None
) -> list[str]:
    """Writes LABEL.ending, or LABEL-NAME.ending, for each label, and the table; all of them or none.

    Gives the names of the files. `check` may refuse the path of one before any is written.
    """
    files = {label: _file_of(found, label, ending) for label in found.labels}
    names = [TABLE, *filter(None, files.values())]
    for name in names:
        check(os.path.join(folder, name))
    rows = [
        [*(getattr(found.labels[label], field) for field in LabelMeasures.COLUMNS.values()), file]
        for label, file in files.items()
    ]
    with ExitStack() as written:
        for label, file in files.items():
            if file:
                surface = surface_of_label(found, label)
                path = os.path.join(folder, file)
                write_to(written, path, lambda name, mesh=surface: write_surface(mesh, name))  # type: ignore[misc]
        path = os.path.join(folder, TABLE)
        write_to(written, path, lambda name: write_table(name, [*LabelMeasures.COLUMNS, "File"], rows))
    return names


def _file_of(found: LabelSurfaces, label: int, ending: str) -> str:
    """Empty for a label of which no part is left."""
    if found.labels[label].triangles == 0:
        return ""
    return str(_kernels.label_file_name(label, found.labels[label].name, ending))
