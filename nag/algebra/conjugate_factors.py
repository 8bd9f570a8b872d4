"""Factors of polynomials whose coefficients are sums of square roots, by their norms.

The norm of a polynomial, the product of its conjugates, has rational coefficients. Where an
irreducible factor of the norm has the degree of the norm of what it has in common with the
polynomial, that is irreducible over the field of the roots (Trager, Algebraic factoring and
rational function integration, 1976); which it has for almost all shifts of the variables by
multiples of the roots. What two polynomials have in common is found modulo primes where the roots
are, in each of the field's embeddings, and tried on the polynomials themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from math import isqrt, prod
from typing import Any

import flint

from nag.algebra.exact_ranks import PrimeField, fields_with_roots, residues, roots_of
from nag.algebra.number import Exact, Surd
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.surd import normal_sum, primes_of

# Distinct irreducible polynomials with their exponents.
Factors = tuple[tuple[Polynomial, int], ...]
RationalFactors = Callable[[Polynomial], Factors]

# What is larger is not taken apart: the roots with their products; the degree of a norm, and the
# products of terms that it takes.
MOST_EMBEDDINGS, MOST_DEGREE, MOST_PRODUCTS = 4, 24, 200_000
# Shifts that are tried; moduli together, from which coefficients are read off.
SHIFTS, MOST_MODULI = 4, 8


@dataclass(frozen=True)
class RootField:
    """The field of the rational numbers with square roots.

    Attributes:
        roots: square-free integers, 1 first, whose roots are a basis: twice as many with each
            generator, the later half the products of it with the first half.
    """

    roots: tuple[int, ...]

    @classmethod
    def of(cls, polynomials: Sequence[Polynomial]) -> RootField:
        """The least one in which all coefficients are."""
        return cls(roots_of(f.terms.values() for f in polynomials))

    def sign(self, embedding: int, k: int) -> int:
        """The sign of the ``k``-th root where the generators change theirs by the bits."""
        return -1 if (embedding & k).bit_count() % 2 else 1

    def conjugate(self, f: Polynomial, embedding: int) -> Polynomial:
        """The polynomial with the roots' signs changed."""
        signs = {r: self.sign(embedding, k) for k, r in enumerate(self.roots)}

        def image(c: Exact) -> Exact:
            if not isinstance(c, Surd):
                return c
            return normal_sum({r: q if signs[r] > 0 else -q for r, q in c.terms.items()})

        return Polynomial(f.n, {e: image(c) for e, c in f.terms.items()})

    def norm(self, f: Polynomial) -> Polynomial | None:
        """The product of the conjugates; None if that takes too many products."""
        generator = 1
        while generator < len(self.roots):
            if len(f.terms) ** 2 > MOST_PRODUCTS:
                return None
            f = f * self.conjugate(f, generator)
            generator *= 2
        return f

    def fields(self) -> tuple[PrimeField, ...]:
        """Primes modulo which the roots are there."""
        primes = frozenset(p for r in self.roots for p in primes_of(r))
        return fields_with_roots(primes, count=MOST_MODULI)


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
    field = RootField.of([f])
    size = len(field.roots)
    if size > MOST_EMBEDDINGS or f.degree * size > MOST_DEGREE:
        return None
    for shift in range(SHIFTS):
        moved = _shift(f, field, shift)
        norm = field.norm(moved)
        if norm is None:
            return None
        found = _factors_by_norm(moved, factor(norm), field)
        if found is not None:
            return tuple((make_monic(_shift(g, field, -shift)), k) for g, k in found)
    return None


def _shift(f: Polynomial, field: RootField, shift: int) -> Polynomial:
    """Each variable with a multiple of the sum of the roots added."""
    if not shift:
        return f
    root = normal_sum({r: flint.fmpq(shift) for r in field.roots[1:]})
    # Another weight for each variable: the same one leaves differences as they are.
    images = [x + root * (i + 1) for i, x in enumerate(Polynomial.variables(f.n))]
    return f.compose(images)


def _factors_by_norm(f: Polynomial, norm: Factors, field: RootField) -> Factors | None:
    """The factors, if those of the norm tell them apart."""
    found: list[tuple[Polynomial, int]] = []
    for h, k in norm:
        # As large a factor as the degree wants is all of the polynomial.
        whole = k == 1 and h.degree == f.degree * len(field.roots)
        common = f if whole else common_factor_with_roots([f, h], field)
        if common is None or common.degree * len(field.roots) != h.degree:
            return None
        found.append((common, k))
    product = prod((g**k for g, k in found), start=Polynomial.constant(f.n, 1))
    return tuple(found) if make_monic(product) == make_monic(f) else None


def common_factor_with_roots(
    polynomials: Sequence[Polynomial], field: RootField | None = None
) -> Polynomial | None:
    """The monic greatest common divisor over the field of the coefficients, 1 among them.

    Args:
        polynomials: not zero, with coefficients that are known exactly.
        field: that has all coefficients, the least one if it is left out.

    Returns:
        None where it is not found within `MOST_MODULI`.
    """
    field = field or RootField.of(polynomials)
    if len(field.roots) > MOST_EMBEDDINGS:
        return None
    leading: Exponents | None = None
    known: dict[tuple[Exponents, int], int] = {}
    modulus = 1
    for prime in field.fields():
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
    polynomials: Sequence[Polynomial], field: RootField, prime: PrimeField
) -> dict[tuple[Exponents, int], int]:
    """Coordinates of the divisor's coefficients, by monomial and place of the root."""
    p, n = prime.modulus, polynomials[0].n
    context = flint.nmod_mpoly_ctx.get([f"x{i}" for i in range(n)], p, flint.Ordering.lex)
    divisors = []
    for embedding in range(len(field.roots)):
        images = (residues(field.conjugate(f, embedding), prime) for f in polynomials)
        own = [context.from_dict({e: c for e, c in terms.items() if c}) for terms in images]
        divisor = reduce(lambda f, g: f.gcd(g), own)
        terms = {tuple(map(int, e)): int(c) for e, c in divisor.to_dict().items()}
        inverse = pow(terms[max(terms)], -1, p)
        divisors.append({e: c * inverse % p for e, c in terms.items()})
    found = {}
    for k, r in enumerate(field.roots):
        root = prod(map(prime.root, primes_of(r))) % p
        inverse = pow(len(field.roots) * root, -1, p)
        for e in dict.fromkeys(e for terms in divisors for e in terms):
            values = (field.sign(m, k) * terms.get(e, 0) for m, terms in enumerate(divisors))
            found[e, k] = sum(values) * inverse % p
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
    n: int, known: dict[tuple[Exponents, int], int], modulus: int, field: RootField
) -> Polynomial | None:
    """The polynomial whose coefficients' coordinates are the simplest of these residues."""
    sums: dict[Exponents, dict[int, flint.fmpq]] = {}
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
