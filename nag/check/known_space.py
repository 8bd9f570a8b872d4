"""Three bars in space, a graph, and the varieties of Bricard and Bennett."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from nag.check.identities import Root
from nag.check.known import (
    KnownDecomposition,
    PaperComponent,
    Parameters,
    Parametrisation,
    Values,
    circle,
)
from nag.symbolic import bennett, bricard, triangle
from nag.symbolic.bennett_geometry import abbreviations


def is_triangle(p: Parameters) -> bool:
    """Whether 1, L1, L2 are sides of a triangle."""
    L1, L2 = p["L1"], p["L2"]
    return L1 > 0 and L2 > 0 and all(x > 0 for x in triangle.constants(L1, L2))


def in_omega(m: Sequence[Any]) -> bool:
    """Whether m lies in T25's Omega_0, and is rational."""
    return all(isinstance(x, Fraction) and x for x in m) and m[2] not in (1, -1)


def has_variety(p: Parameters) -> bool:
    """Whether m lies in Omega_0 and q_5 is not 0."""
    m = (p["m0"], p["m1"], p["m2"])
    return in_omega(m) and abbreviations(m)["q5"] != 0


def three_bars(p: Parameters) -> KnownDecomposition:
    """PT13 5.2."""
    L1, L2 = p["L1"], p["L2"]
    alpha = triangle.constants(L1, L2)

    def point(a1: Any, a3: Any, b1: Any, b0: Any, a2: Any, a0: Any) -> list[Any]:
        a = (a0, a1, a2, a3)
        y, z = a1 * a2 + a0 * a3, a1 * a3 - a0 * a2
        b2 = -4 * L1 * (b1 * y - b0 * z) / alpha[1]
        b3 = -4 * L1 * (b0 * y + b1 * z) / alpha[1]
        return [*a, b0, b1, b2, b3]

    roots = (
        ("b0", lambda a1, a3, b1: alpha[1] / (4 * L2) - b1**2),
        ("a2", lambda a1, a3, b1: alpha[2] / (4 * L1) - a3**2),
        ("a0", lambda a1, a3, b1: alpha[0] / (4 * L1) - a1**2),
    )
    component = PaperComponent(
        "PT13 5.2",
        lambda v: triangle.basis(L1, L2, v[:4], v[4:]),
        Parametrisation("a1 a3 b1", point, roots),
    )
    return KnownDecomposition(
        "three bars",
        tuple(f"{x}{i}" for x in "ab" for i in range(4)),
        lambda v: triangle.equations(L1, L2, v[:4], v[4:]),
        (component,),
    )


def graph(p: Parameters) -> KnownDecomposition:
    """PT13 (2)."""

    def equations(v: Values) -> list[Any]:
        x, y, z = v
        return [x**2 + y**2 - 1, z - 4 * x**4 - 3 * y**3 - x * y - 4]

    def point(t: Any) -> list[Any]:
        x, y = circle(t)
        return [x, y, 4 * x**4 + 3 * y**3 + x * y + 4]

    component = PaperComponent("PT13 (2)", equations, Parametrisation("t", point))
    return KnownDecomposition("graph over the circle", ("x", "y", "z"), equations, (component,))


BRICARD_ROOTS = (
    ("root", lambda cos: 4 * cos**2 - 1),
    ("sin", lambda cos: 1 - cos**2),
    ("root2", lambda cos: 2),
)


def bricards_variety(p: Parameters) -> KnownDecomposition:
    """T25 section 4, I_bric."""

    def equations(v: Values) -> list[Any]:
        return bricard.variety(*v)

    def point(cos: Any, root: Any, sin: Any, root2: Any) -> Values:
        return bricard.parametrisation(cos, sin, root2, root)

    component = PaperComponent(
        "T25 section 4", equations, Parametrisation("cos", point, BRICARD_ROOTS)
    )
    return KnownDecomposition("Bricard's variety", ("a0", "a2", "c2"), equations, (component,))


def bennett_roots(m: Sequence[Any]) -> tuple[Root, ...]:
    """What the parametrisation after (20) adjoins."""
    _, m1, m2 = m
    return (
        ("root6", lambda cos: (m1**2 + m2**2) * (m2**2 * (1 - cos**2) + cos**2)),
        ("root1", lambda cos: m1**2 + 1),
        ("sin", lambda cos: 1 - cos**2),
    )


def bennetts_variety(p: Parameters) -> KnownDecomposition:
    """T25 section 6, I_benn."""
    m = (p["m0"], p["m1"], p["m2"])

    def equations(v: Values) -> list[Any]:
        return bennett.variety(m, *v)

    def point(cos: Any, root6: Any, root1: Any, sin: Any) -> Values:
        return bennett.parametrisation(m, cos, sin, root1, root6)

    component = PaperComponent(
        "T25 (17)", equations, Parametrisation("cos", point, bennett_roots(m))
    )
    return KnownDecomposition(
        "Bennett's variety", ("a0", "a2", "c0", "c2"), equations, (component,)
    )
