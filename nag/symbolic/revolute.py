"""Revolute joints: the two directions of the axis, T25 section 3."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

Vector = Sequence[Any]


def component(u: Vector, z: Vector, j: int) -> list[Any]:
    """Equation (8): k_1^j to k_5^j, the component of I_rev with equal (1) or opposite (2) axes.

    The norms |u|^2 - 1 and |z|^2 - 1 belong to it.
    """
    u0, u1, u2, u3 = u
    z0, z1, z2, z3 = z
    if j == 1:
        return [
            z1 * u3 + z0 * u2 - z3 * u1 - z2 * u0,
            z2 * u3 - z3 * u2 - z0 * u1 + z1 * u0,
            z3 * z1 + z2 * z0 - u3 * u1 - u2 * u0,
            z3 * z2 - z1 * z0 - u3 * u2 + u1 * u0,
            z2**2 + z1**2 - u2**2 - u1**2,
        ]
    return [
        z0 * u3 - z1 * u2 + z2 * u1 - z3 * u0,
        z3 * u3 + z2 * u2 + z1 * u1 + z0 * u0,
        z3 * z1 + z2 * z0 + u3 * u1 + u2 * u0,
        z3 * z2 - z1 * z0 + u3 * u2 - u1 * u0,
        z3**2 + z0**2 - u2**2 - u1**2,
    ]


def turn_to_axis(chi: Vector) -> tuple[Any, ...]:
    """Lemma 3.2: beta with |beta|^2 chi = R(beta) e^3, for |chi| = 1; |beta|^2 = 2 (1 + chi_3)."""
    return (1 + chi[2], -chi[1], chi[0], 0 * chi[0])


def eigenvectors(eta: Vector) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """Proof of lemma 3.4: w^1 and w^2, the turns that take e^1 to eta."""
    e1, e2, e3 = eta
    return (e2, e3, 0 * e1, 1 - e1), (-e3, e2, 1 - e1, 0 * e1)


def turns_to_frame(eta: Vector, xi: Vector) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """Lemma 3.4: alpha^1 and alpha^2, the turns that take e^1 to eta and e^2 to xi."""
    e1, e2, e3 = eta
    x1, x2, x3 = xi
    first = (
        e2 - x1,
        e2 * x3 - x2 * e3 + e3,
        x1 * e3 - x3 * e1 + x3,
        1 - e2 * x1 + x2 * e1 - x2 - e1,
    )
    second = (
        e2 * x3 - x2 * e3 - e3,
        e2 + x1,
        1 + e2 * x1 - x2 * e1 + x2 - e1,
        x1 * e3 - x3 * e1 + x3,
    )
    return first, second


def squared_lengths(eta: Vector, xi: Vector) -> tuple[Any, Any]:
    """End of section 3: |alpha^1|^2 and |alpha^2|^2."""
    e1, e2, _ = eta
    x1, x2, _ = xi
    return 4 * (1 - e1 - x2 + e1 * x2 - e2 * x1), 4 * (1 - e1 + x2 - e1 * x2 + e2 * x1)
