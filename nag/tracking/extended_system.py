"""A homotopy in double-double arithmetic: its arrays, values and Jacobian for one path."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from nag.machine_code.records import Complexes, Reals, Wholes
from nag.tracking.compiled import CompiledRows
from nag.tracking.double_double import (
    add_product,
    at,
    clear,
    exact,
    plus,
    put,
    times,
)
from nag.tracking.homotopy import Homotopy
from nag.tracking.precision import split


class Extended(NamedTuple):
    """A homotopy with double-double coefficients, four doubles each: re, re low, im, im low.

    See `nag.tracking.compiled.Tape`; the numbers say how long the arrays are.
    """

    N: int
    rows: int
    linear: int
    groups: int
    products: int
    value_blocks: int
    jacobian_blocks: int
    group_of: Wholes
    first: Wholes
    second: Wholes
    value_place: Wholes
    value_part: Wholes
    value_start: Wholes
    value_slot: Wholes
    value: Reals
    jacobian_place: Wholes
    jacobian_part: Wholes
    jacobian_start: Wholes
    jacobian_slot: Wholes
    jacobian: Reals
    factors: Complexes
    A0: Complexes
    A1: Complexes


class ExtendedWork(NamedTuple):
    """Scratch of one path; double-doubles are four doubles each, see `Extended`.

    ``x, y``: points. ``patch``: linear forms that normalise them. ``slots``: of the last point.
    ``lines``: linear rows at t. ``m``: Jacobian, then its factors. ``b``: values, then solutions.
    ``slope, old, old_slope, here``: tangents and points in doubles.
    """

    x: Reals
    y: Reals
    patch: Reals
    slots: Reals
    lines: Reals
    m: Reals
    b: Reals
    pivots: Wholes
    slope: Complexes
    old: Complexes
    old_slope: Complexes
    here: Complexes


def _quads(pairs: list[tuple[complex, complex]]) -> np.ndarray:
    flat = [(h.real, low.real, h.imag, low.imag) for h, low in pairs]
    return np.array(flat, dtype=float).reshape(-1, 4)


def _coefficients(rows: CompiledRows) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients of the values and of the Jacobian, in the order of the rows' tape."""
    values: list[tuple[complex, complex]] = []
    blocks: list[tuple[int, int, list[tuple[complex, complex]]]] = []
    for r, (row, scale) in enumerate(zip(rows.parts, rows.scales, strict=True)):
        for part, terms in row:
            derivatives: dict[int, list[tuple[complex, complex]]] = {}
            for e in sorted(terms, reverse=True):
                values.append(split(terms[e], scale))
                for j, k in enumerate(e):
                    if k:
                        derivatives.setdefault(j, []).append(split(terms[e] * k, scale))
            blocks += [(r * rows.N + j, part, derivatives[j]) for j in sorted(derivatives)]
    blocks.sort(key=lambda block: (block[0], block[1]))
    return _quads(values), _quads([pair for *_, block in blocks for pair in block])


def extended_system(homotopy: Homotopy) -> Extended:
    """The arrays of ``homotopy`` for `track_extended_batch`."""
    tape = homotopy.rows.tape
    value, jacobian = _coefficients(homotopy.rows)
    return Extended(
        homotopy.N,
        len(homotopy.rows),
        len(homotopy.A0),
        len(homotopy.groups),
        len(tape.first),
        len(tape.value_place),
        len(tape.jacobian_place),
        homotopy.group_of,
        tape.first,
        tape.second,
        tape.value_place,
        tape.value_part,
        tape.value_start,
        tape.value_slot,
        value,
        tape.jacobian_place,
        tape.jacobian_part,
        tape.jacobian_start,
        tape.jacobian_slot,
        jacobian,
        np.array(homotopy.factors, dtype=np.complex128).reshape(-1, 2),
        np.ascontiguousarray(homotopy.A0),
        np.ascontiguousarray(homotopy.A1),
    )


def extended_work(homotopy: Homotopy) -> ExtendedWork:
    N = homotopy.N
    slots = N + 1 + len(homotopy.rows.tape.first)
    sizes = [N, N, N, slots, len(homotopy.A0) * N, N * N, N]
    return ExtendedWork(
        *(np.zeros(4 * size) for size in sizes),
        np.zeros(N, dtype=np.int64),
        *(np.zeros(N, dtype=np.complex128) for _ in range(4)),
    )


def fill_slots(s, w, x):
    n = s.N
    for j in range(4 * n):
        w.slots[j] = x[j]
    put(w.slots, n, (1.0, 0.0, 0.0, 0.0))
    for k in range(s.products):
        put(w.slots, n + 1 + k, times(at(w.slots, s.first[k]), at(w.slots, s.second[k])))


def _blocks(w, count, place, part, start, slot, coefficient, factors, t, out):
    for b in range(count):
        total = 0.0, 0.0, 0.0, 0.0
        for q in range(start[b], start[b + 1]):
            total = plus(total, times(at(coefficient, q), at(w.slots, slot[q])))
        f = factors[2 * part[b]] + t * factors[2 * part[b] + 1]
        if f != 1.0:
            total = times(exact(f), total)
        put(out, place[b], plus(at(out, place[b]), total))


def rows_at(s, w, t):
    """Linear rows at t as double-doubles: t A1 is not rounded."""
    for k in range(s.linear * s.N):
        put(w.lines, k, plus(times(exact(t), exact(s.A1[k])), exact(s.A0[k])))


def values(s, w, x, t):
    """Values of all rows; patches are ``patch x - 1``."""
    n = s.N
    fill_slots(s, w, x)
    clear(w.b, n)
    _blocks(
        w,
        s.value_blocks,
        s.value_place,
        s.value_part,
        s.value_start,
        s.value_slot,
        s.value,
        s.factors,
        t,
        w.b,
    )
    for k in range(s.linear):
        for j in range(n):
            add_product(w.b, s.rows + k, at(w.lines, n * k + j), at(x, j))
    first = s.rows + s.linear
    for g in range(s.groups):
        w.b[4 * (first + g)] = -1.0
    for j in range(n):
        add_product(w.b, first + s.group_of[j], at(w.patch, j), at(x, j))


def jacobian(s, w, t):
    """Jacobian of all rows, from the slots of the last `_values`."""
    n = s.N
    clear(w.m, n * n)
    _blocks(
        w,
        s.jacobian_blocks,
        s.jacobian_place,
        s.jacobian_part,
        s.jacobian_start,
        s.jacobian_slot,
        s.jacobian,
        s.factors,
        t,
        w.m,
    )
    for k in range(s.linear * n):
        put(w.m, s.rows * n + k, at(w.lines, k))
    first = s.rows + s.linear
    for j in range(n):
        put(w.m, (first + s.group_of[j]) * n + j, at(w.patch, j))
