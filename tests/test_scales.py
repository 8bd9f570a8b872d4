"""Systems far from unit scale, and nearly degenerate ones: right, or honestly undecided."""

from __future__ import annotations

from collections import Counter

import pytest

from nag.algebra.expression import parse_polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition import decompose
from nag.decomposition.witness import Decomposition

CONIC, LINE, POINT = (1, 2, 1), (1, 1, 1), (0, 1, 1)


def decomposed(variables: str, equations: list[str], seed: int) -> Decomposition:
    names = tuple(variables.split())
    system = PolynomialSystem(names, tuple(parse_polynomial(e, names) for e in equations))
    return decompose(system, seed=seed)


def kinds(answer: Decomposition) -> Counter[tuple[int, int, int]]:
    return Counter((c.dimension, c.degree, c.multiplicity) for c in answer.components)


@pytest.mark.parametrize(
    ("variables", "equations", "expected"),
    [
        ("x y", ["(x-10)*(x-20)*(x-30)", "(y-100)*(y-200)*(y-300)"], {POINT: 9}),
        ("x y", ["x^2 + y^2 - 10^12", "x - y"], {POINT: 2}),
        ("x y", ["x*y - 10^8"], {CONIC: 1}),
        ("x y", ["x*y - 10^20"], {CONIC: 1}),
        ("x y", ["x*y - 1/10^12"], {CONIC: 1}),
        ("x y", ["x^2 - y^2 - 1/10^8"], {CONIC: 1}),
        ("x y", ["x^2 + 10^12*y^2 - 1"], {CONIC: 1}),
        ("x y", ["x^2 - 1/10^20", "y^2 - 1"], {POINT: 4}),
        ("x y", ["(x - 100)^2 + (y - 100)^2 - 1"], {CONIC: 1}),
        ("x y z", ["(x - 100)^2 + (y - 100)^2 - 1", "(x - 100)*z"], {CONIC: 1, LINE: 2}),
        ("x y z", ["x*y - z/10^20", "x*z"], {LINE: 1, (1, 1, 2): 1}),
    ],
)
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_scale_does_not_change_the_answer(
    variables: str, equations: list[str], expected: dict[tuple[int, int, int], int], seed: int
) -> None:
    answer = decomposed(variables, equations, seed)
    assert answer.complete
    assert kinds(answer) == Counter(expected)


@pytest.mark.parametrize(
    ("variables", "equations", "true"),
    [
        ("x", ["(x - 1)*(x - 1 - 1/10^3)"], {POINT: 2}),
        ("x", ["(x - 1)*(x - 1 - 1/10^5)"], {POINT: 2}),
        ("x", ["(x - 1)*(x - 1 - 1/10^12)"], {POINT: 2}),
        ("x y", ["(x + y - 1)*(x + y - 1 - 1/10^5)"], {LINE: 2}),
        ("x y", ["(x + y)*(x + (1 + 1/10^5)*y)"], {LINE: 2}),
        ("x y", ["(x + y)*(x + (1 + 1/10^9)*y)"], {LINE: 2}),
    ],
)
@pytest.mark.parametrize("seed", [0, 1, 2, 3])
def test_zeros_too_close_for_doubles_are_never_called_one(
    variables: str, equations: list[str], true: dict[tuple[int, int, int], int], seed: int
) -> None:
    answer = decomposed(variables, equations, seed)
    assert not answer.complete or kinds(answer) == Counter(true)
