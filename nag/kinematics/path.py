"""One motion, evenly sampled: points of the equations along a walk, and the poses there.

Samples are equally far from each other as bodies move (`poses.pose_steps`), whatever coordinates
the curve was found in, and are brought onto the curve by the equations themselves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.kinematics.poses import Poses, pose_steps
from nag.kinematics.scene import Scene
from nag.kinematics.walks import Walk, points_of
from nag.real.curve import RealCurve

# Singular values of a balanced Jacobian, beside the largest, that are the kernel's on a curve, or
# belong to equations that say the same twice.
KERNEL = 1e-8
# Newton's steps, and the last one's size from which on a point is on the curve.
STEPS, ARRIVED = 12, 1e-14
# Steps of samples are so many of the points that they are taken between; how often these are
# halved for it at most.
FINER, HALVINGS = 4, 12


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
        return self.scene.lift(points_of(self.real, chart))

    def sharpen(self, chart: np.ndarray) -> np.ndarray:
        """Points of a chart, brought onto the curve by Newton's method on all equations.

        Steps are the shortest ones, across the curve. Rows are scaled by the powers of cosines
        that make values finite where a turn's variable is not.
        """
        evaluator = Evaluator.of(self.system.polynomials, self.system.n)
        derivatives = evaluator.placed_derivatives(self.system.n)
        degrees = _degrees(evaluator)
        chart = np.array(chart)
        for _ in range(STEPS):
            points = points_of(self.real, chart)
            weights = np.ones((len(points), len(degrees)))
            slopes = np.ones_like(points)
            for turn in self.real.turns:
                cosine = np.abs(np.cos(chart[:, turn.variable]))
                weights *= cosine[:, None] ** degrees[:, turn.variable]
                slopes[:, turn.variable] = turn.radius / cosine**2
            values = evaluator.values(points).real * weights
            rows = derivatives(points).real * weights[:, :, None] * slopes[:, None, :]
            sizes = np.linalg.norm(rows, axis=2)
            sizes = np.where(sizes > 0, sizes, 1.0)
            inverse = np.linalg.pinv(rows / sizes[:, :, None], rcond=KERNEL)
            step = (inverse @ (values / sizes)[:, :, None])[:, :, 0]
            chart -= step
            if float(np.abs(step).max(initial=0.0)) < ARRIVED:
                break
        return chart


def _degrees(evaluator: Evaluator) -> np.ndarray:
    """Degree of each equation in each variable, shape ``(rows, n)``."""
    there = evaluator.coefficients != 0
    return np.array([evaluator.exponents[own].max(axis=0, initial=0) for own in there])


@dataclass(frozen=True, eq=False)
class Path:
    """Samples of one motion.

    Attributes:
        curve: what it runs on.
        walk: how.
        arc: how far each sample is from the first, in radians and sizes, shape ``(k,)``.
        chart: of the samples, shape ``(k, n)``.
        poses: at the samples, with continuous signs.
        vertices: those of the real curve on the way, each with how far it is from the first sample.
    """

    curve: Curve
    walk: Walk
    arc: np.ndarray
    chart: np.ndarray
    poses: Poses
    vertices: tuple[tuple[int, float], ...]

    @property
    def length(self) -> float:
        """The whole way."""
        return float(self.arc[-1])


def sample_path(curve: Curve, walk: Walk, count: int) -> Path:
    """``count`` samples at even distances, the walk's first and last point among them."""
    dense, arc, places = _measure(curve, walk.chart, count)
    wanted = np.linspace(0.0, arc[-1], count)
    columns = [np.interp(wanted, arc, column) for column in dense.T]
    chart = curve.sharpen(np.stack(columns, axis=-1))
    # Ends are given; at vertices among them the equations are singular.
    chart[0], chart[-1] = walk.chart[0], walk.chart[-1]
    poses = curve.poses(chart).with_continuous_signs()
    vertices = tuple((vertex, float(arc[places[index]])) for vertex, index in walk.vertices)
    return Path(curve, walk, wanted, chart, poses, vertices)


def _measure(
    curve: Curve, chart: np.ndarray, count: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points along a walk, more of them where bodies move fast, and how far each is.

    Also at which of them the given ones are.
    """
    scene = curve.scene
    places = np.arange(len(chart))
    for halving in range(HALVINGS + 1):
        steps = pose_steps(curve.poses(chart), scene.centres, scene.size)
        arc = np.concatenate([[0.0], np.cumsum(steps)])
        long = np.flatnonzero(steps > arc[-1] / count / FINER)
        if not len(long) or halving == HALVINGS:
            break
        between = curve.sharpen((chart[long] + chart[long + 1]) / 2)
        chart = np.insert(chart, long + 1, between, axis=0)
        places = places + np.searchsorted(long, places)
    return chart, arc, places
