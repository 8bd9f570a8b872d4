"""The rotation matrix of Euler parameters as printed, T25 section 2.1."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


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
