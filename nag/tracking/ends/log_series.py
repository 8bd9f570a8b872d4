"""Values and Taylor coefficients of a homotopy as series in the logarithm of t, in many digits.

The parameter of the series is h in ``t exp(h)``; ``z`` stands for
`nag.tracking.numbers.complex_numbers`, see `nag.tracking.evaluation`.
"""

from __future__ import annotations

import math

from nag.machine_code.lanes import fma, load, splat, store
from nag.tracking.evaluation import line, slope_of_factor
from nag.tracking.numbers.error_free import power_near_inverse_root


def values(z, s, r):
    """Minus the values of all rows into the right-hand side, and the sizes of their terms."""
    zero = splat(0.0)
    nothing = z.exact(zero, zero)
    for k in range(s.N):
        z.write(r.right, k, nothing)
        store(r.sizes, k, zero)
    for b in range(s.value_blocks):
        total = nothing
        size = zero
        for q in range(s.value_start[b], s.value_start[b + 1]):
            term = z.term(s.value, q, z.read(r.slots, s.value_slot[q]))
            total = z.add(total, term)
            size = size + z.magnitude(term)
        z.write(r.sums, b, total)
        part = s.value_part[b]
        if s.moving[part] != 0:
            factor = z.read(r.factor, part)
            total = z.weigh(total, factor)
            size = size * z.magnitude(factor)
        k = s.value_place[b]
        z.write(r.right, k, z.add(z.read(r.right, k), z.negative(total)))
        store(r.sizes, k, load(r.sizes, k) + size)
    t = z.number.read(r.t, 0)
    for k in range(s.linear):
        moving = line(z, s, s.A1, k, r.slots, 0)
        z.write(r.lines, k, moving)
        total = z.add_multiple(line(z, s, s.A0, k, r.slots, 0), moving, t)
        z.write(r.right, s.rows + k, z.negative(total))
        size = zero
        for j in range(s.N):
            q = 2 * (k * s.N + j)
            still = splat(math.sqrt(s.A0[q] ** 2 + s.A0[q + 1] ** 2))
            slope = splat(math.sqrt(s.A1[q] ** 2 + s.A1[q + 1] ** 2))
            size = fma(fma(load(r.t, 0), slope, still), z.magnitude(z.read(r.slots, j)), size)
        store(r.sizes, s.rows + k, size)
    _patches(z, s, r)


def _patches(z, s, r):
    """Minus the values of the patches, each 0 at the point that it was laid at."""
    first = s.rows + s.linear
    for g in range(s.groups):
        z.write(r.right, first + g, z.read(r.levels, g))
        store(r.sizes, first + g, splat(1.0))
    for j in range(s.N):
        k = first + s.group_of[j]
        p = z.exact(load(r.patch, 2 * j), load(r.patch, 2 * j + 1))
        term = z.multiply(p, z.read(r.slots, j))
        z.write(r.right, k, z.add(z.read(r.right, k), z.negative(term)))


def lay_patches(z, s, r):
    """Scale each group by a power of two to about unit norm, and lay its patch through it."""
    for g in range(s.groups):
        total = splat(0.0)
        for j in range(s.N):
            if s.group_of[j] == g:
                re, im = z.rounded(z.read(r.slots, j))
                total = fma(re, re, fma(im, im, total))
        store(r.measures, 0, total)
        for lane in range(8):
            square = r.measures[lane]
            r.measures[lane] = power_near_inverse_root(square) if square > 0.0 else 1.0
        power = load(r.measures, 0)
        total = total * power * power
        level = z.exact(splat(0.0), splat(0.0))
        for j in range(s.N):
            if s.group_of[j] == g:
                x = z.scale(z.read(r.slots, j), power)
                z.write(r.slots, j, x)
                re, im = z.rounded(x)
                p = re / total
                q = splat(0.0) - im / total
                store(r.patch, 2 * j, p)
                store(r.patch, 2 * j + 1, q)
                level = z.add(level, z.multiply(z.exact(p, q), x))
        z.write(r.levels, g, level)


def block_sums(z, s, r, m, slots, first):
    """Taylor coefficients of order ``m`` of the blocks and of the linear rows' moving parts.

    Those of the slots, ``first`` is that of the first coordinate, are given.
    """
    nothing = z.exact(splat(0.0), splat(0.0))
    for b in range(s.value_blocks):
        total = nothing
        for q in range(s.value_start[b], s.value_start[b + 1]):
            slot = z.read(slots, first + s.value_slot[q])
            if z.is_real(s.value, q):
                total = z.gather_real(total, slot, z.number.same(s.value, 2 * q))
            else:
                total = z.gather(total, slot, z.same(s.value, q))
        z.write(r.sums, m * s.value_blocks + b, z.gathered(total))
    for k in range(s.linear):
        z.write(r.lines, m * s.linear + k, line(z, s, s.A1, k, slots, first))


def _shifts(z, s, r, m):
    """Taylor coefficients of ``t exp(h)`` up to order ``m`` into ``r.change``."""
    weight = z.number.read(r.t, 0)
    for i in range(1, m + 1):
        weight = z.number.multiply(weight, z.number.same(s.inverses, i))
        z.number.write(r.change, i, weight)


def _shift_coefficient(z, r, data, first, stride, m):
    """Coefficient of order ``m`` of ``t (exp(h) - 1)`` times a series, minus it."""
    total = z.exact(splat(0.0), splat(0.0))
    for i in range(1, m + 1):
        term = z.read(data, first + (m - i) * stride)
        total = z.gather_real(total, term, z.number.read(r.change, i))
    return z.negative(z.gathered(total))


def right_side(z, s, r, m):
    """Minus the coefficient of order ``m`` of the rows, the coordinates' own taken as 0."""
    nothing = z.exact(splat(0.0), splat(0.0))
    _shifts(z, s, r, m)
    for k in range(s.N):
        z.write(r.right, k, nothing)
    for b in range(s.value_blocks):
        part = s.value_part[b]
        total = z.negative(z.read(r.sums, m * s.value_blocks + b))
        if s.moving[part] != 0:
            total = z.weigh(total, z.read(r.factor, part))
            moved = _shift_coefficient(z, r, r.sums, b, s.value_blocks, m)
            total = z.add_product(total, slope_of_factor(z, s, part), moved)
        k = s.value_place[b]
        z.write(r.right, k, z.add(z.read(r.right, k), total))
    for k in range(s.linear):
        z.write(r.right, s.rows + k, _shift_coefficient(z, r, r.lines, k, s.linear, m))
