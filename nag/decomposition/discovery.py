"""Components discovered from random starting points, where a complete decomposition is too large.

Newton's method leads to a generic point of some component. The corank of the Jacobian there is its
dimension if the component is reduced; else it is the largest one for which deflation makes the
point regular on a slice. All points move to one slice for each dimension, where loops complete the
components. Nothing says that all components were found.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from nag.algebra.given import check_listed, check_whole
from nag.algebra.imaginary_unit import as_real, has_unit
from nag.algebra.symmetry import SignedPermutation, check_symmetry
from nag.algebra.system import PolynomialSystem
from nag.decomposition.assembly import Assembly, assemble_components
from nag.decomposition.decompose import leave_out_conjugate
from nag.decomposition.ends import seem_excluded
from nag.decomposition.final_checks import judge_components
from nag.decomposition.given_points import CommonSlices, GivenPoint
from nag.decomposition.orbits import group_into_orbits
from nag.decomposition.reduction import Reduction
from nag.numerics.double_ranks import NEARLY_SINGULAR, largest_corank
from nag.numerics.doubles import ARRIVED, MULTIPLE, ROUNDED
from nag.numerics.zero_values import LEAST
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.fibres import whole_space
from nag.witness.gauss_newton import CLOSE, descend, polish
from nag.witness.given_component import check_system
from nag.witness.slices import complex_normal
from nag.witness.witness import Decomposition, PathCounts, Status, WitnessSet

STARTS = 100
# Points that no deflation made regular, after which no more are tried: each costs seconds.
MOST_REFUSALS = 3


@takes_run
@np.errstate(over="ignore", invalid="ignore")
def discover(
    system: PolynomialSystem,
    *,
    run: Run = DEFAULT_RUN,
    starts: int = STARTS,
    symmetries: Sequence[SignedPermutation] = (),
) -> Decomposition:
    """The irreducible components that Newton's method finds from ``starts`` random points.

    Loops of slices complete them, and the trace test confirms each (Sommese, Verschelde & Wampler
    2001, 2002). Every component that is reported has passed the same checks as in a complete
    decomposition, but others may be missing: ``complete`` is False, whatever was found.

    Args:
        system: as for `nag.decompose`.
        starts: number of starting points.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.
        symmetries: as for `nag.decompose`; what they carry a component to is found
            with it.

    Returns:
        The components that were found, by falling dimension.

    Raises:
        nag.algebra.symmetry.SymmetryError: if one of ``symmetries`` does not keep the equations.
        ValueError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> from nag.decomposition import discover
    >>> found = discover(nag.system("(x^2 + y^2 - z)*(x - y)"), starts=10)
    >>> [(c.dimension, c.degree) for c in found.components], found.complete
    ([(2, 1), (2, 2)], False)
    """
    check_system(system)
    check_whole(starts, "starts")
    check_listed(symmetries, "symmetries", "a list of nag.SignedPermutation")
    for symmetry in symmetries:
        check_symmetry(system, symmetry)
    given, system = system, as_real(system)
    rng = run.random(Stream.DISCOVERY)
    reduction = Reduction.of(system, scaled=True)
    search = _Discovery(reduction, CommonSlices.random(reduction.equations, rng), rng, run)
    search.from_random_points(starts)
    found = assemble_components(search.slices.points, reduction, rng, run, embedded=True)
    notes = search.notes(starts, found, 1 + given.imaginary)
    components, counts = list(found.components), search.counts + found.counts
    if symmetries:
        components, more, spent = _with_orbits(system, components, symmetries, run)
        notes, counts = notes + more, counts + spent
    notes += found.notes
    answer = judge_components(system, components, counts, run, notes)
    return leave_out_conjugate(answer, given) if given.imaginary else answer


@dataclass(eq=False)
class _Discovery:
    """Components that are looked for, and what was found so far.

    Attributes:
        slices: a point of each component, at least.
        hits: how often each point was found, by dimension and index.
        refused: number of singular points that deflation did not make regular.
    """

    reduction: Reduction
    slices: CommonSlices
    rng: np.random.Generator
    run: Run
    hits: Counter[tuple[int, int]] = field(default_factory=Counter)
    refused: int = 0
    counts: PathCounts = field(default=PathCounts())

    def from_random_points(self, starts: int) -> None:
        """Follow Newton's method from random points to components."""
        reduction, rng = self.reduction, self.rng
        for k in range(starts):
            self.run.tell("sampling", k, starts)
            start = complex_normal(rng, (reduction.n,)) * 2 ** rng.uniform(-2, 1)
            x = descend(reduction.equations.evaluator, start)
            if x is None or seem_excluded(reduction.nonzero, x[None], np.array([CLOSE]))[0]:
                continue
            place = self._simple(x)
            if place is None and self.refused < MOST_REFUSALS:
                place = self._multiple(x)
                self.refused += place is None
            if place is not None:
                self.hits[place] += 1

    def _simple(self, x: np.ndarray) -> tuple[int, int] | None:
        """The place of the point that a point near a reduced component leads to."""
        equations, flag = self.slices.equations, self.slices.flag
        if not equations.polynomials:
            d, space = equations.n, whole_space(flag)
            cut = self.slices.points[d].cuts[0] if d in self.slices.points else space.cut
            self.slices, place = self.slices.with_point(cut, space.points[0], d, ROUNDED)
            return d, place
        zero = polish(equations.evaluator, x)
        if not zero.converged:
            return None
        return self._brought(GivenPoint(zero.x, LEAST, [zero.corank], False))

    def _multiple(self, x: np.ndarray) -> tuple[int, int] | None:
        """The same from a point near a component that is not reduced."""
        evaluator = self.slices.equations.evaluator
        near = descend(evaluator, x, close=ARRIVED)
        if near is None:
            return None
        most = largest_corank(evaluator.balanced_jacobian(near), NEARLY_SINGULAR)
        return self._brought(GivenPoint(near, MULTIPLE, range(most - 1, -1, -1), True))

    def _brought(self, start: GivenPoint) -> tuple[int, int] | None:
        self.slices, place, spent = self.slices.with_start(start, self.rng, self.run)
        self.counts += spent
        return place

    def notes(self, starts: int, found: Assembly, sides: int) -> list[str]:
        """What a reader must know of components that were found.

        Args:
            sides: 2 where those on which the last coordinate is -i are left out of the answer.
        """
        met = [
            sum(self.hits[component.dimension, int(i)] for i in indices)
            for component, indices in zip(found.components, found.indices, strict=True)
            if sides == 1 or has_unit(component.points).any()
        ]
        notes = [
            f"found by sampling: Newton's method arrived at a component from {sum(met)} "
            f"of {starts} random points; components may be missing"
        ]
        once = met.count(1)
        if once:
            notes.append(f"{once} of {len(met)} components were met only once")
        if self.refused:
            notes.append(f"{self.refused} singular points could not be made regular")
        return notes


def _with_orbits(
    system: PolynomialSystem,
    components: Sequence[WitnessSet],
    symmetries: Sequence[SignedPermutation],
    run: Run,
) -> tuple[list[WitnessSet], list[str], PathCounts]:
    """One component of each orbit, those included that were not met, and what to say of it."""
    whole = [c for c in components if c.status is Status.IRREDUCIBLE]
    if not whole:
        return list(components), [], PathCounts()
    try:
        orbits, counts = group_into_orbits(system, whole, symmetries, run=run)
    except ValueError as error:
        notes = [f"orbits of the symmetries are not known: {error}"]
        return list(components), notes, PathCounts()
    unmet = sum(c.orbit for c in orbits) - len(whole)
    notes = [f"{unmet} components were found by symmetry only"] if unmet else []
    found = [*orbits, *(c for c in components if c.status is not Status.IRREDUCIBLE)]
    return sorted(found, key=lambda c: (-c.dimension, c.degree)), notes, counts
