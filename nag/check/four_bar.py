"""PT13 section 5.3: the four-bar with equal opposite sides."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from nag.algebra.groebner import Ideal, ideal, intersection, quotient
from nag.algebra.rational_function import FunctionField, RationalFunction
from nag.check.known import circle
from nag.check.rings import contains, minors
from nag.check.statement import Verdict, decided, fails, statement
from nag.symbolic import four_bar

# Pairs of sides that differ.
SIDES = ((2, 1), (3, 5), (Fraction(7, 4), Fraction(1, 3)))


def ring() -> tuple[FunctionField, Any, Any]:
    """The ring of the four bars, their cosines and sines."""
    field = FunctionField(four_bar.VARIABLES, "degrevlex")
    v = field.variables
    return field, v[::2], v[1::2]


RING, C, S = ring()


def intersected(parts: list[Ideal]) -> Ideal:
    """The intersection of all."""
    found = parts[0]
    for part in parts[1:]:
        found = intersection(found, part)
    return found


def splits_in_two(a: Any, b: Any) -> bool:
    """Whether J is the intersection of J_0 and J_1."""
    parts = [
        ideal(RING, four_bar.parallelogram(C, S)),
        ideal(RING, four_bar.antiparallelogram(a, b, C, S)),
    ]
    return intersected(parts) == ideal(RING, four_bar.four_bar(a, b, C, S))


@statement("PT13 5.3", "for a /= b, J is the intersection of J_0 and J_1")
def two_components() -> Verdict:
    for a, b in SIDES:
        if not splits_in_two(a, b):
            return decided(False, "", f"not for a = {a}, b = {b}")
    pairs = ", ".join(f"({a}, {b})" for a, b in SIDES)
    return decided(True, f"Groebner bases by FLINT for (a, b) = {pairs}", "")


@statement("PT13 5.3", "for a /= b, J is radical, and J_0 and J_1 are prime")
def components_are_prime() -> Verdict:
    """J is a complete intersection, so J_1 = J : f has no embedded components."""
    for a, b in SIDES:
        whole = ideal(RING, four_bar.four_bar(a, b, C, S))
        found = ideal(RING, four_bar.antiparallelogram(a, b, C, S))
        other = ideal(RING, four_bar.parallelogram(C, S))
        unmixed = whole.dimension == 2 and quotient(whole, (C[2] - C[0]).numerator) == found
        apart = not other.contains(found.basis) and (found.dimension, found.degree) == (2, 8)
        if not (unmixed and apart and other.dimension == 2 and _reduced_graph(a, b)):
            return decided(False, "", f"not for a = {a}, b = {b}")
    return decided(
        True,
        "J_1 = J : (c_2 - c_0), and J is a complete intersection; outside V(J_0) it is the graph "
        "(b - a) y = (a + b) x of half-angles of bars 1 and 3 against bar 0, where J has full "
        "rank; V(J_0) is two circles",
        "",
    )


def _reduced_graph(a: Any, b: Any) -> bool:
    """Whether J_1 vanishes on that graph, identically, and the equations have rank 6 on it."""
    field = FunctionField("x z")
    x, z = field.variables
    c, s = _graph(a, b, x, z, field(1))
    if any(four_bar.antiparallelogram(a, b, c, s)):
        return False
    one = Fraction(1)
    point = _graph(a, b, Fraction(2), Fraction(1, 3), one)
    zeros = [y for pair in zip(*point, strict=True) for y in pair]
    jacobian = []
    for f in four_bar.four_bar(a, b, C, S):
        derivatives = [f.numerator.derivative(i) for i in range(8)]
        values = dict(zip(four_bar.VARIABLES, zeros, strict=True))
        unit = RING(1).numerator
        jacobian.append([RationalFunction(RING, d, unit).at(values) for d in derivatives])
    return any(minors(jacobian, 6))


def _graph(a: Any, b: Any, x: Any, z: Any, one: Any) -> tuple[list[Any], list[Any]]:
    """Bars 0 to 3 where bar 0 has the half-angle z and bar 1 the half-angle x against it."""
    base, first = circle(z), circle(x)
    third = circle(x * Fraction(a + b) / (b - a))
    second = [
        (a * e - b * p + b * q) / a for e, p, q in zip((one, 0 * one), first, third, strict=True)
    ]
    bars = [(one, 0 * one), first, second, third]
    c = [base[0] * p - base[1] * q for p, q in bars]
    s = [base[0] * q + base[1] * p for p, q in bars]
    return c, s


@statement(
    "PT13 5.3, hat J_1", "for a = b, J is the intersection of hat J_0, hat J_1, hat J_2", True
)
def three_components() -> Verdict:
    whole = ideal(RING, four_bar.four_bar(1, 1, C, S))
    printed = ideal(RING, four_bar.folded_1(C, S, printed=True))
    mended = intersected([ideal(RING, g) for g in four_bar.rhombus(C, S)])
    if printed.contains(whole.basis) or mended != whole:
        return decided(False, "", "the components are others")
    x, y = Fraction(3, 5), Fraction(4, 5)
    c, s = (Fraction(1), x, Fraction(-1), -x), (Fraction(0), y, Fraction(0), -y)
    if any(four_bar.folded_1(c, s, printed=True)):
        return decided(False, "", "the point is no zero of hat J_1")
    return fails(
        "true is hat J_1 = <q_0, q_1, s_3 + s_0, c_3 + c_0, s_2 + s_1, c_2 + c_1>; with it, J is "
        "the intersection, by Groebner bases",
        "(c_j) = (1, 3/5, -1, -3/5), (s_j) = (0, 4/5, 0, -4/5) is a zero of hat J_1 as printed, "
        f"and p_1/a is {four_bar.loop(1, 1, c, s)[0]} there",
    )


@statement("PT13 5.3", "for a = b, J is radical")
def rhombus_is_radical() -> Verdict:
    parts = [ideal(RING, g) for g in four_bar.rhombus(C, S)]
    prime = all((p.dimension, p.degree) == (2, 4) for p in parts)
    whole = ideal(RING, four_bar.four_bar(1, 1, C, S))
    return decided(
        prime and intersected(parts) == whole,
        "it is the intersection of the three, each two circles and linear equations",
        "it is not",
    )


@statement("PT13 5.3", "J_0 lies in both cases among the components")
def parallelogram_is_common() -> Verdict:
    part = ideal(RING, four_bar.parallelogram(C, S))
    sides = [*SIDES, (1, 1)]
    return decided(
        all(contains(part, four_bar.four_bar(a, b, C, S)) for a, b in sides),
        "division of the equations",
        "an equation leaves a remainder",
    )


STATEMENTS = (
    two_components,
    components_are_prime,
    three_components,
    rhombus_is_radical,
    parallelogram_is_common,
)
