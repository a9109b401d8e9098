"""The organs of many volumes, several at a time, on Dask."""

from __future__ import annotations

import asyncio
import os
import time
import uuid
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ._atomic import replacing, write_table, write_text
from ._cluster import client_of
from ._cohort_files import is_done, record_of
from ._cohort_report import report_of
from ._cohort_table import RESULTS, Row, rows_of
from ._cohort_work import segment_rows
from ._errors import FileError, FlipFreeError
from ._extras import needed, simpleitk
from ._progress import progress_of
from ._types import PathName, ProgressOption

# Groups of rows that are handed to the scheduler at a time.
WINDOW = 500


@dataclass(frozen=True)
class Cohort:
    """What has become of the rows."""

    rows: list[dict[str, Any]]
    """A dictionary per row of the table: its cells, and the results."""
    output: str
    """The folder of cohort.csv, cohort.parquet, report.html and rows/."""
    kept: int
    """Rows that were done before."""
    seconds: float

    @property
    def failed(self) -> list[dict[str, Any]]:
        """The rows without a segmentation; `message` says why."""
        return [row for row in self.rows if row["status"] != "done"]

    @property
    def report(self) -> str:
        """The name of the report, an HTML file."""
        return os.path.join(self.output, "report.html")

    def __str__(self) -> str:
        done = len(self.rows) - len(self.failed) - self.kept
        return (
            f"{len(self.rows)} rows: {done} segmented, {self.kept} kept, {len(self.failed)} failed; "
            f"{self.seconds:.1f} s; see {self.report}"
        )

    def __repr__(self) -> str:
        return f"<Cohort: {self}>"


def cohort(
    table: PathName | Iterable[Mapping[str, Any]],
    output: PathName,
    *,
    scheduler: str | None = None,
    workers: int = 0,
    threads: int = 1,
    progress: ProgressOption = None,
) -> Cohort:
    """Segments the organs that a table lists, with processes of this machine or of a Dask cluster.

    Each row is an organ. Results, scores and messages go to a folder; what is done there already, from
    the same content of the same files with the same parameters, is kept. Needs
    `pip install flipfree[cohort]`.

    table
        The name of a CSV file, a pandas.DataFrame, or a list of dictionaries. Columns: volume (a file
        or a folder of DICOM files), seed_x, seed_y, seed_z and radius (LPS mm); if wanted, case and
        organ (names), reference and reference_label (a label map to compare with), preset, and any
        parameter of segment(). Other columns are handed through. Files are found from the CSV
        file's folder.
    output
        The folder of the results, created if absent: cohort.csv and cohort.parquet, a row per
        row; report.html, with a picture of each; and for each row a folder with its surface, label map
        and picture.
    scheduler
        The address of a Dask scheduler, such as tcp://10.0.0.5:8786. Its workers need the same version
        of FlipFree and the same files under the same names. By default, workers are started here, and
        a worker that dies is replaced.
    workers, threads
        How many workers to start here, by default as many as processors and memory allow, and
        how many threads each of them has.

    A row that fails is a row with a message; errors are raised for the table, the folder and
    the scheduler. The work may be interrupted, and goes on where it was when it is started again.

    >>> import flipfree
    >>> flipfree.cohort([{"volume": "ct.nii.gz", "seed": (1, 2, 3)}], "results")
    Traceback (most recent call last):
      ...
    flipfree.FlipFreeError: 'table' lacks the columns seed_x, seed_y, seed_z, radius; it has volume, seed.
    """
    rows = rows_of(table)
    if threads < 1 or workers < 0:
        raise ValueError(f"threads, workers: {threads}, {workers} will not do; 1, 0 are the least")
    for module in ("distributed", "pyarrow", "matplotlib"):
        needed(module, "a cohort", "cohort")
    folder = _folder(output)
    start = time.perf_counter()
    known = {row.name: record_of(row, folder) for row in rows if is_done(row, folder)}
    missing = [row for row in rows if row.name not in known]
    results: dict[str, Any] = dict(known)
    with progress_of(progress, "cohort") as tell:
        groups = groups_of([row for row in missing if not row.problem])
        # A row that cannot be read as one needs no worker.
        for row in missing:
            if row.problem:
                results.update(_named([row], segment_rows([row], folder, threads)))
        if groups:
            _work(groups, folder, (scheduler, workers, threads), results, tell, len(rows))
    made = Cohort(
        rows=[{**row.cells, **_columns(results[row.name])} for row in rows],
        output=folder,
        kept=len(known),
        seconds=time.perf_counter() - start,
    )
    _write_tables(made)
    return made


def groups_of(rows: list[Row]) -> list[list[Row]]:
    """The rows of each volume, in the table's order."""
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(row.volume, []).append(row)
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
                f"scheduler: it or its workers are lost ({type(error).__name__}). What is done is kept: "
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


def _folder(output: PathName) -> str:
    folder = os.path.abspath(os.fspath(output))
    try:
        os.makedirs(os.path.join(folder, "rows"), exist_ok=True)
    except OSError as error:
        raise FileError(
            f"The folder '{folder}' cannot be created ({error.strerror}). Check the name and the "
            "permissions of its parent folder."
        ) from error
    return folder


def _write_tables(made: Cohort) -> None:
    columns = list(dict.fromkeys(column for row in made.rows for column in row))
    cells = [[row.get(column) for column in columns] for row in made.rows]
    write_table(os.path.join(made.output, "cohort.csv"), columns, cells)
    _write_parquet(os.path.join(made.output, "cohort.parquet"), columns, made.rows)
    write_text(made.report, report_of(made.rows, made.output))


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
