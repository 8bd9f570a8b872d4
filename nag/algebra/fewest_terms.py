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
    found = list(polynomials)
    pairs = [(i, j) for i in range(len(found)) for j in range(len(found)) if i != j]
    compared: dict[tuple[int, int], tuple[Polynomial, Polynomial]] = {}
    while pairs:
        for i, j in pairs:
            compared[i, j] = found[i], found[j]
            factor = _factor(found[i], found[j])
            if factor is not None:
                found[i] = found[i] - factor * found[j]
        pairs = [
            (i, j) for (i, j), (f, g) in compared.items() if f is not found[i] or g is not found[j]
        ]
    return tuple(found)


def _factor(f: Polynomial, g: Polynomial) -> Fraction | None:
    """What ``g`` is to be multiplied by for ``f`` to lose more terms than it gains."""
    if not (f.exact and g.exact) or not g.terms or g.degree > f.degree:
        return None
    common = f.terms.keys() & g.terms.keys()
    if 2 * len(common) <= len(g.terms):
        return None
    quotients = Counter(Fraction(f.terms[e]) / Fraction(g.terms[e]) for e in common)
    factor, lost = max(quotients.items(), key=lambda each: (each[1], each[0]))
    return factor if lost > len(g.terms) - len(common) else None
