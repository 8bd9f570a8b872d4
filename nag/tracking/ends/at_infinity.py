"""Whether a regular zero lies at infinity: its homogenising coordinate in many digits.

Coefficients that were rounded at 1e-15 move zeros in from infinity to sizes of 1e15, and where two
such coefficients multiply, of 1e30. What looks infinite in the digits that a path is followed in
is therefore looked at in more.
"""

from __future__ import annotations

from collections.abc import Sequence

import flint
import numpy as np

from nag.numerics.digits import log_norm, log_size, number_of_words, words_of_number
from nag.numerics.newton import find_zero
from nag.tracking.ends.terms import Terms
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import Ball, Paths, PathStatus
from nag.tracking.projective import ROUNDING

# Digits that zeros are worked out to, and bits of the patches through the points they are near.
DIGITS, BITS = 152, 700
# Decides: Decimal logarithm of coordinates, beside the largest, that are zero in 160 digits.
ZERO = -150.0
# Errors of coordinates of size one in two words.
DOUBLE_DOUBLE = 2.0**-104


def at_infinity(terms: Terms, centre: np.ndarray, coordinates: Sequence[int]) -> bool:
    """Whether one of the coordinates of the regular zero near a point vanishes.

    Args:
        terms: the homotopy's.
        centre: a point near enough for Newton's method, shape ``(N, 2, words)``.
        coordinates: those that are asked for.
    """
    return _zero_at_infinity(terms, [number_of_words(c) for c in centre], coordinates) is not None


def regular_paths(
    homotopy: Homotopy, points: np.ndarray, condition: np.ndarray
) -> tuple[np.ndarray, Paths]:
    """Which points in doubles are near regular zeros at infinity, and the paths that end there.

    Args:
        points: near enough to regular zeros for Newton's method, shape ``(P, N)``.
        condition: of the Jacobian there, shape ``(P,)``.
    """
    terms, balls = Terms(homotopy), {}
    for i, point in enumerate(points.tolist()):
        zero = _zero_at_infinity(terms, [flint.acb(z) for z in point], homotopy.infinity)
        if zero is not None:
            centre = np.array([words_of_number(z, 2) for z in zero])
            # Numbers as small would leave the range of doubles.
            centre[np.abs(centre[:, :, 0]).max(axis=1) < 10.0**ZERO] = 0.0
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


def _zero_at_infinity(
    terms: Terms, x: list[flint.acb], coordinates: Sequence[int]
) -> list[flint.acb] | None:
    """The zero near a point, by Newton's method, if one of the coordinates vanishes there."""
    zero = find_zero(terms.with_patches(x, BITS), x, DIGITS)
    if zero is None:
        return None
    least = log_norm(zero.point) + ZERO
    return zero.point if any(log_size(zero.point[j]) < least for j in coordinates) else None
