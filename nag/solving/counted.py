"""The number of zeros that exact algebra knows, beside those that paths have found.

Ends at infinity rest on evidence, and some paths are lost; where the equations have no more zeros
than were found, by multiplicity, neither matters any more.
"""

from __future__ import annotations

from dataclasses import replace
from enum import Enum

import numpy as np

from nag.algebra.zero_count import ZeroCount, most_zeros
from nag.solving.judged_ends import JudgedEnds
from nag.solving.square_problem import SquareProblem
from nag.solving.start.choice import FEW
from nag.solving.start.target import Start, StartError
from nag.tracking.paths import Paths, PathStatus


class Verdict(Enum):
    """What a count says of the zeros that were found."""

    UNKNOWN = 0
    ALL = 1
    MISSING = 2
    TOO_MANY = 3


def counted(problem: SquareProblem, begin: Start, paths: Paths, ends: JudgedEnds) -> JudgedEnds:
    """The ends with the number of zeros, where paths leave a doubt that it may settle."""
    if problem.added or len(ends.on_components):
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
