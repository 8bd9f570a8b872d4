"""A homotopy as flat arrays in any arithmetic, and scratch beside it, as the kernels read them."""

from __future__ import annotations

from fractions import Fraction
from typing import Annotated, Any, NamedTuple

import numpy as np

from nag.algebra.number import Number, rounded_fraction
from nag.machine_code.lanes import scratch
from nag.machine_code.records import Reals, Table, Wholes, replaced, table
from nag.tracking.compiled import CompiledRows
from nag.tracking.evaluations import count_preparation
from nag.tracking.homotopy import Homotopy, norms

# Numbers that are no more than doubles.
_DOUBLES = complex | float | np.complexfloating | np.floating
NOTHING, NONE = np.zeros(0), np.zeros(0, np.int64)


class KernelEquations(NamedTuple):
    """A homotopy as flat arrays (see `nag.tracking.compiled.Tape` for blocks and slots).

    Each field says how many numbers it has. A coefficient of ``value`` or ``jacobian`` is as many
    doubles as the arithmetic has ``words``, of its real part and then of its imaginary part; all
    other numbers are pairs of doubles. ``factors``: of part ``p`` the numbers ``a`` and ``b`` in
    ``a + t b``, for each member if paths have factors of their own. The blocks of row ``k`` are
    ``value_begin[k] .. value_begin[k + 1] - 1``, and likewise those of an entry of the Jacobian;
    ``value_real, jacobian_real``: 1 for blocks of real coefficients. ``moves``: 1 if the factors of
    any part depend on t; ``moving``: for each part, 0 if its factor is 1, 2 if it depends on t;
    ``linear_moving``: for each linear row, whether it depends on t.
    Of the products, the Taylor coefficients of the first ``inner`` are kept for all orders.
    If ``toric`` is 1, each part is one term, t is real, and the factor of part ``p`` is
    ``exp(-weights[path * parts + p] t)`` instead.

    What follows is for series in ``log t`` alone, and of real numbers of the arithmetic but for
    the first. ``logarithm``: see `nag.tracking.ends.records.composition`. ``at_end``: weights of
    the coefficients of such a series in its value at t = 0, by its power series in t;
    ``slope_at_end, last_of_slope``: likewise weights of the coefficients of order 1 and up in the
    value of its derivative there, and in that one's last term; ``bend_at_end``: of all its
    coefficients in its derivative with respect to ``(t / here) ** (1 / w)``; ``inverses``: 1 / k.
    """

    N: int
    rows: int
    linear: int
    groups: int
    parts: int
    value_products: int
    products: int
    inner: int
    value_blocks: int
    moves: int
    toric: int
    group_of: Annotated[Wholes, "N"]
    first: Annotated[Wholes, "products"]
    second: Annotated[Wholes, "products"]
    value_begin: Annotated[Wholes, "rows+1"]
    value_place: Annotated[Wholes, "value_blocks"]
    value_part: Annotated[Wholes, "value_blocks"]
    value_start: Annotated[Wholes, "value_blocks+1"]
    value_real: Annotated[Wholes, "value_blocks"]
    value_slot: Annotated[Wholes, "value_terms"]
    value: Annotated[Reals, "value_terms 2 words"]
    jacobian_begin: Annotated[Wholes, "entries+1"]
    jacobian_part: Annotated[Wholes, "jacobian_blocks"]
    jacobian_start: Annotated[Wholes, "jacobian_blocks+1"]
    jacobian_real: Annotated[Wholes, "jacobian_blocks"]
    jacobian_slot: Annotated[Wholes, "jacobian_terms"]
    jacobian: Annotated[Reals, "jacobian_terms 2 words"]
    factors: Annotated[Reals, "members parts 4"] = NOTHING
    moving: Annotated[Wholes, "parts"] = NONE
    A0: Annotated[Reals, "linear N 2"] = NOTHING
    A1: Annotated[Reals, "linear N 2"] = NOTHING
    linear_moving: Annotated[Wholes, "linear"] = NONE
    weights: Annotated[Reals, "paths parts"] = NOTHING
    logarithm: Annotated[Reals, "terms terms"] = NOTHING
    at_end: Annotated[Reals, "terms words"] = NOTHING
    slope_at_end: Annotated[Reals, "orders words"] = NOTHING
    last_of_slope: Annotated[Reals, "orders words"] = NOTHING
    bend_at_end: Annotated[Reals, "terms words"] = NOTHING
    inverses: Annotated[Reals, "inverses words"] = NOTHING


class Work(NamedTuple):
    """Scratch vectors of eight paths in doubles, see `nag.machine_code.lanes.scratch`.

    A complex number has two vectors, of its real and its imaginary part.

    ``t``: where the lanes are. ``slots``: the point, 1 and products there; ``series``: Taylor
    coefficients, order 1 and up, of coordinates and inner products; ``partial``: those of all slots
    of the order at hand as far as lower orders give them, 0 for coordinates; ``change``: what its
    own coefficients add to those of inner products. ``factor``: of the parts at t; in a toric
    system those, and minus the weights. ``factor_at_end, rate``: what it is at t = 0, and its
    derivative by t.
    ``matrix``: Jacobian, then its factors; ``pivots``: of these. ``matrix_slope``: derivative by t
    of its polynomial rows; ``slope``: a Taylor coefficient of the derivative of the rows by t
    alone. ``right``: right-hand side. ``patch``: linear forms that normalise.
    ``base``: point and Taylor coefficients at the last accepted t.
    ``norms``: squared norms of the two Newton corrections, then those of the Taylor coefficients of
    order 1 and up. ``radius``: that of their convergence. ``noise``: squared norms of the
    corrections that rounding errors make, 0 where they are not wanted. ``mode``: 0 in the lanes
    that predict, ``ahead``: their steps in t. ``accepted``: 1 in the lanes whose step is accepted.

    The others are of each lane's path: ``here, goal``: the last accepted t, and where it is to get;
    ``h, taken_h``: the next step and the last one that was tried; ``first, theta, last``: its first
    correction, what the second is of that, and the last correction of all; ``accuracy``: expected
    error of the point; ``growth``: of the step; ``seen_t, seen_radius``: see
    `nag.tracking.predictor.radius_as_seen`; ``path``: its number, ``state, rounds, taken,
    straight``: see `nag.tracking.straight_run`.
    """

    t: Annotated[Reals, "1"]
    slots: Annotated[Reals, "slots 2"]
    series: Annotated[Reals, "orders inner_slots 2"]
    partial: Annotated[Reals, "value_slots 2"]
    change: Annotated[Reals, "inner_slots 2"]
    factor: Annotated[Reals, "parts 2"]
    factor_at_end: Annotated[Reals, "parts 2"]
    rate: Annotated[Reals, "parts 2"]
    matrix: Annotated[Reals, "N N 2"]
    pivots: Annotated[Reals, "N"]
    matrix_slope: Annotated[Reals, "rows N 2"]
    slope: Annotated[Reals, "N 2"]
    right: Annotated[Reals, "N 2"]
    patch: Annotated[Reals, "N 2"]
    base: Annotated[Reals, "orders+1 N 2"]
    norms: Annotated[Reals, "orders+2"]
    radius: Annotated[Reals, "1"]
    noise: Annotated[Reals, "1"]
    mode: Annotated[Reals, "1"]
    ahead: Annotated[Reals, "1"]
    accepted: Annotated[Reals, "1"]
    here: Annotated[Reals, "1"]
    goal: Annotated[Reals, "1"]
    h: Annotated[Reals, "1"]
    taken_h: Annotated[Reals, "1"]
    first: Annotated[Reals, "1"]
    theta: Annotated[Reals, "1"]
    last: Annotated[Reals, "1"]
    accuracy: Annotated[Reals, "1"]
    growth: Annotated[Reals, "1"]
    seen_t: Annotated[Reals, "1"]
    seen_radius: Annotated[Reals, "1"]
    path: Annotated[Wholes, "1"]
    state: Annotated[Wholes, "1"]
    rounds: Annotated[Wholes, "1"]
    taken: Annotated[Wholes, "1"]
    straight: Annotated[Wholes, "1"]


def scratch_table(homotopy: Homotopy, order: int, toric: bool = False) -> Table:
    """The table of `Work` for ``homotopy`` and Taylor coefficients up to ``order``."""
    N, tape = homotopy.N, homotopy.rows.tape
    value_slots = N + 1 + tape.value_products
    return scratch(
        Work,
        N=N,
        rows=len(homotopy.rows),
        parts=len(homotopy.factors),
        slots=N + 1 + len(tape.first),
        value_slots=value_slots,
        inner_slots=value_slots if toric else N + 1 + tape.inner_products,
        orders=order,
    )


def split(numerator: int, denominator: int, count: int) -> list[float]:
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
    over, under = factor.as_integer_ratio()
    if isinstance(value, _DOUBLES):
        z = complex(value)
        ratios = z.real.as_integer_ratio(), z.imag.as_integer_ratio()
        return [part for p, q in ratios for part in split(p * over, q * under, count)]
    value = rounded_fraction(value, 20 * count)
    # A common factor does no harm.
    p, q = value.as_integer_ratio()
    return split(p * over, q * under, count) + [0.0] * count


def values_in_words(rows: CompiledRows, count: int) -> np.ndarray:
    """Coefficients of the values in the order of the rows' tape."""
    key = f"values {count}"
    if key not in rows._cache:
        found: list[float] = []
        for row, scale in zip(rows.parts, rows.scales.tolist(), strict=True):
            inverse = 1 / Fraction(scale)
            for _, terms in row:
                for e in sorted(terms, reverse=True):
                    found += words(terms[e], count, inverse)
        rows._cache[key] = np.array(found)
    return rows._cache[key]


def _jacobian_in_words(rows: CompiledRows, count: int) -> np.ndarray:
    """The same of the Jacobian."""
    values = iter(values_in_words(rows, count).reshape(-1, 2 * count).tolist())
    blocks: list[tuple[int, int, list[float]]] = []
    for r, (row, scale) in enumerate(zip(rows.parts, rows.scales.tolist(), strict=True)):
        inverse = 1 / Fraction(scale)
        for part, terms in row:
            derivatives: dict[int, list[float]] = {}
            for e in sorted(terms, reverse=True):
                own = {1: next(values)}
                for j, k in enumerate(e):
                    if k:
                        if k not in own:
                            own[k] = words(terms[e], count, k * inverse)
                        derivatives.setdefault(j, []).extend(own[k])
            blocks += [(r * rows.N + j, part, derivatives[j]) for j in sorted(derivatives)]
    blocks.sort(key=lambda block: block[:2])
    return np.array([x for _, _, own in blocks for x in own])


def pairs(array: np.ndarray) -> np.ndarray:
    """Complex doubles as real and imaginary parts in turn."""
    return np.ascontiguousarray(array, dtype=np.complex128).ravel().view(np.float64)


def _real_blocks(start: np.ndarray, coefficient: np.ndarray) -> np.ndarray:
    if not coefficient.imag.any():
        return np.ones(len(start) - 1, dtype=np.int64)
    imaginary = np.append(0, np.cumsum(coefficient.imag != 0))
    return (np.diff(imaginary[start]) == 0).astype(np.int64)


def _template(homotopy: Homotopy, count: int) -> Table:
    """What all homotopies of the same rows have in common, in numbers of ``count`` words."""
    rows, key = homotopy.rows, f"equations {count}"
    if key not in rows._cache:
        count_preparation()
        tape, m = rows.tape, len(rows)
        value, jacobian = tape.value_coefficient, tape.jacobian_coefficient
        doubles = count == 1
        rows._cache[key] = table(
            KernelEquations(
                N=rows.N,
                rows=m,
                linear=0,
                groups=len(rows.groups),
                parts=0,
                value_products=tape.value_products,
                products=len(tape.first),
                inner=tape.inner_products if doubles else tape.value_products,
                value_blocks=len(tape.value_place),
                moves=0,
                toric=0,
                group_of=homotopy.group_of,
                first=tape.first,
                second=tape.second,
                value_begin=np.searchsorted(tape.value_place, np.arange(m + 1)),
                value_place=tape.value_place,
                value_part=tape.value_part,
                value_start=tape.value_start,
                value_real=_real_blocks(tape.value_start, value),
                value_slot=tape.value_slot,
                value=pairs(value) if doubles else values_in_words(rows, count),
                jacobian_begin=np.searchsorted(tape.jacobian_place, np.arange(m * rows.N + 1)),
                jacobian_part=tape.jacobian_part,
                jacobian_start=tape.jacobian_start,
                jacobian_real=_real_blocks(tape.jacobian_start, jacobian),
                jacobian_slot=tape.jacobian_slot,
                jacobian=pairs(jacobian) if doubles else _jacobian_in_words(rows, count),
            )
        )
    return rows._cache[key]


def equations(homotopy: Homotopy, count: int = 1, weights: np.ndarray | None = None) -> Table:
    """The table of `KernelEquations` for ``homotopy``, in numbers of ``count`` words.

    Args:
        weights: those of a toric system, shape (paths, parts).
    """
    key, toric = f"equations {count}", weights is not None
    if key in homotopy._cache and not toric:
        return homotopy._cache[key]
    factors = np.array(homotopy.factors, dtype=np.complex128).reshape(1, -1, 2)
    if homotopy.members is not None:
        factors = homotopy.members.factors
    slopes = (factors[:, :, 1] != 0).any(axis=0)
    moving = slopes + (slopes | (factors[:, :, 0] != 1).any(axis=0)).astype(np.int64)
    template = _template(homotopy, count)
    fields: dict[str, Any] = {}
    if toric:
        fields["inner"] = template.record.value_products
        fields["weights"] = np.ascontiguousarray(weights, float).ravel()
    made = replaced(
        template,
        linear=len(homotopy.A0),
        parts=factors.shape[1],
        moves=int(slopes.any()),
        toric=int(toric),
        factors=pairs(factors),
        moving=np.ones(factors.shape[1], np.int64) if toric else moving,
        A0=pairs(homotopy.A0),
        A1=pairs(homotopy.A1),
        linear_moving=homotopy.A1.any(axis=1).astype(np.int64),
        **fields,
    )
    if not toric:
        homotopy._cache[key] = made
    return made


def at_end(homotopy: Homotopy) -> Table:
    """Those in doubles for t = 0 alone, with linear rows scaled to norms between 1/2 and 1."""
    made = equations(homotopy)
    exponents = np.frexp(norms(homotopy.A0))[1]
    if not exponents.any():
        return made
    scaled = np.ldexp(pairs(homotopy.A0).reshape(len(exponents), -1), -exponents[:, None])
    return replaced(made, A0=scaled.ravel())
