"""A system as it is tracked: as many equations as variables, in scaled variables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.high_precision import vanish
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.solving.start.target import Target


@dataclass(frozen=True, eq=False)
class SquareProblem:
    """A system, the square one that is tracked, and both in scaled variables.

    Attributes:
        equations: the system's equations in the scaled variables.
        nonzero: what must not vanish, in the scaled variables.
        added: number of random linear equations that cut a solution set of positive dimension.
        squared: whether the square system has solutions that the equations have not.
    """

    system: PolynomialSystem
    equations: tuple[Polynomial, ...]
    nonzero: Evaluator
    target: Target
    added: int
    squared: bool

    @classmethod
    def of(
        cls, system: PolynomialSystem, equations: Sequence[Polynomial], rng: np.random.Generator
    ) -> SquareProblem:
        n = system.n
        added = max(0, n - len(equations))
        slices = [_random_linear(n, rng) for _ in range(added)]
        square = _squared([*equations, *slices], n, rng)
        target = Target.of(square, n)
        nonzero = Evaluator.of([target.scaled(f) for f in system.nonzero], n)
        mended = tuple(target.scaled(f) for f in [*equations, *slices])
        return cls(system, mended, nonzero, target, added, len(equations) > n)

    def solves(self, x: np.ndarray) -> bool | None:
        """Whether all equations vanish at the square system's exact zero near ``x``.

        None if there is no such zero.
        """
        n = self.target.n
        square = [Polynomial(n, dict(row)) for row in self.target.rows]
        jacobian = Evaluator.of(square, n).jacobian(x)
        return vanish(self.equations, square, np.zeros((0, 1 + n)), jacobian, x)


def _random_linear(n: int, rng: np.random.Generator) -> Polynomial:
    weights = [Fraction(int(w), 128) for w in rng.integers(-128, 129, n + 1)]
    terms = {(0,) * n: weights[n]}
    for i in range(n):
        terms[tuple(int(j == i) for j in range(n))] = weights[i] or Fraction(1)
    return Polynomial(n, terms)


def _squared(polynomials: list[Polynomial], n: int, rng: np.random.Generator) -> list[Polynomial]:
    """``n`` polynomials: those of highest degree, each with multiples of the others added."""
    if len(polynomials) == n:
        return polynomials
    order = sorted(range(len(polynomials)), key=lambda i: (-polynomials[i].degree, i))
    kept, rest = order[:n], order[n:]
    result = []
    for i in kept:
        total = polynomials[i]
        size = _largest(total)
        for j in rest:
            weight = Fraction(int(rng.integers(64, 192)) * int(rng.choice([-1, 1])), 128)
            total = total + polynomials[j] * (weight * size / _largest(polynomials[j]))
        result.append(total)
    return result


def _largest(f: Polynomial) -> Fraction:
    return Fraction(max(abs(float(c)) for c in f.terms.values()))
