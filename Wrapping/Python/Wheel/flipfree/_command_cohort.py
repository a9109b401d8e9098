"""`flipfree cohort`."""

from __future__ import annotations

import os
import re
import sys
from typing import Any

from ._command_inputs import wants_bar
from ._errors import FlipFreeError
from ._options import WrongUsage


def _rows(count: int) -> str:
    return f"{count} {'row' if count == 1 else 'rows'}"


def cohort(values: dict[str, Any]) -> None:
    """`flipfree cohort`."""
    from ._cohort import cohort as segment_cohort

    results = os.path.join(values["output"], "cohort.csv")
    if os.path.realpath(results) == os.path.realpath(values["table"]):
        raise WrongUsage(
            f"'{values['table']}' is an input, which would be overwritten. Give --output another folder"
        )
    result = segment_cohort(
        values["table"],
        values["output"],
        scheduler=values.get("scheduler"),
        workers=values.get("workers", 0),
        threads=values.get("threads", 1),
        progress=wants_bar(values) or None,
    )
    if "quiet" not in values:
        print(result)
    if result.failed:
        failed = [(n, row) for n, row in enumerate(result.rows, 1) if row["status"] != "done"]
        for number, row in failed[:3]:
            message = re.sub("^row [0-9]+(, |: )", "", " ".join(row["message"].split()))
            print(f"flipfree: error: row {number}: {message}", file=sys.stderr)
        raise FlipFreeError(
            f"{len(failed)} of {_rows(len(result.rows))} failed. Their messages are in "
            f"'{os.path.join(values['output'], 'cohort.csv')}' and in report.html beside it."
        )
