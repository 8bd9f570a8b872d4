"""Singular points of a zero set: essential ones of each component, and where components meet.

Sigma(V) is the union of the singular sets of the components (essential singular points) and of
their pairwise intersections (intersection singular points); PT13, definition 7.2. Candidates are
where the Jacobian's rank drops on a component, and the components' intersections; each is judged at
a generic point of it by the multiplicities of the components there: a component is smooth at a
point exactly if its multiplicity is 1.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import combinations
from math import comb
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.algebra.fixed_mapping import fixed_mapping
from nag.algebra.given import check_listed
from nag.algebra.system import PolynomialSystem
from nag.decomposition.factor import IntersectionError, Operand
from nag.decomposition.intersection import intersect_factors
from nag.decomposition.linear_hull import add_hull_equations, mark_simple
from nag.decomposition.rank_drop import SetOfPoints, rank_drop
from nag.numerics.coincidence import SPREAD, coincident
from nag.numerics.doubles import ROUNDED
from nag.numerics.local_dimension import LocalDimension, local_dimension
from nag.numerics.natural_coordinates import NaturalCoordinates
from nag.numerics.read_only import ComplexArray, Several, equal_values, fixed_array
from nag.numerics.tangent_cone import TangentCone, tangent_cone
from nag.numerics.zero_values import all_vanish
from nag.text.json_text import pairs
from nag.text.table import data_frame, lines_of, one_line
from nag.tracking.run import DEFAULT_RUN, ENDED_EARLY, Run, Stream, takes_run
from nag.witness.change_of_coordinates import carry_decomposition, coordinates_of
from nag.witness.component_equations import (
    component_fibres,
    component_system,
    precise_point,
)
from nag.witness.frame import expand_orbits
from nag.witness.given_component import check_decomposition, check_index
from nag.witness.multiplicity import multiplicity_at
from nag.witness.witness import Decomposition, PathCounts, WitnessSet

if TYPE_CHECKING:
    import pandas

# Of its JSON document.
FORMAT = "nag-singular"
# More pairs of components are not intersected.
MOST_PAIRS = 150


@dataclass(frozen=True, eq=False)
class SingularSet(Several[ComplexArray]):
    """An irreducible set of singular points, or an isolated one.

    Attributes:
        dimension, degree: of the set.
        points: complex, shape ``(degree, n)``, on a generic slice.
        multiplicities: for each component through it, by its index, the component's multiplicity
            at a generic point of the set.
        local: tangent and local dimension of the whole zero set at a generic point.
        cone: the tangent cone of the whole zero set at an isolated point; None where it was not
            found, or the set is not isolated.
        imaginary: whether the last coordinate is the imaginary unit's, as of the system.
    """

    dimension: int
    degree: int
    points: ComplexArray
    multiplicities: Mapping[int, int | None]
    local: LocalDimension
    cone: TangentCone | None
    imaginary: bool = False

    __eq__ = equal_values

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", fixed_array(self.points))
        object.__setattr__(self, "multiplicities", fixed_mapping(self.multiplicities))

    @property
    def entries(self) -> ComplexArray:
        """The points."""
        return self.points

    def to_numpy(self) -> ComplexArray:
        """The points, complex, shape ``(degree, n)``, to be written to.

        As in frames, without the imaginary unit, which is the last variable of a system with
        complex coefficients.
        """
        return self.points[:, : self.points.shape[1] - self.imaginary].copy()

    def __repr__(self) -> str:
        return f"SingularSet(dimension={self.dimension}, degree={self.degree})"

    @property
    def essential(self) -> tuple[int, ...]:
        """Indices of the components that are singular there themselves."""
        return tuple(i for i, m in self.multiplicities.items() if (m or 0) > 1)

    @property
    def intersection(self) -> bool:
        """Whether several components meet there."""
        return len(self.multiplicities) > 1

    def rows(self, variables: Sequence[str]) -> list[tuple[str, str]]:
        """The point or set as labelled texts; components are numbered from 1.

        Args:
            variables: names of the coordinates, without that of an imaginary unit, the last one.
        """
        from nag.decomposition.shown import set_rows

        return set_rows(self, variables)

    def document(self, variables: Sequence[str]) -> dict[str, Any]:
        """The set as a JSON object; components are numbered from 1.

        Args:
            variables: names of all coordinates: `SingularLocus.variables` and, where coefficients
                are complex, the imaginary unit's behind them.
        """
        cone = self.cone
        return {
            "dimension": self.dimension,
            "degree": self.degree,
            "essential": [i + 1 for i in self.essential],
            "intersection": self.intersection,
            "multiplicities": [
                {"component": i + 1, "multiplicity": m or 0} for i, m in self.multiplicities.items()
            ],
            "points": pairs(self.points),
            "local": {**self.local.document(), "point": pairs(self.local.point)},
            "tangent_cone": None if cone is None else cone.document(variables),
        }


@dataclass(frozen=True, eq=False)
class SingularLocus(Several[SingularSet]):
    """The singular points of a zero set.

    Attributes:
        sets: by falling dimension.
        examined: indices of the components whose own singular points are all in ``sets``.
        paths: what the run did.
        complete: whether nothing was left open.
        notes: what was.
        proved: indices of components that exact algebra proves to be smooth.
        variables: names of the coordinates, without the imaginary unit.
        unit: name of the imaginary unit, whose coordinate comes last in points; empty where
            coefficients are real.
    """

    sets: tuple[SingularSet, ...]
    examined: tuple[int, ...]
    paths: PathCounts
    complete: bool
    notes: tuple[str, ...]
    proved: tuple[int, ...] = ()
    variables: tuple[str, ...] = ()
    unit: str = ""

    __eq__ = equal_values

    @property
    def entries(self) -> tuple[SingularSet, ...]:
        """The sets."""
        return self.sets

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each set: dimension, degree, and the components through it, from 1.

        Those that are singular there themselves are `essential`.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        return data_frame(
            {
                "dimension": [one.dimension for one in self.sets],
                "degree": [one.degree for one in self.sets],
                "components": [tuple(i + 1 for i in one.multiplicities) for one in self.sets],
                "essential": [tuple(i + 1 for i in one.essential) for one in self.sets],
            }
        )

    __repr__ = one_line

    def __str__(self) -> str:
        rows = [row for row in self.rows(len(self.examined)) if row[0]]
        return lines_of("SingularLocus", [*rows, *(("open", note) for note in self.notes)])

    @property
    def smooth(self) -> tuple[int, ...]:
        """Indices of the components that have no singular points of their own."""
        singular = {i for one in self.sets for i in one.essential}
        return tuple(i for i in self.examined if i not in singular)

    def rows(self, components: int) -> list[tuple[str, str]]:
        """How much there is, as labelled texts; which of so many components are smooth."""
        from nag.decomposition.shown import locus_rows

        return locus_rows(self, components)

    def document(self, components: Sequence[dict[str, Any]] | None = None) -> dict[str, Any]:
        """The singular points as a JSON object without its head; components are numbered from 1.

        Args:
            components: what is said of each component, if that is known.
        """
        variables = [*self.variables, *([self.unit] if self.unit else [])]
        return {
            "notes": list(self.notes),
            "variables": variables,
            "imaginary": self.unit or None,
            "components": None if components is None else list(components),
            "paths": asdict(self.paths),
            "proved": [i + 1 for i in self.proved],
            "examined": [i + 1 for i in self.examined],
            "smooth": [i + 1 for i in self.smooth],
            "sets": [one.document(variables) for one in self.sets],
        }


@dataclass(eq=False)
class _SingularSearch:
    """Points where something may be singular, and what was left open on the way to them.

    Attributes:
        with_equations: each component with the equations that say most of it.
    """

    whole: Decomposition
    with_equations: Sequence[tuple[PolynomialSystem, WitnessSet]]
    run: Run
    candidates: list[SetOfPoints] = field(default_factory=list)
    examined: list[int] = field(default_factory=list)
    proved: list[int] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    counts: PathCounts = field(default=PathCounts())
    _factors: dict[int, Operand] = field(default_factory=dict)

    def on_component(self, i: int) -> None:
        """Points of a component where the rank of its own equations drops."""
        (system, component), name = self.with_equations[i], f"component {i + 1}"
        if component.dimension == 0 and component.is_multiple:
            self.examined.append(i)
            each = component.points[:, None]
            self.candidates += [SetOfPoints(0, 1, x, component.accuracy, (i,)) for x in each]
            return
        if component.multiplicity != 1:
            self.notes.append(f"{name} is not reduced; its own singular points are not known")
            return
        try:
            found = rank_drop(system, component, run=self.run)
        except (IntersectionError, ValueError) as reason:
            self.notes.append(f"{name}: {reason}")
            return
        self.counts += found.paths
        self.notes += [f"{name}: {note}" for note in found.notes]
        if not found.notes:
            self.examined.append(i)
        if found.proved:
            self.proved.append(i)
        self.candidates += [replace(one, source=(i,)) for one in found.sets]

    def leave_open(self, i: int, dimension: int, judged: SingularSet | None) -> None:
        """A set on which the equations of a component lose rank, and it is smooth in general.

        Its own singular points on such a set are not told apart from the others there.
        """
        if i in self.examined and (judged is None or judged.multiplicities.get(i, 1) == 1):
            self.examined.remove(i)
            self.notes.append(
                f"component {i + 1}: its equations lose rank on a set of dimension {dimension} "
                "where it is smooth in general; at which points of that it is singular is not known"
            )

    def told(self) -> SingularLocus:
        """What is known by now: which components are smooth, and no singular points yet."""
        singular = {i for one in self.candidates for i in one.source}
        smooth = tuple(i for i in self.examined if i not in singular)
        own, unit = self.whole.system.own_variables, self.whole.system.unit
        notes = (ENDED_EARLY, *self.notes)
        return SingularLocus((), smooth, self.counts, False, notes, (), own, unit)

    def of_pair(self, i: int, j: int) -> None:
        """The intersection of two components that no common equations show."""
        try:
            factors = self._factor(i), self._factor(j)
            found = intersect_factors(*factors, run=self.run)
        except (IntersectionError, ValueError) as reason:
            self.notes.append(f"components {i + 1} and {j + 1}: {reason}")
            return
        self.counts += found.paths
        notes = [*found.notes, *(c.note for c in found.components if c.note)]
        self.notes += [f"components {i + 1} and {j + 1}: {note}" for note in notes]
        self.candidates += [
            SetOfPoints(
                c.dimension,
                c.degree,
                c.points,
                c.accuracy,
                (i, j),
                None if c.dimension or not c.fibres else precise_point(c),
            )
            for c in found.components
            if not c.note
        ]

    def _factor(self, i: int) -> Operand:
        """A component as one of several that are intersected with each other."""
        if i not in self._factors:
            self._factors[i] = Operand.in_branch(*self.with_equations[i])
        return self._factors[i]

    def of_pairs(self, chosen: Sequence[int]) -> None:
        """The intersections of the chosen components with all others that are not seen yet."""
        pairs = [
            (i, j)
            for i, j in combinations(range(len(self.whole.components)), 2)
            if (i in chosen or j in chosen) and self.unseen(i, j)
        ]
        if len(pairs) > MOST_PAIRS:
            self.notes.append(f"{len(pairs) - MOST_PAIRS} pairs of components were not intersected")
        for pair in pairs[:MOST_PAIRS]:
            self.of_pair(*pair)

    def unseen(self, i: int, j: int) -> bool:
        """Whether a pair's intersection may hold points where neither rank drops."""
        (system, first), (other, second) = self.with_equations[i], self.with_equations[j]
        if first.dimension == 0 or second.dimension == 0:
            return False
        return not (
            i in self.examined
            and j in self.examined
            and first.dimension == second.dimension
            and system == other
        )


@takes_run
@np.errstate(over="ignore", invalid="ignore")
def singular_locus(
    decomposition: Decomposition,
    *,
    only: Sequence[int] | None = None,
    run: Run = DEFAULT_RUN,
) -> SingularLocus:
    """The singular points of the components of a decomposition, and where components meet.

    PT13, definition 7.2: essential singular points of each component, where the Jacobian's rank
    drops, and intersection singular points.

    Args:
        decomposition: as `nag.decompose` returns it.
        only: indices of components of `nag.witness.frame.expand_orbits`; singular points of these
            and their intersections with all others are looked for. All of them by default.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The sets of singular points by falling dimension, each with points of shape
        ``(degree, n)``.

    Raises:
        ValueError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> from nag.decomposition import singular_locus
    >>> (node,) = singular_locus(nag.decompose("y^2 = x^2*(x + 1)")).sets
    >>> node.dimension, node.multiplicities, bool(abs(node.points).max() < 1e-12)
    (0, {0: 2}, True)
    """
    check_decomposition(decomposition)
    given = expand_orbits(decomposition)
    check_indices(only, len(given.components))
    natural = coordinates_of(given.system)
    whole = carry_decomposition(given, natural)
    chosen = list(range(len(whole.components))) if only is None else sorted(set(only))
    found, run = run.found, run.without_found
    own = _own_equations(whole, run.random(Stream.NULL_SPACES), run)
    search = _SingularSearch(whole, own, run)
    if found is not None:
        found(search.told())
    for i in chosen:
        search.on_component(i)
        if found is not None:
            found(search.told())
    search.of_pairs(chosen)
    rng = run.random(Stream.SINGULAR_POINTS)
    sets = _judge_candidates(search, rng, run)
    if not natural.is_identity:
        sets = tuple(_carry_back(one, natural, given.system) for one in sets)
    notes = tuple(dict.fromkeys(search.notes))
    examined, proved = tuple(search.examined), tuple(search.proved)
    own, unit = given.system.own_variables, given.system.unit
    return SingularLocus(sets, examined, search.counts, not notes, notes, proved, own, unit)


def _carry_back(
    one: SingularSet, natural: NaturalCoordinates, system: PolynomialSystem
) -> SingularSet:
    """A set that was found in natural coordinates, in those that were given."""
    back, cone = natural.inverse, one.cone
    points, x = back.points(one.points), back.points(one.local.point)
    # Errors there are relative to the sizes that the coefficients suggest, whatever the units.
    accuracy = None if one.local.tangent_dimension is None else ROUNDED
    local = local_dimension(system, x, accuracy=accuracy)
    if cone is not None:
        cone = tangent_cone(system, x, accuracy=accuracy)
    return replace(one, points=points, local=local, cone=cone)


def check_indices(only: Sequence[int] | None, count: int) -> None:
    """Make sure that indices of components are some.

    Raises:
        ValueError: if they are not.
    """
    if only is None:
        return
    check_listed(only, "only", "a list of indices of components")
    for i in only:
        check_index(i, "only", count)


def _own_equations(
    whole: Decomposition, rng: np.random.Generator, run: Run
) -> list[tuple[PolynomialSystem, WitnessSet]]:
    """The components, each with its branch of the system, or in its linear hull.

    What only cuts one component does not show where it meets others: that asks for all pairs.
    """
    systems = [component_system(whole.system, c) for c in whole.components]
    found = [
        (system, replace(c, system=system))
        for system, c in zip(systems, whole.components, strict=True)
    ]
    if comb(len(found), 2) > MOST_PAIRS:
        return [(system, mark_simple(system, c)) for system, c in found]
    return [add_hull_equations(system, c, rng, run) for system, c in found]


def _judge_candidates(
    search: _SingularSearch, rng: np.random.Generator, run: Run
) -> tuple[SingularSet, ...]:
    points: list[SingularSet] = []
    known, errors = np.zeros((0, search.whole.system.n), dtype=complex), np.zeros(0)
    seen: list[SetOfPoints] = []
    others: dict[tuple[object, ...], dict[tuple[int, ...], list[SingularSet]]] = {}
    for candidate in search.candidates:
        x, error = candidate.points[0], candidate.error
        if candidate.dimension == 0:
            same = np.flatnonzero(coincident(known, x, np.maximum(errors, error))).tolist()
            if not all(candidate.is_apart_from(seen[i]) for i in same):
                continue
        judged = _judge_candidate(search, candidate, rng, run)
        if candidate.dimension and len(candidate.source) == 1:
            search.leave_open(*candidate.source, candidate.dimension, judged)
        if judged is None:
            continue
        if candidate.dimension == 0:
            known, errors = np.vstack([known, x]), np.append(errors, error)
            seen.append(candidate)
            points.append(judged)
            continue
        key = (judged.dimension, judged.degree, tuple(judged.multiplicities.items()))
        others.setdefault(key, {}).setdefault(candidate.source, []).append(judged)
    # A set is found from each component through it; one of these finds all that are alike.
    sets = [one for by_source in others.values() for one in max(by_source.values(), key=len)]
    sets.sort(key=lambda one: (-one.dimension, one.degree))
    return (*sets, *points)


def _judge_candidate(
    search: _SingularSearch, found: SetOfPoints, rng: np.random.Generator, run: Run
) -> SingularSet | None:
    """What a candidate is; None if the components are smooth there and do not meet."""
    whole, x, error = search.whole, found.points[0], max(found.error, ROUNDED)
    local = local_dimension(whole.system, x, accuracy=error)
    if found.dimension == 0 and local.tangent_dimension is not None:
        if local.tangent_dimension == local.dimension:
            return None
        if coincident(x[None], local.point, error).any():
            x, error = local.point, ROUNDED
    multiplicities: dict[int, int | None] = {}
    for i, component in enumerate(whole.components):
        if _outside_hull(search.with_equations[i][0], x, error):
            continue
        # Doubles may take a point that is close to a component for one of it.
        equations = search.with_equations[i][0].polynomials
        if found.precise is not None and all_vanish(equations, found.precise) is False:
            continue
        if component.dimension == 0:
            if coincident(component.points, x, max(component.accuracy, error)).any():
                multiplicities[i] = component.multiplicity
            continue
        # A multiple component is simple in equations of its own.
        own = search.with_equations[i] if component.multiplicity != 1 else (whole.system, component)
        m = _multiplicity(*own, x, error, rng, run)
        if m is None:
            search.notes.append(f"the multiplicity of component {i + 1} at a point is not known")
        elif m:
            multiplicities[i] = m
    if len(multiplicities) < 2 and {*multiplicities.values()} <= {1}:
        return None
    cone = None
    points = found.points
    if found.dimension == 0:
        cone, points = tangent_cone(whole.system, x, accuracy=error), x[None]
    unit = whole.system.imaginary
    return SingularSet(found.dimension, found.degree, points, multiplicities, local, cone, unit)


def _outside_hull(system: PolynomialSystem, x: np.ndarray, accuracy: float) -> bool:
    """Whether a point is further from the zeros of a linear equation than it may be off."""
    error = SPREAD * accuracy * (1 + float(np.linalg.norm(x)))
    for f in system.polynomials:
        if f.degree == 1:
            slopes = sum(abs(complex(c)) for e, c in f.terms.items() if any(e))
            if abs(f(x.tolist(), complex)) > error * slopes:
                return True
    return False


def _multiplicity(
    system: PolynomialSystem,
    component: WitnessSet,
    x: np.ndarray,
    error: float,
    rng: np.random.Generator,
    run: Run,
) -> int | None:
    try:
        fibres = component_fibres(system, component)
    except ValueError:
        return None
    return multiplicity_at(x, error, fibres, rng, run)
