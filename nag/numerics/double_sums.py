"""Arrays of real and complex numbers as unevaluated sums of two doubles.

Dekker, A floating-point technique for extending the available precision, 1971; without fused
multiplication, so that every machine gives the same.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

# Splits a double into two of 26 bits, whose products are exact.
_SPLITTER = 2.0**27 + 1.0


class RealSums(NamedTuple):
    """Real numbers ``high + low``, arrays of one shape."""

    high: np.ndarray
    low: np.ndarray

    def __add__(self, other: RealSums) -> RealSums:  # type: ignore[override]
        total = self.high + other.high
        moved = total - self.high
        error = (self.high - (total - moved)) + (other.high - moved)
        return _renormalize(total, error + (self.low + other.low))

    def __mul__(self, other: RealSums) -> RealSums:  # type: ignore[override]
        product = self.high * other.high
        (a, b), (c, d) = _halves(self.high), _halves(other.high)
        error = ((a * c - product) + a * d + b * c) + b * d
        return _renormalize(product, error + (self.high * other.low + self.low * other.high))

    def __neg__(self) -> RealSums:
        return RealSums(-self.high, -self.low)


class ComplexSums(NamedTuple):
    """Complex numbers by their real and imaginary parts."""

    real: RealSums
    imaginary: RealSums

    @classmethod
    def of(cls, values: np.ndarray) -> ComplexSums:
        """Complex doubles."""
        values = np.asarray(values, dtype=np.complex128)
        zero = np.zeros(values.shape)
        return cls(RealSums(values.real.copy(), zero), RealSums(values.imag.copy(), zero))

    def __add__(self, other: ComplexSums) -> ComplexSums:  # type: ignore[override]
        return ComplexSums(self.real + other.real, self.imaginary + other.imaginary)

    def __mul__(self, other: ComplexSums) -> ComplexSums:  # type: ignore[override]
        a, b, c, d = *self, *other
        return ComplexSums(a * c + -(b * d), a * d + b * c)

    @property
    def high(self) -> np.ndarray:
        """The nearest complex doubles."""
        return self.real.high + 1j * self.imaginary.high

    @property
    def low(self) -> np.ndarray:
        """What these lack."""
        return self.real.low + 1j * self.imaginary.low


def _halves(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    scaled = _SPLITTER * values
    high = scaled - (scaled - values)
    return high, values - high


def _renormalize(high: np.ndarray, low: np.ndarray) -> RealSums:
    total = high + low
    return RealSums(total, low - (total - high))
