"""Paths that start so near to each other that doubles lose them: tracked in more digits throughout.

Newton's method converges to one of two zeros only from within a small part of their distance. What
doubles round, or a predictor misses, must be less than that on the whole way, so such paths are
followed in two, four or eight words from their starts on, in steps that their distance allows.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from nag.algebra.number import Number
from nag.numerics.digits import WORDS
from nag.tracking.compiled import CompiledRows, Terms
from nag.tracking.ends.follow import DIGITS, follow_whole
from nag.tracking.homotopy import Homotopy
from nag.tracking.jumps import collisions
from nag.tracking.paths import Paths, PathStatus
from nag.tracking.settings import Settings, find_settings

# Newton's constant above which double-double is not tried first.
STEEP = 1e11


def moving_rows(
    rows: CompiledRows,
    source: np.ndarray,
    target: np.ndarray,
    gamma: complex,
    through: Sequence[Number] = (),
) -> Homotopy:
    """``t gamma source + (1 - t) target`` beside fixed rows, in coefficients that nothing rounds.

    Args:
        rows: the fixed ones, of one group of coordinates.
        source, target: linear rows, shape ``(k, N)``.
        through: the first affine coordinates of an exact point that the target passes through,
            those that it does not depend on left out: its constants are worked out from them.
    """
    moving = []
    for first, second in zip(source, target, strict=True):
        ends = _through(second, through) if len(through) else (_linear(second),)
        moving.append(tuple((1 + i, terms) for i, terms in enumerate((_linear(first), *ends))))
    degrees = np.vstack([rows.degrees, np.ones((len(source), 1), dtype=np.int64)])
    parts = (*rows.parts, *moving)
    whole = CompiledRows(rows.N, parts, rows.groups, rows.infinity, degrees)
    factors = ((1, 0), (0, gamma), (1, -1), (1j, -1j))[: whole.part_count]
    # The slice's own digits are random ones.
    return Homotopy(whole, factors=factors, digits=rows.digits if len(through) else None)


def _through(row: np.ndarray, point: Sequence[Number]) -> tuple[Terms, Terms]:
    """The real and the imaginary part of a linear row with its constant such that it vanishes."""
    units, parts = np.eye(len(row), dtype=int).tolist(), []
    for values in (row.real.tolist(), row.imag.tolist()):
        slopes = [Fraction(value) for value in values[1:]]
        constant = -sum((a * x for a, x in zip(slopes, point, strict=False)), Fraction(0))
        coefficients = zip(units, (constant, *slopes), strict=True)
        parts.append({tuple(e): c for e, c in coefficients})
    return parts[0], parts[1]


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
    chosen, curvature = find_settings(settings), np.array(curvature, dtype=float)
    first = min(DIGITS) if (curvature < STEEP).all() else WORDS
    paths = _follow_in(first, homotopy, starts, curvature, chosen, threads, endgame)
    for words in (words for words in DIGITS if words > first):
        failed = paths.where(PathStatus.FAILED)
        if not len(failed):
            break
        own = starts[failed], curvature[failed]
        again = _follow_in(words, homotopy, *own, chosen, threads, endgame)
        paths = paths.track_again(failed, again)
    return paths.mark_failed(collisions(homotopy, paths))


def _follow_in(
    words: int,
    homotopy: Homotopy,
    starts: np.ndarray,
    curvature: np.ndarray,
    settings: Settings,
    threads: int,
    endgame: bool,
) -> Paths:
    """The paths in one arithmetic; words that starts lack are Newton's method's to find."""
    own = np.zeros((*starts.shape[:-1], words))
    known = min(words, starts.shape[-1])
    own[..., :known] = starts[..., :known]
    paths = follow_whole(homotopy, own, curvature, settings, threads)
    return paths if endgame else paths.mark_failed(paths.where(PathStatus.SINGULAR))
