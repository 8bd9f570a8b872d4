"""Complex discs in doubles, many at once, with bounds of all rounding errors.

A disc is a midpoint and a radius; every operation's disc holds all values of the exact operation on
numbers of its arguments' discs. Radii are enlarged by more than rounding to the nearest can do, so
that no rounding mode has to be set; an overflow gives radii that are infinite or no numbers, with
which nothing can be proved.

References:
    Rump, Fast and parallel interval arithmetic, 1999;
    Higham, Accuracy and Stability of Numerical Algorithms, 2002, sections 3.1 and 3.6;
    Brent, Percival & Zimmermann, Error bounds on complex floating-point multiplication, 2007.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csr_array, vstack

from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.numerics.doubles import UNIT

# Rounding of a complex product is below sqrt(5) units, of a few operations on radii below 2^-48.
PRODUCT = 8 * UNIT
UP = 1 + 2.0**-46
Terms = Mapping[tuple[int, ...], Number | complex]

# Underflow loses less than this, whatever the sums are long.
LEAST = 2.0**-1000


class Discs(NamedTuple):
    """Midpoints, complex, and radii, real, of the same shape."""

    mid: np.ndarray
    rad: np.ndarray


def magnitude(z: np.ndarray) -> np.ndarray:
    """Upper bounds of absolute values."""
    return np.abs(z) * UP


def product(a: Discs, b: Discs) -> Discs:
    """Discs of the products."""
    size_a, size_b = magnitude(a.mid), magnitude(b.mid)
    rad = size_a * b.rad + a.rad * (size_b + b.rad) + PRODUCT * size_a * size_b
    return Discs(a.mid * b.mid, rad * UP + LEAST)


def rounding_of_sum(length: int) -> float:
    """Relative error of a sum of so many complex products, added in any order, and of factors.

    Twice the bound of Higham, (3.3), and room for factors that are off by a unit or two.
    """
    return (2 * length + 16) * 2 * UNIT


@dataclass(frozen=True, eq=False)
class Weights:
    """A sparse matrix of exact numbers: its doubles, and what they may be off by.

    Attributes:
        matrix, size: doubles, and their absolute values.
        rounding: relative error of one product with a vector of discs.
    """

    matrix: Any
    size: Any
    rounding: float

    @classmethod
    def of(
        cls, entries: Sequence[tuple[int, int, Number | complex]], shape: tuple[int, int]
    ) -> Weights:
        """The matrix with such entries: row, column and value.

        Raises:
            OverflowError: if a value is too large or too small for a double.
        """
        rows = np.array([e[0] for e in entries], dtype=np.int64)
        columns = np.array([e[1] for e in entries], dtype=np.int64)
        values = np.array([_nearest(e[2]) for e in entries])
        if not np.isfinite(values).all() or np.abs(values).min(initial=1.0) < LEAST:
            raise OverflowError("a coefficient is too large or too small for a double")
        matrix = csr_array((values, (rows, columns)), shape=shape)
        longest = int(np.bincount(rows, minlength=1).max(initial=0))
        return cls(matrix, abs(matrix), rounding_of_sum(longest))

    def __matmul__(self, x: Discs) -> Discs:
        """Products with vectors of discs, shape ``(columns, P)``, to ``(rows, P)``."""
        mid = self.matrix @ x.mid
        rad = self.size @ (x.rad + self.rounding * magnitude(x.mid))
        return Discs(mid, rad * (UP + self.rounding) + LEAST)


def _nearest(value: Number | complex) -> complex | float:
    return value if isinstance(value, complex) else float(value)


def matrix_product(a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """``a @ b`` of stacks of exact doubles, and bounds of its rounding errors."""
    rounding = rounding_of_sum(a.shape[-1])
    return a @ b, (magnitude(a) @ magnitude(b)) * (rounding * UP) + LEAST


@dataclass(frozen=True, eq=False)
class DiscPolynomials:
    """Polynomials and linear rows, to be evaluated with their Jacobian on many boxes of discs.

    Attributes:
        n: number of variables; rows: number of rows.
        powers: distinct monomials as places in a table of powers, see `_monomials`.
        values, slopes: the weights of the monomials in each row, and in each derivative.
    """

    n: int
    rows: int
    top: int
    powers: np.ndarray
    values: Weights
    slopes: Weights

    @classmethod
    def of(cls, polynomials: Sequence[Polynomial], slices: np.ndarray) -> DiscPolynomials:
        """Exact polynomials and rows on ``(1, x)``, whose doubles are exact, shape ``(d, 1 + n)``.

        Raises:
            OverflowError: if a coefficient is too large or too small for a double.
        """
        return cls.of_terms([f.terms for f in polynomials], slices)

    @classmethod
    def of_terms(cls, polynomials: Sequence[Terms], slices: np.ndarray) -> DiscPolynomials:
        """The same of maps from exponents to exact numbers, or to doubles that are exact.

        Raises:
            OverflowError: if a coefficient is too large or too small for a double.
        """
        n = slices.shape[1] - 1
        units = [tuple(int(i == j) for j in range(n)) for i in range(n)]
        rows: list[list[tuple[tuple[int, ...], Any]]] = [list(f.items()) for f in polynomials]
        rows += [
            [(e, complex(c)) for e, c in zip([(0,) * n, *units], row, strict=True) if c]
            for row in slices
        ]
        place: dict[tuple[int, ...], int] = {}
        values, slopes = [], []
        for i, row in enumerate(rows):
            for e, c in row:
                values.append((i, place.setdefault(e, len(place)), c))
                for j, k in enumerate(e):
                    if k:
                        less = (*e[:j], k - 1, *e[j + 1 :])
                        slopes.append((i * n + j, place.setdefault(less, len(place)), k * c))
        factors, top = _places(list(place), n)
        shape = len(rows), len(place)
        return cls(
            n, len(rows), top, factors,
            Weights.of(values, shape), Weights.of(slopes, (len(rows) * n, len(place))),
        )  # fmt: skip

    def __call__(self, x: Discs) -> Discs:
        """Values on boxes, shape ``(P, n)``: shape ``(P, rows)``."""
        found = self.values @ self._monomials(x)
        return Discs(found.mid.T, found.rad.T)

    def jacobian(self, x: Discs) -> Discs:
        """Jacobian matrices on boxes, shape ``(P, rows, n)``."""
        found = self.slopes @ self._monomials(x)
        shape = (len(x.mid), self.rows, self.n)
        return Discs(found.mid.T.reshape(shape), found.rad.T.reshape(shape))

    def middles(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Values and Jacobian matrices at points, to rounding, without bounds.

        Shapes ``(P, rows)`` and ``(P, rows, n)``.
        """
        table = [np.ones_like(x.T), x.T]
        while len(table) <= self.top:
            table.append(table[-1] * table[1])
        powers = np.concatenate(table[: self.top + 1])
        first, *others = self.powers
        monomials = powers[first]
        for places in others:
            several = np.flatnonzero(places)
            monomials[several] *= powers[places[several]]
        found = (self._values_and_slopes @ monomials).T
        return found[:, : self.rows], found[:, self.rows :].reshape(len(x), self.rows, self.n)

    @cached_property
    def _values_and_slopes(self) -> Any:
        return vstack([self.values.matrix, self.slopes.matrix], format="csr")

    def _monomials(self, x: Discs) -> Discs:
        """All monomials, shape ``(M, P)``."""
        table = [Discs(np.ones_like(x.mid.T), np.zeros_like(x.rad.T)), Discs(x.mid.T, x.rad.T)]
        while len(table) <= self.top:
            table.append(product(table[-1], table[1]))
        mid = np.concatenate([t.mid for t in table[: self.top + 1]])
        rad = np.concatenate([t.rad for t in table[: self.top + 1]])
        first, *others = self.powers
        found = Discs(mid[first], rad[first])
        for places in others:
            several = np.flatnonzero(places)
            these = Discs(found.mid[several], found.rad[several])
            more = product(these, Discs(mid[places[several]], rad[places[several]]))
            found.mid[several], found.rad[several] = more
        return found


def _places(monomials: Sequence[tuple[int, ...]], n: int) -> tuple[np.ndarray, int]:
    """Factors of each monomial in a table of powers, whose row ``k n + i`` is ``x_i^k``.

    The rest of its places are row 0, a one.
    """
    factors = [[k * n + i for i, k in enumerate(e) if k] for e in monomials]
    longest = max(map(len, factors), default=0)
    places = np.zeros((max(longest, 1), len(monomials)), dtype=np.int64)
    for m, chosen in enumerate(factors):
        places[: len(chosen), m] = chosen
    return places, max((k for e in monomials for k in e), default=0)
