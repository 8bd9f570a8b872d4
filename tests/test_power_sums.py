"""Components of curves from power sums over their points, at the points as they are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from cuts import fibre

from nag.decomposition import trace
from nag.decomposition.power_sums import PowerSums
from nag.decomposition.splitting import LOST, split_points
from nag.decomposition.trace import EVIDENCE
from nag.tracking.run import Run
from nag.witness.fibres import SliceEnds
from nag.witness.points import Points
from nag.witness.slices import random_rows

CURVES = ("x + 3*y - 1", "x^2 + y^2 - 4", "x^5 - x*y^4 + y^2 - 3*x - 1", "x^7 - 2*y^7 + x*y - 5")


def points_of(curves: tuple[str, ...], rng: np.random.Generator) -> tuple[Points, list[list[int]]]:
    """Points of plane curves on a random line, and the indices of those of each curve."""
    rows = random_rows(rng, 1, 2)
    fibres = [fibre("*".join(f"({c})" for c in curves), rows[0])]
    points = Points.of(fibres)
    each = [Points.of([fibre(c, rows[0])]).x for c in curves]
    gaps = np.array([np.linalg.norm(points.x[:, None] - x, axis=2).min(axis=1) for x in each])
    owner = gaps.argmin(axis=0)
    return points, sorted(np.flatnonzero(owner == k).tolist() for k in range(len(curves)))


def singles(points: Points) -> list[np.ndarray]:
    return [np.array([i]) for i in range(len(points))]


@pytest.mark.parametrize("seed", range(4))
def test_components_are_the_sets_whose_power_sums_are_polynomials(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points, curves = points_of(CURVES, rng)
    sums = PowerSums.of(points, len(points), rng)
    assert sums.smallest_unions(singles(points)) == curves
    halves = sorted(half for own in curves for half in (own[::2], own[1::2]) if half)
    unions = sums.smallest_unions([np.array(half) for half in halves])
    assert unions is not None
    assert sorted(sorted(i for k in own for i in halves[k]) for own in unions) == curves


@pytest.mark.parametrize("seed", range(4))
def test_points_of_components_that_are_not_whole_are_in_no_set(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points, curves = points_of(CURVES, rng)
    kept = np.setdiff1d(np.arange(len(points)), [curves[1][0]])
    less = points.only(kept)
    found = PowerSums.of(less, len(less), rng).smallest_unions(singles(less))
    whole = sorted(own for k, own in enumerate(curves) if k != 1)
    assert found is not None and sorted(kept[own].tolist() for own in found) == whole


@pytest.mark.parametrize("seed", range(6))
def test_errors_of_equations_are_what_indicators_leave(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points, curves = points_of(CURVES, rng)
    sums = PowerSums.of(points, len(points), rng)
    for own in curves:
        error = sums.errors[own].sum()
        assert np.linalg.norm(sums.coefficients[:, own].sum(axis=1)) < 10 * error
        for k in range(len(own) if len(own) > 1 else 0):
            part = np.delete(own, k)
            assert np.linalg.norm(sums.coefficients[:, part].sum(axis=1)) > 100 * error


def test_points_that_are_close_together_are_left_to_more_digits() -> None:
    rng = np.random.default_rng(1)
    points, _ = points_of(("x^3 - y - 2", "x^3 - y - 2 - 1/10^13"), rng)
    assert PowerSums.of(points, 6, rng).smallest_unions(singles(points)) is None


@pytest.mark.parametrize("seed", range(3))
def test_a_path_that_was_lost_in_the_trace_joins_nothing(
    monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    points, curves = points_of(CURVES, rng)
    move = trace.move

    def swapping(*arguments, **options) -> list[SliceEnds]:
        (there,) = move(*arguments, **options)
        places = np.arange(len(there.points))
        swapped = [2 * curves[k][0] for k in (1, 2)]
        places[swapped] = swapped[::-1]
        return [replace(there, points=there.points[places])]

    monkeypatch.setattr(trace, "move", swapping)
    found = split_points(points, EVIDENCE, rng, Run())
    reasons = {tuple(c.indices.tolist()): c.reason for c in found.classes}
    assert all(set(own) in map(set, curves) for own in reasons if not reasons[own])
    assert {reason for reason in reasons.values() if reason} == {LOST}
