"""What values are taken for: certainly not zero, or zero at the exact zero that a point stands for.

Values in doubles are relative to the sum of their terms' sizes
(`nag.algebra.evaluation.Evaluator.residuals`), singular values to the size of a balanced matrix.
Whatever lies between, or may be zero, is decided in more digits, or exactly, wherever something
depends on it. Where several zeros are so close that a point may stand for any of them, only what
is the same at all of them is known.
"""

from __future__ import annotations

from collections.abc import Sequence

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.coincidence import NEAR
from nag.numerics.digits import BITS, SPARE, written_error
from nag.numerics.doubles import EPS, SLACK
from nag.numerics.precise_point import POINT_DIGITS, PrecisePoint
from nag.numerics.singular_point import Place, SingularEnd, analyse

# Decides, measured: Values in doubles, beside their terms, at sharpened points that may be zero:
# zeros lie below 2.5e-13, others above 2e-6 in all systems measured. What depends on it is
# confirmed.
ON = 1e-9
# Decides: The same at other points that are certainly not zero; smaller ones are computed to 100
# digits, or leave the answer to another way: so are those of polynomials that must not vanish.
NONZERO = 1e-6
# The least error of a point that is believed.
LEAST = 1e-12


def widen_error(x: np.ndarray, accuracy: float) -> float:
    """An error of the coordinates of a point of that relative accuracy, with a margin."""
    return max(SLACK * accuracy, LEAST) * (1 + float(np.abs(x).max(initial=0.0)))


# Relative error of a zero that is known by its written digits.
WRITTEN = written_error(POINT_DIGITS)
# Decimal logarithm of values beside their terms, of distances and of pivots that are zero at zeros
# of so many digits: all values of zeros lay below 5e-87.
ZERO = float(SPARE - POINT_DIGITS)
# That as a number, which coordinates are beside the largest that are none: such lay below 5e-284,
# others above 0.1.
VANISHES = 10.0**ZERO
# Bits in which the sizes of terms are added up.
LEAST_BITS = 128


def possible_zeros(
    equations: Sequence[Polynomial],
    x: np.ndarray | Sequence[flint.acb],
    accuracy: float | np.ndarray,
    rng: np.random.Generator,
    slices: np.ndarray | None = None,
    place_only: bool = False,
) -> tuple[SingularEnd, ...] | None:
    """The zeros of ``equations`` that ``x`` may stand for, to 100 digits; None if left open.

    Those that are isolated, and one for each set of zeros that it may lie on.

    Args:
        slices: further linear equations, rows on ``(1, x)``.
        place_only: whether multiplicities are of no interest, see `analyse`.
    """
    end = analyse(equations, x, accuracy, rng, slices, place_only)
    if end.place is Place.UNDECIDED:
        return None
    if end.place is not Place.CLUSTER:
        return (end,)
    return (*end.nearby, end) if end.dimension else end.nearby


def select_isolated(zeros: Sequence[SingularEnd] | None) -> tuple[SingularEnd, ...]:
    """The zeros that a point may stand for where all are isolated; none else, or if left open."""
    every = zeros or ()
    return tuple(every) if all(zero.place is Place.ISOLATED for zero in every) else ()


def choose_alike(zeros: Sequence[SingularEnd], x: np.ndarray) -> tuple[SingularEnd, ...]:
    """The one of several zeros that a point agrees with in each coordinate; all if none does.

    What lies within a zero's error agrees with it: where all coordinates are zero, none of them is
    small beside the largest, and what is left of them depends on the last of Newton's steps.
    """
    chosen = []
    for zero in zeros:
        sizes = np.maximum(np.abs(zero.point), np.abs(x))
        same = np.maximum(NEAR * sizes, VANISHES * sizes.max())
        if zero.precise is not None:
            same = np.maximum(same, zero.precise.radii)
        if (np.abs(zero.point - x) <= same).all():
            chosen.append(zero)
    return tuple(chosen) if len(chosen) == 1 else tuple(zeros)


def vanishes_at_point(f: Polynomial, point: PrecisePoint) -> bool | None:
    """Whether a polynomial in the first of its variables vanishes at the zero that a point holds.

    It does not where its value on the balls is not zero. Else it does where its value at their
    middles is zero beside its terms, to nearly all digits that zeros are worked out to; None where
    it is larger, and the balls are too wide.
    """
    point, row = point.first(f.n), BallPolynomials.of((f,))
    if not row.values(point.balls, BITS)[0, 0].contains(0):
        return False
    return True if is_negligible(f, point.centre) else None


def all_vanish(equations: Sequence[Polynomial], point: PrecisePoint) -> bool | None:
    """Whether all of some polynomials vanish at the zero that a point holds."""
    unknown = False
    for f in equations:
        answer = vanishes_at_point(f, point)
        if answer is False:
            return False
        unknown |= answer is None
    return None if unknown else True


def is_negligible(f: Polynomial, x: Sequence[flint.acb]) -> bool:
    """Whether a value is nothing beside its terms, coordinates below one counted as one."""
    return negligible_part(f, x) < VANISHES


def negligible_part(f: Polynomial, x: Sequence[flint.acb]) -> float:
    """The size of ``f(x)`` beside its terms, at exact numbers of at least a hundred digits."""
    row, x = BallPolynomials.of((f,)), x[: f.n]
    sizes = [flint.acb(max(abs(z).mid(), flint.arb(1))) for z in x]
    (bound,), value = row.sizes(sizes, LEAST_BITS), row.values(x, BITS)[0, 0]
    return float(abs(value.mid()).mid() / bound.mid()) if bound != 0 else 0.0


def vanishes_at(zero: SingularEnd, f: Polynomial) -> bool | None:
    """Whether a polynomial vanishes at a zero; None where that is not known."""
    return None if zero.precise is None else vanishes_at_point(f, zero.precise)


def vanishes_at_all(zeros: Sequence[SingularEnd] | None, f: Polynomial) -> bool | None:
    """Whether a polynomial vanishes at all zeros that a point may stand for, or at none.

    None else, or where they are not known, or one is not isolated.
    """
    answers = {vanishes_at(zero, f) for zero in select_isolated(zeros)}
    return answers.pop() if len(answers) == 1 else None


def widen_point(x: np.ndarray, radii: np.ndarray) -> PrecisePoint:
    """A point in doubles with errors that are surely large enough.

    A coordinate of 1e-89 beside one of 1e45 vanishes to any digits that both are written to
    together, but not to its own.

    Args:
        radii: errors of the coordinates, shape ``(n,)``; to them comes that of writing them.
    """
    return PrecisePoint.of_doubles(x, SLACK * (radii + EPS * np.abs(x)))


def multiplicity_of_all(zeros: Sequence[SingularEnd] | None) -> int | None:
    """The multiplicity of all zeros that a point may stand for.

    None if they differ, or where they are not known, or one is not isolated.
    """
    answers = {zero.multiplicity for zero in select_isolated(zeros)}
    return answers.pop() if len(answers) == 1 else None
