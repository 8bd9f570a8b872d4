"""Multiplicity of an isolated zero on a slice: the dimension of its local ring there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.numerics.zero_values import multiplicity_of_all, possible_zeros
from nag.witness.slices import padded

# How well points are known that were sharpened in doubles, by a deflation that may be badly
# conditioned.
ACCURACY = 1e-11


def multiplicity(
    polynomials: Sequence[Polynomial], rows: np.ndarray, x: np.ndarray, rng: np.random.Generator
) -> int:
    """Multiplicity of the zero ``x`` of ``polynomials`` on the slice ``rows``; 0 if not found.

    ``x`` must be known to rounding. Where it may stand for any of several zeros, it is what they
    all have. See `nag.numerics.singular_point.analyse`.
    """
    zeros = possible_zeros(polynomials, x, ACCURACY, rng, padded(rows, 1 + len(x)))
    return multiplicity_of_all(zeros) or 0
