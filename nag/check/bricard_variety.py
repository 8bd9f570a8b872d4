"""T25 section 4 and PT13 5.5: Bricard's variety.

That a zero set is irreducible over the complex numbers is proved by one plane section of it.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from typing import Any

import flint
import numpy as np

from nag.algebra.factoring import is_absolutely_irreducible
from nag.algebra.groebner import Ideal, ideal
from nag.algebra.polynomial import Polynomial
from nag.algebra.rational_function import FunctionField
from nag.check.identities import Residuals, labelled, surviving
from nag.check.loops import bricard_equations, bricard_mechanism, bricard_ring
from nag.check.rings import contains, smooth
from nag.check.statement import Verdict, VerdictKind, decided, fails, statement
from nag.mechanism.axes import difference, dot
from nag.mechanism.loops import gruebler_kutzbach
from nag.mechanism.quaternion import rotate
from nag.symbolic import bricard


def certainly_irreducible(whole: Ideal, seed: int = 0) -> bool:
    """Whether the components of highest dimension are one, of multiplicity 1.

    The zero set is cut with random rational hyperplanes to a curve of the same degree, and that is
    projected to a plane, again to the same degree. Were there two components, there would be two
    images, of smaller degree each.

    Args:
        whole: of dimension 1 or more, in an order that compares degrees first.
        seed: of the random hyperplanes; an unlucky one gives False, none gives a wrong True.

    Raises:
        UnfinishedBasis: if a Groebner basis grows too large.
    """
    rng = np.random.default_rng(seed)
    names = whole.field.names
    field = FunctionField((*names, "s'", "t'"), "lex")
    *x, s, t = field.variables
    lifted = [_lift(f, field) for f in whole.basis]
    cuts = [_linear(rng, x) for _ in range(whole.dimension - 1)]
    images = [s - _linear(rng, x), t - _linear(rng, x)]
    curve = whole.enlarged(_restricted(f.numerator, whole.field) for f in cuts)
    if (curve.dimension, curve.degree) != (1, whole.degree):
        return False
    found = ideal(field, [*lifted, *cuts, *images])
    kept = [g for g in found.basis if not any(any(e[: len(names)]) for e in g.to_dict())]
    if len(kept) != 1:
        return False
    factors = kept[0].factor()[1]
    if len(factors) != 1 or int(factors[0][1]) != 1:
        return False
    terms = {tuple(map(int, e[-2:])): int(c) for e, c in factors[0][0].to_dict().items()}
    plane = Polynomial(2, terms)
    return plane.degree == whole.degree and is_absolutely_irreducible(plane, rng)


def _linear(rng: np.random.Generator, x: list[Any]) -> Any:
    constant, *slopes = (int(k) for k in rng.integers(-9, 10, len(x) + 1))
    return sum((k * y for k, y in zip(slopes, x, strict=True)), constant + 0 * x[0])


def _lift(f: Any, field: FunctionField) -> Any:
    return field.context.from_dict({(*map(int, e), 0, 0): c for e, c in f.to_dict().items()})


def _restricted(f: Any, field: FunctionField) -> Any:
    n = len(field.names)
    return field.context.from_dict({tuple(map(int, e))[:n]: c for e, c in f.to_dict().items()})


RING, BODIES = bricard_ring()
ESSENTIAL = FunctionField("c2 a2 a0", "degrevlex")


def variety() -> Ideal:
    """I_bric."""
    c2, a2, a0 = ESSENTIAL.variables
    return ideal(ESSENTIAL, bricard.variety(a0, a2, c2))


def component() -> Ideal:
    """The ideal of h_0 to h_18."""
    return ideal(RING, bricard.basis(BODIES))


def _signed(signs: tuple[int, ...]) -> list[tuple[Any, ...]]:
    return [tuple(s * x for x in q) for s, q in zip(signs, bricard.ORIENTATIONS, strict=True)]


@statement("T25 section 4", "the constraints of all joints and the loop lie in <h_0, .., h_18>")
def equations_reduce() -> Verdict:
    return decided(
        contains(component(), bricard_equations(BODIES)),
        "division of the mechanism's equations by the basis",
        "an equation leaves a remainder",
    )


@statement("T25 section 4, basis of I", "they generate <h_0, .., h_18>", True)
def basis_of_the_mechanism() -> Verdict:
    """The equations do not change with the sign of b, and 2 b_0 - 1 does."""
    signs = (1, -1, 1, 1, 1)
    point = _signed(signs)
    values = bricard_equations(point)
    if any(values):
        return Verdict(VerdictKind.OPEN, "the point does not satisfy the equations")
    whole = ideal(RING, bricard_equations(BODIES))
    part = component()
    copies = 2**5 // _stabiliser(part)
    if (whole.dimension, whole.degree) != (1, copies * part.degree):
        return Verdict(VerdictKind.OPEN, "the degrees of the components do not add up")
    return fails(
        f"true is: <h_0, .., h_18> is one of {copies} prime components, images of each other by "
        f"signs of bodies: degrees {copies} x {part.degree} = {whole.degree}, Groebner basis by "
        "FLINT",
        "the initial position with -b_init for b_init satisfies all constraints, and "
        f"h_7 = 2 b_0 - 1 is {bricard.basis(point)[7]} there",
    )


def _stabiliser(part: Ideal) -> int:
    """How many changes of the bodies' signs keep the ideal."""
    count = 0
    for signs in product((1, -1), repeat=5):
        image = [tuple(s * x for x in q) for s, q in zip(signs, BODIES, strict=True)]
        count += contains(part, bricard.basis(image))
    return count


@statement("T25 section 4", "h_0 to h_18 are a Groebner basis, and I_bric its elimination ideal")
def groebner_basis() -> Verdict:
    """Lexicographic with c2 > a2 > a0 last: leading monomials without common variables."""
    rest = [f"{x}{i}" for x in "abcde" for i in range(4)]
    names = [x for x in rest if x not in ("c2", "a2", "a0")]
    field = FunctionField([*names, "c2", "a2", "a0"])
    by_name = dict(zip(field.names, field.variables, strict=True))
    bodies = [tuple(by_name[f"{x}{i}"] for i in range(4)) for x in "abcde"]
    h = bricard.basis(bodies)
    groebner = flint.fmpz_mpoly_vec([f.numerator for f in h], field.context).is_groebner()
    last = [f for f in h if not any(any(e[: len(names)]) for e in f.numerator.to_dict())]
    return decided(
        groebner and last == h[:2] and len(h) == 19,
        "Buchberger's criterion; h_0 and h_1 are those in a0, a2, c2 alone",
        "it is not",
    )


@statement("T25 section 4", "V(I_init) lies in V(<h_0, .., h_18>)")
def initial_point() -> Verdict:
    values = bricard.basis(bricard.ORIENTATIONS)
    return decided(not any(values), "exact numbers", f"values {values}")


@statement("T25 section 4", "V(I_bric) is regular; PT13 7.2: V(I_17) is smooth")
def regular() -> Verdict:
    c2, a2, a0 = ESSENTIAL.variables
    generators = bricard.variety(a0, a2, c2)
    return decided(
        smooth(ESSENTIAL, generators, 2) and variety().dimension == 1,
        "the 2-minors of the Jacobian and the generators have no common zero, by FLINT; a "
        "complete intersection",
        "there are singular points",
    )


@statement("T25 section 4", "I_bric is prime; PT13 5.5: I_17 is prime")
def irreducible() -> Verdict:
    """A smooth complete intersection is reduced, so irreducible is enough."""
    return decided(
        variety().degree == 8 and certainly_irreducible(variety()),
        "a plane projection of degree 8 is absolutely irreducible, by Gao's theorem; reduced, "
        "because smooth",
        "it splits",
    )


@statement("PT13 5.5, basis of I", "V(I) is V(I_17), and I is prime", True)
def prime_ideal_of_the_mechanism() -> Verdict:
    found = basis_of_the_mechanism.verdict()
    return Verdict(found.kind, found.how, found.counterexample)


@statement("PT13 (14)", "I_17 is I_bric, with x = a0, z = c2 and y = -a2")
def equation_14() -> Verdict:
    c2, a2, a0 = ESSENTIAL.variables
    printed = ideal(ESSENTIAL, bricard.variety_14(a0, -a2, c2))
    return decided(printed == variety(), "equal generators", "other ideals")


@statement("PT13 5.5", "V(I_17) is symmetric with respect to the origin")
def symmetric() -> Verdict:
    c2, a2, a0 = ESSENTIAL.variables
    same = bricard.variety(-a0, -a2, -c2) == bricard.variety(a0, a2, c2)
    return decided(same, "identity in a0, a2, c2", "it is not")


@statement("T25 section 4", "V(I_bric) has two real components, one physical situation")
def two_real_components() -> Verdict:
    """c2 - a2 is +-sqrt(8 a0^2 - 1)/(4 a0): real for a0^2 >= 1/8, two arcs of the circle."""
    c2, a2, a0 = ESSENTIAL.variables
    relation = 16 * a0**2 * (c2 - a2) ** 2 - (8 * a0**2 - 1)
    roots = contains(variety(), [relation])
    # The ends of the arcs, where both values agree, are four simple real points.
    ends = ideal(ESSENTIAL, [8 * a0**2 - 1, 2 * a2**2 + 2 * a0**2 - 1, c2 - a2])
    simple = (ends.dimension, ends.degree) == (0, 4) and contains(ends, [8 * a2**2 - 3])
    # The sign change takes a, c, e to their negatives and leaves b and d.
    moved = zip(
        bricard.essential_to_all(-a0, -a2, -c2),
        bricard.essential_to_all(a0, a2, c2),
        (-1, 1, -1, 1, -1),
        strict=True,
    )
    same = all(tuple(s * x for x in q) == p for p, q, s in moved)
    return decided(
        roots and simple and same,
        "c2 = a2 +- sqrt(8 a0^2 - 1)/(4 a0) over the arcs a0 >= sqrt(1/8), a0 <= -sqrt(1/8) of "
        "the circle, which close up at their ends; point and negative are the same orientations",
        "the arcs are others",
    )


@statement("T25 (10)", "it maps V(I_bric) to V(I)")
def map_10() -> Verdict:
    c2, a2, a0 = ESSENTIAL.variables
    bodies = bricard.essential_to_all(a0, a2, c2)
    whole = variety()
    true = contains(whole, bricard.basis(bodies)) and contains(whole, bricard_equations(bodies))
    poles = whole.enlarged([a0]).whole
    return decided(
        true and poles,
        "h_0 to h_18 and the mechanism's equations reduce to 0; a0 is never 0",
        "an equation leaves a remainder",
    )


ROOTS = (
    ("root", lambda cos, *_: 4 * cos**2 - 1),
    ("sin", lambda cos, *_: 1 - cos**2),
    ("root2", lambda *_: 2),
)


@statement("T25 section 4", "the parametrisation lies on V(I_bric), and gives all of it")
def parametrisation() -> Verdict:
    """Every point of the circle occurs, and both roots over it."""

    def formula(cos: Any, root: Any, sin: Any, root2: Any) -> Residuals:
        a0, a2, c2 = bricard.parametrisation(cos, sin, root2, root)
        h0, h1 = bricard.variety(a0, a2, c2)
        product = (c2 - a2) ** 2 * 16 * a0**2 - (8 * a0**2 - 1)
        return {"h_0": h0, "h_1": h1, "root": product}

    kept = surviving("cos", formula, ROOTS)
    return decided(not kept, "identity in cos with sin and the roots adjoined", f"{kept} not 0")


@statement("T25 section 4", "one component is -pi/3 <= t <= pi/3, the other 2 pi/3 <= t <= 4 pi/3")
def intervals() -> Verdict:
    """4 cos^2 - 1 >= 0 there: cos(pi/3) = 1/2."""
    ends = [4 * x**2 - 1 for x in (Fraction(1, 2), Fraction(-1, 2))]
    inside = [4 * x**2 - 1 for x in (Fraction(1), Fraction(-1), Fraction(0))]
    true = not any(ends) and inside[0] > 0 and inside[1] > 0 > inside[2]
    return decided(true, "4 cos^2 t - 1 changes its sign at cos t = +-1/2 alone", "elsewhere")


@statement("PT13 figure 5", "the mechanism becomes an equilateral triangle at a point of the curve")
def triangle() -> Verdict:
    """At t = 0 joints 0, 2, 4 are 2 apart, and the others halve the sides."""

    def formula(root3: Any, root2: Any) -> Residuals:
        one = root3 / root3
        essential = bricard.parametrisation(one, 0 * one, root2, root3)
        bodies = bricard.essential_to_all(*essential)
        places = [[x * one for x in bricard.POINTS[0]], [x * one for x in bricard.POINTS[1]]]
        for q in bodies[:-1]:
            places.append([x + y for x, y in zip(places[-1], rotate(q, (1, 0, 0)), strict=True)])
        found = {}
        for i in (0, 2, 4):
            k, middle = (i + 2) % 6, i + 1
            side = difference(places[k], places[i])
            found[f"side {i}"] = dot(side, side) - 4
            half = [
                2 * x - y - z for x, y, z in zip(places[middle], places[i], places[k], strict=True)
            ]
            found |= labelled(f"middle {middle}", half)
        return found

    constants = (("root3", lambda: 3), ("root2", lambda: 2))
    kept = surviving("", formula, constants)
    return decided(
        not kept,
        "at t = 0, exactly in Q(sqrt 2, sqrt 3)",
        f"{kept} not 0",
    )


@statement(
    "PT13 5.5",
    "the components of dimension 1 that the cube lies on do not meet those of dimension 2",
)
def dimensions_do_not_meet() -> Verdict:
    """A half turn of a link about itself reverses two neighbouring axes (condition H)."""
    even = ideal(RING, bricard_equations(BODIES))
    odd = ideal(RING, bricard_equations(BODIES, (-1, 1, 1, 1, 1, 1)))
    return decided(
        (even.dimension, odd.dimension) == (1, 2),
        "with an even number of axes reversed the dimension is 1, with an odd number 2, by "
        "Groebner bases; all of a kind are images of one, and reversed axes never meet (T25 (8))",
        f"dimensions {even.dimension}, {odd.dimension}",
    )


@statement("T25 section 7", "V(I_bric) is a complete intersection; the formula of counting gives 0")
def overconstrained() -> Verdict:
    counted = gruebler_kutzbach(bricard_mechanism())
    return decided(
        (variety().dimension, counted) == (1, 0),
        "two generators in three variables, dimension 1; Gruebler-Kutzbach counts 0",
        f"dimension {variety().dimension}, counted {counted}",
    )


STATEMENTS = (
    equations_reduce,
    basis_of_the_mechanism,
    groebner_basis,
    initial_point,
    regular,
    irreducible,
    prime_ideal_of_the_mechanism,
    equation_14,
    symmetric,
    two_real_components,
    map_10,
    parametrisation,
    intervals,
    triangle,
    dimensions_do_not_meet,
    overconstrained,
)
