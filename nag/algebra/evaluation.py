"""Values, sizes and Jacobians of polynomials at many complex points at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

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
        values = np.ones((len(points), len(self.exponents)), dtype=points.dtype)
        for i in range(self.n):
            top = int(self.exponents[:, i].max(initial=0))
            if top:
                powers = points[:, i, None] ** np.arange(top + 1)
                values = values * powers[:, self.exponents[:, i]]
        return values

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

    def jacobian(self, point: np.ndarray) -> np.ndarray:
        """Jacobian matrix, shape ``(rows, n)``, at one point."""
        point = np.asarray(point, dtype=complex)
        columns = []
        for i in range(self.n):
            k = self.exponents[:, i]
            lowered = self.exponents.copy()
            lowered[:, i] = np.maximum(k - 1, 0)
            monomials = k * np.prod(point**lowered, axis=1)
            columns.append(self.coefficients @ monomials)
        return np.array(columns).T.reshape(len(self.coefficients), self.n)

    def balanced_jacobian(self, point: np.ndarray) -> np.ndarray:
        """The Jacobian with each row divided by the size that its degree lets it have."""
        degrees = np.array(
            [self.exponents[row != 0].sum(axis=1).max(initial=1) for row in self.coefficients]
        ).reshape(-1, 1)
        size = max(1.0, float(np.abs(point).max(initial=1.0)))
        return self.jacobian(point) / size ** np.maximum(degrees - 1, 0)
