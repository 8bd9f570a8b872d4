"""Zeros that no path has reached: of extreme sizes, or where paths were lost.

Ends at infinity rest on evidence, and some paths are lost; where exact algebra counts no more zeros
than were found, by multiplicity, neither matters any more.
"""

from __future__ import annotations

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.zero_count import Completeness
from nag.numerics.coincidence import NEAR
from nag.numerics.digits import DIGITS
from nag.numerics.doubles import SLACK
from nag.numerics.singular_point import Place, analyse
from nag.solving.isolated_zero import IsolatedZero
from nag.solving.path_search import PathSearch
from nag.solving.tropical_zeros import tropical_zeros
from nag.tracking.paths import PathStatus

# They are looked for beside so many paths: cells take time as well.
MOST_PATHS = 2000
# Lost paths at whose last points zeros are looked for.
MOST_LOST = 16
# Decides: Binary logarithm of sizes from which zeros are looked for where they cannot be counted;
# ends so far out may satisfy the least evidence of infinity.
EXTREME = 26.0


def find_at_lost_paths(search: PathSearch) -> PathSearch:
    """The zeros with those that singular ends, and those of lost paths, stand for.

    They are looked for where zeros are missing; the known ones among them are replaced.
    """
    if not _may_lack(search) or search.completeness is not Completeness.MISSING:
        return search
    problem, begin, paths = search.problem, search.begin, search.tracked
    lost = paths.where(PathStatus.FAILED, PathStatus.SINGULAR)
    infinite = paths.points[lost][:, list(begin.homotopy.infinity)] == 0
    lost = lost[~infinite.any(axis=1)][:MOST_LOST]
    known, errors = _known_zeros(search)
    evaluator = Evaluator.of(problem.equations, problem.system.n)
    exact: list[IsolatedZero] = []
    found: list[IsolatedZero] = []
    replaced: set[int] = set()
    for x, accuracy in zip(begin.affine(paths.points[lost]), paths.accuracy[lost], strict=True):
        if not np.abs(x).max() < 2.0**EXTREME:
            continue
        end = analyse(problem.equations, x, min(NEAR, float(accuracy)), search.rng)
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
        before = sum(search.ends.isolated[k].multiplicity for k in near)
        if sum(zero.multiplicity for zero in members) > before:
            found += members
            replaced |= near
    return search.add_zeros(found, replaced) if found else search


def find_by_sizes(search: PathSearch) -> PathSearch:
    """The zeros with some of extreme sizes, or of any where some are missing, that coefficients
    tell of.
    """
    missing = search.completeness is Completeness.MISSING
    if not _may_lack(search) or not (missing or search.completeness is Completeness.UNKNOWN):
        return search
    # Where nothing says that zeros are missing, they are not looked for among ordinary ones.
    least = 0.0 if missing else EXTREME
    far = tropical_zeros(search.problem.equations, *_known_zeros(search), search.rng, least)
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
    return search.add_zeros(zeros) if zeros else search


def _may_lack(search: PathSearch) -> bool:
    """Whether zeros may be missing that are looked for beside the paths."""
    square = not search.problem.added and not search.problem.squared
    return square and 0 < len(search.doubtful) <= MOST_PATHS


def _known_zeros(search: PathSearch) -> tuple[np.ndarray, np.ndarray]:
    """The zeros that were found, shape ``(k, n)``, and how far they are from the exact ones."""
    isolated = search.ends.isolated
    points, accuracy = isolated.points, isolated.accuracy
    # Errors of projective points are relative to all coordinates together.
    sizes = 1 + np.abs(points).max(axis=1, initial=0.0)
    return points, SLACK * accuracy * sizes**2
