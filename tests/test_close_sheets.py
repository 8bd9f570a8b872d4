"""Components that come near to each other everywhere are told apart, as far as digits go."""

from __future__ import annotations

from functools import cache

import flint
import numpy as np
import pytest

import nag
from nag.bench.atlas.curves import close_skew_lines
from nag.decomposition import witness_at
from nag.decomposition.decompose import decompose, one_by_one
from nag.decomposition.method import Task, decompose_by
from nag.files.export import read_decomposition, write_decomposition
from nag.numerics.system_facts import SystemFacts
from nag.tracking.paths import Ball
from nag.tracking.run import Run
from nag.witness.close_points import (
    PointInWords,
    distance,
    fine_of_balls,
    with_newton_constant,
    zero_from,
)
from nag.witness.fibres import _words
from nag.witness.membership import UndecidedError
from nag.witness.slices import random_rows, to_slice
from nag.witness.witness import WitnessSet

# Pairs of conjugate components at a distance of 10^-k, and the degree of each.
LINE = "(x + 2*y - 1)^2 - 2/10^{}"
PAIRS = {
    "lines": ([LINE], 1),
    "circles": (["(x^2 + y^2 - 1)^2 - 2/10^{}"], 2),
    "circles on a sphere": (["x^2 + y^2 + z^2 - 1", LINE], 2),
    "quartics": (["x*y - z^2 + 1 + x", "(x + 2*y - 1 + z^2)^2 - 2/10^{}"], 4),
    "curves in space": (["x^2 + y^2 - 1 + w", "x*z - w^2 + 1", LINE], 4),
}


@cache
def pair(name: str, k: int, seed: int = 0) -> tuple[WitnessSet, ...]:
    texts, degree = PAIRS[name]
    answer = nag.decompose([text.format(2 * k) for text in texts], seed=seed)
    assert answer.complete
    assert [(c.dimension, c.degree) for c in answer.components] == [(1, degree)] * 2
    return answer.components


def sheet(x: np.ndarray, k: int) -> np.ndarray:
    """On which of the lines of `LINE` points are: -1 or 1, as far as doubles show."""
    return (x[:, 0] + 2 * x[:, 1] - 1) * 10.0**k / 2**0.5


EASIER = [(name, k) for name in PAIRS for k in (4, 6, 8, 10, 12, 15)]
HARDER = [(name, 25) for name in PAIRS if name != "quartics"]


@pytest.mark.parametrize(("name", "k"), EASIER + HARDER)
def test_conjugate_sheets_are_two_components(name: str, k: int) -> None:
    for component in pair(name, k):
        assert component.accuracy < 1e-15
        assert (component.digits >= 32).all()


@pytest.mark.parametrize(("k", "seed"), [(12, 1), (12, 4), (12, 5), (15, 3), (15, 4)])
def test_paths_keep_to_their_sheets_where_corrections_are_along_them(k: int, seed: int) -> None:
    pair("curves in space", k, seed)


def test_loops_do_not_jump_between_sheets() -> None:
    # Sixteen points: too many to look for linear traces among all subsets.
    texts = ["x^2 + y^2 + z^2 - 1", "(x^4 + y*z - 1/2)^2 - 2/10^16"]
    answer = nag.decompose(texts)
    assert answer.complete
    assert [(c.dimension, c.degree) for c in answer.components] == [(1, 8)] * 2


@pytest.mark.parametrize("k", [6, 8, 10])
@pytest.mark.parametrize("name", ["lines", "circles on a sphere"])
def test_a_component_is_sampled_on_its_own_sheet(name: str, k: int) -> None:
    means = []
    for component in pair(name, k):
        own = sheet(component.sample(0, 4), k)
        rows = random_rows(np.random.default_rng(5), 1, component.points.shape[1])
        moved = witness_at(component.system, component, to_slice(rows))
        assert np.allclose(sheet(moved.points, k), own[0], atol=1e-3)
        assert np.allclose(own, own[0], atol=1e-3)
        means.append(own[0].real)
    assert np.allclose(sorted(means), [-1, 1], atol=1e-3)


@pytest.mark.parametrize("seed", range(4))
def test_points_of_sheets_that_doubles_do_not_tell_apart_are_sampled(seed: int) -> None:
    # A random slice is scaled on the way to it: it has to stay the same to the last bit.
    for component in pair("circles on a sphere", 20):
        x = component.sample(seed, 1)[0]
        assert abs(x[0] + 2 * x[1] - 1) < 1e-14


def test_a_point_is_on_the_sheet_it_is_nearest_to_or_cannot_be_told() -> None:
    first, second = pair("circles on a sphere", 6)
    x = first.sample(0, 1)[0]
    assert first.contains(x) and not second.contains(x)
    # A rounded point does not say on which of two sheets it is that are nearer to each other.
    first, second = pair("circles on a sphere", 20)
    x = first.sample(0, 1)[0]
    for component in (first, second):
        with pytest.raises(UndecidedError):
            component.contains(x)
        assert not component.contains(x + 1e-3)


def test_points_where_sheets_cross_are_on_both() -> None:
    answer = nag.decompose(["(x^3 + x - y)^2 - 2*x^2/10^12"])
    assert len(answer.components) == 2
    for component in answer.components:
        assert component.contains([0, 0])
        assert not component.contains([1, 2])


@pytest.mark.parametrize(("k", "seed"), [(20, 2), (25, 2), (20, 0)])
def test_a_point_between_two_sheets_of_one_set_is_on_the_set(k: int, seed: int) -> None:
    # Where skew lines pass each other, the first equations have points that are to be left out.
    problem = close_skew_lines(k, np.random.default_rng([seed, 20]))
    answer = decompose(problem.system, seed=seed)
    assert answer.complete
    assert [(c.dimension, c.degree) for c in answer.components] == [(1, 1)] * 2


@pytest.mark.parametrize("k", [8, 15, 25])
def test_close_points_lie_within_their_radii(k: int) -> None:
    found = []
    for component in pair("lines", k):
        ((a, b),), (c,) = component.slice.A, component.slice.b
        (point,), (radii,) = component.points, component.radii
        with flint.ctx.workdps(80):
            a, b, c = (flint.acb(complex(v)) for v in (a, b, c))
            offsets = [sign * flint.arb(2).sqrt() / flint.arb(10) ** k for sign in (1, -1)]
            # x + 2 y = 1 + offset and a x + b y = c.
            zeros = [
                ((b * (1 + e) - 2 * c) / (b - 2 * a), (c - a * (1 + e)) / (b - 2 * a))
                for e in offsets
            ]
            errors = [
                [
                    float(abs(z - flint.acb(complex(x))).mid())
                    for z, x in zip(zero, point, strict=True)
                ]
                for zero in zeros
            ]
            (fine,) = component.fibres[0].fine.values()
            apart = [
                max(float(abs(z - x).mid()) for z, x in zip(zero, fine.balls(), strict=True))
                for zero in zeros
            ]
        own = int(np.argmin(apart))
        found.append(own)
        # The point's digits are those of one line, and far from the other.
        assert apart[own] < 1e-50 and apart[1 - own] > 10.0 ** -(k + 1)
        assert (np.array(errors[own]) <= radii).all()
    assert sorted(found) == [0, 1]


def test_an_export_keeps_the_digits_of_close_points(tmp_path) -> None:
    texts, _ = PAIRS["circles on a sphere"]
    answer = decompose(nag.system([text.format(20) for text in texts]))
    write_decomposition(answer, tmp_path / "close.json")
    again = read_decomposition(tmp_path / "close.json")
    assert again == answer
    for before, after in zip(answer.components, again.components, strict=True):
        assert after.fibres[0].fine and after.fibres == before.fibres
        own, read = (sheet(c.sample(1, 3), 10) for c in (before, after))
        assert np.array_equal(own, read) and np.allclose(np.abs(own), 1, atol=1e-3)


def test_newtons_constant_is_the_inverse_distance_of_two_zeros() -> None:
    for k in (3, 10, 20):
        f = nag.system(f"x^2 - 1/10^{2 * k}", "x").polynomials
        with flint.ctx.workdps(100):
            point = fine_of_balls([flint.acb(1) / flint.arb(10) ** k], 1.0)
        found = with_newton_constant(f, np.zeros((0, 2), dtype=complex), point).curvature
        assert 0.3 < found / (0.5 * 10.0**k) < 3


def test_distances_of_close_points_are_those_of_all_digits() -> None:
    with flint.ctx.workdps(100):
        x, y = (
            fine_of_balls([flint.acb(1) / 3 + e, flint.acb(2)], 1.0)
            for e in (0, flint.arb("3e-30"))
        )
    assert isinstance(x, PointInWords) and np.array_equal(x.rounded, y.rounded)
    assert distance(x.rounded, None, y.rounded, None) == 0
    assert abs(distance(x.rounded, x, y.rounded, y) - 3e-30) < 1e-40


def test_ends_in_more_words_than_are_compared_keep_the_leading_ones() -> None:
    """The last arithmetic has eight words."""
    words = 2.0 ** (-60.0 * np.arange(8))
    centre = np.tile(words, (3, 2, 1))
    assert (_words(Ball(centre, np.zeros(3))) == centre[..., :4]).all()
    padded = _words(Ball(centre[..., :2], np.zeros(3)))
    assert (padded[..., :2] == centre[..., :2]).all() and not padded[..., 2:].any()


@pytest.mark.parametrize(
    "equations",
    [
        ["(x^2 + y^2 - 1)^2 - 2/10^140"],
        ["(x^2 + y*z - 1)^3 - 2/10^210"],
        ["(x^2 + y^2 - 1)^2 - 2/10^140", "z^2 - x*y - 1"],
        ["(x^2 + y^2 - 1)^3 - 2/10^210", "z^2 - x"],
    ],
)
def test_sheets_too_close_to_be_told_apart_are_left_open(equations: list[str]) -> None:
    assert not nag.decompose(equations).complete


def test_sheets_that_only_the_last_arithmetic_tells_apart_are_two() -> None:
    answer = nag.decompose("(x + 2*y - 1)^2 - 2/10^80")
    assert answer.complete
    assert [(c.dimension, c.degree) for c in answer.components] == [(1, 1)] * 2


@pytest.mark.parametrize(("e", "power"), [(25, 2), (25, 3), (20, 6)])
def test_close_zeros_are_known_to_as_many_digits_as_are_asked_for(e: int, power: int) -> None:
    """Their equations' values are much smaller than the zeros' distances."""
    (f,) = nag.system(f"x^{power} - 2/10^{e * power}", "x").polynomials
    with flint.ctx.workdps(400):
        exact = flint.arb(2) ** flint.fmpq(1, power) / flint.arb(10) ** e
        start = fine_of_balls([flint.acb(exact)], 10.0**e)
        found = zero_from([f], np.zeros((0, 2), dtype=complex), start, 150)
        assert found is not None and abs(found.centre[0] - exact) < flint.arb(10) ** -150


@pytest.mark.parametrize("k", [6, 9, 12, 20, 25])
def test_double_curves_on_close_planes_are_as_many_and_as_multiple(k: int) -> None:
    # Both planes hold a conic, each twice; a third one, on x = -3, is simple.
    conic, plane = "(x^2 + y^2 - 1 + (x - y)*z)", f"(z - 1/10^{k})"
    answer = nag.decompose([f"{plane}*{conic}", f"z*{conic} - z^2*(x + 3)*{plane}"])
    assert answer.complete
    found = sorted((c.dimension, c.degree, c.multiplicity) for c in answer.components)
    assert found == [(1, 2, 1), (1, 2, 2), (1, 2, 2)]


CIRCLE, CUBIC = "(x^2 + y^2 - 1)", "(x^3 + y^3 + z^2*x + y*z - 2*x + 1)"
# Curves of which no equation is a product, multiple on sheets 10^-k apart; the degrees and
# multiplicities of all.
MULTIPLE = {
    "two double ones": (
        [CIRCLE + "+ z^2*(z - {0})^2", CIRCLE + "*(x + 2*y + 3*z - 5)"],
        [(2, 2), (2, 2), (4, 1)],
    ),
    "two conjugate double ones": (
        [CIRCLE + "+ (z^2 - 2*{0}^2)^2", CIRCLE + "*(x + 2*y + 3*z - 5)"],
        [(2, 2), (2, 2), (4, 1)],
    ),
    "a double and a simple one": (
        [CIRCLE + "+ z^2*(z - {0})", CIRCLE + "*(x + 2*y + 3*z - 5)"],
        [(2, 1), (2, 2), (3, 1)],
    ),
    "conjugate double cubics, slanting": (
        [
            "((z + x)^2 - 2*{0}^2)^2 + x*" + CUBIC,
            "(x + 1)*" + CUBIC + "- 2*((z + x)^2 - 2*{0}^2)^2",
        ],
        [(3, 2), (3, 2), (4, 1)],
    ),
}


def test_three_conjugate_double_curves_are_three() -> None:
    """Their ends lose 36 digits of 64: slopes are too wide over boxes of their rounding errors."""
    equations = [CIRCLE + "+ (z^3 - 2/10^27)^2", CIRCLE + "*(x + 2*y + 3*z - 5)"]
    answer = nag.decompose(equations)
    assert answer.complete
    found = sorted((c.degree, c.multiplicity) for c in answer.components)
    assert found == [(2, 2), (2, 2), (2, 2), (6, 1)]


@pytest.mark.parametrize(
    ("name", "k"),
    [
        *(("two double ones", k) for k in (3, 8, 15)),
        *(("two conjugate double ones", k) for k in (6, 15)),
        *(("a double and a simple one", k) for k in (6, 10, 15)),
        ("conjugate double cubics, slanting", 6),
    ],
)
def test_multiple_curves_on_close_sheets_have_deflations_of_their_own(name: str, k: int) -> None:
    equations, kinds = MULTIPLE[name]
    answer = nag.decompose([text.format(f"(1/10^{k})") for text in equations])
    assert answer.complete
    assert sorted((c.degree, c.multiplicity) for c in answer.components) == kinds


# A simple curve beside a multiple one: what is known of them are two cuts, of one equation each.
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(("multiplicity", "k"), [(2, 8), (2, 10), (2, 12), (2, 15), (3, 10)])
def test_a_simple_curve_and_a_multiple_one_beside_it_are_two(
    multiplicity: int, k: int, seed: int
) -> None:
    planes = f"(y - 1 + 1/10^{k})^{multiplicity}*(y - 1)"
    system = nag.system([planes, "x^4 + y*z - 1"], "x y z")
    answer = decompose_by((one_by_one,), Task(SystemFacts(system), (), Run(seed=seed)))
    assert answer.complete
    kinds = sorted((c.dimension, c.degree, c.multiplicity) for c in answer.components)
    assert kinds == [(1, 4, 1), (1, 4, multiplicity)]


def test_coranks_of_a_multiple_curve_beside_another_are_those_of_digits() -> None:
    """Its points differ in size, and beside some of them doubles see slopes that vanish."""
    texts = [
        "(y + 1/10^15)^2*y",
        "z*x + 3*v*u - u",
        "(y + 1)^2*(-z - 1)",
        "v*u*z^2*(2*z + u + 1/10^8) - 1/10^12",
    ]
    system = nag.system(texts, "x y z u v", nonzero=["x"])
    answer = decompose_by((one_by_one,), Task(SystemFacts(system), (), Run()))
    assert answer.complete
    found = sorted((c.dimension, c.degree, c.multiplicity, c.corank) for c in answer.components)
    assert found == [(1, 3, 1, 1), (1, 3, 2, 2)]
