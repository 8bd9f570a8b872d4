"""Combinations of equations, by numbers, that have the fewest terms.

A multiple of one equation, added to another, hides what this one says: that a product of variables
is constant, for example. The mixed volume, and so the number of paths of a polyhedral start system,
grows with its terms.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction

from nag.algebra.polynomial import Polynomial


def of_fewest_terms(polynomials: Sequence[Polynomial]) -> tuple[Polynomial, ...]:
    """As many polynomials of the same ideal, without multiples of each other that lengthen them.

    From each, multiples of others of at most its degree are taken as long as that leaves it fewer
    terms. Polynomials that are not rational are left as they are.
    """
    given = list(polynomials)
    rational = [i for i, f in enumerate(given) if f.terms and f.exact]
    found = {i: _Rational(given[i]) for i in rational}
    pairs = [(i, j) for i in rational for j in rational if i != j]
    compared: dict[tuple[int, int], tuple[_Rational, _Rational]] = {}
    while pairs:
        for i, j in pairs:
            compared[i, j] = found[i], found[j]
            factor = _factor(found[i], found[j])
            if factor is not None:
                given[i] = _without(given[i], factor, found[j])
                found[i] = _Rational(given[i])
        pairs = [
            (i, j) for (i, j), (f, g) in compared.items() if f is not found[i] or g is not found[j]
        ]
    return tuple(given)


class _Rational:
    """A polynomial with rational coefficients, as pairs of whole numbers."""

    def __init__(self, f: Polynomial) -> None:
        self.terms = {e: c.as_integer_ratio() for e, c in f.terms.items()}
        self.degree = f.degree


def _without(f: Polynomial, factor: Fraction, g: _Rational) -> Polynomial:
    """``f - factor * g``, each coefficient brought to lowest terms once."""
    terms, (p, q) = dict(f.terms), factor.as_integer_ratio()
    for e, (c, d) in g.terms.items():
        a, b = terms[e].as_integer_ratio() if e in terms else (0, 1)
        terms[e] = Fraction(a * q * d - p * c * b, b * q * d)
    return Polynomial(f.n, terms)


def _factor(f: _Rational, g: _Rational) -> Fraction | None:
    """What ``g`` is to be multiplied by for ``f`` to lose more terms than it gains."""
    if not g.terms or g.degree > f.degree:
        return None
    common = f.terms.keys() & g.terms.keys()
    if 2 * len(common) <= len(g.terms):
        return None
    pairs = [(*f.terms[e], *g.terms[e]) for e in common]
    needed = len(g.terms) - len(common)
    try:
        # The quotient of whole numbers is rounded correctly: equal ones are equal as doubles.
        rounded = Counter([(a * d) / (b * c) for a, b, c, d in pairs])
        if max(rounded.values()) <= needed:
            return None
    except OverflowError:
        pass
    quotients = Counter([Fraction(a * d, b * c) for a, b, c, d in pairs])
    factor, lost = max(quotients.items(), key=lambda each: (each[1], each[0]))
    return factor if lost > needed else None
