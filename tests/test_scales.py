"""Systems far from unit scale, and nearly degenerate ones: right, or honestly undecided."""

from __future__ import annotations

from collections import Counter

import pytest
from systems import kinds, system

from nag.algebra.symmetry import SignedPermutation
from nag.decomposition.decompose import decompose
from nag.solving.solve import solve
from nag.witness.witness import Decomposition

CONIC, LINE, POINT = (1, 2, 1), (1, 1, 1), (0, 1, 1)


def decomposed(variables: str, equations: list[str], seed: int) -> Decomposition:
    return decompose(system(variables, *equations), seed=seed)


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
    ("equations", "images", "expected"),
    [
        (["x^2 + y^2 - 10^12", "x - y"], {"x": "-x", "y": "-y"}, {(0, 1, 2): 1}),
        (["x^2 + y^2 + z^2 - 10^12", "x*y - 10^6*z"], {"x": "-x", "y": "-y"}, {(1, 4, 1): 1}),
        (["x*y - 10^10", "z^3 + x + y - 10^9"], {"x": "y", "y": "x"}, {(1, 6, 1): 1}),
        (["x^2 + y^2 - 10^12", "z^2 - x*y/10^12 - 1"], {"x": "y", "y": "x"}, {(1, 4, 1): 1}),
    ],
)
@pytest.mark.parametrize("seed", [0, 1])
def test_scale_does_not_change_what_symmetries_carry_into_each_other(
    equations: list[str],
    images: dict[str, str],
    expected: dict[tuple[int, int, int], int],
    seed: int,
) -> None:
    of = system("x y z" if "z" in equations[-1] else "x y", *equations)
    symmetry = SignedPermutation.of_map(images, of.variables)
    answer = decompose(of, seed=seed, symmetries=[symmetry])
    assert answer.complete
    assert Counter((c.dimension, c.degree, c.orbit) for c in answer.components) == expected


UNEVEN = [
    (
        # Two zeros are 2e-16 apart, in the smallest of three small coordinates.
        [
            "-9/10*x^3 + y^2*z/2000 + 47/500*x*y + 6600000*x - 9/10000",
            "-6000*x^3*y - 7/100*x^3*z + x^2*z^2/5 - x*y^2*z/400 - 18000*x*z^2",
            "9/10000*x^2 + 57/100000*y*z + 80*x + 12000*y",
        ],
        15,
    ),
    (
        # One zero is of size 1e31, 1e5 and 1e19.
        [
            "-3/20000*x^2*y^2 + 800000*x*y^2*z - 50*x^2*y - 45000*x*y^2 - 9/1000*x*y*z + 760*x*y "
            "+ 850000",
            "-1800000*x^2*y*z^2 + 6000*x*y^4 - 20/9*x*y^2*z^2 + 11/20*x^3*z - 30000*x + 1/50000",
            "7*x*y^2*z + 40000*z^3",
        ],
        33,
    ),
]


@pytest.mark.parametrize(("equations", "count"), UNEVEN)
def test_simple_solutions_with_uneven_coordinates_stay_simple(
    equations: list[str], count: int
) -> None:
    found = solve(system("x y z", *equations))
    assert found.complete
    assert Counter(s.multiplicity for s in found.solutions) == Counter({1: count})


@pytest.mark.parametrize(
    ("equations", "count"),
    [
        (
            [
                "7600*x^2 + 2/5*y^2 - 3/10*z^2 + 61/10",
                "17*x^2*z + 30*x^2 + 40*x*y - 750*y^2 - 610*z^2 + 70",
                "7/10*x^2*y^2 - 500*x*y^2*z + 20*y*z^3 + 42*x^3 + 400*y^2*z - 14/5",
            ],
            24,
        ),
        (
            [
                "-9*x^2 + x*z/2500 + y/5000",
                "30*x*y - 7/100*y*z - 3/25*z - 39/100",
                "-57000*x^4 - 3/5*y^4 + 8*x^2*z - 7/100*x^2 - 7000*x*z - 31",
            ],
            12,
        ),
        (
            # A zero of one branch, x = 5e-24, is next to one of the branch x = 0.
            [
                "-900*x^2*y^2*z + 60*x*y*z^3",
                "-90*x^2*y*z^2 + 4*x*y^4 - 9/100*y^4*z - 11/20*x*z - 2*y*z + 80",
                "-35*x*z^2 + y^2*z/10 + 100*z^3 - 25/2*x*z - 7/100*y + 90",
            ],
            36,
        ),
        (
            # Five pairs differ in a coordinate of 1e-6 only, beside one of 4e6.
            [
                "-10*x^3 - 7/10*x^2*z - y*z/7000 + 67/10*y - 1300000",
                "-y^4*z/12 - 61/10000*x^4 - y^2*z^2/75 + 71/10*y^3 - 37/100",
                "4100000*x^3 - 2/15*x^2 + 3/10*z - 3/50000",
            ],
            23,
        ),
    ],
)
def test_points_with_uneven_coordinates_are_confirmed_as_simple(
    equations: list[str], count: int
) -> None:
    answer = decomposed("x y z", equations, 0)
    assert answer.complete
    assert kinds(answer) == Counter({POINT: count})


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
def test_zeros_close_to_each_other_are_told_apart(
    variables: str, equations: list[str], true: dict[tuple[int, int, int], int], seed: int
) -> None:
    answer = decomposed(variables, equations, seed)
    assert answer.complete and kinds(answer) == Counter(true)


@pytest.mark.parametrize(
    ("variables", "equations", "held"),
    [
        ("x y", ["1e300*x^2 + 1e-300*y - 1", "x*y - 1e200"], 0),
        ("x y", ["(1e300*x^2 + 1e-300*y - 1)*(x - 1)", "x*y - 1e200"], 1),
        ("x", ["1e-200*x - 1e200"], 0),
    ],
)
def test_points_beyond_the_range_of_doubles_are_told_and_not_listed(
    variables: str, equations: list[str], held: int
) -> None:
    given = system(variables, *equations)
    solved, components = solve(given), decompose(given)
    assert len(solved.solutions) == len(components.components) == held
    assert not solved.complete and not components.complete
    for answer, what in ((solved, "solutions"), (components, "components")):
        (note,) = answer.notes
        assert note.startswith(f"there are {what} with coordinates beyond the range of doubles")
