"""The workers of a Dask cluster, one that is there or one of our own, as an executor."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager
from importlib import import_module
from typing import Any

from lipdb.errors import InputError, MissingToolError

LOCAL = "local"
PATIENCE = 30  # Seconds that the first worker may take to come.


@contextmanager
def dask_executor(scheduler: str, count: int) -> Iterator[tuple[Executor, int]]:
    """An executor of the cluster at *scheduler* and how many tasks it does at once; ``local`` makes a cluster of *count* processes.

    Dask starts a worker that was killed again, and gives its tasks to others. Raises `InputError` when nobody answers.
    """
    try:
        distributed: Any = import_module("distributed")
    except ImportError as error:
        raise MissingToolError("dask: not installed; run: pip install 'lipdb[dask]'") from error
    with ExitStack() as stack:
        try:
            if scheduler == LOCAL:
                # One task at a time a process: each has one espeak.
                cluster = distributed.LocalCluster(
                    n_workers=count, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs="CRITICAL"
                )
                stack.enter_context(cluster)
                client = stack.enter_context(distributed.Client(cluster))
            else:
                client = stack.enter_context(distributed.Client(scheduler, timeout=PATIENCE))
            client.wait_for_workers(1, timeout=PATIENCE)
        except (OSError, ValueError, TimeoutError) as error:
            raise InputError(f"{scheduler}: no Dask cluster answers ({error}); give tcp://host:port of its scheduler, or local") from error
        # pure: the same part twice is the same task to Dask; here every task is counted once, whatever it holds.
        executor = client.get_executor(pure=False)
        stack.callback(executor.shutdown, wait=False)
        yield executor, sum(client.nthreads().values())
