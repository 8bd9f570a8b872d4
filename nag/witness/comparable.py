"""Coordinates of comparable sizes for what is moved in coordinates of very unequal ones.

A point's largest coordinates hide what Newton's method does to the others, and a generic slice cuts
by them alone: with lengths of 1e-8 beside angles one path in five failed. Scales are powers of two,
so that nothing is rounded.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np

from nag.algebra.number import Number
from nag.witness.close_points import Fine
from nag.witness.fibres import Fibre, Moved, Tracker, move
from nag.witness.slices import evened, unit_complex


def coordinate_sizes(fibre: Fibre) -> np.ndarray:
    """Sizes of the homogeneous coordinates ``(1, x)`` of the set, shape ``(1 + n,)``."""
    return np.ldexp(1.0, np.concatenate([[0], fibre.cut.powers[: fibre.cut.n]]))


def move_together(
    fibres: Sequence[Fibre],
    source: np.ndarray,
    target: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
    endgame: bool = True,
    through: Sequence[Number] = (),
) -> Iterator[tuple[Fibre, Moved]]:
    """Each fibre of a set, of which there are some, and where it is moved when it is asked for.

    The slice moves from the rows ``source`` to the rows ``target``, by a ``gamma`` from ``rng``, in
    coordinates in which those of the set are comparable.

    Args:
        through: an exact point that the target passes through.
    """
    gamma, sizes = complex(unit_complex(rng)), coordinate_sizes(fibres[0])
    rows = evened(source, sizes), evened(target, sizes)
    return ((fibre, _moved(fibre, *rows, gamma, tracker, endgame, through)) for fibre in fibres)


def _moved(
    fibre: Fibre,
    source: np.ndarray,
    target: np.ndarray,
    gamma: complex,
    tracker: Tracker,
    endgame: bool,
    through: Sequence[Number],
) -> Moved:
    powers = fibre.cut.powers
    if not powers.any():
        return move(fibre, source, target, gamma, tracker, endgame, through)
    sizes = coordinate_sizes(fibre)
    fine = {i: _scaled(point, -powers) for i, point in fibre.fine.items()}
    points = fibre.points * np.ldexp(1.0, -powers)
    own = Fibre(fibre.cut.scaled, fibre.dimension, points, fine)
    there = [x * Fraction(2) ** -int(k) for x, k in zip(through, powers, strict=False)]
    ends = move(own, source * sizes, target * sizes, gamma, tracker, endgame, there)
    fine = {i: _scaled(point, powers) for i, point in ends.fine.items()}
    finite = np.where(ends.finite[:, None], ends.points, 0.0)
    return replace(ends, points=finite * np.ldexp(1.0, powers), fine=fine)


def _scaled(point: Fine, powers: np.ndarray) -> Fine:
    return replace(point, words=np.ldexp(point.words, powers[:, None, None]))
