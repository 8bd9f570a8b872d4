"""Numerical irreducible decomposition of the zero set of a polynomial system.

Where equations share no variables, components are products: one of irreducible sets is irreducible
over the complex numbers, of the sum of the dimensions and the product of the degrees. Mechanisms
whose loops hang together in single bodies are such.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product
from math import prod

import numpy as np

from nag.algebra.given import check_listed, check_running
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation, check_symmetry
from nag.algebra.system import PolynomialSystem
from nag.decomposition.branch_components import decompose_apart
from nag.decomposition.one_equation import decompose_one_equation
from nag.decomposition.rational_curve import decompose_rational_curve
from nag.decomposition.reduction import Reduction
from nag.witness.fibres import Progress, Tracker
from nag.witness.given_component import check_system
from nag.witness.witness import Decomposition, PathCounts

# Products beyond this number, or with more witness points, are not worked out one by one.
MOST_PRODUCTS = 64
MOST_POINTS = 1000
Decompose = Callable[[PolynomialSystem, Sequence[SignedPermutation]], Decomposition]


@np.errstate(over="ignore", invalid="ignore")
def decompose(
    system: PolynomialSystem,
    *,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
    progress: Progress | None = None,
    symmetries: Sequence[SignedPermutation] = (),
) -> Decomposition:
    """Decompose the zero set of ``system`` into irreducible components over the complex numbers.

    Equations that share no variables are decomposed apart, and their components multiplied. Where
    equations factor over the rationals, the parts that the system falls into are decomposed
    apart; zeros of polynomials in one variable, and of two equations in two, are isolated exactly
    where they are few. Otherwise linear equations are solved exactly first. One equation that is
    left is factored over the complex numbers, and a curve that polynomials in one variable give is
    taken as it is, exactly and without paths. Equations of turns in loops are cut by a slice at
    once, if all zeros there may be are found; other equations are intersected one by one. Where
    doubts are left and only points were found, the equations are solved all at once. Nothing is
    tried again: what is left open is said to be. The same seed gives the same answer, byte for
    byte, whatever the number of threads.

    Args:
        system: the equations; components on which a polynomial of ``system.nonzero`` vanishes
            identically are left out.
        seed: of all random numbers.
        threads: for path tracking.
        settings: ``"fast"``, ``"default"`` or ``"careful"`` tracking.
        progress: called with a stage's name, the step reached and the number of steps.
        symmetries: signed permutations of the variables that keep the equations. Of the components
            that they carry into each other one is worked out and reported, with the size of its
            orbit; `nag.witness.frame.expanded` lists the others.

    Raises:
        nag.algebra.symmetry.SymmetryError: if one of ``symmetries`` does not keep the equations.
        ValueError: if another argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> from nag.decomposition import decompose
    >>> [(c.dimension, c.degree) for c in decompose(nag.system("x*(y - 1)")).components]
    [(1, 1), (1, 1)]
    """
    check_system(system)
    check_running(seed, threads, settings, progress)
    check_listed(symmetries, "symmetries", "a list of nag.SignedPermutation")
    for symmetry in symmetries:
        check_symmetry(system, symmetry)
    tracker = Tracker(settings, threads, progress)

    def whole(part: PolynomialSystem, kept: Sequence[SignedPermutation]) -> Decomposition:
        # A branch is not the scheme that was given; its multiplicities are of no interest.
        return _decompose_whole(part, seed, tracker, kept, part is system)

    def undivided(part: PolynomialSystem, kept: Sequence[SignedPermutation]) -> Decomposition:
        apart = decompose_apart(part, whole, kept, seed, threads, settings)
        return whole(part, kept) if apart is None else apart

    parts = decompose_parts(system, undivided, symmetries, seed, threads, settings)
    return undivided(system, symmetries) if parts is None else parts


def _decompose_whole(
    system: PolynomialSystem,
    seed: int,
    tracker: Tracker,
    symmetries: Sequence[SignedPermutation],
    scheme: bool,
) -> Decomposition:
    """The components of a system as it is."""
    reduction = Reduction.of(system, scaled=True)
    rng = np.random.default_rng([seed, 3])
    moving = any(not g.is_identity for g in symmetries)
    exact = decompose_one_equation(reduction, rng, tracker, scheme, one=moving)
    exact = exact or decompose_rational_curve(reduction, rng, tracker, scheme)
    if exact is not None:
        return replace(exact, seed=seed)
    # Paths take longer to load than most of what needs none takes altogether.
    from nag.decomposition.several_equations import decompose_several

    return decompose_several(reduction, seed, rng, tracker, symmetries, scheme)


def decompose_parts(
    system: PolynomialSystem,
    whole: Decompose,
    symmetries: Sequence[SignedPermutation],
    seed: int,
    threads: int,
    settings: str,
) -> Decomposition | None:
    """The components of a system that falls apart by its variables; None if it does not.

    None as well where there are too many products, or a symmetry exchanges parts.

    Args:
        whole: decomposes a part.
    """
    parts = independent_variables(system)
    if len(parts) < 2 or not all(_stays(g, parts) for g in symmetries):
        return None
    answers = [whole(_part(system, part), _restricted(symmetries, part)) for part in parts]
    if not all(a.complete for a in answers):
        return None
    choices = list(product(*(a.components for a in answers)))
    points = [prod(c.degree for c in chosen) for chosen in choices]
    if len(choices) > MOST_PRODUCTS or max(points, default=0) > MOST_POINTS:
        return None
    from nag.decomposition.given_points import components_through_points

    starts = []
    for chosen in choices:
        x = np.zeros(system.n, dtype=complex)
        for part, component in zip(parts, chosen, strict=True):
            x[list(part)] = component.points[0]
        starts.append((sum(c.dimension for c in chosen), x))
    answer = components_through_points(
        system, starts, seed=seed, threads=threads, settings=settings, symmetries=symmetries
    )
    wanted = [
        (sum(c.dimension for c in chosen), k) for chosen, k in zip(choices, points, strict=False)
    ]
    if sorted(wanted) != sorted((c.dimension, c.degree) for c in answer.components):
        return None
    return replace(answer, paths=sum((a.paths for a in answers), PathCounts()) + answer.paths)


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

    def own(polynomials: Sequence[Polynomial]) -> tuple[Polynomial, ...]:
        return tuple(
            Polynomial(len(part), {tuple(e[i] for i in part): c for e, c in f.terms.items()})
            for f in polynomials
            if f.support and f.support <= position.keys()
        )

    groups = [tuple(position[i] for i in g if i in position) for g in system.groups]
    return PolynomialSystem(
        tuple(system.variables[i] for i in part),
        own(system.polynomials),
        own(system.nonzero),
        tuple(g for g in groups if g),
    )


def _stays(g: SignedPermutation, parts: Sequence[tuple[int, ...]]) -> bool:
    """Whether a symmetry moves the variables of one part only, among themselves."""
    moved = {i for i, (k, s) in enumerate(zip(g.sources, g.signs, strict=True)) if k != i or s < 0}
    return any(moved <= set(part) for part in parts)


def _restricted(
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
