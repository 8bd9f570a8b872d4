"""Newton's method at t = 0 in lanes: residuals in double-double, Jacobian and LU in double."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np

from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import scratch, splat, square_root, store
from nag.machine_code.records import Complexes, Reals, Table, Wholes, replaced
from nag.tracking.evaluation import (
    block_of_values,
    jacobian,
    line,
    products,
    weigh_block,
)
from nag.tracking.homotopy import Homotopy
from nag.tracking.kernel_arrays import KernelEquations, Work, pairs, values_in_words
from nag.tracking.linear_algebra import factorize, substitute, substitute_adjoint
from nag.tracking.numbers.complex_numbers import ARITHMETICS, ComplexNumbers
from nag.tracking.numbers.doubles import DOUBLES, ComplexDoubles
from nag.tracking.taylor import normalize


class Doubled(NamedTuple):
    """Slots and factors in double-double, and the coefficients of the values.

    ``rest``: see `nag.tracking.homotopy.Members`; one member has none where paths share factors.
    """

    t: Annotated[Reals, "words"]
    slots: Annotated[Reals, "value_slots 2 words"]
    factor: Annotated[Reals, "parts 2 words"]
    value: Annotated[Reals, "0"]
    rest: Annotated[Reals, "0"]


class Refinement(NamedTuple):
    """Points to be refined in place, and what is found out about them.

    ``points``: shape (count, N); ``member``: whose factors each of them has. ``before, after``:
    smallest singular value of the Jacobian at the first and the last point; ``error``: length of
    the last step; ``frobenius``: Frobenius norm of the last Jacobian. ``further``: where ``twice``
    is not 0, one more step, which is too small for the points to show; points and steps together
    have twice the digits.
    """

    points: Complexes
    member: Wholes
    count: int
    iterations: int
    before: Reals
    after: Reals
    error: Reals
    frobenius: Reals
    further: Complexes
    twice: int


def doubled_table(homotopy: Homotopy) -> Table:
    """What `newton_batch` needs in double-double besides the arrays of the homotopy."""
    value_slots = homotopy.N + 1 + homotopy.rows.tape.value_products
    made = scratch(Doubled, words=2, value_slots=value_slots, parts=len(homotopy.factors))
    rest = np.zeros(len(homotopy.factors), dtype=np.complex128)
    if homotopy.members is not None:
        rest = homotopy.members.rest
    value = values_in_words(homotopy.rows, 2)
    return replaced(made, value=value, rest=pairs(rest))


def _residual(z, zz, s, w, d):
    """Minus the values of polynomial and linear rows in double-double, rounded at the end."""
    zero = splat(0.0)
    nothing = zz.exact(zero, zero)
    products(zz, s, d, 0, s.value_products)
    for k in range(s.rows):
        total = nothing
        for b in range(s.value_begin[k], s.value_begin[k + 1]):
            value = block_of_values(zz, s, b, d.value, d.slots)
            total = zz.add(total, weigh_block(zz, s, d, s.value_part[b], value))
        _write_rounded(z, zz, w, k, total)
    for k in range(s.linear):
        _write_rounded(z, zz, w, s.rows + k, line(zz, s, s.A0, k, d.slots, 0))
    for k in range(s.rows + s.linear, s.N):
        z.write(w.right, k, z.exact(zero, zero))


def _write_rounded(z, zz, w, k, total):
    z.write(w.right, k, z.negative(zz.rounded(total)))


def _matrix(z, s, w):
    """Jacobian at the points, factorised; the squared Frobenius norm."""
    products(z, s, w, 0, s.products)
    jacobian(z, s, w)
    frobenius = splat(0.0)
    for k in range(s.N * s.N):
        frobenius = z.add_square(frobenius, z.read(w.matrix, k))
    factorize(z, s.N, w.matrix, w.pivots)
    return frobenius


def _length(z, s, w):
    total = splat(0.0)
    for j in range(s.N):
        total = z.add_square(total, z.read(w.right, j))
    return square_root(total)


def _stretch(z, s, w, factor):
    for j in range(s.N):
        z.write(w.right, j, z.stretch(z.read(w.right, j), factor))


def _smallest(z, s, w):
    """Smallest singular value of the factorised matrix, by inverse iteration."""
    for j in range(s.N):
        z.write(w.right, j, z.exact(splat(1.0 / (1.0 + j)), splat(0.3 - 0.1 * (j % 7))))
    size = splat(1.0)
    for _step in range(4):
        substitute(z, s.N, w.matrix, w.pivots, w.right)
        _stretch(z, s, w, splat(1.0) / _length(z, s, w))
        substitute_adjoint(z, s.N, w.matrix, w.pivots, w.right)
        size = splat(1.0) / _length(z, s, w)
        _stretch(z, s, w, size)
    return size


def _put(z, zz, s, w, d, batch, first):
    """The next eight points into the lanes; the last one again where there are fewer."""
    z.write(w.slots, s.N, z.exact(splat(1.0), splat(0.0)))
    zz.write(d.slots, s.N, zz.exact(splat(1.0), splat(0.0)))
    for lane in range(8):
        path = min(first + lane, batch.count - 1)
        member = batch.member[path]
        for p in range(s.parts):
            q = member * s.parts + p
            w.factor[16 * p + lane] = s.factors[4 * q]
            w.factor[16 * p + 8 + lane] = s.factors[4 * q + 1]
            d.factor[32 * p + lane] = s.factors[4 * q]
            d.factor[32 * p + 8 + lane] = d.rest[2 * q]
            d.factor[32 * p + 16 + lane] = s.factors[4 * q + 1]
            d.factor[32 * p + 24 + lane] = d.rest[2 * q + 1]
        for j in range(s.N):
            w.slots[16 * j + lane] = batch.points[s.N * path + j].real
            w.slots[16 * j + 8 + lane] = batch.points[s.N * path + j].imag
    store(w.t, 0, splat(0.0))


def _newton(z, zz, s, w, d):
    """Newton's step at the lanes' points, whose matrix is factorised, into the right-hand side."""
    for j in range(s.N):
        re, im = z.read(w.slots, j)
        zz.write(d.slots, j, zz.exact(re, im))
    _residual(z, zz, s, w, d)
    substitute(z, s.N, w.matrix, w.pivots, w.right)


def _move(z, s, w):
    """Take Newton's step, and its length into the first norm."""
    store(w.norms, 0, _length(z, s, w))
    for lane in range(8):
        # A step that long, or not a number, belongs to a singular Jacobian.
        if not w.norms[lane] < 0.5:
            w.norms[lane] = np.inf
            for j in range(2 * s.N):
                w.right[8 * j + lane] = 0.0
    for j in range(s.N):
        z.write(w.slots, j, z.add(z.read(w.slots, j), z.read(w.right, j)))


def newton_batch(
    z: ComplexDoubles,
    zz: ComplexNumbers,
    s: KernelEquations,
    w: Work,
    d: Doubled,
    batch: Refinement,
) -> None:
    """Refine all points of a batch in place, with matrices in ``z`` and residuals in ``zz``."""
    n = s.N
    count = batch.count
    iterations = batch.iterations
    for first in range(0, count, 8):
        last = min(8, count - first)
        _put(z, zz, s, w, d, batch, first)
        normalize(z, s, w)
        length = square_root(_matrix(z, s, w))
        small = _smallest(z, s, w)
        store(w.norms, 0, small)
        store(w.norms, 1, small)
        for lane in range(last):
            batch.before[first + lane] = w.norms[lane]
        for step in range(iterations):
            if step > 0:
                normalize(z, s, w)
                length = square_root(_matrix(z, s, w))
            _newton(z, zz, s, w, d)
            _move(z, s, w)
            for lane in range(last):
                batch.error[first + lane] = w.norms[lane]
        if iterations > 0:
            normalize(z, s, w)
            length = square_root(_matrix(z, s, w))
            store(w.norms, 1, _smallest(z, s, w))
        store(w.norms, 0, length)
        if batch.twice != 0:
            _newton(z, zz, s, w, d)
            for lane in range(last):
                for j in range(n):
                    further = complex(w.right[16 * j + lane], w.right[16 * j + 8 + lane])
                    batch.further[n * (first + lane) + j] = further
        for lane in range(last):
            path = first + lane
            batch.after[path] = w.norms[8 + lane]
            batch.frobenius[path] = w.norms[lane]
            for j in range(n):
                x = complex(w.slots[16 * j + lane], w.slots[16 * j + 8 + lane])
                batch.points[n * path + j] = x


newton_lanes = Kernel(newton_batch, DOUBLES, ARITHMETICS[2])
