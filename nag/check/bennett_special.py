"""T25, end of section 6: B_H mechanisms with q_5 = 0."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from nag.check.identities import Residuals, labelled, surviving
from nag.check.loops import bennett_equations
from nag.check.statement import Verdict, VerdictKind, decided, fails, statement
from nag.mechanism.axes import difference
from nag.symbolic import bennett, bennett_geometry

ROOTS = (
    ("root6", lambda cos, m0, m2: _under_the_root(m0, m2, cos)),
    ("sin", lambda cos, *_: 1 - cos**2),
)


def _under_the_root(m0: Any, m2: Any, cos: Any) -> Any:
    m1 = bennett.first_parameter_q5_zero(m0)
    return (m1**2 + m2**2) * (m2**2 * (1 - cos**2) + cos**2)


def _at_the_point(formula: Any) -> list[str]:
    def residuals(cos: Any, m0: Any, m2: Any, root6: Any, sin: Any) -> Residuals:
        m = (m0, m2)
        return formula(m, *bennett.parametrisation_q5_zero(m, cos, sin, root6))

    return surviving("cos m0 m2", residuals, ROOTS)


def _variety(printed: bool) -> Any:
    def formula(m: Any, *x: Any) -> Residuals:
        return labelled("equation", bennett.variety_q5_zero(m, *x, printed=printed))

    return formula


def _mechanism(printed: bool) -> Any:
    def formula(m: Any, *x: Any) -> Residuals:
        bodies = bennett.essential_to_all_q5_zero(m, *x, printed=printed)
        m0, m2 = m
        parameters = (m0, bennett.first_parameter_q5_zero(m0), m2)
        return labelled("equation", bennett_equations(parameters, bodies))

    return formula


@statement("T25 section 6, case q_5 = 0", "q_5 = 0 is m_1 = 2 m_0/(m_0^2 - 1); then a_2 = 0")
def parameter() -> Verdict:
    def formula(m0: Any, m2: Any) -> Residuals:
        m = (m0, bennett.first_parameter_q5_zero(m0), m2)
        return {
            "q_5": bennett_geometry.abbreviations(m)["q5"],
            "a_2": bennett.orientations(m)[0][2],
        }

    kept = surviving("m0 m2", formula)
    return decided(not kept, "identity in m0, m2", f"{kept} not 0")


@statement(
    "T25 section 6, case q_5 = 0, second equation",
    "the three equations in a_0, a_3, c_0, c_2",
    True,
)
def equations() -> Verdict:
    """At (7/4, 1/3) the initial configuration is exact."""
    m0, m2 = Fraction(7, 4), Fraction(1, 3)
    m = (m0, bennett.first_parameter_q5_zero(m0), m2)
    a, _, c = bennett.orientations(m)
    values = bennett.variety_q5_zero((m0, m2), a[0], a[3], c[0], c[2], printed=True)
    true = bennett.variety_q5_zero((m0, m2), a[0], a[3], c[0], c[2])
    if any(true) or _at_the_point(_variety(False)):
        return Verdict(VerdictKind.OPEN, "the equations that were thought to be true fail")
    if not any(values):
        return Verdict(VerdictKind.OPEN, "the equations hold at the initial configuration")
    return fails(
        "true is the denominator (m0^2 - 1)^2 m2^2 + 4 m0^2, from (17): identity in m0, m2 and "
        "cos t with roots adjoined",
        f"at m = (7/4, 56/33, 1/3) the second equation is {values[1]} at the initial configuration",
    )


@statement(
    "T25 section 6, case q_5 = 0", "a_1, a_2, c_1, c_3, b_0 and b_1, and the parametrisation"
)
def linear_equations() -> Verdict:
    """All but b_2 and b_3, which are in the next statement."""
    kept = _at_the_point(_mechanism(False))
    return decided(
        not kept,
        "the mechanism's equations vanish identically in m0, m2 and cos t, roots adjoined",
        f"{kept} not 0",
    )


@statement(
    "T25 section 6, case q_5 = 0, b_2 and b_3", "b_2 and b_3 in the essential variables", True
)
def last_entries() -> Verdict:
    m0, m2 = Fraction(7, 4), Fraction(1, 3)
    m = (m0, bennett.first_parameter_q5_zero(m0), m2)
    a, b, c = bennett.orientations(m)
    essential = a[0], a[3], c[0], c[2]
    printed = bennett.essential_to_all_q5_zero((m0, m2), *essential, printed=True)[1]
    true = bennett.essential_to_all_q5_zero((m0, m2), *essential)[1]
    off = [difference(printed, [s * x for x in b]) for s in (1, -1)]
    on = [difference(true, [s * x for x in b]) for s in (1, -1)]
    if _at_the_point(_mechanism(False)) or not any(not any(d) for d in on):
        return Verdict(VerdictKind.OPEN, "what was thought to be true fails")
    if any(not any(d) for d in off):
        return Verdict(VerdictKind.OPEN, "the formulas hold at the initial configuration")
    return fails(
        "true is the other way round: b_2 has -a_3 c_0 and b_3 has m2 (m0^2 - 1)/(2 m0) a_3 c_0, "
        "identically in m0, m2 and cos t",
        "at m = (7/4, 56/33, 1/3), a_init and c_init give (b_2, b_3) = "
        f"({printed[2]}, {printed[3]}), and b_init has ({b[2]}, {b[3]})",
    )


STATEMENTS = (parameter, equations, linear_equations, last_entries)
