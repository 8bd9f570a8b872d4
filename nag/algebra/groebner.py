"""Ideals of polynomials over the rationals by Groebner bases: division, dimension and degree.

Bases come from FLINT's Buchberger algorithm, within bounds; divisions by them are our own.
Polynomials are FLINT's with whole coefficients. Everything is multiplied through, never divided:
the remainder is one of a non-zero multiple of the polynomial, by a polynomial in the parameters
that divides a product of leading coefficients. Dimension and degree of an ideal follow from the
leading monomials.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import lcm
from typing import Any

import flint

from nag.algebra.polynomial import Exponents, Polynomial, divides
from nag.algebra.rational_function import FunctionField, Order, RationalFunction


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


def dimension_and_degree(monomials: Iterable[Exponents], n: int) -> tuple[int, int]:
    """Dimension and degree of the zero set of an ideal, its components counted by multiplicity.

    The numerator of the Hilbert series of the leading monomials, divided by 1 - t as often as it
    can be (Cox, Little & O'Shea, Ideals, Varieties, and Algorithms, section 9.3). For an order
    that compares degrees first these are those of the affine variety; the dimension is right for
    every order.

    Args:
        monomials: exponents of the leading monomials, in ``n`` variables.

    Returns:
        (-1, 0) for the whole ring.
    """
    series = _numerator(_minimal(monomials))
    if not any(series):
        return -1, 0
    dimension = n
    while sum(series) == 0:
        # Division by 1 - t: partial sums.
        quotient, total = [], 0
        for c in series[:-1]:
            total += c
            quotient.append(total)
        series, dimension = quotient, dimension - 1
    return dimension, sum(series)


def _minimal(monomials: Iterable[Exponents]) -> list[Exponents]:
    kept: list[Exponents] = []
    for e in sorted(set(monomials), key=sum):
        if not any(divides(f, e) for f in kept):
            kept.append(e)
    return kept


def _numerator(monomials: Sequence[Exponents]) -> list[int]:
    """Coefficients of the numerator over (1 - t)^n, by the exact sequence of a pivot."""
    counts = [
        sum(1 for e in monomials if e[i]) for i in range(len(monomials[0]) if monomials else 0)
    ]
    if any(sum(e) == 0 for e in monomials):
        return [0]
    if all(c <= 1 for c in counts):
        # Coprime monomials: a product of 1 - t^d.
        series = [1]
        for e in monomials:
            d = sum(e)
            longer = [*series, *[0] * d]
            for i, c in enumerate(series):
                longer[i + d] -= c
            series = longer
        return series
    pivot = counts.index(max(counts))
    power = min(e[pivot] for e in monomials if e[pivot])
    x = tuple(power if i == pivot else 0 for i in range(len(counts)))
    with_x = _numerator(_minimal([*monomials, x]))
    quotients = [tuple(max(a - b, 0) for a, b in zip(e, x, strict=True)) for e in monomials]
    by_x = _numerator(_minimal(quotients))
    series = [0] * max(len(with_x), len(by_x) + power)
    for i, c in enumerate(with_x):
        series[i] += c
    for i, c in enumerate(by_x):
        series[i + power] += c
    return series


# Polynomials of a basis, terms of one of them, bits of a coefficient; beyond, it is given up.
BOUNDS = (1000, 10_000, 20_000)


class UnfinishedBasis(ArithmeticError):
    """A Groebner basis that grew beyond the bounds."""


@dataclass(frozen=True, eq=False)
class Ideal:
    """An ideal by its reduced Groebner basis in the order of its ring.

    Attributes:
        field: names of the variables and order of the monomials.
        basis: FLINT's polynomials with coprime whole coefficients; none of the ideal 0.
        generators: those that it was given by.
    """

    field: FunctionField
    basis: tuple[Any, ...]
    generators: tuple[Any, ...]

    @cached_property
    def _divisors(self) -> tuple[Divisor, ...]:
        return tuple(divisor(g, len(self.field.names)) for g in self.basis)

    def remainder(self, f: Any) -> Any:
        """The remainder of a polynomial of the ring, up to a constant; 0 exactly in the ideal."""
        return remainder(f, self._divisors, len(self.field.names))

    def contains(self, polynomials: Iterable[Any]) -> bool:
        """Whether all of them lie in the ideal."""
        return all(self.remainder(f) == 0 for f in polynomials)

    @property
    def whole(self) -> bool:
        """Whether 1 lies in it: there are no zeros."""
        return any(not any(d.monomial) for d in self._divisors)

    @cached_property
    def _dimension_and_degree(self) -> tuple[int, int]:
        return dimension_and_degree((d.monomial for d in self._divisors), len(self.field.names))

    @property
    def dimension(self) -> int:
        """Dimension of the zero set, -1 if it is empty."""
        return self._dimension_and_degree[0]

    @property
    def degree(self) -> int:
        """Degree of the components of that dimension, multiplicities counted.

        Of the affine zero set if the order compares degrees first.
        """
        return self._dimension_and_degree[1]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Ideal):
            return NotImplemented
        return self.contains(other.basis) and other.contains(self.basis)

    __hash__ = None  # type: ignore[assignment]

    def __add__(self, other: Ideal) -> Ideal:
        """The sum: the ideal of the intersection of the zero sets."""
        return self.enlarged(other.basis)

    def enlarged(self, generators: Iterable[Any]) -> Ideal:
        """With more generators."""
        return ideal(self.field, (*self.basis, *generators))


def ideal(
    field: FunctionField, generators: Iterable[Any], bounds: tuple[int, int, int] | None = None
) -> Ideal:
    """The ideal that polynomials generate.

    Args:
        field: the ring's names and order.
        generators: FLINT's polynomials of its ring, or functions, whose numerators are taken.
        bounds: of the basis: polynomials, terms of one of them, bits of a coefficient; `BOUNDS`.

    Raises:
        UnfinishedBasis: beyond the bounds.
    """
    given = [f.numerator if isinstance(f, RationalFunction) else f for f in generators]
    given = [f for f in given if f != 0]
    if not given:
        return Ideal(field, (), ())
    found, finished = flint.fmpz_mpoly_vec(given, field.context).buchberger_naive(
        limits=bounds or BOUNDS
    )
    if not finished:
        raise UnfinishedBasis(f"a Groebner basis of {len(given)} polynomials grows too large")
    return Ideal(field, tuple(found.autoreduction()), tuple(given))


def intersection(first: Ideal, second: Ideal) -> Ideal:
    """The intersection, by elimination of t from t I + (1 - t) J.

    Raises:
        UnfinishedBasis: beyond the bounds.
    """
    longer = FunctionField(("t'", *first.field.names), "lex")
    ring = longer.context
    t = ring.gens()[0]
    sums = [t * _raise_to_ring(f, ring) for f in first.basis]
    sums += [(1 - t) * _raise_to_ring(f, ring) for f in second.basis]
    kept = []
    for f in ideal(longer, sums).basis:
        terms = {tuple(map(int, e)): c for e, c in f.to_dict().items()}
        if not any(e[0] for e in terms):
            kept.append(first.field.context.from_dict({e[1:]: c for e, c in terms.items()}))
    return ideal(first.field, kept)


def quotient(big: Ideal, f: Any) -> Ideal:
    """The ideal of what, times the polynomial f, lies in ``big``: the zeros where f is not 0.

    Raises:
        UnfinishedBasis: beyond the bounds.
    """
    multiples = intersection(big, ideal(big.field, [f]))
    return ideal(big.field, [g // f for g in multiples.basis])


def _raise_to_ring(f: Any, ring: Any) -> Any:
    return ring.from_dict({(0, *map(int, e)): c for e, c in f.to_dict().items()})


def clear_denominators(f: Polynomial, field: FunctionField) -> Any:
    """A polynomial with rational coefficients in the field's variables, times a whole number."""
    factor = lcm(*(c.denominator for c in f.terms.values()))
    return field.context.from_dict({e: int(c * factor) for e, c in f.terms.items()})


def ideal_of(
    polynomials: Sequence[Polynomial],
    names: Sequence[str],
    order: Order = "degrevlex",
    bounds: tuple[int, int, int] | None = None,
) -> Ideal:
    """The ideal of a system's exact equations.

    Raises:
        UnfinishedBasis: beyond the bounds.
    """
    field = FunctionField(names, order)
    return ideal(field, [clear_denominators(f, field) for f in polynomials], bounds)
