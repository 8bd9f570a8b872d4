"""Components of systems that fall apart by their variables: products of those of the parts.

A product of sets that are irreducible over the complex numbers is irreducible, of the sum of the
dimensions and the product of the degrees. Mechanisms whose loops hang together in single bodies are
such.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import reduce
from itertools import product
from math import prod

from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.decomposition.final_checks import choose_groups, judge_components, multidegree_of
from nag.decomposition.method import Attempt, Others, Task
from nag.numerics.system_facts import SystemFacts
from nag.witness.frame import image
from nag.witness.product import multiply_components
from nag.witness.witness import PathCounts, WitnessSet

# Products beyond this number, or with more witness points in all, are not written out.
MOST_PRODUCTS = 4096
MOST_POINTS = 200_000


def decompose_parts(task: Task, others: Others) -> Attempt:
    """The components of a system that falls apart by its variables: products, without paths.

    None where there are too many products, or a symmetry exchanges parts.
    """
    system, symmetries = task.system, task.symmetries
    parts = independent_variables(system)
    if any(f and not f.support for f in system.polynomials) or not all(system.nonzero):
        # A number that is not zero, or a condition that nothing fulfils, is in no part.
        return Attempt(judge_components(system, [], PathCounts(), task.run))
    if len(parts) < 2 or not all(_stays(g, parts) for g in symmetries):
        return Attempt()
    if not all(any(set(group) <= set(part) for part in parts) for group in system.groups):
        # How many of a group's variables are fixed in which part is not known.
        return Attempt()
    answers = [
        others(
            replace(
                task,
                facts=SystemFacts(restrict_to_part(system, part)),
                symmetries=tuple(_restrict_symmetries(symmetries, part)),
                found=None,
            )
        )
        for part in parts
    ]
    counts = [len(a.components) for a in answers]
    points = prod(sum(c.degree for c in a.components) for a in answers)
    if prod(counts) > MOST_PRODUCTS or points > MOST_POINTS:
        return Attempt()
    found = []
    for chosen in product(*(a.components for a in answers)):
        whole = reduce(multiply_components, chosen)
        whole = _with_multidegree(whole, chosen, parts, system.groups)
        found.append(put_in_order(whole, parts))
    found.sort(key=lambda c: (-c.dimension, c.degree))
    paths = sum((a.paths for a in answers), PathCounts())
    notes = [note for a in answers for note in a.notes]
    answer = judge_components(system, found, paths, task.run, notes)
    return Attempt(replace(answer, algebraic=all(a.algebraic for a in answers)))


def put_in_order(component: WitnessSet, parts: Sequence[Sequence[int]]) -> WitnessSet:
    """A product of sets, each in some of the variables, with the variables in their order."""
    places = tuple(i for part in parts for i in part)
    order = SignedPermutation(places, (1,) * len(places)).inverse
    images = tuple(order.after(g).after(order.inverse) for g in component.images)
    moved = image(component, order)
    return replace(moved, orbit=component.orbit, images=images)


def _with_multidegree(
    whole: WitnessSet,
    factors: Sequence[WitnessSet],
    parts: Sequence[Sequence[int]],
    groups: Sequence[Sequence[int]],
) -> WitnessSet:
    """A product with its multidegree: so many groups are fixed of each part as its dimension.

    Args:
        groups: those of the system, each of variables of one part alone.
    """
    choices = choose_groups(groups, whole.dimension)
    owners = [[k for k, part in enumerate(parts) if set(group) <= set(part)] for group in groups]
    if choices is None or any(c.multidegree is None for c in factors):
        return whole
    # The place of each group among those of its part.
    own = [owner for (owner,) in owners]
    places = [own[:g].count(owner) for g, owner in enumerate(own)]
    degrees = {}
    for choice in choices:
        split = [[places[g] for g in choice if own[g] == k] for k in range(len(parts))]
        if [len(each) for each in split] != [c.dimension for c in factors]:
            degrees[choice] = 0
            continue
        values = (c.multidegree[tuple(at)] for c, at in zip(factors, split, strict=True))
        degrees[choice] = prod(map(int, values))
    return replace(whole, multidegree=multidegree_of(degrees, len(groups), whole.dimension))


def independent_variables(system: PolynomialSystem) -> list[tuple[int, ...]]:
    """The variables, those that occur together in a polynomial together."""
    label = list(range(system.n))
    for f in (*system.polynomials, *system.nonzero):
        support = sorted(f.support)
        names = {label[i] for i in support}
        label = [min(names) if k in names else k for k in label]
    return [tuple(i for i, k in enumerate(label) if k == name) for name in sorted(set(label))]


def restrict_to_part(system: PolynomialSystem, part: Sequence[int]) -> PolynomialSystem:
    """The equations in some variables, of which each has all of its own or none.

    Equations without variables are left out.
    """
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
