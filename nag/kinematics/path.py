"""One motion, evenly sampled: points of the equations along a walk, and the poses there.

Samples are equally far from each other as bodies move (`poses.pose_steps`), whatever coordinates
the curve was found in, and are brought onto the curve by the equations themselves.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from nag.algebra.evaluation import Evaluator, PlacedDerivatives
from nag.algebra.system import PolynomialSystem
from nag.kinematics.poses import Poses, pose_steps
from nag.kinematics.scene import Scene
from nag.kinematics.walks import CurveWalk
from nag.numerics.double_newton import ANYWHERE, count_above, find_zeros
from nag.numerics.double_ranks import NEARLY_SINGULAR, SINGULAR
from nag.real.curve import RealCurve
from nag.real.spherical_chart import SphericalChart

# Decides: Singular values of equations along a curve, over the largest, that are zero: Newton's
# steps that bring samples onto it leave them out.
KERNEL = 1e-8
# Steps of samples are so many of the points that they are taken between; how often these are
# halved for it at most.
FINER, HALVINGS = 4, 12
# Cosine of the turn from which on there are more points about it, and chords below which that is
# rounding.
COSINE, LEAST_CHORD = 0.98, 1e-6
# Second least singular values of the equations, beside their median along a circuit, that may
# become as small between samples as where other motions meet it.
PROMISING = 0.3
# How the way between samples is searched for it: places at a time, and how often that is narrowed.
PLACES, NARROWINGS = 21, 9
# Points of a motion on each side of a place where rank is lost, in units of how far it is
# interpolated between them; that in steps of samples, and of the way, at the most.
BESIDE_PASSAGE, NEAR_PASSAGE = (1, 2, 3, 4, 5, 6), 2e-3


@dataclass(frozen=True, eq=False)
class Curve:
    """A real curve with its equations and bodies, as far as points along it are worked out.

    Attributes:
        real: the curve.
        system: the equations.
        scene: bodies and joints.
    """

    real: RealCurve
    system: PolynomialSystem
    scene: Scene

    def poses(self, chart: np.ndarray) -> Poses:
        """Where the bodies are at points of a chart."""
        return self.scene.lift(self.coordinates.points(chart))

    @cached_property
    def coordinates(self) -> SphericalChart:
        """Those of its charts."""
        return SphericalChart.of(self.system)

    @cached_property
    def _equations(self) -> tuple[Evaluator, PlacedDerivatives]:
        """The equations, homogeneous in each group of the chart, with their derivatives.

        Their coefficients have length one. The gradient of one may vanish at a regular point, where
        the others have full rank, so that rows of length one would be rounding errors there.
        """
        coordinates = self.coordinates
        given = Evaluator.of(self.system.polynomials, self.system.n)
        rows = []
        for coefficients in given.coefficients:
            there = np.flatnonzero(coefficients)
            exponents = given.exponents[there]
            degrees = [exponents[:, list(own)].sum(axis=1) for own in coordinates.groups]
            missing = [own.max(initial=0) - own for own in degrees]
            length = float(np.linalg.norm(coefficients)) or 1.0
            whole = map(tuple, np.column_stack([exponents, *missing]).tolist())
            rows.append(dict(zip(whole, (coefficients[there] / length).tolist(), strict=True)))
        monomials = sorted({e for row in rows for e in row})
        table = np.array([[row.get(e, 0.0) for e in monomials] for row in rows])
        table = table.reshape(len(rows), len(monomials))
        size = coordinates.size
        evaluator = Evaluator(size, np.array(monomials, dtype=np.int64).reshape(-1, size), table)
        return evaluator, evaluator.placed_derivatives(size)

    def values_at(self, chart: np.ndarray) -> np.ndarray:
        """Values of the equations, and zeros for the lengths of groups, shape ``(k, rows)``."""
        values = self._equations[0].values(chart).real
        return np.hstack([values, np.zeros((len(chart), len(self.coordinates.groups)))])

    def equations_at(self, chart: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Values and Jacobians by the chart's coordinates.

        The last rows, whose values are zero, are those of the lengths of groups. Shapes
        ``(k, rows)`` and ``(k, rows, size)``.
        """
        evaluator, derivatives = self._equations
        values, rows = evaluator.values(chart).real, derivatives(chart).real
        lengths = self.coordinates.directions_of_scaling(chart)
        none = np.zeros(lengths.shape[:2])
        return np.hstack([values, none]), np.hstack([rows, lengths])

    def sharpen(self, chart: np.ndarray) -> np.ndarray:
        """Points of a chart, brought onto the curve by Newton's method on all equations.

        Steps are the shortest ones, across the curve: where there are more equations than a curve
        needs, they have full rank beside it, and the least singular value is left out.
        """
        size = chart.shape[1]
        ends = find_zeros(
            lambda x, _: self.equations_at(x),
            chart,
            rank=lambda s: np.minimum(count_above(KERNEL)(s), size - 1),
            stop=ANYWHERE,
            values=lambda x, _: self.values_at(x),
        )
        return self.coordinates.normalise(ends.x)


@dataclass(frozen=True, eq=False)
class SingularPassage:
    """Where the equations lose rank on the way of a motion, beside its vertices.

    Other motions may cross it there, and next to it Newton's method may lead to one of them. This
    motion is interpolated instead: points on both sides, far enough away, are joined by polynomials
    in their distance along the tangent.

    Attributes:
        arc: how far along the way the place is.
        reach: so far to both sides points are interpolated.
        arcs: how far beyond the place points on both sides are.
        chart: these points, shape ``(k, size)``.
    """

    arc: float
    reach: float
    arcs: np.ndarray
    chart: np.ndarray

    def points_at(self, arcs: np.ndarray) -> np.ndarray:
        """Points of the motion so far beyond the place, shape ``(k, size)``."""
        # By arc, which is only nearly a smooth function, errors would be across the curve as well.
        ahead = self.chart[-1] - self.chart[0]
        wanted = _interpolation_weights(self.arcs, np.asarray(arcs)) @ (self.chart @ ahead)
        return interpolate_ahead(self.chart, wanted)


def interpolate_ahead(chart: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Points on the polynomials through points of a curve in a row, shape ``(k, size)``.

    Args:
        wanted: the products of these points with the way from the first of the others to the last.
    """
    along = chart @ (chart[-1] - chart[0])
    return np.asarray(_interpolation_weights(along, wanted) @ chart)


def are_singular(curve: Curve, chart: np.ndarray) -> np.ndarray:
    """Whether the equations of a curve lose rank at points of a chart, shape ``(k,)``."""
    return _second_least(curve, chart) < KERNEL


@dataclass(frozen=True, eq=False)
class MeasuredWalk:
    """All points of a motion, by how far they are from the first.

    Attributes:
        curve: what it runs on.
        walk: how, by points between which others are interpolated.
        arc: how far each of these is from the first, in radians and sizes.
        passages: where the equations lose rank on it, more than a step of samples from its
            vertices.
    """

    curve: Curve
    walk: CurveWalk
    arc: np.ndarray
    passages: tuple[SingularPassage, ...] = ()

    @property
    def length(self) -> float:
        """That of the whole way."""
        return float(self.arc[-1])

    @property
    def vertices(self) -> tuple[tuple[int, float], ...]:
        """Those of the real curve, each with how far it is from the first point."""
        return tuple((vertex, float(self.arc[index])) for vertex, index in self.walk.vertices)

    def points_at(self, arcs: np.ndarray) -> np.ndarray:
        """Points so far from the first, shape ``(k, size)``.

        Of a closed motion also before the first and behind the last, up to signs of groups.
        """
        arcs = np.asarray(arcs, dtype=float)
        if self.walk.closed:
            arcs = np.where((arcs < 0) | (arcs > self.length), arcs % self.length, arcs)
        breaks = np.array([index for _, index in self.walk.vertices], dtype=int)
        near = _interpolate(self.arc, self.walk.chart, arcs, breaks)
        chart = self.curve.sharpen(near)
        for passage in self.passages:
            beyond = self.distances(arcs, passage.arc)
            own = np.abs(beyond) < passage.reach
            chart[own] = self.walk.coordinates.align_signs(
                passage.points_at(beyond[own]), near[own]
            )
        return chart

    def distances(self, arcs: np.ndarray, arc: float) -> np.ndarray:
        """How far beyond a place others are, by the shorter way if the motion is closed."""
        beyond = np.asarray(arcs) - arc
        return beyond - self.length * np.round(beyond / self.length) if self.walk.closed else beyond


@dataclass(frozen=True, eq=False)
class Path:
    """Samples of one motion.

    Attributes:
        measured: all of the motion.
        arc: how far each sample is from the first, in radians and sizes, shape ``(k,)``.
        chart: of the samples, shape ``(k, size)``, in the coordinates of the walk.
        poses: at the samples, with continuous signs.
    """

    measured: MeasuredWalk
    arc: np.ndarray
    chart: np.ndarray
    poses: Poses

    @property
    def curve(self) -> Curve:
        """What it runs on."""
        return self.measured.curve

    @property
    def closed(self) -> bool:
        """Whether the motion returns to where it began."""
        return self.measured.walk.closed

    @property
    def length(self) -> float:
        """The whole way."""
        return self.measured.length

    @property
    def step(self) -> float:
        """How far samples are from each other."""
        return self.length / (len(self.arc) - 1)


def sample_path(curve: Curve, walk: CurveWalk, count: int) -> Path:
    """``count`` samples at even distances, the walk's first and last point among them."""
    measured = _measure_walk(curve, walk, count)
    arc = np.linspace(0.0, measured.length, count)
    chart = measured.points_at(arc)
    measured = replace(measured, passages=_find_passages(measured, arc, chart))
    for passage in measured.passages:
        near = np.abs(measured.distances(arc, passage.arc)) < passage.reach
        chart[near] = measured.points_at(arc[near])
    # Ends are given; at vertices among them the equations are singular.
    chart[0], chart[-1] = walk.chart[0], walk.chart[-1]
    return Path(measured, arc, chart, curve.poses(chart).with_continuous_signs())


def _find_passages(
    measured: MeasuredWalk, arc: np.ndarray, chart: np.ndarray
) -> tuple[SingularPassage, ...]:
    """Where the rank of the equations drops between samples, beside vertices, in their order.

    Where the rank is low all along, nothing is said.
    """
    known = measured.curve.real.meetings
    if known is not None and not len(known):
        return ()
    sizes = _second_least(measured.curve, chart)
    usual = float(np.median(sizes))
    if usual < KERNEL:
        return ()
    step, count = float(arc[1]), len(chart)
    vertices = [known for _, known in measured.vertices]
    places: list[float] = []
    for i in range(0 if measured.walk.closed else 1, count - 1):
        around = sizes[i - 1 if i else count - 2], sizes[i + 1]
        if sizes[i] > min(around) or sizes[i] > PROMISING * usual:
            continue
        place, least = _find_rank_loss(measured.curve, measured.points_at, float(arc[i]), step)
        apart = np.abs(measured.distances(np.array([*vertices, *places]), place))
        if least > NEARLY_SINGULAR * usual or not (apart > step).all():
            continue
        if least > SINGULAR * usual:
            # Next to the place steps of Newton's method are not exact, and it may be missed.
            known = np.array([*vertices, *places, place])
            passage = _make_passage(measured, place, step, known)
            least = float(_second_least(measured.curve, passage.points_at(np.zeros(1)))[0])
        if least < SINGULAR * usual:
            places.append(place % measured.length)
    every = np.array([*vertices, *places])
    return tuple(_make_passage(measured, place, step, every) for place in sorted(places))


def _find_rank_loss(
    curve: Curve, points_at: Callable[[np.ndarray], np.ndarray], place: float, width: float
) -> tuple[float, float]:
    """The place within a width where the equations are nearest to losing rank, and how near."""
    return find_least(lambda places: _second_least(curve, points_at(places)), place, width)


def find_least(
    values_at: Callable[[np.ndarray], np.ndarray],
    place: float,
    width: float,
    last: tuple[float, float] = (-np.inf, np.inf),
) -> tuple[float, float]:
    """The place within a width of another where a function is least, and its value there.

    It is looked for about the least of values in steps, and then in smaller ones.

    Args:
        values_at: at places of shape ``(k,)``, of that shape.
        last: the last places in both directions.
    """
    least = np.inf
    for _ in range(NARROWINGS):
        places = np.clip(place + np.linspace(-width, width, PLACES), *last)
        values = values_at(places)
        place, least = float(places[values.argmin()]), float(values.min())
        width = 2 * width / (PLACES - 1)
    return place, least


def _make_passage(
    measured: MeasuredWalk, place: float, step: float, special: np.ndarray
) -> SingularPassage:
    """The passage at a place, with points beside it that keep away from the other special ones."""
    gaps = np.abs(measured.distances(special, place))
    if not measured.walk.closed:
        gaps = np.append(gaps, [place, measured.length - place])
    across = BESIDE_PASSAGE[-1] + 1
    reach = min([step, NEAR_PASSAGE * measured.length, *(gaps[gaps > 0] / across)])
    arcs = reach * np.array([*(-k for k in reversed(BESIDE_PASSAGE)), *BESIDE_PASSAGE])
    chart = measured.walk.coordinates.make_continuous(measured.points_at(place + arcs))
    found = SingularPassage(place, reach, arcs, chart)
    # Between exact points the place itself is known to all digits, too.
    beyond, _ = _find_rank_loss(measured.curve, found.points_at, 0.0, reach)
    return SingularPassage((place + beyond) % measured.length, reach, arcs - beyond, chart)


def _second_least(curve: Curve, chart: np.ndarray) -> np.ndarray:
    """The least singular value of the equations but for the one that is zero along the curve."""
    _, rows = curve.equations_at(chart)
    n = rows.shape[2]
    if n < 2 or rows.shape[1] < n - 1:
        return np.zeros(len(chart))
    return np.linalg.svd(rows, compute_uv=False)[:, n - 2]


def _measure_walk(curve: Curve, walk: CurveWalk, count: int) -> MeasuredWalk:
    """A walk with more points where bodies move fast or it turns sharply, and how far each is."""
    for _ in range(HALVINGS):
        steps = _steps(curve, walk.chart)
        arc = np.concatenate([[0.0], np.cumsum(steps)])
        long = np.flatnonzero((steps > 2 * arc[-1] / count / FINER) | _beside_turns(walk))
        if not len(long):
            break
        between = MeasuredWalk(curve, walk, arc).points_at((arc[long] + arc[long + 1]) / 2)
        walk = walk.insert(long, between)
    # Last, all are halved: lengths of chords and of their halves are extrapolated (Richardson), so
    # that samples are at the same places whatever coordinates the curve was found in.
    steps = _steps(curve, walk.chart)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    between = MeasuredWalk(curve, walk, arc).points_at((arc[1:] + arc[:-1]) / 2)
    walk = walk.insert(np.arange(len(between)), between)
    halves = _steps(curve, walk.chart).reshape(-1, 2)
    halves += (halves.sum(axis=1) - steps)[:, None] / 6
    return MeasuredWalk(curve, walk, np.concatenate([[0.0], np.cumsum(halves)]))


def _beside_turns(walk: CurveWalk) -> np.ndarray:
    """Which segments of a walk turn much against the next or the last one, but for cusps."""
    chords = np.diff(walk.chart, axis=0)
    sizes = np.linalg.norm(chords, axis=1)
    products = (chords[1:] * chords[:-1]).sum(axis=1)
    sharp = products < COSINE * sizes[1:] * sizes[:-1]
    sharp &= np.minimum(sizes[1:], sizes[:-1]) > LEAST_CHORD
    sharp[[i - 1 for _, i in walk.vertices if 0 < i <= len(sharp)]] = False
    return np.append(sharp, False) | np.append(False, sharp)


def _steps(curve: Curve, chart: np.ndarray) -> np.ndarray:
    return pose_steps(curve.poses(chart), curve.scene.measure)


def _interpolate(
    arc: np.ndarray, chart: np.ndarray, wanted: np.ndarray, breaks: np.ndarray
) -> np.ndarray:
    """Points of a chart between those given, by cubics that do not reach over breaks.

    So near to a curve that Newton's method leads to it, and not to another one that crosses it.
    """
    last = len(arc) - 1
    ends = np.unique(np.concatenate([[0, last], breaks]).astype(int))
    segment = np.clip(np.searchsorted(arc, wanted, side="right") - 1, 0, last - 1)
    piece = np.searchsorted(ends, segment, side="right") - 1
    low, high = ends[piece], ends[piece + 1]
    share = (wanted - arc[segment]) / np.where(
        arc[segment + 1] > arc[segment], arc[segment + 1] - arc[segment], 1.0
    )
    linear = chart[segment] + share[:, None] * (chart[segment + 1] - chart[segment])
    first = np.clip(segment - 1, low, np.maximum(low, high - 3))
    four = np.minimum(first[:, None] + np.arange(4), last)
    nodes = arc[four]
    with np.errstate(divide="ignore", invalid="ignore"):
        weights = _interpolation_weights(nodes, wanted)
    cubic = np.einsum("ki,kin->kn", weights, chart[four])
    # Where points are too few, or coincide, a line has to do.
    good = (high - low >= 3) & np.isfinite(weights).all(axis=1)
    return np.where(good[:, None], cubic, linear)


def _interpolation_weights(nodes: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """What values at nodes count in the polynomial through them at wanted places, ``(k, nodes)``.

    Nodes may be others for each place, of that shape.
    """
    nodes = np.broadcast_to(nodes, (len(wanted), nodes.shape[-1]))
    weights = np.ones(nodes.shape)
    for i in range(nodes.shape[1]):
        for j in range(nodes.shape[1]):
            if i != j:
                weights[:, i] *= (wanted - nodes[:, j]) / (nodes[:, i] - nodes[:, j])
    return weights
