"""Families of curves and surfaces, all components known, and a knob that makes them hard."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from functools import reduce
from itertools import product
from math import comb
from operator import mul
from typing import Any

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.bench.atlas.asked import MET, NOT_SIMPLE
from nag.bench.atlas.changes import combine_equations, hide_equations
from nag.bench.atlas.points import KnownProblem, plain
from nag.bench.verdicts import Components
from nag.witness.witness import Slice

ONLY = ("decompose",)


def _curves(*kinds: tuple[int, int]) -> Components:
    """Simple curves: pairs of a degree and how many there are of it."""
    return Counter({(1, degree, 1): count for degree, count in kinds})


def _union(*sets: Sequence[Polynomial]) -> list[Polynomial]:
    """All products of one generator of each; simple components where the sets are."""
    return [reduce(mul, choice) for choice in product(*sets)]


def _small(k: int) -> Fraction:
    return Fraction(1, 10**k)


def circle_power(k: int, rng: np.random.Generator) -> KnownProblem:
    """(x^2 + y^2 - 1)^k."""
    # Powers by repeated multiplication, as `Polynomial` makes them, would take long.
    terms = {
        (2 * i, 2 * j): Fraction((-1) ** (k - i - j) * comb(k, i) * comb(k - i, j))
        for i in range(k + 1)
        for j in range(k + 1 - i)
    }
    circle = Polynomial(2, terms)
    return KnownProblem(plain(circle), Counter({(1, 2, k): 1}), ONLY)


def lines(value: tuple[int, int], rng: np.random.Generator) -> KnownProblem:
    """The product of k random linear forms in n variables."""
    n, k = value
    x = Polynomial.variables(n)
    forms = [
        sum((int(c) * v for c, v in zip(rng.integers(1, 10, n), x, strict=True)), start=x[0] * 0)
        + 10 * j
        for j in range(k)
    ]
    return KnownProblem(plain(reduce(mul, forms)), Counter({(n - 1, 1, 1): k}), ONLY)


def far_circle(k: int, rng: np.random.Generator) -> KnownProblem:
    """(x - 10^k)^2 + y^2 - 1."""
    x, y = Polynomial.variables(2)
    return KnownProblem(plain((x - 10**k) ** 2 + y**2 - 1), _curves((2, 1)), ONLY)


def far_circle_and_line(k: int, rng: np.random.Generator) -> KnownProblem:
    """A circle at 10^k and a line beside it."""
    x, y = Polynomial.variables(2)
    circle = (x - 10**k) ** 2 + y**2 - 1
    return KnownProblem(plain(circle * (x - 10**k - 2)), _curves((2, 1), (1, 1)), ONLY)


def far_circle_in_space(k: int, rng: np.random.Generator) -> KnownProblem:
    """A circle at 10^k and a line, in space, by the generators of their intersection."""
    x, y, z = Polynomial.variables(3)
    circle = [(x - 10**k) ** 2 + y**2 - 1, z - 3]
    line = [x - y - 10**k - 5, y - 2 * z + 1]
    return KnownProblem(hide_equations(_union(circle, line), rng), _curves((2, 1), (1, 1)), ONLY)


def far_skew_lines(k: int, rng: np.random.Generator) -> KnownProblem:
    """Two skew lines, 10^k away and at a distance of 1."""
    x, y, z = Polynomial.variables(3)
    first, second = [x - 10**k, y - 10**k], [x - 10**k - 1, z - 10**k]
    return KnownProblem(hide_equations(_union(first, second), rng), _curves((1, 2)), ONLY)


def far_planes(k: int, rng: np.random.Generator) -> KnownProblem:
    """Two parallel planes 10^k away and a line that crosses them."""
    x, y, z = Polynomial.variables(3)
    form = x + 2 * y - z - 10**k
    planes, line = [form * (form - 1)], [x - y - 10**k, y + z - 3]
    truth = Counter({(2, 1, 1): 2, (1, 1, 1): 1})
    return KnownProblem(hide_equations(_union(planes, line), rng), truth, ONLY)


def big_circle(k: int, rng: np.random.Generator) -> KnownProblem:
    """A circle of radius 10^k, and a line that is a chord of it."""
    x, y = Polynomial.variables(2)
    circle = x**2 + y**2 - 10 ** (2 * k)
    return KnownProblem(plain(circle * (x - y - 1)), _curves((2, 1), (1, 1)), ONLY)


def close_lines(k: int, rng: np.random.Generator) -> KnownProblem:
    """Two parallel lines at a distance of 10^-k, not rational."""
    x, y = Polynomial.variables(2)
    return KnownProblem(plain((x + 2 * y - 1) ** 2 - 2 * _small(2 * k)), _curves((1, 2)), ONLY)


def sheets_apart(k: int, rng: np.random.Generator) -> KnownProblem:
    """Two ellipsoids at a distance of 10^k, and a cubic surface through both: two sextic curves."""
    x = Polynomial.variables(3)
    sheets = []
    for _ in range(2):
        centre = [Fraction(int(b), 100) * Fraction(10) ** k for b in rng.integers(-99, 100, 3)]
        y = [v - b for v, b in zip(x, centre, strict=True)]
        axes = rng.integers(1, 6, 3).tolist()
        sheets.append(sum((int(a) * v**2 for a, v in zip(axes, y, strict=True)), x[0] * 0) - 7)
    cubic = x[0] ** 3 + 2 * x[1] ** 3 - 3 * x[2] ** 3
    for v, c in zip(x, rng.integers(1, 9, 3).tolist(), strict=True):
        cubic = cubic + v * int(c)
    return KnownProblem(plain(sheets[0] * sheets[1], cubic - 1), Counter({(1, 6, 1): 2}))


def close_circles(k: int, rng: np.random.Generator) -> KnownProblem:
    """Two concentric circles, the radii of which differ by 10^-k or so, not rational."""
    x, y = Polynomial.variables(2)
    return KnownProblem(plain((x**2 + y**2 - 1) ** 2 - 2 * _small(2 * k)), _curves((2, 2)), ONLY)


def touching_circles(k: int, rng: np.random.Generator) -> KnownProblem:
    """Two circles side by side that miss each other by 10^-k; their centres are not rational."""
    x, y = Polynomial.variables(2)
    square = 1 + _small(k)
    if k == 0:
        return KnownProblem(plain((x**2 + y**2) ** 2 - 4 * x**2), _curves((2, 2)), ONLY)
    form = (x**2 + y**2 - 1 + square) ** 2 - 4 * square * x**2
    return KnownProblem(plain(form), _curves((2, 2)), ONLY)


def close_skew_lines(k: int, rng: np.random.Generator) -> KnownProblem:
    """Two skew lines at a distance of 10^-k."""
    x, y, z = Polynomial.variables(3)
    return KnownProblem(
        hide_equations(_union([y, z], [x, z - _small(k)]), rng), _curves((1, 2)), ONLY
    )


def close_planes(k: int, rng: np.random.Generator) -> KnownProblem:
    """Two planes that meet at an angle of 10^-k, not rational, and a line."""
    x, y, z = Polynomial.variables(3)
    planes, line = [(x - 1) ** 2 - 2 * _small(2 * k) * y**2], [x + y - 3, z - y + 1]
    truth = Counter({(2, 1, 1): 2, (1, 1, 1): 1})
    return KnownProblem(hide_equations(_union(planes, line), rng), truth, ONLY)


def hyperbola(k: int, rng: np.random.Generator) -> KnownProblem:
    """x y - 10^-k."""
    x, y = Polynomial.variables(2)
    return KnownProblem(hide_equations([x * y - _small(k)], rng), _curves((2, 1)), ONLY)


def nearly_circle_and_line(k: int, rng: np.random.Generator) -> KnownProblem:
    """A cubic at 10^-k from a circle and a line."""
    x, y = Polynomial.variables(2)
    return KnownProblem(plain((x**2 + y**2 - 1) * (x - 2 * y) - _small(k)), _curves((3, 1)), ONLY)


def nearly_circles(k: int, rng: np.random.Generator) -> KnownProblem:
    """A quartic at 10^-k from two circles.

    A multiple of x instead of x^3 would leave both parts conics to the second order.
    """
    x, y = Polynomial.variables(2)
    squares = x**2 + y**2
    return KnownProblem(
        plain((squares - 1) * (squares - 4) - _small(k) * x**3), _curves((4, 1)), ONLY
    )


def nearly_planes(k: int, rng: np.random.Generator) -> KnownProblem:
    """A quadric at 10^-k from two planes."""
    x, y, z = Polynomial.variables(3)
    return KnownProblem(
        hide_equations([x * y - _small(k) * (z + 1)], rng), Counter({(2, 2, 1): 1}), ONLY
    )


def nearly_lines_in_space(k: int, rng: np.random.Generator) -> KnownProblem:
    """A hyperbola at 10^-k from two lines, in a plane of space, and a line that is skew to it."""
    x, y, z = Polynomial.variables(3)
    parts = _union([x * y - _small(k), z], [x - 3, z - y - 2])
    return KnownProblem(hide_equations(parts, rng), _curves((2, 1), (1, 1)), ONLY)


def conjugate_lines(k: int, rng: np.random.Generator) -> KnownProblem:
    """k lines through a point that only the complex numbers tell apart."""
    x, y = Polynomial.variables(2)
    return KnownProblem(hide_equations([x**k - 2 * y**k], rng), _curves((1, k)), ONLY)


def repeated_and_points(k: int, rng: np.random.Generator) -> KnownProblem:
    """A circle of multiplicity k and two points of multiplicity k off it."""
    x, y = Polynomial.variables(2)
    circle = (x**2 + y**2 - 1) ** k
    truth = Counter({(1, 2, k): 1, (0, 1, k): 2})
    return KnownProblem(plain(circle * (x - y - 3) ** k, circle * (x * y - 2)), truth)


def tangent_slice(k: int, rng: np.random.Generator) -> KnownProblem:
    """A twisted cubic and a line, and a plane that all but touches the cubic; 0: that does.

    On (s, s^2, s^3) the plane is (s^2 - e) (s - r) or s^3 - e, where e is 10^-k: at the origin
    two points, or all three, are at a distance of e^(1/2) or e^(1/3).
    """
    x, y, z = Polynomial.variables(3)
    cubic, line = [y - x**2, z - x * y, y**2 - x * z], [x - 1, y + 2 * z - 5]
    e, r = 10.0**-k if k else 0.0, complex(*rng.integers(1, 7, 2))
    plane = [-e, -r, 1] if rng.integers(2) else [0, 0, 1]
    cut = Slice(np.array([plane]), np.array([-r * e if plane[1] else e]))
    facts = Counter({MET: 3} if k else {NOT_SIMPLE: 1})
    system = plain(*combine_equations(_union(cubic, line), rng))
    return KnownProblem(system, _curves((3, 1), (1, 1)), ("slice",), facts=facts, slice=cut)


FAR = (3, 6, 9, 12, 15)
CLOSE = (4, 6, 8, 10, 12, 15, 20, 25)

FAMILIES: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "circle_power": (circle_power, (2, 5, 12, 50, 200)),
    "lines": (lines, ((2, 4), (2, 8), (2, 16), (3, 4), (3, 8), (3, 16))),
    "far_circle": (far_circle, FAR),
    "far_circle_and_line": (far_circle_and_line, FAR),
    "far_circle_in_space": (far_circle_in_space, FAR),
    "far_skew_lines": (far_skew_lines, FAR),
    "far_planes": (far_planes, FAR),
    "big_circle": (big_circle, (2, 4, 6, 8)),
    "close_lines": (close_lines, CLOSE),
    "close_circles": (close_circles, CLOSE),
    "touching_circles": (touching_circles, CLOSE),
    "close_skew_lines": (close_skew_lines, CLOSE),
    "close_planes": (close_planes, CLOSE),
    "hyperbola": (hyperbola, CLOSE),
    "nearly_circle_and_line": (nearly_circle_and_line, CLOSE),
    "nearly_circles": (nearly_circles, CLOSE),
    "nearly_planes": (nearly_planes, CLOSE),
    "nearly_lines_in_space": (nearly_lines_in_space, CLOSE),
    "conjugate_lines": (conjugate_lines, (2, 3, 5)),
    "repeated_and_points": (repeated_and_points, (1, 2, 3)),
}
