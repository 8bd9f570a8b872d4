"""The mechanisms of T25: their decomposition in half-angles against the papers' components."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.groebner import Ideal, clear_denominators, ideal
from nag.algebra.number import square_root
from nag.algebra.rational_function import FunctionField
from nag.algebra.system import PolynomialSystem
from nag.check.bennett_special import ROOTS as SPECIAL_ROOTS
from nag.check.four_way import WAYS, Decompose, digits, evaluator
from nag.check.identities import labelled, surviving
from nag.check.known import Parametrisation, parameter_text
from nag.check.known_space import BRICARD_ROOTS, bennett_roots
from nag.check.loops import (
    bennett_equations,
    bennett_mechanism,
    bricard_equations,
    bricard_mechanism,
)
from nag.check.rings import euler_ring
from nag.check.statement import Statement, Verdict, VerdictKind, decided
from nag.mechanism.axes import difference, dot
from nag.mechanism.graph import Mechanism
from nag.mechanism.model import Model, model
from nag.numerics.zero_values import ON
from nag.symbolic import bennett, bennett_geometry, bricard
from nag.witness.witness import Decomposition, Status

Bodies = Sequence[Sequence[Any]]
Parameters = tuple[Fraction, Fraction, Fraction]


@dataclass(frozen=True)
class KnownMechanism:
    """A mechanism and the prime component that the paper finds its configurations on.

    Attributes:
        name: what it is.
        mechanism: in its reference configuration.
        generators: from the bodies' Euler parameters to the component's generators.
        equations: to the mechanism's own.
        parametrisation: of the component, to the bodies' Euler parameters.
    """

    name: str
    mechanism: Mechanism
    generators: Callable[[Bodies], list[Any]]
    equations: Callable[[Bodies], list[Any]]
    parametrisation: Parametrisation


def known_bricard() -> KnownMechanism:
    """T25 section 4."""

    def point(cos: Any, root: Any, sin: Any, root2: Any) -> Bodies:
        return bricard.essential_to_all(*bricard.parametrisation(cos, sin, root2, root))

    return KnownMechanism(
        "Bricard's mechanism",
        bricard_mechanism(),
        bricard.basis,
        bricard_equations,
        Parametrisation("cos", point, BRICARD_ROOTS),
    )


def known_bennett(m: Sequence[Fraction]) -> KnownMechanism:
    """T25 section 6, for parameters in Omega_0; q_5 may vanish."""
    m = tuple(m)
    special = bennett_geometry.abbreviations(m)["q5"] == 0
    outer = (m[0], m[2])

    def point(cos: Any, root6: Any, root1: Any, sin: Any) -> Bodies:
        essential = bennett.parametrisation(m, cos, sin, root1, root6)
        return bennett.essential_to_all(m, *essential)

    def point_without_q5(cos: Any, root6: Any, sin: Any) -> Bodies:
        essential = bennett.parametrisation_q5_zero(outer, cos, sin, root6)
        return bennett.essential_to_all_q5_zero(outer, *essential)

    def generators(bodies: Bodies) -> list[Any]:
        a, b, c = bodies
        if special:
            essential = a[0], a[3], c[0], c[2]
            ideal_, image = (
                bennett.variety_q5_zero(outer, *essential),
                bennett.essential_to_all_q5_zero(outer, *essential),
            )
        else:
            essential = a[0], a[2], c[0], c[2]
            ideal_, image = (
                bennett.variety(m, *essential),
                bennett.essential_to_all(m, *essential),
            )
        pairs = zip((a, b, c), image, strict=True)
        graph = [x - y for p, q in pairs for x, y in zip(p, q, strict=True)]
        return [*ideal_, *(f for f in graph if f)]

    roots = tuple(
        (name, lambda cos, square=square: square(cos, *outer)) for name, square in SPECIAL_ROOTS
    )
    given = (
        Parametrisation("cos", point_without_q5, roots)
        if special
        else Parametrisation("cos", point, bennett_roots(m))
    )
    text = parameter_text(", ".join(map(str, m)))
    return KnownMechanism(
        f"Bennett's mechanism, m = ({text})",
        bennett_mechanism(m),
        generators,
        lambda bodies: bennett_equations(m, bodies),
        given,
    )


@dataclass(frozen=True)
class ComparedMechanism:
    """A mechanism, its component in the paper, and how to decompose it."""

    known: KnownMechanism
    decompose: Decompose

    @cached_property
    def model(self) -> Model:
        """Half-angles."""
        return model(self.known.mechanism, "H")

    @cached_property
    def decomposition(self) -> Decomposition:
        """In half-angles."""
        return self.decompose(self.model.system)

    @cached_property
    def ideal(self) -> Ideal:
        """The component in all Euler parameters."""
        field, bodies = self._ring
        return ideal(field, self.known.generators(bodies))

    @cached_property
    def _ring(self) -> tuple[FunctionField, list[tuple[Any, ...]]]:
        return euler_ring("abcdefgh"[: len(self.model.structure.moving)])

    @cached_property
    def generators(self) -> Evaluator:
        """The generators as printed, to be evaluated in doubles."""
        field, bodies = self._ring
        return evaluator([g.numerator for g in self.known.generators(bodies)], len(field.names))

    def residual(self, point: np.ndarray) -> float:
        """Relative residual of the generators at a lifted point, the bodies' signs chosen best."""
        euler = self.model.lift(list(point)).euler
        bodies = [np.array(euler[b], dtype=complex) for b in self.model.structure.moving]
        signs = np.array(list(product((1, -1), repeat=len(bodies))))
        points = np.stack(bodies)[None] * signs[:, :, None]
        residuals = self.generators.residuals(points.reshape(len(signs), -1))
        return float(residuals.max(axis=1).min())


def numerical(compared: ComparedMechanism) -> Verdict:
    """Every witness point lifts to a zero of the generators."""
    answer = compared.decomposition
    if not answer.complete:
        return Verdict(VerdictKind.OPEN, "the decomposition is incomplete")
    points = [p for c in answer.components for p in c.points]
    worst = max((compared.residual(p) for p in points), default=1.0)
    if worst > ON:
        return decided(False, "", f"a witness point leaves a residual of {worst:.1e}")
    how = f"{len(points)} witness points in half-angles, lifted, up to the signs of bodies"
    return Verdict(VerdictKind.NUMERICAL, how, digits=digits(worst))


def converse(compared: ComparedMechanism) -> Verdict:
    """Parametrised points satisfy the mechanism's equations."""
    known = compared.known
    given = known.parametrisation

    def residuals(*x: Any) -> dict[str, Any]:
        bodies = given.point(*x)
        return labelled("equation", known.equations(bodies)) | labelled(
            "generator", known.generators(bodies)
        )

    kept = surviving(given.names, residuals, given.roots)
    return decided(not kept, "identity in cos t, with sin t and roots adjoined", f"{kept} not 0")


def dimension_and_degree(compared: ComparedMechanism) -> Verdict:
    """Dimension of the component and of the witness set; degrees in half-angles."""
    answer, part = compared.decomposition, compared.ideal
    undecided = [c for c in answer.components if c.status is not Status.IRREDUCIBLE]
    if undecided:
        return Verdict(VerdictKind.OPEN, undecided[0].note or "a component is undecided")
    found = [(c.dimension, c.degree) for c in answer.components]
    exact = degree_in_half_angles(compared.model.system)
    here, wanted = sum(d for _, d in found), {(part.dimension, exact)}
    if {(dim, here) for dim, _ in found} != wanted or len(found) != 1:
        return decided(False, "", f"{found} found, {sorted(wanted)} by Groebner bases")
    return Verdict(
        VerdictKind.NUMERICAL,
        f"dimension {part.dimension} in both; degree {exact} in half-angles, by a trace test and "
        f"by a Groebner basis; degree {part.degree} in Euler parameters",
    )


def degree_in_half_angles(system: PolynomialSystem, seed: int = 1) -> int:
    """Degree of the curve of a system, what lies in the zeros of `nonzero` taken off.

    Exact: a Groebner basis of the equations and a rational hyperplane.
    """
    k = len(system.nonzero)
    field = FunctionField((*[f"inverse{i}" for i in range(k)], *system.variables), "degrevlex")
    base = FunctionField(system.variables, "degrevlex")

    def raised(f: Any) -> Any:
        terms = clear_denominators(f, base).to_dict().items()
        return field.context.from_dict({(*[0] * k, *map(int, e)): c for e, c in terms})

    inverses = field.context.gens()[:k]
    inverted = [u * raised(f) - 1 for u, f in zip(inverses, system.nonzero, strict=True)]
    slopes = np.random.default_rng(seed).integers(10, 99, system.n + 1).tolist()
    x = field.context.gens()[k:]
    cut = sum((c * y for c, y in zip(slopes, x, strict=False)), 0 * x[0]) + slopes[-1]
    curve = ideal(field, [*map(raised, system.polynomials), *inverted])
    return curve.enlarged([cut]).degree


def reduction(compared: ComparedMechanism) -> Verdict:
    """The mechanism's equations reduce to zero modulo the component."""
    _, bodies = compared._ring
    equations = [f.numerator for f in compared.known.equations(bodies)]
    true = compared.ideal.contains(equations)
    how = f"division: {len(equations)} equations, one basis by FLINT from the paper's generators"
    return decided(true, how, "an equation leaves a remainder")


def four_ways(known: KnownMechanism, decompose: Decompose) -> tuple[Statement, ...]:
    """The four statements about one mechanism."""
    compared = ComparedMechanism(known, decompose)
    ways = (numerical, converse, dimension_and_degree, reduction)
    return tuple(
        Statement(known.name, text, lambda way=way: way(compared))
        for (text, _), way in zip(WAYS, ways, strict=True)
    )


def bennett_parameters(mechanism: Mechanism) -> Iterator[Parameters]:
    """Rational m_0, m_1, m_2 that a loop placed as in lemma 5.1 can only have, for r and for -r.

    Whether it is the mechanism of these is left to be seen: not all it holds is looked at.
    """
    if len(mechanism.joints) != 4 or {joint.type for joint in mechanism.joints} != {"revolute"}:
        return
    first, second, third, fourth = (joint.point for joint in mechanism.joints)
    axis = mechanism.joints[1].axis
    if not _rational(*first, *second, *third, *fourth, *axis) or any(axis[:1]):
        return
    length = square_root(dot(axis, axis))
    x, _, z = difference(third, second)
    r = square_root(dot(difference(third, second), difference(third, second)))
    if not _rational(length, r) or not (r and z and axis[1]):
        return
    # (m_0^2 - 1)/(m_0^2 + 1) and -2 m_0/(m_0^2 + 1) are the axis, and likewise for the others.
    m0 = -axis[1] / (length - axis[2])
    for radius in (r, -r):
        if x == radius or radius + fourth[0] == 0:
            continue
        m1 = z * (m0**2 + 1) / (2 * m0 * (radius - x))
        m2 = m1 * fourth[1] / (radius + fourth[0])
        yield m0, m1, m2


def _rational(*numbers: Any) -> bool:
    return all(isinstance(x, Fraction) for x in numbers)
