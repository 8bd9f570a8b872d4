"""Values, sizes and Jacobians of polynomials at many complex points at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nag.algebra.polynomial import Polynomial

# Coordinates whose powers may leave the range of doubles.
HUGE = 1e30
# Larger Jacobians are summed up term by term.
MOST_ENTRIES = 20_000
# Values of monomials that are in memory at once; more points are gone through in blocks.
TOGETHER = 1 << 16


@dataclass(frozen=True, eq=False)
class Evaluator:
    """Polynomials in ``n`` variables as flat arrays, scaled to largest coefficient one.

    What leaves the range of doubles is not finite, without a warning.

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
            values = f.doubles
            scale = max(map(abs, values), default=1.0)
            places = [index[e] for e in f.terms]
            coefficients[row, places] = [c / scale for c in values]
        exponents = np.array(monomials, dtype=np.int64).reshape(len(monomials), n)
        for array in (coefficients, exponents):
            array.setflags(write=False)
        return cls(n, exponents, coefficients)

    @cached_property
    def _monomials(self) -> _Monomials:
        return _Monomials.of(self.exponents)

    @np.errstate(over="ignore", invalid="ignore")
    def values(self, points: np.ndarray) -> np.ndarray:
        """Values, shape ``(P, rows)``, at ``points`` of shape ``(P, n)``."""
        return self._monomials.combine(np.asarray(points, dtype=complex), self.coefficients.T)

    @np.errstate(over="ignore", invalid="ignore")
    def last_coefficients(self, series: np.ndarray) -> np.ndarray:
        """Coefficients of the highest power of values at power series, shape ``(P, rows)``.

        Constant terms of the series that are large do not spoil them, as they multiply nothing but
        what is in the coefficients.

        Args:
            series: of each coordinate, cut off behind that power, shape ``(P, n, K)``.
        """
        return self._monomials.last_coefficients(series) @ self.coefficients.T

    @np.errstate(over="ignore", invalid="ignore")
    def sizes(self, points: np.ndarray) -> np.ndarray:
        """Sums of the absolute values of the terms, coordinates below one counted as one.

        Shape ``(P, rows)``. Without that floor a single term would never be small beside itself.
        """
        floored = np.maximum(np.abs(points), 1.0)
        sizes = self._monomials.combine(floored, np.abs(self.coefficients).T)
        return np.where(sizes == 0, 1.0, sizes)

    @np.errstate(over="ignore", invalid="ignore")
    def absolute(self, points: np.ndarray) -> np.ndarray:
        """Sums of the absolute values of the terms, shape ``(P, rows)``."""
        return self._monomials.combine(np.abs(points), np.abs(self.coefficients).T)

    def residuals(self, points: np.ndarray) -> np.ndarray:
        """Absolute values over sizes, shape ``(P, rows)``: 1e-16 is rounding at any scale."""
        points = np.asarray(points, dtype=complex)
        far = np.abs(points).max(axis=1, initial=0.0) > HUGE
        if far.any():
            result = np.zeros((len(points), len(self.coefficients)))
            result[~far] = self.residuals(points[~far])
            result[far] = [self._far_residuals(x) for x in points[far]]
            return result
        return np.abs(self.values(points)) / self.sizes(points)

    @np.errstate(over="ignore", invalid="ignore")
    def rounding_residuals(self, point: np.ndarray, error: float) -> np.ndarray:
        """Residuals, shape ``(rows,)``, that rounding a zero to the point leaves, to first order.

        Args:
            error: of each coordinate relative to its size, or to one if that is larger.
        """
        moved = error * np.maximum(np.abs(point), 1.0)
        left = np.abs(self.jacobian(point)) @ moved / self.sizes(np.asarray(point)[None])[0]
        return np.where(np.isfinite(left), left, 0.0)

    def _far_residuals(self, point: np.ndarray) -> np.ndarray:
        """Residuals where powers of the coordinates may leave the range of doubles."""
        size = float(np.abs(point).max())
        weights = self.coefficients * self._lower_powers(
            size, self.exponents.sum(axis=1), self.degrees
        )
        values = weights @ self._monomials(point[None] / size)[0]
        floored = np.maximum(np.abs(point), 1.0) / size
        sizes = np.abs(weights) @ self._monomials(floored[None])[0]
        return np.abs(values) / np.where(sizes == 0, 1.0, sizes)

    def _lower_powers(self, size: float, degrees: np.ndarray, tops: np.ndarray) -> np.ndarray:
        """Powers ``size ** (degrees - tops)``, shape ``(tops, degrees)``; they may be 0."""
        return np.exp2(np.minimum(np.log2(size) * (degrees[None] - tops[:, None]), 0.0))

    @cached_property
    def _derivatives(self) -> tuple[_Monomials, np.ndarray, np.ndarray, np.ndarray]:
        """The derivatives' monomials; place, monomial and factor of their terms."""
        lowered: dict[tuple[int, ...], int] = {}
        places, monomials, factors = [], [], []
        exponents = self.exponents.tolist()
        for row, coefficients in enumerate(self.coefficients.tolist()):
            for e, c in zip(exponents, coefficients, strict=True):
                if not c:
                    continue
                for i, k in enumerate(e):
                    if k:
                        less = (*e[:i], k - 1, *e[i + 1 :])
                        places.append(row * self.n + i)
                        monomials.append(lowered.setdefault(less, len(lowered)))
                        factors.append(k * c)
        table = np.array(list(lowered), dtype=np.int64).reshape(len(lowered), self.n)
        return (
            _Monomials.of(table),
            np.array(places, dtype=np.int64),
            np.array(monomials, dtype=np.int64),
            np.array(factors, dtype=self.coefficients.dtype),
        )

    @cached_property
    def _slopes(self) -> np.ndarray | None:
        """The Jacobian's entries as combinations of the derivatives' monomials, if these are few.

        Shape ``(monomials, rows * n)``.
        """
        powers, places, monomials, factors = self._derivatives
        shape = powers.factors.shape[1], len(self.coefficients) * self.n
        if shape[0] * shape[1] > MOST_ENTRIES:
            return None
        matrix = np.zeros(shape, dtype=complex)
        # No monomial occurs twice in an entry.
        matrix[monomials, places] = factors
        return matrix

    @np.errstate(over="ignore", invalid="ignore")
    def jacobian(self, point: np.ndarray) -> np.ndarray:
        """Jacobian matrix, shape ``(rows, n)``, at one point."""
        powers, places, monomials, factors = self._derivatives
        values = powers(np.asarray(point, dtype=complex)[None])[0]
        if self._slopes is not None:
            return (values @ self._slopes).reshape(len(self.coefficients), self.n)
        terms = factors * values[monomials]
        size = len(self.coefficients) * self.n
        result = np.bincount(places, terms.real, size) + 1j * np.bincount(places, terms.imag, size)
        return result.reshape(len(self.coefficients), self.n)

    def placed_derivatives(self, columns: int) -> PlacedDerivatives:
        """The derivatives by the first so many variables, to be evaluated at many points."""
        powers, places, monomials, factors = self._derivatives
        kept = np.flatnonzero(places % self.n < columns)
        kept = kept[np.argsort(places[kept], kind="stable")]
        return PlacedDerivatives(
            powers,
            places[kept] // self.n * columns + places[kept] % self.n,
            monomials[kept],
            factors[kept],
            (len(self.coefficients), columns),
        )

    def term_sizes(self, points: np.ndarray, columns: int) -> tuple[np.ndarray, np.ndarray]:
        """Sums of the terms' absolute values, and those sums times ``d (d - 1)``, ``(P, rows)``.

        ``d`` is a term's degree in the first ``columns`` variables; the second sums bound second
        derivatives in directions that are relative to the coordinates.
        """
        degrees = self.exponents[:, :columns].sum(axis=1)
        sizes = self._monomials(np.abs(np.asarray(points, dtype=complex)))
        weights = np.abs(self.coefficients).T
        return sizes @ weights, (sizes * (degrees * (degrees - 1))) @ weights

    @cached_property
    def degrees(self) -> np.ndarray:
        """Total degrees of the rows, at least one."""
        totals = self.exponents.sum(axis=1)
        return np.array([totals[row != 0].max(initial=1) for row in self.coefficients], dtype=int)

    def balanced_jacobian(self, point: np.ndarray) -> np.ndarray:
        """The Jacobian with each row divided by the size that its degree lets it have."""
        size = max(1.0, float(np.abs(point).max(initial=1.0)))
        if size > HUGE:
            # The derivatives at the point over its size, each term by what it lacks in degree.
            scaled = Evaluator(
                self.n,
                self.exponents,
                self.coefficients
                * self._lower_powers(size, self.exponents.sum(axis=1), self.degrees),
            )
            return scaled.jacobian(np.asarray(point) / size)
        return self.jacobian(point) / size ** (self.degrees - 1)[:, None]

    @np.errstate(over="ignore", invalid="ignore")
    def balanced_jacobians(self, points: np.ndarray) -> np.ndarray:
        """The same at many points of shape ``(P, n)``: shape ``(P, rows, n)``."""
        points = np.asarray(points, dtype=complex)
        sizes = np.abs(points).max(axis=1, initial=1.0)
        shape = len(points), len(self.coefficients), self.n
        if self._slopes is None or not sizes.max(initial=1.0) <= HUGE:
            return np.array([self.balanced_jacobian(x) for x in points]).reshape(shape)
        powers, *_ = self._derivatives
        slopes = (powers(points) @ self._slopes).reshape(shape)
        return slopes / (sizes[:, None] ** (self.degrees - 1))[:, :, None]


@dataclass(frozen=True, eq=False)
class PlacedDerivatives:
    """Terms of a Jacobian matrix of the given shape, sorted by their places in it."""

    powers: _Monomials
    places: np.ndarray
    monomials: np.ndarray
    factors: np.ndarray
    shape: tuple[int, int]

    def __call__(self, points: np.ndarray) -> np.ndarray:
        """Jacobian matrices, shape ``(P, *shape)``, at points of shape ``(P, n)``."""
        terms = self.powers(np.asarray(points, dtype=complex))[:, self.monomials] * self.factors
        result = np.zeros((len(points), self.shape[0] * self.shape[1]), dtype=complex)
        places, first = np.unique(self.places, return_index=True)
        if len(places):
            result[:, places] = np.add.reduceat(terms, first, axis=1)
        return result.reshape(len(points), *self.shape)


@dataclass(frozen=True, eq=False)
class _Monomials:
    """Monomials as products of entries of a table of powers.

    Attributes:
        top: the highest power.
        factors: int, shape ``(S, M)``: where the factors of each monomial stand in a row of the
            table, ``x_i^k`` at place ``i * (top + 1) + k``; the rest are the entry at 0, a one.
    """

    top: int
    factors: np.ndarray

    @classmethod
    def of(cls, exponents: np.ndarray) -> _Monomials:
        top = int(exponents.max(initial=0))
        rows, columns = np.nonzero(exponents)
        # The factors of a monomial stand in neighbouring places of `rows`.
        slots = np.arange(len(rows)) - np.searchsorted(rows, rows)
        factors = np.zeros((int(slots.max(initial=-1)) + 1, len(exponents)), dtype=np.int64)
        factors[slots, rows] = columns * (top + 1) + exponents[rows, columns]
        return cls(top, factors)

    def __call__(self, points: np.ndarray) -> np.ndarray:
        """Values at points of shape ``(P, n)``, shape ``(P, M)``."""
        if not len(self.factors):
            return np.ones((len(points), self.factors.shape[1]), dtype=points.dtype)
        table = np.ones((*points.shape, self.top + 1), dtype=points.dtype)
        for k in range(1, self.top + 1):
            table[:, :, k] = table[:, :, k - 1] * points
        table = table.reshape(len(points), points.shape[1] * (self.top + 1))
        values = table[:, self.factors[0]]
        for places in self.factors[1:]:
            values *= table[:, places]
        return values

    def combine(self, points: np.ndarray, weights: np.ndarray) -> np.ndarray:
        """Combinations of the values at points of shape ``(P, n)``, shape ``(P, rows)``.

        Args:
            weights: of the monomials, shape ``(M, rows)``.
        """
        # Matrix products round alike in blocks of a multiple of 64 rows.
        together = 64 * max(1, TOGETHER // (64 * max(1, len(weights))))
        if len(points) <= together:
            return self(points) @ weights
        kind = np.result_type(points, weights)
        result = np.empty((len(points), weights.shape[1]), dtype=kind)
        for first in range(0, len(points), together):
            some = slice(first, first + together)
            result[some] = self(points[some]) @ weights
        return result

    def last_coefficients(self, series: np.ndarray) -> np.ndarray:
        """Coefficients of the highest power at power series, ``(P, n, K)``, shape ``(P, M)``."""
        count, n, length = series.shape
        if not len(self.factors):
            ones = np.ones((count, self.factors.shape[1]), dtype=series.dtype)
            return ones * (length == 1)
        table = np.zeros((count, n, self.top + 1, length), dtype=series.dtype)
        table[..., 0, 0] = 1.0
        for k in range(1, self.top + 1):
            table[:, :, k] = series_products(table[:, :, k - 1], series)
        table = table.reshape(count, n * (self.top + 1), length)
        *others, last = self.factors
        if not others:
            return table[:, last, -1]
        values = table[:, others[0]]
        for places in others[1:]:
            values = series_products(values, table[:, places])
        return np.einsum("pmk,pmk->pm", values, table[:, last, ::-1])


def series_products(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Products of power series along the last axis, cut off where they are."""
    result, length = np.zeros_like(a), a.shape[-1]
    for k in range(length):
        result[..., k:] += a[..., : length - k] * b[..., k : k + 1]
    return result


def may_vanish(
    systems: Sequence[Sequence[Polynomial]], points: np.ndarray, limit: float
) -> np.ndarray:
    """At which points all polynomials of which systems may vanish, shape ``(P, systems)``.

    Args:
        points: complex, shape ``(P, n)``.
        limit: residuals above which a polynomial certainly does not vanish at a point.
    """
    place: dict[Polynomial, int] = {}
    rows = [[place.setdefault(f, len(place)) for f in system] for system in systems]
    small = Evaluator.of(list(place), points.shape[1]).residuals(points) < limit
    columns = [small[:, np.array(chosen, dtype=np.int64)].all(axis=1) for chosen in rows]
    return np.array(columns, dtype=bool).reshape(len(systems), len(points)).T
