"""The files that subcommands write, all or none."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import Any

from . import _kernels
from ._atomic import write_table, write_text
from ._files import write_image
from ._image import Image
from ._questions import COLUMNS
from ._segmentation import Segmentation, Vessel
from ._surface_files import write_centerline, write_surface

# Of all organs of a session, one each.
SHARED = ("--labels", "--save-session")


def wants_bar(request: Any) -> bool:
    """Whether somebody looks at the terminal."""
    return not request.quiet and sys.stderr.isatty()


def write_output(option: str, organ: Segmentation, image: Image, names: Any, path: str) -> None:
    """Writes the file that an option asks for."""
    provenance = _kernels.named_provenance(organ.provenance, names)
    if option == "--output":
        # The other formats have it without names: the same surface is the same bytes.
        is_vtp = path.lower().endswith(".vtp")
        write_surface(replace(organ.mesh, provenance=provenance) if is_vtp else organ, path)
    elif option == "--save-session":
        write_text(path, _kernels.session_text(path, [provenance]))
    elif option == "--labels":
        label = int(organ.label_map.voxels.max())
        write_image(organ.label_map, path, names={label: names.organs[0]})
    elif option == "--centerline" and isinstance(organ, Vessel):
        write_centerline(organ, path)
    elif option == "--convergence":
        columns = organ.iterations
        rows = zip(*(values.tolist() for values in columns.values()))
        write_table(path, list(columns), [list(row) for row in rows])
    elif option == "--questions":
        write_table(path, list(COLUMNS), [question.row() for question in organ.questions])
    else:
        from ._picture import write_picture

        write_picture(path, image, organ)
