"""Values, Jacobian and Taylor coefficients of a homotopy in the arithmetic of the kernel.

The parameter of the Taylor series is h in ``t exp(h)``; ``z`` stands for
`nag.tracking.numbers.complex_numbers`.
"""

from __future__ import annotations

import math

from nag.machine_code.lanes import fma, load, splat, store
from nag.tracking.numbers.error_free import power_near_inverse_root


def products(z, s, r, last):
    """Products ``0 .. last - 1`` of the slots."""
    for k in range(last):
        a = z.read(r.slots, s.first[k])
        b = z.read(r.slots, s.second[k])
        z.write(r.slots, s.N + 1 + k, z.multiply(a, b))


def factors_at(z, s, r):
    """Factors of all parts at the lanes' t, and the slot that is 1."""
    t = z.number.read(r.t, 0)
    z.write(r.slots, s.N, z.exact(splat(1.0), splat(0.0)))
    for p in range(s.parts):
        a = z.exact(splat(s.factors[4 * p]), splat(s.factors[4 * p + 1]))
        slope = z.exact(splat(s.factors[4 * p + 2]), splat(s.factors[4 * p + 3]))
        z.write(r.factor, p, z.add(a, z.stretch(slope, t)))


def _line(z, s, r, data, k, slots, first):
    """Sum of a linear row's coefficients times coordinates, which start at ``first``."""
    total = z.exact(splat(0.0), splat(0.0))
    for j in range(s.N):
        q = 2 * (k * s.N + j)
        c = z.exact(splat(data[q]), splat(data[q + 1]))
        total = z.add(total, z.multiply(c, z.read(slots, first + j)))
    return total


def _is_real(z, data, k):
    """Whether complex number ``k`` of an array that is the same in all lanes is real."""
    return data[z.number.words * (2 * k + 1)] == 0.0


def _term(z, data, k, slot):
    """A coefficient times a slot."""
    if _is_real(z, data, k):
        term = z.stretch(slot, z.number.same(data, 2 * k))
    else:
        term = z.multiply(z.same(data, k), slot)
    return term


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
            term = _term(z, s.value, q, z.read(r.slots, s.value_slot[q]))
            total = z.add(total, term)
            size = size + z.magnitude(term)
        z.write(r.sums, b, total)
        part = s.value_part[b]
        if s.moving[part] != 0:
            factor = z.read(r.factor, part)
            total = z.multiply(factor, total)
            size = size * z.magnitude(factor)
        k = s.value_place[b]
        z.write(r.right, k, z.add(z.read(r.right, k), z.negative(total)))
        store(r.sizes, k, load(r.sizes, k) + size)
    t = z.number.read(r.t, 0)
    for k in range(s.linear):
        moving = _line(z, s, r, s.A1, k, r.slots, 0)
        z.write(r.lines, k, moving)
        total = z.add(_line(z, s, r, s.A0, k, r.slots, 0), z.stretch(moving, t))
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


def jacobian(z, s, r):
    """The Jacobian of all rows at the lanes' points and t."""
    n = s.N
    zero = splat(0.0)
    nothing = z.exact(zero, zero)
    for k in range(n * n):
        z.write(r.matrix, k, nothing)
    for b in range(s.jacobian_blocks):
        total = nothing
        for q in range(s.jacobian_start[b], s.jacobian_start[b + 1]):
            slot = z.read(r.slots, s.jacobian_slot[q])
            total = z.add(total, _term(z, s.jacobian, q, slot))
        part = s.jacobian_part[b]
        if s.moving[part] != 0:
            total = z.multiply(z.read(r.factor, part), total)
        k = s.jacobian_place[b]
        z.write(r.matrix, k, z.add(z.read(r.matrix, k), total))
    t = z.number.read(r.t, 0)
    for k in range(s.linear):
        for j in range(n):
            q = 2 * (k * n + j)
            still = z.exact(splat(s.A0[q]), splat(s.A0[q + 1]))
            slope = z.exact(splat(s.A1[q]), splat(s.A1[q + 1]))
            z.write(r.matrix, (s.rows + k) * n + j, z.add(still, z.stretch(slope, t)))
    for j in range(n):
        k = s.rows + s.linear + s.group_of[j]
        entry = z.exact(load(r.patch, 2 * j), load(r.patch, 2 * j + 1))
        z.write(r.matrix, k * n + j, entry)


def incomplete_slots(z, s, r, m):
    """Taylor coefficients of order ``m`` of the slots, those of the coordinates taken as 0."""
    nothing = z.exact(splat(0.0), splat(0.0))
    size = s.N + 1 + s.value_products
    top = (m - 1) * size
    for j in range(s.N + 1):
        z.write(r.series, top + j, nothing)
    for q in range(s.value_products):
        a = s.first[q]
        b = s.second[q]
        total = nothing
        # The second factor is a coordinate, whose coefficient of this order is taken as 0.
        if a > s.N:
            total = z.gather(total, z.read(r.series, top + a), z.read(r.slots, b))
        for i in range(1, m):
            left = z.read(r.series, (i - 1) * size + a)
            right = z.read(r.series, (m - i - 1) * size + b)
            total = z.gather(total, left, right)
        z.write(r.series, top + s.N + 1 + q, z.gathered(total))


def complete_slots(z, s, r, m):
    """Add to the coefficients of order ``m`` what the solution in the right-hand side adds."""
    nothing = z.exact(splat(0.0), splat(0.0))
    size = s.N + 1 + s.value_products
    top = (m - 1) * size
    for j in range(s.N):
        x = z.read(r.right, j)
        z.write(r.change, j, x)
        z.write(r.series, top + j, x)
    z.write(r.change, s.N, nothing)
    for q in range(s.value_products):
        a = s.first[q]
        b = s.second[q]
        total = z.gather(nothing, z.read(r.slots, a), z.read(r.change, b))
        total = z.gathered(z.gather(total, z.read(r.change, a), z.read(r.slots, b)))
        k = s.N + 1 + q
        z.write(r.change, k, total)
        z.write(r.series, top + k, z.add(z.read(r.series, top + k), total))


def block_sums(z, s, r, m):
    """Taylor coefficients of order ``m`` of the blocks and of the linear rows' moving parts."""
    nothing = z.exact(splat(0.0), splat(0.0))
    size = s.N + 1 + s.value_products
    top = (m - 1) * size
    for b in range(s.value_blocks):
        total = nothing
        for q in range(s.value_start[b], s.value_start[b + 1]):
            slot = z.read(r.series, top + s.value_slot[q])
            if _is_real(z, s.value, q):
                total = z.gather_real(total, slot, z.number.same(s.value, 2 * q))
            else:
                total = z.gather(total, slot, z.same(s.value, q))
        z.write(r.sums, m * s.value_blocks + b, z.gathered(total))
    for k in range(s.linear):
        z.write(r.lines, m * s.linear + k, _line(z, s, r, s.A1, k, r.series, top))


def _shifts(z, s, r, m):
    """Taylor coefficients of ``t exp(h)`` up to order ``m`` into ``r.change``."""
    weight = z.number.read(r.t, 0)
    for i in range(1, m + 1):
        weight = z.number.multiply(weight, z.number.same(s.inverses, i))
        z.number.write(r.change, i, weight)


def _shifted(z, r, data, first, stride, m):
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
            total = z.multiply(z.read(r.factor, part), total)
            re = splat(s.factors[4 * part + 2])
            im = splat(s.factors[4 * part + 3])
            moved = _shifted(z, r, r.sums, b, s.value_blocks, m)
            total = z.add(total, z.multiply(z.exact(re, im), moved))
        k = s.value_place[b]
        z.write(r.right, k, z.add(z.read(r.right, k), total))
    for k in range(s.linear):
        z.write(r.right, s.rows + k, _shifted(z, r, r.lines, k, s.linear, m))
