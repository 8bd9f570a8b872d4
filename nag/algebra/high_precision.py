"""Zeros in high precision, where doubles could be deceived.

In doubles, two zeros at a distance of 1e-8 look like a double one, and a coefficient of 1e-16 looks
like none.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mpmath
import numpy as np

from nag.algebra.number import Number, to_mpf
from nag.algebra.polynomial import Polynomial

DIGITS = 100
# Two zeros nearer to each other than this, relative to their size, are taken for one.
VANISHES = 1e-80
NEWTON_STEPS = 60
# A point that moves by more than this was not known to the digits that it claims.
NEAR = 1e-9


def _number(c: Number) -> Any:
    return to_mpf(c, DIGITS)


def _relative(f: Polynomial, z: Sequence[Any]) -> Any:
    """The size of ``f(z)`` beside its terms, coordinates below one counted as one."""
    sizes = [max(abs(x), mpmath.mpf(1)) for x in z]
    bound = f(sizes, lambda c: abs(_number(c)))
    return abs(f(z, _number)) / bound if bound else mpmath.mpf(0)


def vanish(
    equations: Sequence[Polynomial],
    square: Sequence[Polynomial],
    slices: np.ndarray,
    jacobian: np.ndarray,
    z: np.ndarray,
) -> bool | None:
    """Whether equations vanish at the zero of a square system near a point.

    The zero is computed to `DIGITS` digits by Newton's method with the Jacobian at ``z``.

    Args:
        equations: in the first of the ``N`` variables.
        square: polynomials in ``N`` variables.
        slices: rows on ``(1, z)``, shape ``(N - len(square), 1 + N)``.
        jacobian: of ``square``, each divided by its largest coefficient, at ``z``, shape
            ``(len(square), N)``.
        z: shape ``(N,)``.

    Returns:
        None if there is no such zero near ``z``.
    """
    scales = [max(abs(float(c)) for c in f.terms.values()) for f in square]
    try:
        inverse = np.linalg.inv(np.vstack([jacobian, slices[:, 1:]]))
    except np.linalg.LinAlgError:
        return None
    with mpmath.workdps(DIGITS):
        point = [mpmath.mpc(complex(x)) for x in z]
        rows = [[mpmath.mpc(complex(c)) for c in row] for row in slices]
        last = mpmath.inf
        for _ in range(NEWTON_STEPS):
            values = [f(point, _number) / s for f, s in zip(square, scales, strict=True)]
            values += [
                row[0] + sum(c * x for c, x in zip(row[1:], point, strict=True)) for row in rows
            ]
            size = max(map(abs, values), default=mpmath.mpf(0))
            if size < mpmath.mpf(10) ** (12 - DIGITS):
                break
            step = inverse @ np.array([complex(v / size) for v in values])
            point = [x - size * mpmath.mpc(complex(d)) for x, d in zip(point, step, strict=True)]
            if size > last / 2:
                return None
            last = size
        else:
            return None
        moved = max((abs(x - complex(y)) for x, y in zip(point, z, strict=True)), default=0)
        if moved > NEAR * (1 + float(np.linalg.norm(z))):
            return None
        return all(_relative(f, point[: f.n]) < VANISHES for f in equations)
