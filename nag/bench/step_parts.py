"""Where the time of a step goes: what its parts take, beside what their arithmetic would.

The parts of the tracker's kernel in doubles are compiled once more, each repeated by itself on the
first points of the paths. What a whole step takes beyond them is what comes between: series that
are kept, lanes that are judged one by one, filled and emptied, points that wait for others.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import LANES
from nag.machine_code.records import Table
from nag.solving.square_problem import SquareProblem
from nag.solving.start.choice import choose
from nag.tracking import kernel_arrays
from nag.tracking.evaluation import complete_slots, incomplete_slots, products
from nag.tracking.homotopy import Homotopy
from nag.tracking.kernel_arrays import KernelEquations, Work
from nag.tracking.linear_algebra import factorize, substitute
from nag.tracking.numbers.doubles import DOUBLES, ComplexDoubles
from nag.tracking.predictor import predict
from nag.tracking.settings import Settings
from nag.tracking.taylor import (
    complete_slope,
    factors_of_member,
    factors_or_powers_at,
    jacobian_and_slopes,
    normalize,
    right_side,
    values,
)
from nag.tracking.track import run_in_doubles

# Where the lanes are put: between the two systems.
MIDDLE = 0.5
# A part is repeated for so many seconds, and the best of so many runs counts.
SECONDS, RUNS = 0.02, 5
# Paths whose steps are timed, at most.
PATHS = 2048


class Repeats(NamedTuple):
    """How often a part is done, and the order of the Taylor coefficients."""

    times: int
    order: int


def _evaluate(z: ComplexDoubles, s: KernelEquations, w: Work, r: Repeats) -> None:
    for _ in range(r.times):
        normalize(z, s, w)
        factors_or_powers_at(z, s, w)
        products(z, s, w, 0, s.products)
        values(z, s, w)
        products(z, s, w, 0, s.value_products)
        values(z, s, w)


def _differentiate(z: ComplexDoubles, s: KernelEquations, w: Work, r: Repeats) -> None:
    for _ in range(r.times):
        jacobian_and_slopes(z, s, w)


def _differentiate_and_factorize(
    z: ComplexDoubles, s: KernelEquations, w: Work, r: Repeats
) -> None:
    for _ in range(r.times):
        jacobian_and_slopes(z, s, w)
        factorize(z, s.N, w.matrix, w.pivots)


def _raise_products(z: ComplexDoubles, s: KernelEquations, w: Work, r: Repeats) -> None:
    for _ in range(r.times):
        for k in range(1, r.order + 1):
            if k > 1:
                incomplete_slots(z, s, w, k)
            complete_slots(z, s, w, k)


def _raise_rows(z: ComplexDoubles, s: KernelEquations, w: Work, r: Repeats) -> None:
    for _ in range(r.times):
        for k in range(1, r.order + 1):
            right_side(z, s, w, k)
            complete_slope(z, s, w)


def _raise_rows_and_solve(z: ComplexDoubles, s: KernelEquations, w: Work, r: Repeats) -> None:
    for _ in range(r.times):
        for k in range(1, r.order + 1):
            right_side(z, s, w, k)
            substitute(z, s.N, w.matrix, w.pivots, w.right)
            complete_slope(z, s, w)


def _predict(z: ComplexDoubles, s: KernelEquations, w: Work, r: Repeats) -> None:
    for _ in range(r.times):
        predict(z, s, w, r.order)


Repeated = Callable[[ComplexDoubles, KernelEquations, Work, Repeats], None]


class Part(NamedTuple):
    """A part of a step: what is repeated, and what of that is another part's, counted once."""

    name: str
    whole: Repeated
    without: Repeated | None = None


PARTS = (
    Part("values", _evaluate),
    Part("Jacobian", _differentiate),
    Part("its factors", _differentiate_and_factorize, _differentiate),
    Part("series of products", _raise_products),
    Part("series of rows", _raise_rows),
    Part("linear systems", _raise_rows_and_solve, _raise_rows),
    Part("prediction", _predict),
)
_KERNELS: dict[Repeated, Kernel] = {
    function: Kernel(function, DOUBLES)
    for part in PARTS
    for function in (part.whole, part.without)
    if function is not None
}


def count_flops(homotopy: Homotopy, order: int = Settings().order) -> dict[str, int]:
    """Real additions and multiplications of a step, by its parts' names.

    Products and terms are counted from the compiled system; a complex product is 6 operations, a
    complex sum 2, a complex number times a real one 2.
    """
    tape, n = homotopy.rows.tape, homotopy.N

    def blocks(start: np.ndarray, coefficient: np.ndarray) -> int:
        real = sum(
            (4 if not coefficient[a:b].imag.any() else 8) * int(b - a) for a, b in pairwise(start)
        )
        return real + 16 * (len(start) - 1)

    value = blocks(tape.value_start, tape.value_coefficient)
    linear = 8 * n * len(homotopy.A0)
    products = 6 * (len(tape.first) + tape.value_products)
    # A coefficient of order k of a product takes k - 1 complex products and as many sums.
    series = tape.value_products * 8 * (order * (order - 1) // 2) + tape.inner_products * 16 * order
    slopes = 8 * len(np.unique(tape.jacobian_place)) * order
    return {
        "values": products + 2 * (value + linear),
        "Jacobian": blocks(tape.jacobian_start, tape.jacobian_coefficient),
        "its factors": 8 * n**3 // 3,
        "series of products": series,
        "series of rows": slopes + (order - 1) * value + order * linear,
        "linear systems": (order + 2) * 8 * n * n,
        "prediction": (48 + 8 * order) * n,
    }


@dataclass(frozen=True)
class PartCost:
    """A part of a step: its operations, and the microseconds that it takes, of one path."""

    name: str
    flops: int
    microseconds: float


@dataclass(frozen=True)
class StepCost:
    """What a step takes.

    Attributes:
        case: name of the system.
        microseconds: of a whole step in doubles, of one path, ends included.
        parts: of it; the rest is between them.
    """

    case: str
    microseconds: float
    parts: tuple[PartCost, ...]

    @property
    def unexplained(self) -> float:
        """Microseconds that no part explains."""
        return self.microseconds - sum(part.microseconds for part in self.parts)

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return asdict(self)


def measure_step(case: str, system: PolynomialSystem, seed: int = 0) -> StepCost:
    """What a step of the paths that solve a system takes, and its parts.

    Raises:
        nag.StartError: if there is no start system.
    """
    rng = np.random.default_rng(seed)
    problem = SquareProblem.of(system, [f for f in system.polynomials if f], rng)
    begin, _ = choose(problem.target, "auto", system.groups, rng, 1)
    homotopy, order = begin.homotopy, Settings().order
    starts = homotopy.normalized(begin.points[np.arange(min(len(begin.points), PATHS))])
    flops = count_flops(homotopy, order)
    arrays, scratch = kernel_arrays.equations(homotopy), _lanes(homotopy, starts, order)
    own: dict[Repeated, float] = {}
    for function, kernel in _KERNELS.items():
        # Linear systems are solved with the matrix of the points.
        _KERNELS[_differentiate_and_factorize](arrays, scratch, Repeats(1, order))
        own[function] = _time(lambda times, k=kernel: k(arrays, scratch, Repeats(times, order)))
    parts = []
    for name, whole, without in PARTS:
        spent = own[whole] - (own[without] if without is not None else 0.0)
        # Newton's two corrections are solved for beside the coefficients.
        share = (order + 2) / order if name == "linear systems" else 1.0
        parts.append(PartCost(name, flops[name], 1e6 * share * spent / LANES))

    def track() -> int:
        return int(run_in_doubles(homotopy, starts, Settings(), 1, True).steps.sum())

    steps = track()
    seconds = min(_seconds(track) for _ in range(RUNS))
    return StepCost(case, 1e6 * seconds / max(steps, 1), tuple(parts))


def _lanes(homotopy: Homotopy, starts: np.ndarray, order: int) -> Table:
    """Scratch with points of eight paths in the lanes."""
    made = kernel_arrays.scratch_table(homotopy, order)
    w, s = made.record, kernel_arrays.equations(homotopy).record
    w.t[:], w.ahead[:], w.mode[:] = MIDDLE, -0.01, 0.0
    for lane in range(LANES):
        x = starts[lane % len(starts)]
        w.slots[lane : 2 * LANES * homotopy.N : 2 * LANES] = x.real
        w.slots[LANES + lane : 2 * LANES * homotopy.N : 2 * LANES] = x.imag
        factors_of_member(s, w, lane, 0)
    # Series that neither vanish nor overflow.
    w.base[:] = np.resize(np.linspace(0.1, 1.0, 97), len(w.base))
    return made


def _time(run: Callable[[int], None]) -> float:
    """Seconds of one repetition, the best of a few."""
    run(1)
    times = 1
    while _seconds(partial(run, times)) < SECONDS:
        times *= 2
    return min(_seconds(partial(run, times)) for _ in range(RUNS)) / times


def _seconds(run: Callable[[], object]) -> float:
    begin = time.process_time()
    run()
    return time.process_time() - begin
