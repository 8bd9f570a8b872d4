"""T25 section 2: Euler parameters."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from nag.algebra.groebner import ideal
from nag.algebra.rational_function import FunctionField
from nag.check.identities import Residuals, identity, labelled, matrix
from nag.check.rings import apply, determinant, product, scalar, transpose
from nag.check.statement import Verdict, decided, statement
from nag.mechanism.axes import cross, difference, dot
from nag.mechanism.quaternion import (
    H,
    H_tilde,
    K,
    K_tilde,
    R,
    add,
    conjugate,
    norm_squared,
    scale,
)
from nag.symbolic import joints, revolute

ONE = "a0 a1 a2 a3"
TWO = "a0 a1 a2 a3 b0 b1 b2 b3"
VECTORS = "v1 v2 v3 y1 y2 y3"
SMALL = tuple(Fraction(x) for x in (1, 2, -1, 3, 2, 5, -3, 1, 4, -2, 1, 7))


def _hat(v: Any) -> tuple[Any, ...]:
    return (0 * v[0], *v)


def _L(v: Any, y: Any) -> tuple[tuple[Any, ...], ...]:
    return product(K_tilde(_hat(v)), transpose(K(_hat(y))))


@statement("T25 2.1", "R(a) = H~(a) H(a)^T is the matrix printed")
def matrix_of_rotation() -> Verdict:
    def formula(*a: Any) -> Residuals:
        ours = matrix("R and ours", joints.R(a), R(a))
        return ours | matrix("R", product(H_tilde(a), transpose(H(a))), joints.R(a))

    return identity(ONE, formula, SMALL[:4])


@statement("T25 2.1", "R(a) lies in SO(3) if |a| = 1")
def rotations_are_orthogonal() -> Verdict:
    def formula(*a: Any) -> Residuals:
        n = norm_squared(a)
        gram = matrix("R R^T", product(R(a), transpose(R(a))), scalar(n * n, 3))
        return {**gram, "det R - |a|^6": determinant(R(a)) - n**3}

    return identity(ONE, formula, SMALL[:4])


@statement("T25 2.1", "K~(a) and K(a) lie in SO(4) if |a| = 1")
def quaternion_matrices_are_orthogonal() -> Verdict:
    def formula(*a: Any) -> Residuals:
        n, found = norm_squared(a), {}
        for name, m in (("K~", K_tilde(a)), ("K", K(a))):
            found |= matrix(f"{name} {name}^T", product(m, transpose(m)), scalar(n, 4))
            found[f"det {name} - |a|^4"] = determinant(m) - n * n
        return found

    return identity(ONE, formula, SMALL[:4])


@statement("T25 (1)", "R(a)^T = R(conjugate of a)")
def transposed() -> Verdict:
    return identity(ONE, lambda *a: matrix("R", transpose(R(a)), R(conjugate(a))), SMALL[:4])


@statement("T25 (1)", "K~(a)^T b = K(b)^T a")
def products_exchange() -> Verdict:
    def formula(*x: Any) -> Residuals:
        a, b = x[:4], x[4:]
        left, right = apply(transpose(K_tilde(a)), b), apply(transpose(K(b)), a)
        return labelled("difference", difference(left, right))

    return identity(TWO, formula, SMALL[:8])


@statement("T25 (1)", "R(c) = R(b) R(a) exactly for c = +-K(b)^T a")
def products_of_rotations() -> Verdict:
    def formula(*x: Any) -> Residuals:
        a, b = x[:4], x[4:]
        return matrix("R", R(apply(transpose(K(b)), a)), product(R(b), R(a)))

    found = identity(TWO, formula, SMALL[:8])
    field = FunctionField(ONE, "degrevlex")
    a = field.variables
    rows = [
        x - y
        for r, s in zip(R(a), scalar(field(1), 3), strict=True)
        for x, y in zip(r, s, strict=True)
    ]
    unit = ideal(field, [*rows, norm_squared(a) - 1])
    only = unit.contains([(a[0] ** 2 - 1).numerator, *((x**2).numerator for x in a[1:])])
    if not only:
        return decided(False, "", "R(a) = I has other solutions than a = +-1")
    return Verdict(
        found.kind, f"{found.how}; R(a) = I, |a| = 1 only for a = +-1, by a Groebner basis"
    )


@statement("T25 (1)", "K~(a) K(a)^T has the blocks |a|^2 and R(a)")
def blocks() -> Verdict:
    def formula(*a: Any) -> Residuals:
        zero = 0 * a[0]
        right = [(norm_squared(a), zero, zero, zero), *((zero, *row) for row in R(a))]
        return matrix("block", product(K_tilde(a), transpose(K(a))), right)

    return identity(ONE, formula, SMALL[:4])


@statement("T25 lemma 2.1, 1", "L = K~(v^) K(y^)^T is symmetric and L^2 = |v|^2 |y|^2 I")
def symmetric_square() -> Verdict:
    def formula(*x: Any) -> Residuals:
        v, y = x[:3], x[3:]
        L = _L(v, y)
        return {
            **matrix("L - L^T", L, transpose(L)),
            **matrix("L^2", product(L, L), scalar(dot(v, v) * dot(y, y), 4)),
        }

    return identity(VECTORS, formula, SMALL[:6])


@statement("T25 lemma 2.1, 2", "L has the double eigenvalues +-|v||y|, each with an eigenplane")
def eigenvalues() -> Verdict:
    def formula(*x: Any) -> Residuals:
        v, y, z = x[:3], x[3:6], x[6]
        L = _L(v, y)
        shifted = [difference(r, s) for r, s in zip(L, scalar(z, 4), strict=True)]
        square = dot(v, v) * dot(y, y)
        return {"det(L - z) - (z^2 - |v|^2 |y|^2)^2": determinant(shifted) - (z * z - square) ** 2}

    return identity(f"{VECTORS} z", formula, SMALL[:7])


@statement("T25 lemma 2.1, 3", "L L_0 - L_0 L = 2 <u, v> K(d^) + 2 <y, z> K~(q^)")
def commutator() -> Verdict:
    def formula(*x: Any) -> Residuals:
        v, y, u, z = x[:3], x[3:6], x[6:9], x[9:]
        L, L0 = _L(v, y), product(transpose(K_tilde(_hat(u))), K(_hat(z)))
        left = [difference(r, s) for r, s in zip(product(L, L0), product(L0, L), strict=True)]
        right = [
            add(scale(r, 2 * dot(u, v)), scale(s, 2 * dot(y, z)))
            for r, s in zip(K(_hat(cross(y, z))), K_tilde(_hat(cross(u, v))), strict=True)
        ]
        return matrix("commutator", left, right)

    return identity(f"{VECTORS} u1 u2 u3 z1 z2 z3", formula, SMALL)


@statement("T25 lemma 2.1, 4", "the two linear equations of the eigenplane La = |v||y|a")
def eigenplane() -> Verdict:
    def formula(*x: Any) -> Residuals:
        v, y, w, (s, t) = x[:3], x[3:6], x[6:10], x[10:]
        # L + |v||y| takes any vector into the eigenplane.
        a = add(apply(_L(v, y), w), scale(w, s * t))
        first, second = revolute.eigenplane(v, y, a, (s, t))
        return {"first": first, "second": second}

    roots = (
        ("lv", lambda *x: dot(x[:3], x[:3])),
        ("ly", lambda *x: dot(x[3:6], x[3:6])),
    )
    at = tuple(map(Fraction, (1, 2, 2, 2, 3, 6, 1, 2, 3, 4, 3, 7)))
    found = identity(f"{VECTORS} w0 w1 w2 w3", formula, at, roots)
    return Verdict(
        found.kind,
        f"{found.how}; the two are independent, for |v||y| > <v, y>",
        found.counterexample,
    )


@statement("T25 remark 2.1", "of y = x^2 the variable x is essential, and y is not")
def essential_of_a_parabola() -> Verdict:
    field = FunctionField("x y", "degrevlex")
    x, y = field.variables
    over_one = ideal(field, [(y - x**2).numerator, (y - 1).numerator])
    return decided(
        over_one.degree == 2 and over_one.contains([(x**2 - 1).numerator]),
        "(1, 1) and (-1, 1) have the same y; x -> (x, x^2) is the map",
        "y = 1 has one point",
    )


STATEMENTS = (
    matrix_of_rotation,
    rotations_are_orthogonal,
    quaternion_matrices_are_orthogonal,
    transposed,
    products_exchange,
    products_of_rotations,
    blocks,
    symmetric_square,
    eigenvalues,
    commutator,
    eigenplane,
    essential_of_a_parabola,
)
