"""Quaternions and dual quaternions over any commutative ring.

A quaternion is a tuple of four entries, real part first; a dual quaternion p + eps d is a pair of
quaternions. Entries are fractions, polynomials, complex numbers: nothing here divides. Signs and
matrices are those of Tuomela 2025 (T25), section 2.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm
from typing import Any

from nag.mechanism.axes import Vector, cross

Quaternion = tuple[Any, Any, Any, Any]
DualQuaternion = tuple[Quaternion, Quaternion]
Matrix = tuple[tuple[Any, ...], ...]


def multiply(a: Sequence[Any], b: Sequence[Any]) -> Quaternion:
    """The product ab, so that R(ab) = R(a) R(b)."""
    if all(type(x) is Fraction for x in (*a, *b)):
        # Products of whole numbers need no common divisors until they are added up.
        (whole, below), (others, factor) = _clear_denominators(a), _clear_denominators(b)
        below *= factor
        return tuple(Fraction(c, below) for c in _product(whole, others))
    return _product(a, b)


def _clear_denominators(a: Sequence[Fraction]) -> tuple[list[int], int]:
    """Whole numbers and what they are to be divided by."""
    below = lcm(*(x.denominator for x in a))
    return [x.numerator * (below // x.denominator) for x in a], below


def _product(a: Sequence[Any], b: Sequence[Any]) -> Quaternion:
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


def conjugate(a: Sequence[Any]) -> Quaternion:
    """The conjugate (a0, -a1, -a2, -a3)."""
    return (a[0], -a[1], -a[2], -a[3])


def norm_squared(a: Sequence[Any]) -> Any:
    """The sum of squares, without complex conjugation."""
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2] + a[3] * a[3]


def scale(a: Sequence[Any], factor: Any) -> Quaternion:
    """All entries times ``factor``."""
    return tuple(x * factor for x in a)


def add(a: Sequence[Any], b: Sequence[Any]) -> Quaternion:
    """The sum."""
    return tuple(x + y for x, y in zip(a, b, strict=True))


def K(a: Sequence[Any]) -> Matrix:
    """K(a) of T25; its transpose times b is the product ab."""
    return (
        (a[0], a[1], a[2], a[3]),
        (-a[1], a[0], a[3], -a[2]),
        (-a[2], -a[3], a[0], a[1]),
        (-a[3], a[2], -a[1], a[0]),
    )


def K_tilde(a: Sequence[Any]) -> Matrix:
    """K~(a) of T25; its transpose times b is the product ba."""
    return (
        (a[0], a[1], a[2], a[3]),
        (-a[1], a[0], -a[3], a[2]),
        (-a[2], a[3], a[0], -a[1]),
        (-a[3], -a[2], a[1], a[0]),
    )


def H(a: Sequence[Any]) -> Matrix:
    """H(a) of T25: the last three rows of K(a)."""
    return K(a)[1:]


def H_tilde(a: Sequence[Any]) -> Matrix:
    """H~(a) of T25: the last three rows of K~(a)."""
    return K_tilde(a)[1:]


def R(a: Sequence[Any]) -> Matrix:
    """R(a) = H~(a) H(a)^T: the rotation matrix times the squared norm of ``a``."""
    a0, a1, a2, a3 = a
    s0, s1, s2, s3 = a0 * a0, a1 * a1, a2 * a2, a3 * a3
    p01, p02, p03 = a0 * a1, a0 * a2, a0 * a3
    p12, p13, p23 = a1 * a2, a1 * a3, a2 * a3
    return (
        (s0 + s1 - s2 - s3, 2 * (p12 - p03), 2 * (p13 + p02)),
        (2 * (p12 + p03), s0 - s1 + s2 - s3, 2 * (p23 - p01)),
        (2 * (p13 - p02), 2 * (p23 + p01), s0 - s1 - s2 + s3),
    )


def quaternion_of(matrix: Any) -> tuple[Any, ...]:
    """A quaternion, of any length, whose rotation is a matrix, shape ``(3, 3)``.

    The eigenvector of eigenvalue 1 of Davenport's matrix, by the row of its largest entry.
    """
    (a, b, c), (d, e, f), (g, h, i) = matrix
    rows = (
        (1 + a + e + i, h - f, c - g, d - b),
        (h - f, 1 + a - e - i, b + d, c + g),
        (c - g, b + d, 1 - a + e - i, f + h),
        (d - b, c + g, f + h, 1 - a - e + i),
    )
    return rows[max(range(4), key=lambda k: rows[k][k])]


def rotate(a: Sequence[Any], v: Sequence[Any]) -> Vector:
    """R(a) v."""
    return tuple(row[0] * v[0] + row[1] * v[1] + row[2] * v[2] for row in R(a))


def dual_multiply(x: DualQuaternion, y: DualQuaternion) -> DualQuaternion:
    """The product of two dual quaternions."""
    return multiply(x[0], y[0]), add(multiply(x[0], y[1]), multiply(x[1], y[0]))


def dual_conjugate(x: DualQuaternion) -> DualQuaternion:
    """The conjugate of both parts."""
    return conjugate(x[0]), conjugate(x[1])


def line(point: Sequence[Any], axis: Sequence[Any]) -> DualQuaternion:
    """The line through ``point`` along ``axis``: axis + eps (point x axis).

    Its square is minus the squared length of ``axis``; c + s h turns by the angle whose half has
    cosine and sine proportional to c and s times that length.
    """
    zero = axis[0] - axis[0]
    return (zero, *axis), (zero, *cross(point, axis))


def translation(x: DualQuaternion) -> tuple[Vector, Any]:
    """Where a displacement takes the origin, as numerators and their common denominator."""
    moved = multiply(x[1], conjugate(x[0]))
    return tuple(2 * y for y in moved[1:]), norm_squared(x[0])
