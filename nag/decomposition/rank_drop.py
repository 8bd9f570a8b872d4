"""Where the Jacobian's rank drops on a component: a null space system, no minors.

With r the component's codimension, the rank of J drops at x exactly when w^T J(x) = 0 for some
w that is not zero, where J has r rows (Theorem 7.1 of PT13 asks for the vanishing of all r x r
minors instead). Of more equations, r random combinations are taken: their rank drops wherever that
of all of them does, and further points are told by the rank of all. Linear equations are solved
before, exactly: each would cost a coordinate of w. Where the minors and the equations are quickly
proved to have no common zeros, there is nothing to look for.

The pairs (x, w), w in an affine chart, are cut out of the product of the component with the space
of w, equation by equation.

Reference:
    Bates, Hauenstein, Peterson & Sommese, Numerical decomposition of the rank-deficiency set of a
    matrix of multivariate polynomials, 2009.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.smoothness import is_regular_everywhere
from nag.algebra.system import PolynomialSystem
from nag.decomposition.intersection import intersect_equations
from nag.decomposition.reduction import Reduction
from nag.numerics.coincidence import clusters
from nag.witness.membership import component_system
from nag.witness.moving import orthonormal_rows
from nag.witness.projection import ProjectionError, project
from nag.witness.witness import PathCounts, Slice, WitnessSet

# Bits of random numbers: a chart must leave out no vector that turns up, be it as simple as it may.
BITS = 24


@dataclass(frozen=True, eq=False)
class SetOfPoints:
    """A set by its points on a generic slice.

    Attributes:
        dimension, degree: of the set.
        points: complex, shape ``(P, n)``.
        error: the largest relative error of a point.
    """

    dimension: int
    degree: int
    points: np.ndarray
    error: float


@dataclass(frozen=True, eq=False)
class RankDrop:
    """Sets of points of a component where the rank of the Jacobian may drop.

    Attributes:
        sets: as they were found; an isolated point may be found more than once.
        paths: what the tracker did.
        notes: what was left open.
        n: number of variables.
        proved: whether exact algebra proves that it drops nowhere.
    """

    sets: tuple[SetOfPoints, ...]
    paths: PathCounts
    notes: tuple[str, ...]
    n: int
    proved: bool = False

    def isolated(self) -> np.ndarray:
        """The isolated points, each once, shape ``(P, n)``."""
        sets = [one for one in self.sets if one.dimension == 0]
        if not sets:
            return np.zeros((0, self.n), dtype=complex)
        points = np.vstack([one.points for one in sets])
        errors = np.concatenate([np.full(len(one.points), one.error) for one in sets])
        return points[[group[0] for group in clusters(points, errors)]]


def rank_drop(
    system: PolynomialSystem,
    component: WitnessSet,
    *,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
) -> RankDrop:
    """Where the Jacobian of the equations of a reduced component has less than its generic rank.

    Args:
        system: the equations that ``component`` was found from; of a branch of it, if the
            component is one of a branch.

    Raises:
        nag.decomposition.factor.IntersectionError: if the witness points are no regular zeros.
    """
    reduction = Reduction.of(component_system(system, component))
    own, frame, n = reduction.reduced, reduction.frame, reduction.n
    if component.dimension in (0, n):
        return RankDrop((), PathCounts(), (), system.n)
    if is_regular_everywhere(own.polynomials, n - component.dimension):
        return RankDrop((), PathCounts(), (), system.n, proved=True)
    component = _restricted(component, reduction)
    product, start, conditions = _null_space_system(own, component, np.random.default_rng(seed))
    found = intersect_equations(
        product, start, conditions, seed=seed, threads=threads, settings=settings
    )
    sets: list[SetOfPoints] = []
    notes = list(found.notes)
    for one in found.components:
        if one.dimension == 0:
            y = one.points[:, :n]
            sets.append(SetOfPoints(0, one.degree, frame.points(y), frame.error(y, one.accuracy)))
            continue
        try:
            image = project(
                found.system, one, range(n), seed=seed, threads=threads, settings=settings
            )
        except (ProjectionError, ValueError) as reason:
            notes.append(f"a set of points of dimension {one.dimension} at most: {reason}")
            continue
        y = image.points[:, :n]
        error = frame.error(y, image.accuracy)
        sets.append(SetOfPoints(image.dimension, image.degree, frame.points(y), error))
    return RankDrop(tuple(sets), found.paths, tuple(notes), system.n)


def _restricted(component: WitnessSet, reduction: Reduction) -> WitnessSet:
    """A component in the coordinates that linear equations leave: the ranks drop where they did."""
    cut = component.slice
    rows = orthonormal_rows(reduction.frame.pulled_back(cut.A, cut.b))
    points, radii = component.points[:, reduction.kept], component.radii[:, reduction.kept]
    here = Slice(rows[:, 1:], -rows[:, 0])
    return replace(component, slice=here, points=points, radii=radii, multidegree=None, fibres=())


def _null_space_system(
    system: PolynomialSystem, component: WitnessSet, rng: np.random.Generator
) -> tuple[PolynomialSystem, WitnessSet, PolynomialSystem]:
    """The component times the space of w, its equations there, and the conditions w^T J = 0."""
    n, m = system.n, len(system.polynomials)
    r = n - component.dimension
    total = n + r - 1
    jacobian = [[g.with_variables(total, range(n)) for g in row] for row in system.jacobian]
    if m > r:
        columns = list(zip(*jacobian, strict=True))
        jacobian = [[_combined(column, row) for column in columns] for row in _random(rng, r, m)]
    free = [Polynomial.variable(total, i) for i in range(n, total)]
    one = Polynomial.constant(total, 1)
    w = [_combined([one, *free], row) for row in _random(rng, r, r)]
    conditions = [product(w, column) for column in zip(*jacobian, strict=True)]
    names = (*system.variables, *new_names(system.variables, total - n))
    lifted, nonzero = (
        tuple(f.with_variables(total, range(n)) for f in polynomials)
        for polynomials in (system.polynomials, system.nonzero)
    )
    base = PolynomialSystem(names, lifted, nonzero)
    start = _times_space(component, total - n, rng)
    kept = tuple(f for f in dict.fromkeys(conditions) if f)
    return base, start, PolynomialSystem(names, kept)


def _random(rng: np.random.Generator, rows: int, columns: int) -> list[list[Fraction]]:
    """A matrix of orthonormal rows or columns, rounded to exact numbers."""
    matrix = np.linalg.qr(rng.normal(size=(max(rows, columns),) * 2))[0][:rows, :columns]
    return [[Fraction(round(float(c) * 2**BITS), 2**BITS) for c in row] for row in matrix]


def _combined(parts: Sequence[Polynomial], weights: Sequence[Fraction]) -> Polynomial:
    total = Polynomial(parts[0].n, {})
    for f, weight in zip(parts, weights, strict=True):
        total = total + f * weight
    return total


def product(w: Sequence[Polynomial], column: Sequence[Polynomial]) -> Polynomial:
    """The inner product."""
    total = Polynomial(w[0].n, {})
    for a, b in zip(w, column, strict=True):
        total = total + a * b
    return total


def new_names(taken: Sequence[str], count: int) -> list[str]:
    """Names of variables that are not taken."""
    stem = "w"
    while any(name.startswith(stem) for name in taken):
        stem += "_"
    return [f"{stem}{i}" for i in range(count)]


def _times_space(component: WitnessSet, k: int, rng: np.random.Generator) -> WitnessSet:
    """The product of a component with affine space, on a slice that fixes the new coordinates."""
    n, d = component.points.shape[1], component.dimension
    at = np.exp(2j * np.pi * rng.random(k))
    matrix = np.zeros((d + k, n + k), dtype=complex)
    matrix[:d, :n] = component.slice.A
    matrix[d:, n:] = np.eye(k)
    return replace(
        component,
        slice=Slice(matrix, np.concatenate([component.slice.b, at])),
        points=np.hstack([component.points, np.tile(at, (component.degree, 1))]),
        # The new coordinates are the slice's doubles.
        radii=np.hstack([component.radii, np.zeros((component.degree, k))]),
        multidegree=None,
        orbit=1,
        images=(),
        fibres=(),
    )
