"""Simple zeros so close to each other that doubles about them do not say which is meant.

Newton's method from anywhere near leads to one of them, slowly at first: while the others are as
good as at the same place a step leads part of the way. From random places about the points it leads
to each; those that are found are proved, and proved to be distinct, in balls.
"""

from __future__ import annotations

from collections.abc import Sequence

import flint
import numpy as np
from scipy.optimize import linear_sum_assignment

from nag.numerics.ball_boxes import BITS, FineBox, ball_box, holds_conjugate, one_zero
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.newton import newton_to_rest

# Places to begin at, for each zero, and steps from there: each may lead part of the way only.
PLACES, STEPS = 10, 200
EPS = float(np.finfo(float).eps)


def prove_close_zeros(
    system: BallPolynomials, points: np.ndarray, reach: float, rng: np.random.Generator
) -> list[FineBox]:
    """Boxes of as many distinct simple zeros next to points as there are of these, or fewer.

    Args:
        system: as many rows as unknowns.
        points: complex, shape ``(k, n)``, close together.
        reach: how far from the points zeros may be, absolute.
    """
    size = max(float(np.abs(points).max(initial=0.0)), np.finfo(float).tiny)
    spread = float(np.abs(points - points[0]).max(initial=0.0))
    least = 4 * EPS * size
    found: list[FineBox] = []
    for place in range(PLACES * len(points)):
        begin = points[place % len(points)]
        # Distances of all sizes: the points may be zeros of several groups.
        off = least * max(1.0, spread / least) ** rng.random()
        shape = rng.standard_normal(len(begin)) + 1j * rng.standard_normal(len(begin))
        start = [flint.acb(complex(z)) for z in begin + off * shape]
        x = newton_to_rest(system, start, BITS[-1], STEPS)
        box = None if x is None else ball_box(system, x, BITS[-1])
        if box is None or not _near(box, points, reach):
            continue
        if all(one_zero(box, other) is False for other in found):
            found.append(box)
        if len(found) == len(points):
            break
    return found


def _near(box: FineBox, points: np.ndarray, reach: float) -> bool:
    centre = np.array([complex(z) for z in box.centre])
    return bool((np.abs(points - centre).max(axis=1) < reach).any())


def match_boxes(
    boxes: Sequence[FineBox], points: np.ndarray, accuracy: np.ndarray, real: np.ndarray | None
) -> list[FineBox]:
    """One box for each point: the nearest, and of those that are as near one that is as real.

    Args:
        accuracy: estimated relative errors of the points, shape ``(k,)``.
        real: which points are said to be real, shape ``(k,)``, or None.
    """
    size = max(float(np.abs(points).max(initial=0.0)), np.finfo(float).tiny)
    centres = np.array([[complex(z) for z in box.centre] for box in boxes])
    cost = np.abs(points[:, None] - centres).max(axis=2) / size
    if real is not None:
        differs = real[:, None] != np.array([holds_conjugate(box) for box in boxes])
        # What the points' errors leave open decides nothing else.
        unclear = 8 * np.maximum(np.nan_to_num(accuracy, posinf=0.0), EPS)
        cost = cost + differs * unclear[:, None]
    _, chosen = linear_sum_assignment(cost)
    return [boxes[k] for k in chosen.tolist()]
