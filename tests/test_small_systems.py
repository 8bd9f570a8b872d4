"""Small systems that were answered wrongly once, or only after very long, and what is true of them.

The truth is that of `exact_counts`.
"""

from __future__ import annotations

import pytest
from random_small import small_system
from systems import kinds, system

from nag.decomposition.decompose import decompose
from nag.solving.solve import solve

VARIABLES = {3: "x y z", 4: "x y z w"}
SIMPLE, TRIPLE_LINE = (0, 1, 1), (1, 1, 3)
SYSTEMS = {
    # Two simple zeros 1e-15 from a multiple one, in the same branch.
    "beside a multiple zero": (
        (
            "300*x^2*z - 44000*x*y^2 + 20*x*z^2",
            "-40000/9*x^3*y - 27/50000*z^4 - 200/3*x^3 + 1/500*y",
            "9/100*x^4*y - 7/100*x*y^2*z^2 + 200*y*z^4 + 1/10000*x*y^2 + 3/100000*x^2 + 900000*y",
        ),
        {SIMPLE: 39, (0, 1, 8): 1},
    ),
    # A multiple zero of one branch on the line that another one is.
    "a multiple zero on a line": (
        (
            "-8/3*x^3*z - 60000*y^2*z^2 - 8400000*x^3 - 3/10000*x^2*z + 1/5000*z^2",
            "-7000*x*y^2*z + 4000*x*y*z^2 + 470000*x*z^3 - 900000*y^3*z - 700*z^4",
            "-44*x^3*z^2 + 1/12500*z^5 + 6*y*z^3 + 195*y*z^2",
        ),
        {SIMPLE: 28, TRIPLE_LINE: 1},
    ),
    # Two simple zeros of one branch on the conic that another one has, and two beside it.
    "on a conic and beside it": (
        (
            "1250*x^2 + 1000*y^2 + 1/50000*y*z + 4000",
            "700000*x*y*w + 700000*y*z^2 - 40000/7*y*z*w + 3/20*y*z",
            "500*x*z^2 - 3/50000*x*z + 1000*x*w + 7/100*z*w + 1/125*w^2",
            "70*x^2*w^2 + 1/1000*x*y^2*z - 7/10*x*w^3 + 9/100*x^2*z + 930*x*y*z + 600*w^2",
        ),
        {SIMPLE: 38, (1, 2, 1): 1},
    ),
    # Paths to isolated points of a curve are lost, those of a start system are not.
    "paths lost beside a line": (
        (
            "1/2000*x*y*z + 1/5*z^2*w - 3/100*w^3 - 47/100000*x*z",
            "-30*x*y - 800*y^2 - 15/2*y*z - 1/125*w^2 + 1/25000*z",
            "9/100*x^2*w - 1/1000*x*y*w - 7/200*x*w^2 - 5300*w^3 + 1/20000*x*z",
            "-1000*y^2 + 1/2*y*w - 3400*z^2",
        ),
        {(0, 1, 1): 16, (1, 1, 1): 1},
    ),
    # The origin, in three variables whose series are too long, lies on a line.
    "too long series": (
        (
            "-9/4*x^2*y + 75/2*x*y^2 - 2*z^3 + 2*w^3",
            "70*z^2*w^2 + 12*w^4 - 42*x^3 - 5*x*z^2",
            "-9*y*z - 6*z^2 - 2*z*w - 36*w",
            "6*x^2*y - 93*y^2*w",
        ),
        {(0, 1, 1): 33, (1, 1, 1): 1},
    ),
    # Ends on a line where numbers of 1e-63 are no zeros in units of one.
    "small coefficients on a line": (
        (
            "1/50000*x^3*z + 40000*x^2*z^2 - 3/100000*x^2*y - 500000*z",
            "60000*x*y^2 + 29/10000*y^2*w - 4000*w^3 + 2000*z*w",
            "-13/2*y*z*w - 39/5000*z^3 - 2*z^2*w - 2/25*x*w",
            "-17/20000*x*y^2 - x*z^2 - 3/10*x*w^2 + 940*w",
        ),
        {(0, 1, 1): 44, (1, 1, 1): 1, (1, 1, 2): 1},
    ),
    # A coordinate that is known to seven digits, and residuals as large as that explains.
    "a coordinate of few digits": (
        (
            "-1/3000000*x^3 - 250*x^2*y + 23499999999/25000000*x^2*z - 30*x*y*z"
            " + 281999999997/2500000000*x*z^2 - 9/10*y*z^2 + 423/125*z^3 + 1/375000*x^2 - 1000*x*y"
            " + 9400000001/2500000*x*z - 60*y*z + 141000000009/625000000*z^2 + 11/750000*x"
            " - 1000*y + 11750000003/3125000*z + 1/62500",
            "-3/10*x^3*y - 5000*x*y^3 - 1/90000*x*y*z + 45000*y - 1/225",
            "-39/5*z^3 + 9",
        ),
        {SIMPLE: 12, (0, 1, 2): 9},
    ),
    # Coordinates of 1e-89 and 1e45 of one zero, beside a curve where the first is zero.
    "a tiny coordinate beside a huge one": (
        (
            "60000*y*z^2 - 440/9*z*w^2 + 9/1000*y*z + 75000",
            "-1/12500*x*z^2 + 980*x*w",
            "-600000*x^2*z - 1/125*y*w^2 + 920000/9*w^3 - 1/50000*x*y - 1/6250*w^2 + 70",
            "-1/10*x^2*y - 1/500*x*w^2",
        ),
        {SIMPLE: 18, (1, 9, 1): 1},
    ),
    # A simple zero with coordinates of 1e-117 and 1e40, by their own sizes in a small box only.
    "a box no larger than a coordinate": (
        (
            "-9/10000*x^2*z^2 + 8*x*y*w^2 + 7000*y^3*z - 14/75*z",
            "-3/500*x^2 + 20000*x*y - 6*z*w - 7/1000*x - 800000",
            "500000*x*y*w + 45*z^2*w + 1/12500",
            "60000*y*z^2*w + 3/5000*y*w^3 + 250",
        ),
        {SIMPLE: 43},
    ),
    # Zeros far out beside lines: small coordinates of limits count by their own size.
    "a far zero beside a line": (
        (
            "-3/100000*x*y*z^2 + 26/5*y^3 - 1/20*x*z + 1/2*y",
            "-100000*x*y*z^3 - 1300000*y^5 - 1/2500*x^3",
            "-69/100000*x^4 + 800*x*y^3 + 2/5*y*z^3 + 2100*x*y",
        ),
        {SIMPLE: 53, (1, 1, 1): 1},
    ),
    "a far zero beside double lines": (
        (
            "-4/5*x*y + 5*w^2 - 3/100*y",
            "80*x^2*w + 33/50*z*w^2",
            "3/100*x^4*y + 60/7*x^3*z^2 + 10*x*z^3 + 500*y*w^3",
            "-7800*x^2*y*z + 7*y*w^3 - 400*x*y^2",
        ),
        {SIMPLE: 15, (1, 1, 2): 2, (1, 2, 1): 1},
    ),
    # Of two zeros that agree but for y, which is 0 and 1e-95: that is more than their errors.
    "a coordinate that is smaller than most digits tell": (
        (
            "-80000*x*y + 1/100*x*w - 3/100000*y^2 + 11/100000*z*w + 1/10*w",
            "23/5*x^2*w - 7/10*y*z^2 + 1/200*y*z*w - 3/10000*x^2 + 540000*x*y - 1/12500*x*z - 10",
            "-13/100*x^3*y - 50000*y^2*w^2",
            "-1/20000*x*y + 3/400000*x*w - 89*z^2",
        ),
        {SIMPLE: 36, (0, 1, 2): 2},
    ),
}


@pytest.mark.parametrize("name", SYSTEMS)
def test_components_are_those_that_exact_algebra_counts(name: str) -> None:
    equations, truth = SYSTEMS[name]
    answer = decompose(system(VARIABLES[len(equations)], *equations))
    assert kinds(answer) == truth
    assert answer.complete


@pytest.mark.parametrize("name", SYSTEMS)
def test_isolated_zeros_are_as_many_as_exact_algebra_counts(name: str) -> None:
    equations, truth = SYSTEMS[name]
    result = solve(system(VARIABLES[len(equations)], *equations))
    found = [s.multiplicity for s in result.solutions]
    assert sorted(found) == sorted(
        k for (d, _, k), count in truth.items() if not d for _ in range(count)
    )
    assert result.complete


def test_an_end_beside_one_that_is_proved_lies_on_the_curve_there() -> None:
    equations = (
        "-1/20*x*y - 100*y*w + 200000/3*z^2 + 490000*x + 6000*z",
        "30*x^2*y + 7/1200*y*z^2 + 7*z*w^2 + 120*z*w - 100000*z",
        "-3/2*x*y + 800000*y*z + 1/1250*z^2 - 53/10*z + 1/20000*w",
        "-70/9*x*z - 8*y*w - 1/10000*z^2 - 55*w^2",
    )
    result = solve(system("x y z w", *equations))
    assert [s.multiplicity for s in result.solutions] == [1] * 14
    assert result.complete
    assert result.positive_dimensional


def test_a_zero_of_size_1e40_beside_lines_is_not_taken_for_an_infinite_one() -> None:
    answer = decompose(small_system(20262, 5622).system)
    assert kinds(answer) == {SIMPLE: 15, (1, 1, 1): 2}
    assert answer.complete


def test_paths_that_end_at_too_few_zeros_are_followed_further_and_no_others() -> None:
    """Five end where a triple zero seems to be; 28 others go to infinity with winding number 14."""
    result = solve(
        system(
            "x y z w",
            "-90000*x^2 - 5*y^2 + 53/100000*z + 79/800*w",
            "3/400*x*y*z^3 + 9/10000*y*z^2*w^2 + 3/25*x^3*z - 1/500000*z^2*w^2 + 9/100*y^2 + 81",
            "-7/40000*x^2 + 37*x*z - 2/25*y^2 + 39/5000*z^2 - 350000*x + 2000",
            "-6*z^3*w^2 - 17/10000*x^2*y",
        ),
        start="multihomogeneous",
    )
    assert [s.multiplicity for s in result.solutions] == [1] * 66
    assert result.complete
    assert result.paths.at_infinity == 28


@pytest.mark.parametrize(
    ("equations", "simple"),
    [
        # A coordinate of 3/1750 in one branch, which doubles only round.
        (
            (
                "-350/3*x*w + 1/5*w",
                "-1/5000*y^3*z^2 + 200000*x*z*w - 9/1000",
                "-12*x^3*w + 200*x*y^2*w - 21/1000*x*z^2 + 100*y^2*w + 4/5",
                "17/20*z*w^2 + 100/3*x*y - 1/5",
            ),
            33,
        ),
        # Coordinates that vanish, written as 1e-213.
        (
            (
                "-65*x*y^2 - 3/4*x*y*w - 8*y^2*z - 4*z^3 - 7*y^2 - 8*w^2 + 9",
                "-3*x^4 - 7*x*y^3 - 29*x*z^3 + 19*z^4 + 76*x^3 + 5*x^2*y",
                "2/3*y^2*z*w - x*w",
                "-53/3*x*w + w^2",
            ),
            33,
        ),
    ],
)
def test_errors_of_coordinates_hold_also_those_of_writing_them(
    equations: tuple[str, ...], simple: int
) -> None:
    result = solve(system("x y z w", *equations))
    assert result.complete
    assert sum(s.multiplicity == 1 for s in result.solutions) == simple
