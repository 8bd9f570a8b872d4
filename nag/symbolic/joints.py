"""Prime components of joints in the papers' first frames, PT13 section 5.4."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from nag.symbolic.rotation import inner, rotate

Quaternion = Sequence[Any]


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
