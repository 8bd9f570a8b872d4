"""The slider crank, PT13 section 7.2."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

LENGTHS = (2, 1, 1)
# s_1, s_2, s_3 at the two singular points; c_1 = c_2 = c_3 = 0.
SINGULAR = ((-1, 1, 1), (1, -1, -1))


def equations(lengths: Sequence[Any], c: Sequence[Any], s: Sequence[Any]) -> list[Any]:
    """Equation (15), for bars of any lengths."""
    loop = lengths[0] * s[0] + lengths[1] * s[1] + lengths[2] * s[2]
    return [loop, *(x**2 + y**2 - 1 for x, y in zip(c, s, strict=True))]


def quartic(c1: Any, c2: Any, c3: Any) -> Any:
    """The quartic q in c_1, c_2, c_3."""
    return (
        c3**4
        - 2 * c3**2 * c2**2
        + c2**4
        - 8 * c3**2 * c1**2
        - 8 * c2**2 * c1**2
        + 16 * c1**4
        + 8 * (c3**2 + c2**2 - 2 * c1**2)
    )


def tangent_cone(c1: Any, c2: Any, c3: Any) -> Any:
    """The tangent cone at a singular point, in the space of the c."""
    return 2 * c1**2 - c2**2 - c3**2


def singular_lengths(L1: Any, L2: Any, L3: Any) -> tuple[Any, Any, Any]:
    """End of section 7.2: singular points only where one of these vanishes."""
    return L1 - L2 - L3, L1 + L2 - L3, L1 - L2 + L3
