"""What is known of a cohort's rows on the disk, so that work is done once.

A row's folder has the file row.json, written last. It says what the results were made from: the content of
the volume or label map, of the reference and of files of points, seed, points and parameters. A file whose size and
time are still those of then is not read again; any other is.
"""

from __future__ import annotations

import hashlib
import json
import os
from typing import Any

from . import _kernels
from ._atomic import write_text
from ._cohort_table import Row
from ._label_files import TABLE

RECORD = "row.json"
OUTPUTS = {"surface": "surface.vtp", "labels": "labels.nii.gz", "picture": "picture.jpg"}
CENTERLINE = {"centerline": "centerline.vtp"}
SURFACES = {"surfaces": TABLE}

Stamp = dict[str, Any]


def folder_of(row: Row, output: str) -> str:
    """Where the results of a row go."""
    return os.path.join(output, "rows", row.name)


def outputs_of(row: Row) -> dict[str, str]:
    """The files of a row, by the columns that name them."""
    if row.is_label_map:
        return SURFACES
    return {**OUTPUTS, **CENTERLINE} if row.is_vessel else OUTPUTS


def record_of(row: Row, output: str) -> dict[str, Any] | None:
    """What was written last of a row, if it can be read."""
    try:
        with open(os.path.join(folder_of(row, output), RECORD), encoding="utf-8") as file:
            record = json.load(file)
    except (OSError, ValueError):
        return None
    return record if isinstance(record, dict) else None


def is_done(row: Row, output: str) -> bool:
    """Whether the results that are there are those of this row's content."""
    record = record_of(row, output)
    if record is None or record.get("status") != "done" or record.get("request") != request_of(row):
        return False
    folder = folder_of(row, output)
    try:
        sizes = {name: os.path.getsize(os.path.join(folder, name)) for name in record["sizes"]}
        same = all(
            stamp_of(path, record["inputs"][role])["sha256"] == record["inputs"][role]["sha256"]
            for role, path in inputs_of(row).items()
        )
    except (OSError, KeyError, TypeError):
        return False
    return same and sizes == record["sizes"]


def write_record(
    row: Row, output: str, values: dict[str, Any], inputs: dict[str, Stamp], names: list[str]
) -> dict[str, Any]:
    """Writes what there is to know of a row, after its files, which have these names."""
    folder = folder_of(row, output)
    record = {
        **values,
        "request": request_of(row),
        "inputs": inputs,
        "sizes": {name: os.path.getsize(os.path.join(folder, name)) for name in names},
    }
    write_text(os.path.join(folder, RECORD), json.dumps(record, indent=1))
    return record


def inputs_of(row: Row) -> dict[str, str]:
    """The files that a row needs."""
    files = {"volume": row.volume, "reference": row.reference}
    files.update({column: cell for column, cell in row.points.items() if isinstance(cell, str)})
    return {role: path for role, path in files.items() if path}


def request_of(row: Row) -> dict[str, Any]:
    """What is asked for, apart from files."""
    from . import __version__

    # Of a file, its stamp has the content.
    points = {
        column: "file" if isinstance(cell, str) else cell for column, cell in row.points.items()
    }
    # As JSON gives it back.
    request: dict[str, Any] = json.loads(
        json.dumps(
            {
                "version": __version__,
                "seed": row.seed,
                "radius": row.radius,
                "parameters": row.parameters,
                "reference_label": row.reference_label,
                "has_reference": bool(row.reference),
                **({"series": row.series} if row.series else {}),
                **({"is_label_map": True} if row.is_label_map else {}),
                **({"points": points} if points else {}),
            },
            sort_keys=True,
        )
    )
    return request


def stamp_of(path: str, known: Stamp | None = None) -> Stamp:
    """Size, time and content of a file, or of all files of a folder."""
    files = _files_of(path)
    status = [os.stat(file) for file in files]
    size = sum(entry.st_size for entry in status)
    time = max((entry.st_mtime_ns for entry in status), default=0)
    if known is not None and (known.get("size"), known.get("time")) == (size, time):
        return known
    digest = hashlib.sha256()
    for file in files:
        digest.update(f"{os.path.basename(file)}\0".encode() if len(files) > 1 else b"")
        with open(file, "rb") as stream:
            while part := stream.read(1 << 20):
                digest.update(part)
    return {"size": size, "time": time, "sha256": digest.hexdigest()}


def _files_of(path: str) -> list[str]:
    if not os.path.isdir(path):
        return [path]
    return [name for name in _kernels.dicom_files(path) if os.path.isfile(name)]
