"""A hypersurface by exact algebra: its points are roots of one polynomial, and no path is tracked.

Where exact elimination leaves one equation, irreducible over the rationals, its zero set on a
generic line is the zeros of a polynomial in one variable, isolated in balls. Irreducibility over
the complex numbers is Gao's rank (`nag.algebra.factoring`). If there are several factors
they are conjugate, of equal degree; then roots belong together whose sum moves linearly with the
line, so that the sum of their second derivatives is zero, which balls of many digits show
(Sommese, Verschelde & Wampler 2002).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations
from math import comb
from typing import Any

import flint
import numpy as np

from nag.algebra.exact_ranks import null_space
from nag.algebra.factoring import factor_into_irreducibles, most_absolute_factors
from nag.algebra.number import EQUALITY_DIGITS
from nag.algebra.polynomial import Polynomial
from nag.decomposition.final_checks import (
    Examined,
    check_class,
    choose_groups,
    judge_components,
    multidegree_of,
)
from nag.decomposition.hypersurface import NEARER
from nag.decomposition.method import Task
from nag.decomposition.orbits import group_into_orbits
from nag.decomposition.reduction import Reduction
from nag.decomposition.roots import BITS, line, points_in_balls, zeros_on
from nag.decomposition.splitting import Class
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import in_bits
from nag.tracking.run import Run
from nag.witness.cutting import Cut
from nag.witness.moving import SliceError
from nag.witness.slices import random_rows
from nag.witness.witness import Decomposition, PathCounts, WitnessSet

# Sets of points that are looked at for those whose sum is linear.
MOST_CHOICES = 20_000


def is_one_equation(reduction: Reduction) -> bool:
    """Whether exact linear elimination leaves one exact equation in several unknowns."""
    equations = reduction.reduced.polynomials
    return len(equations) == 1 and equations[0].algebraic and reduction.n > 1


def decompose_one_equation(task: Task) -> Decomposition | None:
    """The components of a hypersurface; one of each orbit, which paths tell.

    Returns:
        None where the equation is none, or factors over its coefficients' field, or its degree is
        too high for this, or where orbits are not known.
    """
    reduction, rng, run = task.reduction, task.rng, task.run
    reduced = reduction.reduced
    if not is_one_equation(reduction) or not all(g.algebraic for g in reduced.nonzero):
        return None
    (f,) = reduced.polynomials
    if [k for _, k in factor_into_irreducibles(f)] != [1]:
        return None
    count = most_absolute_factors(f, rng)
    if count is None:
        return None
    n = reduction.n
    rows = random_rows(rng, n, n, NEARER)[: n - 1]
    cut_out = _Line.of(f, rows)
    classes = None if cut_out is None else cut_out.classes(count)
    if cut_out is None or classes is None:
        return None
    components = _components(reduction, cut_out, rows, classes, rng, run, task.scheme)
    total, counts = len(components), PathCounts()
    moving = [g for g in task.symmetries if not g.is_identity]
    if moving and total > 1:
        try:
            components, counts = group_into_orbits(task.system, components, moving, run=run)
        except SliceError:
            return None
        # An image is one of the factors, so that there are no more.
        if sum(c.orbit for c in components) != total:
            return None
    answer = judge_components(task.system, components, counts, run, order=(0,))
    return replace(answer, algebraic=not counts.tracked)


def _components(
    reduction: Reduction,
    cut_out: _Line,
    rows: np.ndarray,
    classes: Sequence[Sequence[int]],
    rng: np.random.Generator,
    run: Run,
    scheme: bool,
) -> list[WitnessSet]:
    (f,) = reduction.reduced.polynomials
    key = factor_into_irreducibles(f)[0][0]
    if any(key == p for g in reduction.reduced.nonzero for p, _ in factor_into_irreducibles(g)):
        return []
    multidegree = _multidegree(reduction, rng)
    points = points_in_balls(Cut(reduction.n, 0, (f,)), rows, cut_out.balls)
    # Without groups: what these are asked for is known from the equation.
    plain = replace(reduction, system=replace(reduction.system, groups=()))
    result = []
    whole = [Class(np.array(own)) for own in classes]
    examined = Examined.of(points, whole, plain, rng)
    for own in whole:
        found, _ = check_class(own, examined, rng, run, scheme)
        if multidegree is not None:
            found = replace(found, multidegree=multidegree // len(classes))
        result.append(found)
    return result


@dataclass(frozen=True, eq=False)
class _Line:
    """The zeros of a polynomial on a line.

    Attributes:
        f: the polynomial.
        normal: in which the line moves to one side.
        direction: of the line, in balls.
        balls: coordinates of each zero.
    """

    f: Polynomial
    normal: np.ndarray
    direction: list[Any]
    balls: list[list[Any]]

    @classmethod
    def of(cls, f: Polynomial, rows: np.ndarray) -> _Line | None:
        """None where the roots cannot be told apart, or are not as many as the degree."""
        images = line(rows)
        balls = zeros_on(f, images)
        if balls is None:
            return None
        return cls(f, rows[-1, 1:].conj(), [image[1] for image in images], balls)

    def classes(self, count: int) -> list[list[int]] | None:
        """The points of each of ``count`` conjugate factors; None if that is not seen."""
        degree = len(self.balls)
        size, rest = divmod(degree, count)
        if count == 1:
            return [list(range(degree))]
        if rest or comb(degree - 1, size - 1) > MOST_CHOICES:
            return None
        bends, found = self._bends(), []
        left = list(range(degree))
        while left:
            first, *others = left
            own = next(
                (
                    [first, *chosen]
                    for chosen in combinations(others, size - 1)
                    if _vanishes([bends[i] for i in (first, *chosen)])
                ),
                None,
            )
            if own is None:
                return None
            found.append(own)
            left = [i for i in left if i not in own]
        return found

    def _bends(self) -> list[tuple[Any, float]]:
        """Second derivatives of the roots when the line moves, parallel to itself.

        With the sizes of the sums that they are.
        """
        n = self.f.n
        gradient = BallPolynomials.of([self.f.derivative(i) for i in range(n)])
        with in_bits(BITS):
            v = self.direction
            w = [flint.acb(complex(x)) for x in self.normal]
            result = []
            for x in self.balls:
                slopes = gradient.values(x, BITS).entries()
                second = gradient.jacobian(x, BITS)
                along = sum((a * b for a, b in zip(slopes, v, strict=True)), flint.acb(0))
                across = sum((a * b for a, b in zip(slopes, w, strict=True)), flint.acb(0))
                way = [b - across / along * a for a, b in zip(v, w, strict=True)]
                terms = [second[i, j] * way[i] * way[j] / along for i in range(n) for j in range(n)]
                size = sum(float(abs(term).mid()) for term in terms)
                result.append((sum(terms, flint.acb(0)), size))
        return result


def _vanishes(bends: Sequence[tuple[Any, float]]) -> bool:
    """Whether a sum of balls is zero to many digits beside its terms."""
    with in_bits(BITS):
        total = sum((bend for bend, _ in bends[1:]), bends[0][0])
    size = max(size for _, size in bends)
    return bool(total.contains(0)) and float(abs(total).upper()) <= 10.0**-EQUALITY_DIGITS * size


def _multidegree(reduction: Reduction, rng: np.random.Generator) -> np.ndarray | None:
    """Numbers of zeros with groups of variables fixed: degrees on lines of these directions."""
    groups, d = reduction.system.groups, reduction.n - 1
    choices, degrees = choose_groups(groups, d), {}
    if choices is None:
        return None
    (f,) = reduction.elimination.system.polynomials
    origin = [Fraction(int(k), 7) for k in rng.integers(-97, 98, reduction.n)]
    for choice in choices:
        fixed = []
        for g in choice:
            row = [Fraction(0)] * reduction.n
            for i in groups[g]:
                weight = Fraction(int(rng.integers(1, 98)))
                for exponents, c in reduction.images[i].terms.items():
                    if any(exponents):
                        row[exponents.index(1)] += weight * c
            fixed.append(row)
        degrees[choice] = _degree_along(f, origin, _common_zero(fixed))
    return multidegree_of(degrees, len(groups), d)


def _common_zero(rows: Sequence[Sequence[Fraction]]) -> Sequence[Fraction] | None:
    """The direction in which all linear forms vanish; None if there are several."""
    directions = null_space(rows, len(rows) + 1)
    return directions[0] if len(directions) == 1 else None


def _degree_along(
    f: Polynomial, origin: Sequence[Fraction], direction: Sequence[Fraction] | None
) -> int:
    if direction is None:
        return 0
    s = Polynomial.variable(1, 0)
    return f.compose([s * v + p for p, v in zip(origin, direction, strict=True)]).degree
