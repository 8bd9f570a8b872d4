"""Rational functions through exact values: how coefficients depend on a parameter.

Cauchy interpolation: the polynomial through all values is reduced by Euclid's algorithm against
the one that vanishes at all places; the first remainder of balanced degree is the numerator
(von zur Gathen & Gerhard, Modern Computer Algebra, section 5.8).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from flint import fmpq_poly

from nag.algebra.flint_numbers import to_fraction, to_rational
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.system import PolynomialSystem

# A function is taken for known when so many values more than it has coefficients lie on it.
SPARE = 3
NUMBERS_OF_VALUES = (8, 16, 32, 64)


def rational_function(places: Sequence[Fraction], values: Sequence[Fraction]) -> Any | None:
    """Numerator and denominator, as polynomials over the rationals, of a function of low degree.

    None if none goes through all values with `SPARE` of them to spare.
    """
    modulus, interpolated = fmpq_poly([1]), fmpq_poly([0])
    for x, y in zip(places, values, strict=True):
        # Newton's form: one more value, one degree more.
        at = to_rational(x)
        factor = (to_rational(y) - interpolated(at)) / modulus(at)
        interpolated += modulus * factor
        modulus *= fmpq_poly([-at, 1])
    before, now = modulus, interpolated
    weight_before, weight = fmpq_poly([0]), fmpq_poly([1])
    while now.degree() + weight.degree() + 2 + SPARE > len(places):
        if now.degree() <= 0 or weight.degree() + SPARE > len(places):
            return None
        quotient, rest = divmod(before, now)
        before, now = now, rest
        weight_before, weight = weight, weight_before - quotient * weight
    if any(weight(to_rational(x)) == 0 for x in places):
        return None
    return now, weight


def family_of(
    system_at: Callable[[Fraction], PolynomialSystem], places: Callable[[int], Sequence[Fraction]]
) -> tuple[Polynomial, ...] | None:
    """The equations as polynomials in the variables and one parameter after them.

    Args:
        system_at: the system at a value of the parameter.
        places: so many values of the parameter to learn from.

    Returns:
        Polynomials that have, at every place, the same zeros as the system; None if coefficients
        are irrational or no rational functions of low degree, or the variables change.
    """
    for count in NUMBERS_OF_VALUES:
        at = list(places(count))
        systems = [system_at(x) for x in at]
        if not _comparable(systems):
            return None
        found = [
            _polynomial(at, parts) for parts in zip(*(s.polynomials for s in systems), strict=True)
        ]
        if all(f is not None for f in found):
            return tuple(found)
    return None


def _comparable(systems: Sequence[PolynomialSystem]) -> bool:
    first = systems[0]
    return all(
        s.exact and s.variables == first.variables and len(s.polynomials) == len(first.polynomials)
        for s in systems
    )


def _polynomial(places: Sequence[Fraction], parts: Sequence[Polynomial]) -> Polynomial | None:
    """One equation, from what it is at each place up to a factor."""
    common = [e for e in sorted(parts[0].terms) if all(e in f.terms for f in parts)]
    if not common:
        return None
    unit = common[-1]
    functions = {}
    for e in sorted({e for f in parts for e in f.terms}):
        values = [Fraction(f.terms.get(e, 0)) / f.terms[unit] for f in parts]
        function = rational_function(places, values)
        if function is None:
            return None
        functions[e] = function
    denominator = fmpq_poly([1])
    for _, each in functions.values():
        denominator *= each // each.gcd(denominator)
    terms: dict[Exponents, Fraction] = {}
    for e, (numerator, own) in functions.items():
        for power, c in enumerate((numerator * (denominator // own)).coeffs()):
            terms[*e, power] = to_fraction(c)
    return Polynomial(parts[0].n + 1, terms)
