"""Polynomials that carry another one into an ideal, by linear algebra on normal forms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

import flint

from nag.algebra.groebner import Ideal
from nag.algebra.polynomial import Exponents, Polynomial, divides

Terms = Mapping[Exponents, Fraction]


def multipliers(ideal: Ideal, f: Polynomial, degree: int, most: int) -> list[Polynomial] | None:
    """A basis of the polynomials s of at most some degree, modulo the ideal, with s f in the ideal.

    Args:
        ideal: by its basis in the graded reverse lexicographic order.
        f: in the ideal's variables.
        most: number of monomials of s beyond which nothing is worked out.

    Returns:
        None if there are more.
    """
    rules = _rules(ideal)
    one = (0,) * f.n
    forms = {one: _reduce_terms(dict(f.terms), rules)}
    level = [one]
    for _ in range(degree):
        following = []
        for e in level:
            for i in range(f.n):
                above = (*e[:i], e[i] + 1, *e[i + 1 :])
                if above in forms or any(divides(lead, above) for lead in rules):
                    continue
                if len(forms) == most:
                    return None
                raised = {(*g[:i], g[i] + 1, *g[i + 1 :]): c for g, c in forms[e].items()}
                forms[above] = _reduce_terms(raised, rules)
                following.append(above)
        level = following
    return _relations(forms, f.n)


def _relations(forms: Mapping[Exponents, Terms], n: int) -> list[Polynomial]:
    """Combinations of monomials whose forms cancel."""
    place: dict[Exponents, int] = {}
    for form in forms.values():
        for e in form:
            place.setdefault(e, len(place))
    if not place:
        return [Polynomial(n, {e: Fraction(1)}) for e in forms]
    entries = [flint.fmpq(0)] * (len(place) * len(forms))
    for column, form in enumerate(forms.values()):
        for e, c in form.items():
            entries[place[e] * len(forms) + column] = flint.fmpq(c.numerator, c.denominator)
    whole, _ = flint.fmpq_mat(len(place), len(forms), entries).numer_denom()
    kernel, nullity = whole.nullspace()
    monomials = list(forms)
    found = []
    for k in range(nullity):
        column = [int(kernel[i, k]) for i in range(len(monomials))]
        found.append(Polynomial(n, dict(zip(monomials, map(Fraction, column), strict=True))))
    return found


def _rules(ideal: Ideal) -> dict[Exponents, Terms]:
    """For each leading monomial the terms that may be put for it."""
    rules = {}
    for g in ideal.basis:
        terms = [(tuple(map(int, e)), Fraction(int(c))) for e, c in g.terms()]
        (lead, top), *rest = terms
        rules[lead] = {e: -c / top for e, c in rest}
    return rules


def _reduce_terms(terms: dict[Exponents, Fraction], rules: Mapping[Exponents, Terms]) -> Terms:
    """The normal form: no monomial of it is a multiple of a leading one."""
    rest: dict[Exponents, Fraction] = {}
    while terms:
        e = max(terms, key=order)
        c = terms.pop(e)
        lead = next((lead for lead in rules if divides(lead, e)), None)
        if lead is None:
            rest[e] = c
            continue
        quotient = tuple(a - b for a, b in zip(e, lead, strict=True))
        for g, d in rules[lead].items():
            key = tuple(a + b for a, b in zip(g, quotient, strict=True))
            value = terms.get(key, Fraction(0)) + c * d
            if value:
                terms[key] = value
            else:
                terms.pop(key, None)
    return rest


def order(e: Exponents) -> tuple[int, Sequence[int]]:
    """Key by which monomials ascend in the graded reverse lexicographic order."""
    return sum(e), tuple(-k for k in reversed(e))
