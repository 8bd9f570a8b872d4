"""Newton's method at t = 0 in lanes: residuals in double-double, Jacobian and LU in double."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from nag.algebra.number import Number
from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import aligned_zeros, fma, load, splat, square_root, store
from nag.machine_code.records import Complexes, Reals
from nag.tracking.ends.records import words
from nag.tracking.homotopy import Homotopy
from nag.tracking.kernel_arrays import System, Work
from nag.tracking.linear_algebra import factorize, substitute, substitute_adjoint
from nag.tracking.numbers.complex_numbers import ARITHMETICS, ComplexNumbers
from nag.tracking.taylor import factors_at, jacobian, normalize, products


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
    the last Jacobian. ``further``: where ``twice`` is not 0, one more step, which is too small for
    the points to show; points and steps together have twice the digits.
    """

    points: Complexes
    count: int
    iterations: int
    before: Reals
    after: Reals
    error: Reals
    frobenius: Reals
    further: Complexes
    twice: int


def low_parts(homotopy: Homotopy) -> Low:
    """What `newton_batch` needs besides the arrays of the homotopy."""
    rows = homotopy.rows
    if "low" not in rows._cache:
        parts = []
        for row, blocks, scale in zip(
            rows.parts, rows.in_doubles, rows.scales.tolist(), strict=True
        ):
            for (_, terms), block in zip(row, blocks, strict=True):
                parts += [_low(terms[e], c, scale) for e, c in block]
        rows._cache["low"] = np.array(parts).reshape(-1, 2).T.copy()
    re, im = rows._cache["low"]
    size = homotopy.N + 1 + rows.tape.value_products
    return Low(
        re,
        im,
        aligned_zeros(4 * size),
        aligned_zeros(4 * max(homotopy.N, 1)),
    )


def _low(number: Number | complex, rounded: complex, scale: float) -> Sequence[float]:
    """Real and imaginary part of what rounding took away from a coefficient over a power of two."""
    if type(number) is Fraction:
        a, b = rounded.real.as_integer_ratio()
        rest = number.numerator * b - a * number.denominator
        return (rest / (number.denominator * b) / scale if rest else 0.0, 0.0)
    if isinstance(number, complex | float):
        return (0.0, 0.0)
    return words(number, 2, 1 / Fraction(scale))[1::2]


def _residual(z, s, w, low):
    """Minus the values of polynomial and linear rows in double-double, rounded at the end."""
    zero = splat(0.0)
    slots = low.slots
    total = low.total
    nothing = z.exact(zero, zero)
    z.write(slots, s.N, z.exact(splat(1.0), zero))
    for q in range(s.value_products):
        x = z.read(slots, s.first[q])
        y = z.read(slots, s.second[q])
        z.write(slots, s.N + 1 + q, z.multiply(x, y))
    for k in range(s.N):
        z.write(total, k, nothing)
    for b in range(s.value_blocks):
        value = nothing
        for q in range(s.value_start[b], s.value_start[b + 1]):
            a = (splat(s.value_re[q]), splat(low.value_re[q]))
            c = a, (splat(s.value_im[q]), splat(low.value_im[q]))
            value = z.add(value, z.multiply(c, z.read(slots, s.value_slot[q])))
        part = s.value_part[b]
        if s.moving[part] != 0:
            factor = z.exact(splat(s.factor_re[2 * part]), splat(s.factor_im[2 * part]))
            value = z.multiply(factor, value)
        k = s.value_place[b]
        z.write(total, k, z.add(z.read(total, k), value))
    for k in range(s.linear):
        value = nothing
        for j in range(s.N):
            c = z.exact(splat(s.A0_re[k * s.N + j]), splat(s.A0_im[k * s.N + j]))
            value = z.add(value, z.multiply(c, z.read(slots, j)))
        z.write(total, s.rows + k, value)
    for k in range(s.N):
        re, im = z.rounded(z.read(total, k))
        store(w.br, k, zero - re)
        store(w.bi, k, zero - im)


def _matrix(s, w):
    """Jacobian at the points, factorised; the squared Frobenius norm."""
    factors_at(s, w)
    products(s, w, 0, s.products)
    jacobian(s, w, 0)
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


def _put(s, w, batch, first):
    """The next eight points into the lanes; the last one again where there are fewer."""
    for lane in range(8):
        path = min(first + lane, batch.count - 1)
        for j in range(s.N):
            w.vr[8 * j + lane] = batch.points[s.N * path + j].real
            w.vi[8 * j + lane] = batch.points[s.N * path + j].imag
    store(w.tr, 0, splat(0.0))


def _newton(z, s, w, low):
    """Newton's step at the lanes' points, whose matrix is factorised, into the right-hand side."""
    for j in range(s.N):
        z.write(low.slots, j, z.exact(load(w.vr, j), load(w.vi, j)))
    _residual(z, s, w, low)
    substitute(s.N, w.jr, w.ji, w.pivots, w.br, w.bi)


def _move(s, w):
    """Take Newton's step, and its length into the first norm."""
    store(w.norms, 0, _length(s, w))
    for lane in range(8):
        # A step that long, or not a number, belongs to a singular Jacobian.
        if not w.norms[lane] < 0.5:
            w.norms[lane] = np.inf
            for j in range(s.N):
                w.br[8 * j + lane] = 0.0
                w.bi[8 * j + lane] = 0.0
    for j in range(s.N):
        store(w.vr, j, load(w.vr, j) + load(w.br, j))
        store(w.vi, j, load(w.vi, j) + load(w.bi, j))


def newton_batch(z: ComplexNumbers, s: System, w: Work, low: Low, batch: Refinement) -> None:
    """Refine all points of a batch in place."""
    n = s.N
    count = batch.count
    iterations = batch.iterations
    for first in range(0, count, 8):
        last = min(8, count - first)
        _put(s, w, batch, first)
        normalize(s, w)
        length = square_root(_matrix(s, w))
        small = _smallest(s, w)
        store(w.norms, 0, small)
        store(w.norms, 1, small)
        for lane in range(last):
            batch.before[first + lane] = w.norms[lane]
        for step in range(iterations):
            if step > 0:
                normalize(s, w)
                length = square_root(_matrix(s, w))
            _newton(z, s, w, low)
            _move(s, w)
            for lane in range(last):
                batch.error[first + lane] = w.norms[lane]
        if iterations > 0:
            normalize(s, w)
            length = square_root(_matrix(s, w))
            store(w.norms, 1, _smallest(s, w))
        store(w.norms, 0, length)
        if batch.twice != 0:
            _newton(z, s, w, low)
            for lane in range(last):
                for j in range(n):
                    further = complex(w.br[8 * j + lane], w.bi[8 * j + lane])
                    batch.further[n * (first + lane) + j] = further
        for lane in range(last):
            path = first + lane
            batch.after[path] = w.norms[8 + lane]
            batch.frobenius[path] = w.norms[lane]
            for j in range(n):
                batch.points[n * path + j] = complex(w.vr[8 * j + lane], w.vi[8 * j + lane])


newton_lanes = Kernel(newton_batch, ARITHMETICS[2])
