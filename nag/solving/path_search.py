"""A system to solve, and the search for its zeros by paths: what is known, what that amounts to."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.algebra.zero_count import Completeness, ZeroCount, judge_number
from nag.numerics.system_facts import SystemFacts
from nag.solving.isolated_zero import IsolatedZero
from nag.solving.path_ends import (
    SortedEnds,
    add_zeros,
    list_doubts,
    restore_conjugate_ends,
    sort_ends,
)
from nag.solving.solutions import PathStatistics, SolveResult
from nag.solving.square_problem import SquareProblem
from nag.solving.start.target import StartSystem
from nag.tracking.paths import Paths, PathStatus
from nag.tracking.run import Run


@dataclass(frozen=True, eq=False)
class SolveTask:
    """A system to solve, and how.

    Attributes:
        start: the start system that is asked for, ``"auto"`` for the one with the least work.
        finite: whether only a finite solution set is of interest.
        sides: 2 where the imaginary unit is an unknown, and solutions with one of its two values
            are left out of the answer.
    """

    facts: SystemFacts
    start: str
    run: Run
    finite: bool = False
    sides: int = 1

    @property
    def system(self) -> PolynomialSystem:
        return self.facts.system

    def of_part(self, system: PolynomialSystem) -> SolveTask:
        """The same for what a branch leaves of the system."""
        return replace(self, facts=SystemFacts(system), run=self.run.without_found)

    @cached_property
    def rng(self) -> np.random.Generator:
        """The random numbers of what is tracked; `problem` takes the first of them."""
        return self.run.random()

    @cached_property
    def problem(self) -> SquareProblem:
        """The system as it is tracked."""
        equations = [f for f in self.system.polynomials if f]
        made = SquareProblem.of(self.system, equations, self.rng, self.facts.natural)
        return replace(made, sides=self.sides)


class Bound(NamedTuple):
    """How many isolated zeros there are at most, by multiplicity, and what says so."""

    count: ZeroCount
    source: str


@dataclass(frozen=True, eq=False)
class PathSearch:
    """What is known so far.

    Attributes:
        problem: the system as it is tracked, and ``begin`` the start system; ``reason``: why that.
        tracked: the paths.
        paths: these, where conjugates of ends are those of lost ones.
        ends: what they lead to, and the zeros that none of them has reached.
        bound: how many zeros there can be, if that was asked.
    """

    task: SolveTask
    problem: SquareProblem
    begin: StartSystem
    reason: str
    rng: np.random.Generator
    tracked: Paths
    paths: Paths
    ends: SortedEnds
    bound: Bound | None = None

    @classmethod
    def of(
        cls,
        task: SolveTask,
        problem: SquareProblem,
        begin: StartSystem,
        reason: str,
        tracked: Paths,
        rng: np.random.Generator,
    ) -> PathSearch:
        """What the ends of paths say."""
        # Where the unit is known for i, conjugates solve another system.
        is_real = not task.system.imaginary
        paths = restore_conjugate_ends(begin, tracked) if is_real else tracked
        ends = sort_ends(problem, begin, paths, rng, task.finite)
        return cls(task, problem, begin, reason, rng, tracked, paths, ends)

    def replace_paths(self, indices: np.ndarray, ends: Paths) -> PathSearch:
        """The same where some paths were tracked again, to other ends."""
        tracked = self.tracked.track_again(indices, ends)
        same = self.task, self.problem, self.begin, self.reason
        return replace(PathSearch.of(*same, tracked, self.rng), bound=self.bound)

    def add_zeros(
        self, zeros: Sequence[IsolatedZero], instead_of: Collection[int] = ()
    ) -> PathSearch:
        """The same with more zeros, some of which replace known ones."""
        return replace(self, ends=add_zeros(self.problem, self.ends, zeros, instead_of))

    @property
    def zeros(self) -> int:
        """The number of isolated zeros that were found, by multiplicity."""
        return self.ends.zeros

    @property
    def completeness(self) -> Completeness:
        """Whether all zeros were found, as far as a bound says."""
        return judge_number(self.zeros, None if self.bound is None else self.bound.count)

    @property
    def doubtful(self) -> np.ndarray:
        """Indices of the paths whose ends are not proved."""
        return np.flatnonzero(self.tracked.status != PathStatus.REGULAR)

    @property
    def has_doubts(self) -> bool:
        """Whether ends are not understood, or paths were lost."""
        return bool(self.ends.unclear) or len(self.tracked.where(PathStatus.FAILED)) > 0

    @property
    def is_clear(self) -> bool:
        """Whether what became of all paths, one for each zero, leaves nothing to be counted."""
        every = self.zeros == len(self.tracked) and not self.has_doubts
        return self.begin.complete and (every or not len(self.doubtful))

    def result(self) -> SolveResult:
        """The answer, as it stands."""
        begin, ends, seen = self.begin, self.ends, self.completeness
        doubts, reason = list(ends.notes), self.reason
        if self.bound is not None and seen is Completeness.ALL:
            most = self.problem.on_one_side(self.zeros)
            unit, one = "", ""
            if self.problem.sides > 1:
                name = self.problem.system.variables[-1]
                unit, one = f", for both values of {name}", f" for each value of {name}"
            reason = f"{reason}{unit}; {self.bound.source} no more than {most}{one}"
        else:
            doubts = [*ends.unclear, *list_doubts(begin, self.paths), *doubts]
        if self.bound is not None and seen in (Completeness.MISSING, Completeness.TOO_MANY):
            doubts.append(self.bound.count.difference(self.zeros, self.problem.sides))
        remarks = []
        if self.problem.added and not len(ends.larger.points):
            remarks.append(
                f"fewer equations than variables: no solution is isolated, and none was found "
                f"where {self.problem.added} random linear equations are added"
            )
        return SolveResult.of(
            self.problem.system,
            self.task.run,
            start=begin.name,
            reason=reason,
            solutions=ends.solutions,
            excluded=ends.excluded,
            larger=ends.larger,
            undecided=ends.undecided[:0] if seen is Completeness.ALL else ends.undecided,
            paths=PathStatistics.of(self.paths.status, int(self.paths.steps.sum())),
            doubts=doubts,
            remarks=remarks,
            whole=begin.complete or seen is Completeness.ALL,
            pathless=not len(self.paths),
        )
