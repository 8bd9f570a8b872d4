"""What a path costs, in time, in memory and on disk, and what very many paths would.

Measured on katsura systems, all of whose 2^n paths lead to zeros: in this machine's processor time,
each size in a process of its own, with a ledger and certificates. The time of a path is fitted by a
power of the number of unknowns.
"""

from __future__ import annotations

import math
import multiprocessing
import resource
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

# A kilobyte of `ru_maxrss`, which macOS tells in bytes.
_UNIT = 1 if sys.platform == "darwin" else 1024


@dataclass(frozen=True)
class PathCost:
    """What the paths of a system cost.

    Attributes:
        unknowns, paths, steps: numbers of.
        seconds: of the processor, tracking and judging.
        proof: of the processor, certificates.
        found: of the processor, the same again from the ledger.
        memory: most bytes in use beyond what a small system takes.
        ledger: bytes on disk.
        workers: wall time of one process over that of two; 0 where it was not measured.
    """

    unknowns: int
    paths: int
    steps: int
    seconds: float
    proof: float
    found: float
    memory: int
    ledger: int
    workers: float = 0.0


def katsura(n: int) -> list[str]:
    """The equations of a magnet's n + 1 densities, with 2^n solutions (Katsura 1986)."""

    def density(k: int) -> str:
        return f"u{abs(k)}"

    equations = ["u0" + "".join(f" + 2*u{k}" for k in range(1, n + 1)) + " - 1"]
    for m in range(n):
        pairs = [(k, m - k) for k in range(-n, n + 1) if abs(m - k) <= n]
        products = " + ".join(f"{density(a)}*{density(b)}" for a, b in pairs)
        equations.append(f"{products} - {density(m)}")
    return equations


def measure_path_costs(sizes: Sequence[int], workers: bool = False) -> Iterator[PathCost]:
    """What the paths of katsura systems cost, one size after the other.

    Args:
        sizes: their n.
        workers: whether two worker processes are compared with one, at the largest size.
    """
    alone = multiprocessing.get_context("spawn")
    for n in sizes:
        with ProcessPoolExecutor(1, mp_context=alone) as process:
            yield process.submit(_measure, n, workers and n == max(sizes)).result()


def _measure(n: int, workers: bool) -> PathCost:
    """The same in this process, which has done nothing else."""
    import nag

    equations = katsura(n)
    # Kernels are compiled or loaded, and a program's own memory is taken.
    nag.certify(nag.solve(katsura(8)))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with tempfile.TemporaryDirectory() as folder:
        run = nag.Run(resume=folder)
        started = time.process_time()
        found = nag.solve(equations, run=run)
        tracked = time.process_time()
        nag.certify(found, run=run)
        proved = time.process_time()
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        nag.solve(equations, run=run)
        again = time.process_time()
        size = sum(file.stat().st_size for file in Path(folder).iterdir())
    return PathCost(
        n + 1,
        found.paths.tracked,
        found.paths.steps,
        tracked - started,
        proved - tracked,
        again - proved,
        memory * _UNIT,
        size,
        _speed_of_two(equations) if workers else 0.0,
    )


def _speed_of_two(equations: list[str]) -> float:
    """Wall time with one worker process over that with two."""
    import nag

    seconds = []
    for count in (1, 2):
        started = time.perf_counter()
        nag.solve(equations, executor=f"processes:{count}")
        seconds.append(time.perf_counter() - started)
    return seconds[0] / seconds[1]


@dataclass(frozen=True)
class CostModel:
    """Seconds a path: ``seconds * unknowns ** power``; bytes a path and an unknown, beyond what few
    paths take.
    """

    seconds: float
    power: float
    memory: float
    ledger: float

    @classmethod
    def fit(cls, costs: Sequence[PathCost]) -> CostModel:
        """The power by least squares in logarithms, bytes by what the largest system adds.

        What is in memory however many paths there are is the same for the two largest.

        Raises:
            ValueError: if there are fewer than two sizes.
        """
        if len({each.unknowns for each in costs}) < 2:
            raise ValueError("one size says nothing of how costs grow")
        logs = [math.log((each.seconds + each.proof) / each.paths) for each in costs]
        power, first = np.polyfit([math.log(each.unknowns) for each in costs], logs, 1)
        before, last = sorted(costs, key=lambda each: each.paths)[-2:]
        more = last.paths * last.unknowns - before.paths * before.unknowns
        return cls(
            math.exp(first),
            float(power),
            max(last.memory - before.memory, 0) / more,
            (last.ledger - before.ledger) / more,
        )

    def plan(self, paths: int, unknowns: int) -> tuple[float, float, float]:
        """Seconds of one processor, bytes in memory and bytes on disk for so many paths."""
        entries = paths * unknowns
        seconds = paths * self.seconds * unknowns**self.power
        return seconds, entries * self.memory, entries * self.ledger
