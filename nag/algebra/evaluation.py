"""Values, sizes and Jacobians of polynomials at many complex points at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nag.algebra.polynomial import Polynomial


@dataclass(frozen=True, eq=False)
class Evaluator:
    """Polynomials in ``n`` variables as flat arrays, scaled to largest coefficient one.

    Attributes:
        exponents: int, shape ``(M, n)``: the distinct monomials of all rows.
        coefficients: float, shape ``(rows, M)``.
    """

    n: int
    exponents: np.ndarray
    coefficients: np.ndarray

    @classmethod
    def of(cls, polynomials: Sequence[Polynomial], n: int) -> Evaluator:
        monomials = sorted({e for f in polynomials for e in f.terms})
        index = {e: i for i, e in enumerate(monomials)}
        coefficients = np.zeros((len(polynomials), len(monomials)))
        for row, f in enumerate(polynomials):
            values = {e: float(c) for e, c in f.terms.items()}
            scale = max(map(abs, values.values()), default=1.0)
            for e, c in values.items():
                coefficients[row, index[e]] = c / scale
        exponents = np.array(monomials, dtype=np.int64).reshape(len(monomials), n)
        return cls(n, exponents, coefficients)

    def _monomials(self, points: np.ndarray) -> np.ndarray:
        return _powers(points, self.exponents)

    def values(self, points: np.ndarray) -> np.ndarray:
        """Values, shape ``(P, rows)``, at ``points`` of shape ``(P, n)``."""
        return self._monomials(np.asarray(points, dtype=complex)) @ self.coefficients.T

    def sizes(self, points: np.ndarray) -> np.ndarray:
        """Sums of the absolute values of the terms, coordinates below one counted as one.

        Shape ``(P, rows)``. Without that floor a single term would never be small beside itself.
        """
        floored = np.maximum(np.abs(points), 1.0)
        sizes = self._monomials(floored) @ np.abs(self.coefficients).T
        return np.where(sizes == 0, 1.0, sizes)

    def residuals(self, points: np.ndarray) -> np.ndarray:
        """Absolute values over sizes, shape ``(P, rows)``: 1e-16 is rounding at any scale."""
        return np.abs(self.values(points)) / self.sizes(points)

    @cached_property
    def _derivatives(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Exponents of the derivatives' monomials; place, monomial and factor of their terms."""
        lowered: dict[tuple[int, ...], int] = {}
        places, monomials, factors = [], [], []
        for row, m in zip(*np.nonzero(self.coefficients), strict=True):
            exponents = tuple(self.exponents[m].tolist())
            for i in np.flatnonzero(self.exponents[m]):
                less = (*exponents[:i], exponents[i] - 1, *exponents[i + 1 :])
                places.append(row * self.n + i)
                monomials.append(lowered.setdefault(less, len(lowered)))
                factors.append(exponents[i] * self.coefficients[row, m])
        table = np.array(list(lowered), dtype=np.int64).reshape(len(lowered), self.n)
        return (
            table,
            np.array(places, dtype=np.int64),
            np.array(monomials, dtype=np.int64),
            np.array(factors, dtype=float),
        )

    def jacobian(self, point: np.ndarray) -> np.ndarray:
        """Jacobian matrix, shape ``(rows, n)``, at one point."""
        table, places, monomials, factors = self._derivatives
        values = _powers(np.asarray(point, dtype=complex)[None], table)[0]
        terms = factors * values[monomials]
        size = len(self.coefficients) * self.n
        result = np.bincount(places, terms.real, size) + 1j * np.bincount(places, terms.imag, size)
        return result.reshape(len(self.coefficients), self.n)

    @cached_property
    def degrees(self) -> np.ndarray:
        """Total degrees of the rows, at least one."""
        totals = self.exponents.sum(axis=1)
        return np.array([totals[row != 0].max(initial=1) for row in self.coefficients], dtype=int)

    def balanced_jacobian(self, point: np.ndarray) -> np.ndarray:
        """The Jacobian with each row divided by the size that its degree lets it have."""
        size = max(1.0, float(np.abs(point).max(initial=1.0)))
        return self.jacobian(point) / size ** (self.degrees - 1)[:, None]


def _powers(points: np.ndarray, exponents: np.ndarray) -> np.ndarray:
    """Monomials at points of shape ``(P, n)``, shape ``(P, M)``."""
    values = np.ones((len(points), len(exponents)), dtype=points.dtype)
    for i in range(points.shape[1]):
        column = points[:, i, None]
        power = column
        for k in range(1, int(exponents[:, i].max(initial=0)) + 1):
            power = power * column if k > 1 else column
            where = np.flatnonzero(exponents[:, i] == k)
            if len(where):
                values[:, where] *= power
    return values
