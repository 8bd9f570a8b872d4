"""The mobility of a mechanism, or of parts that are assembled somehow, at a configuration."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any, Literal, get_args

import numpy as np

from nag.algebra.from_python import coordinates
from nag.algebra.given import Moving, check_choice, check_size, is_a
from nag.algebra.number import Number
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import quote
from nag.decomposition.curve_genus import GenusError, genus
from nag.decomposition.fibre_product import FibreProduct, find_fibre_product
from nag.decomposition.growth import grow_component, leave_singular_point
from nag.decomposition.through import through_points, zero_at
from nag.errors import MechanismError, NagError
from nag.interpolation.precise_samples import SourceError
from nag.mechanism import BUDGET, FORMULATIONS, PLATFORM_ALONE
from nag.mechanism.assembled import assemble_parts, bodies_of
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.axes import space_of
from nag.mechanism.body_on_component import find_body_freedoms
from nag.mechanism.bonds import BondError, Bonds, bonds, has_bonds
from nag.mechanism.graph import Mechanism, check_mechanism
from nag.mechanism.joint_chains import NotClear
from nag.mechanism.loops import gruebler_kutzbach, has_loops, loop_structure
from nag.mechanism.mobility_report import ALL_POSES, CurveOfMotion, MobilityReport
from nag.mechanism.model import Model
from nag.mechanism.moving_parts import find_moving_parts
from nag.mechanism.nearly_mobile import check_tolerance, find_near_motion, find_spoiled_motion
from nag.mechanism.parts import PARTS, model_parts
from nag.mechanism.path_estimates import LEAST_SECONDS, MOST_DECOMPOSED, fewest_estimated_paths
from nag.mechanism.problem import Problem, in_real_coordinates, problem_of
from nag.mechanism.quaternion import R
from nag.mechanism.real_assemblies import (
    count_real,
    lines_of_real,
    no_assembly_text,
    obstacle,
    of_real_assemblies,
    real_assemblies,
    real_doubt,
    tangent_dimension_at,
)
from nag.mechanism.straight_lines import ForcedLines
from nag.numerics.doubles import EPS
from nag.numerics.local_dimension import exact_numbers, local_dimension_near
from nag.numerics.second_order import count_unreal_directions
from nag.numerics.zero_values import ON
from nag.real.real_through import is_real_through
from nag.text.table import count_text
from nag.tracking.run import DEFAULT_RUN, ENDED_EARLY, Run, Stream, takes_run
from nag.witness.frame import expand_orbits
from nag.witness.given_component import round_point
from nag.witness.membership import rounded_error
from nag.witness.witness import Decomposition, WitnessSet

# What components are known by.
SMOOTH = "one component passes through a smooth point, and is reduced there"
ONE_BRANCH = (
    "one component passes through a singular point whose tangent cone is irreducible, of the same "
    "dimension, and is reduced"
)
ISOLATED = "an isolated configuration is a component"
ALL_COMPONENTS = "a decomposition of all configurations"


class NoAssembly(MechanismError):
    """Parts that cannot be assembled, with the reason."""


Detail = Literal["local", "through", "components", "curves"]


@takes_run
def mobility(
    mechanism: Moving,
    point: Sequence[Any] | Mapping[str, Any] | None = None,
    *,
    formulation: str = "auto",
    detail: Detail = "through",
    budget: float = BUDGET,
    of: str | None = None,
    tolerance: float | None = None,
    run: Run = DEFAULT_RUN,
) -> MobilityReport:
    """The mobility of a mechanism at its reference configuration, or at another one.

    That of parts which are not assembled is that of a general configuration, if no point is given.

    What counting predicts, the tangent and the local dimension (Wampler, Hauenstein & Sommese
    2011), and the components through the configuration. Where both dimensions agree, the
    configuration is a smooth point of exactly one component, which is reduced there; its degree is
    found from there.

    Args:
        mechanism: assembled, or parts that may be assembled (`nag.Case.assembly`), or a case or a
            problem of one of them.
        point: in the model's variables (``nag.model(mechanism).system.variables``), in order or by
            name; exact numbers as `nag.Joint` takes them, or doubles.
        formulation: of a mechanism's model, as for `nag.model`.
        detail: ``"local"`` for what needs no component, ``"through"`` for those through the
            configuration as well, ``"components"`` to find these by a decomposition of all that
            there are, ``"curves"`` for genus and bonds of curves, too.
        budget: seconds that the degree may take at a smooth configuration, counted by what a common
            processor does in them, so that the answer does not depend on the time that is taken;
            what is not known then is bounded from below. At a singular one that is not isolated
            nothing is decomposed that is sure to take longer.
        of: the name of a body whose freedoms are asked for: of a mechanism, a link of a linkage or
            a table (``"link2"``), or a bar of a framework in the plane (``"A-B"``).
        tolerance: of what is rigid as it is given, at its reference configuration or at a real
            assembly of its parts: how far its loops may open, in radians and as a part of its size,
            for it to be called nearly mobile.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.mechanism.model.ModelError: if the formulation does not cover the mechanism.
        nag.numerics.local_dimension.NoSolution: if an exact point is no configuration, not even to
            rounding.
        NoAssembly: if parts cannot be assembled.
        ValueError: if parts are to be looked at without a decomposition where no assembly is known,
            or another argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> print(nag.mobility(nag.read_case("cases/bennett.toml").mechanism))
    mobility    overconstrained: it moves with 1 freedom, though counting predicts -2
    counted     -2 by Gruebler-Kutzbach (spatial)
    model       1 equation in 2 unknowns, formulation H
    local       tangent dimension 1, local dimension 1
    components  1 through the configuration: dimension 1, degree 2
    degree      belongs to the coordinates, here formulation H; in others it may be another
    """
    *_, report = mobility_in_steps(
        mechanism,
        point,
        formulation=formulation,
        detail=detail,
        budget=budget,
        of=of,
        tolerance=tolerance,
        run=run,
    )
    return report


@takes_run
def mobility_in_steps(
    mechanism: Any,
    point: Sequence[Any] | Mapping[str, Any] | None = None,
    *,
    formulation: str = "auto",
    detail: Detail = "through",
    budget: float = BUDGET,
    of: str | None = None,
    tolerance: float | None = None,
    run: Run = DEFAULT_RUN,
) -> Iterator[MobilityReport]:
    """The same, as far as it is known: what needs no component first, then the whole."""
    found, run = run.found, run.without_found
    check_choice(detail, "detail", get_args(Detail))
    check_size(budget, "budget")
    if tolerance is not None:
        check_tolerance(tolerance)
    tree = tree_of(mechanism)
    if tree is not None:
        check_body(of, tree)
        first = _without_loops(tree)
        yield _with_moving(first, tree, None, of, run)
        return
    problem = None
    if point is None and formulation == "auto":
        problem = product_of_loops(mechanism, detail, run)
    problem = problem or problem_of(mechanism, formulation=formulation)
    if problem.model is None:
        check_mechanism(problem.system, PARTS)
    made = problem.mechanism
    check_body(of, problem.parts if made is None else made.mechanism)
    at = problem.reference
    if problem.formulation == PLATFORM_ALONE:
        _check_poses(at, point)
    if point is not None:
        at = coordinates(point, problem.system.variables)
    if at is None:
        yield _in_general(problem, detail, of, tolerance, run)
        return
    first = _local_report(problem, at, run)
    if made is not None:
        first = _with_parts(first, made, point is None, at, of, tolerance, run)
    elif of is not None and problem.parts is not None:
        there = assemble_parts(problem.parts, None if point is None else at)
        first = _with_moving(first, there, None, of, run)
    yield first
    if found is not None and detail != "local":
        found(replace(first, open=ENDED_EARLY))
    if detail == "local":
        return
    curve = None
    if detail != "components" and point is None and first.local.smooth:
        curve = _product_of(problem, run)
    if curve is not None:
        yield _with_product(first, problem, curve)
    else:
        yield _with_components(first, problem, at, detail, budget, of, run)


def _check_poses(reference: Sequence[Number] | None, point: Any) -> None:
    """Whether the mobility at a configuration is seen in the platform's poses.

    Raises:
        MechanismError: if it is not.
    """
    others = ", ".join(FORMULATIONS)
    if point is not None:
        raise MechanismError(
            f"formulation {PLATFORM_ALONE}: a pose is no configuration of the joints; leave the "
            f"point out, or take one of the formulations {others}"
        )
    if reference is None:
        raise MechanismError(
            f"formulation {PLATFORM_ALONE}: the reference is a singular configuration of a leg, so "
            f"that the platform's poses do not tell the mobility; take one of {others}"
        )


def tree_of(given: Any) -> Mechanism | None:
    """The mechanism that is given, if it has no loops, so that it has no equations.

    Raises:
        MechanismError: if what is given is no mechanism, no parts and no problem.
    """
    mechanism = model_parts(given)
    if not isinstance(mechanism, Problem | Model | AssemblyModel | PolynomialSystem):
        check_mechanism(mechanism, PARTS)
        return None if has_loops(mechanism) else mechanism
    return None


def product_of_loops(
    given: Any, detail: Detail = "through", run: Run = DEFAULT_RUN
) -> Problem | None:
    """The problem of a mechanism in half-angles, where these say without paths what is asked for.

    None for any other, and for what is no mechanism at its reference configuration.
    """
    if detail not in ("through", "curves") or not _has_four_bars(given):
        return None
    try:
        problem = problem_of(given, formulation="H")
    except MechanismError:
        return None
    return None if _product_of(problem, run) is None else problem


def _product_of(problem: Problem, run: Run) -> FibreProduct | None:
    """The curve through the reference, where it is known without paths, with its degree."""
    if problem.formulation != "H" or problem.reference is None:
        return None
    found = _fibre_product(problem.system, tuple(problem.reference), run.seed)
    known = found is not None and found.factors > 1 and found.degree is not None
    return found if known else None


@lru_cache(maxsize=8)
def _fibre_product(
    system: PolynomialSystem, at: tuple[Number, ...], seed: int
) -> FibreProduct | None:
    """It is asked for before a model is chosen, and when the answer is made."""
    return find_fibre_product(system, at, Run(seed=seed).random(Stream.FIBRE_PRODUCT))


def _has_four_bars(given: Any) -> bool:
    """Whether what is given is a mechanism with several loops, each of four turns."""
    mechanism = model_parts(given)
    if not isinstance(mechanism, Mechanism):
        return False
    loops = loop_structure(mechanism).loops
    joints = [loop.joints for loop in loops]
    return len(loops) > 1 and all(
        len(own) == 4 and all(j.of_type.turns_only for j in own) for own in joints
    )


def _with_product(first: MobilityReport, problem: Problem, curve: FibreProduct) -> MobilityReport:
    """A report of a smooth configuration on a curve that is known without paths."""
    loops = count_text(curve.factors, "loop")
    why = f"{SMOOTH}; exactly, as a product of the curves of {loops} over the turns that they share"
    return replace(
        first,
        components=((1 + problem.free, curve.degree),),
        multiplicities=(1,),
        real=(True,),
        curves=(CurveOfMotion(curve.degree, curve.genus, None),),
        rests_on=why,
    )


def _local_report(problem: Problem, at: Sequence[Number], run: Run) -> MobilityReport:
    found = local_dimension_near(problem.system, at, seed=run.seed)
    free, tangent = problem.free, found.tangent_dimension
    unreal = 0
    if found.dimension and not found.smooth and not problem.system.isotropic:
        unreal = count_unreal_directions(problem.system, found.point, tangent or 0, found.dimension)
    return MobilityReport(
        **_count_freedoms(problem),
        tangent_dimension=None if tangent is None else tangent + free,
        lower=found.lower + free,
        upper=found.upper + free,
        components=None,
        open="",
        local=found,
        unreal=unreal,
    )


def check_body(of: str | None, given: Mechanism | AssemblyModel | None) -> None:
    """That a body whose freedoms are asked for is there.

    Raises:
        MechanismError: if it is not.
    """
    if of is None:
        return
    if given is None:
        raise MechanismError("of: is for mechanisms, whose bodies have names; leave it out")
    known = given.body_names if isinstance(given, Mechanism) else bodies_of(given)
    if of not in known:
        raise MechanismError(f"of: {quote(of)} is no body; they are {', '.join(known)}")


def _with_parts(
    first: MobilityReport,
    made: Model,
    at_reference: bool,
    at: Sequence[Number],
    of: str | None,
    tolerance: float | None,
    run: Run,
) -> MobilityReport:
    """A report, and what moves, or would move if the loops of a rigid mechanism were let open."""
    if first.local_dimension == 0:
        if not at_reference:
            return first
        if tolerance is not None:
            return replace(first, near=find_near_motion(made.mechanism, tolerance))
        shaky = first.tangent_dimension != 0
        return first if shaky else replace(first, hint=find_spoiled_motion(made.mechanism))
    places = None if at_reference else _places(made, at)
    moving = _with_moving(first, made.mechanism, places, of, run)
    if tolerance is None or not at_reference or moving.moving is None:
        return moving
    alone = (*moving.moving.idle, *moving.moving.hanging)
    if sum(part.count for part in alone) != first.local_dimension:
        return moving
    # Rigid apart from what moves by itself, which stands still while the loops are opened.
    in_loops = {b for j in loop_structure(made.mechanism).joints for b in j.bodies}
    idle = {part.bodies: part.count for part in alone if in_loops & set(part.bodies)}
    return replace(moving, near=find_near_motion(made.mechanism, tolerance, idle))


def _places(made: Model, at: Sequence[Number]) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """How the bodies are displaced against the reference configuration."""
    here, reference = made.lift(at), made.lift(made.reference)
    found = {}
    for body, euler in here.euler.items():
        turns = [
            np.array([[complex(x).real for x in row] for row in R(q)])
            for q in (euler, reference.euler[body])
        ]
        place = np.array([complex(x).real for x in here.position[body]])
        found[body] = (turns[0] @ turns[1].T, place)
    return found


def _with_moving(
    report: MobilityReport,
    mechanism: Mechanism,
    places: Mapping[str, tuple[np.ndarray, np.ndarray]] | None,
    of: str | None,
    run: Run,
) -> MobilityReport:
    """A report, and what moves near the configuration, or why that is not known."""
    if report.local_dimension is None:
        return replace(report, unclear="the local dimension is not decided")
    if report.unreal:
        return replace(report, unclear="no real motion has all of its freedoms")
    try:
        moving = find_moving_parts(
            mechanism, report.local_dimension, run.random(Stream.MOVING_PARTS), places, of
        )
    except NotClear as reason:
        return replace(report, unclear=str(reason))
    return replace(report, moving=moving)


def _with_components(
    first: MobilityReport,
    problem: Problem,
    at: Sequence[Number],
    detail: Detail,
    budget: float,
    of: str | None,
    run: Run,
) -> MobilityReport:
    """A report, and the components through the configuration.

    Where it is not known how a body moves near it, how it does along each of them.
    """
    if detail == "through" and first.local.smooth:
        return _with_only_component(first, problem, first.local.point, SMOOTH, budget, run)
    if detail == "through" and first.local.upper == 0:
        return replace(first, components=((problem.free, 1),), real=(True,), rests_on=ISOLATED)
    if detail == "through":
        beside = leave_singular_point(
            problem.system, at, first.local, run.random(Stream.BESIDE_SINGULAR)
        )
        if beside is not None:
            return _with_only_component(first, problem, beside, ONE_BRANCH, budget, run)
    paths = fewest_estimated_paths(problem.system)
    singular = detail == "through" and not first.local.smooth
    beyond = paths * LEAST_SECONDS > budget
    if singular and (beyond or paths > MOST_DECOMPOSED):
        at_reference = problem.reference is not None and tuple(at) == tuple(problem.reference)
        known = _with_components_by_poses(first, problem, budget, of, run) if at_reference else None
        if known is not None:
            return known
    if singular and beyond:
        reason = (
            f"the configuration is singular, and a decomposition takes some {paths:.0e} paths, "
            f"more than a budget of {budget:g} s allows"
        )
        return replace(first, open=reason)
    zero = zero_at(problem.system, at, first.local)
    through, doubt = _components(problem, zero, run)
    if through is None and first.local.smooth:
        only = _with_only_component(first, problem, first.local.point, SMOOTH, budget, run)
        return replace(only, open=doubt if only.least_degree is not None else "")
    free = problem.free
    known = None if through is None else tuple((c.dimension + free, c.degree) for c in through)
    curves = [c for c in through or () if c.dimension == 1] if detail == "curves" else []
    whole = replace(
        first,
        components=known,
        open=doubt,
        curves=tuple(_curve(problem, c, run) for c in curves),
        rests_on="" if known is None else ALL_COMPONENTS,
        multiplicities=tuple(c.multiplicity for c in through or ()),
        real=_find_real_ones(problem.system, through or (), zero, first.local.smooth, run),
    )
    return _with_body_along(_bound_real_dimension(whole), problem.mechanism, through or (), of, run)


def _with_body_along(
    report: MobilityReport,
    made: Model | None,
    through: Sequence[WitnessSet],
    of: str | None,
    run: Run,
) -> MobilityReport:
    """A report, and how a body moves along each of the components, where that is not known yet."""
    if of is None or made is None or report.moving is not None or not through:
        return report
    try:
        along = tuple(find_body_freedoms(made, c, of, run) for c in through)
    except (NotClear, SourceError) as reason:
        return replace(report, unclear=str(reason))
    return replace(report, along=along)


def _find_real_ones(
    system: PolynomialSystem,
    through: Sequence[WitnessSet],
    zero: Sequence[Number | complex],
    smooth: bool,
    run: Run,
) -> tuple[bool | None, ...]:
    """Whether each of the components through a zero has real points of its dimension there."""
    at = round_point(zero)
    accuracy = EPS if exact_numbers(zero) is not None else rounded_error(system, at)
    if smooth or accuracy is None or at.imag.any():
        return ((True if smooth and not at.imag.any() else None),) * len(through)
    return tuple(is_real_through(system, c, at.real, accuracy, run) for c in through)


def _bound_real_dimension(report: MobilityReport) -> MobilityReport:
    """A report with the freedoms that no real motion has, if its largest components are not real.

    What is real of a component that is not lies where it meets its conjugate.
    """
    if report.local_dimension is None or not report.components or not report.real:
        return report
    pairs = zip(report.components, report.real, strict=True)
    largest = max(d - (real is False) for (d, _), real in pairs)
    return replace(report, unreal=max(report.unreal, report.local_dimension - largest))


def _with_components_by_poses(
    first: MobilityReport, problem: Problem, budget: float, of: str | None, run: Run
) -> MobilityReport | None:
    """A report, and the components through a parallel robot's reference, by its poses.

    None for other mechanisms, where a leg is not regular there, and where they are not known within
    the budget.
    """
    if problem.mechanism is None:
        return None
    try:
        poses = problem_of(problem.mechanism.mechanism, formulation=PLATFORM_ALONE)
    except NagError:
        return None
    if poses.reference is None or fewest_estimated_paths(poses.system) * LEAST_SECONDS > budget:
        return None
    local = local_dimension_near(poses.system, poses.reference, seed=run.seed)
    seen = tuple(x + poses.free for x in (local.tangent_dimension or 0, local.lower, local.upper))
    if seen != (first.tangent_dimension, first.lower, first.upper):
        return None
    zero = zero_at(poses.system, poses.reference, local)
    through, _ = _components(poses, zero, run)
    if through is None:
        return None
    report = replace(
        first,
        components=tuple((c.dimension + poses.free, c.degree) for c in through),
        real=_find_real_ones(poses.system, through, zero, local.smooth, run),
        rests_on=ALL_POSES,
    )
    return _with_body_along(_bound_real_dimension(report), poses.mechanism, through, of, run)


def _with_only_component(
    first: MobilityReport,
    problem: Problem,
    start: np.ndarray,
    why: str,
    budget: float,
    run: Run,
) -> MobilityReport:
    """A report of a configuration that one component passes through, and its degree.

    It is of the local dimension, and reduced, as at every smooth point.

    Args:
        start: a smooth point of it.
        why: no other passes through the configuration.
    """
    local = first.local
    whole = (local.lower + problem.free,)
    # A smooth real point has real neighbours of its component's dimension.
    if why == SMOOTH and not start.imag.any():
        first = replace(first, real=(True,))
    if not local.lower:
        return replace(first, components=((*whole, 1),), multiplicities=(1,), rests_on=why)
    # Multidegrees are not asked for.
    system = replace(problem.system, groups=())
    grown = grow_component(system, start, local.lower, seconds=budget, run=run)
    paths = f"by loops of {count_text(grown.paths.tracked, 'path')} from there"
    if grown.degree is not None:
        return replace(
            first,
            components=((*whole, grown.degree),),
            multiplicities=(1,),
            rests_on=f"{why}; its degree {paths}",
        )
    unknown = f"its degree {paths} within a budget of {budget:g} s: {grown.reason}"
    return replace(
        first,
        components=((*whole, None),),
        multiplicities=(1,),
        least_degree=grown.least,
        rests_on=f"{why}; {unknown}",
    )


def _in_general(
    problem: Problem, detail: str, of: str | None, tolerance: float | None, run: Run
) -> MobilityReport:
    """The mobility at a general configuration of parts that may be assembled."""
    if detail == "local":
        raise NagError("the parts are not assembled; give a point, an assembly of them")
    given, forced, problem = problem, lines_of_real(problem), of_real_assemblies(problem)
    found = problem.decompose(run=run)
    components = expand_orbits(found).components
    if found.complete and not components:
        raise NoAssembly(no_assembly_text(given))
    every = len(components)
    if found.complete and problem.parts is not None and not any(c.dimension for c in components):
        components = _with_real_ones(problem, components, forced)
    general = max(components, key=lambda c: (c.dimension, c.corank), default=None)
    known = general if found.complete else None
    free = problem.free
    tangent = None if known is None else known.corank
    if forced is not None and known is not None and problem.parts is not None:
        tangent = tangent_dimension_at(given, problem.parts, known.points[0])
    curves = [c for c in components if c.dimension == 1] if detail == "curves" else []
    doubt = ""
    if known is not None and known.dimension and problem.parts is not None:
        doubt = real_doubt(problem, [c for c in components if c.dimension], run)
    report = MobilityReport(
        **_count_freedoms(problem),
        tangent_dimension=None if tangent is None else tangent + free,
        lower=free + (0 if known is None else known.dimension),
        upper=free + (problem.system.n if known is None else known.dimension),
        components=tuple((c.dimension + free, c.degree) for c in components)
        if found.complete
        else None,
        open="" if found.complete else _incomplete(found),
        local=None,
        curves=tuple(_curve(problem, c, run) for c in curves),
        general=known,
        multiplicities=tuple(c.multiplicity for c in components) if found.complete else (),
        doubt=doubt,
        in_line="" if forced is None else forced.text,
        without_real=every - len(components),
        rests_on=ALL_COMPONENTS if found.complete else "",
    )
    if report.local_dimension == 0:
        # What is shaky gets no hint that it nearly moves.
        if known is None or problem.parts is None or (tangent and tolerance is None):
            return report
        return _with_near_motion(report, problem, components, tolerance)
    if of is None:
        return report
    if known is None or problem.parts is None:
        return replace(report, unclear="the components are not known")
    # Symmetries carry what is one and the same assembly to itself, if it has several points.
    each = found.components if problem.parts.points_of_each > 1 else components
    motions = sum(c.dimension == known.dimension for c in each)
    return _with_general_motion(report, problem, known.corank, motions, of, run)


def _with_real_ones(
    problem: Problem, components: Sequence[WitnessSet], forced: ForcedLines | None
) -> list[WitnessSet]:
    """Those of the finite components of parts that have real assemblies, where that is known.

    Raises:
        NoAssembly: if none has, which is proved.
    """
    parts = problem.parts
    assert parts is not None
    reason = obstacle(parts)
    if reason:
        raise NoAssembly(f"it cannot be assembled (proved): {reason}")
    number, real = count_real(problem, components)
    if real is None:
        return list(components)
    if real:
        return [c for c in components if any(parts.is_real(x) for x in c.points)]
    each = count_text(number, "complex one") if number > 1 else "the only complex one"
    what = f"none of {each} is" if number > 1 else f"{each} is not"
    where = "" if forced is None else f"; in one {forced.text}"
    raise NoAssembly(f"it cannot be assembled: {what} real{where}")


def _with_near_motion(
    report: MobilityReport,
    problem: Problem,
    components: Sequence[WitnessSet],
    tolerance: float | None,
) -> MobilityReport:
    """A report of parts that are rigid, and how they would move from a real assembly.

    From the first of these at which they are nearly mobile, or give a hint that they may be; else
    from the first of all.
    """
    framework = is_a(problem.parts, "nag.mechanism.framework_model", "FrameworkModel")
    if problem.parts is None or framework:
        return report
    points = [x for c in components for x in np.asarray(c.points)]
    real = [x.real.tolist() for x in points if np.abs(x.imag).max(initial=0) < ON]
    placed = (assemble_parts(problem.parts, x) for x in real)
    if tolerance is None:
        hint = next((text for m in placed if (text := find_spoiled_motion(m))), "")
        return replace(report, hint=hint)
    motions = []
    for mechanism in placed:
        motion = find_near_motion(mechanism, tolerance)
        if motion is not None:
            motions.append(motion)
            if motion.nearly_mobile:
                break
    motions.sort(key=lambda motion: not motion.nearly_mobile)
    return replace(report, near=motions[0]) if motions else report


def _with_general_motion(
    report: MobilityReport, problem: Problem, corank: int, motions: int, of: str, run: Run
) -> MobilityReport:
    """A report of a general configuration, and how a body moves there, if it is real.

    Args:
        corank: of the Jacobian there.
        motions: how many components have so many freedoms.
    """
    if motions > 1:
        return replace(
            report,
            unclear=f"{motions} components have {count_text(report.lower, 'freedom')}, and it may "
            "move in another way on each; give the point of one",
        )
    parts = in_real_coordinates(problem).parts
    assert parts is not None
    for zero in real_assemblies(parts, run.seed):
        if zero.corank != corank:
            continue
        there = _with_moving(report, assemble_parts(parts, zero.x.tolist()), None, of, run)
        if there.moving is None or there.moving.body is None:
            return there
        # What is so at this one alone is nothing that was asked for.
        body = replace(there.moving.body, screws=None)
        return replace(there, moving=replace(there.moving, body=body))
    return replace(report, unclear=report.doubt or "no real assembly was found that moves")


def _without_loops(mechanism: Mechanism) -> MobilityReport:
    counted = gruebler_kutzbach(mechanism)
    space = space_of(mechanism.joints)
    free = sum(j.freedoms_in(space) for j in mechanism.joints)
    return MobilityReport(space, counted, "", 0, 0, free, free, free, free, None, "", None)


def _components(
    problem: Problem, at: Sequence[Number], run: Run
) -> tuple[list[WitnessSet] | None, str]:
    """The components through a point, or why they are not known."""
    found = problem.decompose(run=run)
    if not found.complete:
        return None, _incomplete(found)
    through = through_points(found, [("the configuration", tuple(at))], run.threads)[0]
    if not through.solution or through.doubt:
        return None, through.doubt or "the configuration is a rounded one"
    everything = expand_orbits(found).components
    return [everything[i] for i in through.components], ""


def _count_freedoms(problem: Problem) -> dict[str, Any]:
    """What a report says of a problem, whatever was computed."""
    made = problem.model
    return {
        "space": problem.space,
        "gruebler_kutzbach": made.gruebler_kutzbach,
        "formulation": made.formulation_text,
        "variables": problem.system.n,
        "equations": len(problem.system.polynomials),
        "free": problem.free,
        "free_of": " and ".join(f"{count} by {whose}" for count, whose in made.freedoms_left_out),
        "zero_links": made.zero_links,
        "inexact": problem.system.inexact_text,
    }


def _incomplete(found: Decomposition) -> str:
    return f"the decomposition is incomplete: {'; '.join(found.notes)}"


def _curve(problem: Problem, component: WitnessSet, run: Run) -> CurveOfMotion:
    notes = []
    number: int | None = None
    try:
        number = genus(problem.system, component, run=run).genus
    except (GenusError, ValueError) as reason:
        notes.append(f"the genus, {reason}")
    connected: Bonds | None = None
    if has_bonds(problem.model):
        try:
            connected = bonds(problem.model, component, run=run)  # type: ignore[arg-type]
        except (BondError, ValueError) as reason:
            notes.append(f"the bonds, {reason}")
    return CurveOfMotion(component.degree, number, connected, "; ".join(notes))
