"""Polynomials of power series that become known one degree after the other.

Of every product the terms of one degree are made when they are asked for, once; when the series'
terms of that degree are known, what changes is linear in them.

References:
    van der Hoeven, Relax, but don't be too lazy, 2002.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from nag.numerics.point_values import MonomialProducts
from nag.numerics.power_series import Series, SeriesRing, Terms, product_of


@dataclass(frozen=True, eq=False)
class Composition:
    """Polynomials with a series put in for each variable.

    Attributes:
        ring: of the series.
        products: pairs of the factors' places: first comes one, then the series, then the products.
        matrix: coefficients of the polynomials, in that order.
        parts: the terms of degree 0, 1, .. of each, in that order.
    """

    ring: SeriesRing
    products: tuple[tuple[int, int], ...]
    matrix: list[list[Any]]
    parts: list[list[Series]]

    @classmethod
    def of(cls, rows: Sequence[Terms], n: int, ring: SeriesRing) -> Composition:
        """Polynomials in ``n`` variables, for series of which nothing is known yet."""
        made = MonomialProducts(n)
        places = {e: made.place(e) for row in rows for e, _ in row}
        width = 1 + n + len(made.pairs)
        matrix: list[list[Any]] = []
        for row in rows:
            line: list[Any] = [0] * width
            for e, c in row:
                line[places[e]] = line[places[e]] + c
            matrix.append(line)
        return cls(ring, tuple(made.pairs), matrix, [[] for _ in range(width)])

    def extended(self, series: Sequence[Series]) -> list[Series]:
        """The polynomials' terms of the next degree, when the series have these terms of it."""
        degree = len(self.parts[0])
        one: Series = {} if degree else {0: 1}
        for part, terms in zip(self.parts, [one, *series], strict=False):
            part.append(terms)
        for part, (i, j) in zip(self.parts[1 + len(series) :], self.products, strict=True):
            part.append(self._product(self.parts[i], self.parts[j], degree))
        terms = [part[degree] for part in self.parts]
        kept = [k for k, series in enumerate(terms) if series]
        matrix = [[row[k] for k in kept] for row in self.matrix]
        return product_of(matrix, [terms[k] for k in kept], self.ring.modulus)

    def lower(self, steps: Mapping[int, Series]) -> None:
        """Subtract terms of the last degree, which is not 0, from those of some series."""
        series = len(self.parts) - len(self.products) - 1
        found = [{}, *(steps.get(i, {}) for i in range(series))]
        for i, j in self.products:
            total: Series = {}
            for step, other in ((found[i], j), (found[j], i)):
                constant = self.parts[other][0].get(0, 0)
                if step and constant:
                    self.ring.add(total, step, constant)
            found.append(total)
        for part, step in zip(self.parts, found, strict=True):
            self.ring.add(part[-1], step, -1)

    def _product(self, a: Sequence[Series], b: Sequence[Series], degree: int) -> Series:
        """The terms of one degree; of a square, those of two different degrees count twice."""
        if self.ring.m == 1:
            return self._product_in_one(a, b, degree)
        square, result, modulus = a is b, {}, self.ring.modulus
        for k in range(degree // 2 + 1 if square else degree + 1):
            first, second = a[k], b[degree - k]
            if not first or not second:
                continue
            twice = square and 2 * k < degree
            for i, x in first.items():
                if twice:
                    x = x + x
                for j, y in second.items():
                    key = i + j
                    if key in result:
                        result[key] += x * y
                    else:
                        result[key] = x * y
        return {k: c % modulus for k, c in result.items()} if modulus else result

    def _product_in_one(self, a: Sequence[Series], b: Sequence[Series], degree: int) -> Series:
        """The same in one variable, where each degree has one term."""
        total: Any = None
        for k in range(degree + 1):
            first, second = a[k], b[degree - k]
            if first and second:
                (x,), (y,) = first.values(), second.values()
                total = x * y if total is None else total + x * y
        if total is None:
            return {}
        modulus = self.ring.modulus
        return {degree * self.ring.unit(0): total % modulus if modulus else total}
