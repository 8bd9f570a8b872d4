"""Where the Jacobian's rank drops on a component: a null space system, no minors.

With r the component's codimension, the rank of J drops at x exactly when w^T J(x) = 0 for some
w that is not zero, where J has r rows (Theorem 7.1 of PT13 asks for the vanishing of all r x r
minors instead). Of more equations, r random combinations are taken: their rank drops wherever that
of all of them does, and on further sets, of one dimension less than the component, which are told
by the rank of all. Points where that drops may lie in such a set, unseen. Where there is one,
J(x) N = 0 is solved as well, with all equations and one more column than the component's dimension.
Linear equations are solved before, exactly: each would cost a coordinate of w. Where the minors and
the equations are quickly proved to have no common zeros, there is nothing to look for.

The pairs (x, w), w in an affine chart, are cut out of the product of the component with the space
of w, equation by equation; so are (x, N).

Reference:
    Bates, Hauenstein, Peterson & Sommese, Numerical decomposition of the rank-deficiency set of a
    matrix of multivariate polynomials, 2009.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.smoothness import is_regular_everywhere
from nag.algebra.system import PolynomialSystem
from nag.decomposition.intersection import intersect_equations
from nag.decomposition.reduction import Reduction
from nag.numerics.coincidence import clusters
from nag.numerics.doubles import ROUNDED
from nag.numerics.local_dimension import local_dimension
from nag.numerics.precise_point import PrecisePoint
from nag.solving.solutions import SolveResult
from nag.solving.solve import solve
from nag.tracking.run import DEFAULT_RUN, Run, takes_run
from nag.witness.close_to_sets import are_same
from nag.witness.component_equations import component_system
from nag.witness.membership import Membership, membership_in
from nag.witness.moving import orthonormal_rows
from nag.witness.projection import Projection, ProjectionError, project
from nag.witness.witness import Decomposition, PathCounts, Slice, WitnessSet

# Bits of random numbers: a chart must leave out no vector that turns up, be it as simple as it may.
BITS = 24


@dataclass(frozen=True, eq=False)
class SetOfPoints:
    """A set by its points on a generic slice.

    Attributes:
        dimension, degree: of the set.
        points: complex, shape ``(P, n)``.
        error: the largest relative error of a point.
        source: indices of the component or the pair that it was found from, where this is one of
            several.
        precise: an isolated point that equations cut, in digits; None elsewhere.
    """

    dimension: int
    degree: int
    points: np.ndarray
    error: float
    source: tuple[int, ...] = ()
    precise: PrecisePoint | None = None

    def is_apart_from(self, other: SetOfPoints) -> bool:
        """Whether two isolated points are two in the digits of both, where these are known."""
        if self.precise is None or other.precise is None:
            return False
        return not are_same(self.precise, other.precise)


@dataclass(frozen=True, eq=False)
class RankDrop:
    """Sets of points of a component where the rank of the Jacobian may drop.

    Attributes:
        sets: as they were found; an isolated point may be found more than once.
        paths: what the run did.
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


@takes_run
def rank_drop(
    system: PolynomialSystem,
    component: WitnessSet,
    *,
    run: Run = DEFAULT_RUN,
) -> RankDrop:
    """Where the Jacobian of the equations of a reduced component has less than its generic rank.

    Args:
        system: the equations that ``component`` was found from; of a branch of it, if the
            component is one of a branch.

    Raises:
        nag.decomposition.factor.IntersectionError: if the witness points are no regular zeros.
    """
    reduction = Reduction.of(component_system(system, component), scaled=True)
    reduced, frame, n = reduction.reduced, reduction.frame, reduction.n
    if component.dimension in (0, n):
        return RankDrop((), PathCounts(), (), system.n)
    if is_regular_everywhere(reduced.polynomials, n - component.dimension):
        return RankDrop((), PathCounts(), (), system.n, proved=True)
    search = _RankDrops(reduced, _restrict_component(component, reduction), run)
    rng = run.random()
    search.cut(_left_null_space(reduced, search.rank, rng), rng)
    if search.regular:
        search = search.joined(_right_null_space(reduced, search.rank, rng), rng)
    sets = [
        SetOfPoints(one.dimension, one.degree, frame.points(y), frame.error(y, one.error))
        for one in search.sets
        for y in [one.points]
    ]
    return RankDrop(tuple(sets), search.paths, tuple(dict.fromkeys(search.notes)), system.n)


@takes_run
def rank_drop_points(
    system: PolynomialSystem,
    component: WitnessSet,
    *,
    run: Run = DEFAULT_RUN,
) -> np.ndarray | None:
    """Finitely many points, among which are all where a component's Jacobian drops in rank.

    Others may be among them: of other components, and where only combinations of more equations
    than are needed are dependent. Nothing is taken from the component but its dimension.

    Returns:
        Complex, shape ``(P, n)``; None where there may be infinitely many, or one may be missing.
    """
    reduction = Reduction.of(component_system(system, component), scaled=True)
    reduced, frame = reduction.reduced, reduction.frame
    rng = run.random()
    conditions = _left_null_space(reduced, reduced.n - component.dimension, rng)
    found = _isolated_pairs(reduced, conditions, run)
    return frame.points(found.points[:, : reduced.n]) if _is_whole(found) else None


def _in_variables(reduced: PolynomialSystem, conditions: PolynomialSystem) -> PolynomialSystem:
    """A system in its own variables and the further ones of conditions."""
    lifted, nonzero = (
        tuple(f.with_variables(conditions.n, range(reduced.n)) for f in polynomials)
        for polynomials in (reduced.polynomials, reduced.nonzero)
    )
    return PolynomialSystem(conditions.variables, lifted, nonzero)


def _isolated_pairs(
    reduced: PolynomialSystem, conditions: PolynomialSystem, run: Run
) -> SolveResult:
    """The isolated zeros of a system and conditions, in the variables of these."""
    product = _in_variables(reduced, conditions)
    equations = dict.fromkeys((*product.polynomials, *conditions.polynomials))
    return solve(replace(product, polynomials=tuple(equations)), run=run)


def _is_whole(found: SolveResult) -> bool:
    """Whether all zeros are known to be isolated ones that were found."""
    return found.complete and not found.positive_dimensional and not len(found.undecided)


@dataclass(eq=False)
class _RankDrops:
    """What was found of the points where the rank of a component's equations is less than usual.

    Attributes:
        regular: whether sets of positive dimension were met where it is not.
    """

    reduced: PolynomialSystem
    component: WitnessSet
    run: Run
    sets: list[SetOfPoints] = field(default_factory=list)
    paths: PathCounts = field(default=PathCounts())
    notes: list[str] = field(default_factory=list)
    regular: bool = False

    @property
    def rank(self) -> int:
        """The usual rank: the codimension."""
        return self.reduced.n - self.component.dimension

    def cut(self, conditions: PolynomialSystem, rng: np.random.Generator) -> None:
        """Where the component's product with an affine space, of more variables, meets conditions.

        Raises:
            nag.decomposition.factor.IntersectionError: if the witness points are no regular zeros.
        """
        reduced, total = self.reduced, conditions.n
        product = _in_variables(reduced, conditions)
        start = _times_space(self.component, total - reduced.n, rng)
        found = intersect_equations(product, start, conditions, run=self.run)
        self.paths += found.paths
        if found.notes and self._keep_isolated_points(conditions):
            return
        self.notes += [*found.notes, *(one.note for one in found.components if one.note)]
        for one in found.components:
            if not one.note:
                self._judge(found, one)

    def _keep_isolated_points(self, conditions: PolynomialSystem) -> bool:
        """Keep the component's points where the rank drops, if all such points are isolated ones.

        Of a point where many come together, as of a cusp of high order, no regular equations are
        found in passing, and none are needed.
        """
        found = _isolated_pairs(self.reduced, conditions, self.run)
        self.paths += PathCounts(found.paths.tracked, found.paths.failed, found.paths.at_infinity)
        if not _is_whole(found):
            return False
        n, error, kept = self.reduced.n, ROUNDED, []
        for solution in found.solutions:
            x, error = solution.point[:n], max(error, solution.accuracy)
            answer = membership_in(self.reduced, self.component, x, solution.accuracy, self.run)
            if answer is Membership.UNDECIDED:
                return False
            kept += [x] if answer is Membership.MEMBER else []
        if kept:
            self.sets.append(SetOfPoints(0, len(kept), np.array(kept), error))
        return True

    def joined(self, conditions: PolynomialSystem, rng: np.random.Generator) -> _RankDrops:
        """A search by conditions that leave nothing out, beside what is known of larger sets."""
        again = _RankDrops(self.reduced, self.component, self.run)
        again.cut(conditions, rng)
        again.paths += self.paths
        if again.notes:
            # A set that both found cannot be told from two of them.
            points = [one for one in again.sets if one.dimension == 0]
            again.sets, again.notes = self.sets + points, self.notes + again.notes
        return again

    def _judge(self, found: Decomposition, one: WitnessSet) -> None:
        """Keep a set of pairs if the rank of all equations is not known to be the usual one."""
        n = self.reduced.n
        image: WitnessSet | Projection = one
        if one.dimension:
            try:
                image = project(found.system, one, range(n), run=self.run)
            except (ProjectionError, ValueError) as reason:
                self.notes.append(f"a set of points of dimension {one.dimension} at most: {reason}")
                return
        points = image.points[:, :n]
        if image.dimension and len(self.reduced.polynomials) > self.rank:
            accuracy = max(image.accuracy, ROUNDED)
            local = local_dimension(self.reduced, points[0], accuracy=accuracy)
            if local.tangent_dimension == n - self.rank:
                self.regular = True
                return
        self.sets.append(SetOfPoints(image.dimension, image.degree, points, image.accuracy))


def _restrict_component(component: WitnessSet, reduction: Reduction) -> WitnessSet:
    """A component in the coordinates that linear equations leave: the ranks drop where they did."""
    cut, frame = component.slice, reduction.frame
    rows = orthonormal_rows(frame.pulled_back(cut.A, cut.b))
    points = frame.coordinates(component.points)
    radii = component.radii[:, list(frame.positions)] / frame.scales
    here = Slice(rows[:, 1:], -rows[:, 0])
    return replace(component, slice=here, points=points, radii=radii, multidegree=None, fibres=())


def _left_null_space(
    reduced: PolynomialSystem, r: int, rng: np.random.Generator
) -> PolynomialSystem:
    """w^T J = 0 for r equations, or as many random combinations, in the variables x and w."""
    n, m = reduced.n, len(reduced.polynomials)
    total = n + r - 1
    jacobian = _jacobian(reduced, total)
    if m > r:
        columns = list(zip(*jacobian, strict=True))
        jacobian = [[product(column, row) for column in columns] for row in _random(rng, r, m)]
    ones = [Polynomial.constant(total, 1), *Polynomial.variables(total)[n:]]
    w = [product(ones, row) for row in _random(rng, r, r)]
    return _conditions(reduced, [product(w, column) for column in zip(*jacobian, strict=True)])


def _right_null_space(
    reduced: PolynomialSystem, r: int, rng: np.random.Generator
) -> PolynomialSystem:
    """J N = 0 for all equations, in the variables x and those of N: n - r + 1 independent columns.

    In random coordinates the first rows of N are those of the unit matrix.
    """
    n, wide = reduced.n, reduced.n - r + 1
    total = n + (r - 1) * wide
    free = Polynomial.variables(total)[n:]
    jacobian, turn = _jacobian(reduced, total), _random(rng, n, n)
    conditions = []
    for j in range(wide):
        column = [Polynomial.constant(total, int(i == j)) for i in range(wide)]
        column = [product([*column, *free[j::wide]], row) for row in turn]
        conditions += [product(row, column) for row in jacobian]
    return _conditions(reduced, conditions)


def _jacobian(reduced: PolynomialSystem, total: int) -> list[list[Polynomial]]:
    return [[g.with_variables(total, range(reduced.n)) for g in row] for row in reduced.jacobian]


def _conditions(reduced: PolynomialSystem, polynomials: Sequence[Polynomial]) -> PolynomialSystem:
    names = (*reduced.variables, *new_names(reduced.variables, polynomials[0].n - reduced.n))
    return PolynomialSystem(names, tuple(f for f in dict.fromkeys(polynomials) if f))


def _random(rng: np.random.Generator, rows: int, columns: int) -> list[list[Fraction]]:
    """A matrix of orthonormal rows or columns, rounded to exact numbers."""
    matrix = np.linalg.qr(rng.normal(size=(max(rows, columns),) * 2))[0][:rows, :columns]
    return [[Fraction(round(float(c) * 2**BITS), 2**BITS) for c in row] for row in matrix]


def product(w: Sequence[Polynomial], column: Sequence[Polynomial | Fraction]) -> Polynomial:
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
