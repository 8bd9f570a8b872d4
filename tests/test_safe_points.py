"""Paths whose errors grow on the way to a singular end go on from where Newton converges."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from nag.bench.atlas.moved import moved_case
from nag.decomposition.decompose import decompose
from nag.decomposition.reduction import Reduction
from nag.decomposition.superset import intersection_order, witness_superset
from nag.files.cases import read_case
from nag.tracking.run import Run
from nag.tracking.settings import Settings
from nag.witness.fibres import whole_space
from nag.witness.slices import random_rows

SPATIAL = Path(__file__).parent.parent / "cases" / "spatial"


@pytest.mark.parametrize("seed", [0, 3])
def test_ends_that_ask_for_more_digits_are_reached_at_the_first_attempt(seed: int) -> None:
    reduction = Reduction.of(read_case(SPATIAL / "spherical-pair-6r.toml").system)
    reduced, rng = reduction.reduced, np.random.default_rng(seed)
    equations = [reduced.polynomials[i] for i in intersection_order(reduced.polynomials)]
    flag = random_rows(rng, reduced.n, reduced.n, 0.3)
    space = {reduced.n: [whole_space(flag)]}
    found = witness_superset(equations, space, rng, Run(), nonzero=reduced.nonzero)
    assert found.counts.failed == 0
    assert found.notes == ()
    assert {d: sum(map(len, f)) for d, f in found.fibres.items() if f} == {1: 16}


@pytest.mark.parametrize("seed", [6, 11])
def test_ends_that_64_digits_lose_are_found_in_120(seed: int, monkeypatch) -> None:
    monkeypatch.chdir(SPATIAL.parent.parent)
    name = "literature/sphere-curve-lines-point"
    system = moved_case(name, np.random.default_rng([seed, 20])).system
    assert not decompose(system, settings=Settings(digits=64), seed=seed).complete
    assert decompose(system, seed=seed).complete
