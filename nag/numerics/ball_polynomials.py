"""Exact polynomials and linear rows on boxes of FLINT's balls, at the working precision."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import flint
import numpy as np

from nag.algebra.number import Irrational
from nag.algebra.polynomial import Polynomial
from nag.numerics.digits import number

# Bits in which the value of an expression may be off, which is evaluated to more than those asked.
GUARD = 4

Factors = tuple[tuple[int, int], ...]


@dataclass(frozen=True, eq=False)
class Monomials:
    """Products of powers of the variables, each made of an earlier one and one power.

    Attributes:
        powers: pairs of a variable and an exponent.
        made: for each product after the first, which is one, its part and a power, as places.
        places: of the products, by their factors.
    """

    powers: tuple[tuple[int, int], ...]
    made: tuple[tuple[int, int], ...]
    places: dict[Factors, int]

    @classmethod
    def of(cls, wanted: Iterable[Factors]) -> Monomials:
        places: dict[Factors, int] = {(): 0}
        powers: dict[tuple[int, int], int] = {}
        made = []
        for factors in wanted:
            for count in range(1, len(factors) + 1):
                part = factors[:count]
                if part not in places:
                    places[part] = len(places)
                    power = powers.setdefault(part[-1], len(powers))
                    made.append((places[part[:-1]], power))
        return cls(tuple(powers), tuple(made), places)

    def values(self, x: Sequence[flint.acb]) -> list[flint.acb]:
        powers = [x[i] if k == 1 else x[i] ** k for i, k in self.powers]
        found = [flint.acb(1)]
        for part, power in self.made:
            found.append(found[part] * powers[power] if part else powers[power])
        return found


@dataclass(frozen=True, eq=False)
class Slopes:
    """The derivatives of a row: a matrix of coefficients times a column of monomials.

    Attributes:
        variables: in the row.
        monomials: in its derivatives, as places.
        entries: the matrix row by row, each a coefficient of the row and a factor, or None.
    """

    variables: tuple[int, ...]
    monomials: tuple[int, ...]
    entries: tuple[tuple[Any, int] | None, ...]


@dataclass(frozen=True, eq=False)
class BallPolynomials:
    """Rows of terms: pairs of a coefficient and the variables in it with their exponents."""

    n: int
    rows: tuple[tuple[tuple[Any, Factors], ...], ...]
    _terms: dict[int, list[list[tuple[flint.acb, int]]]] = field(default_factory=dict, repr=False)
    _matrices: dict[int, list[flint.acb_mat]] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, polynomials: Sequence[Polynomial], slices: np.ndarray) -> BallPolynomials:
        """Exact polynomials, and rows on ``(1, x)``, of exact doubles, shape ``(d, 1 + n)``."""
        rows = [
            tuple((c, tuple((i, k) for i, k in enumerate(e) if k)) for e, c in f.terms.items())
            for f in polynomials
        ]
        for row in slices:
            terms = [(complex(c), ((j, 1),)) for j, c in enumerate(row[1:])]
            rows.append(((complex(row[0]), ()), *terms))
        return cls(slices.shape[1] - 1, tuple(rows))

    def rows_of(self, chosen: Sequence[int]) -> BallPolynomials:
        """Some of the rows."""
        return BallPolynomials(self.n, tuple(self.rows[i] for i in chosen))

    def __call__(self, x: Sequence[flint.acb]) -> flint.acb_mat:
        """Values, a column."""
        monomials, bits = self._monomials, flint.ctx.prec
        if bits not in self._terms:
            places = monomials.places
            self._terms[bits] = [[(_ball(c), places[f]) for c, f in row] for row in self.rows]
        at, values = monomials.values(x), []
        for row in self._terms[bits]:
            # Terms that cancel exactly leave no error, as they would in a product of matrices.
            total = flint.acb(0)
            for c, place in row:
                total = total + c * at[place]
            values.append(total)
        return flint.acb_mat(len(values), 1, values)

    def jacobian(self, x: Sequence[flint.acb]) -> flint.acb_mat:
        """The Jacobian matrix."""
        (monomials, slopes), bits = self._slopes, flint.ctx.prec
        if bits not in self._matrices:
            self._matrices[bits] = [_matrix(s) for s in slopes]
        at = monomials.values(x)
        entries = [flint.acb(0)] * (len(self.rows) * self.n)
        for r, (row, matrix) in enumerate(zip(slopes, self._matrices[bits], strict=True)):
            column = flint.acb_mat(len(row.monomials), 1, [at[m] for m in row.monomials])
            for i, slope in zip(row.variables, (matrix * column).entries(), strict=True):
                entries[r * self.n + i] = slope
        return flint.acb_mat(len(self.rows), self.n, entries)

    @cached_property
    def _monomials(self) -> Monomials:
        return Monomials.of(f for row in self.rows for _, f in row)

    @cached_property
    def _slopes(self) -> tuple[Monomials, list[Slopes]]:
        derivatives = [
            [(i, _lower(f, place), (c, k)) for c, f in row for place, (i, k) in enumerate(f)]
            for row in self.rows
        ]
        monomials = Monomials.of(f for row in derivatives for _, f, _ in row)
        return monomials, [_slopes_of(row, monomials) for row in derivatives]


def _lower(factors: Factors, place: int) -> Factors:
    """The factors of the derivative by the variable at a place."""
    i, k = factors[place]
    return factors[:place] + (((i, k - 1),) if k > 1 else ()) + factors[place + 1 :]


def _slopes_of(
    derivatives: Sequence[tuple[int, Factors, tuple[Any, int]]], monomials: Monomials
) -> Slopes:
    variables = {i: v for v, i in enumerate(sorted({i for i, _, _ in derivatives}))}
    columns: dict[int, int] = {}
    for _, f, _ in derivatives:
        columns.setdefault(monomials.places[f], len(columns))
    entries: list[tuple[Any, int] | None] = [None] * (len(variables) * len(columns))
    for i, f, entry in derivatives:
        entries[variables[i] * len(columns) + columns[monomials.places[f]]] = entry
    return Slopes(tuple(variables), tuple(columns), tuple(entries))


def _matrix(slopes: Slopes) -> flint.acb_mat:
    entries = [flint.acb(0) if e is None else _ball(e[0]) * e[1] for e in slopes.entries]
    return flint.acb_mat(len(slopes.variables), len(slopes.monomials), entries)


def _ball(c: Any) -> flint.acb:
    value = number(c)
    if isinstance(c, Irrational):
        off = abs(value) * flint.arb(2) ** (GUARD - flint.ctx.prec)
        value = value + flint.acb(flint.arb(0, off.upper()))
    return value
