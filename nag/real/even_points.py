"""Points at even distances along an arc, from those that tracing left in uneven ones.

Between two of them the arc is next to the cubic with the same ends and tangents; Newton's method
brings its points to the curve.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.real.arc_tracing import CORRECTION, bring_to_curve, tangents_at
from nag.real.closure import ProjectiveClosure
from nag.real.curve import Turn, chart_of

# Chord of normalised points, turn of the tangent and change of a half-angle between two points.
CHORD, TURN, HALF_ANGLE = 0.05, 0.1, 0.1
# Fewest points of an arc; and distance of points that are kept, beside that of points that are made
# at the same length.
FEWEST, KEPT = 24, 0.2


def even_points(
    closure: ProjectiveClosure, points: np.ndarray, turns: Sequence[Turn]
) -> np.ndarray:
    """Normalised points along an arc, its ends kept; the same where they are not found.

    Args:
        points: normalised, neighbours of like signs, shape ``(k, size)``.
    """
    length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    kept = points[_thinned(points, KEPT * min(CHORD, length / FEWEST))]
    chords = np.diff(kept, axis=0)
    sizes = np.linalg.norm(chords, axis=1)
    tangents = _tangents(closure, kept, chords / sizes[:, None])
    cosines = np.clip((tangents[1:] * tangents[:-1]).sum(axis=1), -1, 1)
    cost = sizes / CHORD + np.arccos(cosines) / TURN
    if turns:
        angles = chart_of(closure.affine(kept), turns)[:, [t.variable for t in turns]]
        cost = cost + np.abs(np.diff(angles, axis=0)).max(axis=1) / HALF_ANGLE
    along = np.concatenate([[0], np.cumsum(cost)])
    count = max(FEWEST, int(np.ceil(along[-1])) + 1)
    at = np.linspace(0, along[-1], count)[1:-1]
    place = np.clip(np.searchsorted(along, at, side="right") - 1, 0, len(sizes) - 1)
    s = ((at - along[place]) / cost[place])[:, None]
    size = sizes[place, None]
    guess = (
        (1 + 2 * s) * (1 - s) ** 2 * kept[place]
        + s**2 * (3 - 2 * s) * kept[place + 1]
        + s * (1 - s) ** 2 * size * tangents[place]
        - s**2 * (1 - s) * size * tangents[place + 1]
    )
    spacing = np.full(len(at), length / count)
    found, first, good = bring_to_curve(closure, guess, chords[place] / size, spacing)
    if not (good & (first < CORRECTION * spacing)).all():
        return points
    return np.vstack([kept[:1], closure.aligned(found, guess), kept[-1:]])


def _thinned(points: np.ndarray, least: float) -> list[int]:
    """Indices of points that are not nearer to each other than ``least``, both ends among them."""
    kept = [0]
    for i in range(1, len(points) - 1):
        apart = (np.linalg.norm(points[i] - points[k]) for k in (kept[-1], -1))
        if min(apart) >= least:
            kept.append(i)
    return [*kept, len(points) - 1]


def _tangents(closure: ProjectiveClosure, points: np.ndarray, chords: np.ndarray) -> np.ndarray:
    """Unit tangents; at the ends, where the curve may be singular, those of a parabola."""
    if len(points) == 2:
        return np.vstack([chords, chords])
    near = chords[1:] + chords[:-1]
    inner = tangents_at(closure, points[1:-1], near / np.linalg.norm(near, axis=1)[:, None])
    ends = np.vstack([2 * chords[0] - inner[0], 2 * chords[-1] - inner[-1]])
    ends /= np.linalg.norm(ends, axis=1)[:, None]
    return np.vstack([ends[:1], inner, ends[1:]])
