"""Scratch for the kernel of the ends, and weights of the terms of series in the logarithm of t."""

from __future__ import annotations

from functools import cache
from math import factorial
from typing import Annotated, NamedTuple

import numpy as np

from nag.machine_code.lanes import scratch
from nag.machine_code.records import Reals, Table, Wholes, replaced
from nag.tracking import kernel_arrays
from nag.tracking.homotopy import Homotopy
from nag.tracking.kernel_arrays import split

# What a lane does.
IDLE, STEP, FINISH = 0.0, 1.0, 2.0


class Room(NamedTuple):
    """Scratch for eight paths, vectors of lanes, see `nag.machine_code.lanes.scratch`.

    A real number has ``words`` vectors, a complex one twice as many; ``orders`` are those of Taylor
    coefficients, and ``terms`` these with order 0.

    ``t, slots, series, partial, change, factor``: as in `nag.tracking.kernel_arrays.Work`, of
    series in the logarithm of t. ``sums, lines``: Taylor coefficients of the blocks, and of the
    linear rows' moving parts, order by order from 0 on.
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
    their rounding errors. ``measures``: of the last correction. ``accepted``: 1 in the lanes whose
    step is accepted. ``limits``: see `nag.tracking.ends.branch.extrapolate`.

    The others are of each lane's path: ``mode``: `IDLE`, `STEP` or `FINISH`; ``path``: its number;
    ``here``: t at the base, ``h``: the next step in its logarithm; ``first, last``: Newton's first
    and last correction; ``contraction, curvature``: what the second is of the first, and Newton's
    constant; ``settled``: 1 for a point that has converged, 2 for one that has failed; ``taken,
    evaluated, rejected``: steps, evaluations, and steps in a row that were rejected; ``tried``:
    last terms at the last trial at t = 0; ``winding``: winding number, ``waited``: steps since it
    converges with it; ``known, excess``: error of the point, and the correction it stands for;
    ``based, saved``: 1 where there is a base, and a safe point; ``wanted``: 1 where a point is to
    be predicted; ``rough``: 1 where the point comes from doubles; ``seen_t, seen_radius``: see
    `nag.tracking.predictor.radius_as_seen`.
    """

    t: Annotated[Reals, "words"]
    slots: Annotated[Reals, "complex slots"]
    series: Annotated[Reals, "orders complex value_slots"]
    partial: Annotated[Reals, "complex value_slots"]
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
    measures: Annotated[Reals, "4"]
    accepted: Annotated[Reals, "1"]
    limits: Annotated[Reals, "4 complex variables"]
    mode: Annotated[Reals, "1"]
    h: Annotated[Reals, "1"]
    first: Annotated[Reals, "1"]
    last: Annotated[Reals, "1"]
    contraction: Annotated[Reals, "1"]
    settled: Annotated[Reals, "1"]
    curvature: Annotated[Reals, "1"]
    tried: Annotated[Reals, "1"]
    known: Annotated[Reals, "1"]
    based: Annotated[Reals, "1"]
    wanted: Annotated[Reals, "1"]
    excess: Annotated[Reals, "1"]
    saved: Annotated[Reals, "1"]
    rough: Annotated[Reals, "1"]
    here: Annotated[Reals, "1"]
    seen_t: Annotated[Reals, "1"]
    seen_radius: Annotated[Reals, "1"]
    path: Annotated[Wholes, "1"]
    taken: Annotated[Wholes, "1"]
    winding: Annotated[Wholes, "1"]
    waited: Annotated[Wholes, "1"]
    rejected: Annotated[Wholes, "1"]
    evaluated: Annotated[Wholes, "1"]


# Inverses of whole numbers.
MOST_INVERSES = 64


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
def weights(order: int, count: int) -> dict[str, np.ndarray]:
    """The weights of `nag.tracking.kernel_arrays.KernelEquations`, by name, in ``count`` words."""
    rows, common = _logarithm_powers(order)
    numerators = {
        "at_end": [sum((-1) ** m * c for m, c in enumerate(row)) for row in rows],
        "slope_at_end": [
            (k + 1) * sum((-1) ** m * c for m, c in enumerate(rows[k][:-1])) for k in range(order)
        ],
        "last_of_slope": [(k + 1) * rows[k][order - 1] for k in range(order)],
        "bend_at_end": [sum(-((-1) ** m) * m * c for m, c in enumerate(row)) for row in rows],
    }
    exact = {
        name: np.array([part for c in own for part in split(c, common, count)])
        for name, own in numerators.items()
    }
    inverses = [part for k in range(MOST_INVERSES) for part in split(1, max(k, 1), count)]
    return {"logarithm": composition(order).ravel(), **exact, "inverses": np.array(inverses)}


def equations(homotopy: Homotopy, count: int, order: int) -> Table:
    """The arrays of ``homotopy`` for numbers of ``count`` words and series up to ``order``."""
    return replaced(kernel_arrays.equations(homotopy, count), **weights(order, count))


def room(homotopy: Homotopy, count: int, order: int) -> Table:
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
    )
