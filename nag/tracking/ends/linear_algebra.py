"""Newton's correction with equilibrated rows and columns, and what rounding makes of it."""

from __future__ import annotations

import math

from nag.machine_code.lanes import fma, load, select_less, splat, square_root, store
from nag.numerics.doubles import LARGEST, SLACK, SMALLEST
from nag.tracking.linear_algebra import PHASE, order_rows
from nag.tracking.numbers.complex_numbers import largest
from nag.tracking.numbers.error_free import power_near_inverse

# Decides: What a correction leaves of a coordinate that it takes away: a zero along the whole path.
GONE = 1e-6
# Decides: Coordinate of a point from doubles that may be rounding alone. More would hide
# corrections that lead away from the path.
ROUGHEST = 1e-6


def _power_near_inverse(r, value):
    """Powers of two near the inverses of the lanes' values; 1 where a value is none."""
    store(r.measures, 0, value)
    for lane in range(8):
        size = r.measures[lane]
        finite = size > SMALLEST and size < LARGEST
        r.measures[lane] = power_near_inverse(size) if finite else 1.0
    return load(r.measures, 0)


def equilibrate(z, s, r):
    """Multiply columns by the sizes of the coordinates, and rows by the inverse of their largest.

    Scales are powers of two, so that nothing is rounded.
    """
    n = s.N
    for j in range(n):
        power = _power_near_inverse(r, load(r.weights, j))
        store(r.columns, j, splat(1.0) / power)
    for i in range(n):
        most = splat(0.0)
        for j in range(n):
            size = z.magnitude(z.read(r.matrix, i * n + j)) * load(r.columns, j)
            most = largest(most, size)
        power = _power_near_inverse(r, most)
        store(r.scales, i, power)
        for j in range(n):
            entry = z.read(r.matrix, i * n + j)
            z.write(r.matrix, i * n + j, z.scale(entry, load(r.columns, j) * power))


def substitute(z, s, r, data):
    """Overwrite a right-hand side by the solution."""
    n = s.N
    for i in range(n):
        z.write(data, i, z.scale(z.read(data, i), load(r.scales, i)))
    order_rows(z, n, r.pivots, data)
    for i in range(1, n):
        z.write(data, i, _remainder(z, n, r.matrix, data, i, 0, i))
    for i in range(n - 1, -1, -1):
        total = _remainder(z, n, r.matrix, data, i, i + 1, n)
        z.write(data, i, z.multiply(total, z.read(r.matrix, i * n + i)))
    for j in range(n):
        z.write(data, j, z.scale(z.read(data, j), load(r.columns, j)))


def _remainder(z, n, matrix, data, i, begin, end):
    """Entry ``i`` of a vector less entries ``begin .. end - 1`` of row ``i`` times those of it."""
    total = z.negative(z.read(data, i))
    for j in range(begin, end):
        total = z.gather(total, z.read(matrix, i * n + j), z.read(data, j))
    return z.negative(z.gathered(total))


def vanishing(z, x, correction):
    """1 in the lanes where a correction takes a tiny coordinate away altogether, 0 elsewhere.

    Where equations hold a coordinate as a factor, zeros have no rounding errors to be told by.
    """
    size = z.magnitude(x)
    left = z.magnitude(z.add(x, correction))
    gone = select_less(left, splat(GONE) * size, splat(1.0), splat(0.0))
    return select_less(size, splat(z.number.small), gone, splat(0.0))


def _vanishing_step(z, s, r):
    """The largest correction of coordinates that are taken away, those that `vanishing` finds."""
    most = splat(0.0)
    for j in range(s.N):
        x, correction = z.read(r.slots, j), z.read(r.right, j)
        most = largest(most, vanishing(z, x, correction) * z.magnitude(correction))
    return most


def _gone(z, x, correction, beside):
    """`vanishing`, and corrections that are as nothing beside those of coordinates that vanish.

    A product of two such coordinates is a tiny coordinate that changes as much as it is large.
    """
    step = z.magnitude(correction)
    idle = select_less(step, beside * splat(z.number.small), splat(1.0), splat(0.0))
    idle = select_less(z.magnitude(x), splat(z.number.small), idle, splat(0.0))
    return largest(vanishing(z, x, correction), idle)


def make_noise(z, s, r):
    """Rounding errors of the rows; phases that grow as squares cancel no smooth vector."""
    for i in range(s.N):
        size = load(r.sizes, i) * splat(z.number.epsilon * 8.0)
        re, im = math.cos(PHASE * (i * i)), math.sin(PHASE * (i * i))
        z.write(r.noise, i, z.exact(size * splat(re), size * splat(im)))


def _lay_errors(z, s, r, beside):
    """Rounding errors of the coordinates, and the largest of them."""
    most = splat(1e-300)
    for j in range(s.N):
        size, step = z.magnitude(z.read(r.slots, j)), z.magnitude(z.read(r.right, j))
        error = fma(size, splat(z.number.epsilon), z.magnitude(z.read(r.noise, j)) + splat(1e-300))
        gone = _gone(z, z.read(r.slots, j), z.read(r.right, j), beside)
        error = select_less(splat(0.5), gone, largest(error, step), error)
        store(r.errors, j, error)
        most = largest(most, error)
    return most


def _lost_group(s, r):
    """1 in the lanes where the largest coordinate of a group does not exceed its error enough."""
    zero = splat(0.0)
    unknown = zero
    for g in range(s.groups):
        # Coordinates have about unit norm in each group.
        total = zero
        for j in range(s.N):
            if s.group_of[j] == g:
                error = load(r.errors, j)
                total = fma(error, error, total)
        lost = select_less(splat(1.0 / SLACK), square_root(total), splat(1.0), zero)
        unknown = largest(unknown, lost)
    return unknown


def newton_correction(z, s, r, rough, close):
    """Newton's correction into the right-hand side, rounding errors of the point, and measures.

    Measures of each lane: the largest correction over its coordinate's weight; the largest over
    its coordinate's rounding error; the largest rounding error over a coordinate that exceeds
    it a thousandfold; and 1 if the largest coordinate of a group does not. Corrections of
    coordinates smaller than their ``floors``, or than ``rough`` rounding errors and `ROUGHEST`,
    count as if they were of that size.

    Where paths run beside others, ``close`` is 1: a coordinate that is known no better than the
    others, beside the whole point, counts as if it were as large. How near the next path runs is
    known in that measure, and Newton's method cannot know the coordinate in its own.
    """
    n = s.N
    substitute(z, s, r, r.right)
    make_noise(z, s, r)
    substitute(z, s, r, r.noise)
    zero = splat(0.0)
    half = splat(0.5)
    thousand = splat(SLACK)
    eta = zero
    excess = zero
    known = zero
    whole = zero
    beside = _vanishing_step(z, s, r)
    # Points have about unit norm.
    share = close * (splat(1.0) / _lay_errors(z, s, r, beside))
    for j in range(n):
        size = z.magnitude(z.read(r.slots, j))
        step = z.magnitude(z.read(r.right, j))
        whole = whole + step
        error = load(r.errors, j)
        least = share * error
        size = largest(size, least)
        # What does not exceed its rounding error may be zero along the whole path; then its
        # Taylor coefficients are rounding errors as well, and larger.
        unresolved = largest(thousand * error, splat(z.number.small))
        weight = select_less(thousand * error, size, size, unresolved)
        gone = _gone(z, z.read(r.slots, j), z.read(r.right, j), beside)
        weight = select_less(half, gone, splat(z.number.small), weight)
        most = rough * error
        most = select_less(splat(ROUGHEST), most, splat(ROUGHEST), most)
        weight = largest(largest(weight, largest(least, load(r.floors, j))), most)
        store(r.weights, j, weight)
        eta = largest(eta, step / weight)
        excess = largest(excess, step / error)
        resolved = select_less(thousand * error, size, error / size, zero)
        known = largest(known, resolved)
    unknown = _lost_group(s, r)
    # What is not a number is not less than anything.
    huge = splat(1e300)
    eta = select_less(whole, huge, eta, huge)
    store(r.measures, 0, eta)
    store(r.measures, 1, excess)
    store(r.measures, 2, known)
    store(r.measures, 3, unknown)
