"""Runs a cohort: hands volumes to Dask's workers, and writes tables and report of what comes back."""

from __future__ import annotations

import asyncio
import os
import uuid
from collections.abc import Callable, Iterator
from typing import Any

from ._atomic import make_folder, replacing, write_table, write_text
from ._cluster import client_of
from ._cohort_files import is_done, record_of
from ._cohort_report import report_of
from ._cohort_table import RESULTS, Row
from ._cohort_work import segment_rows
from ._errors import FlipFreeError
from ._extras import needed, simpleitk

# Groups of rows that are handed to the scheduler at a time.
WINDOW = 500


def run_cohort(
    rows: list[Row],
    output: str,
    resources: tuple[str | None, int, int],
    tell: Callable[[float], None] | None,
) -> tuple[list[dict[str, Any]], int]:
    """The cells and results of all rows, which are on the disk, too; and how many were done before.

    Resources are the scheduler's address, if any, the number of workers and the threads of each.
    """
    for module in ("distributed", "pyarrow", "matplotlib"):
        needed(module, "a cohort", "cohort")
    folder = _folder(output)
    known = {row.name: record_of(row, folder) for row in rows if is_done(row, folder)}
    missing = [row for row in rows if row.name not in known]
    results: dict[str, Any] = dict(known)
    # A row that cannot be read as one needs no worker.
    wrong = [row for row in missing if row.problem]
    results.update(_named(wrong, segment_rows(wrong, folder, 1)))
    groups = groups_of([row for row in missing if not row.problem])
    if groups:
        _work(groups, folder, resources, results, tell, len(rows))
    made = [{**row.cells, **_columns(results[row.name])} for row in rows]
    _write_tables(made, folder)
    return made, len(known)


def groups_of(rows: list[Row]) -> list[list[Row]]:
    """The rows of each volume, in the table's order."""
    groups: dict[tuple[bool, str, str], list[Row]] = {}
    for row in rows:
        groups.setdefault((row.is_label_map, row.volume, row.series), []).append(row)
    return list(groups.values())


def _work(
    groups: list[list[Row]],
    folder: str,
    resources: tuple[str | None, int, int],
    results: dict[str, Any],
    tell: Callable[[float], None] | None,
    total: int,
) -> None:
    """Fills in the results of the groups as they come."""
    scheduler, workers, threads = resources
    voxels = _most_voxels(groups) if scheduler is None and not workers else 0.0
    with client_of(scheduler, workers, threads, voxels, len(groups)) as client:
        for rows, answers in _answers(client, groups, folder, threads):
            results.update(_named(rows, answers))
            if tell is not None:
                tell(len(results) / total)


def _answers(
    client: Any, groups: list[list[Row]], folder: str, threads: int
) -> Iterator[tuple[list[Row], list[dict[str, Any]]]]:
    """The rows of each group and what has become of them, in the order in which they are ready."""
    distributed = needed("distributed", "a cohort", "cohort")
    waiting = iter(groups)
    running: dict[Any, list[Row]] = {}
    ready = distributed.as_completed(loop=client.loop)

    def submit(rows: list[Row]) -> None:
        key = f"flipfree-{rows[0].name}-{uuid.uuid4().hex}"
        future = client.submit(segment_rows, rows, folder, threads, key=key, pure=False)
        running[future] = rows
        ready.add(future)

    for rows, _ in zip(waiting, range(WINDOW)):
        submit(rows)
    for future in ready:
        rows = running.pop(future)
        following = next(waiting, None)
        if following is not None:
            submit(following)
        try:
            yield rows, future.result()
        except distributed.KilledWorker:
            if len(rows) == 1:
                yield rows, [_killed(rows[0], folder)]
            # One of them did it, and the others are innocent.
            for row in rows if len(rows) > 1 else ():
                submit([row])
        # Rows catch what is wrong with them; this is of the scheduler.
        except (Exception, asyncio.CancelledError) as error:
            raise FlipFreeError(
                f"scheduler: it or its workers are lost ({type(error).__name__}). Finished rows are kept: "
                "start the cohort again."
            ) from error


def _killed(row: Row, folder: str) -> dict[str, Any]:
    message = (
        "the workers that did this row died, probably for lack of memory; start fewer workers, or crop "
        "the volume"
    )
    if is_done(row, folder):
        return record_of(row, folder) or {}
    return {"status": "failed", "message": message}


def _named(rows: list[Row], answers: list[dict[str, Any]]) -> dict[str, Any]:
    return {row.name: answer for row, answer in zip(rows, answers)}


def _columns(record: dict[str, Any]) -> dict[str, Any]:
    return {name: record.get(name) for name in RESULTS}


def _most_voxels(groups: list[list[Row]]) -> float:
    """Of the largest volume; one that cannot be read will be a row with a message."""
    reader = simpleitk(groups[0][0].volume).ImageFileReader()
    most = 0.0
    for rows in groups:
        name = rows[0].volume
        if os.path.isdir(name):
            size = sum(entry.stat().st_size for entry in os.scandir(name)) / 2
        else:
            reader.SetFileName(name)
            try:
                reader.ReadImageInformation()
            except RuntimeError:
                continue
            size = 1.0
            for count in reader.GetSize():
                size *= count
        most = max(most, size)
    return most


def _folder(output: str) -> str:
    folder = os.path.abspath(output)
    make_folder(folder)
    make_folder(os.path.join(folder, "rows"))
    return folder


def _write_tables(rows: list[dict[str, Any]], folder: str) -> None:
    columns = list(dict.fromkeys(column for row in rows for column in row))
    cells = [[row.get(column) for column in columns] for row in rows]
    write_table(os.path.join(folder, "cohort.csv"), columns, cells)
    _write_parquet(os.path.join(folder, "cohort.parquet"), columns, rows)
    write_text(os.path.join(folder, "report.html"), report_of(rows, folder))


def _write_parquet(path: str, columns: list[str], rows: list[dict[str, Any]]) -> None:
    """Cells of the given table are text there, too."""
    arrow = needed("pyarrow", "a cohort", "cohort")
    parquet = needed("pyarrow.parquet", "a cohort", "cohort")
    kinds = {str: arrow.string(), int: arrow.int64(), float: arrow.float64()}
    table = arrow.table(
        {
            column: arrow.array([row.get(column) for row in rows], kinds[RESULTS.get(column, str)])
            for column in columns
        }
    )
    with replacing(path) as temporary:
        parquet.write_table(table, temporary)
