"""PT13 sections 5.3 and 7.2: two four-bars in a row."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, product
from typing import Any

from nag.algebra.groebner import Ideal, ideal
from nag.algebra.rational_function import FunctionField
from nag.check.four_bar import intersected, splits_in_two
from nag.check.rings import radical_contains, smooth
from nag.check.statement import Verdict, decided, statement
from nag.symbolic import four_bar

RING = FunctionField(four_bar.TWO_VARIABLES, "degrevlex")
C, S = RING.variables[::2], RING.variables[1::2]
FIXED = FunctionField(four_bar.GONZALEZ_VARIABLES, "degrevlex")
GENERAL = (3, Fraction(5, 2))


def _second(x: Any) -> tuple[Any, ...]:
    return four_bar.second(x)


def pairs(a: Any, b: Any) -> list[Ideal]:
    """V_0 to V_3 of (10): a component of the first four-bar with one of the second."""
    ground = [C[0] - 1, S[0]]
    first = [four_bar.parallelogram(C[:4], S[:4]), four_bar.antiparallelogram(1, b, C[:4], S[:4])]
    c, s = _second(C), _second(S)
    second = [four_bar.parallelogram(c, s), four_bar.antiparallelogram(a, b, c, s)]
    return [ideal(RING, [*ground, *f, *g]) for f, g in product(first, second)]


def rhombus_pairs() -> list[Ideal]:
    """The 3^2 components of (9) with a = b = 1."""
    first = four_bar.rhombus(C[:4], S[:4])
    second = four_bar.rhombus(_second(C), _second(S))
    return [ideal(RING, [C[0] - 1, S[0], *f, *g]) for f, g in product(first, second)]


def gonzalez_bars() -> tuple[list[Any], list[Any]]:
    """Cosines and sines of bars 0 to 6, with bars 0 and 4 fixed."""
    v = FIXED.variables
    one = FIXED(1)
    c = [one, v[0], v[2], v[4], one, v[6], v[8]]
    s = [0 * one, v[1], v[3], v[5], 0 * one, v[7], v[9]]
    return c, s


def gonzalez_pairs() -> list[Ideal]:
    """Every component of the one rhombus with every one of the other, equal ones once."""
    c, s = gonzalez_bars()
    first = four_bar.rhombus(c[:4], s[:4])
    second = four_bar.rhombus(_second(c), _second(s))
    # Bars 3 and 4 against 5 and 6: c_4 - c_3 - c_5 + c_6 = 0, as in (8).
    parts = [ideal(FIXED, [*f, *g]) for f, g in product(first, second)]
    curves: list[Ideal] = []
    for part in parts:
        if part.dimension == 1 and part not in curves:
            curves.append(part)
    return curves


@statement("PT13 (10)", "V = V_0 u V_1 u V_2 u V_3, four distinct components of dimension 2")
def four_components() -> Verdict:
    """Turned by the direction of bar 3, each is a product of a curve of either four-bar."""
    a, b = GENERAL
    parts = pairs(a, b)
    whole = ideal(RING, four_bar.two_four_bars(a, b, C, S))
    distinct = not any(p.contains(q.basis) for p in parts for q in parts if p is not q)
    inside = all(p.contains(whole.basis) and p.dimension == 2 for p in parts)
    return decided(
        distinct and inside and all(splits_in_two(*sides) for sides in ((1, b), (a, b))),
        f"for a = {a}, b = {b}: either four-bar has the prime components J_0, J_1, so V is these "
        "four products; dimension 2, none in another, by Groebner bases",
        f"dimensions {[p.dimension for p in parts]}",
    )


@statement("PT13 5.3", "V_0 is a graph over V(<q_1, q_4>), a product of two circles")
def two_parallelograms() -> Verdict:
    part = pairs(*GENERAL)[0]
    printed = ideal(RING, four_bar.two_parallelograms(C, S))
    return decided(
        part == printed and (part.dimension, part.degree) == (2, 4),
        "its basis is q_1, q_4 and linear equations for the other variables; dimension 2, degree 4",
        "another ideal",
    )


@statement("PT13 5.3", "for a = b = 1 there are 3^2 = 9 components")
def nine_components() -> Verdict:
    parts = rhombus_pairs()
    whole = ideal(RING, four_bar.two_four_bars(1, 1, C, S))
    distinct = not any(p.contains(q.basis) for p in parts for q in parts if p is not q)
    planes = all((p.dimension, p.degree) == (2, 4) for p in parts)
    return decided(
        distinct and planes and intersected(parts) == whole,
        "Groebner bases by FLINT: nine pairs of circles, none in another, which intersect in (9)",
        "the pairs are not distinct",
    )


@statement("PT13 7.2", "many of the nine meet: intersection singularities")
def meeting_pairs() -> Verdict:
    met = [(p, q) for p, q in combinations(rhombus_pairs(), 2) if not (p + q).whole]
    return decided(len(met) > 0, f"{len(met)} of 36 pairs meet, by Groebner bases", "none meet")


@statement("PT13 (11)", "it is one of the nine, and smooth")
def component_11() -> Verdict:
    printed = ideal(RING, four_bar.two_parallelograms(C, S))
    # What is linear is solved; q_1 and q_4 are left.
    field = FunctionField("c1 s1 c4 s4", "degrevlex")
    c1, s1, c4, s4 = field.variables
    circles = [c1**2 + s1**2 - 1, c4**2 + s4**2 - 1]
    return decided(
        printed in rhombus_pairs() and smooth(field, circles, 2),
        "equal ideals; the 2-minors of the Jacobian of q_1, q_4 have no common zero with them",
        "it is not",
    )


@statement("PT13 7.2", "the system of Gonzalez has six components")
def six_components() -> Verdict:
    c, s = gonzalez_bars()
    curves = gonzalez_pairs()
    whole = ideal(FIXED, four_bar.gonzalez(c, s))
    conics = all((p.dimension, p.degree) == (1, 2) for p in curves)
    covered = all(p.contains(whole.basis) for p in curves) and whole.dimension == 1
    # Nine pairs cover V; those of dimension less than 1 must lie on the curves.
    first = four_bar.rhombus(c[:4], s[:4])
    second = four_bar.rhombus(_second(c), _second(s))
    rest = [ideal(FIXED, [*f, *g]) for f, g in product(first, second)]
    inside = all(p.dimension == 1 or any(_lies_on(p, q) for q in curves) or p.whole for p in rest)
    return decided(
        len(curves) == 6 and conics and covered and inside,
        "nine pairs of components of the rhombi are six conics, by Groebner bases",
        f"{len(curves)} curves",
    )


def _lies_on(small: Ideal, big: Ideal) -> bool:
    return small.contains(big.basis)


@statement("PT13 7.2", "hat I is one of the six, follows from (11), and is smooth")
def gonzalez_component() -> Verdict:
    c, s = gonzalez_bars()
    printed = ideal(FIXED, four_bar.gonzalez_component(c, s))
    from_11 = ideal(FIXED, four_bar.two_parallelograms(c, s))
    field = FunctionField("c1 s1", "degrevlex")
    c1, s1 = field.variables
    circle = c1**2 + s1**2 - 1
    return decided(
        printed in gonzalez_pairs() and printed == from_11 and smooth(field, [circle], 1),
        "equal ideals, (11) with c_4 = 1, s_4 = 0; a circle and linear equations",
        "it is not",
    )


@statement("PT13 7.2", "the components meet where bars are aligned along the horizontal axis")
def singular_configurations() -> Verdict:
    """All five bars: the s vanish wherever two of the six curves meet."""
    _, s = gonzalez_bars()
    met = 0
    for p, q in combinations(gonzalez_pairs(), 2):
        both = p + q
        if both.whole:
            continue
        met += 1
        if both.dimension != 0 or not all(radical_contains(both, x) for x in s if x):
            return decided(False, "", "two curves meet elsewhere")
    return decided(met > 0, f"{met} pairs of the six curves meet, all with s = 0", "none meet")


STATEMENTS = (
    four_components,
    two_parallelograms,
    nine_components,
    meeting_pairs,
    component_11,
    six_components,
    gonzalez_component,
    singular_configurations,
)
