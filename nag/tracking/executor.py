"""Who works blocks out: executors of `concurrent.futures`, by their names."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterator
from concurrent.futures import Executor
from importlib.util import find_spec
from typing import Any

from nag.errors import InputError

NAMES = "processes:N, dask://ADDRESS or mpi"
MOST_PROCESSES = 1024


def check_executor(given: Any) -> None:
    """Make sure that something is an executor or the name of one.

    Raises:
        nag.errors.InputError: if it is not.
    """
    if isinstance(given, str):
        kind, _, rest = given.partition(":")
        if kind == "processes" and rest.isascii() and rest.isdigit():
            if 1 <= int(rest[:9]) <= MOST_PROCESSES:
                return
        elif (kind == "dask" and len(rest) > 2 and rest.startswith("//")) or given == "mpi":
            return
        raise InputError(f"executor: {given[:40]!r} is none; write {NAMES}")
    if given is not None and not callable(getattr(given, "submit", None)):
        raise InputError(
            f"executor: something of type {type(given).__name__} is given; give an executor of "
            f"concurrent.futures, or {NAMES}"
        )


@contextlib.contextmanager
def open_executor(given: Any) -> Iterator[Executor | None]:
    """An executor that is given, or the one of a name, which ends with the block.

    Raises:
        nag.errors.InputError: if it cannot be had; one line.
    """
    if not isinstance(given, str):
        yield given
        return
    kind, _, rest = given.partition(":")
    if kind == "processes":
        from concurrent.futures import ProcessPoolExecutor
        from multiprocessing import get_context

        # Forks of a process with threads may hang.
        context = get_context("spawn")
        pool = ProcessPoolExecutor(int(rest), mp_context=context, initializer=_end_with_parent)
        try:
            yield pool
        finally:
            pool.shutdown(cancel_futures=True)
    elif kind == "dask":
        with _dask(rest[2:]) as executor:
            yield executor
    else:
        with _mpi() as executor:
            yield executor


def _end_with_parent() -> None:
    """In a worker: end when the process that wants its results has ended, and not by Ctrl-C."""
    import os
    import signal
    from multiprocessing import parent_process
    from threading import Thread

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = parent_process()
    assert parent is not None

    def wait() -> None:
        parent.join()
        os._exit(1)

    Thread(target=wait, daemon=True).start()


@contextlib.contextmanager
def _mpi() -> Iterator[Executor]:
    if find_spec("mpi4py") is None:
        raise InputError("executor: mpi needs mpi4py; pip install mpi4py")
    # `python -m mpi4py.futures` has loaded it, and its workers wait. To start some where MPI does
    # not allow it waits for them for ever.
    world = getattr(sys.modules.get("mpi4py.MPI"), "COMM_WORLD", None)
    if world is None or world.Get_size() < 2:
        raise InputError(
            "executor: mpi has no workers here; start with `mpiexec -n N python -m mpi4py.futures "
            "-m nag ...`, N being 2 or more"
        )
    from mpi4py.futures import MPIPoolExecutor

    with MPIPoolExecutor() as executor:
        yield executor


@contextlib.contextmanager
def _dask(address: str) -> Iterator[Executor]:
    try:
        from distributed import Client
    except ImportError:
        raise InputError("executor: dask needs dask; pip install nag[dask]") from None
    where = address if "://" in address else f"tcp://{address}"
    try:
        client = Client(where, timeout=10)
    except (OSError, ValueError) as error:
        raise InputError(f"executor: dask://{address}: no scheduler answers: {error}") from None
    with client:
        yield client.get_executor(pure=False)
