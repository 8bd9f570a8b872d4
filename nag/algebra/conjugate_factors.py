"""Factors of polynomials whose coefficients are sums of roots, by their norms.

The norm of a polynomial, the product of its conjugates, has rational coefficients. Where an
irreducible factor of the norm has the degree of the norm of what it has in common with the
polynomial, that is irreducible over the field of the roots (Trager, Algebraic factoring and
rational function integration, 1976); which it has for almost all shifts of the variables by
multiples of the roots. What two polynomials have in common is found modulo primes where the roots
are, in each of the field's embeddings, and tried on the polynomials themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from math import isqrt, prod
from typing import Any

import flint

from nag.algebra.exact_ranks import NumberField, PrimeField, residues
from nag.algebra.number import Exact, Surd
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.root_basis import Root
from nag.algebra.surd import normal_sum

# Distinct irreducible polynomials with their exponents.
Factors = tuple[tuple[Polynomial, int], ...]
RationalFactors = Callable[[Polynomial], Factors]

# What is larger is not taken apart: the roots with their products; the degree of a norm, and the
# products of terms that it takes.
MOST_EMBEDDINGS, MOST_DEGREE, MOST_PRODUCTS = 4, 24, 200_000
# Shifts that are tried; moduli together, from which coefficients are read off.
SHIFTS, MOST_MODULI = 4, 8


def conjugate_polynomial(f: Polynomial, units: Mapping[int, int]) -> Polynomial:
    """The polynomial with an automorphism's images of the coefficients."""
    return Polynomial(
        f.n,
        {e: c.conjugate(units) if isinstance(c, Surd) else c for e, c in f.terms.items()},
    )


def field_of_coefficients(polynomials: Sequence[Polynomial]) -> NumberField:
    """The least field in which all coefficients are."""
    return NumberField.of(c for f in polynomials for c in f.terms.values())


def find_norm(f: Polynomial, field: NumberField) -> Polynomial | None:
    """The product of the conjugates; None if that takes too many products."""
    factors = [conjugate_polynomial(f, units) for units in field.automorphisms()]
    while len(factors) > 1:
        if len(factors[0].terms) ** 2 > MOST_PRODUCTS:
            return None
        pairs = zip(factors[::2], [*factors[1::2], None], strict=False)
        factors = [g if h is None else g * h for g, h in pairs]
    return factors[0]


def make_monic(f: Polynomial) -> Polynomial:
    """The multiple whose first coefficient, by the lexicographic order of exponents, is one."""
    return f * (1 / f.terms[max(f.terms)])


def factor_with_roots(f: Polynomial, factor: RationalFactors) -> Factors | None:
    """The monic irreducible factors over the field of the coefficients, with exponents.

    Args:
        f: monic, no constant; its coefficients are known exactly.
        factor: factors rational polynomials.

    Returns:
        None for what is too large, or is not taken apart by few shifts.
    """
    field = field_of_coefficients([f])
    size = field.degree
    if size > MOST_EMBEDDINGS or f.degree * size > MOST_DEGREE:
        return None
    for shift in range(SHIFTS):
        moved = _shift(f, field, shift)
        norm = find_norm(moved, field)
        if norm is None:
            return None
        found = _factors_by_norm(moved, factor(norm), field)
        if found is not None:
            return tuple((make_monic(_shift(g, field, -shift)), k) for g, k in found)
    return None


def _shift(f: Polynomial, field: NumberField, shift: int) -> Polynomial:
    """Each variable with a multiple of the sum of the roots added."""
    if not shift:
        return f
    root = normal_sum({r: flint.fmpq(shift) for r in field.roots[1:]})
    # Another weight for each variable: the same one leaves differences as they are.
    images = [x + root * (i + 1) for i, x in enumerate(Polynomial.variables(f.n))]
    return f.compose(images)


def _factors_by_norm(f: Polynomial, norm: Factors, field: NumberField) -> Factors | None:
    """The factors, if those of the norm tell them apart."""
    found: list[tuple[Polynomial, int]] = []
    for h, k in norm:
        # As large a factor as the degree wants is all of the polynomial.
        whole = k == 1 and h.degree == f.degree * field.degree
        common = f if whole else common_factor_with_roots([f, h], field)
        if common is None or common.degree * field.degree != h.degree:
            return None
        found.append((common, k))
    product = prod((g**k for g, k in found), start=Polynomial.constant(f.n, 1))
    return tuple(found) if make_monic(product) == make_monic(f) else None


def common_factor_with_roots(
    polynomials: Sequence[Polynomial], field: NumberField | None = None
) -> Polynomial | None:
    """The monic greatest common divisor over the field of the coefficients, 1 among them.

    Args:
        polynomials: not zero, with coefficients that are known exactly.
        field: that has all coefficients, the least one if it is left out.

    Returns:
        None where it is not found within `MOST_MODULI`.
    """
    field = field or field_of_coefficients(polynomials)
    if field.degree > MOST_EMBEDDINGS:
        return None
    leading: Exponents | None = None
    known: dict[tuple[Exponents, int], int] = {}
    modulus = 1
    for prime in field.fields(MOST_MODULI):
        images = _coefficients_modulo(polynomials, field, prime)
        top = max(e for e, _ in images)
        if leading is not None and top > leading:
            continue
        if leading is None or top < leading:
            leading, known, modulus = top, {}, 1
        known = _join(known, modulus, images, prime.modulus)
        modulus *= prime.modulus
        if not any(top):
            return Polynomial.constant(polynomials[0].n, 1)
        found = _read(polynomials[0].n, known, modulus, field)
        if found is not None and all(exact_quotient(f, found) is not None for f in polynomials):
            return found
    return None


def _coefficients_modulo(
    polynomials: Sequence[Polynomial], field: NumberField, prime: PrimeField
) -> dict[tuple[Exponents, int], int]:
    """Coordinates of the divisor's coefficients, by monomial and place of the root."""
    p, n = prime.modulus, polynomials[0].n
    context = flint.nmod_mpoly_ctx.get([f"x{i}" for i in range(n)], p, flint.Ordering.lex)
    divisors, conjugates = [], field.conjugates(prime)
    for image in conjugates:
        images = (residues(f, image) for f in polynomials)
        own = [context.from_dict({e: c for e, c in terms.items() if c}) for terms in images]
        divisor = reduce(lambda f, g: f.gcd(g), own)
        terms = {tuple(map(int, e)): int(c) for e, c in divisor.to_dict().items()}
        inverse = pow(terms[max(terms)], -1, p)
        divisors.append({e: c * inverse % p for e, c in terms.items()})
    coordinates = prime.matrix([[image.image(r) for r in field.roots] for image in conjugates])
    inverse = [list(map(int, row)) for row in coordinates.inv().tolist()]
    found = {}
    for e in dict.fromkeys(e for terms in divisors for e in terms):
        values = [terms.get(e, 0) for terms in divisors]
        for k, row in enumerate(inverse):
            found[e, k] = sum(a * b for a, b in zip(row, values, strict=True)) % p
    return found


def _join(known: dict[Any, int], modulus: int, more: dict[Any, int], prime: int) -> dict[Any, int]:
    """Residues modulo the product of both moduli."""
    if modulus == 1:
        return more
    inverse = pow(modulus, -1, prime)
    return {
        key: known.get(key, 0)
        + modulus * ((more.get(key, 0) - known.get(key, 0)) * inverse % prime)
        for key in known | more
    }


def _read(
    n: int, known: dict[tuple[Exponents, int], int], modulus: int, field: NumberField
) -> Polynomial | None:
    """The polynomial whose coefficients' coordinates are the simplest of these residues."""
    sums: dict[Exponents, dict[Root, flint.fmpq]] = {}
    for (e, k), c in known.items():
        value = _simplest(c, modulus)
        if value is None:
            return None
        sums.setdefault(e, {})[field.roots[k]] = value
    return Polynomial(n, {e: normal_sum(roots) for e, roots in sums.items()})


def _simplest(c: int, modulus: int) -> flint.fmpq | None:
    """The fraction of numerator and denominator below the root of half the modulus (Wang)."""
    bound = isqrt(modulus // 2)
    (a, s), (b, t) = (modulus, 0), (c, 1)
    while b > bound:
        quotient = a // b
        (a, s), (b, t) = (b, t), (a - quotient * b, s - quotient * t)
    return flint.fmpq(b, t) if t and abs(t) <= bound else None


def exact_quotient(f: Polynomial, g: Polynomial) -> Polynomial | None:
    """The quotient by a monic polynomial; None if something is left."""
    top = max(g.terms)
    rest: dict[Exponents, Exact] = dict(f.terms)
    quotient: dict[Exponents, Exact] = {}
    while rest:
        e = max(rest)
        over = tuple(a - b for a, b in zip(e, top, strict=True))
        if min(over, default=0) < 0:
            return None
        c = quotient[over] = rest[e]
        for d, b in g.terms.items():
            place = tuple(x + y for x, y in zip(d, over, strict=True))
            value = rest.get(place, Fraction(0)) - b * c
            if value:
                rest[place] = value
            else:
                rest.pop(place, None)
    return Polynomial(f.n, quotient)
