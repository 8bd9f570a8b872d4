"""T25 section 6: Bennett's variety, and what is eliminated to reach it."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from typing import Any

from nag.algebra.groebner import Ideal, ideal, intersection
from nag.algebra.rational_function import FunctionField
from nag.check.bennett import OWN, PARAMETERS, M, at_parameters
from nag.check.bricard_variety import smooth
from nag.check.identities import Residuals, identity, labelled, surviving
from nag.check.loops import bennett_equations, bennett_mechanism
from nag.check.rings import contains
from nag.check.statement import Kind, Verdict, decided, fails, statement
from nag.mechanism.axes import difference
from nag.mechanism.mobility import gruebler_kutzbach
from nag.symbolic import bennett, bennett_geometry

# T25's order: b3 > b2 > b1 > b0 > c2 > c0 > a2 > a0, by degree.
LARGE = FunctionField("b3 b2 b1 b0 c2 c0 a2 a0", "degrevlex")
MEDIUM = FunctionField("b3 b2 c2 c0 a2 a0", "degrevlex")
SMALL = FunctionField("c2 c0 a2 a0", "degrevlex")
Parameters = tuple[Fraction, ...]


def _substituted(m: Any, v: dict[str, Any], b: Any) -> list[Any]:
    """The mechanism's equations where (16) gives a and c."""
    a, _, c = bennett.essential_to_all(m, v["a0"], v["a2"], v["c0"], v["c2"])
    return bennett_equations(m, (a, b, c))


def _names(field: FunctionField) -> dict[str, Any]:
    return dict(zip(field.names, field.variables, strict=True))


@lru_cache(maxsize=8)
def i_3(m: Parameters) -> Ideal:
    """I_3: J_a, J_c, J_ab, J_bc and the loop."""
    v = _names(LARGE)
    return ideal(LARGE, _substituted(m, v, (v["b0"], v["b1"], v["b2"], v["b3"])))


@lru_cache(maxsize=8)
def i_4(m: Parameters) -> Ideal:
    """I_4: I_{3,0} with b_0 = t_0 a_0 c_0 and b_1 = t_1 a_0 c_0 substituted."""
    v = _names(MEDIUM)
    t0, t1, *_ = bennett.coefficients(m)
    product = v["a0"] * v["c0"]
    return ideal(MEDIUM, _substituted(m, v, (t0 * product, t1 * product, v["b2"], v["b3"])))


@lru_cache(maxsize=8)
def i_5(m: Parameters) -> Ideal:
    """I_5: with (19)."""
    v = _names(MEDIUM)
    b = bennett.essential_to_all(m, v["a0"], v["a2"], v["c0"], v["c2"])[1]
    return i_4(m).enlarged([v["b2"] - b[2], v["b3"] - b[3]])


def variety(m: Parameters) -> Ideal:
    """I_benn."""
    v = _names(SMALL)
    return ideal(SMALL, bennett.variety(m, v["a0"], v["a2"], v["c0"], v["c2"]))


def _everywhere(test: Any, how: str) -> Verdict:
    """Whether a test holds at all parameters."""
    wrong = [m for m in PARAMETERS if not test(m)]
    text = ", ".join(map(str, wrong[0])) if wrong else ""
    return decided(not wrong, f"{how}, at m = {at_parameters()}", f"not at m = ({text})")


def on_the_curve(formula: Any) -> list[str]:
    """What does not vanish at the parametrised point, for all m and t.

    Args:
        formula: from m and a0, a2, c0, c2 to what should vanish.
    """

    def residuals(cos: Any, m0: Any, m1: Any, m2: Any, *roots: Any) -> Residuals:
        root6, root1, sin = roots
        m = (m0, m1, m2)
        return formula(m, *bennett.parametrisation(m, cos, sin, root1, root6))

    # sqrt(q_6) is given without the sine: sin^2 is 1 - cos^2.
    roots = (
        ("root6", lambda cos, m0, m1, m2: (m1**2 + m2**2) * (m2**2 * (1 - cos**2) + cos**2)),
        ("root1", lambda cos, m0, m1, m2: m1**2 + 1),
        ("sin", lambda cos, *_: 1 - cos**2),
    )
    return surviving(f"cos {M}", residuals, roots)


@statement("T25 (17)", "the basis of I_3 in degree order has 23 elements; dim V(I_3) = 1")
def basis_of_23() -> Verdict:
    return _everywhere(
        lambda m: (len(i_3(m).basis), i_3(m).dimension) == (23, 1), "Groebner bases by FLINT"
    )


@statement("T25 (17)", "g_0, g_1, g_3, g_4 as printed, b_1 + gamma_0 b_0 and g_5 lie in I_3")
def generators() -> Verdict:
    def test(m: Parameters) -> bool:
        v = _names(LARGE)
        a0, a2, c0, c2 = (v[x] for x in ("a0", "a2", "c0", "c2"))
        t0, t1, *_ = bennett.coefficients(m)
        g = [*bennett.variety(m, a0, a2, c0, c2), bennett.g_4(m, a0, c0)[0]]
        g += [v["b1"] - t1 / t0 * v["b0"], bennett.g_5(m, a0, c0, v["b0"])]
        return contains(i_3(m), g)

    return _everywhere(test, "division by the Groebner basis of I_3")


@statement("T25 section 6", "the two forms of g_4 are equal, and g_4 lies in I_benn")
def second_form() -> Verdict:
    def formula(a0: Any, c0: Any, *m: Any) -> Residuals:
        first, second = bennett.g_4(m, a0, c0)
        return {"difference": first - second}

    found = identity(f"a0 c0 {M}", formula, tuple(map(Fraction, (1, 2, 2, 3, 5))))
    inside = _everywhere(
        lambda m: contains(variety(m), [bennett.g_4(m, SMALL.variables[3], SMALL.variables[1])[0]]),
        "in I_benn by division",
    )
    return Verdict(
        found.kind if inside.kind is Kind.EXACT else inside.kind,
        f"{found.how}; {inside.how}",
        found.counterexample or inside.counterexample,
    )


@statement("T25 remark 6.3", "(m2^2 - 1)(m1^2 + 1)(m1^2 + m2^2) gamma_4 is a perfect square")
def perfect_square() -> Verdict:
    """gamma_4 is read off from I_3 at exact parameters, and t_0^2 m_2^2 is the square."""

    def test(m: Parameters) -> bool:
        v = _names(LARGE)
        g = bennett.g_5(m, v["a0"], v["c0"], v["b0"])
        # Another factor would not vanish on I_3.
        other = g + (v["a0"] ** 2 - v["c0"] ** 2)
        return contains(i_3(m), [g]) and not contains(i_3(m), [other])

    return _everywhere(test, "gamma_4 = t_0^2 m2^2/(..) makes g_5 an element of I_3, no other does")


@statement("T25 (18)", "b_0 = +-t_0 a_0 c_0 and b_1 = +-t_1 a_0 c_0 on V(I_3)")
def signs_of_b() -> Verdict:
    def test(m: Parameters) -> bool:
        v = _names(LARGE)
        t0, t1, *_ = bennett.coefficients(m)
        product = v["a0"] * v["c0"]
        return contains(
            i_3(m),
            [v["b0"] ** 2 - (t0 * product) ** 2, v["b1"] ** 2 - (t1 * product) ** 2],
        )

    return _everywhere(test, "division by the Groebner basis of I_3")


def _half(m: Parameters, sign: int) -> Ideal:
    v = _names(LARGE)
    t0, t1, *_ = bennett.coefficients(m)
    product = sign * v["a0"] * v["c0"]
    return i_3(m).enlarged([v["b0"] - t0 * product, v["b1"] - t1 * product])


@statement("T25 section 6", "I_3 is not prime: it is the intersection of I_{3,0} and I_{3,1}")
def two_halves() -> Verdict:
    def test(m: Parameters) -> bool:
        halves = _half(m, 1), _half(m, -1)
        return intersection(*halves) == i_3(m) and halves[0] != halves[1]

    return _everywhere(test, "Groebner bases by FLINT")


@statement("T25 section 6", "I_4 = I_5 n I_{5,0} n I_{5,1}, with a_0 = 0 and with c_0 = 0")
def three_parts() -> Verdict:
    def test(m: Parameters) -> bool:
        v = _names(MEDIUM)
        first, second = (i_4(m).enlarged([v[x]]) for x in ("a0", "c0"))
        return intersection(intersection(i_5(m), first), second) == i_4(m)

    return _everywhere(test, "Groebner bases by FLINT")


@statement(
    "T25 section 6", "the bases of I_4 and I_5 have 20 and 15 elements; a_0 and c_0 are factors"
)
def smaller_bases() -> Verdict:
    """hat g_0 = a_0 (..), hat g_1 = c_0 (..), hat g_2 = c_0 (..)."""

    def test(m: Parameters) -> bool:
        v, basis = _names(MEDIUM), i_4(m).basis
        divided = [sum(f % v[x].numerator == 0 for f in basis) for x in ("a0", "c0")]
        return (len(basis), len(i_5(m).basis)) == (20, 15) and divided[0] >= 1 and divided[1] >= 2

    return _everywhere(test, "Groebner bases by FLINT in degree order")


def _points(m: Parameters, name: str) -> Ideal:
    return i_4(m).enlarged([_names(MEDIUM)[name]])


@statement("T25 section 6", "V(I_{5,0}) and V(I_{5,1}) are 8 points each, by signs of a, b and c")
def isolated_points() -> Verdict:
    def test(m: Parameters) -> bool:
        for name in ("a0", "c0"):
            found = _points(m, name)
            v = _names(MEDIUM)
            for body in ("a", "b", "c"):
                flipped = [
                    _flip(f, [i for i, x in enumerate(MEDIUM.names) if x[0] == body])
                    for f in found.basis
                ]
                if not found.contains(flipped):
                    return False
            # No point is its own image: no body has only zeros.
            bodies = [[v["a0"], v["a2"]], [v["b2"], v["b3"]], [v["c0"], v["c2"]]]
            still = any(not found.enlarged(b).whole for b in bodies)
            if still or (found.dimension, found.degree) != (0, 8):
                return False
        return True

    return _everywhere(test, "dimension 0, degree 8, one orbit of the changes of sign")


def _flip(f: Any, places: list[int]) -> Any:
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

    return _everywhere(test, "the sums with I_5 have dimension 0, degree 4")


@statement("T25 (19)", "b_2 and b_3 with t_2 to t_5, on V(I_5)")
def remaining_entries() -> Verdict:
    """The curve that (16), (18) and (19) map V(I_benn) to satisfies the mechanism's equations."""
    kept = on_the_curve(_equations_at)
    return decided(
        not kept,
        "the mechanism's equations vanish identically in m and t at the parametrised point",
        f"{kept} not 0",
    )


def _equations_at(m: Any, a0: Any, a2: Any, c0: Any, c2: Any) -> Residuals:
    bodies = bennett.essential_to_all(m, a0, a2, c0, c2)
    return labelled("equation", bennett_equations(m, bodies))


@statement("T25 (20)", "I_final has I_benn as its elimination ideal, and h is its inverse")
def final_ideal() -> Verdict:
    def test(m: Parameters) -> bool:
        v = _names(SMALL)
        b = bennett.essential_to_all(m, v["a0"], v["a2"], v["c0"], v["c2"])
        reduced = contains(variety(m), bennett_equations(m, b))
        order = FunctionField(("b3", "b2", *SMALL.names))
        lifted = ideal(order, [_renamed(f, order) for f in i_5(m).basis])
        kept = [g for g in lifted.basis if not any(int(e[0] or e[1]) for e in g.to_dict())]
        wanted = ideal(order, [_renamed(f, order) for f in variety(m).basis])
        return reduced and ideal(order, kept) == wanted

    return _everywhere(
        test, "the mechanism's equations reduce to 0 modulo I_benn; elimination by FLINT"
    )


def _renamed(f: Any, field: FunctionField) -> Any:
    k = len(field.names) - len(f.context().names())
    return field.context.from_dict({(*[0] * k, *map(int, e)): c for e, c in f.to_dict().items()})


@statement("T25 section 6", "V(I_benn) is regular and of dimension 1: a complete intersection")
def regular() -> Verdict:
    def test(m: Parameters) -> bool:
        v = _names(SMALL)
        g = bennett.variety(m, v["a0"], v["a2"], v["c0"], v["c2"])
        return smooth(SMALL, g, 3) and (variety(m).dimension, variety(m).degree) == (1, 8)

    return _everywhere(test, "the 3-minors of the Jacobian have no common zero with g_0, g_1, g_3")


@statement("T25 section 6", "the parametrisation lies on V(I_benn)")
def parametrisation() -> Verdict:
    kept = on_the_curve(lambda m, *x: labelled("g", bennett.variety(m, *x)))
    return decided(
        not kept, "identity in m and cos t, with sin t and both roots adjoined", str(kept)
    )


@statement(
    "T25 section 6", "V(I_benn) has two real components; the sign of c takes one to the other"
)
def two_real_components() -> Verdict:
    """g_0 is a circle; over it g_1 and g_3 give (c_0, c_2) up to a common sign, nowhere 0."""

    def formula(a0: Any, a2: Any, k: Any, *m: Any) -> Residuals:
        m0, m1, m2 = m
        q5 = bennett_geometry.abbreviations(m)["q5"]
        # Solutions of g_3 are multiples of this, and g_1 gives the square of the multiple.
        c0, c2 = k * m1 * (m0**2 + 1) * a2, -k * q5 * a0
        g = bennett.variety(m, a0, a2, c0, c2)
        size = m1**2 * (m2**2 * (m0**2 + 1) ** 2 * a2**2 + q5**2 * a0**2)
        right = m1**2 * m2**2 / (m1**2 + m2**2)
        return {"g_3": g[2], "g_1": g[1] - k**2 * size + right}

    at = tuple(map(Fraction, (1, 2, 3, 2, 3, 5)))
    found = identity(f"a0 a2 k {M}", formula, at)
    how = f"{found.how}: (c0, c2) = k (..), k^2 the inverse of a positive form on the circle g_0"
    return Verdict(found.kind, how, found.counterexample)


INITIAL = ("root1", lambda m0, m1, m2: m1**2 + 1)


def _initial(printed: bool) -> Any:
    """The point of cos t = m1/sqrt(m1^2 + 1), sin t = -1/sqrt(m1^2 + 1); sqrt(q_6) is n2/root1."""

    def residuals(m0: Any, m1: Any, m2: Any, root1: Any) -> Residuals:
        m = (m0, m1, m2)
        root6 = (m1**2 + m2**2) / root1
        cos, sin = m1 / root1, -1 / root1
        bodies = bennett.essential_to_all(m, *bennett.parametrisation(m, cos, sin, root1, root6))
        found = {"sqrt(q_6)": root6**2 - bennett.under_the_root(m, cos, sin)}
        sign = (1, 1 if printed else -1, 1)
        for name, s, q, wanted in zip("abc", sign, bodies, bennett.orientations(m), strict=True):
            found |= labelled(f"{name} - {name}_init", difference([s * x for x in q], wanted))
        return found

    return residuals


@statement(
    "T25 after (20)", "cos t = m1/n, sin t = -1/n, n^2 = m1^2 + 1 is the initial point", True
)
def initial_point() -> Verdict:
    """Known at m1 = 3/4, where the root is rational."""
    at = (Fraction(2), Fraction(3, 4), Fraction(1, 3), Fraction(5, 4))
    found = identity(M, _initial(True), at, (INITIAL,))
    if surviving(M, _initial(False), (INITIAL,)):
        return Verdict(Kind.OPEN, "the point is neither with b nor with -b the initial one")
    return fails(
        "true is: it is the initial point with -b_init for b_init, identically in m; as "
        "R(b) = R(-b), the same configuration",
        found.counterexample,
    )


@statement("T25 section 7", "counting gives -2 for Bennett's mechanism, which moves")
def overconstrained() -> Verdict:
    counted = gruebler_kutzbach(bennett_mechanism(OWN))
    return decided(
        (counted, variety(OWN).dimension) == (-2, 1),
        "Gruebler-Kutzbach; V(I_benn) has dimension 1",
        f"counted {counted}",
    )


STATEMENTS = (
    basis_of_23,
    generators,
    second_form,
    perfect_square,
    signs_of_b,
    two_halves,
    three_parts,
    smaller_bases,
    isolated_points,
    four_points_on_the_curve,
    remaining_entries,
    final_ideal,
    regular,
    parametrisation,
    two_real_components,
    initial_point,
    overconstrained,
)
