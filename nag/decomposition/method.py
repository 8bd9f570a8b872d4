"""Methods of decomposition: each is asked a task, and answers or leaves it to the next one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.decomposition.reduction import Reduction
from nag.numerics.system_facts import SystemFacts
from nag.tracking.run import Run, Stream
from nag.witness.witness import Decomposition, PathCounts, WitnessSet


@dataclass(frozen=True, eq=False)
class Task:
    """A system to decompose, and how.

    Attributes:
        facts: what is known of the system.
        symmetries: signed permutations of the variables that keep the equations.
        scheme: whether multiplicities are of interest: a branch is not the scheme that was given.
        found: called with components that are known already; None for a part of the system.
        sides: 2 where the imaginary unit is an unknown, and components with one of its two values
            are left out of the answer.
    """

    facts: SystemFacts
    symmetries: tuple[SignedPermutation, ...]
    run: Run
    scheme: bool = True
    found: Callable[[Sequence[WitnessSet]], None] | None = None
    sides: int = 1

    @property
    def system(self) -> PolynomialSystem:
        return self.facts.system

    def of_part(self, system: PolynomialSystem, symmetries: Sequence[SignedPermutation]) -> Task:
        """The same for a part of the system, as a set."""
        if system is self.system:
            return replace(self, symmetries=tuple(symmetries))
        # A part in which the unit does not occur has zeros of one side only.
        sides = self.sides if self.system.variables[-1] in system.variables else 1
        return Task(SystemFacts(system), tuple(symmetries), self.run, scheme=False, sides=sides)

    @cached_property
    def reduction(self) -> Reduction:
        """The system in fewer variables, in natural coordinates."""
        return Reduction.of(self.system, scaled=True, natural=self.facts.natural)

    @cached_property
    def rng(self) -> np.random.Generator:
        """The random numbers of what is tried before equations are intersected one by one."""
        return self.run.random(Stream.DECOMPOSITION)


@dataclass(frozen=True, eq=False)
class Attempt:
    """What became of a task.

    Attributes:
        answer: None where the method does not apply, or found that another must be asked.
        spent: paths that were tracked without their being counted in the answer.
    """

    answer: Decomposition | None = None
    spent: PathCounts = field(default=PathCounts())


# Answers a part of a task by the methods after the one that asks.
Others = Callable[[Task], Decomposition]
Method = Callable[[Task, Others], Attempt]


def decompose_by(methods: Sequence[Method], task: Task) -> Decomposition:
    """The answer of the first method that has one, by its name; the last one has always one."""
    spent = PathCounts()
    for k, method in enumerate(methods):
        others = methods[k + 1 :]
        task.run.tell(f"decomposing, {method.__name__.replace('_', ' ')}", 0, 0)
        attempt = method(task, lambda part, others=others: decompose_by(others, part))  # type: ignore[misc]
        spent += attempt.spent
        if attempt.answer is not None:
            answer, name = attempt.answer, method.__name__
            return replace(answer, paths=answer.paths + spent, method=answer.method or name)
    raise AssertionError("the last method answers whatever it is asked")
