"""A homotopy and room to work as flat arrays for the kernel of the ends."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from math import factorial
from typing import Annotated, NamedTuple

import numpy as np

from nag.algebra.number import Number, rounded_fraction
from nag.machine_code.lanes import scratch
from nag.machine_code.records import Reals, Wholes
from nag.tracking.ends.lane_scalars import SCALARS
from nag.tracking.homotopy import Homotopy


class KernelEquations(NamedTuple):
    """A homotopy; numbers have as many words as the arithmetic (see `nag.tracking.compiled.Tape`).

    ``value, jacobian``: coefficients, real and imaginary part in turn. ``factors``: of part ``p``
    the real and imaginary parts of ``a`` and ``b`` in ``a + t b``; ``A0, A1``: likewise real and
    imaginary parts in turn. ``moving``: whether a part's factor is not 1. ``logarithm``: see
    `composition`. ``at_end``: weights of the coefficients of a series in ``log t`` in its value at
    t = 0, by its power series in t; ``slope_at_end, last_of_slope``: likewise weights of the
    coefficients of order 1 and up in the value of its derivative there, and in that one's last
    term; ``bend_at_end``: of all its coefficients in its derivative with respect to
    ``(t / here) ** (1 / w)``; ``inverses``: 1 / k.
    """

    N: int
    rows: int
    linear: int
    groups: int
    parts: int
    value_products: int
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
    moving: Wholes
    factors: Reals
    A0: Reals
    A1: Reals
    logarithm: Reals
    at_end: Reals
    slope_at_end: Reals
    last_of_slope: Reals
    bend_at_end: Reals
    inverses: Reals


class Room(NamedTuple):
    """Scratch for eight paths, vectors of lanes; numbers are laid out as in `KernelEquations`.

    Each field says how many vectors it has, see `nag.machine_code.lanes.scratch`: a real number has
    ``words`` of them, a complex one twice as many; ``orders`` are those of Taylor coefficients, and
    ``terms`` these with order 0.

    ``t``: where the lanes are. ``slots``: coordinates, 1 and products at the point; ``series``:
    their Taylor coefficients in the logarithm of t, order by order from 1 on; ``change``: what a
    coordinate's coefficient adds to them. ``factor``: of the parts at t. ``sums, lines``: Taylor
    coefficients of the blocks, and of the linear rows' moving parts, order by order from 0 on.
    ``matrix, right, noise``: Jacobian, and two right-hand sides. ``pivots, columns, scales``: of
    its factors. ``sizes``: of the terms of each row. ``patch, levels``: linear forms that
    normalise, and their values. ``base``: the last accepted point, ``time``: t there; ``safe,
    safe_time``: the last base that was known well, and t there. ``coordinates, logarithms``: Taylor
    coefficients of the coordinates and of their logarithms at the base, order by order from 1 on;
    ``fresh``: those of the logarithms at the point; ``plain, logs``: the same rounded to doubles,
    coordinate by coordinate from order 0 on. ``weights, errors``: sizes in which corrections count,
    and rounding errors, of each coordinate at the point; ``least, floors``: the least sizes that
    columns are scaled by, and in which corrections count; ``base_sizes``: of the coordinates at the
    base, ``base_weights, base_errors``: as above there; ``met``: 1 for those that have exceeded
    their rounding errors. ``scalars``: see the kernel. ``measures``: of the last correction.
    ``accepted``: 1 in the lanes whose step is accepted. ``limits``: see
    `nag.tracking.ends.branch.extrapolate`.
    """

    t: Annotated[Reals, "words"]
    slots: Annotated[Reals, "complex slots"]
    series: Annotated[Reals, "orders complex value_slots"]
    change: Annotated[Reals, "complex changes"]
    factor: Annotated[Reals, "complex parts"]
    sums: Annotated[Reals, "terms complex blocks"]
    lines: Annotated[Reals, "terms complex linear"]
    matrix: Annotated[Reals, "complex variables variables"]
    right: Annotated[Reals, "complex variables"]
    noise: Annotated[Reals, "complex variables"]
    pivots: Annotated[Reals, "variables"]
    columns: Annotated[Reals, "variables"]
    scales: Annotated[Reals, "variables"]
    sizes: Annotated[Reals, "variables"]
    patch: Annotated[Reals, "2 variables"]
    levels: Annotated[Reals, "complex groups"]
    base: Annotated[Reals, "complex variables"]
    time: Annotated[Reals, "words"]
    safe: Annotated[Reals, "complex variables"]
    safe_time: Annotated[Reals, "words"]
    coordinates: Annotated[Reals, "orders complex variables"]
    logarithms: Annotated[Reals, "orders complex variables"]
    fresh: Annotated[Reals, "orders complex variables"]
    plain: Annotated[Reals, "2 terms variables"]
    logs: Annotated[Reals, "2 terms variables"]
    weights: Annotated[Reals, "variables"]
    least: Annotated[Reals, "variables"]
    floors: Annotated[Reals, "variables"]
    errors: Annotated[Reals, "variables"]
    base_sizes: Annotated[Reals, "variables"]
    base_weights: Annotated[Reals, "variables"]
    base_errors: Annotated[Reals, "variables"]
    met: Annotated[Reals, "variables"]
    scalars: Annotated[Reals, "scalars"]
    measures: Annotated[Reals, "4"]
    accepted: Annotated[Reals, "1"]
    limits: Annotated[Reals, "4 complex variables"]


# Inverses of whole numbers.
MOST_INVERSES = 64


def _split(numerator: int, denominator: int, count: int) -> list[float]:
    """A quotient as a sum of doubles; integers are enough, and no common factor is looked for."""
    parts = [0.0] * count
    for k in range(count):
        if not numerator:
            break
        parts[k] = numerator / denominator
        p, q = parts[k].as_integer_ratio()
        numerator, denominator = numerator * q - p * denominator, denominator * q
    return parts


def words(value: Number | complex, count: int, factor: Fraction = Fraction(1)) -> list[float]:
    """Real and imaginary part of a product as sums of ``count`` doubles, the largest first."""
    over, under = factor.numerator, factor.denominator
    if isinstance(value, complex | float | np.complexfloating | np.floating):
        z = complex(value)
        ratios = z.real.as_integer_ratio(), z.imag.as_integer_ratio()
        return [part for p, q in ratios for part in _split(p * over, q * under, count)]
    value = rounded_fraction(value, 20 * count)
    # A common factor does no harm.
    real = _split(value.numerator * over, value.denominator * under, count)
    return [*real, *[0.0] * count]


def coefficients(homotopy: Homotopy, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients of the values and of the Jacobian in the order of the rows' tape."""
    rows = homotopy.rows
    key = f"words {count}"
    if key not in rows._cache:
        values: list[float] = []
        blocks: list[tuple[int, int, list[float]]] = []
        for r, (row, scale) in enumerate(zip(rows.parts, rows.scales, strict=True)):
            inverse = 1 / Fraction(float(scale))
            for part, terms in row:
                derivatives: dict[int, list[float]] = {}
                for e in sorted(terms, reverse=True):
                    own = {1: words(terms[e], count, inverse)}
                    values += own[1]
                    for j, k in enumerate(e):
                        if k:
                            if k not in own:
                                own[k] = words(terms[e], count, k * inverse)
                            derivatives.setdefault(j, []).extend(own[k])
                blocks += [(r * rows.N + j, part, derivatives[j]) for j in sorted(derivatives)]
        blocks.sort(key=lambda block: block[:2])
        flat = [x for _, _, own in blocks for x in own]
        rows._cache[key] = (np.array(values), np.array(flat))
    return rows._cache[key]


def _pairs(array: np.ndarray) -> np.ndarray:
    flat = np.ascontiguousarray(array, dtype=np.complex128).ravel()
    return flat.view(np.float64) if len(flat) else np.zeros(0)


def composition(order: int) -> np.ndarray:
    """Taylor coefficients of ``log(1 + r) ** k``: entry ``(k, m)`` is that of ``r^m``."""
    first = np.array([0.0] + [(-1.0) ** (m + 1) / m for m in range(1, order + 1)])
    rows = [np.eye(order + 1)[0]]
    for _ in range(order):
        rows.append(np.convolve(rows[-1], first)[: order + 1])
    return np.array(rows)


def _logarithm_powers(order: int) -> tuple[list[list[int]], int]:
    """`composition`, exactly: numerators, and the denominator that they have in common.

    The coefficient of ``r^m`` is ``k! / m!`` times a Stirling number of the first kind.
    """
    rows = [[0] * (order + 1) for _ in range(order + 1)]
    stirling = [1] + [0] * order
    for m in range(order + 1):
        for k in range(m + 1):
            rows[k][m] = factorial(k) * stirling[k] * (factorial(order) // factorial(m))
        shifted = [0, *stirling[:-1]]
        stirling = [a - m * b for a, b in zip(shifted, stirling, strict=True)]
    return rows, factorial(order)


@cache
def _constants(order: int, count: int) -> tuple[np.ndarray, ...]:
    rows, common = _logarithm_powers(order)
    at_end = [sum((-1) ** m * c for m, c in enumerate(row)) for row in rows]
    slopes = [
        (k + 1) * sum((-1) ** m * c for m, c in enumerate(rows[k][:-1])) for k in range(order)
    ]
    last = [(k + 1) * rows[k][order - 1] for k in range(order)]
    bends = [sum(-((-1) ** m) * m * c for m, c in enumerate(row)) for row in rows]
    exact = [
        np.array([part for c in numerators for part in _split(c, common, count)])
        for numerators in (at_end, slopes, last, bends)
    ]
    inverses = [part for k in range(MOST_INVERSES) for part in _split(1, max(k, 1), count)]
    return (composition(order).ravel(), *exact, np.array(inverses))


def equations(homotopy: Homotopy, count: int, order: int) -> KernelEquations:
    """The arrays of ``homotopy`` for numbers of ``count`` words."""
    tape = homotopy.rows.tape
    value, jacobian = coefficients(homotopy, count)
    factors = np.array(homotopy.factors, dtype=np.complex128).reshape(-1, 2)
    moving = (factors[:, 1] != 0) | (factors[:, 0] != 1)
    return KernelEquations(
        homotopy.N,
        len(homotopy.rows),
        len(homotopy.A0),
        len(homotopy.groups),
        len(factors),
        tape.value_products,
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
        moving.astype(np.int64),
        _pairs(factors),
        _pairs(homotopy.A0),
        _pairs(homotopy.A1),
        *_constants(order, count),
    )


def room(homotopy: Homotopy, count: int, order: int) -> Room:
    """Scratch for eight paths of ``homotopy`` in numbers of ``count`` words."""
    N, tape = homotopy.N, homotopy.rows.tape
    value_slots = N + 1 + tape.value_products
    return scratch(
        Room,
        words=count,
        complex=2 * count,
        variables=N,
        linear=len(homotopy.A0),
        groups=len(homotopy.groups),
        parts=len(homotopy.factors),
        blocks=len(tape.value_place),
        slots=N + 1 + len(tape.first),
        value_slots=value_slots,
        changes=max(value_slots, order + 1),
        orders=order,
        terms=order + 1,
        scalars=SCALARS,
    )
