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

from nag.numerics.power_series import Compiled, Series, SeriesRing, Terms, compiled, product_of


@dataclass(frozen=True, eq=False)
class Composition:
    """Polynomials with a series put in for each variable.

    Attributes:
        ring: of the series.
        products: pairs of the factors' places: the series come first, then the products.
        matrix: coefficients of the polynomials, those of one first, then as above.
        parts: the terms of degree 0, 1, .. of the series and the products.
    """

    ring: SeriesRing
    products: tuple[tuple[int, int], ...]
    matrix: Compiled
    parts: list[list[Series]]

    @classmethod
    def of(cls, rows: Sequence[Terms], n: int, ring: SeriesRing) -> Composition:
        """Polynomials in ``n`` variables, for series of which nothing is known yet."""
        made = _Products(n, {}, [])
        exponents = list({e: None for row in rows for e, _ in row if any(e)})
        places = {e: 1 + made.place(e) for e in exponents}
        width = 1 + n + len(made.products)
        matrix: list[list[Any]] = []
        for row in rows:
            line: list[Any] = [0] * width
            for e, c in row:
                k = places.get(e, 0)
                line[k] = line[k] + c
            matrix.append(line)
        return cls(
            ring,
            tuple(made.products),
            compiled(matrix, ring.modulus),
            [[] for _ in range(width - 1)],
        )

    def extended(self, series: Sequence[Series]) -> list[Series]:
        """The polynomials' terms of the next degree, when the series have these terms of it."""
        n, degree = len(series), len(self.parts[0]) if self.parts else 0
        for part, terms in zip(self.parts, series, strict=False):
            part.append(terms)
        for part, (i, j) in zip(self.parts[n:], self.products, strict=True):
            part.append(self._product(self.parts[i], self.parts[j], degree))
        one: Series = {} if degree else {0: 1}
        terms = [one, *(part[degree] for part in self.parts)]
        return product_of(self.matrix, terms, self.ring.modulus)

    def lower(self, steps: Mapping[int, Series]) -> None:
        """Subtract terms of the last degree, which is not 0, from those of some series."""
        found = [steps.get(i, {}) for i in range(len(self.parts) - len(self.products))]
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
        result: Series = {}
        for k in range(degree + 1):
            first, second = a[k], list(b[degree - k].items())
            for i, x in first.items():
                for j, y in second:
                    key = i + j
                    result[key] = result[key] + x * y if key in result else x * y
        modulus = self.ring.modulus
        return {k: c % modulus for k, c in result.items()} if modulus else result


@dataclass(frozen=True, eq=False)
class _Products:
    """Monomials as products of variables and earlier ones."""

    n: int
    known: dict[tuple[int, ...], int]
    products: list[tuple[int, int]]

    def place(self, e: tuple[int, ...]) -> int:
        if e not in self.known:
            self.known[e] = self._made(e)
        return self.known[e]

    def _made(self, e: tuple[int, ...]) -> int:
        last = max(i for i, k in enumerate(e) if k)
        if sum(e) == 1:
            return last
        first, rest = e[:last], (0,) * (len(e) - last)
        half = 0 if any(first) else e[last] // 2
        parts = (*first, half, *rest[1:]), (*(0,) * last, e[last] - half, *rest[1:])
        self.products.append((self.place(parts[0]), self.place(parts[1])))
        return self.n + len(self.products) - 1
