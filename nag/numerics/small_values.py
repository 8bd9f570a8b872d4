"""What a value in doubles is taken for: certainly not zero, or one that may be.

Values are relative to the sum of their terms' sizes (`nag.algebra.evaluation.Evaluator.residuals`),
singular values to the size of a balanced matrix. Whatever lies between, or may be zero, is decided
in more digits, or exactly, wherever something depends on it.
"""

from __future__ import annotations

import numpy as np

# Zeros lie below 2.5e-13 at sharpened points, others above 2e-6 in all systems measured.
ON = 1e-9
# Values at points that are not sharpened that are certainly not zero.
NONZERO = 1e-6
# Singular values at a point of a component below which a gap is looked for.
SINGULAR = 1e-9
# How much larger than its estimate the error of a point may be, and the least that is believed.
SLACK, LEAST = 1e3, 1e-12


def widened(x: np.ndarray, accuracy: float) -> float:
    """An error of the coordinates of a point of that relative accuracy, with a margin."""
    return max(SLACK * accuracy, LEAST) * (1 + float(np.abs(x).max(initial=0.0)))
