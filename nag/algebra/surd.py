"""Sums of rational multiples of square roots, in a normal form.

The square roots of square-free positive integers are linearly independent over the rationals
(Besicovitch, On the linear independence of fractional powers of integers, 1940): a sum that has
each of them once is zero only if nothing is left of it, and two are equal only if they are the
same. So zero is exact, and sums of roots that meet in any place have one form without a field being
agreed on first. A product of two roots is one of them times the root of the common divisor's
square; where all roots of primes change sign, sums go into conjugates, which give inverses.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import gcd, isqrt
from types import MappingProxyType
from typing import Any

import flint

from nag.algebra.flint_numbers import to_fraction, to_rational

# Small primes are looked for in all radicands; of what is then left larger ones are not factored.
_SMALL_PRIMES, _LARGEST_FACTORED = 10_000, 10**30
# Bits with which the evaluation of a sum begins; a rational number's error is far below a double's.
_BITS = 128
# Of a root in a sum of roots, how often one is taken in the search for it.
_DEEPEST = 6

Exact = Fraction | int


@dataclass(frozen=True, eq=False, slots=True)
class Surd:
    """A real number that is a sum of rational multiples of square roots, and not rational.

    Attributes:
        terms: rational numbers of FLINT's, not zero, by the square-free positive integers whose
            roots they multiply; 1 is that of the rational part.
    """

    terms: Mapping[int, flint.fmpq]

    def __reduce__(self) -> tuple[Any, ...]:
        return normal_sum, (dict(self.terms),)

    def __add__(self, other: Surd | Exact) -> Surd | Fraction:
        theirs = _terms(other)
        if theirs is None:
            return NotImplemented
        terms = dict(self.terms)
        for r, c in theirs.items():
            terms[r] = terms[r] + c if r in terms else c
        return normal_sum(terms)

    __radd__ = __add__

    def __neg__(self) -> Surd:
        return _of({r: -c for r, c in self.terms.items()})

    def __pos__(self) -> Surd:
        return self

    def __abs__(self) -> Surd:
        return -self if self.sign() < 0 else self

    def __sub__(self, other: Surd | Exact) -> Surd | Fraction:
        theirs = _terms(other)
        if theirs is None:
            return NotImplemented
        terms = dict(self.terms)
        for r, c in theirs.items():
            terms[r] = terms[r] - c if r in terms else -c
        return normal_sum(terms)

    def __rsub__(self, other: Exact) -> Surd | Fraction:
        return (-self) + other

    def __mul__(self, other: Surd | Exact) -> Surd | Fraction:
        if isinstance(other, Surd):
            return normal_sum(multiply_sums(self.terms, other.terms))
        if not isinstance(other, int | Fraction):
            return NotImplemented
        if not other:
            return Fraction(0)
        q = to_rational(other)
        return _of({r: c * q for r, c in self.terms.items()})

    __rmul__ = __mul__

    def __truediv__(self, other: Surd | Exact) -> Surd | Fraction:
        if isinstance(other, Surd):
            return self * other.inverse()
        if not isinstance(other, int | Fraction):
            return NotImplemented
        return self * (1 / Fraction(other))

    def __rtruediv__(self, other: Exact) -> Surd | Fraction:
        if not isinstance(other, int | Fraction):
            return NotImplemented
        return self.inverse() * other

    def __pow__(self, exponent: int) -> Surd | Fraction:
        if exponent < 0:
            return self.inverse() ** -exponent
        result: Surd | Fraction = Fraction(1)
        base: Surd | Fraction = self
        while exponent:
            if exponent & 1:
                result = base * result
            exponent >>= 1
            if exponent:
                base = base * base
        return result

    def inverse(self) -> Surd:
        """One over it."""
        if len(self.terms) == 1:
            ((r, c),) = self.terms.items()
            return _of({r: 1 / (c * r)})
        found: Surd | Fraction = Fraction(1)
        rest: Surd | Fraction = self
        while isinstance(rest, Surd):
            conjugate = rest.conjugate(max(p for r in rest.terms for p in primes_of(r)))
            found, rest = found * conjugate, rest * conjugate
        result = found * (1 / rest)
        assert isinstance(result, Surd)
        return result

    def conjugate(self, prime: int) -> Surd:
        """The image where the square root of a prime changes its sign, and no other's."""
        return _of({r: c if r % prime else -c for r, c in self.terms.items()})

    def primes(self) -> frozenset[int]:
        """The primes whose roots it is made of."""
        return frozenset(p for r in self.terms for p in primes_of(r))

    def ball(self, bits: int) -> flint.arb:
        """A ball that contains it, whose radius is smaller by so many bits."""
        working = bits + 16
        while True:
            with flint.ctx.workprec(working):
                total = flint.arb(0)
                for r, c in self.terms.items():
                    total += flint.arb(r).sqrt() * c
            if total.rel_accuracy_bits() >= bits:
                return total
            working *= 2

    def binary(self, bits: int) -> tuple[int, int]:
        """Integers m and k, for which ``m 2^k`` has about so many bits in common with it."""
        mantissa, exponent = self.ball(bits).mid().man_exp()
        return int(mantissa), int(exponent)

    def sign(self) -> int:
        """1 or -1."""
        return 1 if self.ball(2) > 0 else -1

    def modulo(self, modulus: int, root: Callable[[int], int]) -> int:
        """Its image modulo a prime number.

        Args:
            root: a square root of each prime number modulo that one.

        Raises:
            ZeroDivisionError: if the modulus divides a denominator.
        """
        total = 0
        for r, c in self.terms.items():
            value = int(c.p) * pow_inverse(int(c.q), modulus)
            for p in primes_of(r):
                value = value * root(p) % modulus
            total += value
        return total % modulus

    @property
    def size(self) -> int:
        """Number of roots, and the rational part."""
        return len(self.terms)

    @property
    def bits(self) -> int:
        """Bits of the longest integer in it."""
        parts = (max(int(c.p).bit_length(), int(c.q).bit_length()) for c in self.terms.values())
        return max(*parts, max(self.terms).bit_length(), 1)

    def __float__(self) -> float:
        return float(self.ball(_BITS).mid())

    def __bool__(self) -> bool:
        return True

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Surd):
            return self.terms == other.terms
        return False if isinstance(other, int | Fraction) else NotImplemented

    def __hash__(self) -> int:
        return hash(float(self))

    def _sign_of_difference(self, other: Surd | Exact) -> int:
        difference = self - other
        if isinstance(difference, Surd):
            return difference.sign()
        return (difference > 0) - (difference < 0)

    def __lt__(self, other: Surd | Exact) -> bool:
        if not isinstance(other, int | Fraction | Surd):
            return NotImplemented
        return self._sign_of_difference(other) < 0

    def __le__(self, other: Surd | Exact) -> bool:
        if not isinstance(other, int | Fraction | Surd):
            return NotImplemented
        return self._sign_of_difference(other) <= 0

    def __gt__(self, other: Surd | Exact) -> bool:
        if not isinstance(other, int | Fraction | Surd):
            return NotImplemented
        return self._sign_of_difference(other) > 0

    def __ge__(self, other: Surd | Exact) -> bool:
        if not isinstance(other, int | Fraction | Surd):
            return NotImplemented
        return self._sign_of_difference(other) >= 0

    def __str__(self) -> str:
        """As it is written in a file: ``sqrt(3)/2``, ``(1/2-5*sqrt(2)/3)``."""
        texts = [_term_text(r, self.terms[r]) for r in sorted(self.terms)]
        if len(texts) == 1:
            return texts[0]
        signed = [t if t.startswith("-") else f"+{t}" for t in texts[1:]]
        return f"({texts[0]}{''.join(signed)})"

    def __repr__(self) -> str:
        return f"Surd({self})"


def _term_text(radicand: int, factor: flint.fmpq) -> str:
    if radicand == 1:
        return str(factor)
    p, q = int(factor.p), int(factor.q)
    front = {1: "", -1: "-"}.get(p, f"{p}*")
    return f"{front}sqrt({radicand})" + (f"/{q}" if q != 1 else "")


def _terms(value: Surd | Exact | Any) -> Mapping[int, flint.fmpq] | None:
    if isinstance(value, Surd):
        return value.terms
    if isinstance(value, int | Fraction):
        return {1: to_rational(value)} if value else {}
    return None


def _of(terms: dict[int, flint.fmpq]) -> Surd:
    return Surd(MappingProxyType(terms))


def normal_sum(terms: Mapping[int, flint.fmpq]) -> Surd | Fraction:
    """The sum of rational multiples of square roots of square-free integers, zeros among them."""
    kept = {r: c for r, c in terms.items() if c}
    if not kept:
        return Fraction(0)
    if len(kept) == 1 and 1 in kept:
        return to_fraction(kept[1])
    return _of(kept)


def multiply_roots(r: int, s: int) -> tuple[int, int]:
    """Square-free t and a whole factor with ``sqrt(r) sqrt(s) = factor sqrt(t)``."""
    if r == s:
        return 1, r
    if r == 1:
        return s, 1
    if s == 1:
        return r, 1
    common = gcd(r, s)
    return (r // common) * (s // common), common


def multiply_sums(first: Mapping[int, Any], second: Mapping[int, Any]) -> dict[int, Any]:
    """The product of sums, by radicands; what cancels stays as zero.

    Coefficients are of any arithmetic in which whole numbers multiply.
    """
    terms: dict[int, Any] = {}
    for r, c in first.items():
        for s, d in second.items():
            t, factor = multiply_roots(r, s)
            product = c * d if factor == 1 else c * d * factor
            terms[t] = terms[t] + product if t in terms else product
    return terms


def pow_inverse(a: int, modulus: int) -> int:
    """One over an integer modulo a prime.

    Raises:
        ZeroDivisionError: if the prime divides it.
    """
    if a == 1:
        return 1
    if a % modulus == 0:
        raise ZeroDivisionError(f"{modulus} divides a denominator")
    return pow(a, -1, modulus)


@lru_cache(maxsize=4096)
def primes_of(radicand: int) -> tuple[int, ...]:
    """The primes that divide a square-free positive integer whose factors can be found."""
    return tuple(int(p) for p, _ in flint.fmpz(radicand).factor()) if radicand > 1 else ()


@lru_cache(maxsize=4096)
def split_square(n: int) -> tuple[int, int] | None:
    """``(a, r)`` with ``n = a^2 r`` and r square-free, for a positive integer.

    None if its factors are too large to be looked for.
    """
    root = isqrt(n)
    if root * root == n:
        return root, 1
    root, radicand, left = 1, 1, n
    for p in _small_primes():
        if p * p > left:
            break
        while left % (p * p) == 0:
            root, left = root * p, left // (p * p)
        if left % p == 0:
            radicand, left = radicand * p, left // p
    whole = isqrt(left)
    if whole * whole == left:
        return root * whole, radicand
    if left > _LARGEST_FACTORED and not flint.fmpz(left).is_prime():
        return None
    for p, k in flint.fmpz(left).factor():
        root *= int(p) ** (int(k) // 2)
        radicand *= int(p) ** (int(k) % 2)
    return root, radicand


@lru_cache(maxsize=1)
def _small_primes() -> tuple[int, ...]:
    return tuple(p for p in range(2, _SMALL_PRIMES) if flint.fmpz(p).is_prime())


def root_of_fraction(value: Fraction) -> Surd | Fraction | None:
    """The non-negative square root of a rational number that is not negative.

    None if its radicand has too large factors for a normal form.
    """
    if not value:
        return Fraction(0)
    # Both parts have no common factor: their square-free parts have none either.
    parts = split_square(value.numerator), split_square(value.denominator)
    if parts[0] is None or parts[1] is None:
        return None
    (a, r), (b, s) = parts
    if r * s > _LARGEST_FACTORED and not (r == 1 or s == 1):
        return None
    return normal_sum({r * s: flint.fmpq(a, b * s)})


def root_of_surd(value: Surd, depth: int = _DEEPEST) -> Surd | Fraction | None:
    """The positive square root of a positive sum of roots, if that is such a sum and is found.

    With ``a + b sqrt(p)`` for the sum, the root and its conjugate have the product
    ``sqrt(a^2 - p b^2)``, and with it the sum and difference of both are roots of simpler numbers.
    """
    if depth == 0 or value.sign() < 0:
        return None
    prime = max(value.primes())
    if all(r % prime == 0 for r in value.terms):
        # Of sqrt(p) times a number, the fourth root of p would be a factor.
        return None
    even = normal_sum({r: c for r, c in value.terms.items() if r % prime})
    norm = _root(value * value.conjugate(prime), depth - 1)
    if norm is None:
        return None
    halves = [_root((even + norm) / 2, depth - 1), _root((even - norm) / 2, depth - 1)]
    if halves[0] is None or halves[1] is None:
        return None
    for found in (halves[0] + halves[1], halves[0] - halves[1]):
        if found * found == value:
            return abs(found)
    return None


def _root(value: Surd | Fraction, depth: int) -> Surd | Fraction | None:
    if isinstance(value, Surd):
        return root_of_surd(value, depth)
    return root_of_fraction(value) if value >= 0 else None
