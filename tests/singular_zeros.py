"""Singular zeros whose place and multiplicity are known, and exact changes of coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from nag.algebra.expression import parse_polynomial
from nag.algebra.factoring import ring
from nag.algebra.polynomial import Polynomial

ROOT2 = 2**0.5


def polynomials(variables: str, *equations: str) -> list[Polynomial]:
    names = variables.split()
    return [parse_polynomial(e, names) for e in equations]


@dataclass(frozen=True, eq=False)
class Zero:
    """A zero and its multiplicity; 0 if it lies on a component of positive dimension."""

    polynomials: list[Polynomial]
    point: np.ndarray
    multiplicity: int

    @classmethod
    def of(cls, variables: str, equations: str, point: Sequence[float], multiplicity: int) -> Zero:
        system = polynomials(variables, *equations.split(", "))
        return cls(system, np.array(point, dtype=complex), multiplicity)

    def beside(self, error: float, rng: np.random.Generator) -> np.ndarray:
        """A point at that distance, relative to the size of the zero or to one."""
        n = len(self.point)
        direction = rng.normal(size=n) + 1j * rng.normal(size=n)
        size = max(1.0, float(np.abs(self.point).max()))
        return self.point + error * size * direction / np.abs(direction).max()

    def changed(self, rng: np.random.Generator) -> Zero:
        """The same zero in other coordinates, of combined equations; all of it exact."""
        n, m = len(self.point), len(self.polynomials)
        mix, combine = _regular(rng, n, 9), _regular(rng, m, 5)
        equations = _mix_equations(self.polynomials, mix, combine)
        return Zero(equations, np.linalg.solve(mix / 4, self.point), self.multiplicity)


def _mix_equations(
    polynomials: Sequence[Polynomial], mix: np.ndarray, combine: np.ndarray
) -> list[Polynomial]:
    """Combinations of polynomials with combinations of variables, over 4, put in."""
    n = polynomials[0].n
    if not all(isinstance(c, Fraction) for f in polynomials for c in f.terms.values()):
        images = [_combination(Polynomial.variables(n), row) / 4 for row in mix]
        moved = [f.compose(images) for f in polynomials]
        return [_combination(moved, row) for row in combine]
    there = ring(n)
    x = there.context.gens()
    forms = [sum(int(w) * v for w, v in zip(row, x, strict=True)) / 4 for row in mix]
    composed = [there.of(f).compose(*forms, ctx=there.context) for f in polynomials]
    return [
        there.polynomial(sum(int(w) * f for w, f in zip(row, composed, strict=True)))
        for row in combine
    ]


def _regular(rng: np.random.Generator, n: int, largest: int) -> np.ndarray:
    while True:
        matrix = rng.integers(-largest, largest + 1, (n, n))
        if abs(np.linalg.det(matrix)) > 0.5:
            return matrix


def _combination(parts: Sequence[Polynomial], weights: np.ndarray) -> Polynomial:
    total = Polynomial(parts[0].n, {})
    for f, weight in zip(parts, weights, strict=True):
        total = total + f * Fraction(int(weight))
    return total


_KSS = ", ".join(f"x{i}^2 - 2*x{i} + x1 + x2 + x3 + x4 + x5 - 4" for i in range(1, 6))
_CBMS2 = ", ".join(f"({a} - {b})^3 - {c}^2" for a, b, c in ("xyz", "zxy", "yzx"))

# Multiplicities are those of Dayton & Zeng 2005, table 1, or follow by hand.
ISOLATED = {
    "a power": Zero.of("x", "x^13", [0], 13),
    "a high power": Zero.of("x", "x^30", [0], 30),
    "touching to order 7": Zero.of("x y", "y - x^7, y", [0, 0], 7),
    "touching to order 12": Zero.of("x y", "y - x^12, y", [0, 0], 12),
    "a tangent": Zero.of("x y", "x^2 + y^2 - 1, x - 1", [1, 0], 2),
    "powers beside a circle": Zero.of(
        "x y", "(x^2 + y^2 - 1)*(x - 2)^5, (x^2 + y^2 - 1)*(y - 3)^4", [2, 3], 20
    ),
    "powers of both": Zero.of("x y", "x^5, y^5", [0, 0], 25),
    "two curves of order 40": Zero.of("x y", "x*y, x^40 + y^40", [0, 0], 80),
    "DZ1": Zero.of("a b c d", "a^4 - b*c*d, b^4 - a*c*d, c^4 - a*b*d, d^4 - a*b*c", [0] * 4, 131),
    "DZ2": Zero.of("x y z", "x^4, x^2*y + y^4, z + z^2 - 7*x^3 - 8*x^2", [0, 0, -1], 16),
    "cbms1": Zero.of("x y z", "x^3 - y*z, y^3 - x*z, z^3 - x*y", [0] * 3, 11),
    "cbms2": Zero.of("x y z", _CBMS2, [0] * 3, 8),
    "KSS5": Zero.of("x1 x2 x3 x4 x5", _KSS, [1] * 5, 16),
    "mth191": Zero.of(
        "x y z", "x^3 + y^2 + z^2 - 1, x^2 + y^3 + z^2 - 1, x^2 + y^2 + z^3 - 1", [0, 1, 0], 4
    ),
    "decker2": Zero.of("x y", "x + y^3, x^2*y - y^4", [0, 0], 4),
    "Griewank-Osborne": Zero.of("x y", "29/16*x^3 - 2*x*y, y - x^2", [0, 0], 3),
    "Ojika 1": Zero.of("x y", "x^2 + y - 3, x + 1/8*y^2 - 3/2", [1, 2], 3),
    "Ojika 2": Zero.of("x y z", "x^2 + y + z - 1, x + y^2 + z - 1, x + y + z^2 - 1", [0, 0, 1], 2),
    # With s = z - 1: s^2 = 0 and s (5 + 10 x) + x^2 (5 + 2 x) = 0, so x^4 (5 + 2 x)^2 = 0.
    "Ojika 3": Zero.of(
        "x y z",
        "x + y + z - 1, 2*x^3 + 5*y^2 - 10*z + 5*z^3 + 5, 2*x + 2*y + z^2 - 1",
        [0, 0, 1],
        4,
    ),
    "Ojika 3, the other": Zero.of(
        "x y z",
        "x + y + z - 1, 2*x^3 + 5*y^2 - 10*z + 5*z^3 + 5, 2*x + 2*y + z^2 - 1",
        [-2.5, 2.5, 1],
        2,
    ),
    "an irrational point": Zero.of("x y", "x^2 - 2, (y - x)^3", [ROOT2] * 2, 3),
    "an irrational point of corank 2": Zero.of(
        "x y z", "x^2 - 2, (y - x)^2, (z - x)^3 + (y - x)*(z - x)", [ROOT2] * 3, 6
    ),
    # Two bars stretched to the distance of their pivots, and a third of length zero beside them.
    "a shaky structure": Zero.of(
        "x y z w",
        "x^2 + y^2 - 1, (z - 2)^2 + w^2 - 1, (x - z)^2 + (y - w)^2, y - w",
        [1, 0, 1, 0],
        4,
    ),
}

ON_COMPONENTS = {
    "Whitney's umbrella": Zero.of("x y z", "x^2 - y^2*z", [0] * 3, 0),
    "an umbrella's handle and a line": Zero.of(
        "x y z", "x^2 - y^2*z, y*(x - z), x*(x - z)", [0] * 3, 0
    ),
    "two lines": Zero.of("x y z", "x*y, z", [0] * 3, 0),
    "three lines": Zero.of("x y z", "x*y, y*z, x*z", [0] * 3, 0),
    "lines through an irrational point": Zero.of(
        "x y z", "x^2 - 2, (y - x)*(z - x), (y - x)*(y + z)", [ROOT2] * 3, 0
    ),
    "a line that meets a curve, an equation that says nothing": Zero.of(
        "x y z",
        "y - x^2, (z - x^3)*(2*y - 1), (y - x^2)*(z - x^3)",
        [ROOT2 / 2, 0.5, ROOT2 / 4],
        0,
    ),
    "a circle": Zero.of("x y", "x^2 + y^2 - 1", [0.6, 0.8], 0),
    "a triple circle": Zero.of("x y", "(x^2 + y^2 - 1)^3", [0.6, 0.8], 0),
    "a triple circle, of two equations": Zero.of(
        "x y", "(x^2 + y^2 - 1)^3*(x - 2), (x^2 + y^2 - 1)^3*(y - 2)", [0.6, 0.8], 0
    ),
    "an embedded point": Zero.of("x y", "x^2, x*y", [0, 0], 0),
    "a plane with an embedded point": Zero.of("x y z", "x^2, x*y, x*z - y^2*x", [0] * 3, 0),
    "a cusp in a plane": Zero.of("x y z", "y^2 - x^3, z*x, z*y", [0] * 3, 0),
    "multiple lines": Zero.of("x y z", "x^2*y^3, z^2", [0] * 3, 0),
}
