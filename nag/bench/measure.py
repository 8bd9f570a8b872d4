"""Times of solving a benchmark system, and what arithmetic allows at best."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.bench.step_parts import count_flops
from nag.numerics.linear_algebra_threads import VARIABLES
from nag.solving.parameter import Solved, begin_of_family, solve_generic, solve_targets
from nag.solving.solutions import SolveResult
from nag.solving.solve import solve

if TYPE_CHECKING:
    from nag.algebra.symmetric_family import FamilyMember

Solver = Callable[[int], SolveResult]

# Best of so many runs; a run that takes longer than LONG seconds is not repeated.
RUNS = 3
LONG = 5.0


@dataclass(frozen=True)
class Measured:
    """One system solved.

    Attributes:
        case: name of the case file.
        expected: number of solutions that is known, or None.
        solutions: number of isolated solutions found; complete: as `SolveResult.complete`.
        start, paths, steps: start system, paths tracked, steps taken.
        seconds: solving, warm, one thread, best of a few; all of it, start system included.
        two_threads: the same with two threads.
        process: a whole process of its own, start-up included.
        microseconds: tracking time for each step; flops: operations of a step; bound: the
            microseconds that these take at the rate measured.
    """

    case: str
    expected: int | None
    solutions: int
    complete: bool
    start: str
    paths: int
    steps: int
    seconds: float
    two_threads: float
    process: float
    microseconds: float
    flops: int
    bound: float

    @property
    def right(self) -> bool:
        """Whether the number of solutions is the known one."""
        return self.complete and self.expected in (None, self.solutions)

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return asdict(self) | {"right": self.right}


def matrix_rate() -> float:
    """Floating-point operations a second of one thread: a product of matrices, best of a few."""
    n = 512
    a = np.random.default_rng(0).random((n, n))
    best = np.inf
    for _ in range(8):
        begin = time.perf_counter()
        a @ a
        best = min(best, time.perf_counter() - begin)
    return 2 * n**3 / best


def flop_rate() -> float:
    """Floating-point operations a second of one thread, measured in a process with one thread."""
    code = "from nag.bench.measure import matrix_rate; print(matrix_rate())"
    environment = os.environ | dict.fromkeys(VARIABLES, "1")
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment
    )
    return float(done.stdout)


def _best(solver: Solver, threads: int) -> tuple[float, Any]:
    best, result = np.inf, None
    for _ in range(RUNS):
        begin = time.perf_counter()
        result = solver(threads)
        best = min(best, time.perf_counter() - begin)
        if best > LONG:
            break
    return best, result


def _generic(family: FamilyMember, seed: int, threads: int) -> Solved:
    return solve_generic(
        family.symmetric,
        start="parameter",
        count=family.solutions,
        seed=seed,
        threads=threads,
    )


def process_seconds(path: Path, seed: int) -> float:
    """Wall-clock time of ``nag solve`` for a case, in a process of its own, one thread."""
    command = [sys.executable, "-m", "nag", "solve", str(path), "--threads", "1", "--quiet"]
    best = np.inf
    for _ in range(RUNS):
        begin = time.perf_counter()
        subprocess.run([*command, "--seed", str(seed)], capture_output=True, check=False)
        best = min(best, time.perf_counter() - begin)
        if best > LONG:
            break
    return best


def measure(
    name: str,
    path: Path,
    system: PolynomialSystem,
    expected: int | None,
    seed: int,
    rate: float,
    family: FamilyMember | None = None,
) -> Measured:
    """Solve ``system`` warm with one and with two threads, and in a process of its own.

    With ``family`` it is solved by way of its family, random parameters first.
    """
    from nag.solving.solve import time_first_attempt

    def solver(threads: int) -> SolveResult:
        if family is None:
            return solve(system, seed=seed, threads=threads)
        return solve_targets(_generic(family, seed, threads), [family.values], threads=threads)[0]

    if family is None:
        solver(1)
    seconds, result = _best(solver, 1)
    two, _ = _best(solver, 2)
    if family is None:
        homotopy, tracking, steps = time_first_attempt(system, seed)
    else:
        homotopy, tracking, steps = begin_of_family(_generic(family, seed, 2), family.values)
    flops = sum(count_flops(homotopy).values())
    return Measured(
        case=name,
        expected=expected,
        solutions=len(result.solutions),
        complete=result.complete,
        start=result.start,
        paths=result.paths.tracked,
        steps=result.paths.steps,
        seconds=seconds,
        two_threads=two,
        process=process_seconds(path, seed),
        microseconds=1e6 * tracking / max(steps, 1),
        flops=flops,
        bound=1e6 * flops / rate,
    )


def as_json(measured: list[Measured], rate: float, peers: dict[str, Any]) -> str:
    """The whole table as JSON text."""
    return (
        json.dumps(
            {
                "format": "nag-bench",
                "version": 1,
                "flops_per_second": rate,
                "benchmarks": [m.document() | {"peers": peers.get(m.case, {})} for m in measured],
            },
            indent=2,
        )
        + "\n"
    )
