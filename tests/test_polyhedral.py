"""Mixed cells, mixed volumes, and start systems with the target's monomials."""

from __future__ import annotations

from fractions import Fraction
from math import prod
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nag.cases import read_case
from nag.tracking.start.mixed_cells import MixedCells, mixed_cells
from nag.tracking.start.polyhedral import mixed_volume, polyhedral
from nag.tracking.start.target import StartError, Target

BENCHMARKS = Path(__file__).parent.parent / "cases" / "benchmarks"


def target(name: str) -> Target:
    system = read_case(BENCHMARKS / f"{name}.toml").system
    return Target.of(system.polynomials, system.n)


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
        assert mixed_volume(target(name), np.random.default_rng(seed)) == volume


def lowest(cells: MixedCells, edge: np.ndarray) -> bool:
    """Whether a cell lies on the lower hull, decided exactly."""
    n = len(cells.supports)
    rows = []
    for support, lift, (a, b) in zip(cells.supports, cells.lifts, edge, strict=True):
        row = [Fraction(int(v)) for v in support[b] - support[a]]
        rows.append([*row, Fraction(int(lift[a] - lift[b]))])
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
            sum((int(e) * x for e, x in zip(point, normal, strict=True)), Fraction(int(value)))
            for point, value in zip(support.tolist(), lift, strict=True)
        ]
        others = [h for c, h in enumerate(heights) if c not in (a, b)]
        if heights[a] != heights[b] or any(h <= heights[a] for h in others):
            return False
    return True


@pytest.mark.parametrize("name", ["cyclic-5", "noon-5", "griewank-osborne", "caprasse"])
def test_every_cell_is_on_the_lower_hull(name: str) -> None:
    cells = mixed_cells(target(name).supports, np.random.default_rng(7))
    assert len({tuple(np.sort(e, axis=1).ravel()) for e in cells.edges}) == len(cells.edges)
    assert all(lowest(cells, edge) for edge in cells.edges)


@settings(deadline=None, max_examples=30)
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


@given(st.lists(st.integers(1, 5), min_size=1, max_size=5))
@settings(deadline=None, max_examples=30)
def test_the_volume_of_multiples_of_a_simplex_is_bezouts_number(degrees: list[int]) -> None:
    n = len(degrees)
    simplex = np.vstack([np.zeros((1, n), int), np.eye(n, dtype=int)])
    cells = mixed_cells([d * simplex for d in degrees], np.random.default_rng(0))
    assert cells.mixed_volume == prod(degrees)


def test_the_start_system_has_as_many_regular_solutions_as_the_volume() -> None:
    each = target("cyclic-5")
    start = polyhedral(each, 70, np.random.default_rng(0), "default", 1)
    points = start.homotopy.normalized(start.points)
    assert len(points) == 70
    assert np.abs(start.homotopy.values(points, 1.0)).max() < 1e-12
    overlap = np.abs(points @ points.conj().T) ** 2 - np.eye(70)
    assert overlap.max() < 1 - 1e-10


def test_a_wrong_volume_is_noticed() -> None:
    each = target("griewank-osborne")
    with pytest.raises(StartError, match="3 of the 4 solutions"):
        polyhedral(each, 4, np.random.default_rng(0), "default", 1)


def test_systems_without_generic_solutions_have_volume_zero() -> None:
    supports = [np.array([[0, 0], [1, 0]]), np.array([[0, 0], [2, 0]])]
    assert mixed_cells(supports, np.random.default_rng(0)).mixed_volume == 0
