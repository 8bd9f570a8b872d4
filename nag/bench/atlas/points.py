"""Families of systems with finitely many zeros, all known, and a knob that makes them hard."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from fractions import Fraction
from functools import reduce
from math import isqrt
from operator import mul
from typing import Any

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.changes import NAMES, combine_equations, hide_equations
from nag.bench.atlas.nine_points import NinePoints
from nag.bench.verdicts import METHODS, Components, ZeroSet
from nag.witness.witness import Slice


@dataclass(frozen=True)
class KnownProblem:
    """A system and all components of its zero set.

    Attributes:
        facts: what else is known, in words, with how often it is so.
        slice: one that meets the component of the largest degree.
        family: nine points and the family by which they are solved.
    """

    system: PolynomialSystem
    truth: Components
    methods: tuple[str, ...] = METHODS
    symmetries: tuple[SignedPermutation, ...] = ()
    facts: Counter[str] = field(default_factory=Counter)
    slice: Slice | None = None
    family: NinePoints | None = None

    @property
    def zero_set(self) -> ZeroSet:
        """What is known of the zero set."""
        return ZeroSet.of(self.truth, self.facts)


def points(*numbers: tuple[int, int]) -> Components:
    """Isolated zeros only: pairs of a multiplicity and how many there are of it."""
    return Counter({(0, 1, multiplicity): count for multiplicity, count in numbers if count})


def plain(*equations: Polynomial) -> PolynomialSystem:
    return PolynomialSystem(NAMES[: equations[0].n], equations)


def _tenth(k: int) -> Fraction:
    return Fraction(1, 10**k)


def power(k: int, rng: np.random.Generator) -> KnownProblem:
    """x^k."""
    (x,) = Polynomial.variables(1)
    return KnownProblem(plain(x**k), points((k, 1)))


def power_beside(k: int, rng: np.random.Generator) -> KnownProblem:
    """(x - 1)^k (x + 1)."""
    (x,) = Polynomial.variables(1)
    return KnownProblem(plain((x - 1) ** k * (x + 1)), points((k, 1), (1, 1)))


def power_on_circle(k: int, rng: np.random.Generator) -> KnownProblem:
    """The k-th power of a line meets a circle in two points."""
    x, y = Polynomial.variables(2)
    return KnownProblem(plain((x - y) ** k, x**2 + y**2 - 2), points((k, 2)))


def factors(k: int, rng: np.random.Generator) -> KnownProblem:
    """(x - 1) ... (x - k)."""
    (x,) = Polynomial.variables(1)
    return KnownProblem(plain(reduce(mul, (x - j for j in range(1, k + 1)))), points((1, k)))


def unity(k: int, rng: np.random.Generator) -> KnownProblem:
    """x^k - 1."""
    (x,) = Polynomial.variables(1)
    return KnownProblem(plain(x**k - 1), points((1, k)))


def _over(first: Polynomial, n: int) -> list[Polynomial]:
    """``first`` = 0 in the first variable, over each root of which the others have two values.

    They are u_j^2 = u_1 + 2 + j, so -2 - j must be no root.
    """
    u = Polynomial.variables(n)
    return [first.compose([u[0]]), *(u[j] ** 2 - u[0] - 2 - j for j in range(1, n))]


def cluster(value: tuple[int, int, int], rng: np.random.Generator) -> KnownProblem:
    """In n variables, m zeros at distances of 10^-k, twice for each variable after the first."""
    n, m, k = value
    (t,) = Polynomial.variables(1)
    first = t**m * (t**2 + t + 5) - 2 * _tenth(k * m)
    return KnownProblem(hide_equations(_over(first, n), rng), points((1, (m + 2) * 2 ** (n - 1))))


def multiple(value: tuple[int, int], rng: np.random.Generator) -> KnownProblem:
    """What clusters of m become when they have come together."""
    n, m = value
    (t,) = Polynomial.variables(1)
    first, count = t**m * (t**2 + t + 5), 2 ** (n - 1)
    return KnownProblem(hide_equations(_over(first, n), rng), points((m, count), (1, 2 * count)))


def far(value: tuple[int, int], rng: np.random.Generator) -> KnownProblem:
    """10^-k u^4 + u - 1 in n coupled variables: one zero of size 1, the others far out."""
    n, k = value
    u = Polynomial.variables(n)
    chain = [_tenth(k) * u[j] ** 4 + u[j] - 1 + (u[j - 1] if j else 0) for j in range(n)]
    return KnownProblem(hide_equations(chain, rng), points((1, 4**n)))


def far_beside(k: int, rng: np.random.Generator) -> KnownProblem:
    """Two zeros of size 1, ten of size 10^(k/2) or so, of 12 by Bezout's number."""
    x, y = Polynomial.variables(2)
    small = _tenth(k)
    f, g = x * y - 1 + small * (x**3 + y**3), x**2 * y - 2 * x + 3 * y + small * x**4
    return KnownProblem(plain(f, g), points((1, 12)))


def far_cluster(value: tuple[int, int, int], rng: np.random.Generator) -> KnownProblem:
    """Around 10^k, in n variables, two zeros at a relative distance of 10^-j, and two others."""
    n, k, j = value
    (x,) = Polynomial.variables(1)
    t = _tenth(k) * x - 1
    first = t**2 * (t**2 + t + 5) - 2 * _tenth(2 * j)
    return KnownProblem(hide_equations(_over(first, n), rng), points((1, 4 * 2 ** (n - 1))))


def nearly_dependent(value: tuple[int, int], rng: np.random.Generator) -> KnownProblem:
    """Two conics, the leading forms of which agree to 10^-k: distinct (1) or a square (2)."""
    kind, k = value
    x, y = Polynomial.variables(2)
    top = (x - y) * (x + 2 * y) if kind == 1 else (x - y) ** 2
    f = top + 2 * x + 3 * y - 1
    g = top + _tenth(k) * (x**2 - 3 * x * y + 5 * y**2) - x + 2 * y + 4
    return KnownProblem(hide_equations([f, g], rng), points((1, 4)))


def rounded(k: int, rng: np.random.Generator) -> KnownProblem:
    """A line that would touch a circle, were the square root of 2 not cut off after k digits.

    Two pairs of zeros at distances of 10^(-k/2).
    """
    x, y, z = Polynomial.variables(3)
    root = Fraction(isqrt(2 * 10 ** (2 * k)), 10**k)
    return KnownProblem(
        hide_equations([x**2 + y**2 - 1, x + y - root, z**2 - x - 3], rng), points((1, 4))
    )


def to_infinity(k: int, rng: np.random.Generator) -> KnownProblem:
    """Two curves of degree k that touch at infinity to order k^2 - 1, and meet in one point.

    Over it a third variable has two values; all other paths run to infinity.
    """
    x, y, z = Polynomial.variables(3)
    return KnownProblem(
        hide_equations([y - x**k - x, y - x**k - 2, z**2 - x - y - 3], rng),
        points((1, 2)),
        ("solve",),
    )


def nearly_tangent(k: int, rng: np.random.Generator) -> KnownProblem:
    """A line cuts a circle in points at a distance of 10^(-k/2) or so; two for each in space."""
    x, y, z = Polynomial.variables(3)
    cut = y - 1 + _tenth(k)
    return KnownProblem(hide_equations([x**2 + y**2 - 1, cut, z**2 - x - 3], rng), points((1, 4)))


def osculating(k: int, rng: np.random.Generator) -> KnownProblem:
    """A circle and a curve touch to order k at one point, and cut at another if k is odd.

    The curve is f q + y^a x^b; on the circle x and y have orders 1 and 2 at the origin.
    """
    x, y = Polynomial.variables(2)
    a, b = divmod(k, 2)
    circle = x**2 + y**2 - 2 * y
    weights = [int(w) for w in rng.integers(1, 6, 2)]
    factor = weights[0] * x - weights[1] * y + 3 if a + b > 2 else circle * 0 + 3
    curve = circle * factor + y**a * x**b
    return KnownProblem(hide_equations([circle, curve], rng), points((k, 1), (b, b)))


def grid(value: tuple[int, ...], rng: np.random.Generator) -> KnownProblem:
    """Three values of each variable, of sizes 10 to these powers."""
    x = Polynomial.variables(len(value))
    sized = [v * Fraction(10) ** -e for v, e in zip(x, value, strict=True)]
    equations = [(v - 1) * (v - 2) * (v + 3) for v in sized]
    return KnownProblem(plain(*combine_equations(equations, rng)), points((1, 3 ** len(value))))


def given(k: int, rng: np.random.Generator) -> KnownProblem:
    """Systems met before, each for one way of going wrong."""
    x, y = Polynomial.variables(2)
    swap = SignedPermutation((1, 0), (1, 1))
    return (
        KnownProblem(
            plain(
                -2 * x * y**3 - 2 * x**2 + 3 * y - Fraction(1, 500),
                -2 * y - Fraction(3, 10**5) * y**4,
            ),
            points((1, 8)),
        ),
        KnownProblem(plain(x * y + x**3 + y**3, x**2 + y**3 * _tenth(6)), points((5, 1), (1, 4))),
        KnownProblem(
            plain(x**2 + y**2 - 10**12, x - y), points((1, 2)), ("decompose",), symmetries=(swap,)
        ),
        KnownProblem(plain((x - 1) * (x - 1 - _tenth(6)), y - x), points((1, 2))),
    )[k]


DIGITS = (4, 6, 8, 10, 12, 15, 20, 25)

FAMILIES: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "power": (power, (2, 5, 12, 13, 20, 50, 100, 200)),
    "power_beside": (power_beside, (2, 5, 12, 13, 20, 50, 100, 200)),
    "power_on_circle": (power_on_circle, (2, 5, 12, 13, 20, 50)),
    "factors": (factors, (5, 10, 15, 20, 25, 30)),
    "unity": (unity, (10, 20, 40, 60)),
    "cluster": (cluster, tuple((n, m, k) for n in (1, 2, 3) for m in (2, 3) for k in DIGITS)),
    "multiple": (multiple, tuple((n, m) for n in (1, 2, 3) for m in (2, 3, 5))),
    "far": (far, tuple((n, k) for n in (1, 2, 3) for k in (3, 6, 9, 12, 15, 20, 25))),
    "far_beside": (far_beside, (3, 6, 9, 12, 15, 20, 25)),
    "far_cluster": (far_cluster, tuple((n, k, j) for n in (1, 2) for k in (4, 9) for j in DIGITS)),
    "nearly_dependent": (nearly_dependent, tuple((c, k) for c in (1, 2) for k in DIGITS)),
    "rounded": (rounded, (8, 12, 16, 24, 32, 48)),
    "to_infinity": (to_infinity, (2, 3, 4, 5, 6)),
    "nearly_tangent": (nearly_tangent, DIGITS),
    "osculating": (osculating, tuple(range(2, 13))),
    "grid": (grid, ((-8,), (8,), (-8, 8), (-8, -8), (8, 8), (0, 8), (-4, 4), (-8, 0, 8))),
    "given": (given, (0, 1, 2, 3)),
}
