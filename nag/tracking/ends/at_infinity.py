"""Whether a regular zero lies at infinity: its homogenising coordinate in many digits.

Coefficients that were rounded at 1e-15 move zeros in from infinity to sizes of 1e15, and where two
such coefficients multiply, of 1e30. What looks infinite in the digits that a path is followed in
is therefore looked at in more.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from nag.tracking.ends.inclusion import patches_through, system_at, values_at
from nag.tracking.ends.terms import Terms, doubles, number
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import Ball, Paths, PathStatus
from nag.tracking.projective import ROUNDING

BITS, ROUGHLY = 700, 280
# Coordinates of size one that are zero; Newton's method has arrived where its step is as small.
ZERO = 1e-150
MOST_STEPS = 12
# Steps from a point in doubles after which another Jacobian saves more steps than it costs.
AGAIN = 2
# How often the digits of an inverse in doubles are doubled for that.
DOUBLINGS = 2
# Errors of coordinates of size one in two words.
DOUBLE_DOUBLE = 2.0**-104


def at_infinity(terms: Terms, centre: np.ndarray, coordinates: Sequence[int]) -> bool:
    """Whether one of the coordinates of the regular zero near a point vanishes.

    Args:
        terms: the homotopy's, not yet worked out in fewer digits.
        centre: a point near enough for Newton's method, shape ``(N, 2, words)``.
        coordinates: those that are asked for.
    """
    import flint

    with flint.ctx.workprec(BITS):
        return _zero(flint, terms, [number(c) for c in centre], coordinates, MOST_STEPS) is not None


def regular_paths(
    homotopy: Homotopy, points: np.ndarray, condition: np.ndarray
) -> tuple[np.ndarray, Paths]:
    """Which points in doubles are near regular zeros at infinity, and the paths that end there.

    Args:
        points: near enough to regular zeros for Newton's method, shape ``(P, N)``.
        condition: of the Jacobian there, shape ``(P,)``.
    """
    import flint

    terms, balls = Terms(homotopy), {}
    with flint.ctx.workprec(BITS):
        for i, point in enumerate(points.tolist()):
            start = [flint.acb(z) for z in point]
            zero = _zero(flint, terms, start, homotopy.infinity, AGAIN)
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


def _zero(
    flint: Any, terms: Terms, x: list[Any], coordinates: Sequence[int], again: int
) -> list[Any] | None:
    """The zero near a point, if one of the coordinates vanishes there.

    By Newton's method with the first point's Jacobian, as it is near enough for that, and after
    ``again`` steps with that of the point reached.
    """
    patches, inverse = patches_through(flint, terms, x), None
    size = max(abs(complex(z.mid())) for z in x)
    for k in range(MOST_STEPS):
        if k in (0, again):
            values, jacobian = system_at(flint, terms, patches, x)
            inverse = _inverse(flint, jacobian.mid(), inverse, again < MOST_STEPS)
            if inverse is None:
                return None
        else:
            values = values_at(flint, terms, patches, x)
        step = (inverse * values.mid()).mid().entries()
        x = [(z - change).mid() for z, change in zip(x, step, strict=True)]
        if max(abs(complex(change)) for change in step) < ZERO * size:
            vanishes = any(abs(complex(x[j])) < ZERO * size for j in coordinates)
            return x if vanishes else None
    return None


def _inverse(flint: Any, matrix: Any, near: Any, rough: bool) -> Any:
    """The inverse of a matrix, or of one near it, in the digits that the point has.

    Args:
        near: an inverse in doubles, or None.
        rough: whether doubles will do.
    """
    N = matrix.nrows()
    with flint.ctx.workprec(ROUGHLY):
        if near is not None:
            twice = flint.acb_mat(N, N, [2 * (i == j) for i in range(N) for j in range(N)])
            for _ in range(DOUBLINGS):
                near = (near * (twice - matrix * near)).mid()
            return near
        try:
            if not rough:
                return matrix.inv().mid()
            entries = np.array([complex(z) for z in matrix.entries()]).reshape(N, N)
            return flint.acb_mat(N, N, np.linalg.inv(entries).ravel().tolist())
        except (ZeroDivisionError, np.linalg.LinAlgError):
            return None
