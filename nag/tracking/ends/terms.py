"""The rows of a homotopy in balls, in as many bits as are asked for."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any

import flint
import numpy as np

from nag.algebra.number import Number
from nag.numerics.ball_polynomials import BallPolynomials, Factors, factors_of, in_ball
from nag.numerics.digits import in_bits
from nag.tracking.homotopy import Homotopy

# Bits of working precision for numbers of as many words.
BITS = {2: 140, 4: 280, 8: 560}
# Under what name rows keep themselves at the end of paths on which they do not change.
AT_END = "balls at the end"
# A monomial; with it, the coefficients of 1 and of t.
Term = tuple[Factors, Any, Any]


@dataclass(frozen=True, eq=False)
class Terms:
    """The terms of all rows of a homotopy, the linear ones last."""

    homotopy: Homotopy
    _rows: dict[int, list[list[Term]]] = field(default_factory=dict, repr=False)

    def rows(self, bits: int) -> list[list[Term]]:
        """For each row its terms."""
        if bits not in self._rows:
            with in_bits(bits):
                self._rows[bits] = self._in_balls()
        return self._rows[bits]

    def _in_balls(self) -> list[list[Term]]:
        h = self.homotopy
        rows: list[list[Term]] = []
        for row in h.rows.parts:
            terms = []
            for part, own in row:
                a, b = (flint.acb(c) for c in h.factors[part])
                for e, c in own.items():
                    value = in_ball(c)
                    terms.append((factors_of(e), value * a, value * b))
            rows.append(terms)
        for first, second in zip(h.A0.tolist(), h.A1.tolist(), strict=True):
            pairs = zip(first, second, strict=True)
            rows.append([(((j, 1),), flint.acb(a), flint.acb(b)) for j, (a, b) in enumerate(pairs)])
        return rows

    @cached_property
    def at_end(self) -> BallPolynomials:
        """The rows at t = 0."""
        h = self.homotopy
        lines = [
            tuple((c, ((j, 1),)) for j, c in enumerate(line) if c != 0) for line in h.A0.tolist()
        ]
        return BallPolynomials(h.N, tuple(lines), _polynomials_at_end(h))

    def with_patches(self, x: list[flint.acb], bits: int) -> BallPolynomials:
        """The rows at t = 0, and one for each group, whose product with a point is 1."""
        rows = []
        with in_bits(bits):
            for group in self.homotopy.groups:
                conjugates = [(j, x[j].mid().conjugate()) for j in group]
                size = sum((c * x[j] for j, c in conjugates), flint.acb(0)).mid()
                parts = [((c / size).mid(), ((j, 1),)) for j, c in conjugates]
                rows.append(((-1, ()), *parts))
        return BallPolynomials(self.homotopy.N, tuple(rows), self.at_end)


def _polynomials_at_end(h: Homotopy) -> BallPolynomials:
    """The rows that are not linear, at t = 0; all homotopies that only move slices share them."""
    factors = [a for a, _ in h.factors]
    shared = all(a == 1 for a in factors)
    known = h.rows._cache.get(AT_END) if shared else None
    if isinstance(known, BallPolynomials):
        return known
    rows = tuple(
        tuple(
            (times(c, factors[part]), factors_of(e))
            for part, own in row
            if factors[part] != 0
            for e, c in own.items()
            if c != 0
        )
        for row in h.rows.parts
    )
    found = BallPolynomials(h.N, rows)
    if shared:
        h.rows._cache[AT_END] = found
    return found


def times(c: Number | complex, factor: complex) -> Any:
    """The product of a coefficient with a double, exactly: as real and imaginary part."""
    if factor == 1:
        return c
    parts = [Fraction(x) for x in (factor.real, factor.imag)]
    if isinstance(c, complex | float | np.complexfloating | np.floating):
        z = complex(c)
        x, y = Fraction(z.real), Fraction(z.imag)
        return x * parts[0] - y * parts[1], x * parts[1] + y * parts[0]
    return c * parts[0], c * parts[1]
