"""Scaling of variables and equations, so that the coefficients are of one size.

Reference: Meintjes & Morgan, A methodology for solving chemical equilibrium systems, 1987 (SCL).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import accumulate
from math import floor, gcd, log2
from operator import mul
from typing import Any

import numpy as np

from nag.algebra.number import Number
from nag.algebra.polynomial import Exponents, Polynomial
from nag.numerics.double_ranks import DEPENDENT, smallest_share

# Exponents beyond this would leave the range of doubles.
LARGEST = 200
# Weight of without_scales variables where the coefficients do not ask for a scale.
INERTIA = 1e-2
# Binary orders between the coefficients of an equation from which on those that are odd lose their
# weight, in so many steps: no scales bring such to the digits that doubles have to spare.
ODD, SWEEPS = 40, 12
# Least over largest singular value of the coefficients of rows that are left as they are.
NEARLY_ORTHOGONAL = 0.1


def magnitude(c: Number | complex) -> float:
    """The binary logarithm of ``|c|``; also beyond the range of doubles."""
    if isinstance(c, Fraction):
        p, q = c.as_integer_ratio()
        return log2(abs(p)) if q == 1 else log2(abs(p)) - log2(q)
    return float(np.log2(abs(complex(c))))


def _magnitudes(numbers: Collection[Number]) -> list[float]:
    """The `magnitude` of each."""
    if set(map(type, numbers)) != {Fraction}:
        return list(map(magnitude, numbers))
    # One call for each takes as long as all else.
    ratios = [c.as_integer_ratio() for c in numbers]
    return [log2(abs(p)) if q == 1 else log2(abs(p)) - log2(q) for p, q in ratios]


def _magnitudes_over(numbers: Collection[int], common: int) -> list[float]:
    """The same of integers over a common denominator."""
    units = [(abs(c), gcd(c, common)) for c in numbers]
    return [log2(c // unit) - log2(common // unit) for c, unit in units]


@dataclass(frozen=True, eq=False)
class Logarithms:
    """The terms of equations that have several, as exponents and logarithms of coefficients.

    Attributes:
        exponents: of all terms, those of each equation together, shape ``(T, n)``.
        sizes: binary logarithms of the coefficients' absolute values, shape ``(T,)``.
        counts: numbers of terms of each equation.
        alone: number of the equations of one term, which are not among these.
    """

    exponents: np.ndarray
    sizes: np.ndarray
    counts: tuple[int, ...]
    alone: int

    @classmethod
    def of(cls, polynomials: Sequence[Polynomial], n: int) -> Logarithms:
        """Those of polynomials in ``n`` variables, none of them zero."""
        several = [f.terms for f in polynomials if len(f.terms) > 1]
        sizes = [size for terms in several for size in _magnitudes(terms.values())]
        return cls._of_parts(several, sizes, len(polynomials), n)

    @classmethod
    def of_integers(cls, sums: Sequence[tuple[dict[Exponents, int], int]], n: int) -> Logarithms:
        """Those of sums of terms with integers, not zero, over a common denominator."""
        several = [each for each in sums if len(each[0]) > 1]
        sizes = [size for terms, q in several for size in _magnitudes_over(terms.values(), q)]
        return cls._of_parts([terms for terms, _ in several], sizes, len(sums), n)

    @classmethod
    def _of_parts(
        cls, several: Sequence[Mapping[Exponents, Any]], sizes: list[float], number: int, n: int
    ) -> Logarithms:
        exponents = np.array([e for terms in several for e in terms], dtype=float)
        counts = tuple(map(len, several))
        exponents = exponents.reshape(len(sizes), n)
        return cls(exponents, np.array(sizes), counts, number - len(several))

    @cached_property
    def first(self) -> list[int]:
        """The index of each equation's first term."""
        return [0, *accumulate(self.counts[:-1])]

    def best_scales(self, near: np.ndarray | float = 0.0) -> np.ndarray:
        """Integers k, shape ``(n,)``, as `variable_scales` gives them."""
        first, exponents, sizes = self.first, self.exponents, self.sizes
        n = exponents.shape[1]
        if not self.counts:
            return np.full(n, near).astype(np.int64)
        if isinstance(near, float) and near == 0.0 and self._largest_range(sizes) == 0.0:
            # No scales are better than those with which nothing varies, and none as near to 0.
            return np.zeros(n, dtype=np.int64)
        # All weights are one at first.
        total, weighted, weighted_sizes = np.array(self.counts, dtype=float), exponents, sizes
        for _ in range(SWEEPS + 1):
            # The normal equations, with the size of each equation at its best for these weights:
            # exponents are small whole numbers, and inertia keeps them regular.
            sums = np.add.reduceat(weighted, first)
            size_sums = np.add.reduceat(weighted_sizes, first)
            matrix = weighted.T @ exponents - (sums.T / total) @ sums
            matrix.flat[:: n + 1] += INERTIA**2
            right = (size_sums / total) @ sums - sizes @ weighted + INERTIA**2 * near
            solution = np.linalg.solve(matrix, right)
            off = sizes + exponents @ solution
            if self._largest_range(off) <= ODD:
                break
            weights = 1 / np.maximum(np.abs(self._beside_medians(off)), 1.0)
            total = np.add.reduceat(weights, first)
            weighted, weighted_sizes = weights[:, None] * exponents, weights * sizes
        return np.minimum(np.maximum(np.rint(solution), -LARGEST), LARGEST).astype(np.int64)

    def spread(self, powers: np.ndarray) -> float:
        """Most binary orders between two coefficients of an equation, at scales."""
        return self._largest_range(self._at(powers)) if self.counts else 0.0

    def unevenness(self, powers: np.ndarray) -> float:
        """Binary orders between a coefficient and the median one of its equation: their median."""
        off = self._beside_medians(self._at(powers)) if self.counts else self.sizes
        return float(_median([*map(abs, off.tolist()), *[0.0] * self.alone]))

    def _at(self, powers: np.ndarray) -> np.ndarray:
        """The logarithms of the coefficients at scales."""
        return self.sizes + self.exponents @ powers

    def _largest_range(self, values: np.ndarray) -> float:
        ranges = np.maximum.reduceat(values, self.first) - np.minimum.reduceat(values, self.first)
        return float(ranges.max())

    def _beside_medians(self, values: np.ndarray) -> np.ndarray:
        """What is left of the values without the median of their equation."""
        parts = zip(self.first, self.counts, strict=True)
        medians = [_median(values[a : a + k].tolist()) for a, k in parts]
        return values - np.repeat(medians, self.counts)


def _median(values: list[float]) -> float:
    ordered = sorted(values)
    return (ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2


def variable_scales(polynomials: Sequence[Polynomial], n: int) -> np.ndarray:
    """Integers k, shape ``(n,)``: with ``x_i = 2^k_i y_i`` the coefficients vary the least.

    The least squares problem of the logarithms of all coefficients, the equations free to be
    scaled too. Where that leaves some far off, their absolute values count and not their squares
    (by weights from step to step): a few odd coefficients, as the small constant that two sheets
    close together have, do not decide. Scales that the equations leave free, as those of
    ``x^2 y - 1`` along ``(1, -2)``, are the nearest to 0; of `Logarithms.best_scales`, to any
    that are given.
    """
    return Logarithms.of(polynomials, n).best_scales()


def scaled_terms(f: Polynomial, scales: np.ndarray) -> dict[Exponents, Number]:
    """Terms of ``f`` in the scaled variables, divided by a power of two near the largest."""
    weights = scales.tolist()
    if not any(weights):
        top = floor(max(map(magnitude, f.terms.values()), default=0.0))
        unit = Fraction(2) ** -top
        return {e: c * unit for e, c in f.terms.items()} if top else dict(f.terms)
    shifts = {e: sum(map(mul, e, weights)) for e in f.terms}
    top = floor(max((magnitude(c) + shifts[e] for e, c in f.terms.items()), default=0.0))
    powers = {shift: Fraction(2) ** (shift - top) for shift in set(shifts.values())}
    return {e: c if shifts[e] == top else c * powers[shifts[e]] for e, c in f.terms.items()}


def independent_rows(
    rows: Sequence[dict[Exponents, Number]],
) -> tuple[dict[Exponents, Number], ...]:
    """Rows that have the same monomials replaced by combinations with orthonormal coefficients.

    The combinations are exact, so that the zeros stay as they are; rows that are nearly
    orthogonal, or that depend on each other, are left alone.
    """
    alike: dict[frozenset[Exponents], list[int]] = {}
    for i, row in enumerate(rows):
        alike.setdefault(frozenset(row), []).append(i)
    result = list(rows)
    for support, indices in alike.items():
        if not 1 < len(indices) <= len(support):
            continue
        if not all(isinstance(c, Fraction) for i in indices for c in rows[i].values()):
            continue
        monomials = sorted(support)
        matrix = np.array([[float(rows[i][e]) for e in monomials] for i in indices])
        if not DEPENDENT < smallest_share(matrix) < NEARLY_ORTHOGONAL:
            continue
        lower = np.linalg.qr(matrix.T, mode="r").T
        combine = np.linalg.inv(lower)
        for i, weights in zip(indices, combine, strict=True):
            exact = [Fraction(float(w)) for w in weights]
            values = {
                e: sum((w * rows[j][e] for w, j in zip(exact, indices, strict=True)), Fraction(0))
                for e in monomials
            }
            result[i] = {e: c for e, c in values.items() if c}
    return tuple(result)
