"""Truncated power series in several variables, over numbers of many digits or modulo a prime.

A series is a map from exponents to coefficients. The exponents are packed into one integer, the
total degree on top, so that products of monomials are sums and truncation is a comparison.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from math import comb, prod
from operator import le, sub
from typing import Any

import flint

from nag.algebra.polynomial import sum_terms
from nag.errors import NagError

# Bits of one exponent.
BITS = 10
MASK = (1 << BITS) - 1
# Sums of up to so many terms are not worth a matrix.
SMALL = 400
# Terms from which on series in one variable are multiplied in compiled code.
LONG = 12

Series = dict[int, Any]
Terms = Sequence[tuple[tuple[int, ...], Any]]


@dataclass(frozen=True)
class SeriesRing:
    """Power series in ``m`` variables modulo degree ``order + 1``, and modulo a prime if not 0."""

    m: int
    order: int
    modulus: int = 0

    def __post_init__(self) -> None:
        if self.order > MASK:
            raise NagError(f"series of order {self.order} are too long")

    def unit(self, i: int) -> int:
        """The key of variable ``i``."""
        return (1 << BITS * self.m) + (1 << BITS * i)

    def degree(self, key: int) -> int:
        return key >> BITS * self.m

    def key(self, exponents: Sequence[int]) -> int:
        return sum(k << BITS * i for i, k in enumerate((*exponents, sum(exponents))))

    def exponents(self, key: int) -> tuple[int, ...]:
        return tuple(key >> BITS * i & MASK for i in range(self.m))

    def multiply(self, a: Series, b: Series) -> Series:
        if self.m == 1 and min(len(a), len(b)) >= LONG:
            return self._multiply_long(a, b)
        limit = (self.order + 1) << BITS * self.m
        second = sorted(b.items())
        result: Series = {}
        for i, x in a.items():
            for j, y in second:
                key = i + j
                if key >= limit:
                    break
                result[key] = result[key] + x * y if key in result else x * y
        return {k: c % self.modulus for k, c in result.items()} if self.modulus else result

    def _multiply_long(self, a: Series, b: Series) -> Series:
        """The product in one variable, in compiled code."""
        unit = self.unit(0)
        dense = [[x.get(k * unit, 0) for k in range(max(x) // unit + 1)] for x in (a, b)]
        if self.modulus:
            first, second = (flint.nmod_poly(x, self.modulus) for x in dense)
            found = [int(c) for c in first.mul_low(second, self.order + 1).coeffs()]
        else:
            first, second = (flint.acb_poly(x) for x in dense)
            found = [c.mid() for c in (first * second).coeffs()[: self.order + 1]]
        return {k * unit: c for k, c in enumerate(found) if c}

    def add(self, total: Series, a: Series, factor: Any) -> None:
        """Add ``factor * a`` to ``total``."""
        for k, c in a.items():
            total[k] = total[k] + c * factor if k in total else c * factor
            if self.modulus:
                total[k] %= self.modulus


def compose_series(
    rows: Sequence[Terms], images: Sequence[Series], ring: SeriesRing
) -> list[Series]:
    """Polynomials with a series put in for each variable."""
    limit = (ring.order + 1) << BITS * ring.m
    images = [{k: c for k, c in image.items() if k < limit} for image in images]
    powers: dict[tuple[int, int], Series] = {}
    monomials: dict[tuple[int, ...], Series] = {}

    def power(i: int, k: int) -> Series:
        if k == 1:
            return images[i]
        if (i, k) not in powers:
            powers[i, k] = ring.multiply(power(i, k // 2), power(i, k - k // 2))
        return powers[i, k]

    def monomial(e: tuple[int, ...]) -> Series:
        if e not in monomials:
            last = max((i for i, k in enumerate(e) if k), default=-1)
            if last < 0:
                return {0: 1}
            rest = (*e[:last], *(0,) * (len(e) - last))
            factor = power(last, e[last])
            monomials[e] = ring.multiply(monomial(rest), factor) if any(rest) else factor
        return monomials[e]

    exponents = list({e: None for row in rows for e, _ in row})
    values = [monomial(e) for e in exponents]
    if sum(len(row) for row in rows) * max(map(len, values), default=0) > SMALL:
        place = {e: i for i, e in enumerate(exponents)}
        matrix: list[list[Any]] = [[0] * len(exponents) for _ in rows]
        for coefficients, row in zip(matrix, rows, strict=True):
            for e, c in row:
                coefficients[place[e]] = coefficients[place[e]] + c
        return product_of(matrix, values, ring.modulus)
    result = []
    for row in rows:
        total: Series = {}
        for e, c in row:
            ring.add(total, monomial(e), c)
        result.append(total)
    return result


def shift_polynomials(
    rows: Sequence[Terms], centre: Sequence[Any], ring: SeriesRing
) -> list[Series]:
    """Polynomials about another point, one variable after the other."""
    result = []
    for row in rows:
        terms: dict[tuple[int, ...], Any] = {}
        for e, c in row:
            terms[e] = terms[e] + c if e in terms else c
        for i, x in enumerate(centre):
            if not x:
                continue
            moved: dict[tuple[int, ...], Any] = {}
            powers: list[Any] = [1]
            binomials: dict[int, list[Any]] = {}
            for e, c in terms.items():
                top = e[i]
                if top not in binomials:
                    while len(powers) <= top:
                        more = powers[-1] * x
                        powers.append(more % ring.modulus if ring.modulus else more)
                    binomials[top] = [comb(top, k) * powers[top - k] for k in range(top + 1)]
                before, after = e[:i], e[i + 1 :]
                for k, factor in enumerate(binomials[top]):
                    to = (*before, k, *after)
                    moved[to] = moved[to] + c * factor if to in moved else c * factor
            terms = {e: c % ring.modulus for e, c in moved.items()} if ring.modulus else moved
        kept = {ring.key(e): c for e, c in terms.items() if sum(e) <= ring.order}
        result.append(kept if ring.modulus else {k: flint.acb(c).mid() for k, c in kept.items()})
    return result


def product_of(matrix: list[list[Any]], column: Sequence[Series], modulus: int) -> list[Series]:
    """A matrix times a column of series, in compiled code."""
    keys = sorted({k for value in column for k in value})
    if not keys or not matrix:
        return [{} for _ in matrix]
    table = [[value.get(k, 0) for k in keys] for value in column]
    if modulus:
        left = flint.nmod_mat(len(matrix), len(column), list(chain(*matrix)), modulus)
        found = left * flint.nmod_mat(len(column), len(keys), list(chain(*table)), modulus)
        rows = [[int(c) for c in row] for row in found.tolist()]
    else:
        rows = (flint.acb_mat(matrix) * flint.acb_mat(table)).mid().tolist()
    return [{k: c for k, c in zip(keys, row, strict=True) if c} for row in rows]


def evaluate(series: Mapping[int, Any], ring: SeriesRing, v: Sequence[Any]) -> Any:
    """The value of a truncated series at ``v``."""
    return sum_terms(((ring.exponents(key), c) for key, c in series.items()), v)


def exponents_of_degree(m: int, degree: int) -> list[tuple[int, ...]]:
    """All exponents of that degree in ``m`` variables, in lexicographic order."""
    if m < 2:
        return [(degree,)] if m else [()] * (degree == 0)
    return [
        (k, *others) for k in range(degree + 1) for others in exponents_of_degree(m - 1, degree - k)
    ]


def derivatives(rows: Sequence[Series], ring: SeriesRing, order: int) -> list[list[Any]]:
    """All partial derivatives of that order, over factorials, as terms, also those that vanish.

    They stand row by row, the directions of each as in `exponents_of_degree`.
    """
    place = {alpha: i for i, alpha in enumerate(exponents_of_degree(ring.m, order))}
    lowered = [exponents_of_degree(ring.m, k) for k in range(order)]
    result = []
    for row in rows:
        derived: list[list[Any]] = [[] for _ in place]
        for key, c in row.items():
            e, left = ring.exponents(key), ring.degree(key) - order
            if left < 0:
                continue
            for part in lowered[left] if left < order else place:
                if all(map(le, part, e)):
                    to, alpha = part, tuple(map(sub, e, part))
                    if left >= order:
                        to, alpha = alpha, part
                    derived[place[alpha]].append((to, c * prod(map(comb, e, alpha))))
        result.extend(derived)
    return result
