"""T25 section 6: Bennett's variety."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from nag.algebra.groebner import Ideal, ideal
from nag.algebra.rational_function import FunctionField
from nag.check.bennett import OWN, M
from nag.check.bennett_elimination import Parameters, everywhere, i_5, names
from nag.check.identities import Residuals, identity, labelled, surviving
from nag.check.loops import bennett_equations, bennett_mechanism
from nag.check.rings import contains, smooth
from nag.check.statement import Verdict, VerdictKind, decided, fails, statement
from nag.mechanism.axes import difference
from nag.mechanism.loops import gruebler_kutzbach
from nag.symbolic import bennett, bennett_geometry

SMALL = FunctionField("c2 c0 a2 a0", "degrevlex")


def variety(m: Parameters) -> Ideal:
    """I_benn."""
    v = names(SMALL)
    return ideal(SMALL, bennett.variety(m, v["a0"], v["a2"], v["c0"], v["c2"]))


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


@statement("T25 section 6", "the two forms of g_4 are equal, and g_4 lies in I_benn")
def second_form() -> Verdict:
    def formula(a0: Any, c0: Any, *m: Any) -> Residuals:
        first, second = bennett.g_4(m, a0, c0)
        return {"difference": first - second}

    found = identity(f"a0 c0 {M}", formula, tuple(map(Fraction, (1, 2, 2, 3, 5))))
    inside = everywhere(
        lambda m: contains(variety(m), [bennett.g_4(m, SMALL.variables[3], SMALL.variables[1])[0]]),
        "in I_benn by division",
    )
    return Verdict(
        found.kind if inside.kind is VerdictKind.EXACT else inside.kind,
        f"{found.how}; {inside.how}",
        found.counterexample or inside.counterexample,
    )


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
        v = names(SMALL)
        b = bennett.essential_to_all(m, v["a0"], v["a2"], v["c0"], v["c2"])
        reduced = contains(variety(m), bennett_equations(m, b))
        order = FunctionField(("b3", "b2", *SMALL.names))
        lifted = ideal(order, [_renamed(f, order) for f in i_5(m).basis])
        kept = [g for g in lifted.basis if not any(int(e[0] or e[1]) for e in g.to_dict())]
        wanted = ideal(order, [_renamed(f, order) for f in variety(m).basis])
        return reduced and ideal(order, kept) == wanted

    return everywhere(
        test, "the mechanism's equations reduce to 0 modulo I_benn; elimination by FLINT"
    )


def _renamed(f: Any, field: FunctionField) -> Any:
    k = len(field.names) - len(f.context().names())
    return field.context.from_dict({(*[0] * k, *map(int, e)): c for e, c in f.to_dict().items()})


@statement("T25 section 6", "V(I_benn) is regular and of dimension 1: a complete intersection")
def regular() -> Verdict:
    def test(m: Parameters) -> bool:
        v = names(SMALL)
        g = bennett.variety(m, v["a0"], v["a2"], v["c0"], v["c2"])
        return smooth(SMALL, g, 3) and (variety(m).dimension, variety(m).degree) == (1, 8)

    return everywhere(test, "the 3-minors of the Jacobian have no common zero with g_0, g_1, g_3")


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


@statement(
    "T25 figure 2", "projected to a0, a2, c0 the two curves meet; in four dimensions they do not"
)
def projection() -> Verdict:
    """Where c_0 = 0 the two differ in the sign of c_2 alone; c_0 = c_2 = 0 does not occur."""

    def test(m: Parameters) -> bool:
        v = names(SMALL)
        over = variety(m).enlarged([v["c0"]])
        apart = over.enlarged([v["c2"]]).whole
        same = ideal(SMALL, [_flipped(f) for f in over.basis]) == over
        return (over.dimension, over.degree) == (0, 4) and apart and same

    return everywhere(test, "four points with c0 = 0, two over each of two")


def _flipped(f: Any) -> Any:
    """With c_2 replaced by -c_2."""
    terms = {tuple(map(int, e)): -c if e[0] % 2 else c for e, c in f.to_dict().items()}
    return SMALL.context.from_dict(terms)


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
        return Verdict(VerdictKind.OPEN, "the point is neither with b nor with -b the initial one")
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
    second_form,
    remaining_entries,
    final_ideal,
    regular,
    parametrisation,
    two_real_components,
    projection,
    initial_point,
    overconstrained,
)
