"""Multiplicity of an isolated zero on a slice: the dimension of its local ring there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.decomposition.slices import padded
from nag.numerics.singular_point import Place, analyse

# How well points are known that were sharpened in doubles, by a deflation that may be badly
# conditioned.
ACCURACY = 1e-11


def multiplicity(
    polynomials: Sequence[Polynomial], rows: np.ndarray, x: np.ndarray, rng: np.random.Generator
) -> int:
    """Multiplicity of the zero ``x`` of ``polynomials`` on the slice ``rows``; 0 if not found.

    ``x`` must be known to rounding. See `nag.numerics.singular_point.analyse`.
    """
    end = analyse(polynomials, x, ACCURACY, rng, padded(rows, 1 + len(x)))
    return end.multiplicity if end.place is Place.ISOLATED else 0
