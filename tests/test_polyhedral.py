"""Mixed cells, mixed volumes, and start systems with the target's monomials."""

from __future__ import annotations

from fractions import Fraction
from math import prod
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from evaluated import values
from hypothesis import given, settings
from hypothesis import strategies as st
from systems import benchmark

from nag.errors import StartError
from nag.solving.start.choice import choose
from nag.solving.start.coefficient_monodromy import GenericSystem
from nag.solving.start.mixed_cells import MixedCells, mixed_cells
from nag.solving.start.polyhedral import (
    binomial_solutions,
    by_degeneration,
    cell_weights,
    polyhedral,
)
from nag.solving.start.target import StartSystem, unit

BENCHMARKS = Path(__file__).parent.parent / "cases" / "benchmarks"


@pytest.mark.parametrize(
    ("name", "volume"),
    [
        ("cyclic-5", 70),
        ("cyclic-6", 156),
        ("cyclic-7", 924),
        ("noon-5", 233),
        ("noon-6", 717),
        ("eco-8", 64),
        ("katsura-8", 256),
        ("chandra-8", 128),
    ],
)
def test_mixed_volumes_that_are_known(name: str, volume: int) -> None:
    for seed in range(3):
        assert (
            mixed_cells(benchmark(name).supports, np.random.default_rng(seed)).mixed_volume
            == volume
        )


def lowest(cells: MixedCells, edge: np.ndarray) -> bool:
    """Whether a cell lies on the lower hull, decided exactly."""
    n = len(cells.supports)
    rows = []
    for support, lift, (a, b) in zip(cells.supports, cells.lifts, edge, strict=True):
        row = [Fraction(int(v)) for v in support[b] - support[a]]
        rows.append([*row, Fraction(lift[a]) - Fraction(lift[b])])
    for k in range(n):
        pivot = next(i for i in range(k, n) if rows[i][k])
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [v / rows[k][k] for v in rows[k]]
        for i in range(n):
            if i != k:
                rows[i] = [v - rows[i][k] * w for v, w in zip(rows[i], rows[k], strict=True)]
    normal = [row[-1] for row in rows]
    for support, lift, (a, b) in zip(cells.supports, cells.lifts, edge, strict=True):
        heights = [
            sum((int(e) * x for e, x in zip(point, normal, strict=True)), Fraction(value))
            for point, value in zip(support.tolist(), lift, strict=True)
        ]
        others = [h for c, h in enumerate(heights) if c not in (a, b)]
        if heights[a] != heights[b] or any(h <= heights[a] for h in others):
            return False
    return True


@pytest.mark.parametrize("name", ["cyclic-5", "noon-5", "griewank-osborne", "caprasse"])
def test_every_cell_is_on_the_lower_hull(name: str) -> None:
    cells = mixed_cells(benchmark(name).supports, np.random.default_rng(7))
    assert len({tuple(np.sort(e, axis=1).ravel()) for e in cells.edges}) == len(cells.edges)
    assert all(lowest(cells, edge) for edge in cells.edges)


@settings(max_examples=20)
@given(st.integers(2, 4), st.integers(0, 10**6))
def test_the_volume_does_not_depend_on_the_lifting(n: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    supports = [
        np.unique(np.vstack([np.zeros((1, n), int), rng.integers(0, 4, (4, n))]), axis=0)
        for _ in range(n)
    ]
    volumes = {mixed_cells(supports, np.random.default_rng(k)).mixed_volume for k in range(3)}
    assert len(volumes) == 1
    assert volumes.pop() <= prod(int(s.sum(axis=1).max()) for s in supports)


def test_cells_that_are_lost_are_seen_by_the_volumes() -> None:
    # Whole lifting values of few digits let points enter at the same time.
    supports, right, refused = benchmark("katsura-8").supports, 0, 0
    for seed in range(60):
        rng = np.random.default_rng(seed)
        lifts = [rng.integers(0, 100, len(s)).astype(float) for s in supports]
        try:
            right += mixed_cells(supports, rng, lifts).mixed_volume == 256
        except StartError as error:
            refused += "lost to rounding" in str(error)
    assert right + refused == 60
    assert right > 0
    assert refused > 0


@given(st.lists(st.integers(1, 5), min_size=1, max_size=5))
@settings(max_examples=20)
def test_the_volume_of_multiples_of_a_simplex_is_bezouts_number(degrees: list[int]) -> None:
    n = len(degrees)
    simplex = np.vstack([np.zeros((1, n), int), np.eye(n, dtype=int)])
    cells = mixed_cells([d * simplex for d in degrees], np.random.default_rng(0))
    assert cells.mixed_volume == prod(degrees)


def start_system(name: str, seed: int) -> StartSystem:
    each, rng = benchmark(name), np.random.default_rng(seed)
    return polyhedral(each, mixed_cells(each.supports, rng), rng, 1)


@pytest.mark.parametrize(("name", "volume"), [("cyclic-5", 70), ("cyclic-6", 156), ("eco-8", 64)])
def test_the_start_system_has_as_many_regular_solutions_as_the_volume(
    name: str, volume: int
) -> None:
    start = start_system(name, 0)
    points = start.homotopy.normalized(start.points)
    assert len(points) == volume
    assert np.abs(values(start.homotopy, points, 1.0)).max() < 1e-12
    overlap = np.abs(points @ points.conj().T) ** 2 - np.eye(volume)
    assert overlap.max() < 1 - 1e-10


@pytest.mark.parametrize("name", ["cyclic-5", "noon-5", "caprasse", "eco-8"])
def test_binomials_have_as_many_solutions_as_the_volume_of_their_cell(name: str) -> None:
    rng = np.random.default_rng(3)
    cells = mixed_cells(benchmark(name).supports, rng)
    coefficients = [unit(rng, len(s)) for s in cells.supports]
    angles, owners = binomial_solutions(cells, coefficients)
    assert np.array_equal(np.bincount(owners), cells.volumes)
    x = np.exp(1j * angles)
    for i, (support, c) in enumerate(zip(cells.supports, coefficients, strict=True)):
        a, b = cells.edges[owners, i].T
        sides = [c[k] * np.prod(x ** support[k], axis=1) for k in (a, b)]
        assert np.abs(sides[0] + sides[1]).max() < 1e-10
    for k in range(len(cells.edges)):
        own = x[owners == k]
        apart = np.abs(own[:, None] - own[None]).max(axis=2) + np.eye(len(own))
        assert apart.min() > 1e-3


def test_only_the_edges_of_a_cell_keep_their_terms_in_the_degeneration() -> None:
    cells = mixed_cells(benchmark("cyclic-6").supports, np.random.default_rng(1))
    weights = cell_weights(cells)
    first = np.cumsum([0] + [len(s) for s in cells.supports])[:-1]
    on = np.zeros(weights.shape, dtype=bool)
    for k, edges in enumerate(cells.edges):
        on[k, (first[:, None] + edges).ravel()] = True
    assert np.array_equal(weights == 0, on)
    assert np.allclose(np.where(on, np.inf, weights).min(axis=1), 1)


def test_paths_lost_in_the_degeneration_are_found_by_monodromy(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def half(*arguments: Any) -> tuple[GenericSystem, int]:
        system, spent = by_degeneration(*arguments)
        return system.holding(system.points[::2], system.errors[::2]), spent

    monkeypatch.setattr("nag.solving.start.polyhedral.by_degeneration", half)
    start = start_system("cyclic-5", 0)
    assert len(start.points) == 70
    assert "35 of them by monodromy" in start.detail


def test_solutions_that_stay_lost_are_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    def half(*arguments: Any) -> tuple[GenericSystem, int]:
        system, spent = by_degeneration(*arguments)
        return system.holding(system.points[::2], system.errors[::2]), spent

    def nothing(system: GenericSystem, *_: Any) -> tuple[GenericSystem, int, bool]:
        return system, 0, False

    monkeypatch.setattr("nag.solving.start.polyhedral.by_degeneration", half)
    monkeypatch.setattr("nag.solving.start.polyhedral.find_by_loops", nothing)
    with pytest.raises(StartError, match="35 of the 70 solutions"):
        start_system("cyclic-5", 0)


def test_systems_without_generic_solutions_have_volume_zero() -> None:
    supports = [np.array([[0, 0], [1, 0]]), np.array([[0, 0], [2, 0]])]
    assert mixed_cells(supports, np.random.default_rng(0)).mixed_volume == 0


def test_a_bound_for_all_zeros_needs_constant_terms() -> None:
    rng = np.random.default_rng(1)
    noon = benchmark("noon-5")
    assert choose(noon, "auto", (), rng, 1)[0].known.most == 233
    assert choose(benchmark("katsura-8"), "auto", (), rng, 1)[0].known.most is None
