"""Homotopies of exact polynomials, on boxes that move with t.

Discs that move are polynomials in a parameter between -1 and 1, with discs as coefficients. Such a
series stands for all functions of s whose value at each s in [-1, 1] is the sum of ``c_k s^k`` with
a number ``c_k`` of each disc, which may be another one for another s. The last coefficient takes in
what a product has of higher order (a Taylor model).

Reference:
    Makino & Berz, Taylor models and other validated functional inclusion methods, 2003.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.numerics.discs import (
    LEAST,
    UP,
    DiscPolynomials,
    Discs,
    Terms,
    Weights,
    magnitude,
    rounding_of_sum,
)
from nag.numerics.doubles import UNIT
from nag.tracking.homotopy import Homotopy


def series_product(a: Discs, b: Discs) -> Discs:
    """Series of the products; coefficients stand along the first axis."""
    length = len(a.mid)
    size_a, size_b = magnitude(a.mid), magnitude(b.mid)
    most_a, most_b = size_a + a.rad, size_b + b.rad
    shape = np.broadcast_shapes(a.mid.shape, b.mid.shape)
    mid = np.zeros(shape, dtype=complex)
    sizes, most = np.zeros(shape), np.zeros(shape)
    for i in range(length):
        mid[i:] += a.mid[i] * b.mid[: length - i]
        sizes[i:] += size_a[i] * size_b[: length - i]
        most[i:] += most_a[i] * most_b[: length - i]
    # What the factors' radii add is the difference, up to rounding.
    rad = most - sizes + 2 * rounding_of_sum(length) * most
    for i in range(1, length):
        rad[-1] += most_a[i] * most_b[length - i :].sum(axis=0)
    return Discs(mid, rad * (UP + rounding_of_sum(length * length)) + LEAST)


def series_sum(a: Discs, b: Discs) -> Discs:
    """Series of the sums."""
    mid = a.mid + b.mid
    return Discs(mid, (a.rad + b.rad + magnitude(mid) * 4 * UNIT) * UP + LEAST)


def values_along(system: DiscPolynomials, x: Discs) -> Discs:
    """Values on series of boxes, shape ``(length, P, n)``: shape ``(length, P, rows)``."""
    return _weigh_monomials(system.values, _monomials(system, x))


def slopes_along(system: DiscPolynomials, x: Discs) -> Discs:
    """Jacobian matrices on series of boxes: shape ``(length, P, rows, n)``."""
    found = _weigh_monomials(system.slopes, _monomials(system, x))
    shape = (*x.mid.shape[:2], system.rows, system.n)
    return Discs(found.mid.reshape(shape), found.rad.reshape(shape))


def _weigh_monomials(weights: Weights, monomials: Discs) -> Discs:
    """Sums of monomials, shape ``(length, M, P)``, to shape ``(length, P, rows)``."""
    length, count, P = monomials.mid.shape
    flat = [c.transpose(1, 0, 2).reshape(count, -1) for c in monomials]
    found = weights @ Discs(*flat)
    return Discs(*(c.reshape(-1, length, P).transpose(1, 2, 0) for c in found))


def _monomials(system: DiscPolynomials, x: Discs) -> Discs:
    """All monomials of a system, shape ``(length, M, P)``."""
    base = Discs(*(np.ascontiguousarray(c.transpose(0, 2, 1)) for c in x))
    one = Discs(np.zeros_like(base.mid), np.zeros_like(base.rad))
    one.mid[0] = 1.0
    table = [one, base]
    while len(table) <= system.top:
        table.append(series_product(table[-1], base))
    mid = np.concatenate([t.mid for t in table[: system.top + 1]], axis=1)
    rad = np.concatenate([t.rad for t in table[: system.top + 1]], axis=1)
    first, *others = system.powers
    found = Discs(mid[:, first], rad[:, first])
    for places in others:
        several = np.flatnonzero(places)
        these = Discs(found.mid[:, several], found.rad[:, several])
        more = Discs(mid[:, places[several]], rad[:, places[several]])
        found.mid[:, several], found.rad[:, several] = series_product(these, more)
    return found


@dataclass(frozen=True, eq=False)
class MovingPart:
    """Rows that are multiplied by ``a + t b``; both are exact doubles."""

    a: complex
    b: complex
    rows: DiscPolynomials

    @classmethod
    def of(cls, a: complex, b: complex, rows: Sequence[Terms], linear: np.ndarray) -> MovingPart:
        """Terms of exact polynomials, then rows on ``(1, x)``, whose doubles are exact.

        Raises:
            OverflowError: if a coefficient is too large or too small for a double.
        """
        return cls(complex(a), complex(b), DiscPolynomials.of_terms(rows, linear))

    def factor(self, t: Discs) -> Discs:
        """``a + t b`` for series of t, of any length."""
        mid = self.b * t.mid
        mid[0] += self.a
        rad = abs(self.b) * (t.rad + 16 * UNIT * magnitude(t.mid))
        rad[0] += 16 * UNIT * abs(self.a)
        return Discs(mid, rad * UP + LEAST)


@dataclass(frozen=True, eq=False)
class MovingSystem:
    """The sum of parts: as many rows as unknowns, and exact for every t."""

    parts: tuple[MovingPart, ...]

    @property
    def n(self) -> int:
        """Number of unknowns."""
        return self.parts[0].rows.n

    @classmethod
    def of(cls, homotopy: Homotopy, patches: np.ndarray) -> MovingSystem:
        """A homotopy in the affine chart where a linear form in each group is one.

        Args:
            patches: the forms, whose doubles are exact, shape ``(groups, N)``.

        Raises:
            OverflowError: if a coefficient is too large or too small for a double.
        """
        rows, count = homotopy.rows, len(homotopy.A0)
        blank = np.zeros((count + len(patches), 1 + homotopy.N), dtype=complex)
        fixed, moving = blank.copy(), blank.copy()
        fixed[:count, 1:], fixed[count:, 1:], fixed[count:, 0] = homotopy.A0, patches, -1.0
        moving[:count, 1:] = homotopy.A1
        nothing: list[Terms] = [{}] * len(rows)
        parts = [MovingPart.of(1.0, 0.0, nothing, fixed)]
        if moving.any():
            parts.append(MovingPart.of(0.0, 1.0, nothing, moving))
        for p, (a, b) in enumerate(homotopy.factors):
            terms = [next((f for q, f in row if q == p), {}) for row in rows.parts]
            parts.append(MovingPart.of(a, b, terms, blank))
        return cls(tuple(parts))

    def at(self, x: np.ndarray, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Values, Jacobian matrices and derivatives by t, to rounding, without bounds.

        Args:
            x: points, shape ``(P, n)``; t: shape ``(P,)``.
        """
        values, slopes, rates = 0.0, 0.0, 0.0
        for part in self.parts:
            f, j = part.rows.middles(x)
            factor = (part.a + part.b * t)[:, None]
            values = values + factor * f
            slopes = slopes + factor[..., None] * j
            rates = rates + part.b * f
        return values, slopes, rates

    def values_along(self, x: Discs, t: Discs) -> Discs:
        """Values on series of boxes and of t, shapes ``(length, P, n)`` and ``(length, P)``."""
        total = None
        for part in self.parts:
            factor = Discs(*(c[..., None] for c in part.factor(t)))
            found = series_product(values_along(part.rows, x), factor)
            total = found if total is None else series_sum(total, found)
        return total

    def slopes_along(self, x: Discs, t: Discs) -> Discs:
        """Jacobian matrices on series of boxes and of t, shape ``(length, P, rows, n)``."""
        total = None
        for part in self.parts:
            factor = Discs(*(c[..., None, None] for c in part.factor(t)))
            found = series_product(slopes_along(part.rows, x), factor)
            total = found if total is None else series_sum(total, found)
        return total


def times(begin: np.ndarray, end: np.ndarray, length: int) -> Discs:
    """The way from ``begin`` to ``end``, shape ``(P,)``, as a series in s from -1 to 1."""
    mid = np.zeros((length, len(begin)), dtype=complex)
    mid[0], mid[1] = (begin + end) / 2, (end - begin) / 2
    rad = np.zeros(mid.shape)
    # The exact middle and half are within this, so that the series holds both ends and all between.
    rad[:2] = 4 * UNIT * (np.abs(begin) + np.abs(end))
    return Discs(mid, rad)
