"""Ends of lost paths that are the conjugates of other ends.

The zeros of equations with real coefficients come in conjugate pairs, which paths of complex
homotopies reach apart from each other. A regular end whose conjugate no path has reached therefore
says where a lost path must have led: of a simple zero, exactly one path ends there.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nag.solving.start.target import Start
from nag.tracking.ends.inclusion import proved
from nag.tracking.ends.terms import Terms
from nag.tracking.paths import Ball, Paths, PathStatus
from nag.tracking.projective import coinciding
from nag.tracking.track import merged


def with_conjugate_ends(begin: Start, paths: Paths) -> Paths:
    """The paths, those that were lost with the missing conjugates of regular ends as theirs.

    They are left as they are unless as many conjugates are missing as paths were lost, each is
    apart from all known regular ends, and Krawczyk's test proves each a regular zero of the exact
    equations. Which lost path leads to which of them is not known, and does not matter.
    """
    lost = paths.where(PathStatus.FAILED)
    if not begin.complete or not len(lost):
        return paths
    missing = _conjugates(paths, _alone(begin, paths))
    if len(missing) != len(lost) or not _all_proved(begin, missing):
        return paths
    return merged(paths, replace(missing, steps=np.zeros_like(missing.steps)), lost)


def _alone(begin: Start, paths: Paths) -> np.ndarray:
    """Indices of the finite regular ends whose conjugates are no such ends."""
    regular = paths.where(PathStatus.REGULAR)
    count = len(regular)
    twice = _joined(_chosen(paths, regular), _conjugates(paths, regular))
    paired = np.zeros(count, dtype=bool)
    groups = begin.homotopy.groups
    for i, j in coinciding(groups, twice.points, twice.accuracy).tolist():
        if i < count <= j and twice.same(begin.homotopy, i, j):
            paired[j - count] = True
    return regular[~paired]


def _all_proved(begin: Start, ends: Paths) -> bool:
    terms = Terms(begin.homotopy)
    for i, (x, accuracy) in enumerate(zip(ends.points, ends.accuracy.tolist(), strict=True)):
        ball = ends.balls.get(i)
        if ball is None:
            parts = np.stack([np.stack([x.real, x.imag], axis=1), np.zeros((len(x), 2))], axis=2)
            ball = Ball(parts, np.full(len(x), accuracy))
        if proved(terms, ball.centre, ball.radii) is None:
            return False
    return True


def _chosen(paths: Paths, indices: np.ndarray) -> Paths:
    names = set(paths.__dataclass_fields__) - {"balls", "branches"}
    arrays = {name: getattr(paths, name)[indices] for name in names}
    balls = {k: paths.balls[i] for k, i in enumerate(indices.tolist()) if i in paths.balls}
    return Paths(**arrays, balls=balls)


def _conjugates(paths: Paths, indices: np.ndarray) -> Paths:
    """The conjugates of regular ends."""
    sign = np.array([1.0, -1.0])[:, None]
    ends = _chosen(paths, indices)
    balls = {k: Ball(ball.centre * sign, ball.radii) for k, ball in ends.balls.items()}
    return replace(ends, points=ends.points.conj(), balls=balls)


def _joined(first: Paths, second: Paths) -> Paths:
    """The ends of both, those of the first one before."""
    names = set(first.__dataclass_fields__) - {"balls", "branches"}
    arrays = {n: np.concatenate([getattr(first, n), getattr(second, n)]) for n in names}
    shift = len(first)
    return Paths(**arrays, balls={**first.balls, **{shift + i: b for i, b in second.balls.items()}})
