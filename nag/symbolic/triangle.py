"""Three bars in space, PT13 section 5.2."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


def constants(L1: Any, L2: Any) -> tuple[Any, Any, Any]:
    """alpha_0, alpha_1 and alpha_2 for sides 1, L1, L2."""
    return (
        (L2 - L1 + 1) * (L2 + L1 - 1),
        (L1 - L2 + 1) * (L1 + L2 - 1),
        (L1 - L2 + 1) * (L1 + L2 + 1),
    )


def equations(L1: Any, L2: Any, a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    """q_0, q_1, q_2 of (I + L1 R(a) + L2 R(b)) e^1 = 0, and p_a, p_b of (7)."""
    first, second = _first_column(a), _first_column(b)
    loop = [L1 * x + L2 * y for x, y in zip(first, second, strict=True)]
    loop[0] = loop[0] + 1
    return [*loop, sum(x * x for x in a) - 1, sum(x * x for x in b) - 1]


def basis(L1: Any, L2: Any, a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    """g_0 to g_4; what the paper leaves out of g_3 and g_4 is written out."""
    a0, a1, a2, a3 = a
    b0, b1, b2, b3 = b
    alpha = constants(L1, L2)
    y, z = a1 * a2 + a0 * a3, a1 * a3 - a0 * a2
    return [
        4 * L1 * (a1**2 + a0**2) - alpha[0],
        4 * L2 * (b1**2 + b0**2) - alpha[1],
        4 * L1 * (a3**2 + a2**2) - alpha[2],
        alpha[1] * b2 + 4 * L1 * (b1 * y - b0 * z),
        alpha[1] * b3 + 4 * L1 * (b0 * y + b1 * z),
    ]


def _first_column(a: Sequence[Any]) -> tuple[Any, Any, Any]:
    a0, a1, a2, a3 = a
    return (2 * (a0**2 + a1**2) - 1, 2 * (a1 * a2 + a0 * a3), 2 * (a1 * a3 - a0 * a2))
