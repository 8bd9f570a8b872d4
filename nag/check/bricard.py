"""T25 section 4: Bricard's mechanism, its joints and the basis of I_1."""

from __future__ import annotations

from typing import Any

import flint

from nag.algebra.groebner import ideal
from nag.algebra.rational_function import FunctionField
from nag.check.joints import E1, E2, E3
from nag.check.loops import axis_equations, local
from nag.check.rings import apply, contains, euler_ring, intersect_in, product, transpose, unit
from nag.check.statement import Verdict, decided, statement
from nag.mechanism.axes import difference, dot
from nag.mechanism.quaternion import K, K_tilde, add, norm_squared, rotate
from nag.symbolic import bricard, revolute

RING, (A, B) = euler_ring("ab")
A_INIT, B_INIT = bricard.ORIENTATIONS[:2]


def links() -> list[tuple[int, ...]]:
    """v^0 to v^5."""
    p = bricard.POINTS
    return [difference(p[(i + 1) % 6], p[i]) for i in range(6)]


@statement("T25 section 5", "Bricard's mechanism satisfies condition (H): axes across both links")
def condition_h() -> Verdict:
    v, chi = links(), bricard.AXES
    products = [dot(chi[i], v[k]) for i in range(6) for k in (i, i - 1)]
    return decided(not any(products), "twelve products are 0", f"products {products}")


@statement("T25 section 4", "a_init to e_init are unit and take e^1 to the links")
def initial_values() -> Verdict:
    v = links()
    true = all(
        norm_squared(q) == 1 and rotate(q, E1) == v[i]
        for i, q in enumerate(bricard.ORIENTATIONS, 1)
    )
    return decided(true, "exact numbers", "a body points elsewhere")


@statement("T25 section 4", "eta^{2,1} = (0, 0, -1)")
def local_vector() -> Verdict:
    found = local(A_INIT, E2)
    return decided(found == (0, 0, -1), "exact numbers", f"it is {found}")


@statement("T25 section 4", "the two constraints of joint J_1, as polynomials in a")
def constraints_of_joint_1() -> Verdict:
    chi = local(A_INIT, bricard.AXES[1])
    turned = rotate(A, chi)
    _, first, second = bricard.joint_1(A)
    true = dot(E1, turned) == -2 * first and dot(E3, turned) == second
    return decided(true, "identity in a", "the polynomials differ")


@statement(
    "T25 section 4", "I_a is the intersection of I_{a,0} and I_{a,1}; a_init lies on the second"
)
def joint_1() -> Verdict:
    field, (a,) = euler_ring("a")
    whole = ideal(field, bricard.joint_1(a))
    parts = [ideal(field, bricard.joint_1_component(a, j)) for j in (0, 1)]
    on = [not any(bricard.joint_1_component(A_INIT, j)) for j in (0, 1)]
    prime = all((p.dimension, p.degree) == (1, 2) for p in parts)
    return decided(
        intersect_in(whole, parts) and on == [False, True] and prime,
        "Groebner bases by FLINT; each component is a smooth conic and linear equations",
        f"a_init lies on them: {on}",
    )


@statement(
    "T25 section 4", "the constraints of joint J_2 are -<R(a)e^3, R(b)e^3> and -<R(a)e^1, R(b)e^3>"
)
def constraints_of_joint_2() -> Verdict:
    chi = local(B_INIT, bricard.AXES[2])
    eta, xi = local(A_INIT, E2), local(A_INIT, E3)
    turned = rotate(B, chi)
    first = dot(rotate(A, eta), turned) + dot(rotate(A, E3), rotate(B, E3))
    second = dot(rotate(A, xi), turned) + dot(rotate(A, E1), rotate(B, E3))
    return decided(not first and not second, "identity in a, b", "they differ")


@statement("T25 section 4", "w = (1, 0, 1, 0) gives alpha = (1, -1, 1, 1) and u by (9)")
def turn_of_joint_2() -> Verdict:
    eta, xi = local(A_INIT, E2), local(A_INIT, E3)
    w = bricard.EIGENVECTOR
    second = product(transpose(K_tilde((0, *E2))), K((0, *xi)))
    alpha = add(w, apply(second, w))
    n = norm_squared(alpha)
    turned = rotate(alpha, E1), rotate(alpha, E2)
    right = turned == (tuple(n * x for x in eta), tuple(n * x for x in xi))
    eigen = w in revolute.eigenvectors(eta)
    # |alpha| = 2.
    u = [x / 2 for x in apply(transpose(K(A)), alpha)]
    same = u == list(bricard.joint_2_turned(A)) and n == 4
    return decided(
        alpha == bricard.TURN and right and eigen and same,
        "exact numbers, and an identity in a",
        f"alpha = {alpha}",
    )


@statement("T25 section 4", "k_1^1 to k_5^1 of joint J_2 are those of (8) at u and z = b")
def component_of_joint_2() -> Verdict:
    from_8 = revolute.component(bricard.joint_2_turned(A), B, 1)
    printed = bricard.joint_2_component(A, B)
    factors = [2, 2, 1, 2, 2]
    norm = unit(A, B)
    field = RING
    apart = [factors[i] * from_8[i] - printed[i] for i in range(5)]
    return decided(
        contains(ideal(field, norm), apart) and not any(apart[:2]),
        "identities in a, b, up to the factor 2 and the norms",
        f"difference {[str(x) for x in apart]}",
    )


@statement("T25 section 4", "a_init and b_init are zeros of these: it is the right component")
def component_of_the_initial_values() -> Verdict:
    values = bricard.joint_2_component(A_INIT, B_INIT)
    other = revolute.component(bricard.joint_2_turned(A_INIT), B_INIT, 2)
    return decided(not any(values) and any(other), "exact numbers", f"values {values}")


@statement("T25 section 4", "the component of joint J_2 is that of the mechanism's equations")
def component_of_the_mechanism() -> Verdict:
    frames = bricard.ORIENTATIONS[:2]
    ours = axis_equations(bricard.AXES[2], (A, B), frames)
    printed = ideal(RING, [*bricard.joint_2_component(A, B), *unit(A, B)])
    return decided(
        printed == ideal(RING, [*ours, *unit(A, B)]),
        "Groebner bases by FLINT: R(a) chi = R(b) chi in local frames generates the same ideal",
        "other ideals",
    )


@statement("T25 section 4", "I_1 = <g_0, .., g_9>, a lexicographic Groebner basis")
def two_joints() -> Verdict:
    """For a3 > a1 > b3 > b1 > b2 > b0 > a2 > a0, as printed."""
    field = FunctionField("a3 a1 b3 b1 b2 b0 a2 a0")
    a3, a1, b3, b1, b2, b0, a2, a0 = field.variables
    a, b = (a0, a1, a2, a3), (b0, b1, b2, b3)
    generators = [
        *bricard.joint_1_component(a, 1),
        *bricard.joint_2_component(a, b),
        *unit(a, b),
    ]
    printed = [g.numerator for g in bricard.two_joints_basis(a, b)]
    found = ideal(field, generators)
    groebner = flint.fmpz_mpoly_vec(printed, field.context).is_groebner()
    return decided(
        found == ideal(field, printed) and groebner and len(found.basis) == 10,
        "Buchberger's criterion, and equal ideals by Groebner bases; dimension 2, 10 generators",
        f"the reduced basis has {len(found.basis)} elements",
    )


@statement("T25 section 7", "20 equations in 20 unknowns at first")
def count_of_equations() -> Verdict:
    """PT13 5.5 counts 37 with (12): 7 for each of 4 joints, 3 for each of 2, 3 for the loop."""
    bodies, joints = 5, 6
    first = bodies + 2 * joints + 3
    components = len(bricard.joint_2_component(A, B)) + 2
    counts = (first, 4 * bodies, 6 * components + 3, 4 * components + 2 * 3 + 3)
    return decided(
        counts == (20, 20, 45, 37),
        "norms, two constraints a joint, the loop; with (12) for all joints 45, with 3 for each "
        "of the two on the ground 37, as PT13 5.5 says",
        f"{first} equations",
    )


STATEMENTS: tuple[Any, ...] = (
    condition_h,
    initial_values,
    local_vector,
    constraints_of_joint_1,
    joint_1,
    constraints_of_joint_2,
    turn_of_joint_2,
    component_of_joint_2,
    component_of_the_initial_values,
    component_of_the_mechanism,
    two_joints,
    count_of_equations,
)
