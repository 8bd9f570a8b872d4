"""Intersections of components with each other and with equations.

A component meets further equations by u-generation that starts from its witness set. Two
components A and B meet where their product meets the diagonal (Sommese, Verschelde & Wampler 2004):
u-generation starts from A x B, whose witness points are the pairs, and takes random combinations of
the equations x = y one by one. Neither needs the components to be different or reduced.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from nag.algebra.elimination import Elimination, eliminate_linear
from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.cutting import Equations
from nag.decomposition.fibres import Fibre, Tracker, admit
from nag.decomposition.final_checks import checked_witness_set
from nag.decomposition.frame import Frame
from nag.decomposition.irreducible import irreducible_classes
from nag.decomposition.monodromy import carried
from nag.decomposition.moving import orthonormal_rows
from nag.decomposition.slices import random_rows, unit_complex
from nag.decomposition.superset import Progress, intersection_order, witness_superset
from nag.decomposition.witness import Decomposition, PathCounts, Status, WitnessSet

ATTEMPTS = 4


class IntersectionError(ValueError):
    """Sets that cannot be intersected; the message is one line."""


@dataclass(frozen=True)
class Intersection:
    """The irreducible components of an intersection.

    Attributes:
        system: all equations that are known to hold on it. Its zero set may be larger: components
            of one system meet where that system's own equations say nothing new. A component's
            multiplicity is 1 where these equations cut it as a reduced one, else 0, not known.
        components: by falling dimension, then rising degree.
        paths: what the tracker did.
        seed: seed of the random numbers.
        settings: name of the tracking settings.
        complete: whether every component is confirmed and nothing was left undecided.
        notes: what a reader must know of an incomplete answer.
    """

    system: PolynomialSystem
    components: tuple[WitnessSet, ...]
    paths: PathCounts
    seed: int
    settings: str
    complete: bool
    notes: tuple[str, ...] = ()

    @property
    def dimension(self) -> int:
        """Largest dimension of a component; -1 for the empty set."""
        return max((c.dimension for c in self.components), default=-1)


@dataclass(frozen=True, eq=False)
class _Factor:
    """A component in the coordinates that are left when linear equations are solved."""

    elimination: Elimination
    frame: Frame
    component: WitnessSet

    @classmethod
    def of(cls, system: PolynomialSystem, component: WitnessSet) -> _Factor:
        if component.points.shape[1] != system.n:
            raise IntersectionError(
                f"the component has {component.points.shape[1]} coordinates, its system {system.n}"
            )
        elimination = eliminate_linear(system, graphs=False)
        return cls(elimination, Frame.of(elimination), component)

    @property
    def n(self) -> int:
        return self.elimination.system.n

    @property
    def points(self) -> np.ndarray:
        return self.component.points[:, list(self.elimination.kept)]

    @property
    def rows(self) -> np.ndarray:
        cut = self.component.slice
        return orthonormal_rows(self.frame.pulled_back(cut.A, cut.b))


@dataclass(frozen=True, eq=False)
class _Product:
    """The product of factors, its coordinates side by side."""

    factors: tuple[_Factor, ...]

    @property
    def n(self) -> int:
        return sum(factor.n for factor in self.factors)

    @property
    def offsets(self) -> list[int]:
        return [sum(f.n for f in self.factors[:i]) for i in range(len(self.factors))]

    def _embedded(self, k: int, f: Polynomial) -> Polynomial:
        offset = self.offsets[k]
        return f.with_variables(self.n, range(offset, offset + self.factors[k].n))

    def polynomials(self, kind: str) -> list[Polynomial]:
        """The factors' ``polynomials`` or ``nonzero`` ones."""
        return [
            self._embedded(k, f)
            for k, factor in enumerate(self.factors)
            for f in getattr(factor.elimination.system, kind)
        ]

    def image(self, k: int, variable: int) -> Polynomial:
        """An original variable of factor ``k`` as a polynomial in the product's coordinates."""
        return self._embedded(k, self.factors[k].elimination.images[variable])

    def fibres(self, rng: np.random.Generator) -> tuple[list[Fibre], np.ndarray]:
        """The pairs of witness points, with cuts, and their slice."""
        points = self.factors[0].points
        for factor in self.factors[1:]:
            right = factor.points
            left = np.repeat(points, len(right), axis=0)
            points = np.hstack([left, np.tile(right, (len(points), 1))])
        d = sum(factor.component.dimension for factor in self.factors)
        rows = np.zeros((d, 1 + self.n), dtype=complex)
        first = 0
        for offset, factor in zip(self.offsets, self.factors, strict=True):
            own = factor.rows
            rows[first : first + len(own), 0] = own[:, 0]
            rows[first : first + len(own), 1 + offset : 1 + offset + factor.n] = own[:, 1:]
            first += len(own)
        components = [factor.component for factor in self.factors]
        accuracy = max([1e-12, *(c.accuracy for c in components)])
        deflate = any(c.multiplicity != 1 for c in components)
        equations = Equations(tuple(self.polynomials("polynomials")), self.n)
        fibres: list[Fibre] = []
        for point in points:
            if not admit(point, accuracy, fibres, equations, rows, rng, deflate):
                raise IntersectionError("the witness points are no regular zeros of the system")
        return fibres, rows

    def slice_of(self, rows: np.ndarray, original: int) -> tuple[np.ndarray, np.ndarray]:
        """``A, b`` of a slice in the original coordinates, all factors' points being equal."""
        A = np.zeros((len(rows), original), dtype=complex)
        for offset, factor in zip(self.offsets, self.factors, strict=True):
            part = rows[:, 1 + offset : 1 + offset + factor.n]
            A[:, list(factor.elimination.kept)] += part
        return A, -rows[:, 0]


def intersect_components(
    system: PolynomialSystem,
    first: WitnessSet,
    second: WitnessSet,
    *,
    other: PolynomialSystem | None = None,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
    progress: Progress | None = None,
) -> Intersection:
    """The irreducible components of the intersection of two components, as sets.

    Args:
        system: the equations that ``first`` was found from.
        other: those that ``second`` was found from, in the same variables; ``system`` by default.

    Raises:
        IntersectionError: if the variables differ, or witness points are none.
    """
    other = system if other is None else other
    _check_variables(system, other)
    product = _Product((_Factor.of(system, first), _Factor.of(other, second)))
    rng = np.random.default_rng([seed, 5])
    diagonal = _diagonal(product, system.n, rng)
    tracker = Tracker(settings, threads)
    return _intersection(product, diagonal, _union(system, other), rng, tracker, seed, progress)


def intersect_equations(
    system: PolynomialSystem,
    component: WitnessSet,
    equations: PolynomialSystem,
    *,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
    progress: Progress | None = None,
) -> Intersection:
    """The irreducible components of the intersection of a component with a zero set.

    Args:
        system: the equations that ``component`` was found from.
        equations: further equations in the same variables.

    Raises:
        IntersectionError: if the variables differ, or witness points are none.
    """
    _check_variables(system, equations)
    product = _Product((_Factor.of(system, component),))
    images = [product.image(0, i) for i in range(system.n)]
    further = [f.compose(images) for f in equations.polynomials]
    rng = np.random.default_rng([seed, 6])
    tracker = Tracker(settings, threads)
    return _intersection(product, further, _union(system, equations), rng, tracker, seed, progress)


def _diagonal(product: _Product, n: int, rng: np.random.Generator) -> list[Polynomial]:
    """Random combinations of the equations that say that two factors' points are equal.

    Generic ones meet the product transversally off the diagonal, wherever else its factors lie in
    each other's singular sets; the equations themselves need not.
    """
    differences = [product.image(0, i) - product.image(1, i) for i in range(n)]
    differences = [f for f in dict.fromkeys(differences) if f]
    result = []
    for _ in differences:
        f = Polynomial.constant(product.n, 0)
        for difference, k in zip(differences, rng.integers(-64, 64, len(differences)), strict=True):
            f = f + difference * Fraction(2 * int(k) + 1, 64)
        result.append(f)
    return result


def _check_variables(first: PolynomialSystem, second: PolynomialSystem) -> None:
    if first.variables != second.variables:
        raise IntersectionError(
            f"the variables differ: {', '.join(first.variables)} and {', '.join(second.variables)}"
        )


def _union(first: PolynomialSystem, second: PolynomialSystem) -> PolynomialSystem:
    return PolynomialSystem(
        first.variables,
        tuple(dict.fromkeys(first.polynomials + second.polynomials)),
        tuple(dict.fromkeys(first.nonzero + second.nonzero)),
        first.groups,
    )


def _intersection(
    product: _Product,
    further: Sequence[Polynomial],
    union: PolynomialSystem,
    rng: np.random.Generator,
    tracker: Tracker,
    seed: int,
    progress: Progress | None,
) -> Intersection:
    flag = random_rows(rng, product.n, product.n)
    further = [f for f in dict.fromkeys(further) if f]
    further = [further[i] for i in intersection_order(further)]
    fibres, counts = _on_flag(product, flag, rng, tracker)
    superset = witness_superset(
        further,
        product.n,
        product.polynomials("nonzero"),
        flag,
        rng,
        tracker,
        progress,
        start=fibres,
        known=product.polynomials("polynomials"),
    )
    counts += superset.counts
    notes = list(superset.notes)
    if superset.counts.failed:
        notes.append(f"{superset.counts.failed} paths failed; points may be missing")
    elimination = eliminate_linear(union, graphs=False)
    frame, reduced = Frame.of(elimination), elimination.system
    equations = Equations(reduced.polynomials, reduced.n)
    everything = Evaluator.of(union.polynomials, union.n)
    components: list[WitnessSet] = []
    for d in sorted(superset.fibres, reverse=True):
        found = superset.fibres[d]
        if not found:
            continue
        if progress is not None:
            progress("splitting", len(components), 0)
        rows = orthonormal_rows(frame.pulled_back(*product.slice_of(flag[:d], union.n)))
        one = product.factors[0]
        x = np.vstack([one.frame.points(fibre.x[:, : one.n]) for fibre in found])
        own, lost = _with_cuts(x[:, list(elimination.kept)], equations, rows, rng)
        if lost:
            notes.append(f"{lost} singular points of dimension {d} could not be made regular")
        if not own:
            continue
        classes, spent = irreducible_classes(own, rows, rng, tracker)
        counts += spent
        sets = []
        for points in classes:
            component, spent = checked_witness_set(
                points,
                own,
                rows,
                equations,
                everything,
                frame,
                union.groups,
                rng,
                tracker,
                scheme=False,
            )
            counts += spent
            sets.append(component)
        components.extend(sorted(sets, key=lambda c: c.degree))
    undecided = any(c.status is Status.UNDECIDED for c in components)
    return Intersection(
        system=union,
        components=tuple(components),
        paths=counts,
        seed=seed,
        settings=tracker.settings,
        complete=not (undecided or notes),
        notes=tuple(notes),
    )


def _on_flag(
    product: _Product, flag: np.ndarray, rng: np.random.Generator, tracker: Tracker
) -> tuple[list[Fibre], PathCounts]:
    """The product's points on the leading rows of a generic flag."""
    fibres, rows = product.fibres(rng)
    counts = PathCounts()
    if len(rows) == 0:
        return fibres, counts
    for attempt in range(ATTEMPTS):
        used = Tracker("careful" if attempt else tracker.settings, tracker.threads)
        gamma = complex(unit_complex(rng))
        there, spent = carried(fibres, rows, flag[: len(rows)], gamma, used)
        counts += spent
        if there is not None:
            return there, counts
    raise IntersectionError("the witness points could not be moved to a generic slice")


def _with_cuts(
    points: np.ndarray, equations: Equations, rows: np.ndarray, rng: np.random.Generator
) -> tuple[list[Fibre], int]:
    """The points with square systems that cut them, and the number for which none was found."""
    fibres: list[Fibre] = []
    lost = 0
    for x in points:
        if admit(x, 1e-12, fibres, equations, rows, rng, deflate=False):
            continue
        lost += not admit(x, 1e-12, fibres, equations, rows, rng, deflate=True)
    return fibres, lost


def intersect_pair(
    decomposition: Decomposition, first: int, second: int, **options: object
) -> Intersection:
    """The intersection of two components of a decomposition, given by their indices."""
    components = decomposition.components
    return intersect_components(
        decomposition.system, components[first], components[second], **options
    )
