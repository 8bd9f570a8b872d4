"""How something is to be worked out: random numbers, threads, accuracy, who hears of progress."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import wraps
from typing import Any

import numpy as np

from nag.algebra.given import check_running
from nag.errors import NagError
from nag.tracking.settings import Settings

# Called with a stage's name, the step reached and the number of steps; 0 if that is not known.
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True)
class Run:
    """How something is to be worked out; the same run gives the same answer, byte for byte.

    Attributes:
        seed: of the random numbers.
        threads: for path tracking; answers do not depend on them.
        settings: ``"fast"``, ``"default"`` or ``"careful"`` tracking, or settings of one's own.
        progress: called with a stage's name, the step reached and the number of steps.

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
    progress: Progress | None = None

    def __post_init__(self) -> None:
        check_running(self.seed, self.threads, self.settings, self.progress)
        object.__setattr__(self, "seed", int(self.seed))
        object.__setattr__(self, "threads", int(self.threads))

    @property
    def short(self) -> dict[str, Any]:
        """The fields by their names, as calls take them one by one."""
        return {each.name: getattr(self, each.name) for each in fields(self)}

    @property
    def name(self) -> str:
        """The name of the settings."""
        return self.settings if isinstance(self.settings, str) else "custom"

    def random(self, *stream: int) -> np.random.Generator:
        """The random numbers of a part of the work, by numbers that no other part uses."""
        return np.random.default_rng([self.seed, *stream] if stream else self.seed)

    def tell(self, stage: str, done: int, total: int) -> None:
        """Tell of the step ``done`` of ``total``; 0 if their number is not known."""
        if self.progress is not None:
            self.progress(stage, done, total)


DEFAULT_RUN = Run()


def takes_run(function: Callable[..., Any]) -> Callable[..., Any]:
    """Let ``seed=1, threads=2, ...`` stand for ``run=Run(seed=1, threads=2, ...)`` in calls."""
    names = frozenset(each.name for each in fields(Run))

    @wraps(function)
    def call(*given: Any, **named: Any) -> Any:
        short = {name: named.pop(name) for name in names & named.keys()}
        if short:
            if "run" in named:
                raise NagError(f"{min(short)}: is given beside run; give one of them")
            named["run"] = Run(**short)
        return function(*given, **named)

    return call
