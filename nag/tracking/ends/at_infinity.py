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
from nag.tracking.ends.terms import Terms, number

BITS, ROUGHLY = 700, 280
# Coordinates of size one that are zero; Newton's method has arrived where its step is as small.
ZERO = 1e-150
MOST_STEPS = 12


def at_infinity(terms: Terms, centre: np.ndarray, coordinates: Sequence[int]) -> bool:
    """Whether one of the coordinates of the regular zero near a point vanishes.

    Args:
        terms: the homotopy's, not yet worked out in fewer digits.
        centre: a point near enough for Newton's method, shape ``(N, 2, words)``.
        coordinates: those that are asked for.
    """
    import flint

    bits = flint.ctx.prec
    try:
        flint.ctx.prec = BITS
        return _vanishes(flint, terms, [number(c) for c in centre], coordinates)
    finally:
        flint.ctx.prec = bits


def _vanishes(flint: Any, terms: Terms, x: list[Any], coordinates: Sequence[int]) -> bool:
    """By Newton's method with the first point's Jacobian, as it is near enough for that."""
    patches = patches_through(flint, terms, x)
    size = max(abs(complex(z.mid())) for z in x)
    values, jacobian = system_at(flint, terms, patches, x)
    try:
        # More digits than the point has would gain nothing.
        flint.ctx.prec = ROUGHLY
        inverse = jacobian.mid().inv().mid()
    except ZeroDivisionError:
        return False
    finally:
        flint.ctx.prec = BITS
    for _ in range(MOST_STEPS):
        step = (inverse * values.mid()).mid().entries()
        x = [(z - change).mid() for z, change in zip(x, step, strict=True)]
        if max(abs(complex(change)) for change in step) < ZERO * size:
            return any(abs(complex(x[j])) < ZERO * size for j in coordinates)
        values = values_at(flint, terms, patches, x)
    return False
