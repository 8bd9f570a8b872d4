"""Ends of lost paths that are the conjugates of other ends.

The zeros of equations with real coefficients come in conjugate pairs, which paths of complex
homotopies reach apart from each other. A regular end whose conjugate no path has reached therefore
says where a lost path must have led: of a simple zero, exactly one path ends there.
"""

from __future__ import annotations

import numpy as np

from nag.solving.start.target import Start
from nag.tracking.ends.inclusion import prove_end
from nag.tracking.ends.terms import Terms
from nag.tracking.paths import Ball, Paths, PathStatus
from nag.tracking.projective import coinciding


def restore_conjugate_ends(begin: Start, paths: Paths) -> Paths:
    """The paths, those that were lost with the missing conjugates of regular ends as theirs.

    They are left as they are unless as many conjugates are missing as paths were lost, each is
    apart from all known regular ends, and Krawczyk's test proves each a regular zero of the exact
    equations. Which lost path leads to which of them is not known, and does not matter.
    """
    lost = paths.where(PathStatus.FAILED)
    if not begin.complete or not len(lost):
        return paths
    missing = paths.select_rows(_find_unpaired(begin, paths)).conjugate()
    if len(missing) != len(lost) or not _prove_all(begin, missing):
        return paths
    return paths.track_again(lost, missing)


def _find_unpaired(begin: Start, paths: Paths) -> np.ndarray:
    """Indices of the finite regular ends whose conjugates are no such ends."""
    regular = paths.where(PathStatus.REGULAR)
    count = len(regular)
    ends = paths.select_rows(regular)
    twice = Paths.concatenate([ends, ends.conjugate()])
    paired = np.zeros(count, dtype=bool)
    groups = begin.homotopy.groups
    for i, j in coinciding(groups, twice.points, twice.accuracy).tolist():
        if i < count <= j and twice.same(begin.homotopy, i, j):
            paired[j - count] = True
    return regular[~paired]


def _prove_all(begin: Start, ends: Paths) -> bool:
    terms = Terms(begin.homotopy)
    for i, (x, accuracy) in enumerate(zip(ends.points, ends.accuracy.tolist(), strict=True)):
        ball = ends.balls.get(i)
        if ball is None:
            parts = np.stack([np.stack([x.real, x.imag], axis=1), np.zeros((len(x), 2))], axis=2)
            ball = Ball(parts, np.full(len(x), accuracy))
        if prove_end(terms, ball.centre, ball.radii) is None:
            return False
    return True
