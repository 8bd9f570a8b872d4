"""Bennett's mechanisms B_H with q5 = 0, where a_2 = 0: the end of T25 section 6."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from nag.symbolic.bennett import coefficients_without_q5


def first_parameter(m0: Any) -> Any:
    """The m_1 for which q5 = m_1 (m_0^2 - 1) - 2 m_0 vanishes."""
    return 2 * m0 / (m0**2 - 1)


def variety(
    m: Sequence[Any], a0: Any, a3: Any, c0: Any, c2: Any, printed: bool = False
) -> list[Any]:
    """The three equations in the essential variables, for (m_0, m_2).

    ``printed``: with the misprinted denominator of the second one.
    """
    m0, m2 = m
    base = m2 if printed else m0
    return [
        (m0**2 + 1) ** 2 / (m0**2 - 1) ** 2 * a0**2 + a3**2 - 1,
        m2**2 * c0**2
        + 4 * m0**2 / (m0**2 - 1) ** 2 * c2**2
        - 4 * m0**2 * m2**2 / ((base**2 - 1) ** 2 * m2**2 + 4 * m0**2),
        2 * m0 * c2 * a3 + (m0**2 + 1) * c0 * a0,
    ]


def essential_to_all(
    m: Sequence[Any], a0: Any, a3: Any, c0: Any, c2: Any, printed: bool = False
) -> list[tuple[Any, ...]]:
    """All of a, b, c; ``printed``: with the coefficients of a_3 c_0 in b_2 and b_3 exchanged."""
    m0, m2 = m
    m1 = first_parameter(m0)
    t0, t1, t2, t4 = coefficients_without_q5((m0, m1, m2))
    u2, u3 = -a3 * c0, m2 * (m0**2 - 1) / (2 * m0) * a3 * c0
    if printed:
        u2, u3 = u3, u2
    a = (a0, m1 * a0, 0 * a0, a3)
    b = (t0 * a0 * c0, t1 * a0 * c0, t2 * a0 * c2 + u2, t4 * a0 * c2 + u3)
    c = (c0, m2 * (m0**2 - 1) / (2 * m0) * c0, c2, 2 * m0 / (m2 * (m0**2 - 1)) * c2)
    return [a, b, c]


def parametrisation(m: Sequence[Any], cos: Any, sin: Any, root6: Any) -> tuple[Any, ...]:
    """The one that begins with a_0 = (m_0^2 - 1) cos t/(m_0^2 + 1): a0, a3, c0, c2."""
    m0, m2 = m
    m1 = first_parameter(m0)
    return (m0**2 - 1) / (m0**2 + 1) * cos, sin, -m1 * m2 * sin / root6, m2 * cos / root6
