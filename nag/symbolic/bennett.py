"""Bennett's mechanisms B_H in Euler parameters, T25 section 6.

Orientations, Bennett's variety, the 14 equations, and the mechanisms with q5 = 0, where a_2 = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from nag.symbolic import bennett_geometry
from nag.symbolic.bennett_geometry import Parameters, abbreviations
from nag.symbolic.joints import inner, rotate, rotate_back

Quaternion = Sequence[Any]


def orientations(m: Parameters) -> list[tuple[Any, ...]]:
    """Lemma 6.1: a_init, b_init and c_init."""
    m0, m1, m2 = m
    s = abbreviations(m)
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


def along_link_1(m: Parameters, a: Quaternion) -> list[Any]:
    """Proof of lemma 6.1: the basis of v^1 = r R(a) e^1, lexicographic with a3 > a2 > a1 > a0."""
    m0, m1, _ = m
    return [
        (m1**2 + 1) * (a[0] ** 2 + a[1] ** 2) - m1**2,
        2 * a[0] * m0 + a[1] * (1 - m0**2) + m1 * a[2] * (m0**2 + 1),
        a[0] * (1 - m0**2) - 2 * a[1] * m0 + m1 * a[3] * (m0**2 + 1),
    ]


def along_link_3(m: Parameters, c: Quaternion) -> list[Any]:
    """Proof of lemma 6.1: the solutions of v^3 = r R(c) e^1."""
    _, m1, m2 = m
    return [
        c[0] ** 2 + c[1] ** 2 - m2**2 / (m1**2 + m2**2),
        c[2] + m1 / m2 * c[1],
        c[3] + m1 / m2 * c[0],
    ]


def product_13(m: Parameters) -> tuple[Any, Any]:
    """Equation (13): kappa_0, the denominator of lemma 6.1, and kappa_0 kappa_1 as printed."""
    m0, m1, m2 = m
    n0, n1, n2 = m0**2 + 1, m1**2 + 1, m1**2 + m2**2
    q = m0**2 * (m2 - 1) ** 2 + (m2 + 1) ** 2
    return n1 * n2 * q, m1**2 * (m2**2 - 1) ** 2 * n0 * n1 * n2 * q


def component_a(m: Parameters, a: Quaternion) -> list[Any]:
    """Equation (14): J_a, where q5 is not 0."""
    m0, m1, _ = m
    q5 = abbreviations(m)["q5"]
    n0, n1 = m0**2 + 1, m1**2 + 1
    return [
        a[1] - m1 * a[0],
        q5 * a[3] - (m0**2 + 2 * m0 * m1 - 1) * a[2],
        n1 * q5**2 * a[0] ** 2 + n1 * n0**2 * a[2] ** 2 - q5**2,
    ]


def component_c(m: Parameters, c: Quaternion) -> list[Any]:
    """Equation (15): J_c."""
    _, m1, m2 = m
    n2 = m1**2 + m2**2
    return [
        m1 * c[1] - m2 * c[0],
        m2 * c[3] - m1 * c[2],
        m2**2 * n2 * c[0] ** 2 + m1**2 * n2 * c[2] ** 2 - m1**2 * m2**2,
    ]


def variety(m: Parameters, a0: Any, a2: Any, c0: Any, c2: Any) -> list[Any]:
    """Equation (17): g_0, g_1 and g_3, the generators of I_benn."""
    m0, m1, m2 = m
    q5 = abbreviations(m)["q5"]
    n0, n1, n2 = m0**2 + 1, m1**2 + 1, m1**2 + m2**2
    return [
        a0**2 + n0**2 / q5**2 * a2**2 - 1 / n1,
        m2**2 * c0**2 + m1**2 * c2**2 - m1**2 * m2**2 / n2,
        m1 * n0 * c2 * a2 + q5 * c0 * a0,
    ]


def g_4(m: Parameters, a0: Any, c0: Any) -> tuple[Any, Any]:
    """g_4 as in (17), and as it stands before (18)."""
    _, m1, m2 = m
    n1, n2 = m1**2 + 1, m1**2 + m2**2
    first = (m2**2 - 1) * n1 * n2 * c0**2 * a0**2
    return (
        first - m2**2 * n2 * c0**2 - m1**2 * m2**2 * n1 * a0**2 + m1**2 * m2**2,
        first - m2**2 * (n2 * c0**2 + m1**2 * n1 * a0**2 - m1**2),
    )


def gamma_4(m: Parameters) -> Any:
    """What gamma_4 of g_5 = b_0^2 - gamma_4 (..) must be by (18)."""
    _, m1, m2 = m
    t0 = coefficients(m)[0]
    return t0**2 * m2**2 / ((m2**2 - 1) * (m1**2 + 1) * (m1**2 + m2**2))


def g_5(m: Parameters, a0: Any, c0: Any, b0: Any) -> Any:
    """g_5, with that gamma_4."""
    _, m1, m2 = m
    inner = (m1**2 + m2**2) * c0**2 + m1**2 * (m1**2 + 1) * a0**2 - m1**2
    return b0**2 - gamma_4(m) * inner


def coefficients(m: Parameters) -> tuple[Any, ...]:
    """t_0 to t_5 of (18) and (19)."""
    m0, m1, _ = m
    q5 = abbreviations(m)["q5"]
    t0, t1, t2, t4 = coefficients_without_q5(m)
    _, _, m2 = m
    t3 = m1 * (m2 - 1) * (m0**2 - 1) - 2 * m0 * (m2 + m1**2)
    t5 = (m2 + m1**2) * (m0**2 - 1) + 2 * m0 * m1 * (m2 - 1)
    return t0, t1, t2, t3 / (m1 * q5), t4, t5 / (m1 * q5)


def coefficients_without_q5(m: Parameters) -> tuple[Any, ...]:
    """t_0, t_1, t_2 and t_4, which are there for q5 = 0 as well."""
    m0, m1, m2 = m
    s = abbreviations(m)
    q, q4 = s["q"], s["q4"]
    t0, t1 = ((m2**2 - 1) * s[k] / (m1 * m2 * q) for k in ("q0", "q1"))
    t2 = m1 * (m2 - 1) * (q4**2 - 4 * m0**2) + 4 * m0 * q4 * (m1**2 + m2)
    t4 = (m1**2 + m2) * (q4**2 - 4 * m0**2) - 4 * m0 * m1 * (m2 - 1) * q4
    denominator = m2 * (m0**2 + 1) * q
    return t0, t1, t2 / denominator, t4 / denominator


def essential_to_all(m: Parameters, a0: Any, a2: Any, c0: Any, c2: Any) -> list[tuple[Any, ...]]:
    """(16), (18), (19) and f_0 to f_7 (with bars): all of a, b, c from the essential ones."""
    m0, m1, m2 = m
    q5 = abbreviations(m)["q5"]
    t0, t1, t2, t3, t4, t5 = coefficients(m)
    a = (a0, m1 * a0, a2, (m0**2 + 2 * m0 * m1 - 1) / q5 * a2)
    b = (t0 * a0 * c0, t1 * a0 * c0, t2 * a0 * c2 + t3 * a2 * c0, t4 * a0 * c2 + t5 * a2 * c0)
    c = (c0, m2 / m1 * c0, c2, m1 / m2 * c2)
    return [a, b, c]


def isolated_points(m: Parameters, j: int, essential: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    """Generators of I_{5,0} and I_{5,1}, 8 points each, before (19).

    Args:
        j: 0 for a_0 = 0, 1 for c_0 = 0.
        essential: a_0, a_2, c_0, c_2.
        b: b_2 and b_3; b_0 = b_1 = 0.
    """
    m0, m1, m2 = m
    a0, a2, c0, c2 = essential
    q5 = abbreviations(m)["q5"]
    n0, n1, n2 = m0**2 + 1, m1**2 + 1, m1**2 + m2**2
    _, _, t2, t3, t4, t5 = coefficients(m)
    unit = b[0] ** 2 + b[1] ** 2 - 1
    if j == 0:
        squares = [a2**2 - q5**2 / (n0**2 * n1), c0**2 - m1**2 / n2]
        return [a0, c2, *squares, t5 * b[0] - t3 * b[1], unit]
    squares = [a0**2 - 1 / n1, c2**2 - m2**2 / n2]
    return [c0, a2, *squares, t4 * b[0] - t2 * b[1], unit]


def under_the_root(m: Parameters, cos: Any, sin: Any) -> Any:
    """q_6 of the parametrisation."""
    _, m1, m2 = m
    return (m1**2 + m2**2) * (m2**2 * sin**2 + cos**2)


def parametrisation(m: Parameters, cos: Any, sin: Any, root1: Any, root6: Any) -> tuple[Any, ...]:
    """After (20): a0, a2, c0, c2; ``root1`` is sqrt(m1^2 + 1), ``root6`` is sqrt(q_6)."""
    m0, m1, m2 = m
    q5 = abbreviations(m)["q5"]
    return (
        cos / root1,
        -q5 * sin / ((m0**2 + 1) * root1),
        m1 * m2 * sin / root6,
        m2 * cos / root6,
    )


E1 = (1, 0, 0)


def frames(m: Any) -> list[tuple[Any, Any, Any]]:
    """(eta, xi, chi) of joints 0 to 3 in global coordinates, lemmas 5.3 and 5.4."""
    chi = bennett_geometry.axes(m)
    first = tuple(tuple(x + 0 * m[0] for x in e) for e in ((1, 0, 0), (0, 1, 0)))
    return [(*first, chi[0]), *((*bennett_geometry.across(c), c) for c in chi[1:])]


def constraints(m: Any, a: Any, b: Any, c: Any, printed: bool = False) -> list[Any]:
    """f_0 to f_13; ``printed``: f_11 as printed, with eta in place of xi."""
    init = orientations(m)
    r = bennett_geometry.abbreviations(m)["r"]
    joints = frames(m)
    columns = [E1, *(rotate(q, E1) for q in (a, b, c))]
    loop = [columns[0][i] + r * columns[1][i] + columns[2][i] + r * columns[3][i] for i in range(3)]

    def across(k: int, left: Any, left_init: Any, right: Any, right_init: Any) -> list[Any]:
        eta, xi, chi = joints[k]
        turned = rotate(right, rotate_back(right_init, chi)) if right is not None else chi
        vectors = (eta, eta) if printed and k == 3 else (eta, xi)
        found = []
        for v in vectors:
            here = v if left is None else rotate(left, rotate_back(left_init, v))
            found.append(inner(here, turned))
        return found

    return [
        *(q[0] ** 2 + q[1] ** 2 + q[2] ** 2 + q[3] ** 2 - 1 for q in (a, b, c)),
        *loop,
        *across(1, None, None, a, init[0]),
        *across(2, a, init[0], b, init[1]),
        *across(3, b, init[1], c, init[2]),
        *across(0, c, init[2], None, None),
    ]


def first_parameter_q5_zero(m0: Any) -> Any:
    """The m_1 for which q5 = m_1 (m_0^2 - 1) - 2 m_0 vanishes."""
    return 2 * m0 / (m0**2 - 1)


def variety_q5_zero(
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


def essential_to_all_q5_zero(
    m: Sequence[Any], a0: Any, a3: Any, c0: Any, c2: Any, printed: bool = False
) -> list[tuple[Any, ...]]:
    """All of a, b, c; ``printed``: with the coefficients of a_3 c_0 in b_2 and b_3 exchanged."""
    m0, m2 = m
    m1 = first_parameter_q5_zero(m0)
    t0, t1, t2, t4 = coefficients_without_q5((m0, m1, m2))
    u2, u3 = -a3 * c0, m2 * (m0**2 - 1) / (2 * m0) * a3 * c0
    if printed:
        u2, u3 = u3, u2
    a = (a0, m1 * a0, 0 * a0, a3)
    b = (t0 * a0 * c0, t1 * a0 * c0, t2 * a0 * c2 + u2, t4 * a0 * c2 + u3)
    c = (c0, m2 * (m0**2 - 1) / (2 * m0) * c0, c2, 2 * m0 / (m2 * (m0**2 - 1)) * c2)
    return [a, b, c]


def parametrisation_q5_zero(m: Sequence[Any], cos: Any, sin: Any, root6: Any) -> tuple[Any, ...]:
    """The one that begins with a_0 = (m_0^2 - 1) cos t/(m_0^2 + 1): a0, a3, c0, c2."""
    m0, m2 = m
    m1 = first_parameter_q5_zero(m0)
    return (m0**2 - 1) / (m0**2 + 1) * cos, sin, -m1 * m2 * sin / root6, m2 * cos / root6
