"""Variables counted from where the zeros lie, if that is far away for how close they lie together.

Where a variable occurs at most linearly, ``x = a y + b`` changes coefficients and no monomials.
The coefficients beside ``y`` and beside 1 can then be made orthogonal and of one size, for all
such variables and for the equations in turn: operator scaling, which converges to coefficients
that determine the zeros as well as they can.

Reference: Gurvits, Classical complexity and quantum entanglement, 2004.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from nag.algebra.polynomial import Exponents, Polynomial

# Least distance from 0, in radii of where the zeros lie, that makes a new origin worth its digits.
FAR = 8.0
# Binary digits of a new origin beyond the size of the radius.
DIGITS = 6
# Sizes beyond which nothing is tried: numbers in a sweep.
MOST_WORK = 1_000_000
MOST_SWEEPS = 60
# Change of the logarithms of the radii in the last sweep.
CONVERGED = 0.05
# Coefficients that depend on others of their group, beside the largest; and radii, and their
# inverses, that no sweep leads to where there is a balance.
DEPENDENT, FARTHEST = 1e-14, 1e9


def centres(polynomials: Sequence[Polynomial], n: int) -> tuple[Fraction, ...]:
    """New origins of the variables, 0 for those that stay as they are."""
    nothing = (Fraction(0),) * n
    linear = [i for i in range(n) if all(_linear_in(f, i) for f in polynomials)]
    if not linear or not all(f.exact and f.terms for f in polynomials):
        return nothing
    monomials = sorted({e for f in polynomials for e in f.terms})
    if len(polynomials) * len(monomials) * len(linear) > MOST_WORK:
        return nothing
    place = {e: k for k, e in enumerate(monomials)}
    matrix = np.zeros((len(polynomials), len(monomials)))
    for row, f in zip(matrix, polynomials, strict=True):
        top = max(abs(c) for c in f.terms.values())
        for e, c in f.terms.items():
            row[place[e]] = float(c / top)
    pairs = {}
    for i in linear:
        upper = np.array([k for k, e in enumerate(monomials) if e[i]], dtype=np.int64)
        lower = [place[_without(monomials[k], i)] for k in upper]
        pairs[i] = np.array(lower, dtype=np.int64), upper
    radius, centre = _balanced(matrix, _alike(polynomials), pairs, n)
    if radius is None:
        return nothing
    return tuple(
        _rounded(b, a) if abs(b) > FAR * a else Fraction(0)
        for a, b in zip(radius.tolist(), centre.tolist(), strict=True)
    )


def shifted(f: Polynomial, origins: Sequence[Fraction]) -> Polynomial:
    """``f`` in the variables ``x - origins``."""
    if not any(origins):
        return f
    variables = Polynomial.variables(f.n)
    return f.compose([x + b for x, b in zip(variables, origins, strict=True)])


def _without(e: Exponents, i: int) -> Exponents:
    return (*e[:i], 0, *e[i + 1 :])


def _linear_in(f: Polynomial, i: int) -> bool:
    """Whether a shift of variable ``i`` leaves the monomials of ``f`` as they are."""
    return all(e[i] == 0 or (e[i] == 1 and _without(e, i) in f.terms) for e in f.terms)


def _alike(polynomials: Sequence[Polynomial]) -> list[list[int]]:
    """Indices of polynomials with the same monomials, that can be combined."""
    groups: dict[frozenset[Exponents], list[int]] = {}
    for k, f in enumerate(polynomials):
        groups.setdefault(frozenset(f.terms), []).append(k)
    return [
        part
        for support, indices in groups.items()
        for part in ([indices] if len(indices) <= len(support) else [[k] for k in indices])
    ]


def _balanced(
    matrix: np.ndarray,
    alike: Sequence[Sequence[int]],
    pairs: dict[int, tuple[np.ndarray, np.ndarray]],
    n: int,
) -> tuple[np.ndarray | None, np.ndarray]:
    """Radii a and centres b, in ``x = a y + b``; None if the sweeps do not converge.

    Args:
        matrix: coefficients, a row each polynomial; overwritten.
        alike: rows that may be combined.
        pairs: for each variable to be changed, columns of monomials without it and with it.
    """
    radius, centre = np.ones(n), np.zeros(n)
    for _ in range(MOST_SWEEPS):
        for indices in alike:
            orthogonal, lower = np.linalg.qr(matrix[indices].T)
            if not np.abs(np.diag(lower)).min() > DEPENDENT * np.abs(np.diag(lower)).max():
                return None, centre
            matrix[indices] = orthogonal.T
        change = 0.0
        for i, (low, high) in pairs.items():
            slope = matrix[:, high]
            size = float((slope**2).sum())
            if size == 0.0:
                return None, centre
            b = -float((matrix[:, low] * slope).sum()) / size
            matrix[:, low] += b * slope
            rest = np.delete(matrix, high, axis=1)
            a = (float((rest**2).sum()) / size) ** 0.5
            if not 1 / FARTHEST < a < FARTHEST:
                return None, centre
            matrix[:, high] *= a
            centre[i] += radius[i] * b
            radius[i] *= a
            change = max(change, abs(float(np.log(a))))
        if change < CONVERGED:
            return radius, centre
    return None, centre


def _rounded(b: float, a: float) -> Fraction:
    """``b`` to some digits beyond the size of ``a``, as a dyadic number."""
    unit = Fraction(2) ** (int(np.floor(np.log2(a))) - DIGITS)
    return round(Fraction(b) / unit) * unit
