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
# Times that points are put between others where the tangent turns by more than this cosine, as it
# may in the last step to a fold.
ROUNDS, WIDE = 6, float(np.cos(2 * TURN))


def even_points(
    closure: ProjectiveClosure, points: np.ndarray, turns: Sequence[Turn]
) -> np.ndarray:
    """Normalised points along an arc, its ends kept; the same where they are not found.

    Args:
        points: normalised, neighbours of like signs, shape ``(k, size)``.
    """
    length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    kept = _insert_points(closure, points[_thin_points(points, KEPT * min(CHORD, length / FEWEST))])
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
    guess = _on_cubics(kept, tangents, place, (at - along[place]) / cost[place])
    spacing = np.full(len(at), length / count)
    directions = chords[place] / sizes[place, None]
    found, first, good = bring_to_curve(closure, guess, directions, spacing)
    if not (good & (first < CORRECTION * spacing)).all():
        return points
    return np.vstack([kept[:1], closure.align_signs(found, guess), kept[-1:]])


def _on_cubics(
    points: np.ndarray, tangents: np.ndarray, place: np.ndarray, share: np.ndarray
) -> np.ndarray:
    """Points of the cubics between neighbours: the index of the first, and the share of the way."""
    s = share[:, None]
    size = np.linalg.norm(points[place + 1] - points[place], axis=1)[:, None]
    return (
        (1 + 2 * s) * (1 - s) ** 2 * points[place]
        + s**2 * (3 - 2 * s) * points[place + 1]
        + s * (1 - s) ** 2 * size * tangents[place]
        - s**2 * (1 - s) * size * tangents[place + 1]
    )


def _insert_points(closure: ProjectiveClosure, points: np.ndarray) -> np.ndarray:
    """The points, with others between them where the tangent turns by much."""
    for _ in range(ROUNDS):
        chords = np.diff(points, axis=0)
        sizes = np.linalg.norm(chords, axis=1)
        directions = chords / sizes[:, None]
        tangents = _tangents(closure, points, directions)
        wide = np.flatnonzero((tangents[1:] * tangents[:-1]).sum(axis=1) < WIDE)
        if not len(wide):
            break
        guess = _on_cubics(points, tangents, wide, np.full(len(wide), 0.5))
        spacing = sizes[wide] / 2
        found, first, good = bring_to_curve(closure, guess, directions[wide], spacing)
        good &= first < CORRECTION * spacing
        if not good.any():
            break
        found = closure.align_signs(found, guess)
        points = np.insert(points, wide[good] + 1, found[good], axis=0)
    return points


def _thin_points(points: np.ndarray, least: float) -> list[int]:
    """Indices of points, both ends among them; of those nearer than ``least`` where it turns."""
    chords = np.diff(points, axis=0)
    chords /= np.linalg.norm(chords, axis=1)[:, None]
    turns = np.arccos(np.clip((chords[1:] * chords[:-1]).sum(axis=1), -1, 1))
    kept, turned = [0], 0.0
    for i in range(1, len(points) - 1):
        turned += turns[i - 1]
        apart = (np.linalg.norm(points[i] - points[k]) for k in (kept[-1], -1))
        if min(apart) >= least or turned > TURN:
            kept.append(i)
            turned = 0.0
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
