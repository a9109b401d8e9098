"""The Dask scheduler and workers that a cohort runs on: those that exist, or some started here."""

from __future__ import annotations

import contextlib
import logging
import multiprocessing
import os
import socket
import tempfile
from collections.abc import Iterator
from typing import Any

from ._errors import FlipFreeError
from ._extras import needed

# Seconds after which a scheduler that does not answer is taken to be out of reach.
PATIENCE = 10.0
# How long workers may all be gone.
LONELY = "120s"
# Bytes: the interpreter and what it imports; and of each voxel, beside the image and the reference, which are
# read into memory twice while they become arrays.
BASE, PER_VOXEL = 400e6, 24.0


@contextlib.contextmanager
def client_of(
    scheduler: str | None, workers: int, threads: int, voxels: float, volumes: int
) -> Iterator[Any]:
    """A client of the scheduler with this address, or of one with workers of its own."""
    distributed = needed("distributed", "a cohort", "cohort")
    _require_main()
    with contextlib.ExitStack() as stack:
        if scheduler is None:
            count = workers or workers_for(threads, voxels, volumes)
            cluster = stack.enter_context(_local(distributed, count))
            client = distributed.Client(cluster, set_as_default=False)
        else:
            client = _connected(distributed, scheduler)
        stack.callback(client.close)
        _require_same_version(client)
        yield client


def workers_for(threads: int, voxels: float, volumes: int) -> int:
    """As many as processors, memory and the number of volumes allow; `voxels` is that of a volume."""
    processors = (os.cpu_count() or 1) // max(threads, 1)
    memory = needed("psutil", "a cohort", "cohort").virtual_memory().available
    return int(max(1, min(processors, memory // (BASE + PER_VOXEL * voxels), volumes)))


@contextlib.contextmanager
def _local(distributed: Any, count: int) -> Iterator[Any]:
    """Processes on this machine; one that dies is replaced."""
    import dask

    with contextlib.ExitStack() as stack:
        scratch = stack.enter_context(tempfile.TemporaryDirectory(prefix="flipfree-dask-"))
        # A worker gets a volume when it is free; a volume that kills three of them is given up, and so is
        # everything if no worker comes back.
        stack.enter_context(
            dask.config.set(
                {
                    "distributed.scheduler.worker-saturation": 1.0,
                    "distributed.scheduler.allowed-failures": 2,
                    "distributed.scheduler.no-workers-timeout": LONELY,
                }
            )
        )
        try:
            yield stack.enter_context(
                distributed.LocalCluster(
                    n_workers=count,
                    threads_per_worker=1,
                    processes=True,
                    host="127.0.0.1",
                    dashboard_address="127.0.0.1:0",
                    local_directory=scratch,
                    preload=[f"{__package__}._cohort_worker"],
                    silence_logs=logging.CRITICAL,
                )
            )
        except RuntimeError as error:
            if "anny" not in str(error):
                raise
            raise FlipFreeError(f"scheduler: the workers could not be started ({error}).") from error


def _connected(distributed: Any, scheduler: str) -> Any:
    try:
        # A client would try for long where nothing listens, and leave tasks behind.
        if "://" not in scheduler or scheduler.startswith(("tcp://", "tls://")):
            place = distributed.comm.get_address_host_port(scheduler)
            socket.create_connection(place, timeout=PATIENCE).close()
        return distributed.Client(scheduler, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, OverflowError, ImportError) as error:
        raise FlipFreeError(
            f"scheduler: no Dask scheduler answers at '{scheduler}'. Start one there "
            "(dask scheduler), or correct the address (tcp://HOST:PORT)."
        ) from error


def _require_main() -> None:
    """New processes import the program's main module, which must not start a cohort again."""
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise FlipFreeError(
            "cohort: a worker has imported the program that calls it. Put the call below "
            "if __name__ == '__main__':"
        )


def _require_same_version(client: Any) -> None:
    from . import __version__

    def version() -> str:  # sent as it is: the worker may lack the package
        try:
            import flipfree
        except ImportError:
            return "none"
        return str(flipfree.__version__)

    found = client.run(version)
    if not found:
        raise FlipFreeError(
            "scheduler: it has no workers. Start some where FlipFree is installed and the files are: "
            f"dask worker {client.scheduler.address}"
        )
    for worker, other in found.items():
        if other != __version__:
            raise FlipFreeError(
                f"scheduler: its worker {worker} has FlipFree {other}, and here is {__version__}. Install "
                "the same version on both."
            )
