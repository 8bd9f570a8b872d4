"""Ideals of polynomials over the rationals by Groebner bases.

Bases come from FLINT's Buchberger algorithm, within bounds; divisions by them are our own.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import lcm
from typing import Any

from nag.algebra.division import Divisor, divisor, remainder
from nag.algebra.hilbert import dimension_and_degree
from nag.algebra.polynomial import Polynomial
from nag.algebra.rational_function import FunctionField, Order, RationalFunction

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
    import flint

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
    sums = [t * _raised(f, ring) for f in first.basis]
    sums += [(1 - t) * _raised(f, ring) for f in second.basis]
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


def _raised(f: Any, ring: Any) -> Any:
    return ring.from_dict({(0, *map(int, e)): c for e, c in f.to_dict().items()})


def cleared(f: Polynomial, field: FunctionField) -> Any:
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
    return ideal(field, [cleared(f, field) for f in polynomials], bounds)
