"""Division with remainder by several polynomials, over the rationals or with parameters.

Polynomials are FLINT's with whole coefficients. Everything is multiplied through, never divided:
the remainder is one of a non-zero multiple of the polynomial, by a polynomial in the parameters
that divides a product of leading coefficients.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from nag.algebra.polynomial import Exponents, divides


@dataclass(frozen=True)
class Divisor:
    """A polynomial with its leading monomial and coefficient.

    Attributes:
        polynomial: all of it.
        monomial: exponents of the leading monomial in the ``k`` first variables.
        coefficient: what stands before it, a polynomial in the other ones.
    """

    polynomial: Any
    monomial: Exponents
    coefficient: Any


def divisor(polynomial: Any, k: int) -> Divisor:
    """The leading term, where the first ``k`` variables are variables and the rest parameters.

    The order is that of the polynomial's ring; with parameters it must be lexicographic, so that
    the terms with one monomial stand together.
    """
    monomial, coefficient = _leading(polynomial, k)
    return Divisor(polynomial, monomial, coefficient)


def remainder(polynomial: Any, divisors: Sequence[Divisor], k: int) -> Any:
    """The remainder of a polynomial: no monomial of it is a multiple of a leading one.

    It is zero if the polynomial is a combination of the divisors and these are a Groebner basis,
    and only if a non-zero multiple by parameters is one.
    """
    ring = polynomial.context()
    rest = ring.from_dict({})
    while polynomial != 0:
        monomial, coefficient = _leading(polynomial, k)
        for d in divisors:
            if divides(d.monomial, monomial):
                quotient = tuple(map(int.__sub__, monomial, d.monomial))
                common = coefficient.gcd(d.coefficient)
                raised = ring.from_dict({(*quotient, *[0] * (ring.nvars() - k)): 1})
                factor = d.coefficient // common
                polynomial = polynomial * factor - d.polynomial * raised * (coefficient // common)
                rest = rest * factor
                break
        else:
            term = coefficient * ring.from_dict({(*monomial, *[0] * (ring.nvars() - k)): 1})
            polynomial, rest = polynomial - term, rest + term
    return rest


def _leading(polynomial: Any, k: int) -> tuple[Exponents, Any]:
    ring = polynomial.context()
    terms = {}
    first: Exponents | None = None
    for exponents, coefficient in polynomial.terms():
        exponents = tuple(map(int, exponents))
        if first is None:
            first = exponents[:k]
        if exponents[:k] != first:
            break
        terms[(*[0] * k, *exponents[k:])] = coefficient
    return first or (), ring.from_dict(terms)
