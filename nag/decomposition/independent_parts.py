"""Components of systems that fall apart by their variables: products of those of the parts.

A product of sets that are irreducible over the complex numbers is irreducible, of the sum of the
dimensions and the product of the degrees. Mechanisms whose loops hang together in single bodies are
such.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from math import prod

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.decomposition.method import Attempt, Others, Task
from nag.witness.witness import PathCounts

# Products beyond this number, or with more witness points, are not worked out one by one.
MOST_PRODUCTS = 64
MOST_POINTS = 1000


def decompose_parts(task: Task, others: Others) -> Attempt:
    """The components of a system that falls apart by its variables.

    None where there are too many products, or a symmetry exchanges parts.
    """
    system, symmetries = task.system, task.symmetries
    parts = independent_variables(system)
    if len(parts) < 2 or not all(_stays(g, parts) for g in symmetries):
        return Attempt()
    answers = [
        others(task.of_part(_part(system, part), _restrict_symmetries(symmetries, part)))
        for part in parts
    ]
    if not all(a.complete for a in answers):
        return Attempt()
    choices = list(product(*(a.components for a in answers)))
    points = [prod(c.degree for c in chosen) for chosen in choices]
    if len(choices) > MOST_PRODUCTS or max(points, default=0) > MOST_POINTS:
        return Attempt()
    from nag.decomposition.given_points import components_through_points

    starts = []
    for chosen in choices:
        x = np.zeros(system.n, dtype=complex)
        for part, component in zip(parts, chosen, strict=True):
            x[list(part)] = component.points[0]
        starts.append((sum(c.dimension for c in chosen), x))
    answer = components_through_points(
        system,
        starts,
        run=task.run,
        symmetries=symmetries,
    )
    wanted = [
        (sum(c.dimension for c in chosen), k) for chosen, k in zip(choices, points, strict=False)
    ]
    if sorted(wanted) != sorted((c.dimension, c.degree) for c in answer.components):
        return Attempt()
    return Attempt(answer, sum((a.paths for a in answers), PathCounts()))


def independent_variables(system: PolynomialSystem) -> list[tuple[int, ...]]:
    """The variables, those that occur together in a polynomial together."""
    label = list(range(system.n))
    for f in (*system.polynomials, *system.nonzero):
        support = sorted(f.support)
        names = {label[i] for i in support}
        label = [min(names) if k in names else k for k in label]
    return [tuple(i for i, k in enumerate(label) if k == name) for name in sorted(set(label))]


def _part(system: PolynomialSystem, part: Sequence[int]) -> PolynomialSystem:
    position = {i: k for k, i in enumerate(part)}

    def restrict(polynomials: Sequence[Polynomial]) -> tuple[Polynomial, ...]:
        return tuple(
            Polynomial(len(part), {tuple(e[i] for i in part): c for e, c in f.terms.items()})
            for f in polynomials
            if f.support and f.support <= position.keys()
        )

    groups = [tuple(position[i] for i in g if i in position) for g in system.groups]
    return PolynomialSystem(
        tuple(system.variables[i] for i in part),
        restrict(system.polynomials),
        restrict(system.nonzero),
        tuple(g for g in groups if g),
    )


def _stays(g: SignedPermutation, parts: Sequence[tuple[int, ...]]) -> bool:
    """Whether a symmetry moves the variables of one part only, among themselves."""
    moved = {i for i, (k, s) in enumerate(zip(g.sources, g.signs, strict=True)) if k != i or s < 0}
    return any(moved <= set(part) for part in parts)


def _restrict_symmetries(
    symmetries: Sequence[SignedPermutation], part: Sequence[int]
) -> list[SignedPermutation]:
    position = {i: k for k, i in enumerate(part)}
    found = [
        SignedPermutation(
            tuple(position[g.sources[i]] for i in part), tuple(g.signs[i] for i in part)
        )
        for g in symmetries
    ]
    return [g for g in dict.fromkeys(found) if not g.is_identity]
