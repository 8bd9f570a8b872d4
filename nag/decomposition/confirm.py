"""Confirmation of a witness point in high precision, where doubles could be deceived."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.high_precision import vanish
from nag.algebra.polynomial import Polynomial
from nag.decomposition.cutting import ON, Cut
from nag.decomposition.slices import padded

# Above this singular value a zero of as many equations as unknowns needs no confirmation.
REGULAR = 1e-5
# Residuals in doubles below this are rounding.
CERTAIN = 1e-14


def confirmed(cut: Cut, equations: Sequence[Polynomial], rows: np.ndarray, z: np.ndarray) -> bool:
    """Whether the zero of ``cut`` on the slice near ``z`` is one of all ``equations``.

    The square system's zero is computed to 100 digits; there the other equations must vanish too.
    """
    matrix = np.vstack([cut.evaluator.jacobian(z), padded(rows, 1 + len(z))[:, 1:]])
    smallest = np.linalg.svd(matrix, compute_uv=False).min(initial=np.inf)
    if not cut.levels and len(cut.polynomials) == len(equations) and smallest > REGULAR:
        return True
    return _at_zero(cut, equations, rows, z) is True


def vanishing(cut: Cut, f: Polynomial, rows: np.ndarray, points: np.ndarray) -> np.ndarray:
    """At which zeros of ``cut`` on the slice, shape ``(P, n + aux)``, ``f`` vanishes.

    Values that doubles cannot tell from zero for certain are computed to 100 digits: at large
    points a value of one may be small beside its terms.
    """
    residuals = Evaluator.of([f], cut.n).residuals(points[:, : cut.n])[:, 0]
    result = residuals < ON
    for i in np.flatnonzero(result & (residuals > CERTAIN)):
        result[i] = _at_zero(cut, [f], rows, points[i]) is not False
    return result


def _at_zero(
    cut: Cut, equations: Sequence[Polynomial], rows: np.ndarray, z: np.ndarray
) -> bool | None:
    """Whether equations vanish at the zero of ``cut`` near ``z``; None if none was found there."""
    jacobian = cut.evaluator.jacobian(z)
    return vanish(equations, cut.polynomials, padded(rows, 1 + len(z)), jacobian, z)
