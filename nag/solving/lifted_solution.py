"""A solution of a system in fewer variables, in those of the system that led to it.

Terms of what gives the other variables may cancel: these are worked out in more digits then.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nag.algebra.elimination import Elimination
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import bits_of, doubles
from nag.numerics.precise_point import DIGITS
from nag.numerics.zero_values import possible_zeros
from nag.solving.isolated_zero import ROUNDING
from nag.solving.solutions import Solution

# Coordinates with larger errors than this, relative to their sizes, are worked out in more digits.
ROUGH = 1e-9


def lifted_solution(solution: Solution, elimination: Elimination) -> Solution:
    """The solution above one of ``elimination.system``.

    Its ``radii`` are known where those of the given one are, or where more digits were needed.
    """
    y, radii = solution.point, solution.radii
    x = elimination.lift(y)
    if len(elimination.kept) == len(x):
        return replace(solution, point=x)
    even = solution.accuracy * (1 + np.linalg.norm(y))
    errors = elimination.lift_radii(y, np.full(len(y), even) if radii is None else radii)
    others = np.delete(np.arange(len(x)), elimination.kept)
    if solution.multiplicity == 1 and (errors > ROUGH * np.abs(x))[others].any():
        fine = _in_digits(elimination, y, solution.accuracy if radii is None else radii)
        if fine is not None:
            point, zero_radii = fine
            # What is known to so many digits does not say whether it vanishes.
            known = elimination.lift_radii(y, zero_radii)
            return replace(solution, point=point, radii=ROUNDING * np.abs(point) + known)
    return replace(solution, point=x, radii=None if radii is None else errors)


def _in_digits(
    elimination: Elimination, y: np.ndarray, error: float | np.ndarray
) -> tuple[np.ndarray, np.ndarray] | None:
    """The point above the regular zero near ``y``, to rounding, and the errors of that zero.

    None if there is none.
    """
    zeros = possible_zeros(elimination.system.polynomials, y, error, np.random.default_rng(0))
    if len(zeros) != 1 or zeros[0].multiplicity != 1 or zeros[0].precise is None:
        return None
    zero = zeros[0].precise
    images = BallPolynomials.of(elimination.images).values(zero.centre, bits_of(DIGITS))
    return doubles(images.mid().entries()), zero.radii
