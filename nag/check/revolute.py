"""T25 section 3: the two components of a revolute joint, and frames."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from nag.algebra.groebner import Ideal, ideal
from nag.check.identities import Residuals, Root, identity, labelled, matrix, surviving
from nag.check.joints import E1, E2, E3
from nag.check.rings import (
    apply,
    contains,
    euler_ring,
    intersect_in,
    product,
    scalar,
    transpose,
    unit,
)
from nag.check.statement import Verdict, decided, holds, statement
from nag.mechanism.axes import difference, dot
from nag.mechanism.quaternion import (
    K,
    K_tilde,
    R,
    add,
    conjugate,
    multiply,
    norm_squared,
    rotate,
    scale,
)
from nag.symbolic import revolute

P = "p0 p1 p2 p3"
FRAME = tuple(map(Fraction, (1, 2, 3, 5)))
RING, (U, Z) = euler_ring("uz")
# The axis chi as a unit vector: its third entry is a root.
AXIS: Root = ("x3", lambda x1, x2, *_: 1 - x1**2 - x2**2)
AXIS_AT = (Fraction(2, 3), Fraction(1, 3), Fraction(2, 3))


def joint() -> Ideal:
    """I_rev of T25 before (8)."""
    axis = rotate(Z, E3)
    return ideal(RING, [dot(rotate(U, E1), axis), dot(rotate(U, E2), axis), *unit(U, Z)])


def component(j: int) -> Ideal:
    """I_rev^j of (8)."""
    return ideal(RING, [*revolute.component(U, Z, j), *unit(U, Z)])


@statement("T25 (8)", "I_rev is the intersection of I_rev^1 and I_rev^2, as ideals")
def components_intersect_in_the_joint() -> Verdict:
    return decided(
        intersect_in(joint(), (component(1), component(2))),
        "Groebner bases by FLINT: I_rev lies in both, their products in I_rev, their sum is 1",
        "the intersection is another ideal",
    )


@statement("T25 (8)", "on I_rev^1 the axes are equal, on I_rev^2 opposite")
def directions_of_the_axis() -> Verdict:
    here, there = rotate(U, E3), rotate(Z, E3)
    same = contains(component(1), difference(there, here))
    opposite = contains(component(2), [x + y for x, y in zip(here, there, strict=True)])
    return decided(same and opposite, "division by the two bases", "the axes differ otherwise")


@statement("T25 (8)", "V(I_rev^1) and V(I_rev^2) do not meet")
def components_do_not_meet() -> Verdict:
    """1 is a combination: the k_1, k_2 of both are the entries of conj(u) z."""

    def formula(*x: Any) -> Residuals:
        u, z = x[:4], x[4:]
        k = [f for j in (1, 2) for f in revolute.component(u, z, j)[:2]]
        return {"certificate": sum(f**2 for f in k) - norm_squared(u) * norm_squared(z)}

    at = tuple(map(Fraction, range(1, 9)))
    found = identity("u0 u1 u2 u3 z0 z1 z2 z3", formula, at)
    how = f"{found.how}: the squares of k_1, k_2 of both add up to |u|^2 |z|^2 = 1"
    return Verdict(found.kind, how, found.counterexample)


@statement("T25 (8)", "I_rev^1 and I_rev^2 are prime, of dimension 4")
def components_are_prime() -> Verdict:
    """Each is <r_i, r_j, |u|^2 - 1, |r|^2 - 1> for r = conj(u) z: a circle times a sphere."""
    r = multiply(conjugate(U), Z)
    true = True
    for j, (i, k) in ((1, (1, 2)), (2, (0, 3))):
        found = component(j)
        true &= found == ideal(RING, [r[i], r[k], *unit(U, Z)])
        true &= (found.dimension, found.degree) == (4, 8)
    how = "u -> u, z -> conj(u) z makes each a circle times the sphere |u| = 1, both irreducible"
    return decided(true, f"{how}; dimension 4, degree 8 by Groebner bases", "they are others")


@statement("T25 remark 3.1", "the k_m^j are of degree 2, the p_m of degree 4")
def degrees() -> Verdict:
    k = [f.numerator.total_degree() for j in (1, 2) for f in revolute.component(U, Z, j)]
    axis = rotate(Z, E3)
    p = [dot(rotate(U, e), axis).numerator.total_degree() for e in (E1, E2)]
    return decided(set(k) == {2} and set(p) == {4}, "counted", f"degrees {k} and {p}")


@statement("T25 lemma 3.1", "L beta = |v||y| beta gives |beta|^2 |v|/|y| y = R(beta) v")
def eigenvectors_turn() -> Verdict:
    def formula(*x: Any) -> Residuals:
        v, y, w, (s, t) = x[:3], x[3:6], x[6:10], x[10:]
        L = product(K_tilde((0 * s, *v)), transpose(K((0 * s, *y))))
        beta = add(apply(L, w), scale(w, s * t))
        n = norm_squared(beta)
        left = [n * s / t * e for e in y]
        return labelled("R(beta) v - |beta|^2 |v|/|y| y", difference(rotate(beta, v), left))

    roots = (
        ("lv", lambda *x: dot(x[:3], x[:3])),
        ("ly", lambda *x: dot(x[3:6], x[3:6])),
    )
    at = tuple(map(Fraction, (1, 2, 2, 2, 3, 6, 1, 2, 3, 4, 3, 7)))
    return identity("v1 v2 v3 y1 y2 y3 w0 w1 w2 w3", formula, at, roots)


@statement("T25 lemma 3.2", "R(beta) e^3 = |beta|^2 chi, |beta|^2 = 2 (1 + chi_3)")
def turn_to_axis() -> Verdict:
    def formula(*chi: Any) -> Residuals:
        beta = revolute.turn_to_axis(chi)
        n = norm_squared(beta)
        turned = difference(rotate(beta, E3), [n * x for x in chi])
        return {**labelled("turned", turned), "|beta|^2": n - 2 * (1 + chi[2])}

    return identity("x1 x2", formula, AXIS_AT, (AXIS,))


def frame(p: Any) -> tuple[Any, Any, Any]:
    """Every orthonormal right-handed frame is one of these."""
    n = norm_squared(p)
    return tuple(tuple(x / n for x in rotate(p, e)) for e in (E1, E2, E3))


def _involutions(eta: Any, xi: Any) -> tuple[Any, Any]:
    zero = 0 * eta[0]
    one = zero + 1
    e1, e2 = (zero, one, zero, zero), (zero, zero, one, zero)
    return (
        product(transpose(K_tilde(e1)), K((zero, *eta))),
        product(transpose(K_tilde(e2)), K((zero, *xi))),
    )


@statement("T25 lemma 3.3", "alpha is there, and is unique up to a factor")
def common_eigenvector() -> Verdict:
    """(I + L_1)(I + L_2)/4 projects on the common eigenspace; its trace is the dimension."""

    def formula(*p: Any) -> Residuals:
        eta, xi, _ = frame(p)
        first, second = _involutions(eta, xi)
        one = scalar(0 * eta[0] + 1, 4)
        halves = [[add(r, s) for r, s in zip(one, L, strict=True)] for L in (first, second)]
        projection = [[x / 4 for x in row] for row in product(*halves)]
        return {
            **matrix("L_1^2 - I", product(first, first), one),
            **matrix("L_2^2 - I", product(second, second), one),
            **matrix("[L_1, L_2]", product(first, second), product(second, first)),
            "trace - 1": sum(projection[i][i] for i in range(4)) - 1,
        }

    found = identity(P, formula, FRAME)
    how = f"{found.how}, frames being R(p) e^i/|p|^2: the common eigenspace has dimension 1"
    return Verdict(found.kind, how, found.counterexample)


@statement("T25 lemma 3.4", "R(alpha^j) e^1 = |alpha^j|^2 eta and R(alpha^j) e^2 = |alpha^j|^2 xi")
def turns_to_frame() -> Verdict:
    def formula(*p: Any) -> Residuals:
        eta, xi, _ = frame(p)
        found = {}
        for j, alpha in enumerate(revolute.turns_to_frame(eta, xi), 1):
            n = norm_squared(alpha)
            for e, x in ((E1, eta), (E2, xi)):
                turned = difference(rotate(alpha, e), [n * y for y in x])
                found |= labelled(f"alpha^{j}, e^{1 if e is E1 else 2}", turned)
        return found

    return identity(P, formula, FRAME)


@statement("T25 lemma 3.4", "alpha^1 and alpha^2 are not both 0 if eta_3 is not 0")
def turns_do_not_vanish() -> Verdict:
    def formula(*p: Any) -> Residuals:
        eta, xi, _ = frame(p)
        first, second = revolute.turns_to_frame(eta, xi)
        return {"alpha^1_1 - alpha^2_0 - 2 eta_3": first[1] - second[0] - 2 * eta[2]}

    return identity(P, formula, FRAME)


@statement("T25 lemma 3.4", "w^1, w^2 are turns of e^1 to eta, and alpha^j = w^j + L_2 w^j")
def turns_from_eigenvectors() -> Verdict:
    def formula(*p: Any) -> Residuals:
        eta, xi, _ = frame(p)
        first, second = _involutions(eta, xi)
        found = {}
        alphas = revolute.turns_to_frame(eta, xi)
        for j, (w, alpha) in enumerate(zip(revolute.eigenvectors(eta), alphas, strict=True), 1):
            found |= labelled(f"L_1 w^{j} - w^{j}", difference(apply(first, w), w))
            found |= labelled(f"alpha^{j}", difference(add(w, apply(second, w)), alpha))
        return found

    return identity(P, formula, FRAME)


@statement("T25 remark 3.3", "alpha^1 and alpha^2 are linearly dependent")
def turns_are_dependent() -> Verdict:
    def formula(*p: Any) -> Residuals:
        eta, xi, _ = frame(p)
        x, y = revolute.turns_to_frame(eta, xi)
        return {f"minor {i}, {j}": x[i] * y[j] - x[j] * y[i] for i in range(4) for j in range(i)}

    return identity(P, formula, FRAME)


@statement("T25 section 3", "the formulas for |alpha^1|^2 and |alpha^2|^2, which are not both 0")
def squared_lengths() -> Verdict:
    def formula(*p: Any) -> Residuals:
        eta, xi, _ = frame(p)
        alphas = revolute.turns_to_frame(eta, xi)
        printed = revolute.squared_lengths(eta, xi)
        found = {f"|alpha^{j + 1}|^2": norm_squared(alphas[j]) - printed[j] for j in range(2)}
        return {**found, "sum - 8 (1 - eta_1)": sum(printed) - 8 * (1 - eta[0])}

    found = identity(P, formula, FRAME)
    return Verdict(found.kind, f"{found.how}; they add up to 8 (1 - eta_1)", found.counterexample)


@statement("T25 corollary 3.1", "alpha = K(b)^T conj(a) takes one orthogonal pair to another")
def pairs_turn() -> Verdict:
    def formula(*x: Any) -> Residuals:
        a, b = x[:4], x[4:]
        alpha = apply(transpose(K(b)), conjugate(a))
        found = {}
        for e in (E1, E2):
            # v and y of lengths 1, in the frames of a and b.
            v = [t / norm_squared(a) for t in rotate(a, e)]
            y = [t / norm_squared(b) for t in rotate(b, e)]
            n = norm_squared(alpha)
            found |= labelled(f"e{e}", difference(rotate(alpha, v), [n * t for t in y]))
        return found

    at = tuple(map(Fraction, (1, 2, 3, 4, 2, -1, 1, 5)))
    return identity("a0 a1 a2 a3 b0 b1 b2 b3", formula, at)


@statement(
    "T25 (9)", "u = K~(alpha)^T a/|alpha| = K(a)^T alpha/|alpha| has R(u) = R(a) R(alpha)/|alpha|^2"
)
def change_of_frame() -> Verdict:
    def formula(*x: Any) -> Residuals:
        a, alpha = x[:4], x[4:]
        # u |alpha| and R(u) |alpha|^2, so that no root is needed.
        u = apply(transpose(K_tilde(alpha)), a)
        other = apply(transpose(K(a)), alpha)
        return {
            **labelled("u", difference(u, other)),
            **matrix("R(u)", R(u), product(R(a), R(alpha))),
        }

    at = tuple(map(Fraction, (1, 2, 3, 4, 2, -1, 1, 5)))
    return identity("a0 a1 a2 a3 b0 b1 b2 b3", formula, at)


@statement("T25 section 1", "a joint with the fixed body eliminates two variables")
def linear_on_the_ground() -> Verdict:
    def formula(*x: Any) -> Residuals:
        z, w, scalars = x[:4], x[4:8], x[8:]
        one = (scalars[0] * 0 + 1, *[scalars[0] * 0] * 3)
        found = {}
        for j in (1, 2):
            k = [revolute.component(one, y, j)[:2] for y in (z, w, add(z, scale(w, scalars[0])))]
            linear = [p + scalars[0] * q - r for p, q, r in zip(*k, strict=True)]
            found |= labelled(f"k^{j}", linear)
        return found

    if surviving("z0 z1 z2 z3 w0 w1 w2 w3 t", formula):
        return decided(False, "", "k_1 and k_2 are not linear in z")
    return holds("for u = 1 two of the k_m^j are linear in z, identically")


STATEMENTS = (
    components_intersect_in_the_joint,
    directions_of_the_axis,
    components_do_not_meet,
    components_are_prime,
    degrees,
    eigenvectors_turn,
    turn_to_axis,
    common_eigenvector,
    turns_to_frame,
    turns_do_not_vanish,
    turns_from_eigenvectors,
    turns_are_dependent,
    squared_lengths,
    pairs_turn,
    change_of_frame,
    linear_on_the_ground,
)
