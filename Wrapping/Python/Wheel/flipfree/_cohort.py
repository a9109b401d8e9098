"""The organs and vessels of many volumes, several at a time, on Dask."""

from __future__ import annotations

import os
import time
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from ._messages import counted
from ._progress import progress_of
from ._types import PathName, ProgressOption


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
            f"{counted(len(self.rows), 'row')}: {done} segmented, "
            f"{self.kept} kept, {len(self.failed)} failed; "
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
    """Segments the organs and vessels that a table lists, with processes of this machine or of a Dask cluster.

    Each row is an organ, a vessel, or a label map, whose labels get surfaces. Results, scores and
    messages go to a folder; what is done there already, from the same content of the same files with
    the same parameters, is kept. Needs `pip install '.[cohort]'` in the source folder.

    table
        The name of a CSV file, a pandas.DataFrame, or a list of dictionaries. Columns: volume (a file
        or a folder of DICOM files) and, where a folder holds several, series (the UID, as
        flipfree.series() lists them); of an organ seed_x, seed_y, seed_z and radius (LPS mm), and if
        wanted inside, outside and boundary (lists of points, LPS mm: "1 2 3; 4 5 6") and corrections
        (a file of points, .csv or .mrk.json); of a vessel points (a list or a file) in place of all
        of these; of a label map label_map (its file) in place of a volume; if wanted, case and organ
        (names), reference and reference_label (a label map to compare with), preset, and any parameter
        of segment() or trace(), or of surfaces() but only and iterations. Other columns are copied to
        the results. Files are found from the CSV file's folder. In dictionaries, points may be lists of
        (x, y, z) or arrays of shape (n, 3).
    output
        The folder of the results, created if absent: cohort.csv and cohort.parquet, a row per
        row; report.html, with a picture of each; and for each row a folder with its surface, label map
        and picture, and a vessel's centerline; of a label map, the surfaces and their table.
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
    flipfree.FlipFreeError: 'table' lacks the columns seed_x, seed_y, seed_z, radius; it has volume, seed. Vessels have points in their place, and label maps the column label_map.
    """
    for name, number, least in (("threads", threads, 1), ("workers", workers, 0)):
        if number < least:
            raise ValueError(f"{name}: {number} is out of range; the least value is {least}")
    # What it imports would make the package slow to import.
    from ._cohort_run import run_cohort
    from ._cohort_table import rows_of

    rows = rows_of(table)
    start = time.perf_counter()
    with progress_of(progress, "cohort") as tell:
        results, kept = run_cohort(rows, os.fspath(output), (scheduler, workers, threads), tell)
    return Cohort(results, os.path.abspath(output), kept, time.perf_counter() - start)
