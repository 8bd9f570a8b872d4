"""Homotopies of exact polynomials, on boxes that move with t."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.numerics.disc_series import series_product, series_sum, slopes_along, values_along
from nag.numerics.discs import LEAST, UNIT, UP, DiscPolynomials, Discs, Terms, magnitude
from nag.tracking.homotopy import Homotopy


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
