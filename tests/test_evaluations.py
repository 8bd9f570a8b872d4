"""Evaluations of a system are counted where someone asks, and nowhere else."""

from __future__ import annotations

from pathlib import Path

from nag.files.cases import read_case
from nag.solving.solve import solve
from nag.tracking.evaluations import count, count_evaluations
from nag.tracking.settings import NAMED

CASES = Path(__file__).parents[1] / "cases"


def test_steps_in_doubles_take_two_values_and_as_many_series_as_the_order() -> None:
    system = read_case(CASES / "benchmarks" / "katsura-6.toml").system
    with count_evaluations() as found:
        result = solve(system)
    # No path needs more digits. Sharpening takes three steps, and one value beside each point.
    steps = result.paths.steps * (2 + NAMED["default"].order)
    assert result.paths.regular == 64
    assert found.number == steps + 4 * 64


def test_work_in_more_digits_counts_and_the_number_of_threads_does_not() -> None:
    system = read_case(CASES / "hard" / "chemequ.toml").system
    numbers = []
    for threads in (1, 2):
        with count_evaluations() as found:
            result = solve(system, threads=threads)
        numbers.append(found.number)
    assert numbers[0] == numbers[1]
    with count_evaluations() as doubles:
        short = solve(system, settings="fast")
    assert doubles.number != numbers[0]
    assert numbers[0] > result.paths.steps
    assert len(short.solutions) == len(result.solutions)


def test_nobody_counts_outside_the_block() -> None:
    with count_evaluations() as found:
        count(3)
    count(4)
    assert found.number == 3
