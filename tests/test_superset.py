"""Witness supersets: what is not reduced on the way only, and paths that fail on some slices."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from nag.algebra.expression import parse_polynomial
from nag.algebra.polynomial import Polynomial
from nag.decomposition import hypersurface, superset
from nag.decomposition.fibres import Tracker
from nag.decomposition.slices import random_rows
from nag.tracking.paths import PathStatus


def polynomials(variables: str, *equations: str) -> tuple[Polynomial, ...]:
    return tuple(parse_polynomial(e, tuple(variables.split())) for e in equations)


@pytest.mark.parametrize("seed", range(3))
def test_nothing_is_deflated_where_only_the_first_equations_have_a_double_component(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    def admit(*arguments: object, deflate: bool) -> bool:
        assert not deflate
        return original(*arguments, deflate=deflate)

    original = superset.admit
    monkeypatch.setattr(superset, "admit", admit)
    # The first two have the double line x = y = 0, on which the third is 1.
    equations = polynomials("x y z", "y*z", "x^2 + y", "x*z + y + 1")
    rng = np.random.default_rng(seed)
    found = superset.witness_superset(equations, 3, (), random_rows(rng, 3, 3), rng, Tracker())
    assert found.notes == () and found.counts.failed == 0
    points = np.vstack([fibre.x for fibre in found.fibres[0]])
    points = points[np.argsort(points[:, 0].real)]
    assert np.abs(points - [[-1, -1, 0], [1, -1, 0]]).max() < 1e-12
    assert not any(found.fibres[d] for d in found.fibres if d > 0)


@pytest.mark.parametrize("bad", [1, 3, hypersurface.MOST_FLAGS])
def test_a_path_that_fails_on_some_flags_is_tracked_on_another_or_more_precisely(
    bad: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    precise = []

    def track(*arguments: object, settings: object, **options: object) -> object:
        paths = original(*arguments, settings=settings, **options)
        tracker = Tracker(settings)
        precise.append(tracker.double_double)
        if len(precise) > bad or tracker.double_double:
            return paths
        status = paths.status.copy()
        status[0] = PathStatus.FAILED
        return replace(paths, status=status)

    original = hypersurface.track
    monkeypatch.setattr(hypersurface, "track", track)
    equations = polynomials("x y", "y^2 - x^3 - 2")
    rng = np.random.default_rng(0)
    flag = random_rows(rng, 2, 2)
    found = superset.witness_superset(equations, 2, (), flag, rng, Tracker())
    assert precise == [False] * min(bad + 1, hypersurface.MOST_FLAGS) + [True] * (
        bad == hypersurface.MOST_FLAGS
    )
    assert found.counts.failed == 0 and found.notes == ()
    (fibre,) = found.fibres[1]
    assert len(fibre) == 3
    x, y = fibre.x.T
    assert np.abs(y**2 - x**3 - 2).max() < 1e-12
    on = found.flag[0, 0] + fibre.x @ found.flag[0, 1:]
    assert np.abs(on).max() < 1e-12
