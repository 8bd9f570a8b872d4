"""T25 section 5: the geometry of Bennett's mechanisms B_H, at generic parameters."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from nag.check.identities import Residuals, identity, labelled, misprinted, surviving
from nag.check.rings import determinant
from nag.check.statement import Verdict, decided, statement
from nag.mechanism.axes import cross, difference, dot
from nag.symbolic import bennett_geometry as b

M = "m0 m1 m2"
OWN = (Fraction(7, 4), Fraction(5, 6), Fraction(1, 3))


def _short(m: Any) -> dict[str, Any]:
    return b.abbreviations(m)


@statement("T25 lemma 5.1", "|v^0| = |v^2| = 1 and |v^1| = |v^3| = |r|")
def opposite_links() -> Verdict:
    def formula(*m: Any) -> Residuals:
        squares = [dot(v, v) for v in b.links(m)]
        r2 = _short(m)["r"] ** 2
        return {f"|v^{i}|^2": squares[i] - (1, r2, 1, r2)[i] for i in range(4)}

    return identity(M, formula, OWN)


@statement("T25 section 5", "the points are in one plane, or equal, only outside Omega_0")
def not_planar() -> Verdict:
    """The volume is a product of parameters and of 1 - m2^2; r = 0 for m2 = +-1."""

    def formula(*m: Any) -> Residuals:
        m0, m1, m2 = m
        p, s = b.points(m), _short(m)
        volume = determinant([p[1], p[2], p[3]])
        n0, n1, n2 = m0**2 + 1, m1**2 + 1, m1**2 + m2**2
        product = -8 * s["r"] ** 2 * m0 * m1**2 * m2 / (n0 * n1 * n2)
        return {"volume": volume - product, "r q": s["r"] * s["q"] - n0 * (1 - m2**2)}

    found = identity(M, formula, OWN)
    p = b.points((Fraction(3), Fraction(2), Fraction(0)))
    if p[1] != p[3]:
        return decided(False, "", "p^1 and p^3 differ for m2 = 0")
    how = f"{found.how}: the volume is a product of r^2, m0, m1^2, m2; for m2 = 0 p^1 is p^3"
    return Verdict(found.kind, how, found.counterexample)


@statement("T25 (11), p^2", "p^2 over a common denominator is that of lemma 5.1")
def second_point() -> Verdict:
    def formula(*m: Any) -> Residuals:
        return labelled("p^2", difference(b.points_11(m)[0], b.points(m)[2]))

    return identity(M, formula, OWN)


@statement("T25 (11), p^3", "p^3 over a common denominator is that of lemma 5.1", True)
def third_point() -> Verdict:
    def formula(printed: bool) -> Any:
        def residuals(*m: Any) -> Residuals:
            found = difference(b.points_11(m, printed)[1], b.points(m)[3])
            return labelled("p^3 minus that of lemma 5.1", found)

        return residuals

    return misprinted(M, formula(True), formula(False), OWN)


@statement("T25 lemma 5.2", "f = f o g_1 = f o g_2, and g_1, g_2 generate Klein's group")
def same_points() -> Verdict:
    def formula(*m: Any) -> Residuals:
        g1, g2 = b.same_points(m)
        found = {}
        for name, g in (("g_1", g1), ("g_2", g2)):
            for i in (2, 3):
                found |= labelled(f"f o {name}", difference(b.points(g)[i], b.points(m)[i]))
        found |= labelled("g_1 g_1", difference(b.same_points(g1)[0], m))
        found |= labelled("g_2 g_2", difference(b.same_points(g2)[1], m))
        commute = difference(b.same_points(g1)[1], b.same_points(g2)[0])
        return found | labelled("g_1 g_2 - g_2 g_1", commute)

    return identity(M, formula, OWN)


@statement("T25 lemma 5.2", "f is injective on Omega")
def injective() -> Verdict:
    """r = |p^3| > 0 on Omega; the points give m1^2 and then m up to g_2, which leaves Omega."""

    def formula(*m: Any) -> Residuals:
        m0, m1, m2 = m
        p, r = b.points(m), _short(m)["r"]
        x, y, z = p[2][0] - 1, p[2][1], p[2][2]
        return {
            "r^2": dot(p[3], p[3]) - r**2,
            "m1^2": m1**2 - (r + x) / (r - x),
            "m2/m1": m2 / m1 - (r - p[3][0]) / p[3][1],
            "slope": y * 2 * m0 - z * (m0**2 - 1),
            "sign": z * (m0**2 + 1) * (m1**2 + 1) - 4 * r * m0 * m1,
        }

    found = identity(M, formula, OWN)
    how = (
        f"{found.how}: m1^2 and m2/m1 are functions of the points, m0 is up to -1/m0, and the "
        "sign of m1 goes with it; Omega has one of the two"
    )
    return Verdict(found.kind, how, found.counterexample)


@statement("T25 section 5", "r > 0 on Omega, and r takes every positive value there")
def lengths() -> Verdict:
    """m0^2 as a function of r and m2: it is at least 1 for m2 near 1."""

    def formula(r: Any, m2: Any, m0: Any) -> Residuals:
        return {"r": _short((m0, m0, m2))["r"] - r}

    def square(r: Any, m2: Any) -> Any:
        return (1 + m2) * (r * (1 + m2) - (1 - m2)) / ((1 - m2) * (1 + m2 - r * (1 - m2)))

    kept = surviving("r m2", formula, (("m0", square),))
    near = [square(r, Fraction(2**20 - 1, 2**20)) for r in (Fraction(1, 1000), Fraction(1000))]
    return decided(
        not kept and min(near) > 1,
        "q > 0; m0^2 solved for, identically in r and m2: it grows without bound as m2 tends to 1",
        f"{kept} not 0",
    )


def _axis(i: int, printed: bool) -> Any:
    def residuals(*m: Any) -> Residuals:
        v, chi = b.links(m), b.axes(m, printed)[i]
        return {
            f"<chi^{i}, v^{i}>": dot(chi, v[i]),
            f"<chi^{i}, v^{(i - 1) % 4}>": dot(chi, v[i - 1]),
            f"|chi^{i}|^2 - 1": dot(chi, chi) - 1,
        }

    return residuals


@statement("T25 lemma 5.3, chi^0", "unit, and across both links")
def axis_0() -> Verdict:
    return identity(M, _axis(0, True), OWN)


@statement("T25 lemma 5.3, chi^1", "unit, and across both links")
def axis_1() -> Verdict:
    return identity(M, _axis(1, True), OWN)


@statement("T25 lemma 5.3, chi^2", "unit, and across both links", True)
def axis_2() -> Verdict:
    return misprinted(M, _axis(2, True), _axis(2, False), OWN)


@statement("T25 lemma 5.3, chi^3", "unit, and across both links", True)
def axis_3() -> Verdict:
    return misprinted(M, _axis(3, True), _axis(3, False), OWN)


def _cosines(printed: bool) -> Any:
    def residuals(*m: Any) -> Residuals:
        chi, (first, second) = b.axes(m, printed), b.cosines(m)
        found = [dot(chi[i], chi[(i + 1) % 4]) for i in range(4)]
        return {
            f"<chi^{i}, chi^{(i + 1) % 4}> - cos(phi_{i})": found[i] - (first, second)[i % 2]
            for i in range(4)
        }

    return residuals


@statement(
    "T25 theorem 5.1", "the cosines of the angles, with the axes as lemma 5.3 has them", True
)
def cosines() -> Verdict:
    return misprinted(M, _cosines(True), _cosines(False), OWN)


@statement("T25 theorem 5.1", "Bennett's third condition: sin(phi_1) = |r| sin(phi_0)")
def sines() -> Verdict:
    def formula(*m: Any) -> Residuals:
        m0, _, m2 = m
        s = _short(m)
        first, second = b.cosines(m)
        printed = 2 * m0 * (m2**2 - 1) / s["q"]
        return {
            "sin^2": 1 - second**2 - printed**2,
            "third condition": 1 - second**2 - s["r"] ** 2 * (1 - first**2),
        }

    return identity(M, formula, OWN)


@statement("T25 section 5", "the angles do not depend on m1")
def angles_without_m1() -> Verdict:
    def formula(m0: Any, m1: Any, m2: Any, n1: Any) -> Residuals:
        found = zip(b.cosines((m0, m1, m2)), b.cosines((m0, n1, m2)), strict=True)
        return {f"cos(phi_{i})": x - y for i, (x, y) in enumerate(found)}

    return identity(f"{M} n1", formula, (*OWN, Fraction(2)))


AXIS = ("x3", lambda x1, x2: 1 - x1**2 - x2**2)
AXIS_AT = (Fraction(2, 3), Fraction(1, 3), Fraction(2, 3))


def _frame(printed: bool, entries: slice) -> Any:
    def residuals(*chi: Any) -> Residuals:
        eta, xi = b.across(chi, printed)
        n = {
            "<eta, chi>": dot(eta, chi),
            "|eta|^2 - 1": dot(eta, eta) - 1,
            "<eta, xi>": dot(eta, xi),
            "<xi, chi>": dot(xi, chi),
            "|xi|^2 - 1": dot(xi, xi) - 1,
        }
        return dict(list(n.items())[entries])

    return residuals


@statement("T25 lemma 5.4, eta", "eta is unit, and across chi and xi", True)
def first_across() -> Verdict:
    found = identity("x1 x2", _frame(True, slice(0, 3)), AXIS_AT, (AXIS,))
    mended = surviving("x1 x2", _frame(False, slice(0, 3)), (AXIS,))
    how = "mended, it is an identity in x1, x2 with x3 adjoined"
    return found if mended else Verdict(found.kind, how, found.counterexample)


@statement("T25 lemma 5.4, xi", "xi is unit, and across chi; mended, (eta, xi, chi) is a frame")
def second_across() -> Verdict:
    def formula(*chi: Any) -> Residuals:
        eta, xi = b.across(chi)
        turned = difference(cross(eta, xi), chi)
        return _frame(False, slice(0, 5))(*chi) | labelled("eta x xi - chi", turned)

    return identity("x1 x2", formula, AXIS_AT, (AXIS,))


@statement("T25 lemma 5.4", "chi^l and e^3 are independent for l >= 1")
def independent_axes() -> Verdict:
    """A first entry, or the second of chi^1, is a product of what is not 0 on Omega_0."""

    def formula(*m: Any) -> Residuals:
        m0, m1, m2 = m
        chi, q = b.axes(m), _short(m)["q"]
        n0, n1, n2 = m0**2 + 1, m1**2 + 1, m1**2 + m2**2
        return {
            "chi^1": chi[1][1] + 2 * m0 / n0,
            "chi^2": chi[2][0] - 4 * m0 * m1 * (1 - m2**2) / (n1 * q),
            "chi^3": chi[3][0] - 4 * m0 * m1 * m2 * (1 - m2**2) / (n2 * q),
        }

    return identity(M, formula, OWN)


STATEMENTS = (
    opposite_links,
    not_planar,
    second_point,
    third_point,
    same_points,
    injective,
    lengths,
    axis_0,
    axis_1,
    axis_2,
    axis_3,
    cosines,
    sines,
    angles_without_m1,
    first_across,
    second_across,
    independent_axes,
)
