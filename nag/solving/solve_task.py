"""A system to solve, and how."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.numerics.system_facts import SystemFacts
from nag.solving.square_problem import SquareProblem
from nag.tracking.run import Run


@dataclass(frozen=True, eq=False)
class SolveTask:
    """A system to solve, and how.

    Attributes:
        start: the start system that is asked for, ``"auto"`` for the one with the least work.
        finite: whether only a finite solution set is of interest.
    """

    facts: SystemFacts
    start: str
    run: Run
    finite: bool = False

    @property
    def system(self) -> PolynomialSystem:
        return self.facts.system

    def of_part(self, system: PolynomialSystem) -> SolveTask:
        """The same for what a branch leaves of the system."""
        return replace(self, facts=SystemFacts(system))

    @cached_property
    def rng(self) -> np.random.Generator:
        """The random numbers of what is tracked; `problem` takes the first of them."""
        return self.run.random()

    @cached_property
    def problem(self) -> SquareProblem:
        """The system as it is tracked."""
        equations = [f for f in self.system.polynomials if f]
        return SquareProblem.of(self.system, equations, self.rng, self.facts.natural)
