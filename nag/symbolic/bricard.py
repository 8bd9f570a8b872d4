"""Bricard's mechanism on the edges of a cube, T25 section 4 and PT13 section 5.5."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

Quaternion = Sequence[Any]

HALF = Fraction(1, 2)
POINTS = ((0, 0, 1), (1, 0, 1), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 1, 1))
AXES = ((0, 0, 1), (0, 1, 0), (1, 0, 0)) * 2
# a_init to e_init.
ORIENTATIONS = (
    (HALF, HALF, HALF, -HALF),
    (HALF, HALF, HALF, HALF),
    (Fraction(0), Fraction(0), Fraction(0), Fraction(1)),
    (HALF, HALF, -HALF, HALF),
    (HALF, HALF, -HALF, -HALF),
)
# Joint J_2: alpha and w of lemma 3.4 as chosen there.
TURN = (1, -1, 1, 1)
EIGENVECTOR = (1, 0, 1, 0)


def joint_1(a: Quaternion) -> list[Any]:
    """I_a: the constraints of joint J_1 and the norm."""
    a0, a1, a2, a3 = a
    return [
        a0**2 + a1**2 + a2**2 + a3**2 - 1,
        a0 * a2 + a1 * a3,
        -(a0**2) + a1**2 + a2**2 - a3**2,
    ]


def joint_1_component(a: Quaternion, j: int) -> list[Any]:
    """I_{a,0} and I_{a,1}; the second is that of the initial position."""
    a0, a1, a2, a3 = a
    sign = 1 if j == 0 else -1
    return [2 * a2**2 + 2 * a0**2 - 1, a1 + sign * a0, a3 - sign * a2]


def joint_2_turned(a: Quaternion) -> tuple[Any, ...]:
    """u of joint J_2, from (9)."""
    a0, a1, a2, a3 = a
    half = (a0 - a0 + 1) / 2
    return (
        half * (-a3 - a2 + a1 + a0),
        half * (-a3 + a2 + a1 - a0),
        half * (-a3 + a2 - a1 + a0),
        half * (a3 + a2 + a1 + a0),
    )


def joint_2_component(a: Quaternion, b: Quaternion) -> list[Any]:
    """k_1^1 to k_5^1 of joint J_2."""
    a0, a1, a2, a3 = a
    b0, b1, b2, b3 = b
    return [
        (b3 + b2 + b1 - b0) * a3
        + (-b3 + b2 + b1 + b0) * a2
        + (-b3 - b2 + b1 - b0) * a1
        + (b3 - b2 + b1 + b0) * a0,
        (b3 + b2 - b1 + b0) * a3
        + (-b3 + b2 - b1 - b0) * a2
        + (b3 + b2 + b1 - b0) * a1
        + (-b3 + b2 + b1 + b0) * a0,
        b3 * b1 + b2 * b0 - a2 * a1 + a3 * a0,
        2 * b3 * b2 - 2 * b1 * b0 + a3**2 - a2**2 + a1**2 - a0**2,
        2 * b2**2 + 2 * b1**2 - a3**2 + 2 * a3 * a2 - a2**2 - a1**2 + 2 * a1 * a0 - a0**2,
    ]


def two_joints_basis(a: Quaternion, b: Quaternion) -> list[Any]:
    """g_0 to g_9, the basis of I_1, lexicographic with a3 > a1 > b3 > b1 > b2 > b0 > a2 > a0."""
    a0, a1, a2, a3 = a
    b0, b1, b2, b3 = b
    return [
        2 * a2**2 + 2 * a0**2 - 1,
        b2 * a0 - b0 * a2,
        b1**2 + b2**2 + 2 * a0**2 - 1,
        2 * b3 * a0**2 - b3 + 2 * b1 * a2 * a0,
        b3 * a2 - b1 * a0,
        b3 * b2 - b1 * b0,
        b3 * b1 + b2 * b0 - 2 * a2 * a0,
        b3**2 + b0**2 - 2 * a0**2,
        a1 - a0,
        a3 + a2,
    ]


def variety(a0: Any, a2: Any, c2: Any) -> list[Any]:
    """h_0 and h_1, the generators of I_bric."""
    return [2 * a2**2 + 2 * a0**2 - 1, 16 * a0**2 * (c2**2 - 2 * c2 * a2 - a0**2) + 1]


def basis(bodies: Sequence[Quaternion]) -> list[Any]:
    """h_0 to h_18, in this order; ``bodies`` are a, b, c, d, e."""
    (a0, a1, a2, a3), b, c, d, e = bodies
    c2 = c[2]
    x = c2**2 - 2 * c2 * a2 - a0**2
    return [
        *variety(a0, a2, c2),
        a1 - a0,
        a3 + a2,
        c[0] - 4 * a0 * x - a0,
        c[1] + 4 * a0 * x + a0,
        c[3] + c2 - 2 * a2,
        2 * b[0] - 1,
        b[1] + 2 * a2 * (c2 - a2),
        b[2] + 8 * a0 * a2 * x,
        b[3] + 2 * a0 * (c2 - a2),
        d[0] + 2 * a2 * (c2 - a2),
        2 * d[1] - 1,
        d[2] + 2 * a0 * (a2 - c2),
        d[3] + 8 * a0 * a2 * x,
        e[0] + 4 * a0 * x,
        e[1] + 4 * a0 * x,
        e[2] - c2 + a2,
        e[3] - c2 + a2,
    ]


def essential_to_all(a0: Any, a2: Any, c2: Any) -> list[tuple[Any, ...]]:
    """Equation (10): Euler parameters a to e from the essential ones."""
    half = (0 * a0 + 1) / 2
    b = (half, 2 * a2 * (a2 - c2), a2 / (2 * a0), 2 * a0 * (a2 - c2))
    c0, e0 = a0 - 1 / (4 * a0), 1 / (4 * a0)
    return [
        (a0, a0, a2, -a2),
        b,
        (c0, -c0, c2, 2 * a2 - c2),
        (b[1], half, -b[3], b[2]),
        (e0, e0, c2 - a2, c2 - a2),
    ]


def parametrisation(cos: Any, sin: Any, root2: Any, root: Any) -> tuple[Any, Any, Any]:
    """After (10): a0, a2 and c2; ``root2`` is sqrt(2), ``root`` +-sqrt(4 cos^2 - 1)."""
    return cos / root2, sin / root2, sin / root2 + root / (2 * root2 * cos)


def variety_14(x: Any, y: Any, z: Any) -> list[Any]:
    """PT13 (14), the generators of I_17."""
    return [
        2 * x**2 + 2 * y**2 - 1,
        16 * x**2 * z**2 + 32 * x**2 * y * z - 16 * x**4 + 1,
    ]
