"""Components of systems that fall apart exactly: those of the branches, joined without repeats."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.algebraic_zeros import BITS, AlgebraicZero, algebraic_zeros
from nag.algebra.branch_equations import BranchEquations, BranchKind
from nag.algebra.branches import branches
from nag.algebra.evaluation import Evaluator, may_vanish
from nag.algebra.factoring import Factors, factored
from nag.algebra.generic_multiplicity import (
    Gradients,
    generic_multiplicity,
    independent_gradients,
)
from nag.algebra.linear_algebra import independent_polynomials
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation, SymmetryError, check_symmetry
from nag.algebra.system import PolynomialSystem
from nag.decomposition.branch_component import BranchComponent
from nag.decomposition.final_checks import judged
from nag.decomposition.symmetric_images import in_orbits
from nag.numerics.natural_coordinates import scale_coordinates
from nag.numerics.singular_point import Place
from nag.numerics.zero_values import (
    NONZERO,
    ON,
    SINGULAR,
    WRITTEN,
    multiplicity_of_all,
    possible_zeros,
    widened,
)
from nag.witness.change_of_coordinates import coordinates_of
from nag.witness.component_equations import component_fibres
from nag.witness.cutting import Cut, numerical_corank
from nag.witness.exact_points import framed, sharpened
from nag.witness.fibres import Fibre, Tracker
from nag.witness.frame import Frame
from nag.witness.membership import Membership, is_member
from nag.witness.moving import witness_at
from nag.witness.multiplicity import multiplicity
from nag.witness.slices import padded, random_rows, to_slice
from nag.witness.witness import Decomposition, PathCounts, Slice, Status, WitnessSet

Whole = Callable[[PolynomialSystem, Sequence[SignedPermutation]], Decomposition]


@dataclass(frozen=True, eq=False)
class _Part:
    """A branch and its components."""

    system: PolynomialSystem
    components: tuple[BranchComponent, ...]
    answer: Decomposition | None


def decompose_apart(
    system: PolynomialSystem,
    whole: Whole,
    symmetries: Sequence[SignedPermutation],
    seed: int,
    threads: int,
    settings: str,
) -> Decomposition | None:
    """The components of a system that falls apart, or has zeros that are known exactly.

    Args:
        whole: decomposes a system as it is, with its symmetries.

    Returns:
        None if the system neither falls apart nor comes down to one variable.
    """
    if system.n == 0:
        return None
    apart = branches(system)
    used: Sequence[SignedPermutation] = ()
    zeros = algebraic_zeros(system) if apart is None else None
    if apart is None and zeros is None:
        return None
    rng = np.random.default_rng([seed, 11])
    if zeros is not None:
        parts = [_algebraic(system, zeros)]
    else:
        systems = [b.system(system) for b in apart]
        used = symmetries if len(systems) == 1 and _keep(symmetries, systems[0]) else ()
        parts = [_part(each, whole, used, rng) for each in systems]
    joined, notes, counts = _joined(parts, rng, Tracker(settings, threads))
    components = [c.witness for c in joined]
    if apart is not None:
        components = _in_scheme(system, joined)
    if symmetries and not used and components:
        try:
            components = _orbits(system, components, symmetries, seed, threads, settings)
        except ValueError as error:
            notes.append(f"orbits of the symmetries are not known: {error}")
    components.sort(key=lambda c: (-c.dimension, c.degree))
    answers = [part.answer for part in parts if part.answer is not None]
    notes += [note for answer in answers for note in answer.notes]
    paths = sum((answer.paths for answer in answers), counts)
    return judged(system, components, paths, settings, notes, seed=seed)


def _keep(symmetries: Sequence[SignedPermutation], system: PolynomialSystem) -> bool:
    try:
        for symmetry in symmetries:
            check_symmetry(system, symmetry)
    except SymmetryError:
        return False
    return True


def _part(
    system: PolynomialSystem,
    whole: Whole,
    symmetries: Sequence[SignedPermutation],
    rng: np.random.Generator,
) -> _Part:
    zeros = None if symmetries else algebraic_zeros(system)
    if zeros is not None:
        return _algebraic(system, zeros)
    branch = BranchEquations(system, graphs=False)
    if branch.kind is BranchKind.EMPTY:
        return _Part(system, (), None)
    if branch.kind is not BranchKind.SYSTEM and not system.groups:
        return _Part(system, (_linear_space(branch, rng),), None)
    answer = whole(system, symmetries)
    return _Part(system, tuple(BranchComponent(c, branch) for c in answer.components), answer)


def _algebraic(system: PolynomialSystem, zeros: Sequence[AlgebraicZero]) -> _Part:
    n = system.n
    evaluator, branch = Evaluator.of(system.polynomials, n), BranchEquations(system, graphs=False)
    found, square = [], len(system.polynomials) == n
    for zero in zeros:
        x = zero.point
        if any(_vanishes_at(f, zero) for f in system.nonzero):
            continue
        witness = WitnessSet(
            slice=Slice(np.zeros((0, n)), np.zeros(0)),
            points=x[None],
            multiplicity=zero.multiplicity,
            status=Status.IRREDUCIBLE,
            residual=float(evaluator.residuals(x[None]).max(initial=0.0)),
            radii=np.finfo(float).eps * np.abs(x)[None],
            digits=[zero.digits],
            corank=_corank(evaluator, x),
            multidegree=np.array(1) if system.groups else None,
        )
        if square and zero.multiplicity == 1:
            fibre = Fibre(Cut(n, 0, system.polynomials), 0, x[None])
            witness = replace(witness, fibres=(fibre,))
        found.append(BranchComponent(witness, branch, zero))
    return _Part(system, tuple(found), None)


def _linear_space(branch: BranchEquations, rng: np.random.Generator) -> BranchComponent:
    """A linear space, which may be a point, by a point of it."""
    system, elimination = branch.system, branch.elimination
    sizes = scale_coordinates(system.polynomials, system.n).sizes
    frame = Frame.of(elimination).scaled(sizes[list(elimination.kept)])
    d = elimination.system.n
    rows = random_rows(rng, d, d)
    point = np.linalg.solve(rows[:, 1:], -rows[:, 0])[None]
    sharp = sharpened(Fibre(Cut(d, 0, ()), d, point), rows)
    x = frame.points(sharp.fibre.x)
    evaluator = Evaluator.of(system.polynomials, system.n)
    cut = Cut(system.n, 0, tuple(independent_polynomials(system.polynomials)))
    witness = WitnessSet(
        slice=frame.slice(rows),
        points=x,
        multiplicity=1,
        status=Status.IRREDUCIBLE,
        residual=float(evaluator.residuals(x).max(initial=0.0)),
        radii=framed(frame, sharp.fibre.x, sharp.radii),
        digits=sharp.digits,
        corank=d,
        fibres=(Fibre(cut, d, x),),
    )
    return BranchComponent(witness, branch)


def _vanishes_at(f: Polynomial, zero: AlgebraicZero) -> bool:
    if f.exact:
        return zero.vanishes(f)
    return bool(Evaluator.of([f], f.n).residuals(zero.point[None])[0, 0] < ON)


def _corank(evaluator: Evaluator, x: np.ndarray) -> int:
    s = np.linalg.svd(evaluator.balanced_jacobian(x), compute_uv=False)
    return numerical_corank(s, len(x), SINGULAR)


def _joined(
    parts: Sequence[_Part], rng: np.random.Generator, tracker: Tracker
) -> tuple[list[BranchComponent], list[str], PathCounts]:
    """The components of all branches that lie in no component of another branch.

    A component lies in the zero set of another branch when the equations vanish at one of its
    generic points. Then it is one of that branch's components or part of a larger one.
    """
    kept: list[BranchComponent] = []
    notes: list[str] = []
    counts = PathCounts()
    systems = [part.system.polynomials for part in parts]
    first = [c.witness.points[0] for part in parts for c in part.components]
    near = iter(may_vanish(systems, np.array(first), NONZERO) if first else ())
    for i, part in enumerate(parts):
        for component, close in zip(part.components, near, strict=False):
            inside = False
            for j in (j for j in np.flatnonzero(close).tolist() if j != i):
                answer, spent = _covered(component, parts[j], j < i, rng, tracker)
                counts += spent
                if answer is Membership.UNDECIDED:
                    d = component.witness.dimension
                    notes.append(f"a component of dimension {d} may lie in one of another branch")
                inside |= answer is Membership.MEMBER
                if inside:
                    break
            if not inside:
                kept.append(component)
    return kept, notes, counts


def _covered(
    component: BranchComponent,
    other: _Part,
    earlier: bool,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[Membership, PathCounts]:
    """Whether a component is in one of another branch: in a larger one, or in an earlier branch."""
    counts = PathCounts()
    unknown = False
    for f in other.system.polynomials:
        there = component.vanishes(f)
        if there is False:
            return Membership.FOREIGN, counts
        unknown |= there is None
    if unknown:
        return Membership.UNDECIDED, counts
    witness = component.witness
    larger = [c for c in other.components if c.witness.dimension > witness.dimension]
    if earlier or (larger and len(larger) == len(other.components)):
        return Membership.MEMBER, counts
    place = component.place_among(other.system.polynomials) if larger else Place.ISOLATED
    if place in (Place.ISOLATED, Place.ON_COMPONENT):
        on = place is Place.ON_COMPONENT
        return Membership.MEMBER if on else Membership.FOREIGN, counts
    result = Membership.FOREIGN
    for each in larger:
        try:
            fibres = component_fibres(other.system, each.witness)
        except ValueError:
            result = Membership.UNDECIDED
            continue
        point, rows = witness.points[0], each.witness.slice.rows
        answer, spent = is_member(point, witness.accuracy, fibres, rows, rng, tracker)
        counts += spent
        if answer is Membership.MEMBER:
            return answer, counts
        if answer is Membership.UNDECIDED:
            result = answer
    return result, counts


def _in_scheme(system: PolynomialSystem, components: Sequence[BranchComponent]) -> list[WitnessSet]:
    """The components with what the original equations make of them."""
    equations = [factored(f) for f in system.polynomials if f]
    factors = [*dict.fromkeys(p for each in equations for p, _ in each)]
    original = Evaluator.of(system.polynomials, system.n)
    products = Evaluator.of(factors, system.n)
    gradients = Gradients.of([f for f in system.polynomials if f], system.n)
    found = []
    for component in components:
        witness = component.witness
        far = (products.residuals(witness.points) > NONZERO).any(axis=0)
        component.vanishes.exclude(p for p, nonzero in zip(factors, far, strict=True) if nonzero)
        multiple = _multiplicity(equations, gradients, component)
        residual = float(original.residuals(witness.points).max(initial=0.0))
        reasons = [witness.note] if witness.note else []
        if residual > max(ON, witness.accuracy):
            reasons.append("a point does not satisfy all equations")
        if not multiple:
            reasons.append("its multiplicity was not found")
        changed = replace(
            witness,
            multiplicity=multiple,
            residual=residual,
            corank=witness.dimension if multiple == 1 else _corank(original, witness.points[0]),
            status=Status.UNDECIDED if reasons else witness.status,
            note="; ".join(reasons),
        )
        found.append(changed)
    return found


def _multiplicity(
    equations: Sequence[Factors], gradients: Gradients, component: BranchComponent
) -> int:
    """The multiplicity of a component in the scheme of all equations; 0 if it was not found."""
    witness = component.witness
    n = witness.points.shape[1]
    x = witness.points[np.linalg.norm(witness.points, axis=1).argmin()]

    codimension = n - witness.dimension

    simple = component.zero is None and witness.multiplicity == 1
    # A scheme is reduced where as many gradients are independent as its codimension.
    if simple and gradients.rank(x, widened(x, witness.accuracy)) >= codimension:
        return 1
    regular = simple and witness.corank == witness.dimension
    if regular and component.branch.is_own_ring(equations, component.vanishes):
        return 1

    def independent(polynomials: Sequence[Polynomial]) -> bool:
        if component.zero is not None and all(f.exact for f in polynomials):
            return component.zero.independent(polynomials)
        return independent_gradients(polynomials, x, widened(x, witness.accuracy))

    def by_local_ring(generators: Sequence[Polynomial]) -> int:
        rows, rng = witness.slice.rows, np.random.default_rng(0)
        # Zeros of other branches may be close to it.
        if component.zero is not None:
            at, error = component.zero.known_to(BITS), 2.0**-BITS
        elif len(component.zeros) == 1:
            at, error = component.zeros[0].digits, WRITTEN
        else:
            return multiplicity(generators, rows, x, rng)
        there = possible_zeros(generators, at, error, rng, padded(rows, 1 + n))
        return multiplicity_of_all(there) or 0

    return generic_multiplicity(
        equations, codimension, component.vanishes, independent, by_local_ring
    )


def _orbits(
    system: PolynomialSystem,
    components: Sequence[WitnessSet],
    symmetries: Sequence[SignedPermutation],
    seed: int,
    threads: int,
    settings: str,
) -> list[WitnessSet]:
    """One of each orbit; components that are not confirmed are none of any.

    Raises:
        ValueError: if points could not be moved to a common slice.
    """
    options = {"seed": seed, "threads": threads, "settings": settings}
    whole = [c for c in components if c.status is Status.IRREDUCIBLE]
    rng, natural = np.random.default_rng([seed, 12]), coordinates_of(system)
    flag = natural.inverse.rows(random_rows(rng, system.n, system.n))
    whole = [
        witness_at(system, c, to_slice(flag[: c.dimension]), **options) if c.dimension else c
        for c in whole
    ]
    orbits = in_orbits(system, whole, symmetries, **options)
    return [*orbits, *(c for c in components if c.status is not Status.IRREDUCIBLE)]
