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
from nag.solving.start.target import Start
from nag.tracking.paths import Paths, PathStatus


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
    if ends.zeros == begin.known.most:
        return replace(ends, count=ZeroCount(begin.known.most, False))
    patient = bool(ends.unclear) or len(paths.where(PathStatus.FAILED)) > 0
    return replace(ends, count=most_zeros(problem.system.polynomials, ends.zeros, patient))


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
