"""Polynomials compiled to flat arrays: products, and rows over them.

A monomial is a product of two earlier ones, so powers are shared between the values and the
Jacobian. Value slot ``j < N`` is coordinate ``j``, slot ``N`` is the constant 1, slot ``N + 1 + k``
is product ``k``. A row is a sum of parts, each a sparse polynomial ``S_p`` with coefficients
that do not depend on t; a homotopy multiplies part ``p`` by ``alpha_p + t beta_p``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from fractions import Fraction
from functools import cached_property
from itertools import accumulate
from math import frexp
from typing import NamedTuple

import numpy as np

from nag.algebra.number import Number, decimal_digits
from nag.algebra.polynomial import Exponents, Polynomial
from nag.errors import NagError

Terms = Mapping[Exponents, Number | complex]


class Tape(NamedTuple):
    """The arrays that the kernels read; see `compile_rows`.

    ``first, second``: slots of the factors of each product; the first ``value_products`` products
    suffice for the values, all are needed for the Jacobian. Only the first ``inner_products`` of
    them are factors of others that the values need.
    ``value_*`` and ``jacobian_*``: blocks of terms; block ``b`` adds
    ``sum(coefficient[q] * slot[q] for q in range(start[b], start[b + 1]))`` times its part's factor
    to row ``place[b]`` of the values, or to entry ``place[b] = row * N + column`` of the Jacobian.
    """

    first: np.ndarray
    second: np.ndarray
    value_products: int
    inner_products: int
    value_place: np.ndarray
    value_part: np.ndarray
    value_start: np.ndarray
    value_slot: np.ndarray
    value_coefficient: np.ndarray
    jacobian_place: np.ndarray
    jacobian_part: np.ndarray
    jacobian_start: np.ndarray
    jacobian_slot: np.ndarray
    jacobian_coefficient: np.ndarray


class SentByContent:
    """A dataclass with a ``_cache``, which other processes get, and ledgers know, by its fields."""

    def __getstate__(self) -> dict[str, object]:
        """The fields alone: what is kept besides holds addresses of this process."""
        state = {each.name: getattr(self, each.name) for each in fields(self)}
        return {**state, "_cache": {}}

    @cached_property
    def content_digest(self) -> bytes:
        """The digest of all that results depend on."""
        from nag.tracking.ledger import digest_of_fields

        return digest_of_fields(self)


@dataclass(frozen=True, eq=False)
class CompiledRows(SentByContent):
    """Homogeneous polynomial rows in ``N`` projective coordinates.

    Attributes:
        N: number of coordinates, homogenising ones included.
        parts: for each row a tuple of ``(part, terms)``; ``terms`` maps exponents of all ``N``
            coordinates to exact numbers (or complex ones).
        groups: the partition of the coordinates into groups, each with its homogenising coordinate.
        infinity: the homogenising coordinates.
        degrees: degree of each row in each group, shape ``(rows, groups)``.
    """

    N: int
    parts: tuple[tuple[tuple[int, Terms], ...], ...]
    groups: tuple[tuple[int, ...], ...]
    infinity: tuple[int, ...]
    degrees: np.ndarray
    _cache: dict[str, object] = field(default_factory=dict, repr=False, compare=False)

    def __len__(self) -> int:
        return len(self.parts)

    @cached_property
    def part_count(self) -> int:
        """Number of parts that the rows refer to."""
        return 1 + max((p for row in self.parts for p, _ in row), default=0)

    @cached_property
    def digits(self) -> int:
        """The most decimal digits of a coefficient."""
        every = (c for row in self.parts for _, terms in row for c in terms.values())
        return max(map(decimal_digits, every), default=0)

    @cached_property
    def in_doubles(self) -> list[list[list[tuple[Exponents, complex]]]]:
        """For each part of each row its terms in the tape's order, coefficients rounded."""
        return [
            [
                [(e, _round_number(terms[e])) for e in sorted(terms, reverse=True)]
                for _, terms in row
            ]
            for row in self.parts
        ]

    @cached_property
    def scales(self) -> np.ndarray:
        """Powers of two by which the compiled rows are divided, for rows of comparable size."""
        sizes = [
            max((abs(c) for block in row for _, c in block), default=1.0) for row in self.in_doubles
        ]
        return np.array([2.0 ** (frexp(size)[1] - 1) for size in sizes], dtype=float)

    @cached_property
    def tape(self) -> Tape:
        """The arrays for the kernels."""
        return _tape(self)


def compile_rows(
    polynomials: Sequence[Polynomial],
    *,
    homogenize: bool = True,
    groups: Sequence[Sequence[int]] = (),
    n: int | None = None,
) -> CompiledRows:
    """Compile polynomials, homogenised exactly.

    Args:
        polynomials: polynomials in the same ``n`` affine variables (or ``N`` projective
            coordinates if ``homogenize`` is False).
        homogenize: put one new coordinate a group in front of the variables: x0 for one group,
            ``x0 .. x(G-1)`` for ``G`` groups, so that variable ``i`` becomes coordinate ``G + i``.
        groups: partition of the indices of the polynomials' own variables; default: one group.
        n: number of variables, needed only if there is no polynomial.

    Raises:
        ValueError: if variables do not match, the groups are no partition, or, with
            ``homogenize=False``, a polynomial is not homogeneous in a group.
    """
    n = polynomials[0].n if n is None else n
    if any(f.n != n for f in polynomials):
        raise NagError("the polynomials have different numbers of variables")
    partition = tuple(tuple(g) for g in groups) or (tuple(range(n)),)
    if sorted(i for g in partition for i in g) != list(range(n)):
        raise NagError("the groups are not a partition of the variables")
    degrees = np.array(
        [[max(f.degree_in(g), 0) for g in partition] for f in polynomials], dtype=np.int64
    ).reshape(len(polynomials), len(partition))
    rows = []
    for f, row_degrees in zip(polynomials, degrees, strict=True):
        if homogenize and len(partition) == 1:
            degree = int(row_degrees[0])
            rows.append(((0, {(degree - sum(e), *e): c for e, c in f.terms.items()}),))
            continue
        terms = {}
        for e, c in f.terms.items():
            missing = tuple(
                int(d) - sum(e[i] for i in g) for g, d in zip(partition, row_degrees, strict=True)
            )
            if not homogenize and any(missing):
                raise NagError(f"{f} is not homogeneous in its groups of variables")
            terms[missing + e if homogenize else e] = c
        rows.append(((0, terms),))
    if not homogenize:
        return CompiledRows(n, tuple(rows), partition, (0,), degrees)
    shift = len(partition)
    homogenized = tuple((k, *(i + shift for i in g)) for k, g in enumerate(partition))
    return CompiledRows(n + shift, tuple(rows), homogenized, tuple(range(shift)), degrees)


def blend(first: CompiledRows, second: CompiledRows) -> CompiledRows:
    """Rows ``S_0 + S_1`` with the parts of ``first`` before those of ``second``.

    Raises:
        ValueError: if numbers of rows, coordinates or degrees differ.
    """
    if (first.N, first.groups, len(first)) != (second.N, second.groups, len(second)):
        raise NagError("the two systems differ in coordinates, groups or number of rows")
    if not np.array_equal(first.degrees, second.degrees):
        raise NagError("the two systems differ in the degrees of their rows")
    shift = first.part_count
    rows = tuple(
        row + tuple((p + shift, terms) for p, terms in other)
        for row, other in zip(first.parts, second.parts, strict=True)
    )
    return CompiledRows(first.N, rows, first.groups, first.infinity, first.degrees)


def _round_number(c: Number | complex) -> complex:
    # Twice as fast as a fraction's own way to a complex number.
    return complex(c.numerator / c.denominator) if type(c) is Fraction else complex(c)


class _Products:
    """Slots of monomials, each the product of an earlier one and a coordinate."""

    def __init__(self, N: int) -> None:
        self.N = N
        self.slots: dict[Exponents, int] = {(0,) * N: N}
        for j in range(N):
            self.slots[(0,) * j + (1,) + (0,) * (N - 1 - j)] = j
        self.factors: list[tuple[int, int]] = []

    def add(self, monomials: Iterable[Exponents]) -> int:
        """Give slots to monomials and, besides, to as few parents of theirs as possible.

        Returns how many of the new products are parents of others; they are the first ones.
        """
        slots = self.slots
        levels: dict[int, dict[Exponents, tuple[Exponents, int]]] = {}
        for e in monomials:
            if e not in slots:
                levels.setdefault(sum(e), {})[e] = (e, 0)
        for degree in range(max(levels, default=0), 2, -1):
            level = levels.setdefault(degree, {})
            below = levels.setdefault(degree - 1, {})
            choices = [(e, _parents(e)) for e in level]
            uses = Counter(parent for _, parents in choices for parent, _ in parents)
            for e, parents in choices:
                parent, last = max(
                    parents, key=lambda p: (p[0] in slots or p[0] in below, uses[p[0]], p[1])
                )
                level[e] = (parent, last)
                if parent not in slots:
                    below.setdefault(parent, (parent, 0))
        for e in levels.get(2, ()):
            levels[2][e] = _parents(e)[-1]
        new = [item for degree in sorted(levels) for item in levels[degree].items()]
        parents = {parent for _, (parent, _) in new}
        inner = [item for item in new if item[0] in parents]
        for e, (parent, last) in (*inner, *(item for item in new if item[0] not in parents)):
            self.factors.append((slots[parent], last))
            slots[e] = self.N + len(self.factors)
        return len(inner)


def _parents(exponents: Exponents) -> list[tuple[Exponents, int]]:
    return [((*exponents[:j], k - 1, *exponents[j + 1 :]), j) for j, k in enumerate(exponents) if k]


_Block = list[tuple[Exponents, complex]]


def _tape(rows: CompiledRows) -> Tape:
    N = rows.N
    products = _Products(N)
    inner = products.add(e for row in rows.in_doubles for block in row for e, _ in block)
    value_products = len(products.factors)
    values: list[tuple[int, int, _Block]] = []
    jacobian: list[tuple[int, int, _Block]] = []
    terms_of = zip(rows.parts, rows.in_doubles, rows.scales.tolist(), strict=True)
    for r, (row, blocks, scale) in enumerate(terms_of):
        for (part, _), terms in zip(row, blocks, strict=True):
            block = [(e, c / scale) for e, c in terms]
            derivatives: dict[int, _Block] = {}
            for e, c in block:
                for j, k in enumerate(e):
                    if k:
                        lowered = (*e[:j], k - 1, *e[j + 1 :])
                        derivatives.setdefault(j, []).append((lowered, c * k))
            values.append((r, part, block))
            jacobian += [(r * N + j, part, derivatives[j]) for j in sorted(derivatives)]
    jacobian.sort(key=lambda entry: (entry[0], entry[1]))
    products.add(e for _, _, block in jacobian for e, _ in block)
    factors = np.array(products.factors, dtype=np.int64).reshape(-1, 2)
    return Tape(
        np.ascontiguousarray(factors[:, 0]),
        np.ascontiguousarray(factors[:, 1]),
        value_products,
        inner,
        *_blocks(values, products.slots),
        *_blocks(jacobian, products.slots),
    )


def _blocks(
    blocks: list[tuple[int, int, _Block]], slots: Mapping[Exponents, int]
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    terms = [term for _, _, block in blocks for term in block]
    return (
        np.array([place for place, _, _ in blocks], dtype=np.int64),
        np.array([part for _, part, _ in blocks], dtype=np.int64),
        np.array([0, *accumulate(len(block) for _, _, block in blocks)], dtype=np.int64),
        np.array([slots[e] for e, _ in terms], dtype=np.int64),
        np.array([c for _, c in terms], dtype=np.complex128),
    )
