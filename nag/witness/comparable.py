"""Coordinates of comparable sizes for what is moved in coordinates of very unequal ones.

A point's largest coordinates hide what Newton's method does to the others, and a generic slice cuts
by them alone: with lengths of 1e-8 beside angles one path in five failed. Scales are powers of two,
so that nothing is rounded.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nag.witness.close_points import Fine
from nag.witness.fibres import Fibre, Moved, Tracker, move


def coordinate_sizes(fibre: Fibre) -> np.ndarray:
    """Sizes of the homogeneous coordinates ``(1, x)`` of the set, shape ``(1 + n,)``."""
    return np.ldexp(1.0, np.concatenate([[0], fibre.cut.powers[: fibre.cut.n]]))


def move_comparable(
    fibre: Fibre,
    source: np.ndarray,
    target: np.ndarray,
    gamma: complex,
    tracker: Tracker,
    endgame: bool = False,
) -> Moved:
    """`move`, in coordinates in which those of the set are comparable."""
    powers = fibre.cut.powers
    if not powers.any():
        return move(fibre, source, target, gamma, tracker, endgame)
    sizes = coordinate_sizes(fibre)
    fine = {i: _scaled(point, -powers) for i, point in fibre.fine.items()}
    points = fibre.points * np.ldexp(1.0, -powers)
    own = Fibre(fibre.cut.scaled, fibre.dimension, points, fine)
    ends = move(own, source * sizes, target * sizes, gamma, tracker, endgame)
    fine = {i: _scaled(point, powers) for i, point in ends.fine.items()}
    finite = np.where(ends.finite[:, None], ends.points, 0.0)
    return replace(ends, points=finite * np.ldexp(1.0, powers), fine=fine)


def _scaled(point: Fine, powers: np.ndarray) -> Fine:
    return replace(point, words=np.ldexp(point.words, powers[:, None, None]))
