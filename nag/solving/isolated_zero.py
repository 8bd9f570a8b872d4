"""An isolated zero, in doubles and in as many digits as were worked out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from nag.numerics.singular_point import SingularEnd
from nag.solving.start.target import Start
from nag.tracking.ends.terms import number
from nag.tracking.paths import Ball

# Digits in which the quotients of projective coordinates are worked out, and errors of points that
# are written to 100 digits.
DIGITS, WRITTEN = 110, 1e-95
# Least distance, beside their size or one, of zeros that are two.
TWO = 1e-80


@dataclass(frozen=True, eq=False)
class FinePoint:
    """Coordinates in FLINT's ``acb``, with an error relative to the point's size or to one."""

    coordinates: tuple[Any, ...]
    error: float

    @classmethod
    def of_ball(cls, begin: Start, ball: Ball) -> FinePoint:
        """The affine coordinates of an end that a path reached in more digits."""
        import flint

        shift, radii = len(begin.groups), ball.radii
        values: dict[int, Any] = {}
        errors = []
        with flint.ctx.workdps(DIGITS):
            x = [number(c) for c in ball.centre]
            for k, group in enumerate(begin.groups):
                size = float(abs(x[k]).mid())
                for i in group:
                    values[i] = (x[shift + i] / x[k]).mid()
                    own = float(abs(values[i]).mid())
                    errors.append((radii[shift + i] + own * radii[k]) / size / (1 + own))
        return cls(tuple(values[i] for i in sorted(values)), float(max(errors, default=0.0)))

    @classmethod
    def of_end(cls, end: SingularEnd) -> FinePoint | None:
        """The coordinates that the judgement of an end gives; None if it gives none."""
        if not end.digits:
            return None
        import flint

        from nag.numerics.digits import point

        with flint.ctx.workdps(DIGITS):
            return cls(tuple(point(end.digits)), WRITTEN)


class IsolatedZero(NamedTuple):
    """An isolated solution in the scaled variables; ``fine``: more digits of it, if known."""

    point: np.ndarray
    multiplicity: int
    residual: float
    accuracy: float
    condition: float
    precision: int
    fine: FinePoint | None = None

    @classmethod
    def of_end(cls, end: SingularEnd, residual: float, precision: int) -> IsolatedZero:
        """An end that was judged to be one."""
        numbers = residual, end.accuracy, end.condition, precision
        return cls(end.point, end.multiplicity, *numbers, FinePoint.of_end(end))

    def is_apart_from(self, other: IsolatedZero) -> bool:
        """Whether two zeros are two, in the digits that both are known to."""
        if self.fine is None or other.fine is None:
            return False
        error = max(TWO, self.fine.error + other.fine.error)
        pairs = zip(self.fine.coordinates, other.fine.coordinates, strict=True)
        return any(float(abs(a - b).mid()) > error * (1 + float(abs(a).mid())) for a, b in pairs)
