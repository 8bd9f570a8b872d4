"""Scaling of variables and equations, so that the coefficients are of one size.

Reference: Meintjes & Morgan, A methodology for solving chemical equilibrium systems, 1987 (SCL).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import accumulate
from math import floor, log2
from operator import mul

import numpy as np

from nag.algebra.number import Number
from nag.algebra.polynomial import Exponents, Polynomial

# Exponents beyond this would leave the range of doubles.
LARGEST = 200
# Weight of unscaled variables where the coefficients do not ask for a scale.
INERTIA = 1e-2
# Binary orders between the coefficients of an equation from which on those that are odd lose their
# weight, in so many steps: no scales bring such to the digits that doubles have to spare.
ODD, SWEEPS = 40, 12
# Least over largest singular value of the coefficients of rows that are made orthogonal.
DEPENDENT, NEARLY_ORTHOGONAL = 1e-12, 0.1


def magnitude(c: Number | complex) -> float:
    """The binary logarithm of ``|c|``; also beyond the range of doubles."""
    if isinstance(c, Fraction):
        p, q = c.as_integer_ratio()
        return log2(abs(p)) if q == 1 else log2(abs(p)) - log2(q)
    return float(np.log2(abs(complex(c))))


def variable_scales(
    polynomials: Sequence[Polynomial], n: int, near: np.ndarray | float = 0.0
) -> np.ndarray:
    """Integers k, shape ``(n,)``: with ``x_i = 2^k_i y_i`` the coefficients vary the least.

    The least squares problem of the logarithms of all coefficients, the equations free to be
    scaled too. Where that leaves some far off, their absolute values count and not their squares
    (by weights from step to step): a few odd coefficients, as the small constant that two sheets
    close together have, do not decide.

    Args:
        near: where the equations leave scales free, as ``x^2 y - 1`` does along ``(1, -2)``, those
            nearest to these are taken.
    """
    several = [f.terms for f in polynomials if len(f.terms) > 1]
    if not several:
        return np.full(n, near).astype(np.int64)
    exponents = np.array([e for terms in several for e in terms], dtype=float)
    sizes = np.array([magnitude(c) for terms in several for c in terms.values()])
    counts = [len(terms) for terms in several]
    first = [0, *accumulate(counts[:-1])]
    of_equation = np.repeat(np.arange(len(several)), counts)
    weights = np.ones(len(sizes))
    for _ in range(SWEEPS + 1):
        # The normal equations, with the size of each equation at its best for these weights:
        # exponents are small whole numbers, and inertia keeps them regular.
        total = np.add.reduceat(weights, first)
        weighted = weights[:, None] * exponents
        sums, size_sums = np.add.reduceat(weighted, first), np.add.reduceat(weights * sizes, first)
        matrix = weighted.T @ exponents - (sums.T / total) @ sums
        matrix.flat[:: n + 1] += INERTIA**2
        right = (size_sums / total) @ sums - sizes @ weighted + INERTIA**2 * near
        solution = np.linalg.solve(matrix, right)
        off = sizes + exponents @ solution
        if (np.maximum.reduceat(off, first) - np.minimum.reduceat(off, first)).max() <= ODD:
            break
        off = np.abs(off - _medians(off, first, counts)[of_equation])
        weights = 1 / np.maximum(off, 1.0)
    return np.clip(np.rint(solution), -LARGEST, LARGEST).astype(np.int64)


def _medians(values: np.ndarray, first: Sequence[int], counts: Sequence[int]) -> np.ndarray:
    """The median of each equation's values."""
    return np.array([np.median(values[a : a + k]) for a, k in zip(first, counts, strict=True)])


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
        singular = np.linalg.svd(matrix, compute_uv=False)
        if not DEPENDENT < singular[-1] / singular[0] < NEARLY_ORTHOGONAL:
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
