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
    imaginary, errors = np.zeros(len(zeros)), np.zeros(len(zeros))
    in_doubles = np.array([zero.fine is None for zero in zeros], dtype=bool)
    for i, zero in enumerate(zeros):
        size = 1 + float(np.abs(zero.point).max(initial=0.0))
        if zero.fine is None:
            imaginary[i] = float(np.abs(zero.point.imag).max(initial=0.0))
            errors[i] = SAFETY * zero.accuracy * size
        else:
            parts = (float(abs(z.imag).mid()) for z in zero.fine.coordinates)
            imaginary[i] = max(parts, default=0.0)
            errors[i] = SAFETY * max(TWO, zero.fine.error) * size
    real = imaginary <= errors
    sizes = np.array([1 + float(np.abs(zero.point).max(initial=0.0)) for zero in zeros])
    for i in np.flatnonzero(in_doubles & ~real & (imaginary <= REAL * sizes)).tolist():
        conjugate = zeros[i].point.conj()
        others = (zero.point for j, zero in enumerate(zeros) if j != i)
        least = min((float(np.abs(x - conjugate).max()) for x in others), default=np.inf)
        real[i] = least > errors[i]
    return real
