"""Calls in processes of their own, each with a limit of processor time.

The system itself ends a process that is over its limit, so that compiled code that runs long is
no obstacle, and a busy machine makes no call slow.
"""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

# A process that neither answers nor uses its time waits for something that does not come.
LONGEST_WAIT = 20
PROCESSES = get_context("spawn")


@dataclass(frozen=True)
class TimedRun:
    """What became of a call.

    Attributes:
        task: its argument.
        value: what it returned; None where it was slow or raised an error.
        seconds: processor time of all its threads; the limit, if it was slow.
        slow: whether it was ended.
        error: type and text of the exception that it raised, or empty.
    """

    task: Any
    value: Any
    seconds: float
    slow: bool = False
    error: str = ""


@dataclass
class _Worker:
    """A process, our end of its pipe, the task it has, its limit, and since when."""

    process: BaseProcess
    pipe: Connection
    task: Any = None
    limit: float = 0.0
    since: float = 0.0

    @classmethod
    def started(cls, work: Callable[[Any], Any], first: Any) -> _Worker:
        ours, theirs = PROCESSES.Pipe()
        process = PROCESSES.Process(target=_serve, args=(theirs, work, first), daemon=True)
        process.start()
        theirs.close()
        return cls(process, ours)

    def give(self, task: Any, limit: float) -> None:
        self.task, self.limit, self.since = task, limit, time.monotonic()
        self.pipe.send((task, limit))

    @property
    def stuck(self) -> bool:
        return time.monotonic() - self.since > LONGEST_WAIT * self.limit

    def end(self) -> None:
        self.process.kill()
        self.process.join()
        self.pipe.close()


def _serve(pipe: Connection, work: Callable[[Any], Any], first: Any) -> None:
    """Work on what comes through ``pipe``; the signal of the timer ends the process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGPROF, signal.SIG_DFL)
    if first is not None:
        work(first)
    while True:
        try:
            task, limit = pipe.recv()
        except EOFError:
            return
        begin, value, error = time.process_time(), None, ""
        signal.setitimer(signal.ITIMER_PROF, limit)
        try:
            value = work(task)
        except Exception as raised:
            error = f"{type(raised).__name__}: {raised}"
        signal.setitimer(signal.ITIMER_PROF, 0)
        try:
            pipe.send((value, time.process_time() - begin, error))
        except BrokenPipeError:
            return


def timed_runs(
    work: Callable[[Any], Any],
    tasks: Iterable[Any],
    *,
    limit: float | Callable[[Any], float],
    jobs: int = 1,
    first: Any = None,
) -> Iterator[TimedRun]:
    """``work(task)`` for all tasks, each result as soon as it is there.

    Args:
        work: a function of a module; it, tasks and results must be picklable.
        tasks: drawn as processes become free.
        limit: seconds of processor time after which a call is ended, for all tasks or for each.
        jobs: number of processes.
        first: a task that each new process does beforehand, which is neither timed nor reported:
            what is loaded on first use is loaded then.
    """
    tasks, workers = iter(tasks), []
    limit_of = limit if callable(limit) else lambda _: limit
    try:
        for task in tasks:
            workers.append(_Worker.started(work, first))
            workers[-1].give(task, limit_of(task))
            if len(workers) == jobs:
                break
        while workers:
            ready = wait([w.pipe for w in workers], timeout=1.0)
            for k, worker in reversed(list(enumerate(workers))):
                stuck = worker.stuck
                if worker.pipe not in ready and not stuck:
                    continue
                run = _receive_run(worker, stuck)
                yield run
                if run.slow:
                    worker.end()
                    workers[k] = worker = _Worker.started(work, first)
                task = next(tasks, _receive_run)
                if task is _receive_run:
                    worker.end()
                    del workers[k]
                else:
                    worker.give(task, limit_of(task))
    finally:
        for worker in workers:
            worker.end()


def _receive_run(worker: _Worker, stuck: bool) -> TimedRun:
    limit = worker.limit
    try:
        if stuck:
            return TimedRun(worker.task, None, limit, slow=True)
        value, seconds, error = worker.pipe.recv()
    except (EOFError, ConnectionResetError):
        worker.process.join()
        if worker.process.exitcode == -signal.SIGPROF:
            return TimedRun(worker.task, None, limit, slow=True)
        code = worker.process.exitcode
        return TimedRun(worker.task, None, limit, slow=True, error=f"the process ended with {code}")
    return TimedRun(worker.task, value, seconds, error=error)
