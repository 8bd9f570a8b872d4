"""How something is to be worked out: random numbers, threads, accuracy, who hears of progress."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from enum import IntEnum
from functools import wraps
from os import PathLike
from typing import Any, TypeVar
from warnings import warn

import numpy as np

from nag.algebra.given import check_declared, check_running, check_size, check_type
from nag.errors import NagError
from nag.numerics.linear_algebra_threads import one_thread
from nag.text.progress_line import progress_line
from nag.tracking.settings import Settings

# Called with a stage's name, the step reached and the number of steps; 0 if that is not known.
Progress = Callable[[str, int, int], None]
# Called with an answer that is not complete yet, of what is known so far; and what it says of that.
ENDED_EARLY = "the work was ended early: this is what was known by then"
UNFINISHED = f"{ENDED_EARLY}, some of it perhaps twice and multiplicities perhaps too low"
Found = Callable[[Any], None]
# Seconds between two times that what grows is told of, at least.
BETWEEN = 1.0


class Stream(IntEnum):
    """The parts of the work that draw random numbers of their own: each is one part's alone."""

    MEMBERSHIP = 1
    MOVING_SLICE = 2
    DECOMPOSITION = 3
    PROJECTION = 4
    INTERSECTION = 5
    COMMON_SLICES = 6
    DISCOVERY = 7
    NULL_SPACES_OF_MEMBERS = 8
    GENUS = 9
    DISCRIMINANT = 10
    GIVEN_POINTS = 11
    BRANCHES = 12
    SWEEP = 13
    REAL_SAMPLES = 14
    MIRROR_IMAGES = 17
    REAL_ASSEMBLIES = 19
    ALL_AT_ONCE = 23
    TURNS = 31
    PARALLEL_ROBOT = 41
    MODE_POSES = 42
    REAL_POSES = 43
    MODE_CLOUD = 44
    MODE_SAMPLES = 45
    MOVING_PARTS = 46
    FIBRE_PRODUCT = 47
    BESIDE_SINGULAR = 48
    REAL_PIECE_AT_POINT = 49
    BODY_CLOUD = 50
    LEG_WAYS = 51
    POSE_MODEL = 52
    SAMPLING = 53
    ELIMINATION = 54
    PLOTTED_CLOUD = 55
    SINGULAR_POINTS = 56
    NULL_SPACES = 57
    REAL_POINTS = 58
    SINGULAR_MEMBERS = 59
    BONDS = 60
    GENERIC_POINTS = 61
    REAL_CURVE = 62
    GROWTH = 63
    REAL_PIECES = 64
    CRITICAL_POINTS = 65
    REACHED_POSE = 66
    CERTIFIED_LOOPS = 67
    CERTIFIED_PATHS = 68
    TRACE = 69
    TRIED_PATHS = 70


@dataclass(frozen=True)
class Run:
    """How something is to be worked out; the same run gives the same answer, byte for byte.

    Attributes:
        seed: of the random numbers.
        threads: for path tracking; answers do not depend on them.
        settings: ``"fast"``, ``"default"`` or ``"careful"`` tracking, or settings of one's own.
        progress: called with a stage's name, the step reached and the number of steps. What stands
            behind a semicolon in the name says how it goes: paths whose ends are still open. With
            True a line with a bar shows it, in a notebook as an output of the cell.
        found: called now and then with what is known already, an incomplete answer, for whoever
            ends the work early: by `nag.decompose`, `nag.solve`, `nag.solve_family`, `nag.motion`,
            `nag.driven_motion`, `nag.modes` and `nag.mobility`; by `nag.solve_family` and
            `nag.driven_motion` when they are interrupted, too.
        resume: a folder in which finished blocks of work are kept, and found again by whoever asks
            the same; answers do not depend on it.
        executor: who works blocks out: an executor of `concurrent.futures`, or ``"processes:4"``,
            ``"dask://ADDRESS"``, ``"mpi"``; answers do not depend on it.
        time_limit: seconds after which the work is ended. `nag.decompose` and `nag.solve` return
            what they have told by ``found`` then, an incomplete answer; where there is nothing, and
            elsewhere, `nag.TimeLimitError` is raised. The work is done in a process of its own,
            which takes a second or two to start.

    Raises:
        nag.NagError: if one makes no sense; the message says which, and what would.

    >>> import nag
    >>> careful = nag.Run(seed=3, settings="careful")
    >>> nag.decompose("x^2 = y^2", run=careful) == nag.decompose("x^2 = y^2", **careful.short)
    True
    """

    seed: int = 0
    threads: int = 1
    settings: Settings | str = "default"
    progress: Progress | bool | None = None
    found: Found | None = None
    resume: str | PathLike[str] | None = None
    executor: Any = None
    time_limit: float | None = None

    def __post_init__(self) -> None:
        check_running(self.seed, self.threads, self.settings, self.progress)
        if self.found is not None and not callable(self.found):
            raise NagError(f"found: {type(self.found).__name__} is given; give a function")
        if self.resume is not None and not isinstance(self.resume, str | PathLike):
            raise NagError(f"resume: {type(self.resume).__name__} is given; give a folder")
        if self.executor is not None:
            from nag.tracking.executor import check_executor

            check_executor(self.executor)
        if self.time_limit is not None:
            check_size(self.time_limit, "time_limit")
        object.__setattr__(self, "seed", int(self.seed))
        object.__setattr__(self, "threads", int(self.threads))

    @property
    def without_found(self) -> Run:
        """The same for a part of the work, whose answers are not those that are asked for."""
        return self if self.found is None else replace(self, found=None)

    def convert_found(self, answer_of: Callable[[Any], Any]) -> Run:
        """The same for what leads to the answer, which ``answer_of`` makes of what that tells."""
        tell = self.found
        return self if tell is None else replace(self, found=lambda part: tell(answer_of(part)))

    @property
    def short(self) -> dict[str, Any]:
        """The fields by their names, as calls take them one by one."""
        return {each.name: getattr(self, each.name) for each in fields(self)}

    @property
    def name(self) -> str:
        """The name of the settings."""
        return self.settings if isinstance(self.settings, str) else "custom"

    def random(self, *stream: int) -> np.random.Generator:
        """The random numbers of a part of the work, by its `Stream` and numbers of its own."""
        return np.random.default_rng([self.seed, *stream] if stream else self.seed)

    def tell(self, stage: str, done: int, total: int) -> None:
        """Tell of the step ``done`` of ``total``; 0 if their number is not known."""
        if callable(self.progress):
            self.progress(stage, done, total)


class TellFound:
    """Tells of an answer that grows, now and then, to whoever ends the work early.

    To make and to keep it takes time, a tenth of the whole at the most; so what was found last is
    not told of at once. An interruption inside the block has it told before it ends the work.
    """

    def __init__(self, run: Run, make_answer: Callable[[], Any]) -> None:
        self._found, self._make_answer = run.found, make_answer
        self._next, self._untold = 0.0, False

    def __enter__(self) -> TellFound:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is not None and issubclass(kind, KeyboardInterrupt) and self._untold:
            self._tell()

    def __call__(self, more: bool) -> None:
        """Tell, if there is more to come, and it was not told just now."""
        self._untold = True
        if more and time.monotonic() >= self._next:
            self._tell()

    def _tell(self) -> None:
        if self._found is None:
            return
        started = time.monotonic()
        self._found(self._make_answer())
        ended = time.monotonic()
        self._untold, self._next = False, ended + max(BETWEEN, 10 * (ended - started))


Answer = TypeVar("Answer")

DEFAULT_RUN = Run()


def takes_run(
    function: Callable[..., Answer], *, answers_early: bool = False
) -> Callable[..., Answer]:
    """Let ``seed=1, threads=2, ...`` stand for ``run=Run(seed=1, threads=2, ...)`` in calls.

    Args:
        answers_early: whether what the function tells by ``run.found`` is what it returns, only
            incomplete.
    """
    names = frozenset(each.name for each in fields(Run))
    check = check_declared(function)

    @wraps(function)
    def call(*given: Any, **named: Any) -> Answer:
        short = {name: named.pop(name) for name in names & named.keys()}
        if short:
            if "run" in named:
                raise NagError(f"{min(short)}: is given beside run; give one of them")
            named["run"] = Run(**short)
        run = named.get("run")
        check_type(run, Run | None, "run", "a nag.Run")
        check(given, named)
        if run is not None and run.progress is True:
            with progress_line() as line:
                return call(*given, **(named | {"run": replace(run, progress=line)}))
        if run is not None and run.time_limit is not None:
            from nag.tracking.timed_call import call_within

            others = {name: value for name, value in named.items() if name != "run"}
            return call_within(function, given, others, run, answers_early)
        if run is None or (run.resume is None and run.executor is None):
            with one_thread():
                return function(*given, **named)
        from nag.tracking.blocks import open_engine

        with one_thread(), open_engine(run.resume, run.executor, run.tell) as opened:
            result = function(*given, **named)
        if opened is not None and opened.ledger is not None and opened.ledger.damaged:
            warn(f"{run.resume}: {opened.ledger.text}", stacklevel=2)
        return result

    return call


def answers_early(function: Callable[..., Answer]) -> Callable[..., Answer]:
    """`takes_run` of a function that tells incomplete answers, one of which may be its last."""
    return takes_run(function, answers_early=True)
