"""Exact polynomials and linear rows on boxes of FLINT's balls, at the working precision."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
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
class BallPolynomials:
    """Rows of terms: pairs of a coefficient and the variables in it with their exponents."""

    n: int
    rows: tuple[tuple[tuple[Any, Factors], ...], ...]
    _known: dict[int, list[list[tuple[flint.acb, Factors]]]] = field(
        default_factory=dict, repr=False
    )

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

    def _terms(self) -> list[list[tuple[flint.acb, Factors]]]:
        bits = flint.ctx.prec
        if bits not in self._known:
            self._known[bits] = [[(_ball(c), f) for c, f in row] for row in self.rows]
        return self._known[bits]

    def __call__(self, x: Sequence[flint.acb]) -> flint.acb_mat:
        """Values, a column."""
        values = []
        for row in self._terms():
            total = flint.acb(0)
            for c, factors in row:
                for i, k in factors:
                    c = c * x[i] ** k
                total = total + c
            values.append(total)
        return flint.acb_mat(len(values), 1, values)

    def jacobian(self, x: Sequence[flint.acb]) -> flint.acb_mat:
        """The Jacobian matrix."""
        entries = [flint.acb(0)] * (len(self.rows) * self.n)
        for r, row in enumerate(self._terms()):
            for c, factors in row:
                powers = [x[i] ** k for i, k in factors]
                after = [flint.acb(1)]
                for p in reversed(powers):
                    after.append(after[-1] * p)
                before = c
                for place, (i, k) in enumerate(factors):
                    slope = before * after[len(factors) - 1 - place]
                    if k > 1:
                        slope = slope * k * x[i] ** (k - 1)
                    entries[r * self.n + i] += slope
                    before = before * powers[place]
        return flint.acb_mat(len(self.rows), self.n, entries)


def _ball(c: Any) -> flint.acb:
    value = number(c)
    if isinstance(c, Irrational):
        off = abs(value) * flint.arb(2) ** (GUARD - flint.ctx.prec)
        value = value + flint.acb(flint.arb(0, off.upper()))
    return value
