"""Cosines of rational turns, and numbers that are made of them, modulo primes.

The number 2 cos(2 pi / n) has the conjugates 2 cos(2 pi k / n), k prime to n, and its field, of
degree phi(n) / 2, has the numbers 1 and 2 cos(2 pi j / n), 0 < j < phi(n) / 2, for a basis
(Washington, Introduction to cyclotomic fields, proposition 2.16). Modulo a prime that leaves 1 or
-1 modulo n all of them are residues. Square roots are such sums as well, by Gauss.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import islice
from math import gcd, lcm

import flint

from nag.algebra.exact_ranks import LARGEST_PRIME, PrimeField
from nag.algebra.number import PI, Irrational, Number, Surd, cosine, pi_multiple
from nag.algebra.surd import pow_inverse

# Conjugates that are looked at: the degree of the largest field.
MOST_DEGREE = 8
# Two in so many primes leave 1 or -1, and one in some forty numbers is a prime.
MOST_TRIES = 20_000


@dataclass(frozen=True)
class CosinesModulo(PrimeField):
    """Arithmetic modulo a prime in which the cosines of n-ths of a turn are residues.

    Attributes:
        order: n.
        power: k, where the cosine of j turns by 1/n is taken for that of j k such turns.
    """

    order: int = 1
    power: int = 1

    @cached_property
    def doubled_cosines(self) -> tuple[int, ...]:
        """2 cos(2 pi j k / n) for j from 0 to n - 1."""
        p, n = self.modulus, self.order
        plain = _doubled_cosines(n, p)
        return tuple(plain[j * self.power % n] for j in range(n))

    def of(self, c: Number | int) -> int:
        """The image of a number that is made of cosines.

        Raises:
            ZeroDivisionError: if the prime divides a denominator.
            ArithmeticError: if the number is not made of these cosines.
        """
        if isinstance(c, Surd):
            return c.modulo(self.modulus, self.root)
        if not isinstance(c, Irrational):
            return super().of(c)
        p = self.modulus
        turns = _turns(c)
        if turns is not None:
            return self._cosine(turns)
        values = [self.of(a) for a in c.arguments]
        if c.operation == "neg":
            return -values[0] % p
        if c.operation == "+":
            return sum(values) % p
        if c.operation == "*":
            return values[0] * values[1] % p
        if c.operation == "/":
            return values[0] * pow_inverse(values[1], p) % p
        raise ArithmeticError(f"{c} is not made of cosines of rational turns")

    def root(self, a: int) -> int:
        """The square root of a prime number, the same sum of cosines in each image."""
        total = sum(factor * self._cosine(turns) for turns, factor in _root_as_cosines(a))
        return total % self.modulus

    def _cosine(self, turns: Fraction) -> int:
        j = turns * self.order
        if j.denominator > 1:
            raise ArithmeticError(f"the cosine of {turns} turns is not one of n-ths of a turn")
        half = (self.modulus + 1) // 2
        return self.doubled_cosines[int(j) % self.order] * half % self.modulus


@dataclass(frozen=True)
class CosineField:
    """The field of 2 cos(2 pi / n) for an even n, which that of n / 2 is where this is odd.

    A `nag.interpolation.image_forms.CoefficientField`.

    Attributes:
        order: n.
    """

    order: int

    @property
    def degree(self) -> int:
        """Over the rational numbers."""
        return len(self._powers)

    @property
    def basis(self) -> tuple[Number, ...]:
        """Numbers whose rational combinations are the field, 1 first."""
        one: Number = Fraction(1)
        return (one, *(2 * cosine(Fraction(2 * j, self.order) * PI) for j in range(1, self.degree)))

    @cached_property
    def _powers(self) -> tuple[int, ...]:
        """Those that give different images."""
        n = self.order
        return tuple(k for k in range(1, n // 2 + 1) if gcd(k, n) == 1) or (1,)

    def fields(self, count: int) -> tuple[CosinesModulo, ...]:
        """So many primes modulo which its numbers have images, fewer if they are not found."""
        found = islice(_primes_for(self.order), count)
        return tuple(CosinesModulo(p, order=self.order) for p in found)

    def conjugates(self, field: CosinesModulo) -> tuple[CosinesModulo, ...]:
        """The images of the field modulo one prime."""
        return tuple(CosinesModulo(field.modulus, order=self.order, power=k) for k in self._powers)


def field_of_cosines(values: Iterable[Number]) -> CosineField | None:
    """The least field of cosines in which numbers are; None if there is none of `MOST_DEGREE`."""
    order = 2
    for value in values:
        own = _order_of(value)
        if own is None:
            return None
        order = lcm(order, own)
    field = CosineField(order)
    return field if order <= _largest_order() and field.degree <= MOST_DEGREE else None


def _largest_order() -> int:
    """An n above which phi(n) / 2 is larger than `MOST_DEGREE`: phi(n) >= sqrt(n / 2)."""
    return 8 * MOST_DEGREE**2


def _order_of(value: Number) -> int | None:
    """An n such that a number is made of cosines of n-ths of a turn."""
    if isinstance(value, Surd):
        return lcm(*(t.denominator for p in value.primes() for t, _ in _root_as_cosines(p)))
    if not isinstance(value, Irrational):
        return 1
    turns = _turns(value)
    if turns is not None:
        return turns.denominator
    if value.operation not in ("neg", "+", "*", "/"):
        return None
    parts = [_order_of(a) for a in value.arguments]
    return None if None in parts else lcm(*parts)


def _turns(value: Irrational) -> Fraction | None:
    """The turns whose cosine a number is, if it is written as a sine or cosine of such an angle."""
    if value.operation not in ("sin", "cos"):
        return None
    angle = pi_multiple(value.arguments[0])
    if angle is None:
        return None
    return angle / 2 if value.operation == "cos" else Fraction(1, 4) - angle / 2


@lru_cache(maxsize=256)
def _root_as_cosines(prime: int) -> tuple[tuple[Fraction, int], ...]:
    """The square root of a prime number as a sum of whole multiples of cosines, by their turns."""
    if prime == 2:
        return ((Fraction(1, 8), 2),)
    shift = Fraction(0) if prime % 4 == 1 else Fraction(1, 4)
    return tuple(
        (Fraction(j, prime) - shift, 1 if pow(j, (prime - 1) // 2, prime) == 1 else -1)
        for j in range(1, prime)
    )


@lru_cache(maxsize=256)
def _doubled_cosines(order: int, p: int) -> tuple[int, ...]:
    """2 cos(2 pi j / n) modulo a prime, from a zero of the first one's minimal polynomial."""
    minimal = flint.nmod_poly([int(c) for c in flint.fmpz_poly.cos_minpoly(order)], p)
    roots = [int(-f[0] / f[1]) for f, _ in minimal.factor()[1] if f.degree() == 1]
    first = min(roots)
    found = [2 % p, first]
    while len(found) < order:
        found.append((first * found[-1] - found[-2]) % p)
    return tuple(found[:order])


def _primes_for(order: int) -> Iterator[int]:
    """The largest primes that leave 1 or -1 modulo a number."""
    top = LARGEST_PRIME // order * order
    for i in range(MOST_TRIES):
        for p in (top - i * order + 1, top - i * order - 1):
            if p < LARGEST_PRIME and flint.fmpz(p).is_prime():
                yield p
