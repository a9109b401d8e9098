"""`flipfree evaluate`."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from ._atomic import write_table
from ._backend import SCORE_COLUMNS, score_summary, validity_summary
from ._command_outputs import require_ending, require_place
from ._errors import FlipFreeError
from ._evaluate import evaluate as evaluate_segmentation
from ._image_files import read_labels
from ._surface_files import ENDINGS, read_surface


def evaluate(values: dict[str, Any]) -> None:
    """`flipfree evaluate`."""
    names = {"segmentation": values["segmentation"], "reference": values["reference"]}
    if "csv" in values:
        require_ending("--csv", values["csv"], (".csv",))
        require_place(values["csv"], list(names.values()))
    label = values.get("label", "")
    labels: dict[str, int] = {}

    def read(name: str) -> Any:
        image, value = read_labels(names[name], values.get(f"{name}_label", label))
        if value is not None:
            labels[f"{name}_label"] = value
        return image

    surface = None
    compared: Any
    if names["segmentation"].lower().endswith(ENDINGS):
        compared = surface = read_surface(names["segmentation"])
    else:
        compared = read("segmentation")
    reference = read("reference")
    try:
        scores = evaluate_segmentation(
            compared, reference, **labels, score_voxelization="voxelize" in values
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
