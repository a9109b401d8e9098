"""`flipfree phantom`."""

from __future__ import annotations

import os
from typing import Any

from . import _kernels
from ._atomic import output_folder
from ._command import say
from ._files import write_image
from ._phantom import phantom as make_phantom


def phantom(request: Any) -> None:
    """`flipfree phantom`."""
    given = {
        "dimensions": request.size,
        "spacing": request.spacing,
        "noise_standard_deviation": request.noise,
        "random_seed": request.random_seed,
        "number_of_lesions": request.lesions,
    }
    with output_folder(request.folder):
        made = make_phantom(request.name, **given)
        stem = os.path.join(request.folder, request.name)
        write_image(made.image, f"{stem}.nii.gz")
        write_image(made.label_map, f"{stem}-truth.nii.gz")
    if not request.quiet:
        say(_kernels.phantom_text(request))
