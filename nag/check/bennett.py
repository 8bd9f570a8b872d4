"""T25 section 6: orientations of B_H mechanisms, their equations and joints."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from nag.algebra.groebner import divisor, ideal, remainder
from nag.algebra.rational_function import FunctionField
from nag.check.identities import Residuals, identity, labelled
from nag.check.joints import E1
from nag.check.loops import axis_equations
from nag.check.rings import euler_ring, intersect_in, unit
from nag.check.statement import Verdict, VerdictKind, decided, fails, statement
from nag.mechanism.axes import difference
from nag.mechanism.quaternion import norm_squared, rotate
from nag.symbolic import bennett, bennett_geometry
from nag.symbolic.bennett import constraints, frames

M = "m0 m1 m2"
OWN = (Fraction(7, 4), Fraction(5, 6), Fraction(1, 3))
# The papers' own parameters and others, inside and outside Omega.
PARAMETERS = (
    OWN,
    (Fraction(2), Fraction(3, 4), Fraction(5, 16)),
    (Fraction(-3, 2), Fraction(-2, 5), Fraction(7, 3)),
)


def at_parameters() -> str:
    """The parameters as text."""
    return ", ".join("(" + ", ".join(map(str, m)) + ")" for m in PARAMETERS)


def _along(i: int) -> Any:
    """Lemma 6.1 for body i."""

    def residuals(*m: Any) -> Residuals:
        a = bennett.orientations(m)[i - 1]
        length = (bennett_geometry.abbreviations(m)["r"], 1, bennett_geometry.abbreviations(m)["r"])
        turned = [length[i - 1] * x for x in rotate(a, E1)]
        found = labelled(f"v^{i}", difference(turned, bennett_geometry.links(m)[i]))
        return {**found, "norm - 1": norm_squared(a) - 1}

    return residuals


@statement("T25 lemma 6.1, a", "a_init is unit, and v^1 = r R(a_init) e^1")
def orientation_1() -> Verdict:
    return identity(M, _along(1), OWN)


@statement("T25 lemma 6.1, b", "b_init is unit, and v^2 = R(b_init) e^1")
def orientation_2() -> Verdict:
    return identity(M, _along(2), OWN)


@statement("T25 lemma 6.1, c", "c_init is unit, and v^3 = r R(c_init) e^1")
def orientation_3() -> Verdict:
    return identity(M, _along(3), OWN)


def _directions(generators: Any, link: int, m: Any, a: Any) -> tuple[list[Any], list[Any]]:
    r = bennett_geometry.abbreviations(m)["r"]
    v = bennett_geometry.links(m)[link]
    turned = [y - r * x for x, y in zip(rotate(a, E1), v, strict=True)]
    return [*turned, norm_squared(a) - 1], generators(m, a)


def _all_directions(generators: Any, link: int) -> Verdict:
    """Whether the generators are those of v = r R(a) e^1, |a| = 1."""
    field = FunctionField(f"a3 a2 a1 a0 {M}")
    *v, m0, m1, m2 = field.variables
    wanted, printed = _directions(generators, link, (m0, m1, m2), tuple(v[::-1]))
    basis = [divisor(g.numerator, 4) for g in printed]
    if any(remainder(f.numerator, basis, 4) != 0 for f in wanted):
        return decided(False, "", "the equations leave a remainder")
    ring, (a,) = euler_ring("a")
    for m in PARAMETERS:
        wanted, printed = _directions(generators, link, m, a)
        if ideal(ring, wanted) != ideal(ring, printed):
            return decided(False, "", f"not at m = {m}")
    return decided(
        True,
        "the equations reduce to 0 with m as parameters; equal ideals by Groebner bases at m = "
        + at_parameters(),
        "",
    )


@statement("T25 lemma 6.1, proof", "G is a basis of v^1 = r R(a) e^1, |a| = 1")
def directions_of_link_1() -> Verdict:
    return _all_directions(bennett.along_link_1, 1)


@statement("T25 lemma 6.1, proof", "c_0^2 + c_1^2, c_2 and c_3 from v^3 = r R(c) e^1")
def directions_of_link_3() -> Verdict:
    return _all_directions(bennett.along_link_3, 3)


@statement(
    "T25 (13)", "kappa_0 kappa_1 as printed is the sum of squares of b_0, b_1 times kappa_0^2"
)
def product_13() -> Verdict:
    """b_0^2 + b_1^2 = (1 + v^2_1)/2 for every solution; lemma 6.1 gives the two squares."""

    def formula(*m: Any) -> Residuals:
        kappa, printed = bennett.product_13(m)
        b = bennett.orientations(m)[1]
        v = bennett_geometry.links(m)[2]
        return {
            "all solutions": kappa**2 * (1 + v[0]) / 2 - printed,
            "two squares": kappa**2 * (b[0] ** 2 + b[1] ** 2) - printed,
        }

    return identity(M, formula, OWN)


@statement("T25 lemma 6.1, proof", "the identity of sums of two squares")
def two_squares() -> Verdict:
    def formula(k0: Any, k1: Any, k2: Any, k3: Any) -> Residuals:
        left = (k0**2 + k1**2) * (k2**2 + k3**2)
        return {"difference": left - (k0 * k2 + k1 * k3) ** 2 - (k0 * k3 - k1 * k2) ** 2}

    return identity("k0 k1 k2 k3", formula, tuple(map(Fraction, (1, 2, 3, 5))))


@statement("T25 section 6", "the initial configuration is a zero of f_0 to f_13")
def initial_configuration() -> Verdict:
    def formula(*m: Any) -> Residuals:
        found = constraints(m, *bennett.orientations(m), printed=True)
        return {f"f_{i}": f for i, f in enumerate(found)}

    return identity(M, formula, OWN)


@statement("T25 section 6, f_11", "f_10 and f_11 are the two constraints of joint J_3", True)
def constraint_11() -> Verdict:
    """c turned about R(b) eta^{3,2} keeps f_10 = 0 and takes the axes apart."""
    a, b, c = bennett.orientations(OWN)
    eta = frames(OWN)[3][0]
    turn = (Fraction(3, 5), *(Fraction(4, 5) * x for x in eta))
    moved = _product(turn, c)
    printed = constraints(OWN, a, b, moved, printed=True)
    true = constraints(OWN, a, b, moved)
    if printed[10:12] != [0, 0]:
        return Verdict(VerdictKind.OPEN, "the point does not satisfy what is printed")
    if true[11] == 0:
        return decided(True, "the axes are parallel", "")
    return fails(
        "f_11 as printed is f_10; true is xi^{3,2} in place of eta^{3,2}",
        f"at m = (7/4, 5/6, 1/3), b = b_init and c = (3/5 + 4/5 eta^3) c_init both printed ones "
        f"are 0, and <R(b) xi, R(c) chi> is {true[11]}",
    )


def _product(a: Any, b: Any) -> tuple[Any, ...]:
    from nag.mechanism.quaternion import multiply

    return multiply(a, b)


@statement("T25 section 6", "14 equations in 12 variables")
def count_of_equations() -> Verdict:
    _, (a, b, c) = euler_ring("abc")
    found = constraints(OWN, a, b, c)
    return decided(len(found) == 14 and all(found), "counted", f"{len(found)} equations")


@statement("T25 section 6", "f_3 to f_13 generate with the norms the mechanism's equations")
def constraints_of_the_mechanism() -> Verdict:
    """Each joint's pair of constraints is the union of its two directions of the axis."""
    ring, (a, b, c) = euler_ring("abc")
    init = bennett.orientations(OWN)
    f = constraints(OWN, a, b, c)
    joints = (
        (1, f[6:8], (None, a), (None, init[0])),
        (2, f[8:10], (a, b), (init[0], init[1])),
        (3, f[10:12], (b, c), (init[1], init[2])),
        (0, f[12:14], (c, None), (init[2], None)),
    )
    for k, pair, bodies, given in joints:
        moving = unit(*(q for q in bodies if q is not None))
        chi = bennett_geometry.axes(OWN)[k]
        parts = [ideal(ring, [*axis_equations(chi, bodies, given, s), *moving]) for s in (1, -1)]
        if not intersect_in(ideal(ring, [*pair, *moving]), parts):
            return decided(False, "", f"joint {k} has other components")
    return decided(
        True,
        "for each joint the constraints are the intersection of the two directions of its axis, "
        "by Groebner bases at m = (7/4, 5/6, 1/3)",
        "",
    )


def _component(letter: str, joint: int) -> Verdict:
    """(14) and (15): J is the part of the joint's constraints with the initial direction."""
    printed = bennett.component_a if letter == "a" else bennett.component_c
    body = 0 if letter == "a" else 2
    field = FunctionField(f"x3 x1 x2 x0 {M}")
    x3, x1, x2, x0, *m = field.variables
    x = (x0, x1, x2, x3)
    init = bennett.orientations(m)[body]
    pair = (None, x) if letter == "a" else (x, None)
    given = (None, init) if letter == "a" else (init, None)
    chi = bennett_geometry.axes(m)[joint]
    basis = [divisor(g.numerator, 4) for g in printed(m, x)]
    ours = [*axis_equations(chi, pair, given), norm_squared(x) - 1]
    if any(remainder(f.numerator, basis, 4) != 0 for f in ours):
        return decided(False, "", "the joint's equations leave a remainder")
    if any(printed(m, init)):
        return decided(False, "", "the initial orientation is no zero")
    ring, (y,) = euler_ring("x")
    for at in PARAMETERS:
        init = bennett.orientations(at)[body]
        pair = (None, y) if letter == "a" else (y, None)
        given = (None, init) if letter == "a" else (init, None)
        chi = bennett_geometry.axes(at)[joint]
        here, there = (
            ideal(ring, [*axis_equations(chi, pair, given, s), *unit(y)]) for s in (1, -1)
        )
        a, b, c = (y if k == body else bennett.orientations(at)[k] for k in range(3))
        f = constraints(at, a, b, c)
        whole = ideal(ring, [*(f[6:8] if letter == "a" else f[12:14]), *unit(y)])
        if here != ideal(ring, printed(at, y)) or not intersect_in(whole, (here, there)):
            return decided(False, "", f"not at m = {at}")
    return decided(
        True,
        "the joint's equations reduce to 0 with m as parameters, and the initial orientation is "
        f"a zero; equal ideals by Groebner bases at m = {at_parameters()}; a smooth conic",
        "",
    )


@statement("T25 (14)", "I_a = J_a n hat J_a with J_a as printed, a_init in V(J_a)")
def component_a() -> Verdict:
    return _component("a", 1)


@statement("T25 (15)", "I_c = J_c n hat J_c with J_c as printed, c_init in V(J_c)")
def component_c() -> Verdict:
    return _component("c", 0)


@statement("T25 (16)", "a_1, a_3, c_1, c_3 from the essential variables, where J_a and J_c vanish")
def eliminated() -> Verdict:
    def formula(a0: Any, a2: Any, c0: Any, c2: Any, *m: Any) -> Residuals:
        a, _, c = bennett.essential_to_all(m, a0, a2, c0, c2)
        linear = [*bennett.component_a(m, a)[:2], *bennett.component_c(m, c)[:2]]
        return labelled("linear", linear)

    return identity(f"a0 a2 c0 c2 {M}", formula, tuple(map(Fraction, (1, 2, 3, 5, 2, 3, 5))))


STATEMENTS = (
    orientation_1,
    orientation_2,
    orientation_3,
    directions_of_link_1,
    directions_of_link_3,
    product_13,
    two_squares,
    initial_configuration,
    constraint_11,
    count_of_equations,
    constraints_of_the_mechanism,
    component_a,
    component_c,
    eliminated,
)
