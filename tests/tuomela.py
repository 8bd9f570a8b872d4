"""Formulas of Tuomela 2025 (T25), sections 5 and 6, as printed; what is mended says so."""

from __future__ import annotations

from typing import Any

from nag.mechanism.axes import Vector, difference


def short(m: tuple) -> dict[str, Any]:
    """The abbreviations q, r and q0 to q5."""
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


def points(m: tuple) -> list[Vector]:
    """Lemma 5.1."""
    m0, m1, m2 = m
    r = short(m)["r"]
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


def links(m: tuple) -> list[Vector]:
    p = points(m)
    return [difference(p[(i + 1) % 4], p[i]) for i in range(4)]


def points_11(m: tuple) -> tuple[Vector, Vector]:
    """Equation (11): the points p^2 and p^3 as polynomials over a common denominator."""
    m0, m1, m2 = m
    q = short(m)["q"]
    f2 = 2 / (q * (m1**2 + 1))
    f3 = (m0**2 + 1) * (m2 - 1) / (q * (m1**2 + m2**2))
    p2 = (
        m0**2 * (m2 - 1) * (m2 - m1**2) + (m2 + 1) * (m2 + m1**2),
        m1 * (m0**2 - 1) * (1 - m2**2),
        2 * m0 * m1 * (1 - m2**2),
    )
    p3 = (m2**2 - m1**2, 2 * m1 * m2, 0 * m0)
    return tuple(f2 * x for x in p2), tuple(f3 * x for x in p3)


def axes(m: tuple, mended: bool = True) -> list[Vector]:
    """Lemma 5.3; ``mended``: with the second entries of chi^2 and chi^3 corrected."""
    m0, m1, m2 = m
    q = short(m)["q"]
    n0, n1, n2 = m0**2 + 1, m1**2 + 1, m1**2 + m2**2
    zero = 0 * m0
    sign = -1 if mended else 1
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


def across(chi: Vector, mended: bool = True) -> tuple[Vector, Vector]:
    """Lemma 5.4: eta and xi; ``mended``: with the sign in eta's first entry corrected."""
    x, y, z = chi
    sign = 1 if mended else -1
    eta = ((z * x**2 + sign * y**2) / (1 - z**2), -x * y / (1 + z), -x)
    xi = (-x * y / (1 + z), z + x**2 / (1 + z), -y)
    return eta, xi


def orientations(m: tuple) -> list[tuple]:
    """Lemma 6.1: a_init, b_init and c_init."""
    m0, m1, m2 = m
    s = short(m)
    n0, n1, n2 = m0**2 + 1, m1**2 + 1, m1**2 + m2**2
    a = (m1, m1**2, s["q5"] / n0, (m0**2 + 2 * m0 * m1 - 1) / n0)
    b = (
        m1 * (m2**2 - 1) * s["q0"],
        m1 * (m2**2 - 1) * s["q1"],
        (1 - m2) * (m1**2 - m2) * s["q1"]
        + 2 * s["q2"]
        - 8 * n2 * (m1**2 * m0 + m2 * m1 + m2 * m0 - m1) / n0,
        (1 - m2) * (m1**2 - m2) * s["q0"]
        + 2 * s["q3"]
        + 8 * n2 * (m2 * m1 * m0 - m1**2 - m1 * m0 - m2) / n0,
    )
    c = (-m1 * m2, -(m2**2), m1 * m2, m1**2)
    return [
        tuple(x / n1 for x in a),
        tuple(x / (n1 * n2 * s["q"]) for x in b),
        tuple(x / n2 for x in c),
    ]


def bennetts_ideal(m: tuple, a: tuple, c: tuple) -> list:
    """g_0, g_1, g_3 and g_4 of (17); g_4 in its second form."""
    m0, m1, m2 = m
    q5 = short(m)["q5"]
    n0, n1, n2 = m0**2 + 1, m1**2 + 1, m1**2 + m2**2
    return [
        a[0] ** 2 + n0**2 / q5**2 * a[2] ** 2 - 1 / n1,
        m2**2 * c[0] ** 2 + m1**2 * c[2] ** 2 - m1**2 * m2**2 / n2,
        m1 * n0 * c[2] * a[2] + q5 * c[0] * a[0],
        (m2**2 - 1) * n1 * n2 * c[0] ** 2 * a[0] ** 2
        - m2**2 * (n2 * c[0] ** 2 + m1**2 * n1 * a[0] ** 2 - m1**2),
    ]


def essential_to_all(m: tuple, a0: Any, a2: Any, c0: Any, c2: Any) -> list[tuple]:
    """(16), (18) and (19): all Euler parameters a, b, c from the essential ones."""
    m0, m1, m2 = m
    s = short(m)
    q, q4, q5 = s["q"], s["q4"], s["q5"]
    t0 = (m2**2 - 1) * s["q0"] / (m1 * m2 * q)
    t1 = (m2**2 - 1) * s["q1"] / (m1 * m2 * q)
    t2 = m1 * (m2 - 1) * (q4**2 - 4 * m0**2) + 4 * m0 * q4 * (m1**2 + m2)
    t3 = m1 * (m2 - 1) * (m0**2 - 1) - 2 * m0 * (m2 + m1**2)
    t4 = (m1**2 + m2) * (q4**2 - 4 * m0**2) - 4 * m0 * m1 * (m2 - 1) * q4
    t5 = (m2 + m1**2) * (m0**2 - 1) + 2 * m0 * m1 * (m2 - 1)
    t2, t4 = (t / (m2 * (m0**2 + 1) * q) for t in (t2, t4))
    t3, t5 = (t / (m1 * q5) for t in (t3, t5))
    a = (a0, m1 * a0, a2, (m0**2 + 2 * m0 * m1 - 1) / q5 * a2)
    b = (t0 * a0 * c0, t1 * a0 * c0, t2 * a0 * c2 + t3 * a2 * c0, t4 * a0 * c2 + t5 * a2 * c0)
    c = (c0, m2 / m1 * c0, c2, m1 / m2 * c2)
    return [a, b, c]


def bricard_10(a0: Any, a2: Any, c2: Any) -> list[tuple]:
    """(10): Euler parameters a to e of Bricard's cube from the essential ones."""
    half = 0 * a0 + 1
    half = half / 2
    b = (half, 2 * a2 * (a2 - c2), a2 / (2 * a0), 2 * a0 * (a2 - c2))
    c0 = a0 - 1 / (4 * a0)
    e0 = 1 / (4 * a0)
    return [
        (a0, a0, a2, -a2),
        b,
        (c0, -c0, c2, 2 * a2 - c2),
        (b[1], half, -b[3], b[2]),
        (e0, e0, c2 - a2, c2 - a2),
    ]
