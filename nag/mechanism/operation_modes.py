"""The operation modes of a parallel robot: the components of the poses of its platform.

What is found of a mode: its dimension, degree and multiplicity; its equations where they are linear
or quadratic; whether it is real; what its poses have in common; whether every leg reaches it. And
of pairs of modes where they meet, the transitions.

References:
    Walter, Husty & Pfurner, A complete kinematic analysis of the SNU 3-UPU parallel robot, 2009;
    Schadlbauer, Walter & Husty, The 3-RPS parallel manipulator from an algebraic viewpoint, 2014.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations
from math import ceil
from typing import Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.exact_ranks import null_space
from nag.algebra.given import Moving, check_size
from nag.algebra.multipliers import order
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose
from nag.decomposition.intersection import intersect_components, intersect_equations
from nag.decomposition.through import through_points
from nag.errors import ComponentError, NagError
from nag.interpolation.image_forms import add_degree
from nag.interpolation.point_cloud import AmbientVariables, Cloud
from nag.interpolation.precise_samples import SourceError, source_of_component
from nag.interpolation.vanishing import (
    InterpolationError,
    forms_of_degree,
    leading_monomial,
    primitive,
)
from nag.mechanism import MODES_BUDGET
from nag.mechanism.graph import check_mechanism
from nag.mechanism.inverse_kinematics import (
    REACHED,
    find_reached_pose,
    reach_poses,
    shift_origin,
)
from nag.mechanism.isotropic_limits import is_isotropic_limit
from nag.mechanism.leg_image import (
    COORDINATES,
    MOST_DEGREE,
    Place,
    forms_about_origin,
    norm_form,
    study_quadric,
)
from nag.mechanism.legs import parallel_robot
from nag.mechanism.modes_report import (
    ModeReality,
    OperationMode,
    OperationModes,
    SpuriousComponent,
    Transition,
)
from nag.mechanism.motions import motion_of, screw_system, twists_at
from nag.mechanism.parts import mechanism_in
from nag.mechanism.path_estimates import LEAST_SECONDS, fewest_estimated_paths
from nag.mechanism.platform import LegEquations, PlatformModel, platform_model
from nag.numerics.coincidence import LEAST
from nag.numerics.double_ranks import NEARLY_SINGULAR, matrix_corank
from nag.numerics.zero_values import NONZERO
from nag.tracking.run import DEFAULT_RUN, ENDED_EARLY, Run, Stream, takes_run
from nag.witness.gauss_newton import descend
from nag.witness.membership import (
    Membership,
    UndecidedError,
    components_through,
    membership_in,
)
from nag.witness.projection import ProjectionError, project
from nag.witness.real_points import real_points_near
from nag.witness.witness import Decomposition, PathCounts, WitnessSet

# General poses at which twists are compared.
POSES = 3
# Real poses that are looked at, starting points for each where a mode is not linear, and how much
# nearer to the reference each is than the one before.
REAL_POSES, REAL_STARTS, NEARER = 4, 6, 0.3
UNITS = tuple(tuple(int(i == j) for j in range(8)) for i in range(8))


@takes_run
def modes(
    mechanism: Moving,
    platform: str | None = None,
    *,
    budget: float = MODES_BUDGET,
    run: Run = DEFAULT_RUN,
) -> OperationModes:
    """The operation modes of a parallel robot, from the platform's poses alone.

    Each leg is replaced by the equations of the poses that it lets the platform have, in Study
    coordinates; the components of their common zeros are the modes. Components of the joints'
    coordinates that stand still in the pose are not seen, as a rod that turns about itself.

    Args:
        mechanism: a `nag.Mechanism`, or a `nag.Case` or a model of one, with coordinates that are
            rational or sums of square roots.
        platform: name of the platform; by default the body of the most legs, three at least.
        budget: seconds; where the paths that are estimated take more at the least, none is
            tracked, and the answer has no modes and says why.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.MechanismError: if there is no such platform, or a leg is none.

    >>> import nag
    >>> found = nag.modes(nag.read_case("cases/robots/tripteron.toml"))
    >>> [(mode.dimension, mode.degree, str(mode.motion)) for mode in found.modes]
    [(3, 1, 'translation')]
    """
    *_, found = modes_in_steps(mechanism, platform, budget=budget, run=run)
    return found


@takes_run
def modes_in_steps(
    mechanism: Any,
    platform: str | None = None,
    *,
    budget: float = MODES_BUDGET,
    run: Run = DEFAULT_RUN,
) -> Iterator[OperationModes]:
    """The same, first without transitions, which may take longer than all else.

    Args:
        mechanism, platform, budget, run: as of `modes`, which raises the same.

    Yields:
        What is known of the modes, and the whole.
    """
    given = mechanism_in(mechanism)
    check_mechanism(given)
    check_size(budget, "budget")
    run.tell("legs", 0, 4)
    model = platform_model(parallel_robot(given, platform), run.random(Stream.PARALLEL_ROBOT))
    paths = fewest_estimated_paths(model.system)
    if paths * LEAST_SECONDS > budget:
        note = (
            f"up to {paths} paths, which take longer than a budget of {budget:g} s allows; one of "
            f"{ceil(paths * LEAST_SECONDS)} s or more tracks them, and nag mobility says "
            "without them what moves at the reference"
        )
        yield OperationModes(model, _no_answer(model, run, note), (), (), (), (note,))
        return
    run.tell("modes", 1, 4)
    inner = run.without_found

    def tell(decomposition: Decomposition, described: Mapping[int, OperationMode]) -> None:
        """Tell of the modes that are known, those that are not described yet without equations."""
        if run.found is not None:
            parts = enumerate(decomposition.components)
            early = tuple(described.get(k) or _make_bare_mode(c) for k, c in parts)
            run.found(_told(OperationModes(model, decomposition, early, (), (), (ENDED_EARLY,))))

    heard = inner if run.found is None else replace(inner, found=lambda d: tell(d, {}))
    components = decompose(model.system, run=heard)
    described = describe_modes(model, components, inner, partial(tell, components))
    yield _told(described)
    yield _told(find_transitions(described, inner))


def _told(found: OperationModes) -> OperationModes:
    """The modes in the coordinates that were given."""
    origin = found.model.origin
    return replace(found, modes=tuple(_carry_back(mode, origin) for mode in found.modes))


def _carry_back(mode: OperationMode, origin: Place) -> OperationMode:
    """A mode in the coordinates that were given: forms of poses, and the real pose."""
    forms = forms_about_origin((*mode.linear, *mode.quadratic), origin)
    forms = sorted(forms, key=lambda f: order(leading_monomial(f)))
    pose = mode.real_pose
    if pose is not None:
        pose = shift_origin(pose[None], -np.array([float(c) for c in origin]))[0]
    return replace(
        mode,
        linear=tuple(f for f in forms if f.degree == 1),
        quadratic=tuple(f for f in forms if f.degree == 2),
        real_pose=pose,
    )


def _no_answer(model: PlatformModel, run: Run, note: str) -> Decomposition:
    return Decomposition(
        system=model.system,
        components=(),
        paths=PathCounts(),
        seed=run.seed,
        settings=run.settings,
        order=(),
        complete=False,
        notes=(note,),
    )


def decompose_poses(model: PlatformModel, run: Run) -> Decomposition:
    """The components of a platform's poses that legs reach, or come as near to as one likes.

    Those that a leg is not known to reach are kept, and said to be open.
    """
    found = decompose(model.system, run=run)
    kept, notes = [], []
    reaches = _judge_reach(model, found, run)
    for component, reach in zip(found.components, reaches, strict=True):
        if reach.wrong:
            continue
        kept.append(component)
        kind = f"dimension {component.dimension}, degree {component.degree}"
        notes += [
            f"whether leg {model.legs[i].leg.name} reaches a component of {kind} is not known"
            for i in reach.open
        ]
    return replace(
        found,
        components=tuple(kept),
        complete=found.complete and not notes,
        notes=(*found.notes, *notes),
    )


@dataclass(frozen=True, eq=False)
class _Reach:
    """Which legs reach the general poses of a component.

    Attributes:
        pose: one of these, shape ``(8,)``.
        residuals: how near each leg comes to it; infinite for those of ``limits``.
        limits: the legs that come as near to it as one likes, and do not reach it.
        wrong: those that do not come near.
        open: those of which neither is known.
    """

    pose: np.ndarray
    residuals: tuple[float, ...]
    limits: tuple[int, ...]
    wrong: tuple[int, ...]
    open: tuple[int, ...]


def _judge_reach(model: PlatformModel, found: Decomposition, run: Run) -> list[_Reach]:
    """Which legs reach each component."""
    rng, length = run.random(Stream.MODE_POSES), model.length
    poses = np.array([model.study(c.points)[0] for c in found.components]).reshape(-1, 8)
    limits = _find_limits(model, poses, run)
    residuals = _residuals_beside(model, poses, limits, rng)
    judged = []
    for pose, near, own in zip(poses, limits, residuals.tolist(), strict=True):
        missing = [i for i, r in enumerate(own) if not r < REACHED and i not in near]
        wrong = tuple(i for i in missing if _misses(model, i, pose, length, rng))
        left = tuple(i for i in missing if i not in wrong)
        judged.append(_Reach(pose, tuple(own), near, wrong, left))
    return judged


def describe_modes(
    model: PlatformModel,
    found: Decomposition,
    run: Run,
    tell: Callable[[Mapping[int, OperationMode]], None],
) -> OperationModes:
    """What is to be said of the components of a platform's poses, each by itself.

    Args:
        tell: called with the modes that are described, by the indices of their components.
    """
    tell({})
    notes = list(found.notes)
    if not found.complete and not notes:
        notes.append("a component is undecided")
    run.tell("legs' reach", 2, 4)
    reaches = _judge_reach(model, found, run)
    through, doubt = _through_reference(model, found, run)
    notes += [doubt] if doubt else []
    mirrored = [_conjugate(found, k, run) for k in range(len(found.components))]
    run.tell("equations", 3, 4)
    known: dict[int, OperationMode] = {}
    spurious = []
    for k, component in enumerate(found.components):
        reach = reaches[k]
        if reach.wrong:
            name = model.legs[reach.wrong[0]].leg.name
            spurious.append(SpuriousComponent(component.dimension, component.degree, name))
            continue
        at = through and through[k]
        mode = _describe(model, component, mirrored[k], k, at, model.length, run)
        singular: tuple[int, ...] = ()
        if mode.component.is_multiple:
            pairs = enumerate(model.legs)
            singular = tuple(i for i, leg in pairs if leg.is_singular_at(reach.pose))
        mode = replace(mode, residuals=reach.residuals, limits=reach.limits, singular_legs=singular)
        if not any(_same_poses(model, mode, other, run) for other in known.values()):
            known[k] = mode
            tell(known)
    order = sorted(known, key=lambda k: _rank(known[k]))
    place = {k: i for i, k in enumerate(order)}
    described = tuple(
        replace(mode, conjugate=None if mode.conjugate is None else place.get(mode.conjugate))
        for mode in map(known.__getitem__, order)
    )
    notes += [
        f"whether leg {model.legs[i].leg.name} reaches mode {number} is not known"
        for number, mode in enumerate(described, 1)
        for i, r in enumerate(mode.residuals)
        if not r < REACHED and i not in mode.limits
    ]
    return OperationModes(model, found, described, tuple(spurious), (), tuple(notes))


def find_transitions(found: OperationModes, run: Run) -> OperationModes:
    """The same modes, and where they meet."""
    transitions = _transitions(found.model, found.modes, run)
    notes = (*found.notes, *(t.open_text for t in transitions if t.note))
    return replace(found, transitions=tuple(transitions), notes=notes)


def _rank(mode: OperationMode) -> tuple[Any, ...]:
    """By falling dimension and rising degree, those through the reference first, then simple ones.

    Neither random numbers nor where the robot stands have a say in it: kinds of motion come before
    equations, and these are in coordinates about it.
    """
    motion, texts = mode.motion, mode.equations
    kind = (
        (motion.turning, motion.rank, not motion.group, motion.group, motion.start)
        if motion is not None
        else ()
    )
    size = (sum(map(len, texts)), texts)
    return -mode.dimension, mode.degree, not mode.through_reference, mode.reality, kind, *size


def _residuals(
    model: PlatformModel,
    poses: np.ndarray,
    length: float,
    rng: np.random.Generator,
    real: bool = False,
    legs: Sequence[int] | None = None,
) -> np.ndarray:
    """How near each leg comes to each pose, or all to one real pose, shape ``(poses, legs)``."""
    legs = range(len(model.legs)) if legs is None else legs
    chains = [model.legs[i].leg.elements() for i in legs]
    return reach_poses(chains, poses, length, rng, real=real, one=real)


def _misses(
    model: PlatformModel, leg: int, pose: np.ndarray, length: float, rng: np.random.Generator
) -> bool:
    """Whether a form of one degree more vanishes on a leg's image and not at a pose."""
    image = model.legs[leg].image
    if model.legs[leg].kept or image.codimension <= 2 or image.degree >= MOST_DEGREE:
        return False
    point = pose / np.linalg.norm(pose / np.repeat([1.0, length], 4))
    for f in add_degree(image, rng).forms[len(image.forms) :]:
        powers = point[None] ** np.array(list(f.terms))
        terms = np.array([float(c) for c in f.terms.values()]) * powers.prod(axis=1)
        if abs(terms.sum()) > NONZERO * np.abs(terms).max():
            return True
    return False


def _find_limits(model: PlatformModel, poses: np.ndarray, run: Run) -> list[tuple[int, ...]]:
    """For each pose the legs that come as near to it as one likes, and do not reach it."""
    found: list[tuple[int, ...]] = [() for _ in poses]
    for i, leg in enumerate(model.legs):
        elements = leg.leg.elements()
        near = [k for k, pose in enumerate(poses) if is_isotropic_limit(elements, pose)]
        if near and _are_all_limits(model, leg, run):
            for k in near:
                found[k] += (i,)
    return found


def _are_all_limits(model: PlatformModel, leg: LegEquations, run: Run) -> bool:
    """Whether all zeros of a leg's equations are limits of poses that it reaches.

    These are a component of the zeros. One form has no others on Study's quadric, where factors are
    unique.
    """
    if leg.kept:
        return False
    if leg.image.codimension <= 2:
        return True
    alone = decompose(model.system_of(leg), run=run)
    return alone.complete and len(alone.components) == 1


def _residuals_beside(
    model: PlatformModel,
    poses: np.ndarray,
    limits: Sequence[tuple[int, ...]],
    rng: np.random.Generator,
) -> np.ndarray:
    """`_residuals` but of the legs that are known not to reach a pose, for which it is infinite."""
    found = np.full((len(poses), len(model.legs)), np.inf)
    for left_out in dict.fromkeys(limits):
        places = [k for k, own in enumerate(limits) if own == left_out]
        kept = [i for i in range(len(model.legs)) if i not in left_out]
        own = _residuals(model, poses[places], model.length, rng, legs=kept)
        found[np.ix_(places, kept)] = own
    return found


def _through_reference(
    model: PlatformModel, found: Decomposition, run: Run
) -> tuple[list[bool] | None, str]:
    """Whether each component is one through the reference, or why that is not known."""
    (through,) = through_points(found, [("the reference pose", model.reference)], run.threads)
    if through.doubt:
        return None, f"the reference pose: {through.doubt}"
    return [k in through.components for k in range(len(found.components))], ""


def _conjugate(found: Decomposition, k: int, run: Run) -> int | None:
    """The component of the conjugate points; None if that is not known."""
    component = found.components[k]
    alike = [
        i
        for i, c in enumerate(found.components)
        if (c.dimension, c.degree) == (component.dimension, component.degree)
    ]
    if len(alike) == 1:
        return k
    point = component.points[0].conj()
    if not component.dimension:
        apart = [np.abs(found.components[i].points[0] - point).max() for i in alike]
        return alike[int(np.argmin(apart))]
    try:
        on = components_through(found, point, accuracy=max(LEAST, component.accuracy), run=run)
    except UndecidedError:
        return None
    return on[0] if len(on) == 1 else None


def _make_bare_mode(component: WitnessSet) -> OperationMode:
    """A mode of which nothing is known but its component."""
    return OperationMode(
        component=component,
        dimension=component.dimension,
        degree=component.degree,
        linear=(),
        quadratic=(),
        note="it was not looked at",
        reality=ModeReality.UNKNOWN,
        conjugate=None,
        real_pose=None,
        motion=None,
        screws=None,
        through_reference=None,
        residuals=(),
        limits=(),
        real_residuals=(),
    )


def _describe(
    model: PlatformModel,
    component: WitnessSet,
    mirrored: int | None,
    index: int,
    through: bool | None,
    length: float,
    run: Run,
) -> OperationMode:
    """A mode, without what is asked of all of them at once."""
    mode = replace(
        _make_bare_mode(component),
        note="",
        conjugate=None if mirrored == index else mirrored,
        through_reference=through,
    )
    if not component.dimension:
        if mirrored != index:
            return replace(mode, reality=ModeReality.CONJUGATE)
        pose = model.study(component.points)[0].real
        return replace(mode, reality=ModeReality.REAL, real_pose=_normalise_real_parts(pose))
    mode = _with_equations(model, mode, length, run)
    if mode.is_linear:
        mode = replace(mode, conjugate=None)
    elif mirrored is None or mirrored != index:
        reality = ModeReality.UNKNOWN if mirrored is None else ModeReality.CONJUGATE
        return replace(mode, reality=reality)
    points = np.array(list(_real_points(model, mode, run)))
    if not len(points):
        # A real slice of what is its own conjugate has real points, if they are odd in number.
        odd = mirrored == index and component.degree % 2 == 1
        return replace(mode, reality=ModeReality.REAL) if odd else mode
    poses = _normalise_real_parts(model.study(points).real)
    residuals = _residuals(model, poses, length, run.random(Stream.REAL_POSES), real=True)
    # The pose that most legs reach, the first of several.
    best = int(np.argmin((residuals >= REACHED).sum(axis=1)))
    point, pose, near = points[best], poses[best], residuals[best]
    if near.max() >= REACHED:
        found = _reached_point(model, mode, pose, length, run)
        if found is not None:
            point, near = found
            pose = _normalise_real_parts(model.study(point[None]).real)[0]
    twists = _twists(model, point, _real_tangents(model, mode, point), length)
    return replace(
        mode,
        reality=ModeReality.REAL,
        real_pose=pose,
        screws=screw_system(twists.real, length),
        real_residuals=tuple(near.tolist()),
    )


def _reached_point(
    model: PlatformModel, mode: OperationMode, pose: np.ndarray, length: float, run: Run
) -> tuple[np.ndarray, np.ndarray] | None:
    """A smooth real point of a mode that all legs reach, looked for from a pose, with residuals.

    Of models that keep joints none is looked for.
    """
    if model.charts.n:
        return None
    rows = [[f.terms.get(e, 0) for e in UNITS] for f in mode.linear]
    basis = np.array([[float(c) for c in v] for v in null_space(rows, 8)])
    forms = Evaluator.of((study_quadric(), *mode.quadratic), 8)
    chains = [leg.leg.elements() for leg in model.legs]
    found = find_reached_pose(chains, basis, forms, pose, length, run.random(Stream.REACHED_POSE))
    if found is None:
        return None
    study, residuals = found
    chart = np.array([1.0, *(-float(c) for c in model.chart)])
    point = study[1:] / (study[:4] @ chart)
    smooth = matrix_corank(_jacobian(model.system, point), NEARLY_SINGULAR) == mode.component.corank
    on = membership_in(model.system, mode.component, point + 0j, REACHED, run)
    return (point, residuals) if smooth and on is Membership.MEMBER else None


def _normalise_real_parts(poses: np.ndarray) -> np.ndarray:
    """Real poses whose real parts have norm one."""
    return poses / np.linalg.norm(poses[..., :4], axis=-1, keepdims=True)


def _with_equations(
    model: PlatformModel, mode: OperationMode, length: float, run: Run
) -> OperationMode:
    """With equations, what poses have in common, and dimension and degree of the poses."""
    if model.charts.n:
        try:
            image = project(model.system, mode.component, range(7), run=run)
            mode = replace(mode, dimension=image.dimension, degree=image.degree)
        except ProjectionError as error:
            mode = replace(mode, note=f"the degree of its poses is not known: {error}")
    try:
        cloud = _cloud(model, mode.component, run)
        found = cloud.tangents(POSES)
        poses = model.study(np.array([point for point, _ in found]))
        about = np.array([float(c) for c in model.origin])
        twists = [_twists(model, *each, length) for each in found]
        motion = motion_of(poses, twists, length, about)
        mode = replace(mode, motion=motion)
        linear = tuple(forms_of_degree(cloud, range(8), 1, ()))
        study = _reduce_form(study_quadric(), linear)
        known = (*linear, *([primitive(study)] if study else []))
        quadratic = tuple(forms_of_degree(cloud, range(8), 2, known))
        return replace(mode, linear=linear, quadratic=quadratic)
    except InterpolationError:
        return replace(mode, note="its linear or quadratic equations are not rational")
    except SourceError as error:
        return replace(mode, note=str(error))


def _pose(model: PlatformModel) -> tuple[Polynomial, ...]:
    """Study coordinates as polynomials in the model's variables."""
    variables = Polynomial.variables(model.system.n)
    first = sum((x * c for x, c in zip(variables, model.chart, strict=False)), variables[0] * 0 + 1)
    return (first, *variables[:7])


def _cloud(model: PlatformModel, component: WitnessSet, run: Run) -> Cloud:
    """Points of a component in Study coordinates, and those of joints behind them."""
    system = model.system
    names = (COORDINATES[0], *system.variables)
    images = (*_pose(model), *Polynomial.variables(system.n)[7:])
    ambient = AmbientVariables.of(system, names, range(1, len(names)), images)
    return Cloud(
        source_of_component(system, component, False), ambient, run.random(Stream.MODE_CLOUD), run
    )


def _reduce_form(form: Polynomial, linear: Sequence[Polynomial]) -> Polynomial:
    """A form without the leading variables of reduced linear forms."""
    images = list(Polynomial.variables(8))
    for f in linear:
        lead = leading_monomial(f)
        images[lead.index(1)] -= f / f.terms[lead]
    return form.compose(images)


def _twists(
    model: PlatformModel, point: np.ndarray, tangents: np.ndarray, length: float
) -> np.ndarray:
    """An orthonormal basis of the twists at a point of the model, shape ``(d, 6)``."""
    poses = model.study(np.vstack([point, point + tangents]))
    return _orthonormal(twists_at(poses[0], poses[1:] - poses[0], length))


def _orthonormal(rows: np.ndarray) -> np.ndarray:
    """A basis of what rows span."""
    sizes = np.linalg.norm(rows, axis=1, keepdims=True)
    rows = rows / np.where(sizes > 0, sizes, 1)
    _, _, directions = np.linalg.svd(rows)
    return directions[: rows.shape[1] - matrix_corank(rows, NEARLY_SINGULAR)]


def _real_points(model: PlatformModel, mode: OperationMode, run: Run) -> Iterator[np.ndarray]:
    """Real points at which a mode is smooth, each one nearer to the reference if that is on it.

    They are looked for from zeros of the mode's own equations: from elsewhere Newton's method for
    those of the legs leads to other modes as well.
    """
    rng, n = run.random(Stream.MODE_SAMPLES), model.system.n
    reference = np.array([float(x) for x in model.reference])
    rows = [[f.terms.get(e, 0) for e in UNITS] for f in mode.linear]
    basis = np.array([[float(c) for c in v] for v in null_space(rows, 8)])
    chart = np.array([1.0, *(-float(c) for c in model.chart)])
    on_chart = Polynomial.of_doubles(8, {**dict(zip(UNITS, chart, strict=False)), (0,) * 8: -1.0})
    own = Evaluator.of((study_quadric(), on_chart, *mode.linear, *mode.quadratic), 8)
    for k in range(REAL_POSES):
        pose = rng.standard_normal(len(basis)) @ basis
        pose = pose / (pose[:4] @ chart)
        near = np.concatenate([pose[1:], rng.standard_normal(n - 7)])
        weight = NEARER**k if mode.through_reference else 1.0
        near = weight * near + (1 - weight) * reference
        if mode.is_linear and not model.charts.n:
            yield near
            continue
        on_own = descend(own, np.concatenate([[1 - chart[1:] @ near[:3]], near[:7]]))
        if on_own is not None:
            near[:7] = on_own[1:]
        real = real_points_near(model.system, mode.component, near, starts=REAL_STARTS, run=run)
        for point in real.points[:1]:
            jacobian = _jacobian(model.system, point)
            if matrix_corank(jacobian, NEARLY_SINGULAR) == mode.component.corank:
                yield point


def _jacobian(system: PolynomialSystem, point: np.ndarray) -> np.ndarray:
    """The Jacobian at a point, its rows of length one."""
    jacobian = Evaluator.of(system.polynomials, system.n).jacobian(point + 0j)
    sizes = np.linalg.norm(jacobian, axis=1, keepdims=True)
    return jacobian / np.where(sizes > 0, sizes, 1)


def _real_tangents(model: PlatformModel, mode: OperationMode, point: np.ndarray) -> np.ndarray:
    """An orthonormal basis of the tangent space at a real point of a reduced mode."""
    _, _, directions = np.linalg.svd(_jacobian(model.system, point).real)
    return directions[model.system.n - mode.component.dimension :]


def _same_poses(model: PlatformModel, mode: OperationMode, other: OperationMode, run: Run) -> bool:
    """Whether two components have the same poses, with different joint coordinates."""
    if not model.charts.n or (mode.dimension, mode.degree) != (other.dimension, other.degree):
        return False
    if mode.linear != other.linear or mode.quadratic != other.quadratic:
        return False
    if mode.is_linear:
        return True
    pose = mode.component.points[0][:7]
    n = model.system.n
    held = tuple(
        Polynomial.of_doubles(n, {UNITS[i][:7] + (0,) * (n - 7): 1.0, (0,) * n: -x})
        for i, x in enumerate(pose)
    )
    try:
        met = intersect_equations(
            model.system, other.component, PolynomialSystem(model.system.variables, held), run=run
        )
    except NagError:
        return False
    return bool(met.components)


def _transitions(
    model: PlatformModel, modes: Sequence[OperationMode], run: Run
) -> list[Transition]:
    """Where modes of positive dimension meet.

    Conjugates of two modes meet as these do.
    """
    pairs = list(combinations([i for i, mode in enumerate(modes) if mode.dimension], 2))
    mirrored = [i if m.reality is ModeReality.REAL else m.conjugate for i, m in enumerate(modes)]
    known: dict[tuple[int, int], Transition] = {}
    for count, pair in enumerate(pairs):
        run.tell("transitions", count, len(pairs))
        images = [mirrored[i] for i in pair]
        other = known.get(tuple(sorted(i for i in images if i is not None)))
        known[pair] = (
            replace(other, modes=pair)
            if other is not None
            else _transition(model, pair, (modes[pair[0]], modes[pair[1]]), run)
        )
    return [t for t in known.values() if t.kinds or t.note]


def _transition(
    model: PlatformModel,
    indices: tuple[int, int],
    pair: tuple[OperationMode, OperationMode],
    run: Run,
) -> Transition:
    if all(mode.is_linear for mode in pair):
        return Transition(indices, _linear_transition(*pair))
    common = _common_zeros(model, pair, run)
    if common.complete and all(_is_on_both(model, pair, c, run) for c in common.components):
        kinds = tuple((c.dimension, c.degree) for c in common.components)
        return Transition(indices, kinds)
    try:
        met = intersect_components(model.system, pair[0].component, pair[1].component, run=run)
        kinds = tuple(_pose_kind(model, c, run) for c in met.components)
    except (ComponentError, NagError) as error:
        return Transition(indices, (), str(error))
    note = "" if met.complete else "; ".join(met.notes) or "a component is undecided"
    return Transition(indices, kinds, note)


def _pose_kind(model: PlatformModel, component: WitnessSet, run: Run) -> tuple[int, int]:
    """Dimension and degree of the poses of a component."""
    if not model.charts.n:
        return component.dimension, component.degree
    image = project(model.system, component, range(7), run=run)
    return image.dimension, image.degree


def _linear_transition(first: OperationMode, second: OperationMode) -> tuple[tuple[int, int], ...]:
    """The linear space that two linear modes have in common; none without displacements."""
    rows = [[f.terms.get(e, 0) for e in UNITS] for f in (*first.linear, *second.linear)]
    basis = null_space(rows, 8)
    weights, zero = Polynomial.variables(len(basis)), Polynomial(len(basis), {})
    point = [sum((w * v[i] for w, v in zip(weights, basis, strict=True)), zero) for i in range(8)]
    return ((len(basis) - 1, 1),) if basis and norm_form().compose(point) else ()


def _common_zeros(
    model: PlatformModel, pair: tuple[OperationMode, OperationMode], run: Run
) -> Decomposition:
    """The zeros of the equations that both modes satisfy: where they meet, and perhaps more."""
    pose = _pose(model)
    more = [f.compose(pose) for mode in pair for f in (*mode.linear, *mode.quadratic)]
    system = replace(model.system, polynomials=(*more, *model.system.polynomials))
    return decompose(system, run=run)


def _is_on_both(
    model: PlatformModel,
    pair: tuple[OperationMode, OperationMode],
    component: WitnessSet,
    run: Run,
) -> bool:
    """Whether a component of the common zeros lies on both modes, which then meet in it.

    It is not asked where others are to be expected: of models that keep joints, whose modes are
    images of components, and of modes whose equations hold on their conjugates as well.
    """
    if model.charts.n or any(mode.reality is ModeReality.CONJUGATE for mode in pair):
        return False
    point, accuracy = component.points[0], max(LEAST, component.accuracy)
    # Poses of a linear mode are all that satisfy its equations.
    return all(
        mode.is_linear
        or membership_in(model.system, mode.component, point, accuracy, run) is Membership.MEMBER
        for mode in pair
    )
