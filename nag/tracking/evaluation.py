"""Products, rows, Jacobian and Taylor coefficients of a homotopy's tape, in any arithmetic.

``z`` is an arithmetic of complex numbers (`nag.tracking.numbers`), ``s`` are
`nag.tracking.kernel_arrays.KernelEquations`, whose coefficients are numbers of it, and ``w`` is
scratch: `nag.tracking.kernel_arrays.Work` or `nag.tracking.ends.records.Room`. In which parameter
the series are is for `nag.tracking.taylor` and `nag.tracking.ends.log_series` to say.
"""

from __future__ import annotations

from nag.machine_code.lanes import load, splat


def products(z, s, w, first, last):
    """Products ``first .. last - 1`` of the slots."""
    for k in range(first, last):
        a = z.read(w.slots, s.first[k])
        b = z.read(w.slots, s.second[k])
        z.write(w.slots, s.N + 1 + k, z.multiply(a, b))


def factors_at(z, s, w):
    """Factors of all parts at the lanes' t, and the slot that is 1."""
    t = z.number.read(w.t, 0)
    z.write(w.slots, s.N, z.exact(splat(1.0), splat(0.0)))
    for p in range(s.parts):
        a = z.exact(splat(s.factors[4 * p]), splat(s.factors[4 * p + 1]))
        z.write(w.factor, p, z.add_multiple(a, slope_of_factor(z, s, p), t))


def slope_of_factor(z, s, part):
    """Derivative of a part's factor by t."""
    return z.exact(splat(s.factors[4 * part + 2]), splat(s.factors[4 * part + 3]))


def block_of_values(z, s, b, data, slots):
    """The sum of a block of the values, coefficients ``data`` times slots."""
    return _block(z, s.value_start, s.value_slot, s.value_real, data, b, slots)


def block_of_jacobian(z, s, b, slots):
    """The same of the Jacobian."""
    return _block(z, s.jacobian_start, s.jacobian_slot, s.jacobian_real, s.jacobian, b, slots)


def _block(z, start, slot, real, data, b, slots):
    total = z.exact(splat(0.0), splat(0.0))
    if real[b] != 0:
        for q in range(start[b], start[b + 1]):
            total = z.add_multiple(total, z.read(slots, slot[q]), z.number.same(data, 2 * q))
    else:
        for q in range(start[b], start[b + 1]):
            total = z.add_term(total, data, q, z.read(slots, slot[q]))
    return total


def weigh_block(z, s, w, part, total):
    """The sum of a block times the factor of its part, which is real in toric systems."""
    if s.moving[part] == 0:
        return total
    if s.toric != 0:
        return z.stretch(total, z.number.read(w.factor, 2 * part))
    return z.weigh(total, z.read(w.factor, part))


def line(z, s, data, k, slots, first):
    """Row ``k`` of a matrix of doubles times coordinates, which start at ``first``."""
    total = z.exact(splat(0.0), splat(0.0))
    for j in range(s.N):
        q = 2 * (k * s.N + j)
        c = z.exact(splat(data[q]), splat(data[q + 1]))
        total = z.add_product(total, c, z.read(slots, first + j))
    return total


def jacobian(z, s, w):
    """The Jacobian of all rows at the lanes' points and t."""
    nothing = z.exact(splat(0.0), splat(0.0))
    for k in range(s.rows * s.N):
        total = nothing
        for b in range(s.jacobian_begin[k], s.jacobian_begin[k + 1]):
            x = block_of_jacobian(z, s, b, w.slots)
            total = z.add(total, weigh_block(z, s, w, s.jacobian_part[b], x))
        z.write(w.matrix, k, total)
    linear_entries(z, s, w)


def linear_entries(z, s, w):
    """Entries of the Jacobian that belong to linear rows and patches."""
    n = s.N
    nothing = z.exact(splat(0.0), splat(0.0))
    t = z.number.read(w.t, 0)
    for k in range(s.linear):
        for j in range(n):
            q = 2 * (k * n + j)
            entry = z.exact(splat(s.A0[q]), splat(s.A0[q + 1]))
            if s.linear_moving[k] != 0:
                entry = z.add_multiple(entry, z.exact(splat(s.A1[q]), splat(s.A1[q + 1])), t)
            z.write(w.matrix, (s.rows + k) * n + j, entry)
    patches = s.rows + s.linear
    for k in range(patches * n, n * n):
        z.write(w.matrix, k, nothing)
    for j in range(n):
        entry = z.exact(load(w.patch, 2 * j), load(w.patch, 2 * j + 1))
        z.write(w.matrix, (patches + s.group_of[j]) * n + j, entry)


def incomplete_slots(z, s, w, k):
    """Taylor coefficients of order ``k`` of the products, those of the coordinates taken as 0."""
    nothing = z.exact(splat(0.0), splat(0.0))
    size = s.N + 1 + s.inner
    for q in range(s.value_products):
        a = s.first[q]
        b = s.second[q]
        total = nothing
        # The second factor is a coordinate, whose coefficient of this order is taken as 0.
        if a > s.N:
            total = z.begin(z.read(w.partial, a), z.read(w.slots, b))
        for i in range(1, k):
            left = z.read(w.series, (i - 1) * size + a)
            total = z.gather(total, left, z.read(w.series, (k - i - 1) * size + b))
        z.write(w.partial, s.N + 1 + q, z.gathered(total))


def complete_slots(z, s, w, k):
    """The coefficients of order ``k`` of the coordinates, and with them of the inner products.

    Those of the coordinates are the solution in the right-hand side. What they contribute is linear
    in them, so that a product needs two multiplications. For order 1 there is nothing to add to.
    """
    top = (k - 1) * (s.N + 1 + s.inner)
    for j in range(s.N):
        x = z.read(w.right, j)
        z.write(w.change, j, x)
        z.write(w.series, top + j, x)
    for q in range(s.inner):
        a = s.first[q]
        b = s.second[q]
        m = s.N + 1 + q
        total = z.begin(z.read(w.slots, a), z.read(w.change, b))
        total = z.gathered(z.gather(total, z.read(w.change, a), z.read(w.slots, b)))
        z.write(w.change, m, total)
        if k > 1:
            total = z.add(z.read(w.partial, m), total)
        z.write(w.series, top + m, total)
