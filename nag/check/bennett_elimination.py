"""T25 section 6: the ideals that lead to Bennett's variety, from the mechanism's equations on."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from typing import Any

from nag.algebra.groebner import Ideal, ideal, intersection
from nag.algebra.rational_function import FunctionField
from nag.check.bennett import PARAMETERS, at_parameters
from nag.check.loops import bennett_equations
from nag.check.rings import contains
from nag.check.statement import Verdict, decided, statement
from nag.symbolic import bennett

# T25's order: b3 > b2 > b1 > b0 > c2 > c0 > a2 > a0, by degree.
LARGE = FunctionField("b3 b2 b1 b0 c2 c0 a2 a0", "degrevlex")
MEDIUM = FunctionField("b3 b2 c2 c0 a2 a0", "degrevlex")
Parameters = tuple[Fraction, ...]


def _substituted(m: Any, v: dict[str, Any], b: Any) -> list[Any]:
    """The mechanism's equations where (16) gives a and c."""
    a, _, c = bennett.essential_to_all(m, v["a0"], v["a2"], v["c0"], v["c2"])
    return bennett_equations(m, (a, b, c))


def names(field: FunctionField) -> dict[str, Any]:
    """The ring's variables by name."""
    return dict(zip(field.names, field.variables, strict=True))


@lru_cache(maxsize=8)
def i_3(m: Parameters) -> Ideal:
    """I_3: J_a, J_c, J_ab, J_bc and the loop."""
    v = names(LARGE)
    return ideal(LARGE, _substituted(m, v, (v["b0"], v["b1"], v["b2"], v["b3"])))


@lru_cache(maxsize=8)
def i_4(m: Parameters) -> Ideal:
    """I_4: I_{3,0} with b_0 = t_0 a_0 c_0 and b_1 = t_1 a_0 c_0 substituted."""
    v = names(MEDIUM)
    t0, t1, *_ = bennett.coefficients(m)
    product = v["a0"] * v["c0"]
    return ideal(MEDIUM, _substituted(m, v, (t0 * product, t1 * product, v["b2"], v["b3"])))


@lru_cache(maxsize=8)
def i_5(m: Parameters) -> Ideal:
    """I_5: with (19)."""
    v = names(MEDIUM)
    b = bennett.essential_to_all(m, v["a0"], v["a2"], v["c0"], v["c2"])[1]
    return i_4(m).enlarged([v["b2"] - b[2], v["b3"] - b[3]])


def everywhere(test: Any, how: str) -> Verdict:
    """Whether a test holds at all parameters."""
    wrong = [m for m in PARAMETERS if not test(m)]
    text = ", ".join(map(str, wrong[0])) if wrong else ""
    return decided(not wrong, f"{how}, at m = {at_parameters()}", f"not at m = ({text})")


@statement("T25 (17)", "the basis of I_3 in degree order has 23 elements; dim V(I_3) = 1")
def basis_of_23() -> Verdict:
    return everywhere(
        lambda m: (len(i_3(m).basis), i_3(m).dimension) == (23, 1), "Groebner bases by FLINT"
    )


@statement("T25 (17)", "g_0, g_1, g_3, g_4 as printed, b_1 + gamma_0 b_0 and g_5 lie in I_3")
def generators() -> Verdict:
    def test(m: Parameters) -> bool:
        v = names(LARGE)
        a0, a2, c0, c2 = (v[x] for x in ("a0", "a2", "c0", "c2"))
        t0, t1, *_ = bennett.coefficients(m)
        g = [*bennett.variety(m, a0, a2, c0, c2), bennett.g_4(m, a0, c0)[0]]
        g += [v["b1"] - t1 / t0 * v["b0"], bennett.g_5(m, a0, c0, v["b0"])]
        return contains(i_3(m), g)

    return everywhere(test, "division by the Groebner basis of I_3")


@statement("T25 remark 6.3", "(m2^2 - 1)(m1^2 + 1)(m1^2 + m2^2) gamma_4 is a perfect square")
def perfect_square() -> Verdict:
    """gamma_4 is read off from I_3 at exact parameters, and t_0^2 m_2^2 is the square."""

    def test(m: Parameters) -> bool:
        v = names(LARGE)
        g = bennett.g_5(m, v["a0"], v["c0"], v["b0"])
        # Another factor would not vanish on I_3.
        other = g + (v["a0"] ** 2 - v["c0"] ** 2)
        return contains(i_3(m), [g]) and not contains(i_3(m), [other])

    return everywhere(test, "gamma_4 = t_0^2 m2^2/(..) makes g_5 an element of I_3, no other does")


@statement("T25 (18)", "b_0 = +-t_0 a_0 c_0 and b_1 = +-t_1 a_0 c_0 on V(I_3)")
def signs_of_b() -> Verdict:
    def test(m: Parameters) -> bool:
        v = names(LARGE)
        t0, t1, *_ = bennett.coefficients(m)
        product = v["a0"] * v["c0"]
        return contains(
            i_3(m),
            [v["b0"] ** 2 - (t0 * product) ** 2, v["b1"] ** 2 - (t1 * product) ** 2],
        )

    return everywhere(test, "division by the Groebner basis of I_3")


def _half(m: Parameters, sign: int) -> Ideal:
    v = names(LARGE)
    t0, t1, *_ = bennett.coefficients(m)
    product = sign * v["a0"] * v["c0"]
    return i_3(m).enlarged([v["b0"] - t0 * product, v["b1"] - t1 * product])


@statement("T25 section 6", "I_3 is not prime: it is the intersection of I_{3,0} and I_{3,1}")
def two_halves() -> Verdict:
    def test(m: Parameters) -> bool:
        halves = _half(m, 1), _half(m, -1)
        return intersection(*halves) == i_3(m) and halves[0] != halves[1]

    return everywhere(test, "Groebner bases by FLINT")


@statement("T25 section 6", "I_4 = I_5 n I_{5,0} n I_{5,1}, with a_0 = 0 and with c_0 = 0")
def three_parts() -> Verdict:
    def test(m: Parameters) -> bool:
        v = names(MEDIUM)
        first, second = (i_4(m).enlarged([v[x]]) for x in ("a0", "c0"))
        return intersection(intersection(i_5(m), first), second) == i_4(m)

    return everywhere(test, "Groebner bases by FLINT")


@statement(
    "T25 section 6", "the bases of I_4 and I_5 have 20 and 15 elements; a_0 and c_0 are factors"
)
def smaller_bases() -> Verdict:
    """hat g_0 = a_0 (..), hat g_1 = c_0 (..), hat g_2 = c_0 (..)."""

    def test(m: Parameters) -> bool:
        v, basis = names(MEDIUM), i_4(m).basis
        divided = [sum(f % v[x].numerator == 0 for f in basis) for x in ("a0", "c0")]
        return (len(basis), len(i_5(m).basis)) == (20, 15) and divided[0] >= 1 and divided[1] >= 2

    return everywhere(test, "Groebner bases by FLINT in degree order")


def _points(m: Parameters, name: str) -> Ideal:
    return i_4(m).enlarged([names(MEDIUM)[name]])


@statement("T25 section 6", "V(I_{5,0}) and V(I_{5,1}) are 8 points each, by signs of a, b and c")
def isolated_points() -> Verdict:
    def test(m: Parameters) -> bool:
        v = names(MEDIUM)
        essential, b = [v[x] for x in ("a0", "a2", "c0", "c2")], [v["b2"], v["b3"]]
        # No point is its own image: no body has only zeros.
        bodies = (essential[:2], b, essential[2:])
        for j, name in enumerate(("a0", "c0")):
            found = _points(m, name)
            same = found == ideal(MEDIUM, bennett.isolated_points(m, j, essential, b))
            orbit = all(found.contains(_flip(f, x) for f in found.basis) for x in "abc")
            apart = all(found.enlarged(body).whole for body in bodies)
            if not (same and orbit and apart and (found.dimension, found.degree) == (0, 8)):
                return False
        return True

    return everywhere(
        test, "dimension 0, degree 8, one orbit of the changes of sign; formulas for the points"
    )


def _flip(f: Any, letter: str) -> Any:
    """With the sign of one body changed."""
    places = [i for i, name in enumerate(MEDIUM.names) if name.startswith(letter)]
    terms = {}
    for e, c in f.to_dict().items():
        odd = sum(int(e[i]) for i in places) % 2
        terms[tuple(map(int, e))] = -c if odd else c
    return MEDIUM.context.from_dict(terms)


@statement("T25 section 6", "four of the 8 points of either lie on V(I_5)")
def four_points_on_the_curve() -> Verdict:
    def test(m: Parameters) -> bool:
        both = [_points(m, x) + i_5(m) for x in ("a0", "c0")]
        return all((p.dimension, p.degree) == (0, 4) for p in both)

    return everywhere(test, "the sums with I_5 have dimension 0, degree 4")


STATEMENTS = (
    basis_of_23,
    generators,
    perfect_square,
    signs_of_b,
    two_halves,
    three_parts,
    smaller_bases,
    isolated_points,
    four_points_on_the_curve,
)
