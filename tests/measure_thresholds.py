"""How far the numbers that decisions rest on lie from their thresholds.

    python tests/measure_thresholds.py [--decompose] [--case FILE ...] [--seeds 0:3]

Solves the systems by paths, or decomposes them, and prints for each threshold that says so
(`nag.thresholds`) how many values it let pass and how many not, how many decades the nearest
of each lie from it, and how many lie within a decade of it. A threshold is a good one where hardly
any do: then another value of it would give the same answers.
"""

from __future__ import annotations

import argparse
import sys
from collections import defaultdict
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.decomposition import (  # noqa: F401
    discovery,
    intersection,
    monodromy,
    splitting,
    trace,
)
from nag.decomposition.decompose import decompose
from nag.files.cases import read_case
from nag.mechanism.problem import problem_of
from nag.numerics import (
    coincidence,
    double_ranks,
    doubles,
    local_structure,
    sharpening,
    zero_values,
)
from nag.numerics.ball_ranks import Digits
from nag.solving import isolated_zero, path_ends
from nag.solving import solve as solving
from nag.tracking import jumps, projective
from nag.tracking import track as tracking
from nag.tracking.ends import follow, limits
from nag.tracking.homotopy import norms
from nag.tracking.paths import PathStatus
from nag.witness import confirm, cutting

CASES = Path(__file__).parents[1] / "cases"
BENCHMARKS = [
    "caprasse",
    "cbms1",
    "cyclic-5",
    "cyclic-6",
    "eco-8",
    "griewank-osborne",
    "inverse-6r",
    "inverse-6r-clustered",
    "katsura-6",
    "kss-5",
    "mth191",
    "noon-5",
    "planar-3-rpr",
    "reimer-5",
    "stewart-gough",
]
SMALL = [
    "bennett",
    "bricard-variety",
    "double-rhombus",
    "four-bar",
    "gonzalez",
    "graph-curve",
    "rhombus",
    "rhombus-chain-2",
    "slider-crank",
    "triangle",
]
# More points are not compared in pairs.
MOST_PAIRED = 300
# Values that stand for none at all.
NONE = 1e-300


class Measured:
    """Values beside a threshold, by its name."""

    def __init__(self) -> None:
        self.values: dict[str, list[np.ndarray]] = defaultdict(list)
        self.limits: dict[str, float] = {}

    def add(self, name: str, limit: float, values: Any) -> None:
        found = np.asarray(values, dtype=float).ravel()
        self.limits[name] = limit
        self.values[name].append(found[np.isfinite(found)])

    def lines(self) -> list[str]:
        head = f"{'threshold':<34}{'value':>9}{'below':>9}{'nearest':>9}{'above':>9}{'nearest':>9}"
        lines = [f"{head}{'within 1':>10}"]
        for name, limit in self.limits.items():
            decades = np.log10(np.maximum(np.concatenate(self.values[name]), NONE) / limit)
            below, above = decades[decades <= 0], decades[decades > 0]
            low = f"{below.max():.1f}" if len(below) else "-"
            high = f"+{above.min():.1f}" if len(above) else "-"
            near = int((np.abs(decades) < 1).sum())
            lines.append(
                f"{name:<34}{limit:>9.0e}{len(below):>9}{low:>9}{len(above):>9}{high:>9}{near:>10}"
            )
        return lines


def around(original: Callable[..., Any], note: Callable[..., None]) -> Callable[..., Any]:
    """``original``, with its result and arguments handed to ``note`` as well."""

    def wrapped(*arguments: Any, **options: Any) -> Any:
        result = original(*arguments, **options)
        note(result, *arguments)
        return result

    return wrapped


def watched(measured: Measured) -> ExitStack:
    """A context in which what is compared with thresholds is measured."""

    def refined(sharp: Any, homotopy: Any, *_: Any) -> None:
        close = sharp.error < 1e-12
        ratio = sharp.smallest / sharp.error
        measured.add("SHARPEST", doubles.SHARPEST, sharp.error)
        measured.add("PROOF", tracking.PROOF, ratio[close])
        proved = close & (ratio > tracking.PROOF)
        sizes = np.abs(sharp.points[:, list(homotopy.infinity)]).min(axis=1, initial=np.inf)
        errors = tracking.RESIDUAL / np.maximum(sharp.smallest, 1e-300)
        measured.add("RESIDUAL (size over error)", 1.0, (sizes / errors)[proved])

    def known(_: Any, states: Any, path: int) -> None:
        errors = states.errors[path]
        sizes = np.abs(states.point(path))[errors > 0] / errors[errors > 0]
        measured.add("SLACK (coordinates over errors)", doubles.SLACK, sizes)

    def initial_forms(limit: Any, *_: Any) -> None:
        if limit is not None:
            need = 10.0**-limits.LEAST_EVIDENCE
            measured.add("LEAST_EVIDENCE (residuals)", need, limit.residual)

    def denominator(found: int, slopes: np.ndarray, least: int) -> None:
        multiples = np.arange(least, limits.LARGEST + 1)[:, None] * slopes
        off = np.abs(multiples - np.rint(multiples)).max(axis=1, initial=0.0)
        measured.add("WHOLE", limits.WHOLE, off[: found - least + 1] if found else off)

    def values(found: np.ndarray, *_: Any) -> None:
        measured.add("ON", zero_values.ON, found)

    def met(_: Any, groups: Any, points: np.ndarray, errors: np.ndarray) -> None:
        if len(points) < MOST_PAIRED:
            radii = doubles.SLACK * np.maximum(projective.ROUNDING, errors)
            first, second = np.triu_indices(len(points), 1)
            apart = norms(projective.aligned_difference(groups, points[first], points[second]))
            measured.add("SLACK (of ends)", 1.0, apart / np.maximum(radii[first], radii[second]))

    def real(found: tuple[Any, ...], *_: Any) -> None:
        for one in found[0]:
            size = 1 + np.abs(one.point).max(initial=0.0)
            imaginary = np.abs(one.point.imag).max(initial=0.0)
            measured.add("REAL", isolated_zero.REAL, imaginary / size)

    def judged(paths: Any, *_: Any) -> None:
        regular = paths.status == PathStatus.REGULAR
        measured.add("steps of regular ends", 1e-12, paths.accuracy[regular])

    stack = ExitStack()
    for owner, name, note in [
        (tracking, "refine", refined),
        (tracking, "_attempt", judged),
        (follow.States, "known_coordinates", known),
        (limits.Limits, "of", initial_forms),
        (limits, "_denominator", denominator),
        (path_ends, "_residuals", values),
        (path_ends, "_solutions", real),
        (jumps, "coinciding_pairs", met),
    ]:
        stack.enter_context(patch.object(owner, name, around(getattr(owner, name), note)))
    watch_digits(measured, stack)
    return stack


def watch_digits(measured: Measured, stack: ExitStack) -> None:
    """Measure what is compared in many digits, by solving as by decomposing."""

    def relative(found: Any, *_: Any) -> None:
        measured.add("VANISHES", zero_values.VANISHES, float(found))

    def negligible(numbers: Digits, size: float) -> bool:
        # Also of what is not decided, and raises an error.
        if numbers.zero == sharpening.ZERO:
            value = 10.0 ** min(size, 300.0)
            measured.add("ZERO", 10.0**sharpening.ZERO, value)
            measured.add("SOMETHING", 10.0**local_structure.SOMETHING, value)
        return judge(numbers, size)

    judge = Digits._negligible
    stack.enter_context(patch.object(Digits, "_negligible", negligible))
    everywhere(stack, zero_values.negligible_part, relative)


def everywhere(stack: ExitStack, function: Callable[..., Any], note: Callable[..., None]) -> None:
    """Hand what a function gives and is given to ``note``, wherever it is called from."""
    wrapped, name = around(function, note), function.__name__
    for module in [m for key, m in sys.modules.items() if key.startswith("nag.")]:
        if vars(module).get(name) is function:
            stack.enter_context(patch.object(module, name, wrapped))


def watched_decomposition(measured: Measured) -> ExitStack:
    """A context in which what a decomposition compares with thresholds is measured."""

    def coincident(_: Any, points: np.ndarray, x: np.ndarray, error: Any) -> None:
        distances = np.linalg.norm(points - x, axis=1)
        measured.add(
            "coincident (over LEAST)", 1.0, distances / coincidence.radii_of_balls(x[None], error)
        )

    def clusters(_: Any, points: np.ndarray, accuracy: np.ndarray) -> None:
        if len(points) < MOST_PAIRED:
            radii = coincidence.radii_of_balls(points, accuracy)
            distances = np.linalg.norm(points[:, None] - points[None], axis=2)
            ratios = distances / np.maximum(radii[:, None], radii[None])
            pairs = np.triu_indices(len(points), 1)
            measured.add("clusters (over LEAST)", 1.0, ratios[pairs])

    def compared(_: Any, distances: np.ndarray, errors: Any) -> None:
        same = np.maximum(coincidence.HIT, coincidence.SAFETY * errors)
        other = np.maximum(coincidence.MISS, coincidence.BEYOND * errors)
        measured.add("HIT (over errors)", 1.0, distances / same)
        measured.add("MISS (over errors)", 1.0, distances / other)

    def vanishing(_: Any, fibre: Any, f: Any) -> None:
        evaluator, x = Evaluator.of([f], fibre.cut.n), fibre.x
        measured.add("ON", zero_values.ON, evaluator.residuals(x))
        terms = np.maximum(evaluator.absolute(x), NONE)
        measured.add("ARRIVED", doubles.ARRIVED, np.abs(evaluator.values(x)) / terms)

    def corank(_: Any, singular: np.ndarray, columns: int, small: float) -> None:
        values = np.zeros(columns)
        values[: len(singular)] = singular[:columns]
        values = np.maximum(values / max(1.0, values.max(initial=0.0)), 1e-17)
        gaps = np.concatenate([[1.0], values[:-1]]) / values
        measured.add("GAP", double_ranks.GAP, gaps[values < small])

    def sharpened(found: Any, evaluator: Any, *_: Any) -> None:
        if np.isfinite(found.step):
            measured.add("SHARP", doubles.SHARP, found.step)
            residuals = evaluator.residuals(found.z[None]).max(initial=0.0)
            measured.add("VANISHING", doubles.VANISHING, residuals)

    def straight(_: Any, own: Any, indices: Any) -> None:
        motion = max(own.known[i].motion for i in indices)
        bent = own._bend(indices) / motion if motion else np.inf
        measured.add("EVIDENCE (bend over motion)", 1.0, bent * 10.0**own.evidence)

    def nearest(found: Any, *_: Any) -> None:
        _, closest, following = found
        with np.errstate(invalid="ignore"):
            measured.add("NEARER", monodromy.NEARER, closest / following)

    def loops(found: Any, *_: Any) -> None:
        measured.add("MOST_LOOPS", splitting.MOST_LOOPS, turns)
        turns[:] = [0.0]

    def turned(*_: Any) -> None:
        turns[0] += 1

    turns, stack = [0.0], ExitStack()
    everywhere(stack, coincidence.coincident, coincident)
    everywhere(stack, coincidence.clusters, clusters)
    everywhere(stack, coincidence.classify_arrivals, compared)
    everywhere(stack, confirm.find_vanishing, vanishing)
    everywhere(stack, double_ranks.numerical_corank, corank)
    everywhere(stack, cutting.sharpen, sharpened)
    everywhere(stack, monodromy._two_nearest, nearest)
    stack.enter_context(
        patch.object(
            trace.Trace, "_decide_in_digits", around(trace.Trace._decide_in_digits, straight)
        )
    )
    everywhere(stack, splitting.split_points, loops)
    everywhere(stack, splitting._run_loop, turned)
    watch_digits(measured, stack)
    return stack


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--case", action="append", type=Path)
    parser.add_argument("--seeds", default="0:3", help="first:last+1")
    parser.add_argument("--decompose", action="store_true", help="decompose the systems")
    options = parser.parse_args()
    watch = watched_decomposition if options.decompose else watched
    measured = Measured()
    with watch(measured):
        for file in options.case or files(options.decompose):
            case = read_case(file)
            system = problem_of(case).system
            for seed in range(*map(int, options.seeds.split(":"))):
                if options.decompose:
                    result = decompose(system, seed=seed)
                    found = len(result.components)
                else:
                    result = solving.solve(system, seed=seed)
                    found = len(result.solutions)
                answer = "complete" if result.complete else "not complete"
                print(f"{file.stem} seed {seed}: {found}, {answer}", flush=True)
    print("\n".join(measured.lines()))


def files(decompose: bool) -> list[Path]:
    """The cases that are measured where none are named."""
    if decompose:
        small = [CASES / f"{name}.toml" for name in SMALL]
        return [*sorted((CASES / "literature").glob("*.toml")), *small]
    hard = sorted((CASES / "hard").glob("*.toml"))
    return [*hard, *(CASES / "benchmarks" / f"{name}.toml" for name in BENCHMARKS)]


if __name__ == "__main__":
    main()
