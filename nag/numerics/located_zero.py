"""The exact zero that a point stands for: sharpened, and singular ones deflated first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import log10
from typing import Any

import flint
import numpy as np

from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.numerics.curves import is_exact_zero
from nag.numerics.deflation import DeflatedPoint, NotDeflated, SeriesTooLong, certain_round, deflate
from nag.numerics.descent import Round
from nag.numerics.digits import DIGITS, ROUNDING, doubles, middle, rational_point, to_ball
from nag.numerics.exact_system import ExactSystem
from nag.numerics.local_structure import FURTHEST, REACHES
from nag.numerics.scaling import scaled_terms, variable_scales
from nag.numerics.sharpening import ARRIVED, ZERO
from nag.numerics.sharpening import ROUNDING as STALLED


@dataclass(frozen=True, eq=False)
class LocatedZero:
    """An exact zero of exact equations in scaled variables.

    Attributes:
        found: the zero, and what its deflation says.
        block: rows and columns of the largest regular block of the Jacobian.
        exact: the coordinates as exact numbers, or None.
    """

    system: ExactSystem
    found: DeflatedPoint
    block: Round
    exact: tuple[Number, ...] | None

    @property
    def balls(self) -> list[flint.acb]:
        """The zero to as many digits as are known of it, at the working precision.

        Newton's last step is as short as the inverse lets it be, and no shorter.
        """
        if self.exact is not None:
            return [to_ball(c) for c in self.exact]
        radius = flint.arb(10) ** max(ARRIVED, STALLED + self.found.inverse - DIGITS)
        # Equations are real: the only zero near to a real point is real.
        across = radius if any(c.imag for c in self.found.point) else 0
        parts = [(c.real.mid(), c.imag.mid()) for c in self.found.point]
        return [flint.acb(flint.arb(re, radius), flint.arb(im, across)) for re, im in parts]

    @property
    def tangent(self) -> int:
        """Dimension of the tangent space, the Jacobian's corank."""
        return self.system.n - len(self.block.columns)


def exact_zero(
    polynomials: Sequence[Polynomial],
    point: Sequence[Any] | np.ndarray,
    accuracy: float,
    rng: np.random.Generator,
) -> tuple[LocatedZero | None, list[flint.arb]]:
    """The exact zero that a point stands for, and the sizes of its variables' units.

    Args:
        point: exact numbers, or doubles known to ``accuracy``.
    """
    exact = all(is_exact(c) for c in point)
    error = None if exact else log10(max(accuracy, 1e-300))
    zero, factors, _ = locate_zero(polynomials, list(point), error, rng)
    return zero, factors


def is_exact(c: Any) -> bool:
    """Whether a number is an exact one."""
    return isinstance(c, int | Number)


def locate_zero(
    polynomials: Sequence[Polynomial],
    point: Sequence[Any],
    error: float | None,
    rng: np.random.Generator,
) -> tuple[LocatedZero | None, list[flint.arb], str]:
    """The zero, the sizes of its variables' units, and why there is none if there is none.

    Args:
        error: decimal logarithm of the point's error in each coordinate; None if it is exact.
    """
    n = len(point)
    powers = variable_scales(polynomials, n)
    scaled = [Polynomial(n, scaled_terms(f, powers)) for f in polynomials if f]
    x = [_over(c, int(k)) for c, k in zip(point, powers, strict=True)]
    precise = [middle(to_ball(c)) for c in x]
    system = ExactSystem.of(scaled, doubles(precise))
    known = [_over(c, k) for c, k in zip(x, system.scales, strict=True)]
    y = [middle(to_ball(c)) for c in known]
    zero, reason = _exact_zero(system, y, error, known, rng)
    factors = [flint.arb(2) ** (int(a) + b) for a, b in zip(powers, system.scales, strict=True)]
    return zero, factors, reason


def _over(c: Any, k: int) -> Any:
    """``c`` over a power of two, exactly."""
    if isinstance(c, complex | float | np.number):
        z = complex(c)
        return complex(np.ldexp(z.real, -k), np.ldexp(z.imag, -k))
    return c * Fraction(2) ** -k


def _exact_zero(
    system: ExactSystem,
    y: list[flint.acb],
    error: float | None,
    known: Sequence[Any],
    rng: np.random.Generator,
) -> tuple[LocatedZero | None, str]:
    """The exact zero that a point stands for, or why there is none."""
    if not system.rows:
        nothing = DeflatedPoint(y, (Round((), ()),), system.n, -np.inf, 0.0)
        return LocatedZero(system, nothing, nothing.rounds[0], None), ""
    slopes = system.values_at(DIGITS).jacobian
    if error is None:
        block = certain_round(slopes, y, ROUNDING - DIGITS, rng)
        try:
            found = deflate(system, y, ROUNDING - DIGITS, rng)
            found = replace(found, point=y)
        except NotDeflated:
            found = DeflatedPoint(y, (replace(block, order=2),), 0, ZERO, 0.0)
        return LocatedZero(system, found, block, tuple(known)), ""
    reasons = []
    # Less reach than what may hold a singular zero shows no other that stands for the point.
    least = -np.inf
    reaches = (min(error + more, max(FURTHEST, error)) for more in REACHES)
    for reach in dict.fromkeys(max(reach, ROUNDING - DIGITS) for reach in reaches):
        if reach < least:
            continue
        try:
            found = deflate(system, y, reach, rng)
        except NotDeflated as reason:
            reasons.append(str(reason))
            if isinstance(reason, SeriesTooLong):
                least = reach
            continue
        if is_exact_zero(system, found):
            block = certain_round(
                system.values_at(DIGITS).jacobian, found.point, ROUNDING - DIGITS, rng
            )
            exact = rational_point(found.point, DIGITS) if system.rational else None
            if exact is not None and not system.vanishes_exactly(exact):
                exact = None
            return LocatedZero(system, found, block, None if exact is None else tuple(exact)), ""
        reasons.append(f"what should vanish there is of size 1e{found.defect:.0f}")
    return None, reasons[0]
