"""Newton's method in eight lanes, each until rounding errors are all that is left."""

from __future__ import annotations

from nag.machine_code.lanes import load, select_less, splat, store
from nag.tracking.ends.linear_algebra import equilibrate, newton_correction, vanishing
from nag.tracking.ends.log_series import lay_patches, values
from nag.tracking.ends.records import IDLE
from nag.tracking.evaluation import factors_at, jacobian, products
from nag.tracking.linear_algebra import factorize
from nag.tracking.numbers.complex_numbers import largest

# Rounding errors that doubles make of a point, with room to spare.
DOUBLES = 1e-13
# Decides: Coordinates not known at a start in doubles.
FLOOR = 1e-9
# Corrections of a point.
MOST_CORRECTIONS = 12
# Decides: Rounding errors in a correction that need not contract any more.
STAGNANT = 1e2


def lay_floors(z, s, r):
    """The least sizes by which columns are scaled, and in which corrections count.

    Small coordinates are not known at points that come from doubles; nor are those that have never
    exceeded their rounding errors, or vanish at a limit. What does not exceed its rounding errors
    at the base has no size of its own. Scaled by it, rows that hold nothing else would be pivots,
    and rounding errors of others all that is left of these.
    """
    half = splat(0.5)
    zero = splat(0.0)
    floor = splat(FLOOR)
    rough = load(r.rough, 0)
    based = load(r.based, 0)
    for j in range(s.N):
        size = z.magnitude(z.read(r.slots, j))
        begun = select_less(half, rough, floor, zero)
        begun = select_less(half, load(r.met, j), begun, floor)
        begun = select_less(zero, size, begun, floor)
        known, weight = load(r.base_sizes, j), load(r.base_weights, j)
        least = select_less(known, weight, weight, zero)
        store(r.least, j, select_less(half, based, least, begun))
        store(r.floors, j, select_less(half, based, zero, begun))


def weigh(z, s, r):
    """Sizes of the coordinates by which columns are scaled."""
    for j in range(s.N):
        size = largest(z.magnitude(z.read(r.slots, j)), load(r.least, j))
        store(r.weights, j, select_less(splat(0.0), size, size, splat(1.0)))


def linearize(z, s, r, rough, close):
    """The factorised Jacobian at the points, Newton's correction and its measures.

    ``rough, close``: see `newton_correction`.
    """
    products(z, s, r, 0, s.products)
    values(z, s, r)
    jacobian(z, s, r)
    equilibrate(z, s, r)
    factorize(z, s.N, r.matrix, r.pivots)
    newton_correction(z, s, r, rough, close)


def correct(z, s, r, b):
    """Newton's method in all lanes, until each has settled or failed.

    At last everything is evaluated once more at the corrected points, whatever number of
    corrections a lane and its neighbours took.
    """
    for lane in range(8):
        r.settled[lane] = 0.0 if r.mode[lane] > IDLE else 2.0
    lay_patches(z, s, r)
    factors_at(z, s, r)
    half = splat(0.5)
    nothing = z.exact(splat(0.0), splat(0.0))
    # What vanishes along a path is as large, at points from doubles, as their rounding errors are.
    from_doubles = load(r.rough, 0) - load(r.based, 0)
    rough = select_less(half, from_doubles, splat(DOUBLES / z.number.epsilon), splat(0.0))
    close = splat(1.0) if b.close > 0 else splat(0.0)
    lay_floors(z, s, r)
    weigh(z, s, r)
    for k in range(MOST_CORRECTIONS):
        linearize(z, s, r, rough, close)
        for lane in range(8):
            if r.settled[lane] < 0.5:
                r.evaluated[lane] += 1
        settled = load(r.settled, 0)
        for j in range(s.N):
            x = z.read(r.slots, j)
            correction = z.read(r.right, j)
            moved = z.choose(half, vanishing(z, x, correction), nothing, z.add(x, correction))
            z.write(r.slots, j, z.choose(settled, half, moved, x))
        busy = 0
        for lane in range(8):
            if r.settled[lane] < 0.5:
                r.settled[lane] = _judge_correction(z, r, lane, k)
                if r.settled[lane] < 0.5:
                    busy += 1
        if busy == 0:
            break
    weigh(z, s, r)
    linearize(z, s, r, rough, close)
    for lane in range(8):
        excess = r.measures[8 + lane]
        r.evaluated[lane] += 1
        r.excess[lane] = max(1.0, excess)
        r.known[lane] = r.measures[16 + lane] * r.excess[lane]
        if not excess <= STAGNANT or not r.measures[24 + lane] < 0.5:
            r.settled[lane] = 2.0


def _judge_correction(z, r, lane, k):
    """0 if a lane needs another correction, 1 if it has settled, 2 if it failed."""
    eta = r.measures[lane]
    excess = r.measures[8 + lane]
    if not eta < 0.5 or not r.measures[24 + lane] < 0.5:
        r.first[lane] = 1.0 if k == 0 else r.first[lane]
        return 2.0
    noise = excess <= 1.0
    if k == 0:
        r.first[lane] = eta
        r.contraction[lane] = 0.0
        r.last[lane] = eta
        return 1.0 if noise else 0.0
    theta = eta / r.last[lane]
    r.last[lane] = eta
    if k == 1:
        # A second correction that is half rounding errors says how large it is at most.
        curvature = theta / r.first[lane]
        if excess <= STAGNANT:
            curvature = min(curvature, r.curvature[lane])
        r.curvature[lane] = curvature
    if noise:
        return 1.0
    if k == 1:
        r.contraction[lane] = theta
    if theta > 0.25:
        # Corrections that do not contract any more may be a few rounding errors.
        return 1.0 if excess <= STAGNANT else 2.0
    # The next correction is about theta^2 times this one.
    if eta * theta * theta <= z.number.epsilon:
        return 1.0
    return 2.0 if k == MOST_CORRECTIONS - 1 else 0.0
