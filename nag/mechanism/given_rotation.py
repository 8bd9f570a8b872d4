"""Rotations that are given in rounded numbers, as exact ones.

Angles of drawings are multiples of pi/12 written in decimals, or measured. The first are recognised
and taken exactly, with square roots; any other is taken to the simplest rational point of the
circle next to it, by the tangent of half the angle. So every rotation is exactly orthogonal, as a
quaternion that need not have norm 1, and what turns forth and back by the same angle is where it
was.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import atan2, gcd, lcm
from typing import Any

from nag.algebra.number import (
    PI,
    Irrational,
    Number,
    cosine,
    is_zero,
    number_text,
    pi_multiple,
    rounded_fraction,
    sine,
    square_root,
    to_mpf,
)
from nag.errors import NagError
from nag.mechanism.axes import Vector, difference, dot
from nag.mechanism.graph import ORIGIN
from nag.mechanism.quaternion import R, multiply, norm_squared

Quaternion = tuple[Number, Number, Number, Number]
IDENTITY: Quaternion = (Fraction(1), Fraction(0), Fraction(0), Fraction(0))

# Decides: Radians, or parts of the largest entry, by which doubles miss what they stand for; cosine
# of the angle between a line's direction and its moment that rounding leaves.
NEAR = 1e-9
# Radians that the rational rotation next to an angle may be off: rounding of a double at pi.
ROUNDED = 4e-16
# Decides: Lengths that are zero: what is left in doubles of products with the cosine of pi/2.
NOTHING = 1e-12
# Numbers of fewer decimals are not taken for rounded multiples of pi/12: 0.26 may be just that.
LEAST_DECIMALS = 4
# Turns of more radians are no angles of a drawing.
LARGEST = 10_000
# Digits of a quaternion from which on it is rounded, to so many.
LONG, SHORT = 100, 18


@dataclass(frozen=True)
class Taken:
    """What a number of a file was taken for.

    Attributes:
        given: the number, as decimals.
        exact: the multiple of pi that it stands for; empty if it was rounded to a rational point.
    """

    given: str
    exact: str = ""


@dataclass(frozen=True)
class GivenTurn:
    """A rotation as a quaternion of any length, and what its numbers were taken for."""

    quaternion: Quaternion = IDENTITY
    taken: tuple[Taken, ...] = ()

    def then(self, other: GivenTurn) -> GivenTurn:
        """This rotation, and the other one in the frame that it leads to."""
        return GivenTurn(
            shortened(multiply(self.quaternion, other.quaternion)), self.taken + other.taken
        )


@dataclass(frozen=True)
class GivenFrame:
    """A place: x goes to R x + origin, R the rotation of a quaternion of any length."""

    quaternion: Quaternion = IDENTITY
    origin: Vector = ORIGIN

    @cached_property
    def matrix(self) -> tuple[Vector, ...]:
        """The rotation, exactly orthogonal."""
        squared = norm_squared(self.quaternion)
        return tuple(tuple(x / squared for x in row) for row in R(self.quaternion))

    def turned(self, v: Sequence[Number]) -> Vector:
        """A direction, as seen from outside."""
        return tuple(dot(row, v) for row in self.matrix)

    def placed(self, p: Sequence[Number]) -> Vector:
        """A point, as seen from outside."""
        return tuple(x + y for x, y in zip(self.turned(p), self.origin, strict=True))

    def back(self, v: Sequence[Number]) -> Vector:
        """A direction that is seen from outside, in this frame: the inverse is the transpose."""
        return tuple(dot(column, v) for column in zip(*self.matrix, strict=True))

    def seen(self, p: Sequence[Number]) -> Vector:
        """A point that is seen from outside, in this frame."""
        return self.back(difference(p, self.origin))

    def then(self, other: GivenFrame) -> GivenFrame:
        """The place of a frame that is given in this one."""
        turned = shortened(multiply(self.quaternion, other.quaternion))
        return GivenFrame(turned, self.placed(other.origin))


def shortened(quaternion: Sequence[Number]) -> Quaternion:
    """A multiple of a quaternion in short numbers; rounded where they are very long."""
    if not all(isinstance(x, Fraction) for x in quaternion):
        if sum(len(str(x)) for x in quaternion) <= 8 * LONG:
            return tuple(quaternion)
        quaternion = tuple(rounded_fraction(x, SHORT) for x in quaternion)
    below = lcm(*(x.denominator for x in quaternion))
    whole = [int(x * below) for x in quaternion]
    divisor = gcd(*whole) or 1
    whole = [x // divisor for x in whole]
    largest = max(map(abs, whole))
    if largest >= 10**LONG:
        whole = [x * 10**SHORT // largest for x in whole]
    return tuple(Fraction(x) for x in whole)


def decimals_of(value: Fraction) -> int | None:
    """Decimals with which a number is written in base ten; None if it has no end."""
    below, places = value.denominator, [0, 0]
    for i, p in enumerate((2, 5)):
        while below % p == 0:
            below //= p
            places[i] += 1
    return max(places) if below == 1 else None


def _uncertainty(decimals: int | None) -> Fraction:
    """By how much a number of so many decimals may miss what it stands for."""
    near = Fraction(NEAR)
    if decimals is None or decimals < LEAST_DECIMALS:
        return near
    return max(near, Fraction(1, 10**decimals))


def known_multiple(angle: Number, within: Fraction | None = None) -> Fraction | None:
    """The multiple of pi/12, over pi, that an angle in radians stands for, or None.

    1.5708 is pi/2 in four decimals, rounded or cut off, and 1.5707963267948966 is to a double. Of
    fewer than four decimals none is recognised but 0.

    Args:
        within: the uncertainty of the angle, by default that of its last decimal.
    """
    turns = pi_multiple(angle)
    if turns is None and not isinstance(angle, Fraction):
        turns = rounded_fraction(angle / PI, 30)
    elif turns is None:
        turns = rounded_fraction(_over_pi(angle), 30)
        if within is None:
            within = _uncertainty(decimals_of(angle))
    multiple = Fraction(round(turns * 12), 12)
    if multiple == 0 or within is None:
        within = Fraction(NEAR)
    # Pi is less than 22/7.
    return multiple if abs(turns - multiple) * 22 < 7 * within else None


def _over_pi(angle: Fraction) -> Number:
    return angle / PI if angle else angle


def half_angle(angle: Number, within: Fraction | None = None) -> tuple[Number, Number, Taken]:
    """(cos : sin) of half an angle in radians, and what the angle was taken for.

    Raises:
        NagError: for an angle of thousands of turns.
    """
    if abs(angle) > LARGEST:
        raise NagError(f"{_shown(angle)} is no angle in radians; reduce it by turns")
    known = known_multiple(angle, within)
    if known is not None:
        exact = _pi_text(known)
        taken = Taken(exact if isinstance(angle, Irrational) else _shown(angle), exact)
        if known % 2 == 1:
            return Fraction(0), Fraction(1), taken
        return 1 + cosine(known * PI), sine(known * PI), taken
    cos, sin = _rational_direction(angle, Fraction(1))
    return cos, sin, Taken(_shown(angle))


def _pi_text(part: Fraction) -> str:
    """A multiple of pi as people write it."""
    above = {1: "pi", -1: "-pi"}.get(part.numerator, f"{part.numerator}*pi") if part else "0"
    return above if part.denominator == 1 else f"{above}/{part.denominator}"


def _rational_direction(angle: Number, length: Number) -> tuple[Fraction, Fraction]:
    """(c : s) next to (cos(angle / 2) : sin(angle / 2) / length), in the simplest fractions."""
    import mpmath

    with mpmath.workdps(50):
        half, size = to_mpf(angle, 45) / 2, to_mpf(length, 45)
        cos, sin = mpmath.cos(half), mpmath.sin(half)
        # The error of the quotient is at least that of half the angle.
        if abs(sin) <= abs(cos):
            value, within = sin / cos / size, mpmath.mpf(ROUNDED) / 2 / size
            return Fraction(1), _simplest(_fraction(value), _fraction(within))
        value, within = cos / sin * size, mpmath.mpf(ROUNDED) / 2 * size
        return _simplest(_fraction(value), _fraction(within)), Fraction(1)


def _fraction(value: Any) -> Fraction:
    negative, mantissa, exponent, _ = value._mpf_
    return Fraction(int(-mantissa if negative else mantissa)) * Fraction(2) ** int(exponent)


def _simplest(value: Fraction, within: Fraction) -> Fraction:
    """The fraction of the smallest denominator no further than that; odd in ``value``."""
    if value < 0:
        return -_simplest(-value, within)
    low, high = value - within, value + within
    if low <= 0:
        return Fraction(0)
    quotients = []
    while low // 1 != low and low // 1 == high // 1:
        whole = low // 1
        quotients.append(whole)
        low, high = 1 / (high - whole), 1 / (low - whole)
    found = Fraction(-(-low // 1))
    for whole in reversed(quotients):
        found = whole + 1 / found
    return found


def _shown(angle: Number) -> str:
    return number_text(angle) if isinstance(angle, Irrational) else f"{float(angle):.12g}"


def turn_about(axis: Sequence[Number], angle: Number) -> GivenTurn:
    """The rotation by an angle in radians about a direction of any length but zero.

    Its axis is exact; the angle, where it is not recognised, is rounded.
    """
    squared = dot(axis, axis)
    length = square_root(squared)
    cos, sin, taken = half_angle(angle)
    if taken.exact and not isinstance(length, Irrational):
        sin = sin / length
    elif not isinstance(length, Fraction) or length != 1:
        cos, sin = _rational_direction(angle, length)
        taken = Taken(taken.given)
    said = () if taken.exact == "0" or is_zero(sin) else (taken,)
    return GivenTurn(shortened((cos, *(sin * x for x in axis))), said)


def turns_in_order(angles: Sequence[Number], letters: str) -> GivenTurn:
    """Rotations about axes x, y, z of the frame that turns with them, or XYZ of the fixed one."""
    found = GivenTurn()
    for letter, angle in zip(letters, angles, strict=True):
        axis = tuple(Fraction(int(letter.lower() == x)) for x in "xyz")
        own = turn_about(axis, angle)
        found = found.then(own) if letter.islower() else own.then(found)
    return found


def given_quaternion(given: Sequence[Fraction]) -> GivenTurn:
    """The rotation of a quaternion in rounded numbers: any is exact, its length does not matter.

    A turn about a coordinate axis by a multiple of pi/12 is recognised.

    Raises:
        NagError: if it is zero.
    """
    entries, within = _clean_entries(given)
    if not any(entries):
        raise NagError("is zero; a quaternion has a direction")
    axes = [i for i in (1, 2, 3) if entries[i]]
    if len(axes) != 1 or not entries[0]:
        return GivenTurn(shortened(entries))
    angle = Fraction(2 * atan2(entries[axes[0]], entries[0]))
    known = known_multiple(angle, 2 * within)
    if known is None:
        return GivenTurn(shortened(entries))
    axis = tuple(Fraction(int(i == axes[0])) for i in (1, 2, 3))
    found = turn_about(axis, known * PI)
    return GivenTurn(found.quaternion, (Taken(_shown(angle), _pi_text(known)),))


def given_axis(given: Sequence[Fraction]) -> Vector:
    """The direction that a vector in rounded numbers stands for.

    Entries that are zero, or of one size, to rounding are so exactly; in a coordinate plane the
    multiples of pi/12 are recognised.

    Raises:
        NagError: if it is zero.
    """
    entries, within = _clean_entries(given)
    there = [i for i in range(3) if entries[i]]
    if not there:
        raise NagError("has length zero; it needs a direction")
    if len(there) == 1:
        return tuple(Fraction((x > 0) - (x < 0)) for x in entries)
    if len(there) == 3:
        return entries
    i, j = there
    known = known_multiple(Fraction(atan2(entries[j], entries[i])), within)
    if known is None or entries[i].denominator == entries[j].denominator == 1:
        return entries
    found = [Fraction(0)] * 3
    sin, cos = sine(known * PI), cosine(known * PI)
    size = abs(cos)
    found[i], found[j] = cos / size, sin / size
    return tuple(found)


def _clean_entries(given: Sequence[Fraction]) -> tuple[tuple[Fraction, ...], Fraction]:
    """Entries without what rounding left, and how uncertain they are."""
    largest = max(map(abs, given))
    if not largest:
        return tuple(given), Fraction(NEAR)
    # Of vectors of length one the last decimal may be rounded; others are as they are written.
    decimals = max((decimals_of(x) or 0) for x in given)
    within = _uncertainty(decimals)
    if abs(sum(x * x for x in given) - 1) > 4 * within:
        within = Fraction(NEAR)
    entries = [x if abs(x) > NEAR * largest else Fraction(0) for x in given]
    for i, x in enumerate(entries):
        for y in entries[:i]:
            if abs(abs(x) - abs(y)) <= NEAR * largest:
                entries[i] = abs(y) if x > 0 else -abs(y)
                break
    return tuple(entries), within


def given_point(given: Sequence[Fraction]) -> Vector:
    """A point as it is written, but for what products with the cosine of pi/2 leave of zero."""
    return tuple(x if abs(x) > NOTHING else Fraction(0) for x in given)


def next_quaternion(entries: Sequence[float], given: str) -> GivenTurn:
    """The rotation of a quaternion that was worked out in doubles."""
    size = max(map(abs, entries))
    turn = given_quaternion([Fraction(repr(x / size)) for x in entries])
    simple = all(abs(x) <= 1 for x in turn.quaternion)
    return turn if simple or turn.taken else GivenTurn(turn.quaternion, (Taken(given),))
