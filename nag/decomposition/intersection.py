"""Intersections of components with each other and with equations.

A component meets further equations by u-generation that starts from its witness set; two components
meet on the diagonal of their product. Neither needs the components to be different or reduced.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.given import check_type
from nag.algebra.imaginary_unit import in_variables_with_unit, restore_unit
from nag.algebra.system import PolynomialSystem
from nag.decomposition.assembly import assemble_components
from nag.decomposition.diagonal import meet_on_diagonal
from nag.decomposition.factor import NOT_MOVED, IntersectionError, Operand, move_to_flag
from nag.decomposition.final_checks import judge_components
from nag.decomposition.reduction import Reduction
from nag.decomposition.superset import (
    Superset,
    intersection_order,
    witness_superset,
)
from nag.numerics.double_ranks import NEARLY_SINGULAR, corank_on_component
from nag.numerics.natural_coordinates import NaturalCoordinates
from nag.numerics.zero_values import LEAST, ON
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.change_of_coordinates import carry_component, coordinates_of
from nag.witness.component_equations import component_system
from nag.witness.cutting import Equations
from nag.witness.fibres import Fibre, admit_end
from nag.witness.given_component import check_component, check_system
from nag.witness.moving import orthonormal_rows
from nag.witness.points import Points
from nag.witness.slices import random_rows
from nag.witness.witness import (
    DOUBLE,
    Decomposition,
    PathCounts,
    Status,
    WitnessSet,
    even_radii,
)

__all__ = [
    "IntersectionError",
    "intersect_components",
    "intersect_equations",
]


@takes_run
@np.errstate(over="ignore", invalid="ignore")
def intersect_components(
    system: PolynomialSystem,
    first: WitnessSet,
    second: WitnessSet,
    *,
    run: Run = DEFAULT_RUN,
) -> Decomposition:
    """The irreducible components of the intersection of two components, as sets.

    They meet on the diagonal of their product (Sommese, Verschelde & Wampler 2004). The answer's
    system are all equations that are known to hold on it; its zero set may be larger: components of
    one system meet where that system's own equations say nothing new. A component's multiplicity is
    1 where these equations cut it as a reduced one, else 0, not known.

    Args:
        system: the equations that ``first`` was found from.
        first: one of the components of a `nag.Decomposition`.
        second: one of the same system, or of one in the same variables that it knows.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        IntersectionError: if the variables differ, or witness points are none.
        ValueError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> from nag.decomposition import intersect_components
    >>> surfaces = nag.decompose("(x^2 + y^2 - z)*(x - y)")
    >>> parabola = intersect_components(surfaces.system, *surfaces.components)
    >>> [(c.dimension, c.degree) for c in parabola.components]
    [(1, 2)]
    """
    check_component(system, first, "first")
    check_type(second, WitnessSet, "second", "a component, as nag.decompose finds them")
    other = system if second.system is None else second.system
    _check_variables(system, other)
    factors = Operand.in_branch(system, first), Operand.in_branch(other, second)
    answer = intersect_factors(*factors, run=run)
    return _knowing_the_unit(answer) if system.imaginary else answer


def _knowing_the_unit(answer: Decomposition) -> Decomposition:
    """What complex equations have in common, as components of such."""
    return replace(answer, system=restore_unit(answer.system))


@np.errstate(over="ignore", invalid="ignore")
def intersect_factors(first: Operand, second: Operand, *, run: Run) -> Decomposition:
    """`intersect_components` for components whose equations have been looked at before.

    Raises:
        IntersectionError: if witness points are none.
    """
    whole = _union(first.reduction.system, second.reduction.system)
    natural = coordinates_of(whole)
    common = Reduction.of(natural.system(whole))
    rng = run.random(Stream.INTERSECTION)
    if any(f and f.degree == 0 for f in common.reduced.polynomials):
        # Linear equations of both contradict each other, exactly.
        nothing = judge_components(common.system, (), PathCounts(), run)
        return _carry_back(nothing, (), whole, natural)
    first, second = first.carry(natural), second.carry(natural)
    found = meet_on_diagonal(first, second, common, rng, run)
    result = _intersection(common, found.points, found.counts, found.doubts, rng, run)
    bare = [_bare_point(x, accuracy, common) for x, accuracy in found.bare]
    return _carry_back(result, (*result.components, *bare), whole, natural)


def _carry_back(
    result: Decomposition,
    components: Sequence[WitnessSet],
    system: PolynomialSystem,
    natural: NaturalCoordinates,
) -> Decomposition:
    """An answer with these components, in the coordinates that were given."""
    return replace(
        result,
        system=system,
        components=tuple(
            carry_component(c, natural.inverse, system, back=True) for c in components
        ),
        complete=result.complete and not any(c.note for c in components),
    )


@takes_run
@np.errstate(over="ignore", invalid="ignore")
def intersect_equations(
    system: PolynomialSystem,
    component: WitnessSet,
    equations: PolynomialSystem,
    *,
    run: Run = DEFAULT_RUN,
) -> Decomposition:
    """The irreducible components of the intersection of a component with a zero set.

    The equations are met one by one, from the component's witness set (u-generation: Duff, Leykin
    & Rodriguez 2022).

    Args:
        system: the equations that ``component`` was found from.
        component: one of the components of a `nag.Decomposition`.
        equations: further equations in the same variables.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        IntersectionError: if the variables differ, or witness points are none.
        ValueError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> from nag.decomposition import intersect_equations
    >>> bowl = nag.decompose("x^2 + y^2 = z")
    >>> level = nag.system("z = 1", "x y z")
    >>> circle = intersect_equations(bowl.system, bowl.components[0], level)
    >>> [(c.dimension, c.degree) for c in circle.components]
    [(1, 2)]
    """
    check_component(system, component)
    check_system(equations, "equations")
    if system.imaginary and equations.variables == system.own_variables:
        equations = in_variables_with_unit(equations, system.variables[-1])
    _check_variables(system, equations)
    imaginary = system.imaginary
    system = component_system(system, component)
    whole = _union(system, equations)
    natural = coordinates_of(whole)
    factor = Operand.of(system, component).carry(natural)
    common = Reduction.of(natural.system(whole))

    rng = run.random(Stream.COMMON_SLICES)
    superset = _meet_equations(factor, natural.system(equations), rng, run)
    notes, points = superset.doubts, {}
    for d, found in superset.fibres.items():
        if not found:
            continue
        points[d], lost = _in_common(found, factor, common, rng)
        if lost:
            notes.append(f"{lost} singular points of dimension {d} could not be made regular")
        if len(points[d]) + lost < sum(map(len, found)):
            notes.append(f"points of dimension {d} are too close to each other")
    answer = _intersection(common, points, superset.counts, notes, rng, run)
    answer = _carry_back(answer, answer.components, whole, natural)
    return _knowing_the_unit(answer) if imaginary else answer


def _meet_equations(
    factor: Operand, equations: PolynomialSystem, rng: np.random.Generator, run: Run
) -> Superset:
    """Witness points of all dimensions where a component meets equations, in its coordinates."""
    further = [f.compose(factor.reduction.images) for f in equations.polynomials]
    further = [f for f in dict.fromkeys(further) if f]
    further = [further[i] for i in intersection_order(further)]
    flag = random_rows(rng, factor.n, factor.n)
    start, spent = move_to_flag(factor.fibres(rng), flag, rng, run)
    if start is None:
        return Superset({}, spent, (NOT_MOVED,))
    reduced, d = factor.reduction.reduced, factor.component.dimension
    found = witness_superset(further, {d: start}, rng, run, reduced.polynomials, reduced.nonzero)
    return replace(found, counts=spent + found.counts)


def _in_common(
    found: Sequence[Fibre],
    factor: Operand,
    common: Reduction,
    rng: np.random.Generator,
) -> tuple[Points, int]:
    """Points on a slice, with cuts, in the coordinates of the intersection.

    Also the number of points for which none was found.
    """
    cut = factor.reduction.frame.slice(found[0].rows)
    rows = orthonormal_rows(common.frame.pulled_back(cut.A, cut.b))
    x = factor.reduction.frame.points(np.vstack([fibre.x for fibre in found]))
    fibres, lost = _with_cuts(x[:, common.kept], common.equations, rows, rng)
    return Points.of(fibres) if fibres else Points(rows), lost


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
    reduction: Reduction,
    points: Mapping[int, Points],
    counts: PathCounts,
    notes: Sequence[str],
    rng: np.random.Generator,
    run: Run,
) -> Decomposition:
    """The points of all dimensions, split into irreducible components."""
    found = assemble_components(points, reduction, rng, run, scheme=False)
    paths = counts + found.counts
    return judge_components(reduction.system, found.components, paths, run, (*notes, *found.notes))


def _bare_point(x: np.ndarray, accuracy: float, common: Reduction) -> WitnessSet:
    """An isolated point as a path's end left it, no system being known that sharpens it."""
    point = common.frame.points(x[None])
    residual = float(common.original.residuals(point).max(initial=0.0))
    note = "" if residual < max(ON, accuracy) else "the point does not satisfy all equations"
    return WitnessSet(
        slice=common.frame.slice(np.zeros((0, 1 + len(x)))),
        points=point,
        multiplicity=None,
        status=Status.UNDECIDED if note else Status.IRREDUCIBLE,
        residual=residual,
        radii=even_radii(point, common.frame.error(x[None], accuracy)),
        digits=[DOUBLE],
        corank=corank_on_component(common.equations.evaluator, x, 0, 0, NEARLY_SINGULAR),
        note=note,
    )


def _with_cuts(
    points: np.ndarray, equations: Equations, rows: np.ndarray, rng: np.random.Generator
) -> tuple[list[Fibre], int]:
    """The points with square systems that cut them, and the number for which none was found."""
    fibres: list[Fibre] = []
    lost = 0
    for x in points:
        if admit_end(x, LEAST, fibres, equations, rows, rng, deflate=False):
            continue
        lost += not admit_end(x, LEAST, fibres, equations, rows, rng, deflate=True)
    return fibres, lost
