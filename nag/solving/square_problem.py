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
from nag.numerics.zero_values import possible_zeros, vanishes_at_all
from nag.solving.start.target import Target

# Values, beside their terms, of polynomials that certainly do not vanish.
NONZERO = 1e-6


@dataclass(frozen=True, eq=False)
class SquareProblem:
    """A system, the square one that is tracked, and both in scaled variables.

    Attributes:
        equations: the system's equations in the scaled variables.
        nonzero: polynomials that must not vanish, in the scaled variables.
        added: number of random linear equations that cut a solution set of positive dimension.
        squared: whether the square system has solutions that the equations have not.
    """

    system: PolynomialSystem
    equations: tuple[Polynomial, ...]
    nonzero: tuple[Polynomial, ...]
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
        nonzero = tuple(target.scaled(f) for f in system.nonzero)
        mended = tuple(target.scaled(f) for f in [*equations, *slices])
        return cls(system, mended, nonzero, target, added, len(equations) > n)

    def solves(self, x: np.ndarray) -> bool | None:
        """Whether all equations vanish at the square system's exact zero near ``x``.

        None if there is no such zero.
        """
        return self._vanish(self.equations, x)

    def excluded(self, x: np.ndarray, accuracy: float, multiple: bool) -> bool | None:
        """Whether a polynomial that must not vanish does at the exact zero near ``x``.

        None if that is not known.
        """
        n, answers = self.target.n, []
        zeros = None
        for g in self.nonzero:
            if Evaluator.of([g], n).residuals(x[None])[0, 0] > NONZERO:
                continue
            if not multiple:
                answers.append(self._vanish([g], x))
                continue
            if zeros is None:
                zeros = possible_zeros(self.equations, x, accuracy, np.random.default_rng(0))
            answers.append(vanishes_at_all(zeros, g))
        return True if True in answers else None if None in answers else False

    def _vanish(self, polynomials: Sequence[Polynomial], x: np.ndarray) -> bool | None:
        n = self.target.n
        square = [Polynomial(n, dict(row)) for row in self.target.rows]
        jacobian = Evaluator.of(square, n).jacobian(x)
        return vanish(polynomials, square, np.zeros((0, 1 + n)), jacobian, x)


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
