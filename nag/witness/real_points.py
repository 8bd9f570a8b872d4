"""Real points of a component near a given point.

From real starting points around the given one, Newton's method with real arithmetic leads to real
zeros; from each, Lagrange-Newton steps lead to a point whose distance is stationary. A zero counts
if it lies on the component (a path test). Nothing found is no proof that there is nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.given import check_whole
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.numerics.coincidence import coincident
from nag.numerics.read_only import BooleanArray, RealArray, Several, equal_values, fixed_array
from nag.numerics.zero_values import LEAST, ON
from nag.text.table import one_line
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.change_of_coordinates import carry_component, coordinates_of
from nag.witness.component_equations import component_fibres
from nag.witness.fibres import Fibre
from nag.witness.gauss_newton import descend, polish
from nag.witness.given_component import check_component
from nag.witness.membership import Membership, is_member
from nag.witness.witness import WitnessSet

STARTS = 24
# Largest standard deviation of starting points, relative to the size of the given one.
SPREAD = 0.5
# Steps along the component towards the given point, the length of those that have arrived, and of
# the last one where rounding keeps them from becoming shorter.
MOST_STEPS = 60
# Decides: Part of the distance that can still be gained, at a nearest point.
STATIONARY = 1e-10
# The same at a point that may be a nearest one, and is said to be almost: to half those digits.
ALMOST = STATIONARY**0.5
# Part of such a step that is the last one tried; and directions along the component, beside the
# longest, in which the variables do not change.
SHORTEST, STILL = 1e-6, 1e-10
# Rounding of distances, and of points between which derivatives are compared, relative to sizes.
LEVEL, APART = 1e-15, 1e-5


@dataclass(frozen=True, eq=False)
class RealPoints(Several[RealArray]):
    """Real points of a component, the nearest first.

    Attributes:
        points: real, shape ``(count, n)``.
        distances: from the given point, shape ``(count,)``.
        stationary: for each, whether its distance is stationary along the component.
        residual: largest relative residual of the equations at the points.
        undecided: number of real zeros whose membership could not be decided; they are left out.
        reason: why no point was found; empty otherwise.
    """

    points: RealArray
    distances: RealArray
    stationary: BooleanArray
    residual: float
    undecided: int = 0
    reason: str = ""

    __eq__ = equal_values

    def __post_init__(self) -> None:
        for name in ("points", "distances", "stationary"):
            object.__setattr__(self, name, fixed_array(getattr(self, name)))

    @property
    def entries(self) -> RealArray:
        """The points."""
        return self.points

    def to_numpy(self) -> RealArray:
        """The points, shape ``(count, n)``, to be written to."""
        return self.points.copy()

    @property
    def complete(self) -> bool:
        """Whether of every real zero that was found it is known if it is on the component."""
        return not self.undecided

    __repr__ = one_line

    def __str__(self) -> str:
        from nag.witness.shown import real_points_text

        return real_points_text(self)

    def _repr_html_(self) -> str:
        from nag.witness.shown import real_points_html

        return real_points_html(self)

    def __len__(self) -> int:
        return len(self.points)


@takes_run
def real_points_near(
    system: PolynomialSystem,
    component: WitnessSet,
    near: np.ndarray,
    *,
    starts: int = STARTS,
    run: Run = DEFAULT_RUN,
) -> RealPoints:
    """Real points of ``component`` near a real point.

    Newton's method leads to them from points around the given one; then they move to where their
    distance is stationary (Seidenberg 1954). Nothing found is no proof that there is nothing.

    Args:
        system: the equations that ``component`` was found from.
        component: one of the components of a `nag.Decomposition`.
        near: real, shape ``(n,)``.
        starts: number of starting points; the first is ``near`` itself.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The points, real of shape ``(count, n)``, the nearest first.

    Raises:
        ValueError: if an argument makes no sense, or witness points are none.

    >>> import nag
    >>> from nag.decomposition import real_points_near
    >>> circle = nag.decompose("x^2 + y^2 = 1")
    >>> near = real_points_near(circle.system, circle.components[0], [3.0, 0.0])
    >>> near.points[0].round(6).tolist(), round(float(near.distances[0]), 6)
    ([1.0, 0.0], 2.0)
    """
    check_component(system, component)
    check_whole(starts, "starts", 1)
    system.check_real_coordinates()
    if system.imaginary:
        raise NagError("component: its equations have complex coefficients; use find_real_points")
    near = _real_vector(near, system.n)
    rng = run.random(Stream.REAL_POINTS)
    # Distances are those in the units that are given.
    natural = coordinates_of(system).without_scales
    system, near = natural.system(system), natural.points(near)
    component = carry_component(component, natural, system)
    fibres = component_fibres(system, component)
    everything = Evaluator.of(system.polynomials, system.n)
    known = np.zeros((0, system.n))
    pulls: list[float] = []
    zeros, undecided = 0, 0
    for start in _starts(near, starts, rng):
        for x, pull in _nearest_zeros(fibres, everything, start, near):
            zeros += 1
            if coincident(known, x, pull if pull < ALMOST else 0.0).any():
                continue
            answer, _ = is_member(x + 0j, LEAST, fibres, rng, run)
            undecided += answer is Membership.UNDECIDED
            if answer is Membership.MEMBER:
                known = np.vstack([known, x])
                pulls.append(pull)
    residual = float(everything.residuals(known + 0j).max(initial=0.0))
    distances = np.linalg.norm(known - near, axis=1)
    order, arrived = np.argsort(distances, kind="stable"), np.array(pulls, dtype=float) < ALMOST
    reason = "" if len(known) else _why_none(zeros, starts)
    known, distances, arrived = known[order], distances[order], arrived[order]
    points = natural.inverse.points(known)
    return RealPoints(points, distances, arrived, residual, undecided, reason)


def _why_none(zeros: int, starts: int) -> str:
    if zeros:
        return f"none of {zeros} real zeros that were found lies on the component"
    return f"no real zero of the equations was found from {starts} starting points"


def _real_vector(near: Any, n: int) -> np.ndarray:
    """The point as an array.

    Raises:
        ValueError: if it is none.
    """
    try:
        point = np.asarray(near, dtype=float)
    except (TypeError, ValueError, OverflowError):
        point = np.zeros(0)
    if point.shape != (n,) or not np.isfinite(point).all():
        raise NagError(f"near: the point must be {n} finite real numbers")
    return point


def _starts(near: np.ndarray, count: int, rng: np.random.Generator) -> Iterator[np.ndarray]:
    """Starting points ever further from a point, beginning with the point itself."""
    n = len(near)
    for k in range(count):
        scale = SPREAD * k / max(1, count - 1) * (1 + np.linalg.norm(near))
        yield near + scale / np.sqrt(max(1, n)) * rng.standard_normal(n)


def _nearest_zeros(
    fibres: Sequence[Fibre], everything: Evaluator, start: np.ndarray, near: np.ndarray
) -> Iterator[tuple[np.ndarray, float]]:
    """Real zeros of each cut from ``start``, moved to where their distance is stationary.

    Also the length of the next step along the component, relative to the size of ``near``.
    """
    for fibre in {id(fibre.cut): fibre for fibre in fibres}.values():
        # What deflation added is known where the equations hold, not where they do not.
        there = descend(everything, start) if fibre.cut.aux else start
        z = None if there is None else _real_zero(fibre, everything, fibre.lifted(there).real)
        if z is not None:
            yield _nearest(fibre, everything, z, near)


def _nearest(
    fibre: Fibre, everything: Evaluator, z: np.ndarray, near: np.ndarray
) -> tuple[np.ndarray, float]:
    n, size = fibre.cut.n, 1 + float(np.linalg.norm(near))
    reach, last = 1.0, np.inf
    for _ in range(MOST_STEPS):
        x = z[:n]
        pull, step = _step_towards(fibre, z, near)
        # Distances do not tell short steps from none, which their lengths do.
        if pull < STATIONARY * size or (pull < ALMOST * size and pull >= last):
            break
        last = pull
        while reach >= SHORTEST:
            trial = _real_zero(fibre, everything, fibre.lifted(x + reach * step).real)
            gain = np.inf if trial is None else np.linalg.norm(trial[:n] - near)
            if gain < np.linalg.norm(x - near) + LEVEL * size:
                break
            reach /= 4
        else:
            break
        z, reach = trial, min(1.0, 2 * reach)
    return z[:n], pull / size


def _step_towards(fibre: Fibre, z: np.ndarray, near: np.ndarray) -> tuple[float, np.ndarray]:
    """The distance to the foot of ``near`` on the tangent space, and a step along that space.

    The step is Newton's for a stationary distance, turned round along the axes of the curvature on
    which that would lead uphill (Greenstadt, On the relative efficiencies of gradient methods,
    Math. Comp. 21 (1967)). The curvature of the set is the equations' second derivatives, each
    times its Lagrange multiplier.
    """
    n, evaluator = fibre.cut.n, fibre.cut.evaluator
    _, _, vh = np.linalg.svd(evaluator.balanced_jacobian(z).real)
    tangent = vh[len(z) - fibre.dimension :].T
    # The distance is measured in the variables, and unknowns that deflation added follow.
    along = tangent[:n]
    foot = along @ np.linalg.lstsq(along, near - z[:n], rcond=STILL)[0]
    pull = float(np.linalg.norm(foot))
    if not len(fibre.cut.polynomials) or not fibre.dimension:
        return pull, foot
    normal = np.concatenate([z[:n] - near, np.zeros(len(z) - n)])
    multipliers = np.linalg.lstsq(evaluator.jacobian(z).real.T, normal, rcond=None)[0]
    aside = APART * max(1.0, float(np.abs(z).max())) * tangent.T
    slopes = evaluator.placed_derivatives(len(z))(np.vstack([z + aside, z - aside])).real
    turned = (slopes[: len(aside)] - slopes[len(aside) :]).transpose(0, 2, 1) @ multipliers
    bent = turned @ tangent / (2 * np.linalg.norm(aside, axis=1, keepdims=True))
    curvature = along.T @ along - (bent + bent.T) / 2
    sizes, axes = np.linalg.eigh(curvature)
    # Towards a minimum along an axis of the curvature, away from a maximum.
    sizes = np.maximum(np.abs(sizes), STILL * max(1.0, float(np.abs(sizes).max())))
    step = along @ (axes @ (axes.T @ (along.T @ (near - z[:n])) / sizes))
    # No point that is nearer than this one lies further from it.
    longest = 2 * float(np.linalg.norm(near - z[:n]))
    return pull, step * min(1.0, longest / max(float(np.linalg.norm(step)), 1e-300))


def _real_zero(fibre: Fibre, everything: Evaluator, z: np.ndarray) -> np.ndarray | None:
    """A regular real zero of the cut that satisfies all equations, or None."""
    cut = fibre.cut
    if not cut.polynomials:
        return z
    near = descend(cut.evaluator, z)
    if near is None:
        return None
    zero = polish(cut.evaluator, near, corank=fibre.dimension)
    inside = everything.residuals(zero.x[None, : cut.n] + 0j).max(initial=0.0) < ON
    return zero.x if zero.converged and inside else None
