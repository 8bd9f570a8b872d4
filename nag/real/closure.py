"""The closure of a curve in a product of projective spaces, and a pencil of hyperplanes there.

Each group of variables is a chart of a projective space; variables without groups are one of such
all together. Coordinates are homogeneous: first those that the charts divide by, one a group, then
the variables. The value ``t`` of a linear form is a point ``(p : q)`` of a line as well: over it
lie the points with ``q B = p A``, where ``A`` is the product of all dividing coordinates and ``B``
the form times that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import sqrt

import numpy as np

from nag.algebra.evaluation import Evaluator, PlacedDerivatives
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.double_newton import ANYWHERE, find_zeros
from nag.real.curve import Turn

# Decides: Homogeneous coordinates of length one that are zero at vertices known to more digits.
AT_INFINITY = 1e-9
# Decides: The same of norms of displacements.
NO_NORM = 1e-7
# Eigenvalues of quadratic forms, beside the largest, that rounding makes negative.
NEGATIVE = 1e-12


@dataclass(frozen=True, eq=False)
class ProjectiveClosure:
    """A curve's equations, homogeneous in each group.

    Attributes:
        groups: a partition of the variables' indices.
        equations: of the curve, and then ``A`` and ``B``, in ``G + n`` coordinates.
        scale: what the last of these rows is divided by to be as it is evaluated.
        norms: for each group polynomials in its homogeneous coordinates that are not zero where
            these are a displacement.
    """

    n: int
    groups: tuple[tuple[int, ...], ...]
    equations: tuple[Polynomial, ...]
    scale: float
    norms: tuple[tuple[Polynomial, ...], ...]

    @classmethod
    def of(
        cls, polynomials: Sequence[Polynomial], system: PolynomialSystem, form: np.ndarray
    ) -> ProjectiveClosure:
        """The closure of a curve on which the polynomials vanish."""
        n = system.n
        groups = system.groups or (tuple(range(n)),)
        count = len(groups)
        exact = [_homogeneous(f, groups) for f in polynomials]
        everything = {(1,) * count + (0,) * n: Fraction(1)}
        weighted: dict[tuple[int, ...], Fraction] = {}
        for g, group in enumerate(groups):
            for i in group:
                e = [1] * count + [0] * n
                e[g], e[count + i] = 0, 1
                weighted[tuple(e)] = Fraction(float(form[i]))
        pencil = Polynomial(count + n, everything), Polynomial(count + n, weighted)
        norms = tuple(
            tuple(_homogeneous(f, groups) for f in _norms_of(system, group)) for group in groups
        )
        scale = max(abs(float(c)) for c in form)
        return cls(n, groups, (*exact, *pencil), scale, norms)

    @property
    def size(self) -> int:
        """Number of homogeneous coordinates."""
        return len(self.groups) + self.n

    @cached_property
    def group_of(self) -> np.ndarray:
        """The group of each homogeneous coordinate, shape ``(size,)``."""
        own = np.zeros(self.n, dtype=int)
        for g, group in enumerate(self.groups):
            own[list(group)] = g
        return np.concatenate([np.arange(len(self.groups)), own])

    @property
    def coordinates(self) -> tuple[tuple[int, ...], ...]:
        """The homogeneous coordinates of each group."""
        return coordinates_of_groups(self.groups)

    @cached_property
    def _evaluator(self) -> Evaluator:
        return Evaluator.of(self.equations, self.size)

    @cached_property
    def _slopes(self) -> PlacedDerivatives:
        return self._evaluator.placed_derivatives(self.size)

    def values(self, points: np.ndarray) -> np.ndarray:
        """Values of the equations, of ``A`` and of ``B``, shape ``(P, rows)``."""
        values = self._evaluator.values(points)
        values = values if np.iscomplexobj(points) else values.real
        values[:, -1] *= self.scale
        return values

    def jacobians(self, points: np.ndarray) -> np.ndarray:
        """Their derivatives, shape ``(P, rows, size)``."""
        slopes = self._slopes(points)
        slopes = slopes if np.iscomplexobj(points) else slopes.real
        slopes[:, -1] *= self.scale
        return slopes

    def normalise(self, points: np.ndarray) -> np.ndarray:
        """Points with the coordinates of each group of length one."""
        squares = np.zeros((len(points), len(self.groups)))
        for g in range(len(self.groups)):
            squares[:, g] = (np.abs(points[:, self.group_of == g]) ** 2).sum(axis=1)
        return points / np.sqrt(squares)[:, self.group_of]

    def homogeneous(self, x: np.ndarray) -> np.ndarray:
        """Affine points, shape ``(P, n)``, as homogeneous ones."""
        ones = np.ones((len(x), len(self.groups)), dtype=x.dtype)
        return self.normalise(np.hstack([ones, x]))

    def affine(self, points: np.ndarray) -> np.ndarray:
        """Homogeneous points as affine ones; where they are infinite, very large."""
        count = len(self.groups)
        first = points[:, :count]
        first = np.where(first == 0, 1e-300, first)
        return points[:, count:] / first[:, self.group_of[count:]]

    @cached_property
    def _affine_evaluator(self) -> Evaluator:
        count = len(self.groups)
        own = [
            Polynomial(self.n, {e[count:]: c for e, c in f.terms.items()})
            for f in self.equations[:-2]
        ]
        return Evaluator.of(own, self.n)

    @np.errstate(all="ignore")
    def refined(self, x: np.ndarray) -> np.ndarray:
        """Affine points of the curve, each coordinate to rounding relative to its own size.

        Large coordinates hide the others of a normalised point. What does not become better stays.
        """
        evaluator = self._affine_evaluator
        residuals = evaluator.residuals(x).max(axis=1, initial=0.0)
        slopes = evaluator.placed_derivatives(self.n)

        def units(x: np.ndarray) -> np.ndarray:
            return np.maximum(1.0, np.abs(x))

        def equations(x: np.ndarray, _: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            sizes = evaluator.sizes(x)
            matrix = slopes(x).real * units(x)[:, None] / sizes[..., None]
            return evaluator.values(x).real / sizes, matrix

        moved = find_zeros(equations, x, 2, self.n - 1, ANYWHERE, units).x
        better = evaluator.residuals(moved).max(axis=1, initial=0.0) < residuals
        return np.where(better[:, None], moved, x)

    def distances(self, some: np.ndarray, others: np.ndarray) -> np.ndarray:
        """Distances of normalised points, whatever their factors, shape ``(P, Q)``."""
        result = np.zeros((len(some), len(others)))
        for g in range(len(self.groups)):
            own = self.group_of == g
            a, b = some[:, own], others[:, own]
            products = a @ b.conj().T
            sizes = np.abs(products)
            turns = np.where(sizes > 0, products / np.where(sizes > 0, sizes, 1), 1)
            apart = a[:, None] - turns[..., None] * b[None]
            result = np.maximum(result, np.linalg.norm(apart, axis=2))
        return result

    def align_signs(self, points: np.ndarray, to: np.ndarray) -> np.ndarray:
        """Real points with the signs of groups that bring them next to others, or to one."""
        signs = np.ones((len(points), len(self.groups)))
        for g in range(len(self.groups)):
            own = self.group_of == g
            signs[:, g] = np.where((points[:, own] * to[..., own]).sum(axis=1) < 0, -1.0, 1.0)
        return points * signs[:, self.group_of]

    def is_infinite(self, point: np.ndarray) -> bool:
        """Whether a normalised real point is beyond where configurations are.

        At infinity of a group whose norms do not vanish there it is a configuration like others.
        """
        for g, norms in enumerate(self.norms):
            far = abs(point[g]) < AT_INFINITY
            lost = any(abs(float(f(point.tolist()))) < NO_NORM for f in norms)
            if lost or (far and not norms):
                return True
        return False

    def corank_gap(self, point: np.ndarray) -> float:
        """The least singular value that is not one of the tangent, beside the largest.

        It is zero where the curve's equations are singular.
        """
        own = self.jacobians(point[None])[0][:-2]
        patches = np.zeros((len(self.groups), self.size))
        for g in range(len(self.groups)):
            patches[g] = np.where(self.group_of == g, point, 0)
        s = np.linalg.svd(np.vstack([own, patches]), compute_uv=False)
        return float(s[self.size - 2] / s[0])


def coordinates_of_groups(groups: Sequence[Sequence[int]]) -> tuple[tuple[int, ...], ...]:
    """The homogeneous coordinates of each group: the one that divides it, and its variables'."""
    return tuple((g, *(len(groups) + i for i in own)) for g, own in enumerate(groups))


def homogeneous_norms(system: PolynomialSystem, group: Sequence[int]) -> tuple[Polynomial, ...]:
    """The norms of a group of variables, in their common denominator and the variables.

    Where none of them vanishes, infinity of the variables is a configuration like others.
    """
    place = {i: k for k, i in enumerate(group)}
    positions = [place.get(i, 0) for i in range(system.n)]
    own = range(len(group))
    norms = (f.with_variables(len(group), positions) for f in _norms_of(system, group))
    return tuple(_homogeneous(f, [own]) for f in norms)


def _norms_of(system: PolynomialSystem, group: Sequence[int]) -> list[Polynomial]:
    return [f for f in system.nonzero if system.groups and _is_norm(f, group)]


def _is_norm(f: Polynomial, group: Sequence[int]) -> bool:
    """Whether a polynomial in a group is quadratic and nowhere negative, infinity included."""
    if {i for e in f.terms for i, k in enumerate(e) if k} - set(group) or f.degree != 2:
        return False
    size = 1 + len(group)
    place = {i: 1 + k for k, i in enumerate(group)}
    matrix = np.zeros((size, size))
    for e, c in f.terms.items():
        factors = [place[i] for i, k in enumerate(e) for _ in range(k)]
        i, j = [0] * (2 - len(factors)) + factors
        matrix[i, j] += float(c) / 2
        matrix[j, i] += float(c) / 2
    values = np.linalg.eigvalsh(matrix)
    return bool(values[0] > -NEGATIVE * values[-1])


def _homogeneous(f: Polynomial, groups: Sequence[Sequence[int]]) -> Polynomial:
    """A polynomial made homogeneous in each group."""
    tops = [max((sum(e[i] for i in group) for e in f.terms), default=0) for group in groups]
    terms = {
        (*(top - sum(e[i] for i in group) for top, group in zip(tops, groups, strict=True)), *e): c
        for e, c in f.terms.items()
    }
    return Polynomial(len(groups) + f.n, terms)


def turns_of(system: PolynomialSystem) -> tuple[Turn, ...]:
    """The variables that are half-angles: groups of one with a norm that has no real zeros."""
    result = []
    for group in system.groups:
        if len(group) != 1:
            continue
        (i,) = group
        for f in system.nonzero:
            powers = {e[i]: float(c) for e, c in f.terms.items() if sum(e) == e[i]}
            if len(powers) != len(f.terms) or max(powers, default=0) != 2:
                continue
            centre = -powers.get(1, 0.0) / (2 * powers[2])
            square = powers.get(0, 0.0) / powers[2] - centre**2
            if square > 0:
                result.append(Turn(i, centre, sqrt(square)))
                break
    return tuple(result)
