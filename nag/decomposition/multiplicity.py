"""Multiplicity of an isolated zero on a slice: the dimension of its local ring there."""

from __future__ import annotations

import numpy as np
import scipy.linalg

from nag.algebra.evaluation import Evaluator
from nag.algebra.local_ring import local_dimension
from nag.decomposition.cutting import numerical_corank
from nag.decomposition.slices import padded

# Relative size of singular values that count as zero at a point known to rounding.
ZERO = 1e-8


def multiplicity(evaluator: Evaluator, rows: np.ndarray, x: np.ndarray) -> int:
    """Multiplicity of the zero ``x`` of ``evaluator`` on the slice ``rows``; 0 if not found.

    ``x`` must be known to rounding. See `nag.algebra.local_ring.local_dimension`.
    """
    a = padded(rows, 1 + len(x))[:, 1:]
    along = scipy.linalg.null_space(a) if len(a) else None
    scaled, z = _in_unit_box(evaluator, x)
    return local_dimension(scaled, z, lambda s, k: numerical_corank(s, k, ZERO), along) or 0


def _in_unit_box(evaluator: Evaluator, x: np.ndarray) -> tuple[Evaluator, np.ndarray]:
    """The equations and the point in coordinates, larger by a power of two, that are at most one.

    At a large point the rounding errors of terms of high degree are no small numbers.
    """
    power = max(0, int(np.ceil(np.log2(np.abs(x).max(initial=1.0)))))
    totals = evaluator.exponents.sum(axis=1)
    coefficients = evaluator.coefficients * 2.0 ** (power * (totals - evaluator.degrees[:, None]))
    return Evaluator(evaluator.n, evaluator.exponents, coefficients), x / 2.0**power
