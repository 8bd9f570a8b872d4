"""Isosingular deflation: equations of which a multiple component is a reduced one.

At generic points of a component that is not reduced the Jacobian J has null vectors that are no
tangents of it. To the equations are added ``J(z) (Q1 + Q2 L) = 0`` in new unknowns L, which say
that J has as many null vectors; Q1 and Q2 are random, of numbers of few bits, so that all stays
exact (Hauenstein & Wampler, Isosingular sets and deflation, 2013). Its points are isolated on a
slice, not in space: `nag.numerics.deflation` deflates isolated zeros, without new unknowns.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.numerics.read_only import fixed_array

# Deflated systems of more unknowns, or of more terms, cost more than they are worth.
MOST_UNKNOWNS = 80
MOST_TERMS = 100_000


@dataclass(frozen=True, eq=False)
class Level:
    """One deflation step: ``J(z) (Q1 + Q2 L) = 0`` in new unknowns ``L``, column by column.

    ``J`` is the Jacobian of the ``polynomials``, ``base`` evaluates them.
    """

    polynomials: Sequence[Polynomial]
    base: Evaluator
    q1: np.ndarray
    q2: np.ndarray

    def __post_init__(self) -> None:
        object.__setattr__(self, "q1", fixed_array(self.q1))
        object.__setattr__(self, "q2", fixed_array(self.q2))

    def unknowns(self, z: np.ndarray) -> np.ndarray:
        """The values of ``L`` at ``z``, by least squares, flattened column by column."""
        jacobian = self.base.jacobian(z)
        solution, *_ = np.linalg.lstsq(jacobian @ self.q2, -jacobian @ self.q1, rcond=None)
        return solution.T.ravel()


@dataclass(frozen=True, eq=False)
class DeflatedEquations:
    """Equations in n variables and in the unknowns that deflation added, ``total`` together."""

    polynomials: Sequence[Polynomial]
    evaluator: Evaluator
    n: int
    total: int
    levels: tuple[Level, ...]

    @classmethod
    def none(
        cls, polynomials: Sequence[Polynomial], evaluator: Evaluator, n: int
    ) -> DeflatedEquations:
        """Equations that were not deflated."""
        return cls(polynomials, evaluator, n, n, ())

    def too_large(self, free: int, m: int) -> bool:
        """Whether deflation with ``m`` null vectors among ``free`` columns costs too much."""
        entries = sum(sum(map(bool, e)) for f in self.polynomials for e in f.terms)
        unknowns = self.total + (free - m) * m
        return unknowns > MOST_UNKNOWNS or entries * m * (1 + free - m) > MOST_TERMS

    def once_more(self, q1: np.ndarray, q2: np.ndarray) -> DeflatedEquations:
        """The equations together with ``J (q1 + q2 L) = 0`` in new unknowns ``L``."""
        polynomials = _with_null_vectors(self.polynomials, self.total, q1, q2)
        total = self.total + q1.shape[1] * q2.shape[1]
        levels = (*self.levels, Level(self.polynomials, self.evaluator, q1, q2))
        return DeflatedEquations(
            polynomials, Evaluator.of(polynomials, total), self.n, total, levels
        )


def _with_null_vectors(
    polynomials: Sequence[Polynomial], n: int, q1: np.ndarray, q2: np.ndarray
) -> list[Polynomial]:
    """The polynomials together with ``J (q1 + q2 L) = 0``, exact, in the variables ``(z, L)``."""
    k, m = q2.shape[1], q1.shape[1]
    total = n + k * m
    first = [[Fraction(q) for q in row] for row in q1]
    second = [[Fraction(q) for q in row] for row in q2]
    zeros = (0,) * (k * m)
    units = [(*zeros[:i], 1, *zeros[i + 1 :]) for i in range(k * m)]
    result = [f.with_variables(total, range(n)) for f in polynomials]
    for f in polynomials:
        gradient = [(i, f.derivative(i)) for i in sorted(f.support)]
        for column in range(m):
            terms: dict[tuple[int, ...], Number] = {}
            for i, derivative in gradient:
                entries = [(zeros, first[i][column])]
                entries += [(units[column * k + j], second[i][j]) for j in range(k)]
                for exponents, coefficient in derivative.terms.items():
                    for unit, q in entries:
                        key = exponents + unit
                        terms[key] = terms.get(key, 0) + coefficient * q
            value = Polynomial(total, terms)
            if value:
                result.append(value)
    return result
