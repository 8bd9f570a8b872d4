"""The number of zeros that exact algebra knows, beside those that paths have found.

Ends at infinity rest on evidence, and some paths are lost; where the equations have no more zeros
than were found, by multiplicity, neither matters any more.
"""

from __future__ import annotations

from dataclasses import replace
from enum import Enum

import numpy as np

from nag.algebra.zero_count import most_zeros
from nag.solving.judged_ends import JudgedEnds, enlarged
from nag.solving.square_problem import SquareProblem
from nag.solving.start.target import Start
from nag.solving.tropical_zeros import tropical_zeros
from nag.tracking.paths import Paths, PathStatus

# Zeros of extreme sizes are looked for beside so many paths: cells take time as well.
MOST_PATHS = 2000
# Errors of known points, in those estimated, in which another zero may not lie.
SAFETY = 1e3
# Binary logarithm of a size at which a zero may look infinite to the least evidence: some 1e8.
EXTREME = 26.0


class Verdict(Enum):
    """What a count says of the zeros that were found."""

    UNKNOWN = 0
    ALL = 1
    MISSING = 2
    TOO_MANY = 3


def counted(problem: SquareProblem, begin: Start, paths: Paths, ends: JudgedEnds) -> JudgedEnds:
    """The ends with the number of zeros, where paths leave a doubt that it may settle."""
    proved = bool((paths.status == PathStatus.REGULAR).all()) or ends.zeros == len(paths)
    if (begin.complete and proved) or problem.added or len(ends.on_components):
        return ends
    return replace(ends, count=most_zeros(problem.system.polynomials, ends.zeros))


def verdict(ends: JudgedEnds) -> Verdict:
    """Whether all zeros were found.

    A count of multiplicities that rest on evidence beside a bound that is proved: more than there
    can be says that a multiplicity is wrong, or that a zero counts twice.
    """
    if ends.count is None:
        return Verdict.UNKNOWN
    if ends.count.bound == ends.zeros:
        return Verdict.ALL
    if ends.count.bound < ends.zeros:
        return Verdict.TOO_MANY
    return Verdict.MISSING if ends.count.exact else Verdict.UNKNOWN


def with_far_zeros(
    problem: SquareProblem, paths: Paths, ends: JudgedEnds, rng: np.random.Generator
) -> JudgedEnds:
    """The ends with simple zeros of extreme sizes that no path has reached, if any are missing."""
    lost = paths.where(PathStatus.AT_INFINITY, PathStatus.FAILED)
    wanted = verdict(ends) in (Verdict.UNKNOWN, Verdict.MISSING)
    if not wanted or problem.added or problem.squared or not 0 < len(lost) <= MOST_PATHS:
        return ends
    points = np.array([z.point for z in ends.isolated]).reshape(-1, problem.system.n)
    accuracy = np.array([z.accuracy for z in ends.isolated])
    # Errors of projective points are relative to all coordinates together.
    sizes = 1 + np.abs(points).max(axis=1, initial=0.0)
    # Where nothing says that zeros are missing, they are not looked for among ordinary ones.
    least = 0.0 if verdict(ends) is Verdict.MISSING else EXTREME
    found = tropical_zeros(problem.equations, points, SAFETY * accuracy * sizes**2, rng, least)
    return enlarged(problem, ends, found) if found else ends


def doubtful(paths: Paths) -> np.ndarray:
    """Indices of the paths whose ends are not proved."""
    return np.flatnonzero(paths.status != PathStatus.REGULAR)
