"""Whether polynomials vanish at the exact isolated zero that a point stands for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.high_precision import vanish
from nag.algebra.polynomial import Polynomial
from nag.tracking.singular_ends import sharpened


def vanish_at_zero(
    equations: Sequence[Polynomial],
    x: np.ndarray,
    accuracy: float,
    polynomials: Sequence[Polynomial],
) -> bool | None:
    """Whether ``polynomials`` vanish at the isolated zero of ``equations`` near ``x``.

    The zero is made regular by deflation where it is multiple, and computed to 100 digits. None if
    that does not succeed.
    """
    import scipy.linalg

    found = sharpened(equations, x, accuracy, np.random.default_rng(0))
    if found is None:
        return None
    jacobian = Evaluator.of(found.polynomials, len(found.z)).jacobian(found.z)
    _, _, pivots = scipy.linalg.qr(jacobian.T, mode="economic", pivoting=True)
    chosen = sorted(int(p) for p in pivots[: len(found.z)])
    square = [found.polynomials[i] for i in chosen]
    none = np.zeros((0, 1 + len(found.z)))
    return vanish(polynomials, square, none, jacobian[chosen], found.z)
