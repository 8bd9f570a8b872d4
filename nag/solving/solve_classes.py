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
from nag.numerics.coincidence import overlapping
from nag.numerics.zero_values import NONZERO
from nag.solving.kantorovich import Confirmation, Confirmed
from nag.solving.parameter_line import ParameterLine, parameter_line
from nag.solving.solution_classes import invariants
from nag.solving.solutions import PathStatistics, Solution, SolveResult
from nag.solving.start.family_monodromy import CONFIRMING, SHARP, Progress, family_monodromy
from nag.solving.start.scalings import nearest_scaling, random_scaling, scaling_weights
from nag.tracking.paths import PathStatus
from nag.tracking.run import Run
from nag.tracking.settings import Settings, named
from nag.tracking.track import track

# The part of the classes that may be lost by chance; if more are, the parameters are special, and
# their ends need an endgame.
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
        arrived: which classes end at a confirmed regular zero of their own, shape ``(P,)``.
        at_infinity, singular: which of the others end there.
        tracked, steps: numbers of paths and steps, of all attempts.
    """

    ends: Confirmed
    arrived: np.ndarray
    at_infinity: np.ndarray
    singular: np.ndarray
    tracked: int
    steps: int


def solved_by_monodromy(
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
    repeated = _repeated(symmetric, sharp, 1.0, found.values)
    regular = sharp.regular & ~repeated
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
    lost = int((~found.arrived & ~found.at_infinity).sum())
    if len(weights) and 0 < lost <= FEW * len(found.arrived):
        # Another way leads to the same solutions, each from another one.
        turned = factors * random_scaling(weights, rng)
        other = track_classes(solved, goal, turned, run.threads, run.settings)
        found = _joined(symmetric, goal, factors, found, other)
    return _result(symmetric, target, found, solved.complete, solved.detail, run)


def _joined(
    symmetric: SymmetricFamily,
    goal: np.ndarray,
    factors: np.ndarray,
    found: ClassEnds,
    other: ClassEnds,
) -> ClassEnds:
    """The classes that were found on one way and those that another one adds."""
    x, p = np.split(factors, [symmetric.family.n])
    both = [np.flatnonzero(each.arrived) for each in (found, other)]
    points = [each.ends.points[i] / x for each, i in zip((found, other), both, strict=True)]
    radii = [each.ends.radii[i] / np.abs(x) for each, i in zip((found, other), both, strict=True)]
    balls = invariants(symmetric, np.concatenate(points), goal / p, np.concatenate(radii))
    repeated = overlapping(*balls)[:, 1] - len(both[0])
    new = both[1][np.setdiff1d(np.arange(len(both[1])), repeated)]
    # Lost paths give their places first.
    free = np.flatnonzero(~found.arrived)
    free = free[np.argsort(found.at_infinity[free] + found.singular[free], kind="stable")]
    new = new[: len(free)]
    places = free[: len(new)]
    ends = found.ends.replace_rows(places, other.ends.select_rows(new))
    flags = [f.copy() for f in (found.arrived, found.at_infinity, found.singular)]
    for flag, value in zip(flags, (True, False, False), strict=True):
        flag[places] = value
    tracked, steps = found.tracked + other.tracked, found.steps + other.steps
    return ClassEnds(ends, *flags, tracked, steps)


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
    chosen = named("fast" if settings == "default" else settings)
    sharp = min(SHARP, chosen.newton)
    chosen = replace(chosen, retries=0, max_steps=MOST_STEPS, newton=sharp)
    symmetric = solved.symmetric
    x, p = np.split(factors, [symmetric.family.n])
    near = goal / p
    line = parameter_line(symmetric.family, solved.values, near)
    confirm = Confirmation(symmetric.family)
    ends = confirm(np.full_like(solved.members[0], np.nan), goal)
    arrived = np.zeros(len(ends.points), dtype=bool)
    tracked = steps = 0
    for member in solved.members:
        left = np.flatnonzero(~arrived)
        if not len(left) or (tracked and len(left) > FEW * len(arrived)):
            break
        starts = line.starts(member[left])
        paths = track(line.homotopy, starts, chosen, threads, endgame=False, distinct=False)
        tracked, steps = tracked + len(left), steps + int(paths.steps.sum())
        ends = ends.replace_rows(left, confirm(line.affine(paths.points) * x, goal, threads))
        arrived = ends.regular & ~_repeated(symmetric, ends, x, near)
    left = np.flatnonzero(~arrived)
    infinite, singular = np.zeros_like(arrived), np.zeros_like(arrived)
    if len(left):
        paths = track(line.homotopy, line.starts(solved.members[0][left]), settings, threads)
        tracked, steps = tracked + len(left), steps + int(paths.steps.sum())
        points = line.affine(paths.points)
        points[paths.status == PathStatus.AT_INFINITY] = np.nan
        ends = ends.replace_rows(left, confirm(points * x, goal, threads))
        arrived = ends.regular & ~_repeated(symmetric, ends, x, near)
        infinite[left] = (paths.status == PathStatus.AT_INFINITY) & ~arrived[left]
        singular[left] = (paths.status == PathStatus.SINGULAR) & ~arrived[left]
    return ClassEnds(ends, arrived, infinite, singular, tracked, steps)


def _repeated(
    symmetric: SymmetricFamily, ends: Confirmed, scale: np.ndarray | float, values: np.ndarray
) -> np.ndarray:
    """Which regular ends are of the class of another one: a path jumped.

    Args:
        scale: what coordinates are to be divided by, for the parameters ``values``.
    """
    repeated = np.zeros(len(ends.points), dtype=bool)
    places = np.flatnonzero(ends.regular)
    points, radii = ends.points[places] / scale, ends.radii[places] / np.abs(scale)
    balls = invariants(symmetric, points, values, radii)
    repeated[places[overlapping(*balls).ravel()]] = True
    return repeated


def _result(
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
    arrived = np.flatnonzero(found.arrived)
    images = symmetric.images(found.ends.points[arrived], values)
    solutions = _solutions(symmetric, found.ends, arrived, images, system)
    lost = len(found.arrived) - len(arrived) - int(found.at_infinity.sum() + found.singular.sum())
    notes = []
    if not complete:
        notes.append("it is not known whether all solutions for random parameters were found")
    if found.singular.any():
        notes.append(f"{int(found.singular.sum())} classes of solutions end at singular points")
    if lost:
        notes.append(f"the paths of {lost} classes of solutions were lost")
    usable = np.isfinite(images).all(axis=(0, 2))
    if not usable.all():
        notes.append(f"members of {int((~usable).sum())} classes of solutions are at infinity")
    undecided = symmetric.outer(found.ends.points[found.singular])
    counts = PathStatistics(
        found.tracked,
        len(arrived),
        int(found.singular.sum()),
        int(found.at_infinity.sum()),
        lost,
        found.steps,
    )
    return SolveResult(
        system=system,
        solutions=solutions,
        on_components=np.zeros((0, system.n), dtype=complex),
        undecided=undecided,
        excluded=0,
        paths=counts,
        start="parameter",
        reason=f"parameter homotopy: {detail}",
        seed=run.seed,
        settings=run.name,
        complete=not notes,
        notes=tuple(notes),
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
