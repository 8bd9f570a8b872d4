"""A point known to more digits than doubles have: a ball for each coordinate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import flint
import numpy as np

from nag.numerics.digits import doubles, log_norm, times_power_of_two
from nag.numerics.newton import Functions, find_zero

# Decimal digits that zeros are worked out to where nothing else is said.
POINT_DIGITS = 100
# Those that are taken to compute with such zeros.
WORKING_DIGITS = 120
# Exponents beyond which an error is none, or is unknown.
LEAST_ERROR, LARGEST_ERROR = -300.0, 300.0
# Decides: Decimal logarithm of what Newton's method may move a zero in doubles by, relative.
NEAR = -9.0


@dataclass(frozen=True, eq=False)
class PrecisePoint:
    """A point in balls.

    Attributes:
        centre: exact numbers.
        radii: errors of the coordinates, absolute, shape ``(n,)``.
    """

    centre: tuple[flint.acb, ...]
    radii: np.ndarray

    @classmethod
    def of(cls, centre: Sequence[flint.acb], error: float) -> PrecisePoint:
        """Coordinates with one error, of which the decimal logarithm is given."""
        radius = 10.0 ** min(max(error, LEAST_ERROR), LARGEST_ERROR)
        return cls(tuple(centre), np.full(len(centre), radius))

    @classmethod
    def of_doubles(cls, x: np.ndarray, radii: np.ndarray) -> PrecisePoint:
        """Complex doubles with their errors, both of shape ``(n,)``."""
        return cls(tuple(map(flint.acb, x.tolist())), radii)

    def __len__(self) -> int:
        return len(self.centre)

    def first(self, count: int) -> PrecisePoint:
        """The first coordinates only."""
        return PrecisePoint(self.centre[:count], self.radii[:count])

    @property
    def balls(self) -> list[flint.acb]:
        """The coordinates as balls that hold the exact ones."""
        return [
            flint.acb(flint.arb(z.real, r), flint.arb(z.imag, r))
            for z, r in zip(self.centre, self.radii.tolist(), strict=True)
        ]

    @property
    def doubles(self) -> np.ndarray:
        """The point rounded, shape ``(n,)``."""
        return doubles(self.centre)

    @property
    def error(self) -> float:
        """The largest error, relative to the coordinate's size or to one."""
        sizes = np.array([float(abs(c).mid()) for c in self.centre])
        return float((self.radii / (1 + sizes)).max(initial=0.0))

    def scaled(self, powers: Sequence[int]) -> PrecisePoint:
        """Each coordinate times a power of two, which rounds nothing."""
        centre = [times_power_of_two(z, int(k)) for z, k in zip(self.centre, powers, strict=True)]
        return PrecisePoint(tuple(centre), self.radii * np.exp2(np.asarray(powers, dtype=float)))

    def log_distance(self, other: PrecisePoint) -> float:
        """The decimal logarithm of the distance of the middles in the largest coordinate."""
        return log_norm(a - b for a, b in zip(self.centre, other.centre, strict=True))

    def parts(self) -> tuple[list[list[tuple[int, int]]], list[float]]:
        """Mantissas and exponents of two of the real and imaginary parts, and the radii."""
        return [[_exact(z.real), _exact(z.imag)] for z in self.centre], self.radii.tolist()

    @classmethod
    def from_parts(
        cls, centre: Sequence[Sequence[Sequence[int]]], radii: Sequence[float]
    ) -> PrecisePoint:
        """What `parts` was made of."""
        made = []
        for pair in centre:
            real, imag = (times_power_of_two(flint.acb(m), e).real for m, e in pair)
            made.append(flint.acb(real, imag))
        return cls(tuple(made), np.array(radii, dtype=float))

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return PrecisePoint.from_parts, self.parts()


def _exact(x: flint.arb) -> tuple[int, int]:
    mantissa, exponent = x.man_exp()
    return int(mantissa), int(exponent)


def precise_zero(
    system: Functions, z: np.ndarray, digits: float = POINT_DIGITS, within: float = NEAR
) -> PrecisePoint | None:
    """The regular zero near a point in doubles, shape ``(n,)``; None if there is none near.

    Args:
        digits: relative to the largest coordinate or to one.
        within: decimal logarithm of how far it may be, relative likewise.
    """
    if not np.isfinite(z).all():
        return None
    found = find_zero(system, [flint.acb(complex(x)) for x in z], digits, within)
    if found is None or found.error == inf:
        return None
    return PrecisePoint.of(found.point, found.error)
