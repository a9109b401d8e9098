"""`flipfree evaluate`."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from ._atomic import write_table
from ._backend import SCORE_COLUMNS, score_summary, validity_summary
from ._command_inputs import wants_bar
from ._command_outputs import require_ending, require_place
from ._errors import FlipFreeError
from ._evaluate import evaluate as evaluate_segmentation
from ._files import read_image
from ._surface_files import ENDINGS, read_surface


def evaluate(values: dict[str, Any]) -> None:
    """`flipfree evaluate`."""
    progress = wants_bar(values)
    names = {"segmentation": values["segmentation"], "reference": values["reference"]}
    if "csv" in values:
        require_ending("--csv", values["csv"], (".csv",))
        require_place(values["csv"], list(names.values()))
    label = values.get("label", -1)
    surface = None
    compared: Any
    if names["segmentation"].lower().endswith(ENDINGS):
        compared = surface = read_surface(names["segmentation"])
    else:
        compared = read_image(names["segmentation"], progress=progress)
    try:
        scores = evaluate_segmentation(
            compared,
            read_image(names["reference"], progress=progress),
            segmentation_label=values.get("segmentation_label", label),
            reference_label=values.get("reference_label", label),
            score_voxelization="voxelize" in values,
        )
    except FlipFreeError as error:
        raise type(error)(
            f"'{names['segmentation']}' against '{names['reference']}': {error}"
        ) from error
    if "csv" in values:
        row = {"Segmentation": names["segmentation"], "Reference": names["reference"]}
        row.update((SCORE_COLUMNS[field][0], value) for field, value in asdict(scores).items())
        write_table(values["csv"], list(row), [list(row.values())])
    if "quiet" in values:
        return
    print(score_summary(asdict(scores)), end="")
    if surface is not None:
        print(validity_summary(surface), end="")
