"""Confirmation of a witness point in high precision, where doubles could be deceived."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mpmath
import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.number import Number, to_mpf
from nag.algebra.polynomial import Polynomial
from nag.decomposition.cutting import ON, Cut
from nag.decomposition.slices import padded

DIGITS = 60
# Two zeros nearer to each other than this, relative to their size, are taken for one.
VANISHES = 1e-40
NEWTON_STEPS = 60
# Above this singular value a zero of as many equations as unknowns needs no confirmation; a point
# that moves by more than this was not known to the digits that it claims.
REGULAR = 1e-5
NEAR = 1e-9
# Residuals in doubles below this are rounding.
CERTAIN = 1e-14


def _number(c: Number) -> Any:
    return to_mpf(c, DIGITS)


def _relative(f: Polynomial, z: Sequence[Any]) -> Any:
    """The size of ``f(z)`` beside its terms, coordinates below one counted as one."""
    sizes = [max(abs(x), mpmath.mpf(1)) for x in z]
    bound = f(sizes, lambda c: abs(_number(c)))
    return abs(f(z, _number)) / bound if bound else mpmath.mpf(0)


def confirmed(cut: Cut, equations: Sequence[Polynomial], rows: np.ndarray, z: np.ndarray) -> bool:
    """Whether the zero of ``cut`` on the slice near ``z`` is one of all ``equations``.

    The square system's zero is computed to `DIGITS` digits; there the other equations must vanish
    too. In doubles, two zeros at a distance of 1e-8 look like a double one, and a coefficient of
    1e-16 looks like none.
    """
    matrix = np.vstack([cut.evaluator.jacobian(z), padded(rows, 1 + len(z))[:, 1:]])
    smallest = np.linalg.svd(matrix, compute_uv=False).min(initial=np.inf)
    if not cut.levels and len(cut.polynomials) == len(equations) and smallest > REGULAR:
        return True
    return _vanish(cut, equations, rows, z) is True


def vanishing(cut: Cut, f: Polynomial, rows: np.ndarray, points: np.ndarray) -> np.ndarray:
    """At which zeros of ``cut`` on the slice, shape ``(P, n + aux)``, ``f`` vanishes.

    Values that doubles cannot tell from zero for certain are computed to `DIGITS` digits: at large
    points a value of one may be small beside its terms.
    """
    residuals = Evaluator.of([f], cut.n).residuals(points[:, : cut.n])[:, 0]
    result = residuals < ON
    for i in np.flatnonzero(result & (residuals > CERTAIN)):
        result[i] = _vanish(cut, [f], rows, points[i]) is not False
    return result


def _vanish(
    cut: Cut, equations: Sequence[Polynomial], rows: np.ndarray, z: np.ndarray
) -> bool | None:
    """Whether equations vanish at the zero of ``cut`` near ``z``; None if none was found there.

    Newton's method keeps the Jacobian at ``z``.
    """
    n = cut.n
    a = padded(rows, 1 + len(z))
    matrix = np.vstack([cut.evaluator.jacobian(z), a[:, 1:]])
    scales = [max(abs(float(c)) for c in f.terms.values()) for f in cut.polynomials]
    try:
        inverse = np.linalg.inv(matrix)
    except np.linalg.LinAlgError:
        return None
    with mpmath.workdps(DIGITS):
        point = [mpmath.mpc(complex(x)) for x in z]
        slices = [[mpmath.mpc(complex(c)) for c in row] for row in a]
        last = mpmath.inf
        for _ in range(NEWTON_STEPS):
            values = [f(point, _number) / s for f, s in zip(cut.polynomials, scales, strict=True)]
            values += [
                row[0] + sum(c * x for c, x in zip(row[1:], point, strict=True)) for row in slices
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
        return all(_relative(f, point[:n]) < VANISHES for f in equations)
