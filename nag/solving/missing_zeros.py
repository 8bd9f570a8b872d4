"""Zeros that no path has reached: of extreme sizes, or where paths were lost; and whether any are.

Ends at infinity rest on evidence, and some paths are lost; where exact algebra counts no more zeros
than were found, by multiplicity, neither matters any more.
"""

from __future__ import annotations

from dataclasses import replace
from enum import Enum

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.zero_count import ZeroCount, most_zeros
from nag.errors import StartError
from nag.numerics.singular_point import Place, analyse
from nag.solving.isolated_zero import IsolatedZero
from nag.solving.judged_ends import JudgedEnds, enlarged
from nag.solving.square_problem import SquareProblem
from nag.solving.start.choice import FEW
from nag.solving.start.target import Start
from nag.solving.tropical_zeros import tropical_zeros
from nag.tracking.paths import Paths, PathStatus

# Digits in which these zeros are known.
DIGITS = 150
# They are looked for beside so many paths: cells take time as well.
MOST_PATHS = 2000
# Lost paths at whose last points zeros are looked for, and how near to one these are at best.
MOST_LOST, NEAR = 16, 1e-6
# Errors of known points, in those estimated, in which another zero may not lie.
SAFETY = 1e3
# Binary logarithm of a size at which a zero may look infinite to the least evidence: some 1e8.
EXTREME = 26.0


def with_missing_zeros(
    problem: SquareProblem, begin: Start, paths: Paths, ends: JudgedEnds, rng: np.random.Generator
) -> JudgedEnds:
    """The ends with zeros that no path has reached, if any are missing."""
    number = len(doubtful(paths))
    if problem.added or problem.squared or not 0 < number <= MOST_PATHS:
        return ends
    if verdict(ends) is Verdict.MISSING:
        found, known = _at_lost_paths(problem, begin, paths, ends, rng)
        ends = enlarged(problem, ends, found, known) if found else ends
    if verdict(ends) not in (Verdict.UNKNOWN, Verdict.MISSING):
        return ends
    # Where nothing says that zeros are missing, they are not looked for among ordinary ones.
    least = 0.0 if verdict(ends) is Verdict.MISSING else EXTREME
    far = tropical_zeros(problem.equations, *_known(problem, ends), rng, least)
    zeros = [
        IsolatedZero(
            z.point,
            1,
            z.residual,
            z.end.accuracy,
            z.end.condition,
            DIGITS,
            None if z.end.precise is None else z.end.precise.scaled(z.scales),
        )
        for z in far
    ]
    return enlarged(problem, ends, zeros) if zeros else ends


def _known(problem: SquareProblem, ends: JudgedEnds) -> tuple[np.ndarray, np.ndarray]:
    """The zeros that were found, shape ``(k, n)``, and how far they are from the exact ones."""
    points = np.array([z.point for z in ends.isolated]).reshape(-1, problem.system.n)
    accuracy = np.array([z.accuracy for z in ends.isolated])
    # Errors of projective points are relative to all coordinates together.
    sizes = 1 + np.abs(points).max(axis=1, initial=0.0)
    return points, SAFETY * accuracy * sizes**2


def _at_lost_paths(
    problem: SquareProblem, begin: Start, paths: Paths, ends: JudgedEnds, rng: np.random.Generator
) -> tuple[list[IsolatedZero], set[int]]:
    """Zeros for which singular ends, and those of lost paths, stand, if they are not all known.

    Also the indices of the known ones among these.
    """
    lost = paths.where(PathStatus.FAILED, PathStatus.SINGULAR)
    infinite = paths.points[lost][:, list(begin.homotopy.infinity)] == 0
    lost = lost[~infinite.any(axis=1)][:MOST_LOST]
    known, errors = _known(problem, ends)
    evaluator = Evaluator.of(problem.equations, problem.system.n)
    exact: list[IsolatedZero] = []
    found: list[IsolatedZero] = []
    replaced: set[int] = set()
    for x, accuracy in zip(begin.affine(paths.points[lost]), paths.accuracy[lost], strict=True):
        if not np.abs(x).max() < 2.0**EXTREME:
            continue
        end = analyse(problem.equations, x, min(NEAR, float(accuracy)), rng)
        members: list[IsolatedZero] = []
        for each in end.nearby if end.place is Place.CLUSTER else (end,):
            if each.place is not Place.ISOLATED:
                continue
            residual = float(evaluator.residuals(each.point[None]).max())
            zero = IsolatedZero.of_end(each, residual, DIGITS)
            if all(map(zero.is_apart_from, exact)):
                exact.append(zero)
                members.append(zero)
        apart = [np.abs(known - zero.point).max(axis=1, initial=0.0) for zero in members]
        near = {k for distance in apart for k in np.flatnonzero(distance <= errors).tolist()}
        # Which of the members of a cluster are known, doubles do not say.
        before = sum(ends.isolated[k].multiplicity for k in near)
        if sum(zero.multiplicity for zero in members) > before:
            found += members
            replaced |= near
    return found, replaced


class Verdict(Enum):
    """What a count says of the zeros that were found."""

    UNKNOWN = 0
    ALL = 1
    MISSING = 2
    TOO_MANY = 3


def counted(problem: SquareProblem, begin: Start, paths: Paths, ends: JudgedEnds) -> JudgedEnds:
    """The ends with the number of zeros, where paths leave a doubt that it may settle."""
    if problem.added or len(ends.larger.points):
        return ends
    patient = bool(ends.unclear) or len(paths.where(PathStatus.FAILED)) > 0
    if begin.complete and ends.zeros == len(paths):
        # There are no more zeros than paths, whatever became of each of these.
        return replace(ends, count=ZeroCount(len(paths), False)) if patient else ends
    if begin.complete and bool((paths.status == PathStatus.REGULAR).all()):
        return ends
    if ends.zeros in (begin.known.most, _mixed_volume(problem, begin)):
        return replace(ends, count=ZeroCount(ends.zeros, False))
    return replace(ends, count=most_zeros(problem.system.polynomials, ends.zeros, patient))


def _mixed_volume(problem: SquareProblem, begin: Start) -> int | None:
    """The mixed volume of the equations' polytopes, each with the origin, if few zeros are.

    No system of these supports has more isolated zeros, by multiplicity, also where coordinates
    vanish (Li & Wang, The BKK root count in C^n, 1996).
    """
    if begin.known.bound is not None or problem.squared or len(begin.points) > FEW:
        return begin.known.bound
    from nag.solving.start.mixed_cells import mixed_cells

    try:
        return mixed_cells(problem.target.sparsest.supports, np.random.default_rng(0)).mixed_volume
    except StartError:
        return None


def verdict(ends: JudgedEnds) -> Verdict:
    """Whether all zeros were found.

    More than there can be say that a multiplicity is wrong, or that a zero counts twice.
    """
    if ends.count is None:
        return Verdict.UNKNOWN
    if ends.count.bound == ends.zeros:
        return Verdict.ALL
    if ends.count.bound < ends.zeros:
        return Verdict.TOO_MANY
    return Verdict.MISSING if ends.count.exact else Verdict.UNKNOWN


def doubtful(paths: Paths) -> np.ndarray:
    """Indices of the paths whose ends are not proved."""
    return np.flatnonzero(paths.status != PathStatus.REGULAR)
