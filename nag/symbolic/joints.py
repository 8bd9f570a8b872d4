"""Rotations by Euler parameters, and the prime components of joints in the papers' first frames.

The rotation matrix is that of T25 section 2.1, the components are those of PT13 section 5.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

Quaternion = Sequence[Any]


def R(a: Sequence[Any]) -> tuple[tuple[Any, ...], ...]:
    """R(a), for |a| = 1 a rotation."""
    a0, a1, a2, a3 = a
    return (
        (a0**2 + a1**2 - a2**2 - a3**2, 2 * a1 * a2 - 2 * a0 * a3, 2 * a1 * a3 + 2 * a0 * a2),
        (2 * a1 * a2 + 2 * a0 * a3, a0**2 - a1**2 + a2**2 - a3**2, 2 * a2 * a3 - 2 * a0 * a1),
        (2 * a1 * a3 - 2 * a0 * a2, 2 * a2 * a3 + 2 * a0 * a1, a0**2 - a1**2 - a2**2 + a3**2),
    )


def rotate(a: Sequence[Any], v: Sequence[Any]) -> tuple[Any, ...]:
    """R(a) v."""
    return tuple(inner(row, v) for row in R(a))


def rotate_back(a: Sequence[Any], v: Sequence[Any]) -> tuple[Any, ...]:
    """R(a)^T v: a global vector in the frame of a body."""
    return tuple(inner(column, v) for column in zip(*R(a), strict=True))


def inner(u: Sequence[Any], v: Sequence[Any]) -> Any:
    """<u, v>."""
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def turned_frame(alpha: Sequence[Any], a: Sequence[Any]) -> tuple[Any, ...]:
    """K~(alpha)^T a of T25 (1) and (9), with R(turned_frame(alpha, a)) = R(a) R(alpha)."""
    p, q, r, s = alpha
    a0, a1, a2, a3 = a
    return (
        p * a0 - q * a1 - r * a2 - s * a3,
        q * a0 + p * a1 + s * a2 - r * a3,
        r * a0 - s * a1 + p * a2 + q * a3,
        s * a0 + r * a1 - q * a2 + p * a3,
    )


def orientation(a: Quaternion) -> tuple[tuple[Any, ...], ...]:
    """PT13 section 3: the rotation matrix of unit Euler parameters, half of each entry."""
    a0, a1, a2, a3 = a
    half = (a0 - a0 + 1) / 2
    return (
        (a0**2 + a1**2 - half, a1 * a2 - a0 * a3, a1 * a3 + a0 * a2),
        (a1 * a2 + a0 * a3, a0**2 + a2**2 - half, a2 * a3 - a0 * a1),
        (a1 * a3 - a0 * a2, a2 * a3 + a0 * a1, a0**2 + a3**2 - half),
    )


def revolute_12(a: Quaternion, b: Quaternion) -> list[Any]:
    """Equation (12): g_1 to g_5. It is the component of R(b) e^3 = R(a) e^2."""
    a0, a1, a2, a3 = a
    b0, b1, b2, b3 = b
    return [
        (a2 - a3) * b0 + (a3 + a2) * b1 - (a1 + a0) * b2 + (a0 - a1) * b3,
        (a0 - a1) * b0 + (a1 + a0) * b1 + (a3 + a2) * b2 + (a3 - a2) * b3,
        2 * a0**2 + 2 * a2**2 + 2 * b1 * b0 - 2 * b3 * b2 - 1,
        2 * b1**2 + 2 * b2**2 + 2 * a1 * a0 + 2 * a3 * a2 - 1,
        b3 * b1 + b2 * b0 - a2 * a1 + a3 * a0,
    ]


def cylindrical_13(a: Quaternion, b: Quaternion) -> list[Any]:
    """Equation (13): h_1 to h_5, the component of R(b) e^1 = R(a) e^1."""
    a0, a1, a2, a3 = a
    b0, b1, b2, b3 = b
    return [
        b1**2 + b0**2 - a1**2 - a0**2,
        b0 * a3 - b1 * a2 + b2 * a1 - b3 * a0,
        b1 * a3 + b0 * a2 - b3 * a1 - b2 * a0,
        b2 * b1 + b3 * b0 - a2 * a1 - a3 * a0,
        b3 * b1 - b2 * b0 - a3 * a1 + a2 * a0,
    ]


def translational(a: Quaternion, b: Quaternion) -> list[Any]:
    """The generators printed for I_tra besides |a|^2 - 1: b is a after half a turn about e^1."""
    a0, a1, a2, a3 = a
    b0, b1, b2, b3 = b
    return [b0 - a1, b1 + a0, b2 + a3, b3 - a2]


def universal(a: Quaternion, b: Quaternion) -> Any:
    """p_6 = <R(a) e^3, R(b) e^3>."""
    e3 = (0, 0, 1)
    return inner(rotate(a, e3), rotate(b, e3))


# Table 1: numbers of C-, SO- and O-constraints, and of conditions.
TABLE_1 = {
    "spherical": (1, 0, 0, 3),
    "universal": (1, 1, 0, 4),
    "revolute": (1, 2, 0, 5),
    "cylindrical": (0, 2, 2, 4),
    "translational": (0, 3, 2, 5),
}
