"""PT13 sections 3, 5.1 and 5.4: orientations and the joints' constraints."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from nag.algebra.groebner import Ideal, ideal
from nag.check.identities import Residuals, identity, matrix
from nag.check.rings import contains, euler_ring, intersect_in, unit
from nag.check.statement import Verdict, decided, fails, statement
from nag.mechanism.axes import difference, dot
from nag.mechanism.quaternion import R, conjugate, multiply, norm_squared, rotate
from nag.symbolic import bricard, joints, revolute

E1, E2, E3 = (1, 0, 0), (0, 1, 0), (0, 0, 1)
RING, (A, B) = euler_ring("ab")
ONE = tuple(map(Fraction, (1, 0, 0, 0)))


def across(i: Any, j: Any, a: Any = A, b: Any = B) -> Any:
    """The SO-constraint <R(a) e^i, R(b) e^j>."""
    return dot(rotate(a, i), rotate(b, j))


def component(generators: Any) -> Ideal:
    """The generators with the norms of both bodies."""
    return ideal(RING, [*generators(A, B), *unit(A, B)])


@statement("PT13 section 3", "the matrix of Euler parameters with |a| = 1 is R(a)")
def orientation() -> Verdict:
    def formula(a1: Any, a2: Any, a3: Any, a0: Any) -> Residuals:
        a = (a0, a1, a2, a3)
        printed = [[2 * x for x in row] for row in joints.orientation(a)]
        return matrix("R", printed, R(a))

    root = ("a0", lambda a1, a2, a3: 1 - a1**2 - a2**2 - a3**2)
    at = (Fraction(2, 5), Fraction(2, 5), Fraction(4, 5), Fraction(1, 5))
    return identity("a1 a2 a3", formula, at, (root,))


@statement("PT13 table 1", "numbers of conditions of the five joints")
def conditions() -> Verdict:
    counts = {k: 3 * c + so + o - n for k, (c, so, o, n) in joints.TABLE_1.items()}
    return decided(
        not any(counts.values()), "a C-constraint counts 3, the others 1", f"differences {counts}"
    )


@statement("PT13 (7), 5.4", "dim V(I_rev) = 4, and I_rev is not prime")
def revolute_joint() -> Verdict:
    joint = ideal(RING, [across(E1, E3), across(E2, E3), *unit(A, B)])
    parts = [ideal(RING, [*revolute.component(A, B, j), *unit(A, B)]) for j in (1, 2)]
    return decided(
        joint.dimension == 4 and intersect_in(joint, parts),
        "Groebner bases by FLINT; it is the intersection of the two components of T25 (8)",
        f"dimension {joint.dimension}",
    )


@statement("PT13 (12)", "g_1 to g_5 and the norms are a component of <p_1, p_2, p_a, p_b>", True)
def revolute_12() -> Verdict:
    found = component(joints.revolute_12)
    if contains(found, [across(E1, E3), across(E2, E3)]):
        return decided(True, "division by the basis", "")
    half = Fraction(1, 2)
    b = (half, -half, half, half)
    values = [*joints.revolute_12(ONE, b), norm_squared(b) - 1]
    true = contains(
        found, [across(E1, E3), across(E3, E3), *difference(rotate(B, E3), rotate(A, E2))]
    )
    if any(values) or not true:
        return decided(False, "", "p_2 does not lie in the component")
    return fails(
        "true is p_2 = <R(a) e^3, R(b) e^3>: (12) is the part R(b) e^3 = R(a) e^2, by division",
        f"a = (1, 0, 0, 0), b = (1/2, -1/2, 1/2, 1/2) is a zero of (12), and p_2 is "
        f"{across(E2, E3, ONE, b)} there",
    )


@statement("PT13 (12)", "the ideal is prime, of dimension 4")
def revolute_12_is_prime() -> Verdict:
    """It is I_rev^1 after the change of frame of T25 (9)."""
    found = component(joints.revolute_12)
    turned = bricard.joint_2_turned(A)
    other = ideal(RING, [*revolute.component(turned, B, 1), *unit(A, B)])
    return decided(
        found == other and found.dimension == 4,
        "it is I_rev^1 of T25 (8) in another frame, by division both ways",
        f"dimension {found.dimension}",
    )


@statement("PT13 (13)", "h_1 to h_5 and the norms are a component of I_cyl")
def cylindrical_13() -> Verdict:
    found = component(joints.cylindrical_13)
    axes = difference(rotate(B, E1), rotate(A, E1))
    return decided(
        contains(found, [across(E2, E1), across(E3, E1), *axes]),
        "division by the basis; on it R(b) e^1 = R(a) e^1",
        "p_3 or p_4 does not lie in it",
    )


@statement("PT13 (13)", "the ideal is prime, of dimension 4")
def cylindrical_13_is_prime() -> Verdict:
    """In r = conj(a) b it is r_2 = r_3 = 0: a sphere times a circle."""
    found = component(joints.cylindrical_13)
    r = multiply(conjugate(A), B)
    return decided(
        found == ideal(RING, [r[2], r[3], *unit(A, B)]) and found.dimension == 4,
        "with r = conj(a) b it is the circle r_2 = r_3 = 0 times the sphere |a| = 1",
        f"dimension {found.dimension}",
    )


@statement("PT13 5.4", "the generators of (12) and (13) are of degree 2")
def degrees() -> Verdict:
    generators = [*joints.revolute_12(A, B), *joints.cylindrical_13(A, B)]
    found = {f.numerator.total_degree() for f in generators}
    return decided(found == {2}, "counted", f"degrees {found}")


@statement("PT13 5.4", "a = b is one possibility of the translational joint")
def translation_without_turning() -> Verdict:
    values = [across(i, j, A, A) for i, j in ((E2, E1), (E3, E1), (E2, E3))]
    return decided(not any(values), "identity in a", f"values {values}")


@statement(
    "PT13 5.4, translational joint",
    "(13) and p_5 generate <p_a, b_0 - a_1, b_1 + a_0, b_2 + a_3, b_3 - a_2>",
    True,
)
def translational_joint() -> Verdict:
    found = ideal(RING, [*joints.cylindrical_13(A, B), across(E2, E3), *unit(A, B)])
    printed = ideal(RING, [*joints.translational(A, B), *unit(A)])
    if found == printed:
        return decided(True, "division both ways", "")
    half_turn = multiply(A, (0, 1, 0, 0))
    choices = [[s * x for x in b] for b in (A, half_turn) for s in (1, -1)]
    parts = [ideal(RING, [*difference(B, b), *unit(A)]) for b in choices]
    if printed not in parts or not intersect_in(found, parts):
        return decided(False, "", "the ideals differ")
    values = [*joints.cylindrical_13(ONE, ONE), across(E2, E3, ONE, ONE)]
    if any(values):
        return decided(False, "", f"values {values} at a = b")
    return fails(
        "true is: they generate the intersection of four such ideals, b = +-a and b = +-a i; the "
        "printed one is b = -a i, a component, by Groebner bases",
        "a = b = (1, 0, 0, 0) is a zero of (13) and p_5, and b_1 + a_0 is 1 there",
    )


@statement("PT13 5.4", "V(I_uni) is irreducible, and a and b may be exchanged")
def universal_joint() -> Verdict:
    """In r = conj(a) b it is r_0^2 + r_3^2 = r_1^2 + r_2^2 = 1/2: two circles and a sphere."""
    p = joints.universal(A, B)
    r = multiply(conjugate(A), B)
    half = Fraction(1, 2)
    found = ideal(RING, [p, *unit(A, B)])
    circles = [r[0] ** 2 + r[3] ** 2 - half, r[1] ** 2 + r[2] ** 2 - half]
    true = found == ideal(RING, [*circles, *unit(A)]) and found.dimension == 5
    same = contains(found, [across(E3, E3), joints.universal(B, A)])
    return decided(
        true and same,
        "with r = conj(a) b it is two smooth conics in different variables times the sphere "
        "|a| = 1, by Groebner bases; dimension 5",
        "it is another variety",
    )


STATEMENTS = (
    orientation,
    conditions,
    revolute_joint,
    revolute_12,
    revolute_12_is_prime,
    cylindrical_13,
    cylindrical_13_is_prime,
    degrees,
    translation_without_turning,
    translational_joint,
    universal_joint,
)
