"""Combinations of equations, by numbers, of the lowest degrees, of fewest terms or variables.

Where the terms of highest degree of several equations depend on each other, a combination has a
lower degree: as many paths as the product of the degrees then need not be tracked to infinity. As
two circles and two spheres do, equations of mechanisms often share what is highest in them.

A multiple of one equation, added to another, hides what this one says: that a product of variables
is constant, for example. The mixed volume, and so the number of paths of a polyhedral start system,
grows with its terms.

More equations than a set needs often say together what one of few variables says alone: the closure
of a Bennett linkage, four equations in three half-angles, what each two of them have in common.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from math import lcm, prod
from typing import Any

import flint

from nag.algebra.exact_ranks import coefficient_rows, field_of, reduce_matrix, residues
from nag.algebra.flint_numbers import to_fraction, to_rational
from nag.algebra.polynomial import Exponents, Polynomial, occurring_variables

# Coefficients beyond which no combination of lower degree is looked for.
MOST_COEFFICIENTS = 100_000
# Variables beyond which no combination of fewer is looked for: each set of them is.
MOST_VARIABLES = 7
# Terms with FLINT's rational coefficients.
Row = Mapping[Exponents, Any]


def of_lowest_degrees(polynomials: Sequence[Polynomial]) -> tuple[Polynomial, ...]:
    """As many polynomials with the same combinations, of the lowest degrees.

    The given ones, as far as they can stay; all of them if they depend on each other or are not
    rational, if the degrees cannot be lowered, or if that makes more terms.
    """
    given = tuple(polynomials)
    if len(given) < 2 or not all(f.exact and f.terms for f in given):
        return given
    monomials = _descending([f.terms for f in given])
    if len(given) * len(monomials) > MOST_COEFFICIENTS or _surely_lowest(given, monomials):
        return given
    rows = list(map(_row, given))
    table, _ = reduce_matrix(flint.fmpq_mat(coefficient_rows(rows, monomials)))
    reduced = [{e: c for e, c in zip(monomials, row, strict=True) if c} for row in table]
    degrees = [sum(next(iter(row))) for row in reduced]
    if len(reduced) < len(given) or prod(degrees) == prod(f.degree for f in given):
        return given
    chosen: list[Polynomial] = []
    for degree in sorted(set(degrees)):
        # The given ones come first, so that they stay.
        of_degree = [(f, row) for f, row in zip(given, rows, strict=True) if f.degree == degree]
        of_degree += [(None, row) for d, row in zip(degrees, reduced, strict=True) if d == degree]
        tops = [{e: c for e, c in row.items() if sum(e) == degree} for _, row in of_degree]
        for k in _first_independent(tops):
            f, row = of_degree[k]
            chosen.append(_clear_denominators(given[0].n, row) if f is None else f)
    shorter = sum(len(f.terms) for f in chosen) <= sum(len(f.terms) for f in given)
    return tuple(chosen) if shorter else given


def of_fewest_terms(polynomials: Sequence[Polynomial]) -> tuple[Polynomial, ...]:
    """As many polynomials of the same ideal, without multiples of each other that lengthen them.

    From each, multiples of others of at most its degree are taken as long as that leaves it fewer
    terms. Polynomials that are not rational are left as they are.
    """
    places = [i for i, f in enumerate(polynomials) if f.exact and f.terms]
    found = [_row(polynomials[i]) for i in places]
    degrees = [polynomials[i].degree for i in places]
    changed: set[int] = set()
    pairs = [(i, j) for i in range(len(found)) for j in range(len(found)) if i != j]
    compared: dict[tuple[int, int], tuple[Row, Row]] = {}
    while pairs:
        for i, j in pairs:
            compared[i, j] = found[i], found[j]
            if degrees[j] > degrees[i]:
                continue
            factor = _factor(found[i], found[j])
            if factor is not None:
                found[i] = _less(found[i], factor, found[j])
                degrees[i] = max(map(sum, found[i]), default=-1)
                changed.add(i)
        pairs = [
            (i, j) for (i, j), (f, g) in compared.items() if f is not found[i] or g is not found[j]
        ]
    result = list(polynomials)
    for i in changed:
        terms = {e: to_fraction(c) for e, c in found[i].items()}
        result[places[i]] = Polynomial(result[places[i]].n, terms)
    return tuple(result)


def of_fewest_variables(polynomials: Sequence[Polynomial]) -> tuple[Polynomial, ...]:
    """A basis of the combinations of polynomials, of as few variables each as there can be.

    Of many variables, or with coefficients that are not rational, they stay; zeros are left out.
    """
    given = tuple(f for f in polynomials if f.terms)
    variables = sorted(frozenset[int]().union(*(f.support for f in given)))
    if not all(f.exact for f in given) or len(variables) > MOST_VARIABLES:
        return given
    if not given:
        return ()
    rows = list(map(_row, given))
    monomials = _descending(rows)
    chosen: list[Row] = []
    for size in range(len(variables) + 1):
        for inside in combinations(variables, size):
            found = [*chosen, *_combinations_in(inside, rows, monomials)]
            chosen = [found[k] for k in _first_independent(found)]
    return tuple(_clear_denominators(given[0].n, row) for row in chosen)


def _combinations_in(
    variables: Sequence[int], rows: Sequence[Row], monomials: Sequence[Exponents]
) -> list[Row]:
    """A basis of the combinations of rows that have no other variables than these."""
    within = {e for e in monomials if occurring_variables([e]) <= set(variables)}
    ordered = sorted(monomials, key=within.__contains__)
    table, pivots = reduce_matrix(flint.fmpq_mat(coefficient_rows(rows, ordered)))
    return [
        {e: c for e, c in zip(ordered, row, strict=True) if c}
        for row, pivot in zip(table, pivots, strict=True)
        if ordered[pivot] in within
    ]


def _first_independent(rows: Sequence[Row]) -> list[int]:
    """Indices of the rows that are no combinations of those before them."""
    if not rows:
        return []
    return reduce_matrix(flint.fmpq_mat(coefficient_rows(rows)).transpose())[1]


def _surely_lowest(polynomials: Sequence[Polynomial], monomials: Sequence[Exponents]) -> bool:
    """Whether no combination has a lower degree: none has modulo a prime."""
    field = field_of(polynomials)
    if field is None:
        return False
    rows = coefficient_rows([residues(f, field) for f in polynomials], monomials)
    _, pivots = field.reduced(rows, len(monomials))
    degrees = [sum(monomials[k]) for k in pivots]
    return len(degrees) == len(rows) and prod(degrees) == prod(f.degree for f in polynomials)


def _row(f: Polynomial) -> Row:
    return {e: to_rational(c) for e, c in f.terms.items()}


def _clear_denominators(n: int, row: Row) -> Polynomial:
    """The multiple of a row whose leading coefficient of one becomes the common denominator."""
    common = lcm(*(int(c.q) for c in row.values()))
    return Polynomial(n, {e: Fraction(int(c.p) * (common // int(c.q))) for e, c in row.items()})


def _descending(rows: Sequence[Mapping[Exponents, Any]]) -> list[Exponents]:
    """All monomials, those of the highest degree first."""
    return sorted({e for row in rows for e in row}, key=lambda e: (-sum(e), e))


def _factor(f: Row, g: Row) -> Any:
    """What ``g`` is to be multiplied by for ``f`` to lose more terms than it gains, or None."""
    common = f.keys() & g.keys()
    gained = len(g) - len(common)
    if len(common) <= gained:
        return None
    # As pairs of integers: to hash FLINT's numbers takes ten times as long as to divide them.
    quotients = {e: f[e] / g[e] for e in common}
    pairs = {e: (int(q.p), int(q.q)) for e, q in quotients.items()}
    counts = Counter(pairs.values())
    lost = max(counts.values())
    if lost <= gained:
        return None
    return max(q for e, q in quotients.items() if counts[pairs[e]] == lost)


def _less(f: Row, factor: Any, g: Row) -> Row:
    """The terms of ``f - factor g``."""
    terms = dict(f)
    for e, c in g.items():
        value = terms[e] - factor * c if e in terms else -factor * c
        if value:
            terms[e] = value
        else:
            del terms[e]
    return terms
