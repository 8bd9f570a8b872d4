"""Arcs of a real curve, traced over intervals of a pencil, all together.

Over the interval between the points ``P0`` and ``P1`` of the pencil, the arc over
``(1 - s) P0 + s P1`` is followed from the middle towards both ends, in arc length. How far it has
come is told by the angle ``a`` with ``s = (1 - cos a) / 2``: near a fold at an end the points are
smooth functions of it, as they are no longer of ``s``. Newton's method is that of Gauss on all
equations of the curve: there may be more than are needed, and at real points no choice of some of
them is generic.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nag.errors import ComponentError
from nag.numerics.double_newton import Stop, find_zeros, newton_steps
from nag.numerics.doubles import SHARP
from nag.real.closure import ProjectiveClosure

# First step in the angle and the largest one, and the least in arc length beside the first.
FIRST, LARGEST, LEAST = 0.02, 0.2, 1e-8
# Cosine of the largest turn of the tangent in a step, and longest chord of normalised points.
TURN, CHORD = 0.98, 0.15
# First corrections beside the step.
CORRECTION = 0.1
# Decides: Newton's second correction beside the first, where another branch is as many times as far
# as the point is off.
SHRINK = 0.05
# Part of what a step may be off and turn that makes the next one longer.
EASY = 0.25
# Decides: By how much slopes may change in a step, in units in which they are 1 where it begins:
# where they change by as much as they are, another branch may be next to the point that is found.
CHANGE = 0.5
# How far before a place where the equations are singular, but not the curve, that is stepped over;
# distance from the tangent beside that; and step below which that is done where places are unknown.
JUMP, ASIDE, BLIND = 0.02, 0.1, 1e-5
# Part of a step that rounding may move a point by.
MOVED = 1e-2
# Difference from an angle from which Newton's method leads there.
REACHED = 1e-4


class TracingError(ComponentError):
    """An arc that was lost, with the reason."""


@dataclass(frozen=True, eq=False)
class Intervals:
    """Intervals of the pencil, one for each arc.

    Attributes:
        first, last: homogeneous points ``P0`` and ``P1``, shape ``(E, 2)``.
    """

    first: np.ndarray
    last: np.ndarray

    def only(self, chosen: np.ndarray) -> Intervals:
        """Some of them."""
        return Intervals(self.first[chosen], self.last[chosen])

    def at(self, angles: np.ndarray) -> np.ndarray:
        """Points of the pencil, shape ``(E, 2)``."""
        s = np.sin(angles / 2)[:, None] ** 2
        return (1 - s) * self.first + s * self.last

    def angles(self, values: np.ndarray) -> np.ndarray:
        """Angles of points at which ``A`` and ``B`` have these values, shape ``(E, 2)``.

        Beyond an end they are negative, or larger than a half turn.
        """
        a, b = values.T
        # The pencil's point is (B : A): s is where it is between the ends.
        low = self.first[:, 0] * a - self.first[:, 1] * b
        high = self.last[:, 0] * a - self.last[:, 1] * b
        s = low / (low - high)
        inside = 2 * np.arcsin(np.sqrt(np.clip(s, 0, 1)))
        return np.where(s < 0, -1.0, np.where(s > 1, np.pi + 1, inside))

    def slopes(self, angles: np.ndarray) -> np.ndarray:
        """Their derivatives by the angle."""
        return (np.sin(angles) / 2)[:, None] * (self.last - self.first)


def trace_arcs(
    closure: ProjectiveClosure,
    intervals: Intervals,
    starts: np.ndarray,
    begin: np.ndarray,
    end: np.ndarray,
    crossed: np.ndarray | None = None,
) -> list[tuple[np.ndarray, np.ndarray]]:
    """The arcs from angles to others: for each its angles, and its points, normalised.

    Steps are in arc length: angles do not tell points well where a fold is near to a node.

    Args:
        starts: homogeneous real points, shape ``(E, size)``.
        begin, end: angles, shape ``(E,)``.
        crossed: smooth points of the curve at which its equations are singular, as another one
            crosses it there, shape ``(K, size)``; None where they are not known.

    Raises:
        TracingError: if steps become too short, or angles do not grow.
    """
    count = len(starts)
    sense = np.sign(end - begin)
    angle, x = begin.astype(float).copy(), closure.normalise(starts)
    speeds = _speeds(closure, intervals, angle, x) * sense[:, None]
    lengths = np.linalg.norm(speeds, axis=1)
    if not (np.isfinite(lengths) & (lengths > 0)).all():
        raise TracingError("an arc does not begin")
    tangent, step = speeds / lengths[:, None], FIRST * lengths
    forward = np.sign(_crossing(closure, intervals, angle, x, tangent))
    least, bend = LEAST * step, np.zeros_like(x)
    angles = [[a] for a in angle]
    points = [[p] for p in x.copy()]
    active = np.arange(count)
    tried = np.zeros(count, dtype=bool)
    while len(active):
        over = _steps_over(closure, x[active], tangent[active], step[active], crossed)
        over[tried[active]] = 0
        h, old = np.where(over > 0, over, step[active]), angle[active]
        guess = x[active] + h[:, None] * tangent[active] + (h**2 / 2)[:, None] * bend[active]
        found, first, good = bring_to_curve(closure, guess, tangent[active], h)
        found = closure.align_signs(found, x[active])
        chord = np.linalg.norm(found - x[active], axis=1)
        there = intervals.only(active).angles(closure.values(found)[:, -2:])
        next_ = tangents_at(closure, found, tangent[active])
        cosine = (next_ * tangent[active]).sum(axis=1)
        gain = (there - old) * sense[active]
        good &= (first <= CORRECTION * h + SHARP) & (chord < CHORD) & (cosine > TURN)
        good &= (gain > 0) & (gain < LARGEST)
        change = _change_of_slopes(closure, x[active], tangent[active], found)
        good &= (change < CHANGE) | (over > 0)
        # Beyond a fold the arc would lead back.
        crossing = _crossing(closure, intervals.only(active), there, found, next_)
        good &= crossing * forward[active] > 0
        left = (end[active] - old) * sense[active]
        beyond = gain > left + REACHED
        taken = active[good & ~beyond]
        some = good & ~beyond
        tried[active] = ~some & ((over > 0) | tried[active])
        bend[taken] = (next_[some] - tangent[taken]) / h[some, None]
        angle[taken], x[taken], tangent[taken] = there[some], found[some], next_[some]
        for i in taken:
            angles[i].append(angle[i])
            points[i].append(x[i].copy())
        easy = (first < EASY * CORRECTION * h) & (cosine > 1 - EASY * (1 - TURN))
        easy &= (chord < CHORD / 2) & (gain < LARGEST / 2) & (change < CHANGE / 2)
        # Nearly all of the way to the end, and then all of it.
        shorter = np.where(good & beyond, h * left / np.where(gain > 0, gain, 1), h / 3)
        longer = np.where(easy & (over == 0), 2 * h, np.where(over > 0, h / 4, h))
        step[active] = np.where(some, longer, shorter)
        if (step[active] < least[active]).any():
            raise TracingError("an arc was lost: steps became too short")
        active = active[np.abs(end[active] - angle[active]) > REACHED]
    landed = _land(closure, intervals, end, x)
    for own, last in zip(points, landed, strict=True):
        own[-1] = last
    return [(np.array(a), np.array(p)) for a, p in zip(angles, points, strict=True)]


def _matrices(
    closure: ProjectiveClosure, x: np.ndarray, normal: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Values and slopes of the equations, of patches and of a hyperplane through each point."""
    slopes, values = closure.jacobians(x)[:, :-2], closure.values(x)[:, :-2]
    patches = np.zeros((len(x), len(closure.groups), closure.size))
    for g in range(len(closure.groups)):
        patches[:, g] = np.where(closure.group_of == g, x, 0)
    matrix = np.concatenate([slopes, patches, normal[:, None]], axis=1)
    right = np.concatenate([values, np.zeros((len(x), len(closure.groups) + 1))], axis=1)
    return right, matrix


def _steps_over(
    closure: ProjectiveClosure,
    x: np.ndarray,
    tangent: np.ndarray,
    step: np.ndarray,
    crossed: np.ndarray | None,
) -> np.ndarray:
    """Steps over places ahead where the equations are singular; 0 where there is none.

    No step towards them would be short enough, though the curve itself is smooth.
    """
    if crossed is None:
        return np.where(step < BLIND, 8 * BLIND, 0.0)
    over = np.zeros(len(x))
    for place in crossed:
        gap = closure.align_signs(np.repeat(place[None], len(x), axis=0), x) - x
        ahead = (gap * tangent).sum(axis=1)
        aside = np.linalg.norm(gap - ahead[:, None] * tangent, axis=1)
        near = (ahead > 0) & (ahead < JUMP) & (aside < ASIDE * ahead)
        over = np.where(near & ((over == 0) | (2 * ahead < over)), 2 * ahead, over)
    return over


def are_one_step(closure: ProjectiveClosure, points: np.ndarray, goal: np.ndarray) -> np.ndarray:
    """Whether a smooth point is one step away from others along the curve, shape ``(P,)``.

    Args:
        points: normalised real points, shape ``(P, size)``; goal: one more, shape ``(size,)``.
    """
    goals = closure.align_signs(np.repeat(goal[None], len(points), axis=0), points)
    tangents = tangents_at(closure, points, goals - points)
    return _change_of_slopes(closure, points, tangents, goals) < CHANGE


@np.errstate(all="ignore")
def _change_of_slopes(
    closure: ProjectiveClosure, x: np.ndarray, tangent: np.ndarray, found: np.ndarray
) -> np.ndarray:
    """By how much the equations' slopes differ at other points, whatever the equations' scales.

    The norm of ``M(x)^-1 (J(y) - J(x))``, with ``M`` of `_matrices`, shape ``(P,)``; below 1
    Newton's method with ``M(x)`` contracts along the chord (Kantorovich): no two branches meet it.
    """
    _, matrix = _matrices(closure, x, tangent)
    rows = len(closure.equations) - 2
    apart = closure.jacobians(found)[:, :rows] - matrix[:, :rows]
    q, r = np.linalg.qr(matrix)
    product = np.einsum("pij,pik->pjk", q[:, :rows], apart)
    diagonal = np.abs(np.diagonal(r, axis1=1, axis2=2)).min(axis=1)
    safe = (diagonal > 0) & np.isfinite(product).all(axis=(1, 2))
    result = np.full(len(x), np.inf)
    if safe.any():
        result[safe] = np.linalg.norm(np.linalg.solve(r[safe], product[safe]), 2, axis=(1, 2))
    return result


@np.errstate(all="ignore")
def bring_to_curve(
    closure: ProjectiveClosure, x: np.ndarray, tangent: np.ndarray, step: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points of the curve across tangents from guesses, first corrections, and success."""
    ends = find_zeros(
        lambda x, which: _matrices(closure, x, tangent[which]),
        closure.normalise(x),
        stop=Stop(rounding=np.maximum(SHARP, MOVED * step), shrinking=SHRINK),
    )
    return closure.normalise(ends.x), ends.first, ends.converged


@np.errstate(all="ignore")
def tangents_at(closure: ProjectiveClosure, x: np.ndarray, near: np.ndarray) -> np.ndarray:
    """Unit tangents in the sense of others."""
    right, matrix = _matrices(closure, x, near)
    right[:] = 0
    right[:, -1] = 1
    found = newton_steps(right, matrix)
    return np.nan_to_num(found / np.linalg.norm(found, axis=1)[:, None])


@np.errstate(all="ignore")
def _crossing(
    closure: ProjectiveClosure,
    intervals: Intervals,
    angles: np.ndarray,
    x: np.ndarray,
    tangent: np.ndarray,
) -> np.ndarray:
    """How fast tangents cross the pencil's hyperplanes; of another sign beyond a fold."""
    slopes = closure.jacobians(x)
    pencil = intervals.at(np.clip(angles, 0, np.pi))
    normal = pencil[:, 1:] * slopes[:, -1] - pencil[:, :1] * slopes[:, -2]
    return (normal * tangent).sum(axis=1)


@np.errstate(all="ignore")
def _speeds(
    closure: ProjectiveClosure, intervals: Intervals, angles: np.ndarray, x: np.ndarray
) -> np.ndarray:
    """Derivatives of points by the angle."""
    right, matrix = _over(closure, intervals.at(angles), x)
    values, change = closure.values(x), intervals.slopes(angles)
    right[:] = 0
    right[:, -1] = change[:, 0] * values[:, -2] - change[:, 1] * values[:, -1]
    return newton_steps(right, matrix)


def _land(
    closure: ProjectiveClosure, intervals: Intervals, angles: np.ndarray, x: np.ndarray
) -> np.ndarray:
    """Points over angles, from such as are next to them."""
    pencil = intervals.at(angles)
    ends = find_zeros(lambda x, which: _over(closure, pencil[which], x), x)
    return closure.align_signs(closure.normalise(ends.x), x)


def _over(
    closure: ProjectiveClosure, pencil: np.ndarray, x: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """As `_matrices`, with the pencil's hyperplane."""
    slopes, values = closure.jacobians(x), closure.values(x)
    p, q = pencil[:, :1], pencil[:, 1:]
    right, matrix = _matrices(closure, x, q * slopes[:, -1] - p * slopes[:, -2])
    right[:, -1] = q[:, 0] * values[:, -1] - p[:, 0] * values[:, -2]
    return right, matrix
