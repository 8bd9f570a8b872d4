"""Whether a regular zero lies at infinity: its homogenising coordinate in many digits.

Coefficients that were rounded at 1e-15 move zeros in from infinity to sizes of 1e15, and where two
such coefficients multiply, of 1e30. What looks infinite in the digits that a path is followed in
is therefore looked at in more.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import log2
from typing import Any

import flint
import numpy as np

from nag.tracking.ends.inclusion import patches_through, system_at
from nag.tracking.ends.terms import Terms, doubles, number
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import Ball, Paths, PathStatus
from nag.tracking.projective import ROUNDING

BITS = 700
# Coordinates of size one that are zero; Newton's method has arrived before a step as small.
ZERO = 1e-150
MOST_STEPS = 12
# Bits in which Newton's method takes its first step, and those that a later one needs beside the
# digits that it brings.
FIRST_BITS, MORE_BITS = 256, 128
# Errors of coordinates of size one in two words.
DOUBLE_DOUBLE = 2.0**-104


def at_infinity(terms: Terms, centre: np.ndarray, coordinates: Sequence[int]) -> bool:
    """Whether one of the coordinates of the regular zero near a point vanishes.

    Args:
        terms: the homotopy's, not yet worked out in fewer digits.
        centre: a point near enough for Newton's method, shape ``(N, 2, words)``.
        coordinates: those that are asked for.
    """
    with flint.ctx.workprec(BITS):
        terms.work_out()
        return _zero(flint, terms, [number(c) for c in centre], coordinates) is not None


def regular_paths(
    homotopy: Homotopy, points: np.ndarray, condition: np.ndarray
) -> tuple[np.ndarray, Paths]:
    """Which points in doubles are near regular zeros at infinity, and the paths that end there.

    Args:
        points: near enough to regular zeros for Newton's method, shape ``(P, N)``.
        condition: of the Jacobian there, shape ``(P,)``.
    """
    terms, balls = Terms(homotopy), {}
    with flint.ctx.workprec(BITS):
        terms.work_out()
        for i, point in enumerate(points.tolist()):
            start = [flint.acb(z) for z in point]
            zero = _zero(flint, terms, start, homotopy.infinity)
            if zero is not None:
                centre = np.array([doubles(z, 2) for z in zero])
                # Numbers as small would leave the range of doubles.
                centre[np.abs(centre[:, :, 0]).max(axis=1) < ZERO] = 0.0
                balls[i] = Ball(centre, np.full(len(zero), DOUBLE_DOUBLE))
    k, centres = len(balls), np.array([ball.centre[:, :, 0] for ball in balls.values()])
    centres = centres.reshape(k, homotopy.N, 2)
    return np.array(list(balls), dtype=np.int64), Paths(
        homotopy.normalized(centres[:, :, 0] + 1j * centres[:, :, 1]),
        np.full(k, PathStatus.AT_INFINITY, dtype=np.int8),
        np.ones(k, dtype=np.int64),
        np.full(k, ROUNDING),
        condition[list(balls)],
        np.zeros(k, dtype=np.int64),
        np.full(k, 32, dtype=np.int16),
        np.zeros(k, dtype=np.int8),
        np.ones(k, dtype=bool),
        dict(enumerate(balls.values())),
    )


def _zero(flint: Any, terms: Terms, x: list[Any], coordinates: Sequence[int]) -> list[Any] | None:
    """The zero near a point, by Newton's method, if one of the coordinates vanishes there.

    The terms must have been worked out in all digits.
    """
    patches, last, bits = patches_through(flint, terms, x), 0.0, FIRST_BITS
    size = max(abs(complex(z.mid())) for z in x)
    for _ in range(MOST_STEPS):
        with flint.ctx.workprec(bits):
            values, jacobian = system_at(flint, terms, patches, x)
            try:
                # Half of the digits are right already.
                with flint.ctx.workprec(bits // 2 + MORE_BITS // 2):
                    step = jacobian.solve(values, algorithm="approx").entries()
            except ZeroDivisionError:
                return None
            x = [(z - change).mid() for z, change in zip(x, step, strict=True)]
        length = max(abs(complex(change)) for change in step) / size
        # The quotient of two steps is squared from one to the next; of one step nothing is known,
        # unless it is as small already.
        arrived = length < ZERO or (length < last and length * (length / last) ** 2 < ZERO)
        if length == 0 or (arrived and bits == BITS):
            vanishes = any(abs(complex(x[j])) < ZERO * size for j in coordinates)
            return x if vanishes else None
        # The next step is about as long as the square of this one, and brings as many digits again.
        last, bits = length, min(BITS, MORE_BITS + int(4 * max(0.0, -log2(length))))
    return None
