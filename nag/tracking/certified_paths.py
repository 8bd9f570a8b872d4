"""Certified paths: tubes that are proved to hold exactly one path, from t = 1 on.

Along a step of t each path is enclosed in a tube, boxes of fixed sides about a cubic curve. For the
whole step at once, in series of discs, Krawczyk's test proves that each box holds exactly one zero;
the tubes of two steps are proved to hold the same one where they meet. Paths that begin at distinct
points therefore cannot jump, and nothing depends on how the curve was found.

References:
    Guillemot & Lairez, Validated numerics for algebraic path tracking, 2024 (Moore's boxes along a
    predictor; here the curve is Hermite's through both ends of a step, and the preconditioner
    moves along with it); Krawczyk 1969.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nag.numerics.array_table import ArrayTable
from nag.numerics.discs import LEAST, UP, Discs, magnitude, rounding_of_sum
from nag.numerics.double_newton import ANYWHERE, find_zeros, newton_steps
from nag.numerics.doubles import UNIT
from nag.numerics.krawczyk import invert_matrices
from nag.text.progress import REMARK
from nag.tracking import blocks
from nag.tracking.moving_discs import MovingSystem, times

# Coefficients of series of values, and of Jacobian matrices.
LENGTH, SLOPES = 5, 3
# Parts of a tube's sides that the curve's error, the Jacobian's change along the step and its
# change across the tube are to take up.
ERROR, ALONG, ACROSS = 0.2, 0.3, 0.3
# Changes of step and sides from one trial to the next; the first step; first sides over the point.
LEAST_FACTOR, MOST_FACTOR, FIRST_STEP, FIRST_SIDE = 0.2, 2.0, 0.02, 1e-2
# Least side of a tube beside its largest.
FLATTEST = 1e-3
# A path that gets so near to t = 0 without arriving there has ended.
ENDGAME = 1e-6
# Decides: Steps, relative to t, at which a path is left without a proof.
SHORTEST = 1e-9
# Trials of a path, and corrections of a point.
MOST_TRIALS, CORRECTIONS = 2000, 3
# Sides of boxes that are tried about a point, and paths that are enclosed at a time.
SIDES, BLOCK = 10, 256


@dataclass(frozen=True, eq=False)
class ProvedZeros(ArrayTable):
    """Zeros, each by a box that it lies in, and a larger one that holds no other.

    Attributes:
        centres: complex, shape ``(P, n)``; inner, outer: radii of the boxes, shape ``(P, n)``;
            negative outer ones where no zero is proved.
    """

    centres: np.ndarray
    inner: np.ndarray
    outer: np.ndarray

    @property
    def proved(self) -> np.ndarray:
        """Which of them there are, shape ``(P,)``."""
        return (self.outer > 0).all(axis=1)

    def same(self, other: ProvedZeros) -> np.ndarray:
        """Which pairs are proved to be the same zero, one of each; shapes may be broadcast."""
        off = magnitude(self.centres - other.centres) * UP
        mine = (off + other.inner) * UP < self.outer
        theirs = (off + self.inner) * UP < other.outer
        return mine.all(axis=-1) | theirs.all(axis=-1)


@dataclass(frozen=True, eq=False)
class CertifiedPaths:
    """How far paths are proved.

    Attributes:
        reached: the t down to which a tube holds each path, shape ``(P,)``.
        ends: the zeros there.
        steps, trials: tubes of all paths together, and those that were tried.
    """

    reached: np.ndarray
    ends: ProvedZeros
    steps: int
    trials: int


@dataclass(eq=False)
class _PathStates:
    """Where the paths are: arrays that are written to, one entry for each path."""

    x: np.ndarray
    rates: np.ndarray
    t: np.ndarray
    step: np.ndarray
    sides: np.ndarray
    at: ProvedZeros


def prove_zeros_near(
    system: MovingSystem, points: np.ndarray, t: float, reach: float = np.inf
) -> ProvedZeros:
    """The zeros next to points at a fixed t, as far as doubles can prove them.

    Args:
        reach: how far from the points zeros may be to count, relative to their size.
    """
    found = ProvedZeros(points.copy(), np.full(points.shape, np.inf), np.full(points.shape, -1.0))
    left = np.arange(len(points))
    with np.errstate(all="ignore"):
        times_ = np.full(len(points), t)
        x, _ = _correct_points(system, points, times_)
        sizes = np.abs(x).max(axis=1, initial=0.0)
        left = left[np.abs(x - points).max(axis=1, initial=0.0) <= reach * sizes]
        for exponent in range(SIDES):
            if not len(left):
                break
            curve = np.zeros((4, *x[left].shape), dtype=complex)
            curve[0] = x[left]
            side = FIRST_SIDE * 2.0 ** (-4 * exponent) * sizes[left]
            radii = np.broadcast_to(side[:, None], x[left].shape)
            tube = _tube(system, curve, times_[left], times_[left], radii)
            done = left[tube.proved]
            found.centres[done], found.inner[done] = x[done], tube.inner[tube.proved]
            found.outer[done] = radii[tube.proved]
            left = left[~tube.proved]
    return found


def are_distinct(zeros: ProvedZeros) -> bool:
    """Whether all zeros are proved, and proved to be pairwise distinct."""
    if not zeros.proved.all():
        return False
    for i in range(len(zeros.centres) - 1):
        off = np.abs(zeros.centres[i + 1 :] - zeros.centres[i]) / UP
        apart = off > (zeros.inner[i + 1 :] + zeros.inner[i]) * UP
        if not apart.any(axis=1).all():
            return False
    return True


def certified_paths(
    system: MovingSystem,
    starts: ProvedZeros,
    begin: np.ndarray | float = 1.0,
    endgame: float = ENDGAME,
    most_trials: int = MOST_TRIALS,
) -> CertifiedPaths:
    """Enclose paths towards t = 0, as far as doubles can prove them.

    Args:
        system: the homotopy.
        starts: its zeros at ``begin``; what is not proved there is not followed.
        begin: t of each path, shape ``(P,)``, or of all.
        endgame: t at which a path that does not arrive is left: its end may be singular, or at
            infinity in the chart.
        most_trials: tubes that are tried about each path.
    """
    P = len(starts.centres)
    t = np.full(P, begin, dtype=float)
    x, rates = starts.centres.copy(), np.zeros_like(starts.centres)
    at = ProvedZeros(starts.centres.copy(), starts.inner.copy(), starts.outer.copy())
    sides = FIRST_SIDE * np.abs(x).max(axis=1, keepdims=True, initial=0.0) * np.ones(x.shape)
    state = _PathStates(x, rates, t, FIRST_STEP * t, sides, at)
    active, steps, trials = np.flatnonzero(starts.proved & (t > 0)), 0, 0
    with np.errstate(all="ignore"):
        state.x[active], state.rates[active] = _correct_points(system, x[active], t[active])
        for _ in range(most_trials):
            if not len(active):
                break
            trials += len(active)
            for first in range(0, len(active), BLOCK):
                steps += int(_try_step(system, state, active[first : first + BLOCK]).sum())
            going = (t[active] > endgame) & (state.step[active] > SHORTEST * t[active])
            active = active[going]
            blocks.tell(f"proving paths{REMARK}{steps} steps", P - len(active), P)
    return CertifiedPaths(t, at, steps, trials)


def _correct_points(
    system: MovingSystem, x: np.ndarray, t: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Points that Newton's method leads to, and the paths' derivatives by t there."""
    x = find_zeros(lambda x, i: system.at(x, t[i])[:2], x, CORRECTIONS, stop=ANYWHERE).x
    _, slopes, rates = system.at(x, t)
    return x, -newton_steps(rates, slopes)


def _try_step(system: MovingSystem, state: _PathStates, active: np.ndarray) -> np.ndarray:
    """Try one step of the active paths; which of them were proved."""
    t, x, rates = state.t[active], state.x[active], state.rates[active]
    end = t - state.step[active]
    end = np.where(end < 0.1 * state.step[active], 0.0, end)
    way = (end - t)[:, None]
    guess, far_rates = _correct_points(system, x + way * rates, end)
    curve = _hermite(x, guess, rates * way / 2, far_rates * way / 2)
    radii = state.sides[active]
    tube = _tube(system, curve, t, end, radii)
    first, last = (_end_of(curve, tube.inner, radii, s) for s in (-1, 1))
    proved = tube.proved & first.same(state.at.select_rows(active))
    done = active[proved]
    state.x[done], state.rates[done], state.t[done] = guess[proved], far_rates[proved], end[proved]
    state.at.centres[done], state.at.inner[done] = last.centres[proved], last.inner[proved]
    state.at.outer[done] = last.outer[proved]
    _control_steps(state, active, tube, proved)
    return proved


def _control_steps(state: _PathStates, active: np.ndarray, tube: _Tube, proved: np.ndarray) -> None:
    """Sides and steps of the next trial."""
    side = np.clip(ACROSS / tube.across, LEAST_FACTOR, MOST_FACTOR)
    side = np.where(np.isfinite(side), side, LEAST_FACTOR)
    error = tube.error / side
    old = state.sides[active]
    shape = np.where(np.isfinite(tube.image), tube.image, old)
    shape = np.maximum(shape, FLATTEST * shape.max(axis=1, keepdims=True))
    shape = np.sqrt(shape / shape.max(axis=1, keepdims=True) * old / old.max(axis=1, keepdims=True))
    step = np.minimum((ALONG / tube.along) ** 0.5, (ERROR / np.maximum(error, 1e-300)) ** 0.25)
    step = np.where(np.isnan(step), LEAST_FACTOR, step)
    most = np.where(proved, MOST_FACTOR, 0.7)
    shape *= (old.max(axis=1) / shape.max(axis=1))[:, None]
    state.sides[active] = shape * side[:, None]
    state.step[active] *= np.clip(step, LEAST_FACTOR, most)


def _hermite(x: np.ndarray, y: np.ndarray, dx: np.ndarray, dy: np.ndarray) -> np.ndarray:
    """The cubic in s with these values and derivatives at -1 and 1, shape ``(4, P, n)``."""
    second = (dy - dx) / 4
    third = ((dx + dy) - (y - x)) / 4
    return np.stack([(x + y) / 2 - second, (y - x) / 2 - third, second, third])


def _end_of(curve: np.ndarray, inner: np.ndarray, radii: np.ndarray, s: int) -> ProvedZeros:
    """The zero at an end of a tube, by boxes about a centre that is rounded."""
    point = curve[0] + s * curve[1] + curve[2] + s * curve[3]
    rounding = magnitude(curve).sum(axis=0) * 32 * UNIT
    return ProvedZeros(point, (inner + rounding) * UP, (radii - rounding) / UP)


@dataclass(frozen=True, eq=False)
class _Tube:
    """Boxes along a curve.

    Attributes:
        proved: where they hold exactly one zero each; inner: radii that it lies within.
        error, along, across: parts of the sides, see `ERROR`.
    """

    proved: np.ndarray
    inner: np.ndarray
    image: np.ndarray
    error: np.ndarray
    along: np.ndarray
    across: np.ndarray


def _tube(
    system: MovingSystem, curve: np.ndarray, begin: np.ndarray, end: np.ndarray, radii: np.ndarray
) -> _Tube:
    """Krawczyk's test for all boxes of these radii about a curve at once."""
    _, P, n = curve.shape
    mid = np.zeros((LENGTH, P, n), dtype=complex)
    mid[:4] = curve
    values = system.values_along(Discs(mid, np.zeros(mid.shape)), times(begin, end, LENGTH))
    rad = np.zeros((SLOPES, P, n))
    rad[0], rad[2] = radii, magnitude(curve[3])
    box = Discs(curve[:SLOPES], rad)
    slopes = system.slopes_along(box, times(begin, end, SLOPES))
    inverse = invert_matrices(slopes.mid[0])
    moving = -inverse @ slopes.mid[1] @ inverse
    column = Discs(values.mid[..., None], values.rad[..., None])
    off, rounding = (part[..., 0] for part in _bound_product(inverse, moving, column, 0.0))
    step = (off + rounding) * UP
    bent, wide = _bound_product(inverse, moving, slopes, np.eye(n))
    rest = (bent + wide) * UP
    inner = radii
    for k in range(3):
        inner = (step + (rest @ inner[..., None])[..., 0]) * UP
        if k == 0:
            proved = (inner < radii).all(axis=1)
    # Shorter steps are of no use where the curve is as good as doubles can say.
    parts = (
        np.maximum(off - rounding, 0.0),
        (bent @ radii[..., None])[..., 0],
        (wide @ radii[..., None])[..., 0],
    )
    return _Tube(
        proved,
        inner,
        (rest @ radii[..., None])[..., 0],
        *((p / radii).max(axis=1, initial=0.0) for p in parts),
    )


def _bound_product(
    inverse: np.ndarray, moving: np.ndarray, series: Discs, identity: np.ndarray | float
) -> tuple[np.ndarray, np.ndarray]:
    """Bounds of ``(inverse + s moving) series(s) - identity``: of midpoints, and of the rest."""
    length = len(series.mid)
    rounding = rounding_of_sum(2 * inverse.shape[-1])
    sizes = magnitude(series.mid)
    loose = series.rad + rounding * sizes
    size, move = magnitude(inverse), magnitude(moving)
    exact, rest = 0.0, 0.0
    for k in range(length):
        mid = inverse @ series.mid[k]
        rest = rest + size @ loose[k]
        if k:
            mid = mid + moving @ series.mid[k - 1]
            rest = rest + move @ loose[k - 1]
        else:
            mid = mid - identity
        exact = exact + magnitude(mid)
    rest = rest + move @ (sizes[-1] + series.rad[-1])
    return exact * (UP + rounding), rest * (UP + rounding) + LEAST
