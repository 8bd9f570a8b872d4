"""Whether polynomials vanish at the exact isolated zero that a point stands for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.algebra.high_precision import DIGITS, all_vanish
from nag.algebra.polynomial import Polynomial
from nag.numerics.singular_point import Place, analyse


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
    from nag.numerics.digits import point, working

    end = analyse(equations, x, accuracy, np.random.default_rng(0))
    if end.place is not Place.ISOLATED:
        return None
    with working(DIGITS):
        return all_vanish(polynomials, point(end.digits))
