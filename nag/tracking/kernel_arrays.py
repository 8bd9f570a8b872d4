"""A homotopy as flat arrays, and scratch beside it, as the kernels read them."""

from __future__ import annotations

from itertools import accumulate
from typing import Any, NamedTuple

import numpy as np

from nag.machine_code.lanes import VECTOR, aligned_zeros, separate
from nag.machine_code.records import Reals, Table, Wholes, address, replaced, table
from nag.tracking.compiled import CompiledRows
from nag.tracking.homotopy import Homotopy, norms

# Rows of the lanes' scalars.
SCALARS = 11


class System(NamedTuple):
    """A homotopy as flat arrays (see `nag.tracking.compiled.Tape` for blocks and slots).

    The numbers say how long the arrays are. Factor ``2 p`` is a, ``2 p + 1`` is b of part ``p``.
    The blocks of row ``k`` are ``value_begin[k] .. value_begin[k + 1] - 1``, and likewise those of
    an entry of the Jacobian. ``moves`` is 1 if the factors of any part depend on t. Of the products
    the Taylor coefficients of the first ``inner`` are kept for all orders.
    If ``toric`` is 1, each part is one term, t is real, and the factor of part ``p`` is
    ``exp(-weights[path * parts + p] t)`` instead.
    """

    N: int
    rows: int
    linear: int
    groups: int
    parts: int
    value_products: int
    products: int
    value_blocks: int
    inner: int
    moves: int
    first: Wholes
    second: Wholes
    value_begin: Wholes
    value_place: Wholes
    value_part: Wholes
    value_start: Wholes
    value_slot: Wholes
    value_re: Reals
    value_im: Reals
    value_real: Wholes
    jacobian_begin: Wholes
    jacobian_part: Wholes
    jacobian_start: Wholes
    jacobian_slot: Wholes
    jacobian_re: Reals
    jacobian_im: Reals
    jacobian_real: Wholes
    factor_re: Reals
    factor_im: Reals
    moving: Wholes
    A0_re: Reals
    A0_im: Reals
    A1_re: Reals
    A1_im: Reals
    linear_moving: Wholes
    group_of: Wholes
    toric: int
    weights: Reals


class Work(NamedTuple):
    """Scratch vectors of one batch of lanes.

    ``vr, vi``: slots; the first N are the point. ``cr, ci``: Taylor coefficients of order 1 and up
    of coordinates and inner products, one order after the other. ``dr, di``: those of all slots of
    the order at hand, as far as lower orders give them: 0 for coordinates. ``er, ei``: what its own
    coefficients add to those of inner products.
    ``jr, ji``: Jacobian, then its factors. ``mr, mi``: derivative by t of its polynomial rows.
    ``sr, si``: a Taylor coefficient of the derivative of the rows by t alone.
    ``br, bi``: right-hand side. ``pr, pi``: patch.
    ``fr, fi``: the parts' factors at t; in a toric system those, and minus the weights. ``base``:
    point and Taylor coefficients at the last accepted t, real and imaginary parts in turn.
    ``tr``: t. ``norms``: squared norms of the two Newton corrections, then those of the Taylor
    coefficients of order 1 and up. ``radius``: that of their convergence. ``noise``: squared norms
    of the corrections that rounding errors make, 0 where they are not wanted. ``mode``: 0 in the
    lanes that predict. ``zr``: their steps in
    t. ``accepted``: 1 in the lanes whose step is accepted. ``scalars, counters``: see
    `nag.tracking.straight_run`.
    """

    vr: Reals
    vi: Reals
    cr: Reals
    ci: Reals
    dr: Reals
    di: Reals
    er: Reals
    ei: Reals
    jr: Reals
    ji: Reals
    mr: Reals
    mi: Reals
    sr: Reals
    si: Reals
    br: Reals
    bi: Reals
    pr: Reals
    pi: Reals
    fr: Reals
    fi: Reals
    pivots: Reals
    base: Reals
    tr: Reals
    norms: Reals
    radius: Reals
    noise: Reals
    mode: Reals
    zr: Reals
    accepted: Reals
    scalars: Reals
    counters: Wholes


def _real_blocks(start: np.ndarray, coefficient: np.ndarray) -> np.ndarray:
    if not coefficient.imag.any():
        return np.ones(len(start) - 1, dtype=np.int64)
    imaginary = np.append(0, np.cumsum(coefficient.imag != 0))
    return (np.diff(imaginary[start]) == 0).astype(np.int64)


def _parts(array: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    array = array.ravel()
    return np.ascontiguousarray(array.real), np.ascontiguousarray(array.imag)


def _rows(rows: CompiledRows) -> tuple[Any, ...]:
    """The arrays of compiled rows, in the order of `System` from ``first`` on."""
    tape, m = rows.tape, len(rows)
    value, jacobian = tape.value_coefficient, tape.jacobian_coefficient
    return (
        tape.first,
        tape.second,
        np.searchsorted(tape.value_place, np.arange(m + 1)),
        tape.value_place,
        tape.value_part,
        tape.value_start,
        tape.value_slot,
        *_parts(value),
        _real_blocks(tape.value_start, value),
        np.searchsorted(tape.jacobian_place, np.arange(m * rows.N + 1)),
        tape.jacobian_part,
        tape.jacobian_start,
        tape.jacobian_slot,
        *_parts(jacobian),
        _real_blocks(tape.jacobian_start, jacobian),
    )


def system(homotopy: Homotopy, weights: np.ndarray | None = None) -> Table:
    """The table of `System` for ``homotopy``; with ``weights``, (paths, parts), of a toric one."""
    known = homotopy._cache.get("system")
    if known is not None and weights is None:
        return known
    factors = homotopy.factors
    moving = [int(b != 0 or a != 1 or weights is not None) for a, b in factors]
    (A0_re, A0_im), (A1_re, A1_im) = map(_parts, (homotopy.A0, homotopy.A1))
    tape, toric = homotopy.rows.tape, weights is not None
    made = replaced(
        _template(homotopy),
        linear=len(homotopy.A0),
        parts=len(factors),
        inner=tape.value_products if toric else tape.inner_products,
        moves=int(any(b != 0 for _, b in factors)),
        factor_re=np.array([c.real for pair in factors for c in pair]),
        factor_im=np.array([c.imag for pair in factors for c in pair]),
        moving=np.array(moving, dtype=np.int64),
        A0_re=A0_re,
        A0_im=A0_im,
        A1_re=A1_re,
        A1_im=A1_im,
        linear_moving=homotopy.A1.any(axis=1).astype(np.int64),
        toric=int(toric),
        weights=np.ascontiguousarray(weights, float).ravel() if toric else np.zeros(1),
    )
    if weights is None:
        homotopy._cache["system"] = made
    return made


def at_end(homotopy: Homotopy) -> Table:
    """The same for t = 0 alone, with linear rows scaled to norms between 1/2 and 1."""
    made, shape = system(homotopy), homotopy.A0.shape
    exponents = np.frexp(norms(homotopy.A0))[1]
    if not exponents.any():
        return made
    scales = np.ldexp(1.0, -exponents)[:, None]
    re, im = (part.reshape(shape) * scales for part in (made.record.A0_re, made.record.A0_im))
    return replaced(made, A0_re=re.ravel(), A0_im=im.ravel())


def _template(homotopy: Homotopy) -> Table:
    """What all homotopies of the same rows have in common."""
    rows = homotopy.rows
    if "system" not in rows._cache:
        tape, nothing, none = rows.tape, np.zeros(0), np.zeros(0, np.int64)
        rows._cache["system"] = table(
            System(
                rows.N,
                len(rows),
                0,
                len(homotopy.groups),
                0,
                tape.value_products,
                len(tape.first),
                len(tape.value_place),
                0,
                0,
                *_rows(rows),
                *(nothing, nothing, none, nothing, nothing, nothing, nothing, none),
                homotopy.group_of,
                0,
                nothing,
            )
        )
    return rows._cache["system"]


def scratch_table(homotopy: Homotopy, order: int, toric: bool = False) -> Table:
    """The table of `Work` for ``homotopy`` and Taylor coefficients up to ``order``."""
    N, rows = homotopy.N, len(homotopy.rows)
    tape = homotopy.rows.tape
    slots = N + 1 + len(tape.first)
    value_slots = N + 1 + tape.value_products
    inner_slots = value_slots if toric else N + 1 + tape.inner_products
    parts = len(homotopy.factors)
    sizes = [slots] * 2 + [order * inner_slots] * 2 + [value_slots] * 2 + [inner_slots] * 2
    sizes += [N * N] * 2 + [rows * N] * 2 + [N] * 6 + [parts] * 2
    sizes += [N, 2 * (order + 1) * N, 1, order + 2, 1, 1, 1, 1, 1, SCALARS]
    vectors, counters = aligned_zeros(sum(sizes)), np.zeros(48, np.int64)
    words = np.array([0, *accumulate(sizes)]) * VECTOR
    words += address(vectors)
    words[-1] = address(counters)
    return Table(words, address(words), Work(*separate(vectors, sizes), counters))
