"""What Dask runs in each worker that a cohort starts on its own machine, before any work."""

from __future__ import annotations

import signal
from typing import Any


def dask_setup(worker: Any) -> None:
    """Ctrl-C is for the program that started the workers; it ends them."""
    del worker
    signal.signal(signal.SIGINT, signal.SIG_IGN)
