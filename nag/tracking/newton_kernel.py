"""Newton's method at t = 0 in lanes: residuals in double-double, Jacobian and LU in double."""

from __future__ import annotations

from typing import Any, NamedTuple

import numba
import numpy as np

from nag.tracking.homotopy import Homotopy
from nag.tracking.jets import bare, factors_at, jacobian, normalize, products, system, work
from nag.tracking.kernel_cache import Kernel
from nag.tracking.lanes import aligned, fma, load, pointer, splat, square_root, store
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

    value_re: Any
    value_im: Any
    slots: Any
    total: Any


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


@numba.njit(nogil=True)
def _residual(s, w, low_re, low_im, slots, total):
    """Minus the values of polynomial and linear rows in double-double, rounded at the end."""
    zero = splat(0.0)
    size = s.N + 1 + s.value_products
    store_complex(slots, size, s.N, (splat(1.0), zero, zero, zero))
    for q in range(s.value_products):
        a = load_complex(slots, size, s.first[q])
        b = load_complex(slots, size, s.second[q])
        store_complex(slots, size, s.N + 1 + q, multiply_complex(a, b))
    nothing = (zero, zero, zero, zero)
    for k in range(s.N):
        store_complex(total, s.N, k, nothing)
    for b in range(s.value_blocks):
        value = nothing
        for q in range(s.value_start[b], s.value_start[b + 1]):
            c = (
                splat(s.value_re[q]),
                splat(low_re[q]),
                splat(s.value_im[q]),
                splat(low_im[q]),
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


@numba.njit(nogil=True)
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


@numba.njit(nogil=True)
def _length(s, w):
    total = splat(0.0)
    for j in range(s.N):
        x = load(w.br, j)
        y = load(w.bi, j)
        total = fma(x, x, fma(y, y, total))
    return square_root(total)


@numba.njit(nogil=True)
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


@numba.njit(nogil=True, cache=True)
def newton_batch(arrays, scratch, low, points, iterations, before, after, error, frobenius):
    """Refine all ``points`` in place.

    ``before, after``: smallest singular value at the first and the last point; ``error``: length
    of the last step; ``frobenius``: Frobenius norm of the last Jacobian.
    """
    s, w = bare(arrays, scratch)
    low_re = pointer(low.value_re)
    low_im = pointer(low.value_im)
    slots = pointer(low.slots)
    total = pointer(low.total)
    n = s.N
    zero = splat(0.0)
    size = n + 1 + s.value_products
    count = len(points)
    for first in range(0, count, 8):
        for lane in range(8):
            path = min(first + lane, count - 1)
            for j in range(n):
                w.vr[8 * j + lane] = points[path, j].real
                w.vi[8 * j + lane] = points[path, j].imag
        store(w.tr, 0, zero)
        store(w.ti, 0, zero)
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
            _residual(s, w, low_re, low_im, slots, total)
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
                points[first + lane, j] = complex(w.vr[8 * j + lane], w.vi[8 * j + lane])


def _example() -> tuple[Any, ...]:
    from nag.algebra.polynomial import Polynomial
    from nag.tracking.compiled import compile_rows

    x = Polynomial.variable(1, 0)
    homotopy = Homotopy(compile_rows([x * x - 1]))
    one = np.zeros(1)
    points = np.ones((1, 2), dtype=np.complex128)
    low = low_parts(homotopy)
    return system(homotopy), work(homotopy, 1), low, points, 3, one, one, one, one


newton_lanes = Kernel(newton_batch, _example)
