"""PT13 section 2 and 5.2: a graph over the circle, and three bars in space."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from nag.algebra.groebner import divisor, ideal, remainder
from nag.algebra.rational_function import FunctionField
from nag.check.identities import identity
from nag.check.rings import euler_ring
from nag.check.statement import Verdict, decided, statement
from nag.symbolic import triangle

SIDES = ((Fraction(3, 2), Fraction(5, 4)), (Fraction(4, 5), Fraction(1)), (2, Fraction(7, 3)))
# b_3 and b_2 are eliminated, so they come first.
VARIABLES = "b3 b2 b1 b0 a3 a2 a1 a0"


def _quaternions(v: Any) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    return tuple(v[7:3:-1]), tuple(v[3::-1])


@statement("PT13 (2)", "the elimination ideal of x, y is <x^2 + y^2 - 1>; V is a graph over it")
def graph() -> Verdict:
    field = FunctionField("z x y", "lex")
    z, x, y = field.variables
    circle, quartic = x**2 + y**2 - 1, z - 4 * x**4 - 3 * y**3 - x * y - 4
    found = ideal(field, [circle, quartic])
    kept = [g for g in found.basis if not any(int(e[0]) for e in g.to_dict())]
    return decided(
        len(kept) == 1 and ideal(field, kept) == ideal(field, [circle]) and found.dimension == 1,
        "lexicographic Groebner basis by FLINT; the second generator is z minus a polynomial",
        f"the elimination ideal has {len(kept)} generators",
    )


@statement("PT13 5.2", "the equations of the triangle lie in <g_0, .., g_4>, a Groebner basis")
def equations_reduce() -> Verdict:
    """Divided with L1 and L2 as parameters; the leading monomials are coprime two by two."""
    field = FunctionField(f"{VARIABLES} L1 L2")
    *v, L1, L2 = field.variables
    a, b = _quaternions(v)
    basis = [divisor(g.numerator, 8) for g in triangle.basis(L1, L2, a, b)]
    coprime = all(
        not any(p and q for p, q in zip(f.monomial, g.monomial, strict=True))
        for i, f in enumerate(basis)
        for g in basis[:i]
    )
    rest = [remainder(f.numerator, basis, 8) for f in triangle.equations(L1, L2, a, b)]
    return decided(
        coprime and not any(f != 0 for f in rest),
        "divided with L1, L2 as parameters; leading monomials without common variables",
        "an equation leaves a remainder",
    )


@statement("PT13 5.2", "g_0 to g_4 lie in the ideal of the equations")
def basis_lies_in_the_ideal() -> Verdict:
    field, (a, b) = euler_ring("ab")
    for L1, L2 in SIDES:
        found = ideal(field, triangle.equations(L1, L2, a, b))
        if found != ideal(field, triangle.basis(L1, L2, a, b)) or found.dimension != 3:
            return decided(False, "", f"not for L1 = {L1}, L2 = {L2}")
    sides = ", ".join(f"({x}, {y})" for x, y in SIDES)
    return decided(True, f"Groebner bases by FLINT for (L1, L2) = {sides}; dimension 3", "")


@statement("PT13 5.2", "g_0, g_1, g_2 are the elimination ideal of b_2 and b_3")
def eliminated() -> Verdict:
    field = FunctionField(VARIABLES)
    a, b = _quaternions(field.variables)
    for L1, L2 in SIDES:
        found = ideal(field, triangle.equations(L1, L2, a, b))
        kept = [g for g in found.basis if not any(int(e[0] or e[1]) for e in g.to_dict())]
        if ideal(field, kept) != ideal(field, triangle.basis(L1, L2, a, b)[:3]):
            return decided(False, "", f"not for L1 = {L1}, L2 = {L2}")
    return decided(True, f"lexicographic Groebner bases by FLINT for {len(SIDES)} triangles", "")


@statement("PT13 5.2", "alpha_0, alpha_1 and alpha_2 are positive for triangles")
def constants_are_positive() -> Verdict:
    """In x = L2 + 1 - L1, y = L1 + 1 - L2, z = L1 + L2 - 1, positive for a triangle 1, L1, L2."""

    def formula(x: Any, y: Any, z: Any) -> dict[str, Any]:
        one = (x + y) / 2
        # Sides one, L1, L2, scaled so that x + y = 2 gives the side 1.
        L1, L2 = (y + z) / 2 / one, (x + z) / 2 / one
        alpha = triangle.constants(L1, L2)
        products = (x * z, y * z, y * (x + y + z))
        return {f"alpha_{i}": alpha[i] - products[i] / one**2 for i in range(3)}

    found = identity("x y z", formula, (Fraction(1), Fraction(2), Fraction(3)))
    how = f"{found.how}: products of what the triangle inequalities make positive"
    return Verdict(found.kind, how, found.counterexample)


STATEMENTS = (
    graph,
    equations_reduce,
    basis_lies_in_the_ideal,
    eliminated,
    constants_are_positive,
)
