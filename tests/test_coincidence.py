"""Points that coincide are found among those nearby, all of them, in any order."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import nag
from nag.algebra.symmetry import SignedPermutation
from nag.numerics import coincidence
from nag.numerics.coincidence import (
    SortedPoints,
    coincident,
    neighbours,
    point_orbit,
    radii_of_balls,
)
from nag.numerics.singular_point import Place
from nag.solving import path_ends
from nag.solving.square_problem import SquareProblem


def points_in_clusters(rng: np.random.Generator, count: int) -> np.ndarray:
    """Points, many of them close to others or to the conjugates of others."""
    centres = rng.standard_normal((count // 8, 4)) + 1j * rng.standard_normal((count // 8, 4))
    chosen = centres[rng.integers(len(centres), size=count)]
    chosen = np.where(rng.random((count, 1)) < 0.5, chosen, chosen.conj())
    return chosen + 10.0 ** rng.uniform(-13, -2, (count, 1)) * rng.standard_normal((count, 4))


@pytest.mark.parametrize("seed", range(5))
def test_sorted_points_find_all_that_coincide(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = points_in_clusters(rng, 200)
    every = SortedPoints.of(points)
    for x in (*points[:50], *points[:50].conj(), np.zeros(4)):
        error = 10.0 ** rng.uniform(-12, -1)
        expected = np.flatnonzero(coincident(points, x, error))
        assert np.array_equal(every.coincident(x, error), expected)
        radius = float(radii_of_balls(x[None], error)[0])
        assert set(expected) <= set(every.near(x, radius))


@pytest.mark.parametrize("widest", [1e-6, 1e-1, 10.0, np.inf])
def test_neighbours_are_all_pairs_within_a_width_nearest_places_first(widest: float) -> None:
    rng = np.random.default_rng(1)
    key = rng.standard_normal(60).round(2)
    width = 10.0 ** rng.uniform(-3, -1, 60)
    width[17] = widest
    order = np.argsort(key, kind="stable")
    expected = [
        (order[a], order[a + apart])
        for apart in range(1, 60)
        for a in range(60 - apart)
        if key[order[a + apart]] - key[order[a]] <= max(width[order[[a, a + apart]]])
    ]
    pairs = [pair for i, j in neighbours(key, width) for pair in zip(i, j, strict=True)]
    assert pairs == expected


def test_a_singular_end_is_compared_with_few_others_however_many_there_are(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    compared = 0

    def count(points: np.ndarray, x: np.ndarray, error: float) -> np.ndarray:
        nonlocal compared
        compared += len(points)
        return coincident(points, x, error)

    class Problem:
        added = 0

    class Judgements:
        def __init__(self) -> None:
            self.asked: list[list[int]] = []

        def judge_in_blocks(self, chosen: list[int]) -> None:
            self.asked.append(list(chosen))

        def judge(self, i: int) -> Judgements:
            return self

        place = Place.ISOLATED

    monkeypatch.setattr(coincidence, "coincident", count)
    half = 1500
    points = np.random.default_rng(2).standard_normal((half, 6, 2)) @ [1, 1j]
    ends = path_ends._Zeros(
        np.arange(2 * half),
        np.concatenate([points, points.conj()]),
        np.full(2 * half, 1e-9),
        np.zeros(2 * half),
        np.zeros(2 * half, dtype=bool),
    )
    judgements = Judgements()
    groups = list(np.arange(2 * half)[:, None])
    path_ends._judge_in_blocks(Problem(), ends, judgements, groups)
    assert judgements.asked == [list(range(half)), list(range(half, 2 * half))]
    assert compared < 10 * half


@given(st.permutations(range(4)), st.lists(st.sampled_from([1, -1]), min_size=4, max_size=4))
def test_an_orbit_is_carried_into_itself_and_no_point_is_in_it_twice(sources, signs) -> None:
    g = SignedPermutation(tuple(sources), tuple(signs))
    x = np.array([1 + 2j, -3, 0.5j, 7 - 1j])
    images = point_orbit(x, [g.of_point])
    assert (images[0] == x).all()
    known = {tuple(z) for z in images.tolist()}
    assert len(known) == len(images)
    assert {tuple(z) for z in images.conj().tolist()} == known
    assert {tuple(z) for z in g.of_point(images).tolist()} == known


def test_what_symmetries_carry_to_a_judged_end_on_a_set_is_not_judged_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    judged = 0

    def count(*ends: Any) -> Any:
        nonlocal judged
        judged += 1
        return judge(*ends)

    judge = path_ends._judge_end
    monkeypatch.setattr(path_ends, "_judge_end", count)
    # Turning x, y, z keeps each equation; the set is the three axes and other curves.
    equations = [
        "x^2*y^2 + y^2*z^2 + z^2*x^2",
        "x^2*y + y^2*z + z^2*x",
        "x*y^2 + y*z^2 + z*x^2",
    ]
    with_maps, here = nag.solve(equations, start="total"), judged
    monkeypatch.setattr(SquareProblem, "symmetry_maps", ())
    judged = 0
    without = nag.solve(equations, start="total")
    assert 0 < here < judged
    assert with_maps.complete and without.complete
    assert len(with_maps) == len(without) == 0
    assert len(with_maps.on_components) == len(without.on_components) > 0
