"""Values and Taylor coefficients of a homotopy in doubles, as series in t; patches of unit norm.

``z`` stands for `nag.tracking.numbers.doubles`, see `nag.tracking.evaluation`.
"""

from __future__ import annotations

import math

from nag.machine_code.lanes import fma, fnma, load, splat, square_root
from nag.numerics.doubles import UNIT
from nag.tracking.evaluation import (
    block_of_jacobian,
    block_of_values,
    jacobian,
    line,
    linear_entries,
    weigh_block,
)
from nag.tracking.linear_algebra import PHASE


def factors_or_powers_at(z, s, w):
    """Factors of all parts at the lanes' t; powers of exp(t), and their exponents, if toric."""
    z.write(w.slots, s.N, z.exact(splat(1.0), splat(0.0)))
    if s.toric == 0:
        t = load(w.t, 0)
        for p in range(s.parts):
            a = z.read(w.factor_at_end, p)
            z.write(w.factor, p, z.add_multiple(a, z.read(w.rate, p), t))
        return
    for lane in range(8):
        first = w.path[lane] * s.parts
        for p in range(s.parts):
            weight = s.weights[first + p]
            w.factor[16 * p + lane] = math.exp(-weight * w.t[lane])
            w.factor[16 * p + 8 + lane] = -weight


def factors_of_member(s, w, lane, member):
    """The factors of a lane's own member at t = 0, and how they change with t."""
    for p in range(s.parts):
        first = 4 * (member * s.parts + p)
        w.factor_at_end[16 * p + lane] = s.factors[first]
        w.factor_at_end[16 * p + 8 + lane] = s.factors[first + 1]
        w.rate[16 * p + lane] = s.factors[first + 2]
        w.rate[16 * p + 8 + lane] = s.factors[first + 3]


def _add_slope(z, s, w, part, x, slope):
    """Add a number times the derivative of a part's factor."""
    if s.moving[part] < 2:
        return slope
    return z.gather(slope, x, z.read(w.rate, part))


def _row(z, s, w, k, slots):
    """Polynomial row ``k`` of the slots, and its derivative by t alone."""
    total = z.exact(splat(0.0), splat(0.0))
    slope = total
    for b in range(s.value_begin[k], s.value_begin[k + 1]):
        x = block_of_values(z, s, b, s.value, slots)
        total = z.add(total, weigh_block(z, s, w, s.value_part[b], x))
        slope = _add_slope(z, s, w, s.value_part[b], x, slope)
    return total, slope


def values(z, s, w):
    """Minus the values of all rows at the lanes' points and t, into the right-hand side.

    Besides, the derivative of polynomial rows, and of linear ones that move, by t alone.
    """
    for k in range(s.rows):
        total, slope = _row(z, s, w, k, w.slots)
        z.write(w.right, k, z.negative(total))
        z.write(w.slope, k, slope)
    t = load(w.t, 0)
    for k in range(s.linear):
        total = line(z, s, s.A0, k, w.slots, 0)
        if s.linear_moving[k] != 0:
            slope = line(z, s, s.A1, k, w.slots, 0)
            z.write(w.slope, s.rows + k, slope)
            total = z.add_multiple(total, slope, t)
        z.write(w.right, s.rows + k, z.negative(total))
    patches = s.rows + s.linear
    for g in range(s.groups):
        z.write(w.right, patches + g, z.exact(splat(1.0), splat(0.0)))
    for j in range(s.N):
        k = patches + s.group_of[j]
        term = z.subtract_product(z.read(w.right, k), z.read(w.patch, j), z.read(w.slots, j))
        z.write(w.right, k, term)


def rounding_errors(z, s, w):
    """Errors that rounding makes of the values of all rows, into the right-hand side.

    Those of a row's terms are independent of each other: what they make together is about the root
    of the sum of their squares.
    """
    for k in range(s.rows):
        total = splat(0.0)
        for b in range(s.value_begin[k], s.value_begin[k + 1]):
            size = splat(0.0)
            for q in range(s.value_start[b], s.value_start[b + 1]):
                square = z.square(z.read(w.slots, s.value_slot[q]))
                size = fma(splat(_square(s.value, q)), square, size)
            part = s.value_part[b]
            if s.moving[part] != 0:
                f = load(w.factor, 2 * part)
                size = size * (f * f if s.toric != 0 else z.square(z.read(w.factor, part)))
            total = total + size
        _write_error(z, w, k, total)
    t = load(w.t, 0)
    for k in range(s.linear):
        total = splat(0.0)
        for j in range(s.N):
            fixed = splat(_square(s.A0, k * s.N + j))
            moving = splat(_square(s.A1, k * s.N + j))
            total = fma(fma(moving, t * t, fixed), z.square(z.read(w.slots, j)), total)
        _write_error(z, w, s.rows + k, total)
    for g in range(s.groups):
        _write_error(z, w, s.rows + s.linear + g, splat(1.0))


def _square(data, k):
    return data[2 * k] * data[2 * k] + data[2 * k + 1] * data[2 * k + 1]


def _write_error(z, w, k, square):
    """Rounding errors of terms with a sum of squares; phases that no smooth vector cancels."""
    size = square_root(square) * splat(UNIT)
    re, im = math.cos(PHASE * (k * k)), math.sin(PHASE * (k * k))
    z.write(w.right, k, z.exact(size * splat(re), size * splat(im)))


def jacobian_and_slopes(z, s, w):
    """The Jacobian of all rows, and the derivative of its polynomial rows by t if these move."""
    if s.moves == 0:
        jacobian(z, s, w)
        return
    for k in range(s.rows * s.N):
        total = z.exact(splat(0.0), splat(0.0))
        slope = total
        for b in range(s.jacobian_begin[k], s.jacobian_begin[k + 1]):
            x = block_of_jacobian(z, s, b, w.slots)
            total = z.add(total, weigh_block(z, s, w, s.jacobian_part[b], x))
            slope = _add_slope(z, s, w, s.jacobian_part[b], x, slope)
        z.write(w.matrix, k, total)
        z.write(w.matrix_slope, k, slope)
    linear_entries(z, s, w)


def complete_slope(z, s, w):
    """Add what the solution in the right-hand side contributes to the derivative by t alone.

    That is linear in it: for polynomial rows, the derivative of the Jacobian times it.
    """
    n = s.N
    for k in range(s.rows if s.moves != 0 else 0):
        re, im = z.read(w.slope, k)
        # Two sums of each part, which do not wait for one another.
        re_too = splat(0.0)
        im_too = splat(0.0)
        for j in range(n):
            q = k * n + j
            if s.jacobian_begin[q] < s.jacobian_begin[q + 1]:
                mr, mi = z.read(w.matrix_slope, q)
                x, y = z.read(w.right, j)
                re = fma(mr, x, re)
                im = fma(mr, y, im)
                re_too = fnma(mi, y, re_too)
                im_too = fma(mi, x, im_too)
        z.write(w.slope, k, z.exact(re + re_too, im + im_too))
    for k in range(s.linear):
        if s.linear_moving[k] != 0:
            z.write(w.slope, s.rows + k, line(z, s, s.A1, k, w.right, 0))


def _toric_right_side(z, s, w, k):
    for j in range(s.N):
        z.write(w.right, j, z.exact(splat(0.0), splat(0.0)))
    size = s.N + 1 + s.inner
    for b in range(s.value_blocks):
        part = s.value_part[b]
        q = s.value_start[b]
        slot = s.value_slot[q]
        minus = load(w.factor, 2 * part + 1)
        x = z.read(w.slots, slot)
        # Horner's rule for the sum of minus^j / j! times the coefficient of order k - j.
        for m in range(1, k):
            rate = minus * splat(1.0 / (k - m + 1))
            x = z.add_multiple(z.read(w.series, (m - 1) * size + slot), x, rate)
        x = z.stretch(x, minus)
        if k > 1:
            x = z.add(x, z.read(w.partial, slot))
        c = z.stretch(z.same(s.value, q), load(w.factor, 2 * part))
        row = s.value_place[b]
        z.write(w.right, row, z.subtract(z.read(w.right, row), z.multiply(c, x)))


def right_side(z, s, w, k):
    """Minus the Taylor coefficient of order ``k`` of the rows, that of the point taken as 0.

    The derivative by t alone does not depend on t: its coefficient of order ``k - 1`` is what t
    contributes, and is replaced by the next one, as far as lower orders give it.
    """
    if s.toric != 0:
        _toric_right_side(z, s, w, k)
        return
    for j in range(s.N):
        z.write(w.right, j, z.negative(z.read(w.slope, j)))
        z.write(w.slope, j, z.exact(splat(0.0), splat(0.0)))
    for j in range(s.rows if k > 1 else 0):
        total, slope = _row(z, s, w, j, w.partial)
        z.write(w.right, j, z.subtract(z.read(w.right, j), total))
        z.write(w.slope, j, slope)


def normalize(z, s, w):
    """Scale the lanes' points to unit norm in each group and lay the patch through them."""
    for g in range(s.groups):
        total = splat(0.0)
        for j in range(s.N):
            if s.group_of[j] == g:
                total = z.add_square(total, z.read(w.slots, j))
        scale = splat(1.0) / square_root(total)
        for j in range(s.N):
            if s.group_of[j] == g:
                x, y = z.stretch(z.read(w.slots, j), scale)
                z.write(w.slots, j, z.exact(x, y))
                z.write(w.patch, j, z.exact(x, splat(0.0) - y))
