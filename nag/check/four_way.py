"""A decomposition against the papers' prime components, four ways.

Numerically: witness points are zeros of the papers' generators. The other way round: the points of
a parametrisation satisfy the equations. Dimensions and degrees. Exactly: the equations reduce to
zero modulo the papers' generators.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import floor, log10
from typing import Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.groebner import Ideal, ideal
from nag.algebra.polynomial import Polynomial
from nag.algebra.rational_function import FunctionField
from nag.check.identities import labelled, surviving
from nag.check.known import KnownDecomposition, PaperComponent
from nag.check.statement import Statement, Verdict, VerdictKind, decided, holds
from nag.numerics.zero_values import ON
from nag.witness.witness import Decomposition, Status, WitnessSet

Decompose = Callable[[Any], Decomposition]

# Values in doubles vanish to sixteen digits at most.
ROUNDING = 1e-16


@dataclass(frozen=True)
class Compared:
    """A system, its components in the papers, and how to decompose it.

    Attributes:
        known: the papers' half.
        decompose: from a polynomial system to its numerical decomposition.
        coordinates: from points of that to the papers' coordinates.
    """

    known: KnownDecomposition
    decompose: Decompose
    coordinates: Callable[[np.ndarray], np.ndarray] = np.asarray

    @cached_property
    def field(self) -> FunctionField:
        """The ring of the system's variables, in degree order."""
        return FunctionField(self.known.variables, "degrevlex")

    @cached_property
    def equations(self) -> list[Any]:
        """The equations as functions."""
        return [f for f in self.known.equations(self.field.variables) if f]

    @cached_property
    def ideals(self) -> tuple[Ideal, ...]:
        """The components' ideals."""
        x = self.field.variables
        return tuple(
            ideal(self.field, [g for g in c.generators(x) if g]) for c in self.known.components
        )

    @cached_property
    def decomposition(self) -> Decomposition:
        """The numerical one."""
        from nag.algebra.system import PolynomialSystem

        polynomials = tuple(as_polynomial(f.numerator) for f in self.equations)
        return self.decompose(PolynomialSystem(self.known.variables, polynomials))

    @cached_property
    def matches(self) -> list[tuple[WitnessSet, list[int], float]]:
        """Each numerical component, the papers' components that vanish on it, largest residual."""
        found = []
        for component in self.decomposition.components:
            points = self.coordinates(component.points)
            residuals = [residual(part, points) for part in self.ideals]
            hits = [i for i, r in enumerate(residuals) if r < ON]
            found.append((component, hits, min(residuals, default=1.0)))
        return found


def as_polynomial(f: Any) -> Polynomial:
    """FLINT's polynomial as one of ours."""
    terms = {tuple(map(int, e)): int(c) for e, c in f.to_dict().items()}
    return Polynomial(len(f.context().names()), terms)


def evaluator(polynomials: Sequence[Any], n: int) -> Evaluator:
    """FLINT's polynomials for evaluation in doubles, coefficients of any size scaled to 1."""
    scaled = [as_polynomial(f) for f in polynomials]
    return Evaluator.of([f / max(map(abs, f.terms.values())) for f in scaled], n)


def residual(part: Ideal, points: np.ndarray) -> float:
    """Largest relative residual of an ideal's basis at points."""
    return float(evaluator(part.basis, points.shape[1]).residuals(points).max(initial=0.0))


def digits(value: float) -> int:
    """Decimal digits to which something vanishes, at most 16."""
    return 16 if value <= ROUNDING else floor(-log10(value))


def numerical(compared: Compared) -> Verdict:
    """Every witness point is a zero of exactly one component's generators."""
    answer = compared.decomposition
    if not answer.complete:
        return Verdict(VerdictKind.OPEN, "the decomposition is incomplete")
    hits = [found for _, found, _ in compared.matches]
    if sorted(hits) != [[i] for i in range(len(compared.ideals))]:
        text = f"{len(answer.components)} components found, on {hits} of the papers'"
        return Verdict(VerdictKind.FAILS, "components do not match one to one", text)
    worst = max(r for _, _, r in compared.matches)
    count = sum(len(c.points) for c in answer.components)
    return Verdict(
        VerdictKind.NUMERICAL,
        f"{count} witness points, each on one of {len(compared.ideals)}",
        digits=digits(worst),
    )


def converse(compared: Compared) -> Verdict:
    """The parametrised points satisfy the equations, identically."""
    for component in compared.known.components:
        kept = _not_vanishing(compared.known, component)
        if kept:
            return decided(False, "", f"{component.place}: {kept[0]}")
    names = {c.parametrisation.names for c in compared.known.components}
    return holds(f"identities in {', '.join(sorted(' '.join(names).split()))}")


def _not_vanishing(known: KnownDecomposition, component: PaperComponent) -> list[str]:
    given = component.parametrisation

    def residuals(*x: Any) -> dict[str, Any]:
        point = given.point(*x)
        equations = labelled("equation", known.equations(point))
        return equations | labelled("generator", component.generators(point))

    return surviving(given.names, residuals, given.roots)


def dimension_and_degree(compared: Compared) -> Verdict:
    """Of each component by its Groebner basis and by its witness set."""
    rows = []
    for component, hits, _ in compared.matches:
        here = (component.dimension, component.degree)
        there = [(compared.ideals[i].dimension, compared.ideals[i].degree) for i in hits]
        if component.status is not Status.IRREDUCIBLE:
            return Verdict(VerdictKind.OPEN, component.note or "a component is undecided")
        if there != [here]:
            return decided(False, "", f"{here} found, {there} by Groebner bases")
        rows.append(here)
    text = ", ".join(
        f"{rows.count(row)} of dimension {row[0]}, degree {row[1]}" for row in sorted(set(rows))
    )
    how = f"{text}: witness sets with a trace test, and Groebner bases by FLINT"
    return Verdict(VerdictKind.NUMERICAL, how)


def reduction(compared: Compared) -> Verdict:
    """The equations reduce to zero modulo every component."""
    equations = [f.numerator for f in compared.equations]
    for part, component in zip(compared.ideals, compared.known.components, strict=True):
        if not part.contains(equations):
            return decided(False, "", f"{component.place}: an equation leaves a remainder")
    bases = "one basis" if len(compared.ideals) == 1 else f"{len(compared.ideals)} bases"
    return holds(f"division: {len(equations)} equations, {bases} by FLINT from the generators")


WAYS = (
    ("witness points are zeros of the papers' generators", numerical),
    ("parametrised points satisfy the equations", converse),
    ("dimension and degree agree", dimension_and_degree),
    ("the equations reduce to 0 modulo the papers' generators", reduction),
)


def four_ways(
    known: KnownDecomposition,
    decompose: Decompose,
    coordinates: Callable[[np.ndarray], np.ndarray] = np.asarray,
) -> tuple[Statement, ...]:
    """The four statements about one system."""
    compared = Compared(known, decompose, coordinates)
    return tuple(Statement(known.name, text, lambda way=way: way(compared)) for text, way in WAYS)
