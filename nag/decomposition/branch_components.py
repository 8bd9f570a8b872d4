"""Components of systems that fall apart exactly: those of the branches, joined without repeats.

The branches are decomposed and joined in coordinates that suit the whole system: only in these can
slices and distances be of use for all of its components.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from nag.algebra.algebraic_zeros import AlgebraicZero
from nag.algebra.branch_equations import BranchEquations, BranchKind
from nag.algebra.evaluation import Evaluator
from nag.algebra.exact_ranks import independent_polynomials
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation, SymmetryError, check_symmetry
from nag.algebra.system import PolynomialSystem
from nag.decomposition.final_checks import judge_components
from nag.decomposition.method import Others, Task
from nag.decomposition.orbits import group_into_orbits
from nag.numerics.branch_union import (
    BranchZeros,
    GenericPoint,
    PointWithError,
    find_repeats,
    multiplicities_in_scheme,
)
from nag.numerics.coincidence import LEAST
from nag.numerics.double_ranks import corank_on_component
from nag.numerics.natural_coordinates import NaturalCoordinates, scale_coordinates
from nag.numerics.singular_point import Place, SingularEnd, analyse
from nag.numerics.zero_values import ON, WRITTEN, vanishes_at_all, widen_error
from nag.tracking.run import Run, Stream
from nag.witness.change_of_coordinates import carry_component, coordinates_of
from nag.witness.component_equations import component_fibres
from nag.witness.confirm import find_vanishing
from nag.witness.cutting import Cut
from nag.witness.exact_points import carry_radii, exact_zeros, sharpen_points
from nag.witness.fibres import Fibre, whole_space
from nag.witness.frame import Frame
from nag.witness.membership import Membership, is_on_one_of
from nag.witness.moving import witness_at
from nag.witness.slices import pad_rows, random_rows, to_slice
from nag.witness.witness import Decomposition, PathCounts, Slice, Status, WitnessSet


@dataclass(frozen=True, eq=False)
class BranchComponent(GenericPoint):
    """A component of a branch, by its witness points.

    Attributes:
        zero: the exact zero, where it is one of an algebraic branch.
    """

    witness: WitnessSet
    branch: BranchEquations
    zero: AlgebraicZero | None = None

    @property
    def dimension(self) -> int:  # type: ignore[override]
        return self.witness.dimension

    @property
    def rows(self) -> np.ndarray:  # type: ignore[override]
        return pad_rows(self.witness.slice.rows, 1 + self.witness.points.shape[1])

    @property
    def points(self) -> np.ndarray:
        return self.witness.points

    @cached_property
    def point(self) -> np.ndarray:
        """The smallest of the points, shape ``(n,)``."""
        smallest: np.ndarray = self.points[np.linalg.norm(self.points, axis=1).argmin()]
        return smallest

    @property
    def radii(self) -> np.ndarray | None:
        known = self._each_known and self.witness.multiplicity == 1
        return self.witness.radii[0] if known else None

    @property
    def multiplicity_in_branch(self) -> int:
        # A branch is decomposed as a set: where points are not simple, nothing is known.
        simple = self.witness.multiplicity == 1 and self.witness.corank == self.witness.dimension
        return 1 if simple else 0

    @property
    def error(self) -> float:
        return widen_error(self.point, self.witness.accuracy)

    def vanishes_in_digits(self, f: Polynomial, image: Polynomial) -> bool | None:
        multiple = self._is_isolated and self.witness.multiplicity != 1
        fibre = None if multiple and self.zeros else self._fibre
        if fibre is None:
            # Doubles do not see that the points are regular, or are of a zero known to 100 digits.
            return vanishes_at_all(self.zeros, f)
        (answer,) = find_vanishing(fibre.only([0]), f)
        return vanishes_at_all(self.zeros, f) if answer is None else answer

    def in_digits(self) -> PointWithError:
        # Zeros of other branches may be close to it.
        if len(self.zeros) == 1:
            return self.zeros[0].precise.centre, WRITTEN
        return self.point, LEAST

    @property
    def _is_isolated(self) -> bool:
        """Whether it is a point that paths ended at."""
        return not self.witness.fibres and not self.witness.dimension

    @property
    def _each_known(self) -> bool:
        """Whether it is a point of which the error of each coordinate is known."""
        return self._is_isolated and bool(np.ptp(self.witness.radii[0]) > 0)

    def place_among(self, equations: Sequence[Polynomial]) -> Place:
        """Where it lies among zeros of others, if it is an isolated point and one of these."""
        if self.witness.dimension or self.zero is not None or len(self.zeros) != 1:
            return Place.UNDECIDED
        rng = np.random.default_rng(0)
        return analyse(equations, self.in_digits()[0], WRITTEN, rng, place_only=True).place

    @cached_property
    def _fibre(self) -> Fibre | None:
        """The points with equations that cut them; None where these are not regular zeros."""
        try:
            return component_fibres(self.branch.system, self.witness)[0]
        except ValueError:
            return None

    @cached_property
    def zeros(self) -> tuple[SingularEnd, ...]:
        """The exact zeros on the slice that the first point may stand for."""
        return exact_zeros(self.branch.system.polynomials, self.witness)


@dataclass(frozen=True, eq=False)
class _DecomposedBranch(BranchZeros[BranchComponent]):
    """A branch and its components."""

    answer: Decomposition | None


def decompose_apart(task: Task, others: Others) -> Decomposition | None:
    """The components of a system that falls apart, or has zeros that are known exactly.

    Args:
        others: decomposes a branch.

    Returns:
        None if the system neither falls apart nor comes down to one variable.
    """
    system, symmetries, run = task.system, task.symmetries, task.run
    if system.n == 0:
        return None
    apart = task.facts.branches.parts
    used: Sequence[SignedPermutation] = ()
    zeros = task.facts.exact_zeros if apart is None else None
    if apart is None and zeros is None:
        return None
    given, natural = system, NaturalCoordinates.identity(system.n)
    if apart:
        natural = _suitable_coordinates(system, symmetries)
        system = natural.system(system)
    rng = run.random(Stream.GENERIC_POINTS)
    if zeros is not None:
        parts = [_algebraic(system, zeros)]
    else:
        systems = [natural.system(b.system(given)) for b in apart]
        used = symmetries if len(systems) == 1 and _keep(symmetries, systems[0]) else ()
        parts = []
        for each in systems:
            parts.append(_part(task.of_part(each, used), others, rng))
            if task.found is not None:
                # Some of these may lie on components of other branches.
                own = [c.witness for part in parts for c in part.found]
                task.found([_carry_back(c, natural.inverse, given, None) for c in own])
    joined, notes, counts = _join(parts, rng, run)
    components = [c.witness for c in joined]
    if apart is not None:
        components = _in_scheme(system, joined)
    exact = {id(c): each.zero for c, each in zip(components, joined, strict=True) if each.zero}
    if symmetries and not used and components:
        try:
            components, spent = _in_orbits(system, components, symmetries, run)
            counts += spent
        except ValueError as error:
            notes.append(f"orbits of the symmetries are not known: {error}")
    components.sort(key=lambda c: (-c.dimension, c.degree))
    back = natural.inverse
    components = [_carry_back(c, back, given, exact.get(id(c))) for c in components]
    answers = [part.answer for part in parts if part.answer is not None]
    notes += [note for answer in answers for note in answer.notes]
    paths = sum((answer.paths for answer in answers), counts)
    answer = judge_components(given, components, paths, run, notes)
    return replace(answer, algebraic=not counts.tracked and all(a.algebraic for a in answers))


def _suitable_coordinates(
    system: PolynomialSystem, symmetries: Sequence[SignedPermutation]
) -> NaturalCoordinates:
    """The coordinates that suit a system, if its symmetries are the same there."""
    natural = coordinates_of(system)
    if natural.is_identity or _keep(symmetries, natural.system(system)):
        return natural
    return NaturalCoordinates.identity(system.n)


def _carry_back(
    component: WitnessSet,
    natural: NaturalCoordinates,
    system: PolynomialSystem,
    zero: AlgebraicZero | None,
) -> WitnessSet:
    """A component of a system in the coordinates that were given, where it may be an exact zero."""
    if natural.is_identity:
        return component
    there = carry_component(component, natural, system, back=True)
    if zero is None:
        return there
    x = zero.scale_and_shift(natural.inverse.scales, natural.inverse.origin).point[None]
    return replace(there, points=x, radii=np.finfo(float).eps * np.abs(x))


def _keep(symmetries: Sequence[SignedPermutation], system: PolynomialSystem) -> bool:
    try:
        for symmetry in symmetries:
            check_symmetry(system, symmetry)
    except SymmetryError:
        return False
    return True


def _part(task: Task, others: Others, rng: np.random.Generator) -> _DecomposedBranch:
    system = task.system
    zeros = None if task.symmetries else task.facts.exact_zeros
    if zeros is not None:
        return _algebraic(system, zeros)
    branch = BranchEquations(system, graphs=False)
    if branch.kind is BranchKind.EMPTY:
        return _DecomposedBranch(system, (), None)
    if branch.kind is not BranchKind.SYSTEM and not system.groups:
        return _DecomposedBranch(system, (_linear_space(branch, rng),), None)
    answer = others(task)
    return _DecomposedBranch(
        system, tuple(BranchComponent(c, branch) for c in answer.components), answer
    )


def _algebraic(system: PolynomialSystem, zeros: Sequence[AlgebraicZero]) -> _DecomposedBranch:
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
            corank=corank_on_component(evaluator, x, 0, zero.multiplicity),
            multidegree=np.array(1) if system.groups else None,
        )
        if square and zero.multiplicity == 1:
            fibre = Fibre(Cut(n, 0, system.polynomials), witness.slice.rows, x[None])
            witness = replace(witness, fibres=(fibre,))
        found.append(BranchComponent(witness, branch, zero))
    return _DecomposedBranch(system, tuple(found), None)


def _linear_space(branch: BranchEquations, rng: np.random.Generator) -> BranchComponent:
    """A linear space, which may be a point, by a point of it."""
    system, elimination = branch.system, branch.elimination
    sizes = scale_coordinates(system.polynomials, system.n).sizes
    frame = Frame.of(elimination).scaled(sizes[list(elimination.kept)])
    d = elimination.system.n
    rows = random_rows(rng, d, d)
    sharp = sharpen_points([whole_space(rows)])
    x = frame.points(sharp.x)
    evaluator = Evaluator.of(system.polynomials, system.n)
    cut = Cut(system.n, 0, tuple(independent_polynomials(system.polynomials)))
    own = frame.slice(rows)
    witness = WitnessSet(
        slice=own,
        points=x,
        multiplicity=1,
        status=Status.IRREDUCIBLE,
        residual=float(evaluator.residuals(x).max(initial=0.0)),
        radii=carry_radii(frame, sharp.x, sharp.radii),
        digits=sharp.digits,
        corank=d,
        fibres=(Fibre(cut, own.rows, x),),
    )
    return BranchComponent(witness, branch)


def _vanishes_at(f: Polynomial, zero: AlgebraicZero) -> bool:
    if f.exact:
        return zero.vanishes(f)
    return bool(Evaluator.of([f], f.n).residuals(zero.point[None])[0, 0] < ON)


@dataclass
class _Coverage:
    """Looks for components in larger ones of other branches.

    Attributes:
        counts: the paths that it takes.
    """

    rng: np.random.Generator
    run: Run
    counts: PathCounts = field(default=PathCounts())

    def is_in_larger(self, part: _DecomposedBranch, component: BranchComponent) -> bool | None:
        """Whether a component on which the equations of a part vanish is in a larger one of it."""
        witness = component.witness
        larger = [c for c in part.found if c.witness.dimension > witness.dimension]
        if larger and len(larger) == len(part.found):
            return True
        place = component.place_among(part.system.polynomials) if larger else Place.ISOLATED
        if place in (Place.ISOLATED, Place.ON_COMPONENT):
            return place is Place.ON_COMPONENT
        sets, known = [], True
        for each in larger:
            try:
                sets.append(component_fibres(part.system, each.witness))
            except ValueError:
                known = False
        point, accuracy = witness.points[0], witness.accuracy
        answer, spent = is_on_one_of(point, accuracy, sets, self.rng, self.run)
        self.counts += spent
        if answer is Membership.FOREIGN and known:
            return False
        return True if answer is Membership.MEMBER else None


def _join(
    parts: Sequence[_DecomposedBranch], rng: np.random.Generator, run: Run
) -> tuple[list[BranchComponent], list[str], PathCounts]:
    """The components of all branches that lie in no component of another branch."""
    coverage = _Coverage(rng, run)
    kept: list[BranchComponent] = []
    notes: list[str] = []
    for component, repeated in find_repeats(parts, coverage.is_in_larger):
        if repeated is None:
            d = component.witness.dimension
            notes.append(f"a component of dimension {d} may lie in one of another branch")
        if not repeated:
            kept.append(component)
    return kept, notes, coverage.counts


def _in_scheme(system: PolynomialSystem, components: Sequence[BranchComponent]) -> list[WitnessSet]:
    """The components with what the original equations make of them."""
    original = Evaluator.of(system.polynomials, system.n)
    found = []
    multiplicities = multiplicities_in_scheme(system, components)
    for component, multiple in zip(components, multiplicities, strict=True):
        witness = component.witness
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
            corank=corank_on_component(original, witness.points[0], witness.dimension, multiple),
            status=Status.UNDECIDED if reasons else witness.status,
            note="; ".join(reasons),
        )
        found.append(changed)
    return found


def _in_orbits(
    system: PolynomialSystem,
    components: Sequence[WitnessSet],
    symmetries: Sequence[SignedPermutation],
    run: Run,
) -> tuple[list[WitnessSet], PathCounts]:
    """One of each orbit; components that are not confirmed are none of any.

    Raises:
        ValueError: if points could not be moved to a common slice.
    """
    whole = [c for c in components if c.status is Status.IRREDUCIBLE]
    rng, natural = run.random(Stream.BRANCHES), coordinates_of(system)
    flag = natural.inverse.rows(random_rows(rng, system.n, system.n))
    whole = [
        witness_at(system, c, to_slice(flag[: c.dimension]), run=run) if c.dimension else c
        for c in whole
    ]
    moved = PathCounts(sum(c.degree for c in whole if c.dimension))
    orbits, counts = group_into_orbits(system, whole, symmetries, run=run)
    others = [c for c in components if c.status is not Status.IRREDUCIBLE]
    return [*orbits, *others], moved + counts
