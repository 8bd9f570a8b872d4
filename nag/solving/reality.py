"""Which zeros of equations with real coefficients are real: those that are their own conjugates."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.numerics.coincidence import SAFETY
from nag.solving.isolated_zero import TWO, IsolatedZero

# Imaginary parts of real points, relative to their size, where errors are underestimated.
REAL = 1e-10


def which_are_real(zeros: Sequence[IsolatedZero]) -> np.ndarray:
    """Which zeros are real, shape ``(k,)``.

    Imaginary parts beyond the errors, in the digits that a zero is known to, say that it is not.
    Of a zero in doubles a little beyond its estimated error, another zero that is its conjugate
    says so.
    """
    if not zeros:
        return np.zeros(0, dtype=bool)
    points = np.array([zero.point for zero in zeros])
    sizes = 1 + np.abs(points).max(axis=1, initial=0.0)
    imaginary = np.abs(points.imag).max(axis=1, initial=0.0)
    errors = SAFETY * sizes * np.array([zero.accuracy for zero in zeros])
    in_doubles = np.array([zero.fine is None for zero in zeros], dtype=bool)
    for i in np.flatnonzero(~in_doubles).tolist():
        fine = zeros[i].fine
        parts = (float(abs(z.imag).mid()) for z in fine.coordinates)
        imaginary[i] = max(parts, default=0.0)
        errors[i] = SAFETY * max(TWO, fine.error) * sizes[i]
    real = imaginary <= errors
    for i in np.flatnonzero(in_doubles & ~real & (imaginary <= REAL * sizes)).tolist():
        conjugate = zeros[i].point.conj()
        others = (zero.point for j, zero in enumerate(zeros) if j != i)
        least = min((float(np.abs(x - conjugate).max()) for x in others), default=np.inf)
        real[i] = least > errors[i]
    return real
