"""Bennett's mechanisms B_H: points, axes and frames, T25 section 5, for parameters m0, m1, m2."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

Parameters = Sequence[Any]
Vector = tuple[Any, Any, Any]


def abbreviations(m: Parameters) -> dict[str, Any]:
    """r and q of lemma 5.1, q0 to q5 of lemma 6.1."""
    m0, m1, m2 = m
    q = m0**2 * (m2 - 1) ** 2 + (m2 + 1) ** 2
    q4 = m0**2 * (m2 - 1) + m2 + 1
    return {
        "q": q,
        "r": (m0**2 + 1) * (1 - m2**2) / q,
        "q0": q4 * (m1**2 + m2) - 2 * m0 * (m2 - 1) * m1,
        "q1": q4 * m1 * (m2 - 1) + 2 * m0 * (m1**2 + m2),
        "q2": (1 - m2) * (m1**2 + m2**2) * (m1**2 * m0 + m2 * m1 + m2 * m0 - 3 * m1),
        "q3": (m1**2 + m2**2)
        * (m2 * m1 * (m2 * m0 - m1 - 2 * m0) - m2**2 + 3 * m1**2 + m1 * m0 + 3 * m2),
        "q4": q4,
        "q5": m1 * (m0**2 - 1) - 2 * m0,
    }


def points(m: Parameters) -> list[Vector]:
    """Lemma 5.1: p^0 to p^3."""
    m0, m1, m2 = m
    r = abbreviations(m)["r"]
    n0, n1, n2 = m0**2 + 1, m1**2 + 1, m1**2 + m2**2
    zero = 0 * m0
    return [
        (zero, zero, zero),
        (zero + 1, zero, zero),
        (
            1 + r * (m1**2 - 1) / n1,
            2 * r * m1 * (m0**2 - 1) / (n0 * n1),
            4 * r * m0 * m1 / (n0 * n1),
        ),
        (r * (m1**2 - m2**2) / n2, 2 * r * m1 * m2 / n2, zero),
    ]


def links(m: Parameters) -> list[Vector]:
    """v^0 to v^3, each link from its joint to the next."""
    p = points(m)
    return [tuple(y - x for x, y in zip(p[i], p[(i + 1) % 4], strict=True)) for i in range(4)]


def points_11(m: Parameters, printed: bool = False) -> tuple[Vector, Vector]:
    """Equation (11): p^2 and p^3 over a common denominator; p^3 is misprinted."""
    m0, m1, m2 = m
    q = abbreviations(m)["q"]
    f2 = 2 / (q * (m1**2 + 1))
    p2 = (
        m0**2 * (m2 - 1) * (m2 - m1**2) + (m2 + 1) * (m2 + m1**2),
        m1 * (m0**2 - 1) * (1 - m2**2),
        2 * m0 * m1 * (1 - m2**2),
    )
    f3 = (m0**2 + 1) * ((m2 - 1) if printed else (m2**2 - 1)) / (q * (m1**2 + m2**2))
    p3 = (m2**2 - m1**2, (2 if printed else -2) * m1 * m2, 0 * m0)
    return tuple(f2 * x for x in p2), tuple(f3 * x for x in p3)


def same_points(m: Parameters) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """Lemma 5.2: g_1(m) and g_2(m), which have the points of m."""
    m0, m1, m2 = m
    return (m0, -1 / m1, 1 / m2), (-1 / m0, -m1, -m2)


def axes(m: Parameters, printed: bool = False) -> list[Vector]:
    """Lemma 5.3: chi^0 to chi^3; the second entries of chi^2 and chi^3 are misprinted."""
    m0, m1, m2 = m
    q = abbreviations(m)["q"]
    n0, n1, n2 = m0**2 + 1, m1**2 + 1, m1**2 + m2**2
    zero = 0 * m0
    sign = 1 if printed else -1
    chi2 = (
        4 * m0 * m1 * (1 - m2**2) * n0,
        4 * m0 * (sign * (m0**2 - 1) * n2 + m2 * n0 * n1),
        (m2 - 1) ** 2 * n1 * m0**4
        + 2 * ((m2**2 - 3) * m1**2 - 3 * m2**2 + 1) * m0**2
        + (m2 + 1) ** 2 * n1,
    )
    chi3 = (
        4 * m0 * m1 * m2 * (1 - m2**2),
        sign * 2 * m0 * (m1**2 - m2**2) * (1 - m2**2),
        (m0 * m2 - m0 + m2 + 1) * (m0 * m2 - m0 - m2 - 1) * n2,
    )
    return [
        (zero, zero, zero + 1),
        (zero, -2 * m0 / n0, (m0**2 - 1) / n0),
        tuple(x / (n0 * n1 * q) for x in chi2),
        tuple(x / (n2 * q) for x in chi3),
    ]


def cosines(m: Parameters) -> tuple[Any, Any]:
    """Theorem 5.1: cos(phi_0) = cos(phi_2) and cos(phi_1) = cos(phi_3)."""
    m0, _, m2 = m
    q = abbreviations(m)["q"]
    return (
        (m0**2 - 1) / (m0**2 + 1),
        (m0 * m2 - m0 + m2 + 1) * (m0 * m2 - m0 - m2 - 1) / q,
    )


def across(chi: Sequence[Any], printed: bool = False) -> tuple[Vector, Vector]:
    """Lemma 5.4: eta and xi; a sign in the first entry of eta is misprinted."""
    x, y, z = chi
    sign = -1 if printed else 1
    eta = ((z * x**2 + sign * y**2) / (1 - z**2), -x * y / (1 + z), -x)
    xi = (-x * y / (1 + z), z + x**2 / (1 + z), -y)
    return eta, xi
