"""The component through a regular point, grown from there: monodromy finds its other points.

Nothing else of the zero set is looked at. Points are carried to another slice and back, along two
ways each, every point once along each way: that is four paths a point, where loops of their own
follow all points again and again (Duff, Hill, Jensen, Lee, Leykin & Sommars, Solving polynomial
systems via homotopy continuation and monodromy, 2019). Loops look for what these ways do not reach.
Paths that ask for more digits than doubles are dropped: others lead to the same points. A linear
trace says that all are found (Sommese, Verschelde & Wampler 2002); else there are at least as many
as were found. How much is done is limited by evaluations of the equations and not by a clock: the
same seed, the same answer.

A singular point that only one component passes through, as its tangent cone says, is left along
that cone for a regular one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, reduce
from itertools import product, zip_longest
from typing import Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.final_checks import Examined, check_class
from nag.decomposition.independent_parts import (
    independent_variables,
    put_in_order,
    restrict_to_part,
)
from nag.decomposition.monodromy import LoopEnds, ends_are_distinct, locate_ends, run_loop
from nag.decomposition.reduction import Reduction
from nag.decomposition.splitting import split_joined_points
from nag.decomposition.trace import Trace, digits_of_evidence
from nag.numerics.double_ranks import NEARLY_SINGULAR, matrix_corank
from nag.numerics.doubles import ROUGH
from nag.numerics.local_dimension import LocalDimension, exact_numbers
from nag.numerics.tangent_cone import tangent_cone
from nag.numerics.zero_values import LEAST, ON
from nag.tracking.evaluations import ZERO, Evaluations, count_evaluations
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.tracking.settings import find_settings
from nag.witness.cutting import Cut, find_cut
from nag.witness.exact_points import IN_DOUBLE_DOUBLE
from nag.witness.fibres import Fibre, move
from nag.witness.gauss_newton import polish
from nag.witness.points import Points, move_points
from nag.witness.product import multiply_components
from nag.witness.slices import random_rows, rows_through, unit_complex
from nag.witness.witness import DOUBLE, PathCounts, Status, WitnessSet

# Slices that the first point is carried to, at most; loops, and such in turn that find nothing; and
# from how many of those on every other slice lies near the origin.
MOST_SLICES, MOST_LOOPS, MOST_QUIET, QUIET = 4, 200, 24, 4
# Paths that loops which find nothing track together at least before they are given up: those of few
# points say little.
QUIET_PATHS = 64
# Ways to another slice, and as many back; and how many more back where points are missing.
WAYS, MORE_WAYS = 2, 3
# Paths that are tracked before it is known what they take, and at most at once.
FEW, MOST_AT_ONCE = 64, 1024
# Seconds that a path takes besides its evaluations, that an evaluation takes for each variable of a
# term of the equations, for each entry of the Jacobian and for each step of its elimination, on a
# processor as is common; and how many paths are evaluated at once.
PATH, FACTOR, ENTRY, STEP, LANES = 6e-5, 3e-10, 7e-10, 5e-11, 8
# Seconds that it takes, for each variable of a term, to find coordinates and a cut.
MADE_READY = 1e-5

# Binary logarithms of the distances to which a singular point is left, one after the other; how far
# from the tangent cone, beside the distance, a zero may be there; and what that becomes at half the
# distance where the set touches the cone, at most.
DISTANCES, BENT, TOUCHING = (3, 24), 0.1, 0.7

BUDGET = "its budget was used up"
NO_SLICE = "no path led from it to a generic slice"
NOT_ALL = "loops found no more points, and these are not all, or no path of their trace arrived"


@dataclass(frozen=True, eq=False)
class Growth:
    """What is known of the component through a point.

    Attributes:
        dimension: of the component.
        least: its degree is this at least.
        component: all of it; None where that is not confirmed, and for a product of sets some of
            which are points.
        reason: why the degree is not confirmed; empty where it is.
        paths: that were tracked.
        seconds: that were not used.
    """

    dimension: int
    least: int
    component: WitnessSet | None
    reason: str
    paths: PathCounts
    seconds: float

    @property
    def degree(self) -> int | None:
        """The component's degree; None where it is not known."""
        return None if self.reason else self.least


@dataclass(eq=False)
class _Allowance:
    """What may be tracked yet.

    Attributes:
        seconds: that are left of a common processor.
        each: that an evaluation takes there.
        spent: seconds, and the paths that they were spent on, by the digits in which these were
            followed. The last ones tell less: points that are found late are hard to reach.
    """

    seconds: float
    each: float = 0.0
    spent: dict[int, tuple[float, int]] = field(default_factory=dict)
    paths: PathCounts = field(default_factory=PathCounts)

    def pay(self, digits: int, spent: Evaluations, paths: PathCounts) -> None:
        """Take off what paths took."""
        work = spent.work * self.each
        if digits == DOUBLE:
            # Lanes that are not filled take as long.
            work *= max(LANES / max(paths.tracked, 1), 1.0)
        cost = work + paths.tracked * PATH
        self.seconds -= cost + spent.once * self.each
        self.paths += paths
        before, tracked = self.spent.get(digits, (0.0, 0))
        self.spent[digits] = before + cost, tracked + paths.tracked

    def per_path(self, digits: int) -> float | None:
        """Seconds that a path in so many digits took on the average; None if there was none."""
        cost, tracked = self.spent.get(digits, (0.0, 0))
        return cost / tracked if tracked else None

    def most(self, digits: int) -> int:
        """How many paths may be tracked: a few where it is not known what they take."""
        if self.seconds <= 0:
            return 0
        cost = self.per_path(digits)
        return FEW if cost is None else int(self.seconds / cost)


@takes_run
@np.errstate(over="ignore", invalid="ignore")
def grow_component(
    system: PolynomialSystem,
    point: np.ndarray,
    dimension: int,
    *,
    seconds: float,
    run: Run = DEFAULT_RUN,
) -> Growth:
    """The component through a solution where the equations' rank is its codimension.

    Where equations share no variables it is a product, and its factors are grown.

    Args:
        point: the solution, to doubles' accuracy.
        dimension: of the component, 1 or more.
        seconds: how long loops and traces may take, counted by the evaluations that a common
            processor makes in that time; what would take longer is not begun.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.
    """
    parts = independent_variables(system)
    if len(parts) > 1:
        dimensions = [_dimension_at(restrict_to_part(system, p), point[list(p)]) for p in parts]
        if sum(dimensions) == dimension:
            return _grow_product(system, parts, dimensions, point, seconds, run)
    rng = run.random(Stream.GROWTH)
    reduction = Reduction.of(system, scaled=True)
    allowance = _Allowance(seconds - MADE_READY * _count_factors(system.polynomials))
    points = _first_point(reduction, point, dimension, allowance, rng, run)
    if points is None:
        return Growth(dimension, 1, None, NO_SLICE, allowance.paths, allowance.seconds)
    growing = _Growing(points, reduction, allowance, rng, run)
    reason = growing.find_all()
    component = None if reason else growing.confirmed()
    if not reason and component.status is Status.UNDECIDED:
        component, reason = None, component.note
    least, left = len(growing.points), allowance.seconds
    return Growth(dimension, least, component, reason, allowance.paths, left)


def leave_singular_point(
    system: PolynomialSystem,
    point: Sequence[Any],
    local: LocalDimension,
    rng: np.random.Generator,
) -> np.ndarray | None:
    """A regular point beside a singular one, on the only component that passes through it.

    None where others may pass through it as well, and where no such point is found.

    Args:
        point: as it was given, exact or not.
        local: what is known of the equations there.
    """
    if local.dimension is None or local.tangent_dimension != local.dimension + 1:
        return None
    error = {} if exact_numbers(point) is not None else {"accuracy": ROUGH}
    cone = tangent_cone(system, point, **error)
    if cone is None or not cone.is_irreducible(rng):
        return None
    evaluator = Evaluator.of(system.polynomials, system.n)
    along, last, found = cone.tangent_vector(rng), np.inf, None
    for k in range(*DISTANCES):
        # A curve leaves the point along each vector of the cone: what is off is of second order.
        start = local.point + 2.0**-k * along
        end = polish(evaluator, start, local.dimension)
        off = float(np.abs(end.x - start).max()) * 2.0**k
        if found is not None and off < BENT and off < TOUCHING * last:
            return found
        last, found = off, end.x if end.converged and off < BENT else None
    return None


def _dimension_at(system: PolynomialSystem, point: np.ndarray) -> int:
    """The corank of the equations at a solution."""
    evaluator = Evaluator.of(system.polynomials, system.n)
    return matrix_corank(evaluator.balanced_jacobian(point + 0j), NEARLY_SINGULAR)


def _grow_product(
    system: PolynomialSystem,
    parts: Sequence[Sequence[int]],
    dimensions: Sequence[int],
    point: np.ndarray,
    seconds: float,
    run: Run,
) -> Growth:
    """The product of the components through a solution's parts; of points nothing is grown."""
    least, paths, factors, reasons = 1, PathCounts(), [], []
    for part, dimension in zip(parts, dimensions, strict=True):
        if not dimension:
            continue
        here = point[list(part)]
        own = restrict_to_part(system, part)
        grown = grow_component(own, here, dimension, seconds=seconds, run=run)
        least, paths, seconds = least * grown.least, paths + grown.paths, grown.seconds
        factors.append(grown.component)
        reasons += [grown.reason] if grown.reason else []
    component = None
    if all(dimensions) and all(factor is not None for factor in factors):
        component = put_in_order(reduce(multiply_components, factors), parts)
    reason = "; ".join(dict.fromkeys(reasons))
    return Growth(sum(dimensions), least, component, reason, paths, seconds)


def _first_point(
    reduction: Reduction,
    point: np.ndarray,
    dimension: int,
    allowance: _Allowance,
    rng: np.random.Generator,
    run: Run,
) -> Points | None:
    """The point of a generic slice that a solution is carried to."""
    near = reduction.frame.coordinates(np.asarray(point, dtype=complex))
    x = polish(reduction.equations.evaluator, near, dimension).x
    rows = rows_through(rng, dimension, x)
    # One cut for all attempts: to make a large one ready takes longer than a path.
    found = find_cut(reduction.equations, rows, x, LEAST, rng, deflate=False)
    if found is None:
        return None
    cut, z = found
    allowance.each = _evaluation_seconds(cut)
    for digits in [DOUBLE] * MOST_SLICES + [IN_DOUBLE_DOUBLE]:
        if allowance.seconds <= 0:
            break
        start = Fibre(cut, rows, z[None])
        rows = rows_through(rng, dimension, z)
        target, gamma = random_rows(rng, dimension, len(z)), complex(unit_complex(rng))
        with count_evaluations() as spent:
            (ends,) = move([start], target, gamma, _follow_closely(run, digits))
        allowance.pay(digits, spent, ends.counts.judged_elsewhere)
        # A cut that leaves out an equation which only seems to hold gives itself away elsewhere.
        on_all = reduction.equations.evaluator.residuals(ends.x).max(initial=0.0) <= ON
        if ends.regular.all() and on_all:
            return Points(target).with_point(cut, ends.points[0])
    return None


def _follow_closely(run: Run, digits: int) -> Run:
    """The same with paths followed in so many digits at most, and at least carefully.

    Where no trace confirms a degree, nothing shows that a path has jumped to another component,
    whose points are then found like those of this one. For three Sarrus linkages in a row, as one
    system, whose component is of degree 125, there were more points on 3 of 8 seeds with default
    settings, on 3 of 30 with a tolerance of 1e-4, and on none of 20 with careful ones.
    """
    given, careful = find_settings(run.settings), find_settings("careful")
    closely = replace(
        given,
        digits=digits,
        tolerance=min(given.tolerance, careful.tolerance),
        newton=min(given.newton, careful.newton),
        radius_factor=min(given.radius_factor, careful.radius_factor),
        max_steps=max(given.max_steps, careful.max_steps),
    )
    return replace(run, settings=closely)


def _evaluation_seconds(cut: Cut) -> float:
    """Seconds that a common processor takes for an evaluation of a square system."""
    total = 1 + cut.n + cut.aux
    return FACTOR * _count_factors(cut.polynomials) + ENTRY * total**2 + STEP * total**3


def _count_factors(polynomials: Sequence[Polynomial]) -> int:
    """Variables of terms, and the terms' coefficients."""
    return sum(1 + sum(e > 0 for e in term) for f in polynomials for term in f.terms)


@dataclass(eq=False)
class _Way:
    """A way from one slice to another.

    Attributes:
        gamma: that the rows turn with.
        tried: how many points, the first ones, were carried along it.
        ends: for each that arrived the point that it came to.
    """

    gamma: complex
    tried: int = 0
    ends: dict[int, int] = field(default_factory=dict)


@dataclass(eq=False)
class _Growing:
    """Points of one component on a slice, and the loops that joined them.

    Attributes:
        loops: for each the pairs of points that it joins, shape ``(m, 2)``.
        trace: of all the points; None before there is one, or where a path of it failed.
    """

    points: Points
    reduction: Reduction
    allowance: _Allowance
    rng: np.random.Generator
    run: Run
    loops: list[np.ndarray] = field(default_factory=list)
    trace: Trace | None = None

    @cached_property
    def evidence(self) -> int:
        """Digits to which a trace must be linear."""
        natural = self.reduction.natural.system(self.reduction.system)
        return digits_of_evidence(natural.polynomials)

    def find_all(self) -> str:
        """Find points until the trace of all of them is linear; why it did not become so."""
        if self._find_by_ways():
            return ""
        quiet, digits = 0, DOUBLE
        for _ in range(MOST_LOOPS):
            linear = self._has_linear_trace() if quiet else None
            if linear:
                return ""
            # Where a trace says that points are missing, it is for more loops to find them.
            if linear is None and quiet >= max(MOST_QUIET, QUIET_PATHS // len(self.points)):
                return NOT_ALL
            self.run.tell("points of the component", len(self.points), 0)
            known = self.allowance.per_path(digits)
            some = min(len(self.points), self.allowance.most(digits) // 2)
            if not some or (known is not None and some < len(self.points)):
                return BUDGET
            found = self._run_loop(digits, some, quiet >= QUIET and quiet % 2 == 0)
            quiet = 0 if found else quiet + (some == len(self.points))
            digits = DOUBLE if found and digits == DOUBLE else IN_DOUBLE_DOUBLE
        return NOT_ALL

    def _find_by_ways(self) -> bool:
        """Carry points to another slice and back; whether the trace of all is linear.

        Where it says that points are missing, they are looked for along further ways back: that is
        half of what a loop takes.
        """
        rng, points = self.rng, self.points
        other = Points(random_rows(rng, points.dimension, points.n))
        gammas = unit_complex(rng, 2 * WAYS + MORE_WAYS).tolist()
        ways = [[_Way(g) for g in gammas[:WAYS]], [_Way(g) for g in gammas[WAYS : 2 * WAYS]]]
        for more in (None, *gammas[2 * WAYS :]):
            ways[1] += [] if more is None else [_Way(more)]
            other = self._carry_all(other, ways)
            linear = self._has_linear_trace()
            if linear is not False:
                break
        for there, back in product(*ways):
            pairs = [(i, back.ends[k]) for i, k in there.ends.items() if k in back.ends]
            self.loops.append(np.array(pairs, dtype=int).reshape(-1, 2))
        return bool(linear)

    def _carry_all(self, other: Points, ways: Sequence[Sequence[_Way]]) -> Points:
        """Carry points there and back while that finds any, each once along each way.

        Args:
            other: the points that are known on the other slice.
            ways: there, and back.

        Returns:
            those on the other slice.
        """
        found = True
        while found:
            found = False
            for there, back in zip_longest(*ways):
                if there is not None and (some := self._choose_waiting_points(there, self.points)):
                    other, found = self._carry(self.points, some, other, there), True
                if back is not None and (some := self._choose_waiting_points(back, other)):
                    self.points, found = self._carry(other, some, self.points, back), True
            self.run.tell("points of the component", len(self.points), 0)
        return other

    def _choose_waiting_points(self, way: _Way, points: Points) -> range:
        """Those that were not carried along a way yet, as many as can be afforded."""
        return range(way.tried, min(len(points), way.tried + self.allowance.most(DOUBLE)))

    def _carry(self, points: Points, some: range, others: Points, way: _Way) -> Points:
        """The points of the other slice, with those that some points are carried to."""
        way.tried += len(some)
        with count_evaluations() as spent:
            run = _follow_closely(self.run, DOUBLE)
            there, order, paths = move_points(points, some, others.rows, way.gamma, run)
        self.allowance.pay(DOUBLE, spent, paths)
        places = locate_ends(there, others)
        if places is None or not ends_are_distinct(there, places):
            return others
        residuals = self.reduction.equations.evaluator.residuals(there.x)
        # Where another path of the way ended, one of the two has jumped.
        taken = np.isin(places, list(way.ends.values()))
        good = ~taken & ((places >= 0) | (residuals.max(axis=1, initial=0.0) < ON))
        ends = LoopEnds(order, there, places).only(good)
        others, pairs = ends.join_to(others, points)
        way.ends |= dict(pairs.tolist())
        return others

    def _run_loop(self, digits: int, some: int, scaled: bool) -> bool:
        """Track a loop from some of the points, the first ones; whether it found any."""
        run = _follow_closely(self.run, digits)
        with count_evaluations() as spent:
            found, paths = run_loop(self.points, range(some), self.rng, run, scaled)
        self.allowance.pay(digits, spent, paths)
        if found.places is None:
            return False
        new = found.places < 0
        residuals = self.reduction.equations.evaluator.residuals(found.ends.x)
        good = ~new | (residuals.max(axis=1, initial=0.0) < ON)
        self.points, pairs = found.only(good).join_to(self.points)
        self.loops.append(pairs)
        return bool((new & good).any())

    def _has_linear_trace(self) -> bool | None:
        """Whether the trace of all points is linear; None where it cannot be afforded or said."""
        run, everything = _follow_closely(self.run, IN_DOUBLE_DOUBLE), range(len(self.points))
        trace = self.trace or Trace.of(self.points, self.evidence, self.rng)
        while True:
            rest = [i for i in everything if i not in trace.ends]
            some = self.allowance.most(IN_DOUBLE_DOUBLE) // 2
            if not rest:
                break
            if not some:
                return None
            with count_evaluations() as spent:
                trace, paths = trace.carry(self.points, rest[: min(some, MOST_AT_ONCE)], run)
            self.allowance.pay(IN_DOUBLE_DOUBLE, spent, paths)
            self.trace = trace
            if trace is None:
                return None
        if trace.count_unclear(everything) * ZERO * self.allowance.each > self.allowance.seconds:
            return None
        with count_evaluations() as spent:
            linear, self.trace = trace.linear(self.points, everything)
        self.allowance.pay(IN_DOUBLE_DOUBLE, spent, PathCounts())
        return linear

    def confirmed(self) -> WitnessSet:
        """The component of the first point, whose trace is linear and that of no part of it."""
        run = _follow_closely(self.run, IN_DOUBLE_DOUBLE)
        with count_evaluations() as spent:
            found = split_joined_points(self.points, self.trace, self.loops, self.rng, run)
            self.points = found.points
            own = next(each for each in found.classes if 0 in each.indices)
            examined = Examined.of(self.points, [own], self.reduction, self.rng)
            component, paths = check_class(own, examined, self.rng, run)
        self.allowance.pay(IN_DOUBLE_DOUBLE, spent, found.counts + paths)
        return component
