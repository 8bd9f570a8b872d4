"""Combinations of equations, by numbers, that have the lowest degrees.

Where the terms of highest degree of several equations depend on each other, a combination has a
lower degree: as many paths as the product of the degrees then need not be tracked to infinity. As
two circles and two spheres do, equations of mechanisms often share what is highest in them.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from math import lcm, prod

from nag.algebra.polynomial import Polynomial

# Coefficients beyond which no combination is looked for.
MOST_COEFFICIENTS = 100_000


def of_lowest_degrees(polynomials: Sequence[Polynomial]) -> tuple[Polynomial, ...]:
    """As many polynomials with the same combinations, of the lowest degrees.

    The given ones, as far as they can stay; all of them if they depend on each other or are not
    rational, if the degrees cannot be lowered, or if that makes more terms.
    """
    given = tuple(polynomials)
    if len(given) < 2 or not all(f.exact and f.terms for f in given) or _surely_lowest(given):
        return given
    rows = _echelon(given)
    if len(rows) < len(given) or prod(f.degree for f in rows) == prod(f.degree for f in given):
        return given
    chosen: list[Polynomial] = []
    for degree in sorted({f.degree for f in rows}):
        forms: list[Polynomial] = []
        for f in (*given, *rows):
            top = Polynomial(f.n, {e: c for e, c in f.terms.items() if sum(e) == degree})
            if f.degree == degree and len(_echelon((*forms, top))) > len(forms):
                forms.append(top)
                chosen.append(f)
    shorter = sum(len(f.terms) for f in chosen) <= sum(len(f.terms) for f in given)
    return tuple(chosen) if shorter else given


def _surely_lowest(polynomials: Sequence[Polynomial]) -> bool:
    """Whether, one after another, each has a term of its degree that none of those left has.

    No combination of these is then of a lower degree than the highest of theirs.
    """
    left = [{e for e in f.terms if sum(e) == f.degree} for f in polynomials]
    while left:
        counts = Counter(e for top in left for e in top)
        rest = [top for top in left if all(counts[e] > 1 for e in top)]
        if len(rest) == len(left):
            return False
        left = rest
    return True


def _echelon(polynomials: Sequence[Polynomial]) -> list[Polynomial]:
    """The rows of the reduced echelon form, monomials of the highest degree first."""
    import flint

    monomials = sorted({e for f in polynomials for e in f.terms}, key=lambda e: (-sum(e), e))
    if len(polynomials) * len(monomials) > MOST_COEFFICIENTS:
        return []
    zero = Fraction(0)
    entries = [
        flint.fmpq(c.numerator, c.denominator)
        for f in polynomials
        for c in (Fraction(f.terms.get(e, zero)) for e in monomials)
    ]
    reduced, rank = flint.fmpq_mat(len(polynomials), len(monomials), entries).rref()
    rows = []
    for k in range(rank):
        row = {e: c for j, e in enumerate(monomials) if (c := reduced[k, j]) != 0}
        common = lcm(*(int(c.q) for c in row.values()))
        terms = {e: Fraction(int(c.p) * (common // int(c.q))) for e, c in row.items()}
        rows.append(Polynomial(polynomials[0].n, terms))
    return rows
