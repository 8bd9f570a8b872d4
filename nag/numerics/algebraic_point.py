"""Points and equations in square roots, modulo primes in which those roots exist.

A number field is mapped into the field of a prime that splits its polynomial; what is a unit or a
rank there is one over the numbers, and what vanishes over the numbers vanishes there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice

from nag.algebra.exact_ranks import LARGEST_PRIME, MOST_PRIMES, PrimeField, primes_below
from nag.algebra.number import Irrational, Number
from nag.algebra.polynomial import sum_terms
from nag.numerics.exact_system import ExactSystem
from nag.numerics.power_series import Terms


class _NoImage(Exception):
    """A number that has no image modulo any prime, as far as is known."""


class _OtherPrime(Exception):
    """A number that has no image modulo this prime."""


@dataclass(frozen=True, eq=False)
class PrimeImage:
    """Exact equations and a point that they vanish at, modulo a prime.

    Attributes:
        modulus: the prime.
        rows: of the system.
        centre: the point.
    """

    modulus: int
    rows: tuple[Terms, ...]
    centre: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class _Images:
    modulus: int

    def of(self, c: Number | int) -> int:
        p = self.modulus
        if not isinstance(c, Irrational):
            try:
                return PrimeField(p).of(c)
            except ArithmeticError as error:
                raise _OtherPrime(str(error)) from None
        if c.operation == "sqrt":
            return self._root(c.arguments[0])
        if c.operation not in ("+", "*", "/", "neg", "exact"):
            raise _NoImage(f"{c.operation} is not algebraic")
        values = [self.of(a) for a in c.arguments]
        if c.operation == "exact":
            return values[0]
        if c.operation == "neg":
            return -values[0] % p
        if c.operation == "/":
            if not values[1]:
                raise _OtherPrime("division by zero")
            return values[0] * pow(values[1], -1, p) % p
        return (values[0] + values[1] if c.operation == "+" else values[0] * values[1]) % p

    def _root(self, radicand: Number) -> int:
        if isinstance(radicand, Fraction):
            raise _NoImage("a radicand has too large factors")
        try:
            return PrimeField(self.modulus).root(self.of(radicand))
        except ArithmeticError as error:
            raise _OtherPrime(str(error)) from None


def prime_images(system: ExactSystem, point: Sequence[Number], count: int) -> list[PrimeImage]:
    """The system and an exact zero of it modulo so many primes; none where it has no such images.

    Args:
        point: in the system's scaled variables.
    """
    found: list[PrimeImage] = []
    for p in islice(primes_below(LARGEST_PRIME), MOST_PRIMES):
        if len(found) == count:
            break
        images = _Images(p)
        try:
            centre = tuple(images.of(c) for c in point)
            rows = tuple([(e, images.of(c)) for e, c in row] for row in system.rows)
        except _OtherPrime:
            continue
        except _NoImage:
            return []
        if any(sum_terms(row, centre) % p for row in rows):
            # Nested roots may have been chosen so that they do not belong together.
            continue
        found.append(PrimeImage(p, rows, centre))
    return found if len(found) == count else []
