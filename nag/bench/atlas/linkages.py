"""Families of linkages, with a knob that leads to where they begin or cease to move."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.asked import SINGULAR
from nag.bench.atlas.points import KnownProblem
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.model import model

Vector = tuple[Fraction, ...]
ONLY = ("decompose",)


def _loop(points: Sequence[Sequence], axes: Sequence[Sequence]) -> Mechanism:
    """A single loop of revolute joints through these points, with these axes."""
    n = len(points)
    joints = [
        Joint(f"J{i}", "revolute", (f"B{(i - 1) % n}", f"B{i}"), _exact(p), _exact(a))
        for i, (p, a) in enumerate(zip(points, axes, strict=True))
    ]
    return Mechanism("B0", tuple(joints))


def _exact(values: Sequence) -> Vector:
    return tuple(Fraction(v) for v in values)


def _bennett() -> tuple[list[list[Fraction]], list[list[Fraction]]]:
    """Points and axes of a Bennett mechanism (Tuomela 2025, lemmas 5.1 and 5.3)."""
    a, b, c = Fraction(7, 4), Fraction(5, 6), Fraction(1, 3)
    q = a**2 * (c - 1) ** 2 + (c + 1) ** 2
    n0, n1, n2 = a**2 + 1, b**2 + 1, b**2 + c**2
    r = n0 * (1 - c**2) / q
    points = [
        [0, 0, 0],
        [1, 0, 0],
        [1 + r * (b**2 - 1) / n1, 2 * r * b * (a**2 - 1) / (n0 * n1), 4 * r * a * b / (n0 * n1)],
        [r * (b**2 - c**2) / n2, 2 * r * b * c / n2, 0],
    ]
    # Each axis is orthogonal to the links on both sides of it.
    axes = []
    for i in range(4):
        before, after = (
            [u - v for u, v in zip(points[j], points[i], strict=True)]
            for j in ((i - 1) % 4, (i + 1) % 4)
        )
        axes.append(_cross(before, after))
    return [list(_exact(p)) for p in points], axes


def _cross(a: Sequence[Fraction], b: Sequence[Fraction]) -> list[Fraction]:
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def bennett_violated(k: int, rng: np.random.Generator) -> KnownProblem:
    """Bennett's mechanism with one joint moved by 10^-k, so that it is rigid; 0: not moved.

    Its closure equations are bilinear in two half-angles. Where they have rank 1 they are one
    curve of degree 2; here they have rank 3, and one zero, which is simple.
    """
    points, axes = _bennett()
    if k:
        points[2] = [p + s * Fraction(1, 10**k) for p, s in zip(points[2], (1, -1, 2), strict=True)]
    found = model(_loop(points, axes), "H").system
    return KnownProblem(found, Counter({(0, 1, 1): 1} if k else {(1, 2, 1): 1}), ONLY)


def bricard_violated(k: int, rng: np.random.Generator) -> KnownProblem:
    """Bricard's cube with one joint moved by 10^-k, so that it is rigid; 0: not moved.

    In six configurations: for k = 2, 4 and 6 Krawczyk's test proves 16 simple zeros, of 24 at
    most, and that nothing that must not vanish does so at six of them; at the others it does to
    rounding.
    """
    points = [[0, 0, 1], [1, 0, 1], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1]]
    axes = [[0, 0, 1], [0, 1, 0], [1, 0, 0], [0, 0, 1], [0, 1, 0], [1, 0, 0]]
    if k:
        points[3] = [1 + Fraction(1, 10**k), 1 - Fraction(2, 10**k), 0]
    found = model(_loop(points, axes), "H").system
    return KnownProblem(found, Counter({(0, 1, 1): 6} if k else {(1, 8, 1): 1}), ONLY)


def bennett_scaled(k: int, rng: np.random.Generator) -> KnownProblem:
    """Bennett's mechanism, 10^k times as large."""
    points, axes = _bennett()
    points = [[p * Fraction(10) ** k for p in point] for point in points]
    return KnownProblem(model(_loop(points, axes), "H").system, Counter({(1, 2, 1): 1}), ONLY)


def _four_bar(a: Fraction, b: Fraction, c: Fraction, d: Fraction) -> PolynomialSystem:
    """Closure of a planar four-bar: d - a e1 - b e2 + c e3 = 0 for unit vectors e1, e2, e3."""
    names = ("c1", "s1", "c2", "s2", "c3", "s3")
    v = Polynomial.variables(6)
    rows = [v[0] * -a - v[2] * b + v[4] * c + d, v[1] * -a - v[3] * b + v[5] * c]
    rows += [v[i] ** 2 + v[i + 1] ** 2 - 1 for i in (0, 2, 4)]
    return PolynomialSystem(names, rows)


def parallelogram(k: int, rng: np.random.Generator) -> KnownProblem:
    """A parallelogram, two bars of which are 10^k times as long as the others."""
    a, b = Fraction(10) ** k, Fraction(1)
    truth = Counter({(1, 2, 1): 1, (1, 4, 1): 1})
    return KnownProblem(_four_bar(a, b, a, b), truth, ONLY)


def kite(k: int, rng: np.random.Generator) -> KnownProblem:
    """A kite at 10^-k from a rhombus: two bars fold onto each other, or none do; 0: a rhombus."""
    one, other = Fraction(1), 1 + (Fraction(1, 10**k) if k else 0)
    truth = Counter({(1, 2, 1): 1, (1, 4, 1): 1} if k else {(1, 2, 1): 3})
    return KnownProblem(_four_bar(other, one, one, other), truth, ONLY)


def slider_crank(k: int, rng: np.random.Generator) -> KnownProblem:
    """Slider cranks of lengths b + c + 10^-k, b and c; 0: of lengths b + c, b and c.

    A point is singular where all three bars stand upright; these lengths then close exactly if
    the first is the sum of the others, in two such points, nodes of the surface.
    """
    v = Polynomial.variables(6)
    b, c = (Fraction(int(n), 7) for n in rng.integers(3, 22, 2))
    a = b + c + (Fraction(1, 10**k) if k else 0)
    rows = [v[1] * a + v[3] * b + v[5] * c]
    rows += [v[i] ** 2 + v[i + 1] ** 2 - 1 for i in (0, 2, 4)]
    system = PolynomialSystem(("c1", "s1", "c2", "s2", "c3", "s3"), rows)
    facts = Counter({} if k else {SINGULAR.format(2, 3, 2): 2})
    return KnownProblem(system, Counter({(2, 8, 1): 1}), ("singular",), facts=facts)
