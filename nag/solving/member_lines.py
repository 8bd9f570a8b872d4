"""Homotopies to many members of a family at once, whose coefficients differ from path to path.

Rows of a family are sums of products ``g(p) h(x)`` of a polynomial in the parameters and one in the
unknowns. Each is a part of the homotopy's rows, the same for all members; its factor is the
member's own. Along the line ``p(t) = t first + (1 - t) second`` that is a polynomial in t,
``q0 + q1 t + q2 t^2 + ..``: the higher terms are further parts, with powers of a coordinate that
is t, as in `nag.solving.parameter_line`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from nag.algebra.family import Family
from nag.algebra.number import Number, rounded_fraction
from nag.algebra.polynomial import Exponents
from nag.numerics.double_sums import ComplexSums, RealSums
from nag.solving.parameter_line import ParameterLine
from nag.tracking.compiled import CompiledRows
from nag.tracking.homotopy import Homotopy, Members
from nag.tracking.kernel_arrays import split

# A polynomial by its terms.
Terms = Mapping[Exponents, Number]


@dataclass(frozen=True, eq=False)
class _Part:
    """A product in a row: a polynomial in the parameters and one in the unknowns."""

    row: int
    inner: Terms
    outer: Terms

    @cached_property
    def degree(self) -> int:
        """The degree in the parameters."""
        return max(map(sum, self.inner))


@dataclass(frozen=True, eq=False)
class MemberLines:
    """Lines from one system of a family to any others.

    Attributes:
        family: which one.
        first: the parameters at t = 1, shape ``(k,)``.
    """

    family: Family
    first: np.ndarray

    def __getstate__(self) -> dict[str, object]:
        """What it is made of; the rest is made again where it is wanted."""
        return {"family": self.family, "first": self.first}

    @cached_property
    def _parts(self) -> list[_Part]:
        n, parts = self.family.n, []
        for row, f in enumerate(self.family.polynomials):
            split_terms = [(e[n:], e[:n], c) for e, c in f.terms.items()]
            by_unknowns = _products((e, p, c) for p, e, c in split_terms)
            by_parameters = _products(split_terms)
            # Whichever has fewer factors of their own.
            if len(by_parameters) < len(by_unknowns):
                parts += [_Part(row, {p: Fraction(1)}, h) for p, h in by_parameters]
            else:
                parts += [_Part(row, g, {e: Fraction(1)}) for e, g in by_unknowns]
        return parts

    @cached_property
    def _rows(self) -> CompiledRows:
        """The rows: of each part as many as its degree in t asks for, one at least."""
        n = self.family.n
        extra = int(any(part.degree > 1 for part in self._parts))
        rows: list[list[tuple[int, Terms]]] = [[] for _ in range(n)]
        count = 0
        for part in self._parts:
            for power in range(max(part.degree, 1)):
                terms = {(*e, *[power] * extra): c for e, c in part.outer.items()}
                rows[part.row].append((count, terms))
                count += 1
        made, degrees = [], []
        for row in rows:
            degree = max((sum(e) for _, terms in row for e in terms), default=0)
            degrees.append([degree])
            made.append(
                tuple((p, {(degree - sum(e), *e): c for e, c in t.items()}) for p, t in row)
            )
        N = 1 + n + extra
        return CompiledRows(N, tuple(made), (tuple(range(N)),), (0,), np.array(degrees))

    @cached_property
    def _sizes(self) -> np.ndarray:
        """The largest coefficient of each part of the rows, as these are scaled."""
        rows = self._rows
        return np.array(
            [
                max(abs(c) for _, c in block) / scale
                for blocks, scale in zip(rows.in_doubles, rows.scales.tolist(), strict=True)
                for block in blocks
            ]
        )

    @cached_property
    def _row_of(self) -> np.ndarray:
        return np.repeat(np.arange(self.family.n), [len(row) for row in self._rows.parts])

    def to(self, values: np.ndarray) -> ParameterLine:
        """The homotopy to members with the given parameters, complex, shape ``(M, k)``."""
        rows = self._rows
        M, N = len(values), rows.N
        factors = np.zeros((M, rows.part_count, 2), dtype=np.complex128)
        rest = np.zeros((M, rows.part_count), dtype=np.complex128)
        sums, along = self._monomials(values)
        p = 0
        for part in self._parts:
            exact = _combine(part.inner, sums, M)
            line = np.zeros((part.degree + 1, M), dtype=np.complex128)
            for e, c in part.inner.items():
                line[: sum(e) + 1] += complex(c) * along[e]
            factors[:, p, 0], rest[:, p] = exact.high, exact.low
            for power in range(1, part.degree + 1):
                factors[:, p + power - 1, 1] = line[power]
            p += max(part.degree, 1)
        # Rows of comparable size, as if each member had been compiled by itself; exactly.
        scale = np.ones((M, rows.part_count))
        sizes = np.abs(factors).max(axis=2, initial=0.0) * self._sizes
        for row in range(self.family.n):
            own = self._row_of == row
            largest = sizes[:, own].max(axis=1, initial=0.0)
            exponents = np.where(largest > 0, np.frexp(largest)[1] - 1, 0)
            scale[:, own] = np.ldexp(1.0, -exponents)[:, None]
        members = Members(np.ascontiguousarray(factors * scale[:, :, None]), rest * scale)
        extra = N - 1 - self.family.n
        A0, A1 = np.zeros((extra, N)), np.zeros((extra, N))
        A0[:, N - 1 :], A1[:, 0] = 1.0, -1.0
        return ParameterLine(Homotopy(rows, A0, A1, members=members), self.family.n)

    def _monomials(
        self, values: np.ndarray
    ) -> tuple[dict[Exponents, ComplexSums], dict[Exponents, np.ndarray]]:
        """Monomials in the parameters: values at t = 0, and coefficients in t, ``(d + 1, M)``."""
        M, k = values.shape
        step = self.first - values
        powers = [ComplexSums.of(values[:, i]) for i in range(k)]
        one = (0,) * k
        sums, along = {one: ComplexSums.of(np.ones(M))}, {one: np.ones((1, M), np.complex128)}
        for e in sorted({e for part in self._parts for e in part.inner}):
            known = one
            for i, exponent in enumerate(e):
                for power in range(1, exponent + 1):
                    key = (*e[:i], power, *one[i + 1 :])
                    if key not in sums:
                        sums[key] = sums[known] * powers[i]
                        before = along[known]
                        longer = np.zeros((len(before) + 1, M), dtype=np.complex128)
                        longer[:-1] = before * values[:, i]
                        longer[1:] += before * step[:, i]
                        along[key] = longer
                    known = key
        return sums, along


def _products(
    terms: Iterable[tuple[Exponents, Exponents, Number]],
) -> list[tuple[Exponents, dict[Exponents, Number]]]:
    """Terms collected by their first exponents."""
    collected: defaultdict[Exponents, dict[Exponents, Number]] = defaultdict(dict)
    for first, second, c in terms:
        collected[first][second] = c
    return sorted(collected.items(), reverse=True)


def _combine(terms: Terms, sums: Mapping[Exponents, ComplexSums], M: int) -> ComplexSums:
    """A polynomial's values from those of its monomials."""
    total = ComplexSums.of(np.zeros(M))
    zero = RealSums(np.zeros(1), np.zeros(1))
    for e, c in terms.items():
        p, q = rounded_fraction(c, 40).as_integer_ratio()
        high, low = split(p, q, 2)
        number = ComplexSums(RealSums(np.array([high]), np.array([low])), zero)
        total = total + number * sums[e]
    return total
