"""Revolute joints: the two directions of the axis, T25 section 3."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from nag.symbolic.joints import inner, turned_frame

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


def component_in_frames(eta: Vector, xi: Vector, chi: Vector, a: Vector, b: Vector, j: int) -> Any:
    """The component of I_ab (7) with R(b) chi = R(a)(eta x xi) (j = 1) or its opposite (2).

    k_1^j to k_5^j at the u and z of (9), without their square roots; the first two are multiplied
    by |alpha||beta|. The norms |a|^2 - 1 and |b|^2 - 1 belong to it.

    Args:
        eta, xi: orthonormal vectors across the axis in the frame of a.
        chi: the axis as a unit vector in the frame of b.
    """
    alpha, beta = turn_to_frame(eta, xi), turn_from_e3(chi)
    u, z = turned_frame(alpha, a), turned_frame(beta, b)
    zero = [0 * x for x in u]
    bilinear = component(u, z, j)[:2]
    of_u, of_z = component(u, zero, j)[2:], component(zero, z, j)[2:]
    m, n = sum(x * x for x in alpha), sum(x * x for x in beta)
    return [*bilinear, *(f / m + g / n for f, g in zip(of_u, of_z, strict=True))]


def eigenplane(v: Vector, y: Vector, a: Vector, lengths: tuple[Any, Any]) -> tuple[Any, Any]:
    """Lemma 2.1, 4: the two linear equations of La = |v||y|a; ``lengths`` are |v| and |y|."""
    (a0, *rest), (lv, ly) = a, lengths
    cross = (y[1] * v[2] - y[2] * v[1], y[2] * v[0] - y[0] * v[2], y[0] * v[1] - y[1] * v[0])
    along = [ly * p - lv * q for p, q in zip(v, y, strict=True)]
    return (lv * ly - inner(v, y)) * a0 + inner(rest, cross), inner(along, rest)


def turn_from_e3(chi: Vector) -> tuple[Any, ...]:
    """Lemma 3.2, and half a turn about e^1 for -e^3, which it leaves out."""
    beta = turn_to_axis(chi)
    zero = 0 * chi[0]
    return beta if any(beta) else (zero, zero + 1, zero, zero)


def turn_to_frame(eta: Vector, xi: Vector) -> tuple[Any, ...]:
    """Lemma 3.3: alpha of lemma 3.4 that is not 0, and a turn about e^1 if eta is e^1."""
    for alpha in turns_to_frame(eta, xi):
        if any(alpha):
            return alpha
    zero = 0 * xi[0]
    about_e1 = (1 + xi[1], xi[2], zero, zero)
    return about_e1 if any(about_e1) else (zero, zero + 1, zero, zero)


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
