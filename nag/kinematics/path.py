"""One motion, evenly sampled: points of the equations along a walk, and the poses there.

Samples are equally far from each other as bodies move (`poses.pose_steps`), whatever coordinates
the curve was found in, and are brought onto the curve by the equations themselves.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nag.algebra.evaluation import Evaluator, PlacedDerivatives
from nag.algebra.system import PolynomialSystem
from nag.kinematics.poses import Poses, pose_steps
from nag.kinematics.scene import Scene
from nag.kinematics.walks import CurveWalk
from nag.real.curve import RealCurve
from nag.real.spherical_chart import SphericalChart

# Decides: Singular values of equations along a curve, over the largest, that are zero: Newton's
# steps that bring samples onto it leave them out.
KERNEL = 1e-8
# Newton's steps, the last one's size from which on a point is on the curve, and the share of a step
# that the next one is at most while derivatives are not worked out anew.
STEPS, ARRIVED, SHRINKING = 12, 1e-14, 1e-3
# Steps of samples are so many of the points that they are taken between; how often these are
# halved for it at most.
FINER, HALVINGS = 4, 12
# Second least singular values of the equations, beside their median along a circuit, that may
# become as small between samples as where other motions meet it.
PROMISING = 0.3
# Decides: Second least singular value of the equations, over its median along a circuit, at which
# other motions meet it: it is brought to 1e-8 there.
SINGULAR = 1e-5
# How the way between samples is searched for it: places at a time, and how often that is narrowed.
PLACES, NARROWINGS = 21, 9


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
        chart = np.array(chart)
        left, sizes = np.arange(len(chart)), np.full(len(chart), np.inf)
        stale = np.ones(len(chart), dtype=bool)
        inverses = np.empty((0, 0, 0))
        for _ in range(STEPS):
            if not len(left):
                break
            values, rows = self.equations_at(chart[left[stale]])
            if stale.any():
                own = _shortest_steps(rows)
                if not inverses.size:
                    inverses = np.empty((len(chart), *own.shape[1:]))
                inverses[left[stale]] = own
            if not stale.all():
                values = self.values_at(chart[left])
            step = (inverses[left] @ values[:, :, None])[:, :, 0]
            chart[left] = self.coordinates.normalise(chart[left] - step)
            size = np.abs(step).max(axis=1)
            going = ~(size < ARRIVED)
            stale = (size > SHRINKING * sizes[left])[going]
            sizes[left] = size
            left = left[going]
        return chart


def _shortest_steps(rows: np.ndarray) -> np.ndarray:
    """Matrices that take values of equations to the shortest steps by which these vanish.

    Of Jacobians, shape ``(k, rows, size)``, the inverses of ``size - 1`` singular values at most,
    and of none that is zero.
    """
    u, s, v = np.linalg.svd(rows, full_matrices=False)
    kept = s > KERNEL * s[:, :1]
    kept[:, rows.shape[2] - 1 :] = False
    scales = np.where(kept, 1 / np.where(kept, s, 1.0), 0.0)
    return np.asarray(v.transpose(0, 2, 1) @ (scales[:, :, None] * u.transpose(0, 2, 1)))


@dataclass(frozen=True, eq=False)
class Path:
    """Samples of one motion.

    Attributes:
        curve: what it runs on.
        walk: how.
        arc: how far each sample is from the first, in radians and sizes, shape ``(k,)``.
        chart: of the samples, shape ``(k, size)``, in the coordinates of the walk.
        poses: at the samples, with continuous signs.
        vertices: those of the real curve on the way, each with how far it is from the first sample.
    """

    curve: Curve
    walk: CurveWalk
    arc: np.ndarray
    chart: np.ndarray
    poses: Poses
    vertices: tuple[tuple[int, float], ...]

    @property
    def length(self) -> float:
        """The whole way."""
        return float(self.arc[-1])

    @property
    def before_first(self) -> np.ndarray:
        """The sample before the first of a closed motion, which is the last but one."""
        last = self.chart[-2:]
        return self.walk.coordinates.make_continuous(np.vstack([self.chart[:1], last[::-1]]))[2]


def singular_places(path: Path) -> list[tuple[float, np.ndarray]]:
    """Where the rank of the equations drops on a path: how far along it is, and the chart there.

    Other motions may go on from there. Vertices of the real curve are among them; where the rank is
    low all along, nothing is said.
    """
    curve, chart = path.curve, path.chart
    sizes = _second_least(curve, chart)
    usual = float(np.median(sizes))
    if usual < KERNEL:
        return []
    count = len(chart)
    found = []
    for i in range(0 if path.walk.closed else 1, count - 1):
        before = chart[i - 1] if i else path.before_first
        around = sizes[i - 1 if i else count - 2], sizes[i + 1]
        if sizes[i] > min(around) or sizes[i] > PROMISING * usual:
            continue
        middle, width = 0.0, 1.0
        for _ in range(NARROWINGS):
            places = middle + np.linspace(-width, width, PLACES)
            between = curve.sharpen(along_three(before, chart[i], chart[i + 1], places))
            own = _second_least(curve, between)
            least = int(own.argmin())
            middle, width = float(places[least]), 2 * width / (PLACES - 1)
        if own[least] < SINGULAR * usual:
            arc = (path.arc[i] + middle * (path.arc[1] - path.arc[0])) % path.length
            found.append((float(arc), between[least]))
    return found


def along_three(
    before: np.ndarray, middle: np.ndarray, after: np.ndarray, places: np.ndarray
) -> np.ndarray:
    """Points of the parabola through three, at places from -1, the first, to 1, the last."""
    t = places[:, None]
    return middle + t * (after - before) / 2 + t**2 * (after - 2 * middle + before) / 2


def _second_least(curve: Curve, chart: np.ndarray) -> np.ndarray:
    """The least singular value of the equations but for the one that is zero along the curve."""
    _, rows = curve.equations_at(chart)
    n = rows.shape[2]
    if n < 2 or rows.shape[1] < n - 1:
        return np.zeros(len(chart))
    return np.linalg.svd(rows, compute_uv=False)[:, n - 2]


def sample_path(curve: Curve, walk: CurveWalk, count: int) -> Path:
    """``count`` samples at even distances, the walk's first and last point among them."""
    dense, arc, places = _measure(curve, walk, count)
    wanted = np.linspace(0.0, arc[-1], count)
    chart = curve.sharpen(_interpolate(arc, dense, wanted, places[[i for _, i in walk.vertices]]))
    # Ends are given; at vertices among them the equations are singular.
    chart[0], chart[-1] = walk.chart[0], walk.chart[-1]
    poses = curve.poses(chart).with_continuous_signs()
    vertices = tuple((vertex, float(arc[places[index]])) for vertex, index in walk.vertices)
    return Path(curve, walk, wanted, chart, poses, vertices)


def _measure(
    curve: Curve, walk: CurveWalk, count: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points along a walk, more of them where bodies move fast, and how far each is.

    Also at which of them the given ones are.
    """
    scene, chart = curve.scene, walk.chart
    places = np.arange(len(chart))
    for halving in range(HALVINGS + 1):
        steps = pose_steps(curve.poses(chart), scene.centres, scene.size)
        arc = np.concatenate([[0.0], np.cumsum(steps)])
        long = np.flatnonzero(steps > arc[-1] / count / FINER)
        if not len(long) or halving == HALVINGS:
            break
        breaks = places[[i for _, i in walk.vertices]]
        halves = (arc[long] + arc[long + 1]) / 2
        between = curve.sharpen(_interpolate(arc, chart, halves, breaks))
        chart = np.insert(chart, long + 1, between, axis=0)
        places = places + np.searchsorted(long, places)
    return chart, arc, places


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
    weights = np.ones(four.shape)
    with np.errstate(divide="ignore", invalid="ignore"):
        for i in range(4):
            for j in range(4):
                if i != j:
                    weights[:, i] *= (wanted - nodes[:, j]) / (nodes[:, i] - nodes[:, j])
    cubic = np.einsum("ki,kin->kn", weights, chart[four])
    # Where points are too few, or coincide, a line has to do.
    good = (high - low >= 3) & np.isfinite(weights).all(axis=1)
    return np.where(good[:, None], cubic, linear)
