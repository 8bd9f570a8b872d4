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
    scaled, sizes = _scaled(evaluator, x)
    along = scipy.linalg.null_space(a * sizes) if len(a) else None
    return local_dimension(scaled, x / sizes, lambda s, k: numerical_corank(s, k, ZERO), along) or 0


def _scaled(evaluator: Evaluator, x: np.ndarray) -> tuple[Evaluator, np.ndarray]:
    """The equations in coordinates that are at most one at ``x``, and what these are multiplied by.

    Scales are powers of two; each equation's largest coefficient is one again. At a large point the
    rounding errors of terms of high degree are no small numbers.
    """
    powers = np.ceil(np.log2(np.maximum(np.abs(x), 1.0)))
    coefficients = evaluator.coefficients * 2.0 ** (evaluator.exponents @ powers)
    largest = np.abs(coefficients).max(axis=1, initial=0.0)
    coefficients /= np.where(largest == 0, 1.0, largest)[:, None]
    return Evaluator(evaluator.n, evaluator.exponents, coefficients), 2.0**powers
