"""`flipfree evaluate`."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from ._atomic import write_table
from ._backend import SCORE_COLUMNS, score_summary, validity_summary
from ._command import say
from ._errors import FlipFreeError
from ._evaluate import evaluate as evaluate_segmentation
from ._image_files import read_labels
from ._surface_files import ENDINGS, read_surface


def evaluate(request: Any) -> None:
    """`flipfree evaluate`."""
    labels: dict[str, int] = {}

    def read(name: str, label: str, keyword: str) -> Any:
        image, value = read_labels(name, label)
        if value is not None:
            labels[keyword] = value
        return image

    surface = None
    compared: Any
    if request.segmentation.lower().endswith(ENDINGS):
        compared = surface = read_surface(request.segmentation)
    else:
        compared = read(request.segmentation, request.segmentation_label, "segmentation_label")
    reference = read(request.reference, request.reference_label, "reference_label")
    try:
        scores = evaluate_segmentation(compared, reference, **labels, score_voxelization=request.voxelize)
    except FlipFreeError as error:
        raise type(error)(f"'{request.segmentation}' against '{request.reference}': {error}") from error
    if request.csv:
        row = {"Segmentation": request.segmentation, "Reference": request.reference}
        row.update((SCORE_COLUMNS[field][0], value) for field, value in asdict(scores).items())
        write_table(request.csv, list(row), [list(row.values())])
    if request.quiet:
        return
    say(score_summary(asdict(scores)))
    if surface is not None:
        say(validity_summary(surface))
