"""The irreducible components through given points, with all their witness points.

Where another model of the same set was decomposed, one point of each of its components is enough:
loops find the other points on the slice, and the trace says when these are all. Points that were
come by one by one are first brought to a common slice for each dimension.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.decomposition.assembly import assemble_components
from nag.decomposition.final_checks import judge_components
from nag.decomposition.orbits import group_into_orbits
from nag.decomposition.reduction import Reduction
from nag.numerics.coincidence import coincident
from nag.numerics.doubles import MULTIPLE
from nag.numerics.zero_values import LEAST, ON
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.cutting import Cut, Equations
from nag.witness.fibres import Fibre, admit_end, move
from nag.witness.gauss_newton import polish
from nag.witness.points import Points
from nag.witness.slices import random_rows, rows_through, unit_complex
from nag.witness.witness import Decomposition, PathCounts, Status, WitnessSet


@dataclass(frozen=True, eq=False)
class GivenPoint:
    """A solution through which there is a component to be found.

    Attributes:
        x: the solution, with its relative error.
        dimensions: those that the component may have; the first fits in which ``x`` is regular.
        deflate: whether deflation may make it regular.
    """

    x: np.ndarray
    accuracy: float
    dimensions: Iterable[int]
    deflate: bool


@dataclass(frozen=True, eq=False)
class CommonSlices:
    """Points of components on the leading rows of one flag of slices.

    Attributes:
        equations: those that hold on the components.
        flag: shape ``(n, 1 + n)``.
        points: by dimension.
        errors: relative errors of the points of each dimension, shape ``(P,)``.
    """

    equations: Equations
    flag: np.ndarray
    points: Mapping[int, Points]
    errors: Mapping[int, np.ndarray]

    @classmethod
    def random(cls, equations: Equations, rng: np.random.Generator) -> CommonSlices:
        """A generic flag, without points."""
        return cls(equations, random_rows(rng, equations.n, equations.n), {}, {})

    def with_point(self, cut: Cut, z: np.ndarray, d: int, error: float) -> tuple[CommonSlices, int]:
        """With a point of dimension ``d``, unless it is there, and its index."""
        known, errors = self.points.get(d, Points(self.flag[:d])), self.errors.get(d, np.zeros(0))
        there = coincident(known.x, z[: cut.n], np.maximum(errors, error))
        if there.any():
            return self, int(there.argmax())
        points = {**self.points, d: known.with_point(cut, z)}
        errors = {**self.errors, d: np.append(errors, error)}
        return replace(self, points=points, errors=errors), len(known)

    def with_start(
        self, start: GivenPoint, rng: np.random.Generator, run: Run
    ) -> tuple[CommonSlices, tuple[int, int] | None, PathCounts]:
        """With the point that a solution leads to, and its dimension and index.

        These are None if it led to no component; then nothing changes.
        """
        local = self._local(start, rng)
        if local is None:
            return self, None, PathCounts()
        d = local.dimension
        z, error, counts = local.points[0], start.accuracy, PathCounts()
        if d:
            gamma = complex(unit_complex(rng))
            (ends,) = move([local], self.flag[:d], gamma, run)
            z, error, counts = ends.points[0], float(ends.accuracy[0]), ends.counts.judged_elsewhere
            if not ends.regular.all():
                return self, None, counts
        # A cut that leaves out an equation which only seems to hold gives itself away elsewhere.
        if self._residual(z[: local.cut.n]) > ON:
            return self, None, counts
        slices, place = self.with_point(local.cut, z, d, error)
        return slices, (d, place), counts

    def _residual(self, x: np.ndarray) -> float:
        return float(self.equations.evaluator.residuals(x[None]).max(initial=0.0))

    def _local(self, start: GivenPoint, rng: np.random.Generator) -> Fibre | None:
        """A fibre on a slice through a point that has it as a regular point there."""
        for d in start.dimensions:
            rows = rows_through(rng, d, start.x)
            cuts = self.points[d].cuts if d in self.points else ()
            fibres = [Fibre(c, rows, np.zeros((0, c.n + c.aux), dtype=complex)) for c in cuts]
            if admit_end(start.x, start.accuracy, fibres, self.equations, rows, rng, start.deflate):
                (fibre,) = (f for f in fibres if len(f))
                return fibre
        return None


def best_lifted(
    component: WitnessSet, lift: Callable[[np.ndarray], Sequence[complex] | np.ndarray]
) -> np.ndarray:
    """Of a component's witness points, the one that is smallest in other coordinates.

    Each of them leads to the whole component, but one that is large there, where a norm nearly
    vanishes or a slide goes far, is known to fewer digits.

    Args:
        component: in its own coordinates.
        lift: from a point to its other coordinates.
    """
    lifted = [np.array(lift(x), dtype=complex) for x in component.points]
    sizes = [float(np.abs(point).max(initial=0.0)) for point in lifted]
    return lifted[int(np.argmin(np.nan_to_num(sizes, nan=np.inf)))]


@takes_run
def components_through_points(
    system: PolynomialSystem,
    starts: Sequence[tuple[int, np.ndarray]],
    *,
    run: Run = DEFAULT_RUN,
    symmetries: Sequence[SignedPermutation] = (),
) -> Decomposition:
    """The components through solutions that are generic on them.

    Args:
        system: the equations.
        starts: for each component at least one point, with the component's dimension there.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.
        symmetries: signed permutations that keep the equations; of each orbit of components one is
            worked out.

    Returns:
        A decomposition that is complete if every point led to a component that was confirmed; it
        says nothing of components through none of the points.
    """
    rng = run.random(Stream.GIVEN_POINTS)
    reduction = Reduction.of(system, scaled=True)
    slices, counts, notes = _on_common_slices(starts, reduction, rng, run)
    found = assemble_components(slices.points, reduction, rng, run)
    counts += found.counts
    components: list[WitnessSet] = []
    for component in found.components:
        if component.status is Status.IRREDUCIBLE and symmetries:
            try:
                (component,), spent = group_into_orbits(system, [component], symmetries, run=run)
                counts += spent
            except ValueError:
                notes.append(
                    f"the orbit of a component of dimension {component.dimension} is not known"
                )
        components.append(component)
    return judge_components(system, components, counts, run, (*notes, *found.notes))


def _on_common_slices(
    starts: Sequence[tuple[int, np.ndarray]],
    reduction: Reduction,
    rng: np.random.Generator,
    run: Run,
) -> tuple[CommonSlices, PathCounts, list[str]]:
    """A point of each component on the common slice of its dimension, and what was not found."""
    slices = CommonSlices.random(reduction.equations, rng)
    counts, notes = PathCounts(), []
    for d, start in starts:
        x = reduction.frame.coordinates(np.asarray(start, dtype=complex))
        zero = polish(reduction.equations.evaluator, x)
        near, accuracy = (zero.x, LEAST) if zero.converged else (x, MULTIPLE)
        simple = zero.converged and zero.corank == d
        slices, place, spent = slices.with_start(
            GivenPoint(near, accuracy, [d], not simple), rng, run
        )
        counts += spent
        if place is None:
            notes.append(f"a point of dimension {d} led to no component")
    return slices, counts, notes
