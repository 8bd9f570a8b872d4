"""A path as a branch near t = 0: what its Taylor coefficients say, and where they lead.

Taylor coefficients are those in h, t going to ``t exp(h)``, in doubles: ``plain`` of the
coordinates, ``logs`` of their logarithms. A branch is ``x_j = t^v_j`` times a
power series in ``r = t ** (1 / w)``, so the derivative of ``log x_j`` is ``v_j`` plus one: its
series in r converges as far as the next branch point is from 0, for the true w only.
"""

from __future__ import annotations

import math

from nag.machine_code.lanes import any_less, fma, load, select_less, splat, square_root, store
from nag.numerics.doubles import SMALLEST
from nag.tracking.numbers.complex_numbers import SMALL_SQUARE, largest, length

# Longest step, in log t.
LONGEST = 40.0


def _keep(z, data, k, accepted, value):
    z.write(data, k, z.choose(splat(0.5), accepted, value, z.read(data, k)))


def expand_logarithms(z, s, r, order):
    """Taylor coefficients of the logarithms of the coordinates at the point."""
    nothing = z.exact(splat(0.0), splat(0.0))
    n = s.N
    size = n + 1 + s.value_products
    for j in range(n):
        x = z.read(r.slots, j)
        inverse = z.inverse(x)
        # m x_m = sum of i l_i x_(m-i) for l = log x; the sums take the place of l for now.
        for m in range(1, order + 1):
            own = z.read(r.series, (m - 1) * size + j)
            total = z.gather_real(nothing, z.negative(own), z.number.exact(splat(float(m))))
            for i in range(1, m):
                left = z.read(r.change, i)
                total = z.gather(total, left, z.read(r.series, (m - i - 1) * size + j))
            total = z.multiply(z.gathered(total), z.negative(inverse))
            z.write(r.change, m, total)
            z.write(r.fresh, (m - 1) * n + j, z.stretch(total, z.number.same(s.inverses, m)))


def estimate_radius(z, s, r, order):
    """Radius of convergence at the point, and the last term, into the first two measures.

    Of each coordinate that series counts, its own or its logarithm's, whose last term is smaller.
    """
    zero = splat(0.0)
    size = s.N + 1 + s.value_products
    last = zero
    second = zero
    third = zero
    for j in range(s.N):
        weight = largest(load(r.weights, j), z.magnitude(z.read(r.slots, j)))
        share = z.magnitude(z.read(r.slots, j)) / weight
        weight = splat(1.0) / weight
        plain = z.magnitude(z.read(r.series, (order - 1) * size + j)) * weight
        log = z.magnitude(z.read(r.fresh, (order - 1) * s.N + j)) * share
        last = largest(last, select_less(log, plain, log, plain))
        own = z.magnitude(z.read(r.series, (order - 2) * size + j)) * weight
        other = z.magnitude(z.read(r.fresh, (order - 2) * s.N + j)) * share
        second = largest(second, select_less(log, plain, other, own))
        own = z.magnitude(z.read(r.series, (order - 3) * size + j)) * weight
        other = z.magnitude(z.read(r.fresh, (order - 3) * s.N + j)) * share
        third = largest(third, select_less(log, plain, other, own))
    least = splat(SMALLEST)
    inverse = splat(1.0) / largest(last, least)
    radius = largest(second * inverse, square_root(third * inverse))
    store(r.measures, 0, select_less(least, last, radius, splat(LONGEST)))
    store(r.measures, 1, last)


def keep_series(z, s, r, order):
    """Taylor coefficients of coordinates and logarithms into the base, in the accepted lanes."""
    accepted = load(r.accepted, 0)
    n = s.N
    size = n + 1 + s.value_products
    for j in range(n):
        for m in range(1, order + 1):
            k = (m - 1) * n + j
            _keep(z, r.coordinates, k, accepted, z.read(r.series, (m - 1) * size + j))
            _keep(z, r.logarithms, k, accepted, z.read(r.fresh, k))
        _round(z, s, r, order, j)


def _round(z, s, r, order, j):
    """Taylor coefficients of a coordinate and its logarithm as doubles."""
    q = 2 * j * (order + 1)
    re, im = z.rounded(z.read(r.base, j))
    store(r.plain, q, re)
    store(r.plain, q + 1, im)
    for m in range(1, order + 1):
        re, im = z.rounded(z.read(r.coordinates, (m - 1) * s.N + j))
        store(r.plain, q + 2 * m, re)
        store(r.plain, q + 2 * m + 1, im)
        re, im = z.rounded(z.read(r.logarithms, (m - 1) * s.N + j))
        store(r.logs, q + 2 * m, re)
        store(r.logs, q + 2 * m + 1, im)


def _last_terms(z, s, r, order, j):
    """Sizes of the last coefficients of a coordinate's logarithm, times it, and of itself."""
    q = 2 * (j * (order + 1) + order)
    plain = length(load(r.plain, q), load(r.plain, q + 1))
    log = length(load(r.logs, q), load(r.logs, q + 1))
    return log * z.magnitude(z.read(r.base, j)), plain


def predict(z, s, r, order, wanted, finishing, h):
    """Points a step ``-h`` in log t on, or at t = 0 where finishing, in the lanes wanted.

    A coordinate is predicted by the series, its own or its logarithm's, whose last term is smaller.
    """
    n = s.N
    half = splat(0.5)
    step = z.number.exact(splat(0.0) - h)
    for j in range(n):
        base = z.read(r.base, j)
        log = z.exact(splat(0.0), splat(0.0))
        plain = log
        end = log
        for m in range(order, 0, -1):
            k = (m - 1) * n + j
            own = z.read(r.coordinates, k)
            log = z.stretch(z.add(log, z.read(r.logarithms, k)), step)
            plain = z.stretch(z.add(plain, own), step)
            end = z.add(end, z.stretch(own, z.number.same(s.at_end, m)))
        last, other = _last_terms(z, s, r, order, j)
        value = z.add(base, plain)
        if any_less(last, other):
            by_log = z.multiply(base, z.exponential(log, s.inverses))
            value = z.choose(last, other, by_log, value)
        value = z.choose(half, finishing, z.add(base, end), value)
        z.write(r.slots, j, z.choose(half, wanted, value, z.read(r.slots, j)))
    zero = z.number.exact(splat(0.0))
    shrunk, _ = z.exponential((step, zero), s.inverses)
    t = z.number.multiply(z.number.read(r.time, 0), shrunk)
    t = z.number.choose(half, finishing, zero, t)
    z.number.write(r.t, 0, z.number.choose(half, wanted, t, z.number.read(r.t, 0)))


def _size(data, q, lane):
    square = data[8 * q + lane] ** 2 + data[8 * (q + 1) + lane] ** 2
    if square < SMALL_SQUARE:
        return abs(complex(data[8 * q + lane], data[8 * (q + 1) + lane]))
    return math.sqrt(square)


def _reach(first, second, order, goal):
    """How far a series leads whose last coefficients have these sizes."""
    h = LONGEST
    if first > 0.0:
        h = min(h, (goal / first) ** (1.0 / order))
    if second > 0.0:
        h = min(h, (goal / second) ** (1.0 / (order - 1)))
    return h


def longest_step(s, r, order, lane, goal):
    """The longest step with an expected error of ``goal``, relative to each coordinate's weight."""
    h = LONGEST
    for j in range(s.N):
        q = 2 * (j * (order + 1) + order)
        weight = r.base_weights[8 * j + lane]
        here = _reach(
            _size(r.plain, q, lane) / weight, _size(r.plain, q - 2, lane) / weight, order, goal
        )
        if r.base_sizes[8 * j + lane] >= weight:
            here = max(
                here, _reach(_size(r.logs, q, lane), _size(r.logs, q - 2, lane), order, goal)
            )
        h = min(h, here)
    return h


def _at_zero(s, data, q, order, m, lane):
    """Coefficient ``m`` in r = -rho, w = 1, of a series in h; entry ``q`` is its first."""
    value = 0.0 + 0.0j
    for k in range(1, m + 1):
        c = s.logarithm[k * (order + 1) + m]
        p = q + 2 * k
        value += c * complex(data[8 * p + lane], data[8 * (p + 1) + lane])
    return value if m % 2 == 0 else -value


def tail_at_end(s, r, order, lane):
    """Size of the last terms at t = 0 of the coordinates' power series in t, over their weights."""
    most = 0.0
    for j in range(s.N):
        q = 2 * j * (order + 1)
        last = abs(_at_zero(s, r.plain, q, order, order, lane))
        before = abs(_at_zero(s, r.plain, q, order, order - 1, lane))
        most = max(most, (last + before) / r.base_weights[8 * j + lane])
    return most


def tails(s, r, order, w):
    """Largest last term at r = 0 of the derivatives of the logarithms as series in t^(1/w).

    Coordinates that do not exceed their rounding error have no logarithm and do not count.
    """
    most = splat(0.0)
    for j in range(s.N):
        total = splat(0.0)
        for m in range(order - 2, order):
            re = splat(0.0)
            im = splat(0.0)
            power = 1.0
            for k in range(m + 1):
                c = splat(s.logarithm[k * (order + 1) + m] * power * (k + 1))
                power = power * w
                q = 2 * (j * (order + 1) + k + 1)
                re = fma(c, load(r.logs, q), re)
                im = fma(c, load(r.logs, q + 1), im)
            total = total + square_root(fma(re, re, im * im))
        size = load(r.base_sizes, j)
        known = select_less(size, load(r.base_weights, j), splat(0.0), total)
        most = select_less(most, known, known, most)
    return most


def extrapolate(z, s, r, order, winding):
    """What each coordinate's logarithm is at r = 0: four complex numbers for each.

    The derivative there, which is the order v, and the last term of its series; the change of the
    logarithm from here and its derivative with respect to r over r here, both but for ``w v`` times
    their first weight, as ``v h`` does not end.
    """
    w = z.number.exact(winding)
    for j in range(s.N):
        slope = z.exact(splat(0.0), splat(0.0))
        last = slope
        change = slope
        bend = slope
        power = z.number.exact(splat(1.0))
        for k in range(order):
            log = z.stretch(z.read(r.logarithms, k * s.N + j), power)
            slope = z.add(slope, z.stretch(log, z.number.same(s.slope_at_end, k)))
            last = z.add(last, z.stretch(log, z.number.same(s.last_of_slope, k)))
            power = z.number.multiply(power, w)
            log = z.stretch(log, w)
            change = z.add(change, z.stretch(log, z.number.same(s.at_end, k + 1)))
            bend = z.add(bend, z.stretch(log, z.number.same(s.bend_at_end, k + 1)))
        z.write(r.limits, 4 * j, slope)
        z.write(r.limits, 4 * j + 1, last)
        z.write(r.limits, 4 * j + 2, change)
        z.write(r.limits, 4 * j + 3, bend)
