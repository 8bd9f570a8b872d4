"""Unions of prescribed components are taken apart into just these, whatever they are."""

from __future__ import annotations

import numpy as np
import pytest
from unions import found, random_union

from nag.decomposition.decompose import decompose
from nag.witness.witness import Status


@pytest.mark.parametrize("seed", range(50))
def test_a_union_is_taken_apart_into_its_components(seed: int) -> None:
    union = random_union(seed)
    answer = decompose(union.system, seed=seed)
    assert found(answer) == union.truth
    assert answer.complete
    assert all(c.status is Status.IRREDUCIBLE for c in answer.components)


@pytest.mark.parametrize("seed", range(50))
def test_prescribed_components_satisfy_the_equations_exactly(seed: int) -> None:
    union = random_union(seed)
    rng = np.random.default_rng(seed)
    for component in union.components:
        assert not any(union.system(component.point(rng)))
