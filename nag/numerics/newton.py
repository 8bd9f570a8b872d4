"""Newton's method in balls: to so many digits, or until rounding governs what is left.

A step at an exact point x solves ``F'(x) s = F(x)``: by least squares where there are more
equations than unknowns, the shortest where there are fewer. Values and slopes are balls, and so is
the step: how wide it is says what rounding and conditions may have made of it. Where that governs a
step, the next one is made in more bits; no other estimate of an error is needed.

Short steps do not say that a zero is regular: beside a multiple one they are as short as what is
left, which may be below all digits. A point has converged where Krawczyk's test proves, in a box
about its last step, that the zero there is simple. That is decided here for all who ask for zeros.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import inf, log10
from typing import Protocol

import flint
import numpy as np

from nag.numerics.digits import LOG10_2, bits_of, in_bits, log_norm, middle

# Bits of first steps; what a later one needs beside the digits that it is to have; and how many are
# taken at a time. At most there are so many, and so many times those of the digits asked for.
FIRST_BITS, MORE_BITS, UNIT_BITS = 128, 32, 64
MOST_BITS, MOST_TIMES = 1024, 4
STEPS = 60
# Decimal logarithm of what a step exceeds its error by; and of what it is shorter than the one
# before by where nothing else is said, after the first ones.
GAIN, FIRST_STEPS = 0.2, 3
# An inverse by which a step gains so many digits, and this part of those that are left, is kept.
FAST, LEFT = 12.0, 1 / 6
# Sides of Krawczyk's box in those of the last step: in an image as much smaller the zero is nearer
# to the new point than that step was long. And boxes that are tried, the next where the image says.
BOX, BOXES = 4, 2
# The part of all digits that a point has where a step that is no shorter than the last is rounding.
RESTS = 0.3


class Functions(Protocol):
    """Equations in balls, such as `nag.numerics.ball_polynomials.BallPolynomials`."""

    def values(self, x: Sequence[flint.acb], bits: int) -> flint.acb_mat: ...

    def jacobian(self, x: Sequence[flint.acb], bits: int) -> flint.acb_mat: ...


@dataclass(frozen=True, eq=False)
class Converged:
    """The regular zero that Newton's method has led to.

    Of as many equations as unknowns it is proved to be one; of more, that no other is as near.

    Attributes:
        point: exact numbers.
        error: the last step at most, rounding included: the decimal logarithm of its largest
            coordinate.
        inverse: a matrix near the inverse Jacobian.
    """

    point: list[flint.acb]
    error: float
    inverse: flint.acb_mat


def inverse_of(matrix: flint.acb_mat, bits: int) -> flint.acb_mat | None:
    """The inverse of a matrix, or its pseudo-inverse, in balls; None if it may be singular."""
    rows, columns = matrix.nrows(), matrix.ncols()
    with in_bits(bits):
        try:
            if rows == columns:
                return matrix.inv()
            across = matrix.conjugate().transpose()
            if rows > columns:
                return (across * matrix).solve(across)
            return across * (matrix * across).inv()
        except ZeroDivisionError:
            return None


def solve_equations(
    matrix: flint.acb_mat, right: flint.acb_mat, bits: int
) -> list[flint.acb] | None:
    """What a matrix multiplies to a column, in balls; None if it may be singular.

    By least squares where it has more rows than columns, the shortest where it has fewer.
    """
    rows, columns = matrix.nrows(), matrix.ncols()
    with in_bits(bits):
        try:
            if rows == columns:
                return matrix.solve(right).entries()
            across = matrix.conjugate().transpose()
            if rows > columns:
                return (across * matrix).solve(across * right).entries()
            return (across * (matrix * across).solve(right)).entries()
        except ZeroDivisionError:
            return None


def newton_step(
    system: Functions, x: Sequence[flint.acb], bits: int, inverse: flint.acb_mat | None = None
) -> list[flint.acb] | None:
    """Newton's step in balls, to be subtracted; None at a singular Jacobian.

    Args:
        inverse: a matrix near that of the Jacobian, if one is known.
    """
    values = system.values(x, bits)
    if inverse is None:
        return solve_equations(system.jacobian(x, bits), values, bits)
    with in_bits(bits):
        return (inverse * values).entries()


def step_by_doubles(
    inverse: np.ndarray, values: Sequence[flint.acb]
) -> tuple[float, float, list[flint.acb]]:
    """Newton's step by an inverse in doubles, to be subtracted, of values far below these.

    Each such step gains as many digits as doubles have, whatever the rank.

    Args:
        inverse: or pseudo-inverse, of the Jacobian near a zero.

    Returns:
        Decimal logarithms of the largest value and of the largest entry of the step; the step.
    """
    size = log_norm(values)
    unit = flint.arb(10) ** flint.arb(size)
    step = inverse @ np.array([complex(value / unit) for value in values])
    length = size + log10(max(float(np.abs(step).max(initial=0.0)), 1e-300))
    return size, length, [unit * flint.acb(c) for c in step.tolist()]


def move_point(
    x: Sequence[flint.acb], change: Sequence[flint.acb], bits: int, share: float = 1.0
) -> list[flint.acb]:
    """The point that a change, or a share of it, leads to, an exact one."""
    with in_bits(bits):
        return [middle(a + middle(b) * share) for a, b in zip(x, change, strict=True)]


def subtract_step(x: Sequence[flint.acb], step: Sequence[flint.acb], bits: int) -> list[flint.acb]:
    """The point that a step of Newton's method leads to."""
    with in_bits(bits):
        return [(a - b).mid() for a, b in zip(x, step, strict=True)]


def slopes_over(
    system: Functions,
    x: Sequence[flint.acb],
    sides: Sequence[flint.arb],
    inverse: flint.acb_mat,
    bits: int,
) -> flint.arb_mat:
    """Absolute values of the entries of ``1 - Y F'(X)`` for discs X of these radii about a point.

    Of fewer equations than unknowns, whose zeros are no points, of ``1 - F'(X) Y``.

    Args:
        inverse: ``Y``, a matrix near the inverse Jacobian, exact.
    """
    with in_bits(bits):
        discs = [flint.acb(d, d) for d in (flint.arb(0, r) for r in sides)]
        jacobian = system.jacobian([z + d for z, d in zip(x, discs, strict=True)], bits)
        wide = jacobian.nrows() < jacobian.ncols()
        rest = (jacobian * inverse if wide else inverse * jacobian) - _identity(
            min(jacobian.nrows(), jacobian.ncols())
        )
        return flint.arb_mat(rest.nrows(), rest.ncols(), [abs(z) for z in rest.entries()])


@lru_cache
def _identity(n: int) -> flint.acb_mat:
    return flint.acb_mat(n, n, [int(i == j) for i in range(n) for j in range(n)])


def _is_simple(
    system: Functions,
    x: Sequence[flint.acb],
    step: Sequence[flint.acb],
    inverse: flint.acb_mat,
    bits: int,
) -> bool:
    """Whether there is a simple zero, and one only, a step of Newton's method from a point.

    Each side of the box is a multiple of the step there, as coordinates may differ in their digits.
    """
    inverse = inverse.mid()
    with in_bits(bits):
        sides = [BOX * z.abs_upper() for z in step]
        # Coordinates that do not move have a side as well, beside the others or the point.
        least = max([*sides, flint.arb(0)])
        if not least > 0:
            least = max([flint.arb(1), *(abs(z).mid() for z in x)])
        sides = [max(r, least * flint.arb(2) ** -bits).mid() for r in sides]
        for _ in range(BOXES):
            slopes = slopes_over(system, x, sides, inverse, bits)
            if slopes.ncols() != len(sides):
                return all(BOX * sum(row, flint.arb(0)) < 1 for row in slopes.tolist())
            image = (slopes * flint.arb_mat(len(sides), 1, sides)).entries()
            if all(BOX * a < r for a, r in zip(image, sides, strict=True)):
                return True
            if not all(a.is_finite() for a in image):
                return False
            sides = [max(r, 2 * BOX * a.upper()).mid() for a, r in zip(image, sides, strict=True)]
    return False


def find_zero(
    system: Functions,
    start: Sequence[flint.acb],
    digits: float,
    within: float = inf,
    gain: float = GAIN,
) -> Converged | None:
    """The regular zero that Newton's method leads to from the middles of a point, to many digits.

    Args:
        digits: relative to the point's largest coordinate or to one.
        within: decimal logarithm of how far the zero may be, relative likewise.
        gain: what a step must be shorter by than the one before, after the first ones: decimal
            logarithm. By two zeros that are close together each step halves the distance.

    Returns:
        None if steps do not become shorter soon, or lead further away, if the digits are more than
        conditions leave of many bits, or if the zero is not proved to be simple.
    """
    x, size = list(map(middle, start)), max(0.0, log_norm(start))
    most = MOST_BITS + MOST_TIMES * bits_of(digits)
    bits, clear, last, inverse = FIRST_BITS, FIRST_BITS, inf, None
    for count in range(STEPS):
        new = inverse is None
        if inverse is None:
            inverse = inverse_of(system.jacobian(x, clear), clear)
        step = None if inverse is None else newton_step(system, x, bits, inverse)
        length, rounding = (inf, inf) if step is None else _lengths(step)
        error = max(length, rounding)
        done = error < size - digits
        if step is None or (not done and rounding > length - GAIN):
            # What is left is rounding, or all that there is: more bits of the same point.
            if bits > most:
                return None
            bits, clear, inverse = 2 * bits, 2 * clear, None
            continue
        before, x = x, subtract_step(x, step, max(bits, bits_of(digits) + MORE_BITS))
        slow = count >= FIRST_STEPS and length > last - gain
        if (slow and not done) or not _is_within(x, start, size + within):
            return None
        rounded = max(size - LOG10_2 * bits, length - LOG10_2 * clear if new else -inf)
        lost = max(0.0, rounding - rounded)
        if done and (last < inf or length == -inf):
            if _is_simple(system, before, step, inverse, clear):
                return Converged(x, error, inverse)
            enough = min(most, _whole_bits(size - error + lost)) if error > -inf else most
            if new and clear >= enough:
                return None
            # Other zeros may be nearer than slopes in so few bits tell.
            bits, clear, inverse, last = max(bits, enough), max(clear, enough), None, length
            continue
        left = length - size + digits
        # A first step that is short beside the point is by slopes as near to those at the zero.
        if min(last, size) - length < max(FAST, LEFT * left):
            inverse = None
        elif new:
            # How wide it is has been seen: any matrix near the inverse leads to the zero.
            inverse = inverse.mid()
        known = min(4 * (size - length), digits) if length > -inf else digits
        bits = max(bits, _whole_bits(known + lost))
        # Of the digits after a step, half are those of the point that it starts from.
        clear, last = max(clear, _whole_bits(known / 2 + lost)), length
    return None


def _whole_bits(digits: float) -> int:
    """Bits to work in for so many digits."""
    return UNIT_BITS * -(-(bits_of(digits) + MORE_BITS) // UNIT_BITS)


def _is_within(x: Sequence[flint.acb], start: Sequence[flint.acb], most: float) -> bool:
    """Whether the largest difference has a decimal logarithm of so much at most."""
    return most == inf or log_norm(a - b for a, b in zip(x, start, strict=True)) <= most


def _lengths(step: Sequence[flint.acb]) -> tuple[float, float]:
    """Decimal logarithms of a step's largest middle, and of its largest radius."""
    return log_norm(step), log_norm(z.rad() for z in step)


def newton_to_rest(
    system: Functions, start: Sequence[flint.acb], bits: int, steps: int
) -> list[flint.acb] | None:
    """Where Newton's method comes to rest from a point, in so many bits and after so many steps.

    That is where rounding governs a step. None at a singular Jacobian.
    """
    x, last = list(map(middle, start)), inf
    for _ in range(steps):
        step = newton_step(system, x, bits)
        if step is None:
            return None
        length, x = log_norm(map(middle, step)), subtract_step(x, step, bits)
        if all(z.contains(0) for z in step):
            break
        if length >= last and length - log_norm(x) < -RESTS * LOG10_2 * bits:
            break
        last = length
    return x
