"""Start systems by monodromy, and the trace test that proves them complete."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from evaluated import values
from systems import benchmark, system

from nag.errors import StartError
from nag.solving.start import monodromy as module
from nag.solving.start.coefficient_monodromy import GenericSystem, find_by_loops
from nag.solving.start.mixed_cells import mixed_cells
from nag.solving.start.monodromy import (
    Pencil,
    irreducible_row,
    monodromy,
    seed_pencil,
    trace_is_linear,
)
from nag.solving.start.target import Target

BENCHMARKS = Path(__file__).parent.parent / "cases" / "benchmarks"


def enlarged(each: Target, row: int) -> list[np.ndarray]:
    """The supports, one of them enlarged by a simplex."""
    supports = list(each.supports)
    moves = np.vstack([np.zeros((1, each.n), dtype=np.int64), np.eye(each.n, dtype=np.int64)])
    supports[row] = np.unique(np.concatenate([supports[row] + m for m in moves]), axis=0)
    return supports


def all_points(name: str, seed: int) -> tuple[Pencil, GenericSystem]:
    each, rng = benchmark(name), np.random.default_rng(seed)
    row = irreducible_row(each.supports, rng)
    assert row is not None
    pencil, system = seed_pencil(each.supports, row, rng)
    volume = mixed_cells(enlarged(each, row), rng).mixed_volume
    system, _, _ = find_by_loops(system, volume, rng, 1)
    assert len(system.points) == volume
    return pencil, system


@pytest.mark.parametrize("name", ["caprasse", "griewank-osborne", "planar-3-rpr", "katsura-6"])
def test_the_search_ends_with_all_solutions_by_the_trace_alone(name: str) -> None:
    each, rng = benchmark(name), np.random.default_rng(2)
    start = monodromy(each, rng, 1)
    row = irreducible_row(each.supports, rng)
    assert row is not None
    assert len(start.points) == mixed_cells(enlarged(each, row), rng).mixed_volume
    points = start.homotopy.normalized(start.points)
    assert np.abs(values(start.homotopy, points, 1.0)).max() < 1e-12
    assert "trace" in start.detail


@pytest.mark.parametrize("name", ["caprasse", "griewank-osborne", "planar-3-rpr"])
def test_the_trace_of_all_is_linear_and_that_of_fewer_is_not(name: str) -> None:
    pencil, system = all_points(name, 1)
    assert trace_is_linear(pencil, system.points, np.random.default_rng(5), 1)
    count = len(system.points)
    for k in range(0, count, max(1, count // 20)):
        fewer = np.delete(system.points, k, axis=0)
        assert not trace_is_linear(pencil, fewer, np.random.default_rng(5), 1)
    assert not trace_is_linear(pencil, system.points[::2], np.random.default_rng(5), 1)


def test_what_rounding_hides_is_seen_in_more_digits(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "ROUNDING", 1.0)
    monkeypatch.setattr(module, "CLEAR", np.inf)
    pencil, system = all_points("planar-3-rpr", 1)
    assert trace_is_linear(pencil, system.points, np.random.default_rng(5), 1)
    for k in range(len(system.points)):
        fewer = np.delete(system.points, k, axis=0)
        assert not trace_is_linear(pencil, fewer, np.random.default_rng(5), 1)


@pytest.mark.parametrize("seed", [2, 24])
def test_points_of_very_different_motions_need_no_other_pencil(seed: int) -> None:
    start = monodromy(benchmark("eco-8"), np.random.default_rng(seed), 1)
    assert len(start.points) == 160


def rows(*terms: dict[tuple[int, ...], int]) -> Target:
    exact = tuple({e: Fraction(c) for e, c in row.items()} for row in terms)
    return Target(len(terms), exact)


def test_without_an_irreducible_curve_the_mixed_volume_says_how_many() -> None:
    each = rows({(3, 0): 1, (0, 0): -2}, {(0, 2): 1, (0, 1): 1, (0, 0): 3})
    rng = np.random.default_rng(0)
    assert irreducible_row(each.supports, rng) is None
    start = monodromy(each, rng, 1)
    assert len(start.points) == 6
    assert "mixed volume" in start.detail
    # All of its equations but one are forms, and forms of four degrees define lines.
    cyclic = benchmark("cyclic-5")
    assert irreducible_row(cyclic.supports, rng) is None
    assert len(monodromy(cyclic, rng, 1).points) == 70


def test_a_curve_that_falls_apart_for_one_degree_in_all_terms_is_not_irreducible() -> None:
    # In x y z = 1 no coordinate vanishes, so that the supports are without the origin: a form in x
    # and y is a product of linear ones.
    given = system("x y z", "x*y*z - 1", "x^2 + y^2", "x + 2*y + 3*z - 1")
    each = Target.of(given.polynomials, 3)
    assert each.in_torus
    assert irreducible_row(each.supports, np.random.default_rng(0)) is None
    for seed in range(12):
        assert len(monodromy(each, np.random.default_rng(seed), 1).points) == 6


def test_a_system_without_generic_solutions_has_no_paths() -> None:
    each = rows({(2, 0): 1, (0, 0): -2}, {(3, 0): 1, (0, 0): 3})
    assert len(monodromy(each, np.random.default_rng(0), 1).points) == 0


def test_one_polynomial_in_one_variable() -> None:
    each = rows({(4,): 1, (1,): 1, (0,): -2})
    assert len(monodromy(each, np.random.default_rng(0), 1).points) == 5


def test_what_no_trace_proves_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "trace_is_linear", lambda *_, **__: False)
    with pytest.raises(StartError, match="5 solutions were found, but no trace proves"):
        monodromy(benchmark("griewank-osborne"), np.random.default_rng(0), 1)
