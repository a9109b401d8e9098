"""`flipfree cohort`."""

from __future__ import annotations

import os
import re
import sys
from typing import Any

from ._command import say
from ._command_outputs import wants_bar
from ._errors import FlipFreeError
from ._messages import counted


def cohort(request: Any) -> None:
    """`flipfree cohort`."""
    from ._cohort import cohort as segment_cohort

    result = segment_cohort(
        request.table,
        request.folder,
        scheduler=request.scheduler or None,
        workers=request.workers,
        threads=request.threads,
        progress=wants_bar(request) or None,
    )
    if not request.quiet:
        say(f"{result}\n")
    if result.failed:
        failed = [(n, row) for n, row in enumerate(result.rows, 1) if row["status"] != "done"]
        for number, row in failed[:3]:
            message = re.sub("^row [0-9]+(, |: )", "", " ".join(row["message"].split()))
            print(f"flipfree: error: row {number}: {message}", file=sys.stderr)
        raise FlipFreeError(
            f"{len(failed)} of {counted(len(result.rows), 'row')} failed. Their messages are in "
            f"'{os.path.join(request.folder, 'cohort.csv')}' and in report.html beside it."
        )
