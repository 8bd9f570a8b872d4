"""Newton's method at t = 0 in lanes: residuals in double-double, Jacobian and LU in double."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import aligned, fma, load, splat, square_root, store
from nag.machine_code.records import Complexes, Reals
from nag.tracking.homotopy import Homotopy
from nag.tracking.jets import System, Work, factors_at, jacobian, normalize, products
from nag.tracking.linear_algebra import factorize, substitute, substitute_adjoint
from nag.tracking.precision import (
    add_complex,
    load_complex,
    multiply_complex,
    split,
    store_complex,
)


class Low(NamedTuple):
    """Low parts of coefficients, and scratch for double-double slots."""

    value_re: Reals
    value_im: Reals
    slots: Reals
    total: Reals


class Refinement(NamedTuple):
    """Points to be refined in place, and what is found out about them.

    ``points``: shape (count, N). ``before, after``: smallest singular value of the Jacobian at the
    first and the last point; ``error``: length of the last step; ``frobenius``: Frobenius norm of
    the last Jacobian.
    """

    points: Complexes
    count: int
    iterations: int
    before: Reals
    after: Reals
    error: Reals
    frobenius: Reals


def low_parts(homotopy: Homotopy) -> Low:
    """What `newton_batch` needs besides the arrays of the homotopy."""
    rows = homotopy.rows
    low = rows.__dict__.get("_low")
    if low is None:
        parts = []
        for row, scale in zip(rows.parts, rows.scales, strict=True):
            for _, terms in row:
                parts += [split(terms[e], scale)[1] for e in sorted(terms, reverse=True)]
        low = np.array(parts, dtype=np.complex128)
        rows.__dict__["_low"] = low
    size = homotopy.N + 1 + rows.tape.value_products
    return Low(
        np.ascontiguousarray(low.real),
        np.ascontiguousarray(low.imag),
        aligned(4 * size),
        aligned(4 * max(homotopy.N, 1)),
    )


def _residual(s, w, low):
    """Minus the values of polynomial and linear rows in double-double, rounded at the end."""
    zero = splat(0.0)
    slots = low.slots
    total = low.total
    size = s.N + 1 + s.value_products
    store_complex(slots, size, s.N, (splat(1.0), zero, zero, zero))
    for q in range(s.value_products):
        x = load_complex(slots, size, s.first[q])
        y = load_complex(slots, size, s.second[q])
        store_complex(slots, size, s.N + 1 + q, multiply_complex(x, y))
    nothing = (zero, zero, zero, zero)
    for k in range(s.N):
        store_complex(total, s.N, k, nothing)
    for b in range(s.value_blocks):
        value = nothing
        for q in range(s.value_start[b], s.value_start[b + 1]):
            c = (
                splat(s.value_re[q]),
                splat(low.value_re[q]),
                splat(s.value_im[q]),
                splat(low.value_im[q]),
            )
            x = load_complex(slots, size, s.value_slot[q])
            value = add_complex(value, multiply_complex(c, x))
        part = s.value_part[b]
        if s.moving[part] != 0:
            factor = (splat(s.factor_re[2 * part]), zero, splat(s.factor_im[2 * part]), zero)
            value = multiply_complex(factor, value)
        k = s.value_place[b]
        store_complex(total, s.N, k, add_complex(load_complex(total, s.N, k), value))
    for k in range(s.linear):
        value = nothing
        for j in range(s.N):
            c = (splat(s.A0_re[k * s.N + j]), zero, splat(s.A0_im[k * s.N + j]), zero)
            value = add_complex(value, multiply_complex(c, load_complex(slots, size, j)))
        store_complex(total, s.N, s.rows + k, value)
    for k in range(s.N):
        value = load_complex(total, s.N, k)
        store(w.br, k, zero - value[0])
        store(w.bi, k, zero - value[2])


def _matrix(s, w):
    """Jacobian at the points, factorised; the squared Frobenius norm."""
    factors_at(s, w)
    products(s, w, 0, s.products)
    jacobian(s, w)
    frobenius = splat(0.0)
    for k in range(s.N * s.N):
        x = load(w.jr, k)
        y = load(w.ji, k)
        frobenius = fma(x, x, fma(y, y, frobenius))
    factorize(s.N, w.jr, w.ji, w.pivots)
    return frobenius


def _length(s, w):
    total = splat(0.0)
    for j in range(s.N):
        x = load(w.br, j)
        y = load(w.bi, j)
        total = fma(x, x, fma(y, y, total))
    return square_root(total)


def _smallest(s, w):
    """Smallest singular value of the factorised matrix, by inverse iteration."""
    for j in range(s.N):
        store(w.br, j, splat(1.0 / (1.0 + j)))
        store(w.bi, j, splat(0.3 - 0.1 * (j % 7)))
    size = splat(1.0)
    for _step in range(4):
        substitute(s.N, w.jr, w.ji, w.pivots, w.br, w.bi)
        inverse = splat(1.0) / _length(s, w)
        for j in range(s.N):
            store(w.br, j, load(w.br, j) * inverse)
            store(w.bi, j, load(w.bi, j) * inverse)
        substitute_adjoint(s.N, w.jr, w.ji, w.pivots, w.br, w.bi)
        size = splat(1.0) / _length(s, w)
        for j in range(s.N):
            store(w.br, j, load(w.br, j) * size)
            store(w.bi, j, load(w.bi, j) * size)
    return size


def newton_batch(s: System, w: Work, low: Low, batch: Refinement) -> None:
    """Refine all points of a batch in place."""
    n = s.N
    points = batch.points
    iterations = batch.iterations
    count = batch.count
    before = batch.before
    after = batch.after
    error = batch.error
    frobenius = batch.frobenius
    slots = low.slots
    zero = splat(0.0)
    size = n + 1 + s.value_products
    for first in range(0, count, 8):
        for lane in range(8):
            path = min(first + lane, count - 1)
            for j in range(n):
                w.vr[8 * j + lane] = points[n * path + j].real
                w.vi[8 * j + lane] = points[n * path + j].imag
        store(w.tr, 0, zero)
        normalize(s, w)
        length = square_root(_matrix(s, w))
        small = _smallest(s, w)
        store(w.norms, 0, small)
        store(w.norms, 1, small)
        for lane in range(min(8, count - first)):
            before[first + lane] = w.norms[lane]
        for step in range(iterations):
            for j in range(n):
                x = load(w.vr, j)
                y = load(w.vi, j)
                store_complex(slots, size, j, (x, zero, y, zero))
            if step > 0:
                normalize(s, w)
                for j in range(n):
                    store_complex(slots, size, j, (load(w.vr, j), zero, load(w.vi, j), zero))
                length = square_root(_matrix(s, w))
            _residual(s, w, low)
            substitute(n, w.jr, w.ji, w.pivots, w.br, w.bi)
            store(w.norms, 0, _length(s, w))
            for lane in range(8):
                # A step that long, or not a number, belongs to a singular Jacobian.
                if not w.norms[lane] < 0.5:
                    w.norms[lane] = np.inf
                    for j in range(n):
                        w.br[8 * j + lane] = 0.0
                        w.bi[8 * j + lane] = 0.0
            for j in range(n):
                store(w.vr, j, load(w.vr, j) + load(w.br, j))
                store(w.vi, j, load(w.vi, j) + load(w.bi, j))
            for lane in range(min(8, count - first)):
                error[first + lane] = w.norms[lane]
        if iterations > 0:
            normalize(s, w)
            length = square_root(_matrix(s, w))
            store(w.norms, 1, _smallest(s, w))
        store(w.norms, 0, length)
        for lane in range(min(8, count - first)):
            after[first + lane] = w.norms[8 + lane]
            frobenius[first + lane] = w.norms[lane]
            for j in range(n):
                points[n * (first + lane) + j] = complex(w.vr[8 * j + lane], w.vi[8 * j + lane])


newton_lanes = Kernel(newton_batch, "tracking")
