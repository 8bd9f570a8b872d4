"""The points that steps start from, and those that the next arithmetic may start from."""

from __future__ import annotations

from nag.machine_code.lanes import load, select_less, splat, store
from nag.numerics.doubles import SLACK
from nag.tracking.ends.branch import keep_series
from nag.tracking.numbers.complex_numbers import largest

# Rounding error times Newton's constant at which a point is kept for the next arithmetic to start
# from.
SAFE = 1e-6
# Rounding errors of the residuals that the error of a point stands for, and second derivatives of
# equations of the usual degrees, both in parts of their terms.
RESIDUAL, SECOND = 8.0, 10.0


def keep(z, s, r, order):
    """Make the accepted points the bases of further steps."""
    half = splat(0.5)
    accepted = load(r.accepted, 0)
    for j in range(s.N):
        x = z.read(r.slots, j)
        z.write(r.base, j, z.choose(half, accepted, x, z.read(r.base, j)))
        size = z.magnitude(x)
        store(r.base_sizes, j, select_less(half, accepted, size, load(r.base_sizes, j)))
        weight, known = load(r.weights, j), load(r.base_weights, j)
        weight = largest(weight, size)
        store(r.base_weights, j, select_less(half, accepted, weight, known))
        error, known = load(r.errors, j) * load(r.excess, 0), load(r.base_errors, j)
        store(r.base_errors, j, select_less(half, accepted, error, known))
    time = z.number.read(r.time, 0)
    z.number.write(r.time, 0, z.number.choose(half, accepted, z.number.read(r.t, 0), time))
    _keep_safe(z, s, r)
    keep_series(z, s, r, order)


def steepest(z, r, lane):
    """What Newton's constant may be, in a direction that corrections have not had."""
    return SECOND * r.known[lane] / (RESIDUAL * z.number.epsilon)


def _keep_safe(z, s, r):
    """Keep the bases that are known so well that the next arithmetic may start from them.

    Newton's constant is at most as large as the inverse Jacobian makes it, of which the error of
    the point says how large it is; corrections that are rounding errors say nothing of it. Where
    rounding errors are all that is left of a coordinate that was known, it is not that path's.
    """
    half = splat(0.5)
    accepted = load(r.accepted, 0)
    lost = splat(0.0)
    for j in range(s.N):
        error, met = splat(SLACK) * load(r.base_errors, j), load(r.met, j)
        known = select_less(error, load(r.base_sizes, j), splat(1.0), splat(0.0))
        lost = largest(lost, met - known)
        store(r.met, j, select_less(half, accepted, largest(met, known), met))
    store(r.measures, 1, lost)
    for lane in range(8):
        curvature = max(r.curvature[lane], steepest(z, r, lane), 1.0)
        r.measures[lane] = 0.0
        well = r.known[lane] * curvature <= SAFE and r.measures[8 + lane] < 0.5
        if r.accepted[lane] > 0.5 and well:
            r.measures[lane] = 1.0
            r.saved[lane] = 1.0
    safe = load(r.measures, 0)
    for j in range(s.N):
        z.write(r.safe, j, z.choose(half, safe, z.read(r.base, j), z.read(r.safe, j)))
    time = z.number.choose(half, safe, z.number.read(r.time, 0), z.number.read(r.safe_time, 0))
    z.number.write(r.safe_time, 0, time)
