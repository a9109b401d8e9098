"""What a worker does: all rows of one volume, which is read once."""

from __future__ import annotations

import contextlib
import math
import os
import re
import socket
import time
import warnings
from collections.abc import Iterator
from typing import Any

from ._atomic import replacing
from ._backend import set_threads
from ._cohort_files import (
    Stamp,
    folder_of,
    inputs_of,
    is_done,
    outputs_of,
    record_of,
    stamp_of,
    write_record,
)
from ._cohort_points import corrections_of, vessel_of
from ._cohort_table import SCORES, Row
from ._errors import FlipFreeError, FlipFreeWarning
from ._evaluate import evaluate
from ._files import read_image, write_image
from ._image import Image
from ._image_files import read_labels
from ._label_files import write_label_surfaces
from ._picture import write_picture
from ._segment import segment
from ._segmentation import Segmentation, Vessel
from ._surface_files import write_centerline, write_surface
from ._surfaces import surfaces as make_surfaces
from ._trace import trace

# Side of a row's picture, in pixels.
PICTURE = 640


def segment_rows(rows: list[Row], output: str, threads: int) -> list[dict[str, Any]]:
    """Segments the rows of a volume that are not done yet, and gives what is known of each."""
    set_threads(threads)
    volume = _Volume()
    return [_known(row, output) or _segmented(row, output, volume) for row in rows]


class _Volume:
    """An image that is read when it is needed first; the worker keeps one at a time."""

    def __init__(self) -> None:
        self.image: Image | None = None
        self.stamp: Stamp = {}
        self.seconds = 0.0

    def read(self, row: Row) -> Image:
        if self.image is None:
            start = time.perf_counter()
            if row.is_label_map:
                with _said_of(row, "column label_map"):
                    self.image, _ = read_labels(row.volume, "")
            else:
                with _said_of(row, "columns volume and series" if row.series else "column volume"):
                    self.image = read_image(row.volume, series=row.series or None)
            self.stamp = stamp_of(row.volume)
            self.seconds = time.perf_counter() - start
        return self.image


def _known(row: Row, output: str) -> dict[str, Any] | None:
    """A worker that died may have finished this row."""
    return record_of(row, output) if is_done(row, output) else None


def _segmented(row: Row, output: str, volume: _Volume) -> dict[str, Any]:
    """Does a row; whatever goes wrong is said in its message."""
    values: dict[str, Any] = {
        "status": "failed",
        "message": row.problem,
        "worker": f"{socket.gethostname()}:{os.getpid()}",
    }
    inputs: dict[str, Stamp] = {}
    files: list[str] = []
    start = time.perf_counter()
    try:
        if not row.problem:
            os.makedirs(folder_of(row, output), exist_ok=True)
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always", FlipFreeWarning)
                image = volume.read(row)
                # Before they are read: what changes later is another content. One that is not there is
                # an error then.
                inputs = {
                    role: stamp_of(path)
                    for role, path in inputs_of(row).items()
                    if role != "volume" and os.path.exists(path)
                }
                results, files = (_surfaces if row.is_label_map else _results)(row, output, image)
                values.update(results)
            inputs["volume"] = volume.stamp
            values["message"] = "; ".join(str(entry.message) for entry in caught)
            values["status"] = "done"
    except MemoryError:
        values["message"] = "out of memory; give the workers more, or start fewer of them"
    except (FlipFreeError, TypeError, ValueError) as error:
        values["message"] = " ".join(str(error).split())
    except Exception as error:  # pylint: disable=broad-except
        values["message"] = f"{type(error).__name__}: {' '.join(str(error).split())}"
    values["seconds_reading"] = round(volume.seconds, 3)
    values["seconds"] = round(time.perf_counter() - start, 3)
    earlier = _files_there(row, output)
    if values["status"] == "done":
        _remove(earlier, files, folder_of(row, output))
    else:
        files = earlier  # so that the next results know of them
    return _recorded(row, output, values, inputs, files)


def _files_there(row: Row, output: str) -> list[str]:
    """Those of earlier results."""
    sizes = (record_of(row, output) or {}).get("sizes") or ()
    folder = folder_of(row, output)
    return [name for name in map(os.path.basename, sizes) if os.path.isfile(os.path.join(folder, name))]


def _remove(earlier: list[str], files: list[str], folder: str) -> None:
    """Of the earlier files those that the new ones do not replace; their names may differ in case alone."""
    kept = {name.lower() for name in files}
    for name in earlier:
        if name.lower() not in kept:
            with contextlib.suppress(OSError):
                os.remove(os.path.join(folder, name))


def _surfaces(row: Row, output: str, image: Image) -> tuple[dict[str, Any], list[str]]:
    """What is known of the surfaces of a label map, and the names of their files."""
    with _said_of(row):
        found = make_surfaces(image, **row.parameters)
    files = write_label_surfaces(found, folder_of(row, output), "stl")
    volume = sum(measures.volume for measures in found.labels.values())
    return {"segmented_ml": round(volume, 3), **_names(row)}, files


def _results(row: Row, output: str, image: Image) -> tuple[dict[str, Any], list[str]]:
    """What is known of an organ or a vessel, and the names of its files."""
    organ = _found(row, image)
    values: dict[str, Any] = {
        "series_read": image.series or None,
        # Which is about organs; rounded down as in the warning.
        "confidence": None if row.is_vessel else math.floor(1e4 * organ.confidence) / 1e4,
        "questions": None if row.is_vessel else len(organ.questions),
        "first_question": _first_place(organ),
        "segmented_ml": round(organ.volume, 3),
        "iterations": len(organ.iterations["Iteration"]),
        "stop_reason": organ.stop_reason,
        "self_intersections": organ.self_intersections,
    }
    if row.reference:
        with _said_of(row, "column reference" if row.reference_label < 0 else "columns reference and reference_label"):
            scores = evaluate(organ, row.reference, reference_label=row.reference_label)
        values.update(
            (column, round(getattr(scores, field), 4 if column.endswith("_mm") else 6))
            for field, column in SCORES.items()
        )
    _write(row, output, image, organ)
    return {**values, **_names(row)}, list(outputs_of(row).values())


def _names(row: Row) -> dict[str, str]:
    """Of its files, by the columns that name them."""
    return {role: f"rows/{row.name}/{name}" for role, name in outputs_of(row).items()}


def _first_place(organ: Segmentation) -> str | None:
    """As the columns inside and outside take points."""
    if not organ.questions:
        return None
    return " ".join(f"{x:.6g}" for x in organ.questions[0].place)


def _found(row: Row, image: Image) -> Segmentation:
    try:
        points = vessel_of(row.points["points"]) if row.is_vessel else []
        corrections = {} if row.is_vessel else corrections_of(row.points)
    except ValueError as error:
        raise FlipFreeError(f"row {row.number}, column {error}") from error
    with _said_of(row):
        if row.is_vessel:
            return trace(image, points, **row.parameters)
        return segment(image, row.seed, row.radius, **corrections, **row.parameters)


@contextlib.contextmanager
def _said_of(row: Row, columns: str = "") -> Iterator[None]:
    """What goes wrong is said of the row and of the columns in which it can be mended."""
    try:
        yield
    except (FlipFreeError, TypeError, ValueError) as error:
        text = str(error)
        place = columns or _columns_of(row, text)
        # Such a message begins with the column's name itself.
        separator = " " if place == "column" else ": "
        raise FlipFreeError(f"row {row.number}{f', {place}' if place else ''}{separator}{text}") from error


def _columns_of(row: Row, text: str) -> str:
    """Those that a message of segment() or trace() is about; empty where it does not say."""
    if text.partition(":")[0] in row.parameters:
        return "column"
    if re.search(r"\bthe seed\b", text):
        return "columns seed_x, seed_y, seed_z and radius"
    if row.is_label_map:
        return "column label_map"
    kinds = [kind for kind in ("inside", "outside", "boundary") if f"the {kind} point" in text]
    return f"column {kinds[0]}" if kinds else "column points" if row.is_vessel else ""


def _write(row: Row, output: str, image: Image, organ: Segmentation) -> None:
    """All files or none."""
    with contextlib.ExitStack() as files:
        paths = {
            role: files.enter_context(replacing(os.path.join(folder_of(row, output), name)))
            for role, name in outputs_of(row).items()
        }
        write_surface(organ, paths["surface"])
        write_image(organ.label_map, paths["labels"])
        write_picture(paths["picture"], image, organ, PICTURE)
        if isinstance(organ, Vessel):
            write_centerline(organ, paths["centerline"])


def _recorded(
    row: Row, output: str, values: dict[str, Any], inputs: dict[str, Stamp], files: list[str]
) -> dict[str, Any]:
    try:
        os.makedirs(folder_of(row, output), exist_ok=True)
        return write_record(row, output, values, inputs, files)
    except OSError as error:
        return {**values, "status": "failed", "message": values["message"] or str(error)}
