"""Random small sparse systems of polynomials, some of them degenerate on purpose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product

import numpy as np
from numpy.random import Generator

from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.changes import FAR_COORDINATES, NAMES, in_far_coordinates

Equations = Sequence[Polynomial]

UNKNOWNS, UNKNOWNS_ODDS = (2, 3, 4), (0.5, 0.3, 0.2)
DEGREES = (2, 3, 4, 5)
LARGEST_DEGREES = 120
# Powers of ten by which coefficients differ.
SPREADS = (0, 2, 5)
DEGENERATE_ODDS = 0.1
# Powers of ten by which coordinates lie away from a system's own ones, up to this.
DECADES, DENSE_DECADES = 6, 3


@dataclass(frozen=True)
class Small:
    """A system, and what was done to it: ``"general"`` or a name of `DEGENERATIONS`."""

    kind: str
    system: PolynomialSystem


def small_system(seed: int, number: int) -> Small:
    """The system of this number; it depends on nothing else."""
    rng = np.random.default_rng([seed, number, 20])
    n = int(rng.choice(UNKNOWNS, p=UNKNOWNS_ODDS))
    while True:
        degrees = [int(d) for d in rng.choice(DEGREES, n)]
        if np.prod(degrees) <= LARGEST_DEGREES:
            break
    spread = int(rng.choice(SPREADS))
    equations = [sparse(n, d, spread, rng) for d in degrees]
    kind = "general"
    if rng.random() < DEGENERATE_ODDS:
        kind = str(rng.choice(list(DEGENERATIONS)))
        equations = DEGENERATIONS[kind](equations, degrees, spread, rng)
    return Small(kind, PolynomialSystem(NAMES[:n], tuple(equations)))


def far_coordinates(seed: int, number: int) -> tuple[str, int]:
    """One of `FAR_COORDINATES` for the system of this number, and how far they lie."""
    rng = np.random.default_rng([seed, number, 21])
    kind = str(rng.choice(FAR_COORDINATES))
    return kind, int(rng.integers((DENSE_DECADES if kind == "dense" else DECADES) + 1))


def far_system(seed: int, number: int) -> Small:
    """The system of this number in its `far_coordinates`."""
    small, (kind, decades) = small_system(seed, number), far_coordinates(seed, number)
    rng = np.random.default_rng([seed, number, 22])
    return replace(small, system=in_far_coordinates(small.system, kind, decades, rng))


def _monomials(n: int, degree: int) -> list[Exponents]:
    """The exponents of all monomials up to ``degree``."""
    return [e for e in product(range(degree + 1), repeat=n) if sum(e) <= degree]


def _coefficient(spread: int, rng: Generator) -> Fraction:
    """A number of one or two digits, or a quotient of such, times a power of ten."""
    top = int(rng.integers(1, 10) if rng.random() < 0.7 else rng.integers(1, 100))
    bottom = 1 if rng.random() < 0.8 else int(rng.integers(2, 10))
    power = int(rng.integers(-spread, spread + 1))
    return Fraction(top * int(rng.choice([-1, 1])), bottom) * Fraction(10) ** power


def sparse(n: int, degree: int, spread: int, rng: Generator) -> Polynomial:
    """A polynomial of this degree with two to six terms, often a constant among them."""
    monomials = _monomials(n, degree)
    leading = [e for e in monomials if sum(e) == degree]
    chosen = {leading[rng.integers(len(leading))]}
    for k in rng.choice(len(monomials), min(len(monomials), int(rng.integers(1, 6)))):
        chosen.add(monomials[k])
    if rng.random() < 0.6:
        chosen.add((0,) * n)
    if len(chosen) == 1:
        chosen.add((0,) * n)
    return Polynomial(n, {e: _coefficient(spread, rng) for e in sorted(chosen)})


def _linear(n: int, spread: int, rng: Generator) -> Polynomial:
    x = Polynomial.variables(n)
    chosen = rng.choice(n, 2, replace=False)
    constant = Polynomial.constant(n, _coefficient(spread, rng))
    return sum((_coefficient(spread, rng) * x[i] for i in chosen), start=constant)


def _lower(n: int, degree: int, spread: int, rng: Generator) -> Polynomial:
    return sparse(n, max(1, degree), spread, rng)


def repeated_factor(
    equations: Equations, degrees: Sequence[int], spread: int, rng: Generator
) -> list[Polynomial]:
    """One equation has the square of a linear form as a factor."""
    n, k = len(equations), int(rng.integers(len(equations)))
    form = _linear(n, spread, rng)
    other = _lower(n, degrees[k] - 2, spread, rng) if degrees[k] > 2 else 1
    return [*equations[:k], form * form * other, *equations[k + 1 :]]


def common_factor(
    equations: Equations, degrees: Sequence[int], spread: int, rng: Generator
) -> list[Polynomial]:
    """Two equations have a linear factor in common."""
    n = len(equations)
    i, j = (int(k) for k in rng.choice(n, 2, replace=False))
    form, result = _linear(n, spread, rng), list(equations)
    for k in (i, j):
        result[k] = form * _lower(n, degrees[k] - 1, spread, rng)
    return result


def double_point(
    equations: Equations, degrees: Sequence[int], spread: int, rng: Generator
) -> list[Polynomial]:
    """At a rational point all equations vanish and two gradients are parallel."""
    n = len(equations)
    point = [_coefficient(0, rng) for _ in range(n)]
    x = Polynomial.variables(n)
    result = [f - f(point) for f in equations]
    slope = [_coefficient(0, rng) for _ in range(n)]
    for k in range(2):
        weight = _coefficient(0, rng)
        for i in range(n):
            wrong = weight * slope[i] - result[k].derivative(i)(point)
            result[k] = result[k] + wrong * (x[i] - point[i])
    return result


def curve_of_solutions(
    equations: Equations, degrees: Sequence[int], spread: int, rng: Generator
) -> list[Polynomial]:
    """All equations are combinations of one polynomial fewer than there are unknowns."""
    n = len(equations)
    generators = [_linear(n, spread, rng), *(sparse(n, 2, spread, rng) for _ in range(n - 2))]
    result = []
    for k in range(n):
        total = equations[k] * 0
        for g in generators:
            total = total + g * _lower(n, degrees[k] - g.degree, spread, rng)
        result.append(total)
    return result


def missing_constants(
    equations: Equations, degrees: Sequence[int], spread: int, rng: Generator
) -> list[Polynomial]:
    """The origin is a zero."""
    return [f - f((0,) * f.n) for f in equations]


def dependent_leading_forms(
    equations: Equations, degrees: Sequence[int], spread: int, rng: Generator
) -> list[Polynomial]:
    """The leading form of one equation is a multiple of that of another: zeros at infinity."""
    n = len(equations)
    low, high = sorted((int(k) for k in rng.choice(n, 2, replace=False)), key=lambda k: degrees[k])
    top = Polynomial(n, {e: c for e, c in equations[low].terms.items() if sum(e) == degrees[low]})
    rest = {e: c for e, c in equations[high].terms.items() if sum(e) < degrees[high]}
    gap = [0] * n
    gap[int(rng.integers(n))] = degrees[high] - degrees[low]
    result = list(equations)
    factor = Polynomial(n, {tuple(gap): _coefficient(spread, rng)})
    result[high] = factor * top + Polynomial(n, rest) + _linear(n, spread, rng)
    return result


DEGENERATIONS = {
    make.__name__: make
    for make in (
        repeated_factor,
        common_factor,
        double_point,
        curve_of_solutions,
        missing_constants,
        dependent_leading_forms,
    )
}
