"""Paths that start so near to each other that doubles lose them: tracked in more digits throughout.

Newton's method converges to one of two zeros only from within a small part of their distance. What
doubles round, or a predictor misses, must be less than that on the whole way, so such paths are
followed in double-double or quad-double from their starts on, in steps that their distance allows.
"""

from __future__ import annotations

import numpy as np

from nag.tracking.compiled import CompiledRows, Terms
from nag.tracking.ends.follow import DIGITS, follow_whole
from nag.tracking.homotopy import Homotopy
from nag.tracking.jumps import collisions
from nag.tracking.paths import Paths, PathStatus
from nag.tracking.settings import Settings, named
from nag.tracking.track import merged, without

# Words of a start point, and Newton's constant above which double-double is not tried first.
WORDS, STEEP = 4, 1e11


def moving_rows(
    rows: CompiledRows, source: np.ndarray, target: np.ndarray, gamma: complex
) -> Homotopy:
    """``t gamma source + (1 - t) target`` beside fixed rows, in coefficients that nothing rounds.

    Args:
        rows: the fixed ones, of one group of coordinates.
        source, target: linear rows, shape ``(k, N)``.
    """
    parts = list(rows.parts)
    for pair in zip(source, target, strict=True):
        parts.append(tuple((1 + i, _linear(row)) for i, row in enumerate(pair)))
    degrees = np.vstack([rows.degrees, np.ones((len(source), 1), dtype=np.int64)])
    whole = CompiledRows(rows.N, tuple(parts), rows.groups, rows.infinity, degrees)
    return Homotopy(whole, factors=((1, 0), (0, gamma), (1, -1)))


def _linear(row: np.ndarray) -> Terms:
    units = np.eye(len(row), dtype=int).tolist()
    return {tuple(e): complex(c) for e, c in zip(units, row, strict=True)}


def track_close(
    homotopy: Homotopy,
    starts: np.ndarray,
    curvature: np.ndarray,
    settings: Settings | str = "default",
    threads: int = 1,
    *,
    endgame: bool = True,
) -> Paths:
    """Track paths whose starts are known to many digits, from t = 1 to t = 0.

    Args:
        homotopy: what to track.
        starts: points at t = 1 as sums of four doubles, of norms about one, pairwise distinct,
            shape ``(P, N, 2, 4)``.
        curvature: estimates of Newton's constant there, as of the inverse distance to the next
            point, shape ``(P,)``.
        endgame: False where a path that does not end regularly has failed.

    Returns:
        The paths, whose regular ends are balls.
    """
    chosen, curvature = named(settings), np.array(curvature, dtype=float)
    words = min(DIGITS) if (curvature < STEEP).all() else WORDS
    paths = follow_whole(homotopy, starts[..., :words], curvature, chosen, threads)
    failed = paths.where(PathStatus.FAILED)
    if words < WORDS and len(failed):
        again = follow_whole(homotopy, starts[failed], curvature[failed], chosen, threads)
        paths = merged(paths, again, failed)
    if not endgame:
        paths = without(paths, paths.where(PathStatus.SINGULAR))
    return without(paths, collisions(homotopy, paths))
