"""Points and equations in square roots, modulo primes in which those roots exist.

A number field is mapped into the field of a prime that splits its polynomial; what is a unit or a
rank there is one over the numbers, and what vanishes over the numbers vanishes there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import islice
from typing import Any

import flint

from nag.algebra.exact_ranks import LARGEST_PRIME, PrimeField, primes_below
from nag.algebra.number import Irrational, Number
from nag.algebra.polynomial import sum_terms
from nag.numerics.exact_system import ExactSystem
from nag.numerics.power_series import Terms

# How many primes are tried; half of them lack any one square root.
MOST_PRIMES = 4000
# Radicands are taken apart into primes, so that sqrt(2) sqrt(3) = sqrt(6); larger ones are not.
LARGEST_RADICAND = 10**24


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
    roots: dict[Any, int] = field(default_factory=dict)

    def of(self, c: Number | int) -> int:
        p = self.modulus
        if not isinstance(c, Irrational):
            try:
                return PrimeField(p).of(c)
            except ZeroDivisionError as error:
                raise _OtherPrime(str(error)) from None
        if c.operation == "sqrt":
            return self._root(c.arguments[0])
        if c.operation not in ("+", "*", "/", "neg"):
            raise _NoImage(f"{c.operation} is not algebraic")
        values = [self.of(a) for a in c.arguments]
        if c.operation == "neg":
            return -values[0] % p
        if c.operation == "/":
            if not values[1]:
                raise _OtherPrime("division by zero")
            return values[0] * pow(values[1], -1, p) % p
        return (values[0] + values[1] if c.operation == "+" else values[0] * values[1]) % p

    def _root(self, radicand: Number) -> int:
        p = self.modulus
        if isinstance(radicand, Irrational):
            return self._of_square(self.of(radicand))
        whole = radicand.numerator * radicand.denominator
        if abs(whole) > LARGEST_RADICAND:
            raise _NoImage("a radicand is too large")
        root = pow(radicand.denominator, -1, p)
        for q, k in flint.fmpz(whole).factor() if whole else ():
            root = root * pow(self._of_square(int(q)), int(k), p) % p
        return root if whole else 0

    def _of_square(self, a: int) -> int:
        if a not in self.roots:
            # The primes are 3 modulo 4.
            root = pow(a, (self.modulus + 1) // 4, self.modulus)
            if root * root % self.modulus != a % self.modulus:
                raise _OtherPrime("a square root does not exist")
            self.roots[a] = root
        return self.roots[a]


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
