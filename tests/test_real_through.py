"""Whether a component has real points of its own dimension next to a real point."""

import numpy as np
import pytest

import nag
from nag.real.real_through import is_real_through


def answers(equation: str, seed: int = 0) -> list[bool | None]:
    found = nag.decompose(equation, seed=seed)
    origin = np.zeros(found.system.n)
    run = nag.Run(seed=seed)
    return [is_real_through(found.system, c, origin, 1e-15, run) for c in found.components]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    ("equation", "expected"),
    [
        ("y^2 - x^3", [True]),
        ("y^2 - x^2*(x + 1)", [True]),
        ("x^2 + y^2 - z^2", [True]),
        ("z*(x^2 + y^2 + z^2) - x^4", [True]),
    ],
)
def test_real_branches_are_seen(equation: str, expected: list[bool], seed: int) -> None:
    assert answers(equation, seed) == expected


@pytest.mark.parametrize("seed", range(3))
def test_what_is_not_its_own_conjugate_is_not_real(seed: int) -> None:
    assert sorted(map(str, answers("x^3 - y^3", seed))) == ["False", "False", "True"]


@pytest.mark.parametrize("equation", ["x^2 + y^2 + z^2", "y^2 - x^2*(x - 1)"])
def test_an_isolated_real_point_is_not_called_a_real_branch(equation: str) -> None:
    assert answers(equation) == [None]
