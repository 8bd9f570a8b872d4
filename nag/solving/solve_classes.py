"""A symmetric family solved for given parameters: one path for each class of solutions.

An end counts when Kantorovich's theorem confirms a regular zero that no other path leads to. The
members of a class are equally good starts, and differ in size: where the path from one of them is
lost, the path from another may arrive.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.number import Number
from nag.algebra.rational_map import MapError
from nag.algebra.symmetric_family import SymmetricFamily
from nag.numerics.coincidence import overlapping_pairs
from nag.numerics.zero_values import NONZERO
from nag.solving.kantorovich import Confirmation, Confirmed
from nag.solving.parameter_line import ParameterLine, parameter_line
from nag.solving.solution_classes import invariants
from nag.solving.solutions import PathStatistics, Solution, SolveResult
from nag.solving.start.family_monodromy import CONFIRMING, SHARP, Progress, family_monodromy
from nag.solving.start.scalings import nearest_scaling, random_scaling, scaling_weights
from nag.tracking.paths import PathStatus
from nag.tracking.run import Run
from nag.tracking.settings import Settings, find_settings
from nag.tracking.track import track

# Decides: Part of the classes that chance may lose; more, and the parameters are special.
FEW = 0.1
# Steps of a path from a member of a class other than the last that is tried.
MOST_STEPS = 1500


@dataclass(frozen=True, eq=False)
class SolvedClasses:
    """A symmetric family solved for random parameters, in inner coordinates.

    Attributes:
        values: the parameters, shape ``(k,)``.
        members: all members of all classes of solutions, the smallest of each class first, shape
            ``(order, P, n)``.
        complete: whether loops find no more of them than the number that is known, and each is
            confirmed.
        detail: how they were found.
    """

    symmetric: SymmetricFamily
    values: np.ndarray
    members: np.ndarray
    complete: bool
    detail: str


@dataclass(frozen=True, eq=False)
class ClassEnds:
    """What became of the classes of solutions.

    Attributes:
        ends: confirmed or not, one for each class; in inner coordinates.
        status: `PathStatus`, shape ``(P,)``; ``REGULAR`` where a class ends at a confirmed regular
            zero of its own.
        tracked, steps: numbers of paths and steps, of all attempts.
    """

    ends: Confirmed
    status: np.ndarray
    tracked: int
    steps: int

    def where(self, *status: PathStatus) -> np.ndarray:
        """Indices of the classes with one of these statuses."""
        return np.flatnonzero(np.isin(self.status, status))


def solve_random_member(
    symmetric: SymmetricFamily,
    count: int | None,
    rng: np.random.Generator,
    threads: int,
    progress: Progress | None = None,
) -> SolvedClasses:
    """Solve for random parameters; ``count`` is the number of solutions, if it is known.

    Raises:
        StartError: if there is no solution to begin with, or there are too many.
        MapError: if the symmetries do not carry solutions to solutions.
    """
    order = len(symmetric)
    wanted = None if count is None else -(-count // order)
    found = family_monodromy(symmetric, rng, threads, wanted, progress)
    members = smallest_members(symmetric, found.points, found.values)
    evaluator = Evaluator.of(symmetric.family.polynomials, symmetric.family.polynomials[0].n)
    values = np.broadcast_to(found.values, (members[:, 0].shape[0], len(found.values)))
    if evaluator.residuals(np.hstack([members[:, 0], values])).max() > NONZERO:
        raise MapError("the maps do not carry solutions to solutions")
    sharp = Confirmation(symmetric.family)(members[0], found.values, threads)
    regular = _judge_classes(symmetric, sharp, 1.0, found.values) == PathStatus.REGULAR
    points = sharp.points[regular]
    complete = bool(regular.all()) and wanted == len(points) and found.idle >= CONFIRMING
    detail = f"{len(points)} solutions" if order == 1 else f"{len(points)} classes of {order}"
    detail += f" for random parameters by monodromy, {found.paths} paths in {found.loops} loops"
    detail += f", the last {found.idle} of which found nothing new"
    if count is not None:
        detail += f"; {count} are given"
    members = smallest_members(symmetric, points, found.values)
    return SolvedClasses(symmetric, found.values, members, complete, detail)


def solve_classes(
    solved: SolvedClasses,
    target: Sequence[Number],
    rng: np.random.Generator,
    run: Run,
) -> SolveResult:
    """All solutions for exact parameters ``target``, by one path for each class."""
    symmetric = solved.symmetric
    goal = symmetric.inner_values([complex(v) for v in target])
    # The nearer the parameters, the shorter the paths.
    weights = scaling_weights(symmetric.family)
    factors = nearest_scaling(weights, solved.values, goal, rng)
    found = track_classes(solved, goal, factors, run.threads, run.settings)
    lost = len(found.where(PathStatus.FAILED, PathStatus.SINGULAR))
    if len(weights) and 0 < lost <= FEW * len(found.status):
        # Another way leads to the same solutions, each from another one.
        turned = factors * random_scaling(weights, rng)
        other = track_classes(solved, goal, turned, run.threads, run.settings)
        found = _join_ends(symmetric, goal, factors, found, other)
    return _list_members(symmetric, target, found, solved.complete, solved.detail, run)


def _join_ends(
    symmetric: SymmetricFamily,
    goal: np.ndarray,
    factors: np.ndarray,
    found: ClassEnds,
    other: ClassEnds,
) -> ClassEnds:
    """The classes that were found on one way and those that another one adds."""
    x, p = np.split(factors, [symmetric.family.n])
    both = [each.where(PathStatus.REGULAR) for each in (found, other)]
    every = Confirmed.concatenate(
        [each.ends.select_rows(i) for each, i in zip((found, other), both, strict=True)]
    )
    repeated = _repeats(symmetric, every, x, goal / p)[:, 1] - len(both[0])
    new = both[1][np.setdiff1d(np.arange(len(both[1])), repeated)]
    # Lost paths give their places first.
    lost, free = (
        found.where(PathStatus.FAILED),
        found.where(*set(PathStatus) - {PathStatus.REGULAR}),
    )
    free = np.append(lost, np.setdiff1d(free, lost))
    new = new[: len(free)]
    places, status = free[: len(new)], found.status.copy()
    status[places] = PathStatus.REGULAR
    ends = found.ends.replace_rows(places, other.ends.select_rows(new))
    return ClassEnds(ends, status, found.tracked + other.tracked, found.steps + other.steps)


def line_of_classes(
    solved: SolvedClasses, target: Sequence[Number]
) -> tuple[ParameterLine, np.ndarray]:
    """The homotopy to given parameters, not scaled, and one start for each class."""
    goal = solved.symmetric.inner_values([complex(v) for v in target])
    line = parameter_line(solved.symmetric.family, solved.values, goal)
    return line, line.starts(solved.members[0])


def smallest_members(
    symmetric: SymmetricFamily, points: np.ndarray, values: np.ndarray
) -> np.ndarray:
    """All members of each class, the smallest first, shape ``(order, P, n)``."""
    images = symmetric.images(points, values)
    norms = np.linalg.norm(images, axis=2)
    norms = np.where(np.isfinite(norms), norms, np.inf)
    order = np.argsort(norms, axis=0, kind="stable")
    return np.take_along_axis(images, order[:, :, None], axis=0)


def track_classes(
    solved: SolvedClasses,
    goal: np.ndarray,
    factors: np.ndarray,
    threads: int,
    settings: Settings | str,
) -> ClassEnds:
    """Follow one solution of each class to the parameters ``goal``, in inner coordinates.

    The paths lead to ``goal`` scaled: ``factors``, of unknowns and parameters, undo that.
    """
    # Jumps show, as every end must be confirmed and of another class.
    chosen = find_settings("fast" if settings == "default" else settings)
    sharp = min(SHARP, chosen.newton)
    chosen = replace(chosen, retries=0, max_steps=MOST_STEPS, newton=sharp)
    symmetric = solved.symmetric
    x, p = np.split(factors, [symmetric.family.n])
    near = goal / p
    line = parameter_line(symmetric.family, solved.values, near)
    confirm = Confirmation(symmetric.family)
    ends = confirm(np.full_like(solved.members[0], np.nan), goal)
    status = np.full(len(ends), PathStatus.FAILED)
    tracked = steps = 0
    for member in solved.members:
        left = np.flatnonzero(status == PathStatus.FAILED)
        if not len(left) or (tracked and len(left) > FEW * len(status)):
            break
        starts = line.starts(member[left])
        paths = track(line.homotopy, starts, chosen, threads, endgame=False, distinct=False)
        tracked, steps = tracked + len(left), steps + int(paths.steps.sum())
        ends = ends.replace_rows(left, confirm(line.affine(paths.points) * x, goal, threads))
        status = _judge_classes(symmetric, ends, x, near)
    left = np.flatnonzero(status == PathStatus.FAILED)
    if len(left):
        paths = track(line.homotopy, line.starts(solved.members[0][left]), settings, threads)
        tracked, steps = tracked + len(left), steps + int(paths.steps.sum())
        points = line.affine(paths.points)
        points[paths.status == PathStatus.AT_INFINITY] = np.nan
        ends = ends.replace_rows(left, confirm(points * x, goal, threads))
        status = _judge_classes(symmetric, ends, x, near)
        lost = np.isin(paths.status, (PathStatus.AT_INFINITY, PathStatus.SINGULAR))
        lost &= status[left] == PathStatus.FAILED
        status[left[lost]] = paths.status[lost]
    return ClassEnds(ends, status, tracked, steps)


def _judge_classes(
    symmetric: SymmetricFamily, ends: Confirmed, scale: np.ndarray | float, values: np.ndarray
) -> np.ndarray:
    """``REGULAR`` for classes that end at regular zeros of their own, else ``FAILED``.

    Shape ``(P,)``; the other arguments are those of `_repeats`.
    """
    regular = ends.regular.copy()
    regular[_repeats(symmetric, ends, scale, values).ravel()] = False
    return np.where(regular, PathStatus.REGULAR, PathStatus.FAILED)


def _repeats(
    symmetric: SymmetricFamily, ends: Confirmed, scale: np.ndarray | float, values: np.ndarray
) -> np.ndarray:
    """Pairs of regular ends of one class, of which a path jumped, shape ``(pairs, 2)``.

    Args:
        scale: what coordinates are to be divided by, for the parameters ``values``.
    """
    places = np.flatnonzero(ends.regular)
    points, radii = ends.points[places] / scale, ends.radii[places] / np.abs(scale)
    return places[overlapping_pairs(*invariants(symmetric, points, values, radii))]


def _list_members(
    symmetric: SymmetricFamily,
    target: Sequence[Number],
    found: ClassEnds,
    complete: bool,
    detail: str,
    run: Run,
) -> SolveResult:
    """All members of the classes that arrived, as solutions of the family's own system."""
    system = symmetric.original.at(target)
    values = symmetric.inner_values([complex(v) for v in target])
    arrived = found.where(PathStatus.REGULAR)
    images = symmetric.images(found.ends.points[arrived], values)
    singular, lost = found.where(PathStatus.SINGULAR), len(found.where(PathStatus.FAILED))
    doubts = []
    if not complete:
        doubts.append("it is not known whether all solutions for random parameters were found")
    if len(singular):
        doubts.append(f"{len(singular)} classes of solutions end at singular points")
    if lost:
        doubts.append(f"the paths of {lost} classes of solutions were lost")
    usable = np.isfinite(images).all(axis=(0, 2))
    if not usable.all():
        doubts.append(f"members of {int((~usable).sum())} classes of solutions are at infinity")
    return SolveResult.of(
        system,
        run,
        start="parameter",
        reason=f"parameter homotopy: {detail}",
        solutions=_solutions(symmetric, found.ends, arrived, images, system),
        undecided=symmetric.outer(found.ends.points[singular]),
        paths=PathStatistics.of(found.status, found.steps, found.tracked),
        doubts=doubts,
    )


def _solutions(
    symmetric: SymmetricFamily,
    ends: Confirmed,
    arrived: np.ndarray,
    images: np.ndarray,
    system: object,
) -> tuple[Solution, ...]:
    n = symmetric.original.n
    polynomials = system.polynomials
    evaluator = Evaluator.of(polynomials, n)
    # The equations have real coefficients: a zero is real if its conjugate is near enough to it.
    conjugates = symmetric.inner(symmetric.outer(ends.points).conj())
    real = ends.same(conjugates)[arrived]
    order = len(images)
    everything = symmetric.outer(images.transpose(1, 0, 2).reshape(-1, n))
    usable = np.isfinite(everything).all(axis=1)
    residual = np.full(len(everything), np.inf)
    residual[usable] = evaluator.residuals(everything[usable]).max(axis=1)
    everything[np.repeat(real, order)] = everything[np.repeat(real, order)].real
    return tuple(
        Solution(point, 1, bool(real[i // order]), float(residual[i]), accuracy, condition, digits)
        for i, (point, accuracy, condition, digits) in enumerate(
            zip(
                everything,
                np.repeat(ends.accuracy[arrived], order).tolist(),
                np.repeat(ends.condition[arrived], order).tolist(),
                np.repeat(ends.precision[arrived], order).tolist(),
                strict=True,
            )
        )
        if usable[i]
    )
