"""Work cut into blocks: found in a ledger, worked out here, or elsewhere.

A block is a pure function of its arguments, and their size depends on the problem alone. So it does
not matter where and when a block is worked out, nor by how many.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextvars import ContextVar
from dataclasses import dataclass
from itertools import islice
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    from nag.tracking.ledger import Arrays, Ledger
    from nag.tracking.run import Run

# Blocks that are in memory at once, in this process alone and with an executor.
ALONE, SHARED = 8, 256
T = TypeVar("T")
# A function of a block's arguments and of a number of threads, to arrays.
Work = Callable[..., Any]


@dataclass(eq=False)
class Engine:
    """Where blocks are kept, and who works them out.

    Attributes:
        ledger: None where nothing is kept.
        executor: one of `concurrent.futures`, or None: this process alone.
        tell: called with a stage, the number of blocks done, and of all.
    """

    ledger: Ledger | None
    executor: Executor | None
    tell: Callable[[str, int, int], None] | None = None


@contextlib.contextmanager
def open_engine(
    resume: Any, executor: Any, tell: Callable[[str, int, int], None] | None = None
) -> Iterator[Engine | None]:
    """Have all work inside kept in a folder, and shared by an executor; neither need be.

    Args:
        resume: the ledger's folder, or None.
        executor: see `nag.tracking.executor.open_executor`.
        tell: see `Engine`.

    Raises:
        nag.errors.InputError: if there can be no ledger there, or no such executor.
    """
    if (resume is None and executor is None) or _engine.get() is not None:
        yield None
        return
    from nag.tracking.executor import check_executor, open_executor
    from nag.tracking.ledger import Ledger

    check_executor(executor)
    ledger = None if resume is None else Ledger.open(resume)
    with open_executor(executor) as opened:
        made = Engine(ledger, opened, tell)
        token = _engine.set(made)
        try:
            yield made
        finally:
            _engine.reset(token)


_engine: ContextVar[Engine | None] = ContextVar("engine", default=None)
_told: ContextVar[Callable[[str, int, int], None] | None] = ContextVar("told", default=None)


def in_blocks() -> bool:
    """Whether work is to be cut into blocks at all: only where someone keeps or shares them."""
    return _engine.get() is not None


def at_once() -> int:
    """How many blocks are worked out before the next ones are made; answers do not depend on it.

    What is to be shared is more than what there are workers for.
    """
    chosen = _engine.get()
    return SHARED if chosen is not None and chosen.executor is not None else ALONE


def work_out(
    work: Work,
    calls: Sequence[tuple[Any, ...]],
    stage: str,
    threads: int = 1,
    told: Callable[[int], None] | None = None,
) -> list[tuple[Arrays, bool]]:
    """Results of a function for several arguments, in their order, and which were made here.

    Args:
        work: a function of a module, so that other processes know it.
        calls: its arguments, see `nag.tracking.ledger.add_content`.
        stage: what it is called where progress is told.
        threads: of what is worked out here.
        told: called with the number of calls that are done, instead of the engine's ``tell``.
    """
    from nag.tracking.ledger import key_of

    chosen = _engine.get()
    assert chosen is not None
    results: list[tuple[Arrays, bool] | None] = [None] * len(calls)
    keys: list[bytes] = []
    if chosen.ledger is not None:
        keys = [key_of(work, call) for call in calls]
        for k, key in enumerate(keys):
            found = chosen.ledger.find(key)
            results[k] = None if found is None else (found, False)
    missing = [k for k, result in enumerate(results) if result is None]
    done = len(calls) - len(missing)
    for k, arrays, here in _results(chosen, work, calls, missing, threads):
        if chosen.ledger is not None:
            chosen.ledger.keep(keys[k], arrays)
        results[k] = arrays, here
        done += 1
        if told is not None:
            told(done)
        elif chosen.tell is not None and len(calls) > 1:
            chosen.tell(f"{stage}, blocks", done, len(calls))
    return [result for result in results if result is not None]


def share(
    work: Work, calls: Iterable[tuple[Any, ...]], sizes: Sequence[int], stage: str
) -> Iterator[Arrays]:
    """Results of a function for several arguments, in their order, few of them in memory.

    They are kept or shared where someone does; a single call is worked out in less time.

    Args:
        work, stage: see `work_out`.
        calls: each made when it is needed.
        sizes: for each of them how many points it is of, which are told.
    """
    chosen, count = _engine.get(), len(sizes)
    if chosen is None or count < 2:
        for k, call in enumerate(calls):
            yield work(*call)
            tell(stage, sum(sizes[: k + 1]), sum(sizes))
        return
    left = iter(calls)
    for first in range(0, count, at_once()):

        def told(done: int, first: int = first) -> None:
            if chosen.tell is not None:
                chosen.tell(stage, sum(sizes[: first + done]), sum(sizes))

        some = list(islice(left, at_once()))
        yield from (found for found, _ in work_out(work, some, stage, 1, told))


@contextlib.contextmanager
def tell_proofs_to(progress: Callable[[str, int, int], None] | None) -> Iterator[None]:
    """Have what is proved inside told of, where no run is given to it."""
    token = _told.set(progress)
    try:
        yield
    finally:
        _told.reset(token)


def tell(stage: str, done: int, total: int) -> None:
    """Tell of a proof's step ``done`` of ``total`` whoever wants to hear of it."""
    told = _told.get()
    if told is not None:
        told(stage, done, total)


def keep_result(
    work: Callable[..., T],
    call: tuple[Any, ...],
    run: Run,
    pack: Callable[[T], Arrays],
    unpack: Callable[[Arrays], T],
) -> T:
    """A result that is found where it was kept, or worked out here, in blocks where these are.

    Args:
        work: a function of ``call`` and a run, on whose seed and settings alone it depends.
        call: its arguments, see `nag.tracking.ledger.add_content`.
        pack, unpack: what makes a block of the result, and the equal result of the block.
    """
    from nag.tracking.ledger import key_of

    chosen = _engine.get()
    if chosen is None or chosen.ledger is None:
        return work(*call, run)
    key = key_of(work, (*call, run.seed, run.settings))
    found = chosen.ledger.find(key)
    if found is not None:
        return unpack(found)
    result = work(*call, run)
    chosen.ledger.keep(key, pack(result))
    return result


def _results(
    chosen: Engine,
    work: Work,
    calls: Sequence[tuple[Any, ...]],
    missing: Sequence[int],
    threads: int,
) -> Iterator[tuple[int, Arrays, bool]]:
    """Blocks as they are done, and whether here; what is lost elsewhere is worked out here."""
    from concurrent.futures import BrokenExecutor, as_completed

    left = list(missing)
    if chosen.executor is not None and len(missing) > 1:
        futures: dict[Future[Arrays], int] = {}
        try:
            for k in missing:
                futures[chosen.executor.submit(_alone, work, calls[k])] = k
        except (BrokenExecutor, RuntimeError):
            # What was taken before that may still come.
            chosen.executor = None
        try:
            for future in as_completed(futures):
                error = future.exception()
                if error is None:
                    left.remove(futures[future])
                    yield futures[future], future.result(), False
                elif not _is_lost(error):
                    raise error
                elif isinstance(error, BrokenExecutor):
                    chosen.executor = None
        except BaseException:
            for future in futures:
                future.cancel()
            raise
    for k in left:
        # A block is not cut into further ones.
        token = _engine.set(None)
        try:
            arrays = work(*calls[k], threads=threads)
        finally:
            _engine.reset(token)
        yield k, arrays, True


def _alone(work: Work, call: tuple[Any, ...]) -> Arrays:
    """A block in another process."""
    return work(*call, threads=1)


def _is_lost(error: BaseException) -> bool:
    """Whether a worker was lost, and not the work: no one else's classes need be imported."""
    names = {kind.__name__ for kind in type(error).__mro__}
    return bool(names & {"BrokenExecutor", "KilledWorker", "CancelledError", "CommClosedError"})
