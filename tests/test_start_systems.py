"""Start systems: solved exactly, as many solutions as the count says, regular all of them."""

from __future__ import annotations

from fractions import Fraction
from math import comb, prod

import numpy as np
import pytest
from classical_systems import make_classic
from evaluated import jacobian, patch, values
from hypothesis import given, settings
from hypothesis import strategies as st
from systems import benchmark

from nag.algebra.expression import parse_polynomial
from nag.algebra.polynomial import Polynomial
from nag.errors import StartError
from nag.numerics.scaling import independent_rows, scaled_terms, variable_scales
from nag.solving.start.choice import choose
from nag.solving.start.mixed_cells import mixed_cells
from nag.solving.start.multihomogeneous import (
    _Choices,
    best_groups,
    bezout_number,
    count,
    multihomogeneous,
)
from nag.solving.start.target import StartSystem, Target
from nag.solving.start.total_degree import bezout, has_bezouts_volume, total_degree
from nag.tracking.paths import PathStatus
from nag.tracking.track import track


def target(variables: str, *equations: str) -> Target:
    names = variables.split()
    return Target.of([parse_polynomial(e, names) for e in equations], len(names))


SYSTEMS = [
    target("x y", "x^2 + y^2 - 5", "x^3*y - 2"),
    target("x y z", "x + 2*y - 3*z - 1", "x^2 - y*z + 3", "z^3 + x*y - 7"),
    target("x y z", "x - y + 2", "x + y + z", "x*y*z - 4"),
]
EIGENVALUES = target("l a b", "2*a + b - l*a", "a - 3*b - l*b", "3*a + 5*b - 1")


def residual_at_start(start: StartSystem) -> float:
    points = start.homotopy.normalized(start.points)
    return float(np.abs(values(start.homotopy, points, 1.0)).max(initial=0.0))


def are_distinct_and_regular(start: StartSystem) -> bool:
    homotopy = start.homotopy
    points = homotopy.normalized(start.points)
    rows = np.concatenate([jacobian(homotopy, points, 1.0), patch(homotopy, points)], axis=1)
    smallest = np.linalg.svd(rows, compute_uv=False)[:, -1]
    affine = start.affine(points)
    apart = np.linalg.norm(affine[:, None] - affine[None], axis=2)
    apart += np.eye(len(affine))
    return bool(smallest.min() > 1e-6 and apart.min() > 1e-6)


@pytest.mark.parametrize("each", SYSTEMS)
def test_total_degree_has_bezouts_number_of_regular_solutions(each: Target) -> None:
    start = total_degree(each, np.random.default_rng(0))
    assert len(start.points) == bezout(each) == prod(each.degrees)
    assert residual_at_start(start) < 1e-14
    assert are_distinct_and_regular(start)


def test_linear_equations_hold_all_the_way() -> None:
    start = total_degree(SYSTEMS[2], np.random.default_rng(1))
    assert len(start.homotopy.A0) == 2
    assert not start.homotopy.A1.any()
    assert len(start.points) == 3


def test_multihomogeneous_has_its_number_of_regular_solutions() -> None:
    groups = ((0,), (1, 2))
    start = multihomogeneous(EIGENVALUES, groups, np.random.default_rng(0))
    assert len(start.points) == count(EIGENVALUES, groups) == 2
    assert residual_at_start(start) < 1e-14
    assert are_distinct_and_regular(start)


def test_groups_are_found() -> None:
    groups, number = best_groups(EIGENVALUES)
    assert (groups, number) == (((0,), (1, 2)), 2)
    multilinear = target("x y z", *(f"x*y*z + {a}*x*y + {a * a}*z - {a}" for a in (2, 3, 5)))
    assert best_groups(multilinear) == (((0,), (1,), (2,)), 6)


@given(st.lists(st.integers(1, 4), min_size=1, max_size=5))
def test_one_group_gives_bezouts_number(degrees: list[int]) -> None:
    assert bezout_number(np.array(degrees)[:, None], [len(degrees)]) == prod(degrees)


@given(st.integers(1, 5), st.integers(1, 5))
def test_bilinear_systems_have_binomial_numbers(a: int, b: int) -> None:
    degrees = np.ones((a + b, 2), dtype=int)
    assert bezout_number(degrees, [a, b]) == comb(a + b, a)


@given(st.lists(st.integers(1, 2), min_size=1, max_size=3), st.data())
def test_factors_are_chosen_in_each_way_once(sizes: list[int], data: st.DataObject) -> None:
    row = st.lists(st.integers(0, 2), min_size=len(sizes), max_size=len(sizes))
    degrees = np.array(data.draw(st.lists(row, min_size=sum(sizes), max_size=sum(sizes))))
    choices = _Choices.of(degrees, sizes)
    assert len(choices) == bezout_number(degrees, sizes)
    every = choices.choose(np.arange(len(choices)))
    assert len({each.tobytes() for each in every}) == len(every)
    for each in every:
        assert np.bincount(each[:, 0], minlength=len(sizes)).tolist() == sizes
        assert (each[:, 1] < degrees[np.arange(len(degrees)), each[:, 0]]).all()
    some = np.array([k for k in (7, 0, 3) if k < len(choices)], dtype=int)
    assert np.array_equal(choices.choose(some), every[some])


@settings(max_examples=20)
@given(st.permutations(range(5)), st.integers(0, 10**6))
def test_a_partition_gives_at_most_what_the_search_ends_with(order: list[int], seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows = []
    for _ in range(5):
        exponents = rng.integers(0, 2, (4, 5))
        rows.append(Polynomial(5, {tuple(e): 1 for e in exponents.tolist()} | {(0,) * 5: 1}))
    each = Target.of(rows, 5)
    groups, number = best_groups(each)
    assert number == count(each, groups) <= bezout(each)
    split = (tuple(sorted(order[:2])), tuple(sorted(order[2:])))
    assert best_groups(each, split)[1] <= count(each, split)


def test_auto_takes_the_fewest_paths_and_says_why() -> None:
    start, reason = choose(EIGENVALUES, "auto", (), np.random.default_rng(0), 1)
    assert start.name == "multihomogeneous" and len(start.points) == 2
    assert "total degree 4" in reason and "multihomogeneous 2" in reason


def test_a_mixed_volume_below_every_other_count_is_the_least_work() -> None:
    far = target("x y", "x^40 - 3*x^21*y + 7*y^2 - 1", "y^3 + x^5*y - 2*x + 5")
    start, reason = choose(far, "auto", (), np.random.default_rng(0), 1)
    assert start.name == "polyhedral" and len(start.points) == 120
    assert "multihomogeneous 130" in reason and "mixed volume 120" in reason


@pytest.mark.parametrize("most", [1, 7, 119])
def test_a_polyhedral_start_is_the_same_however_many_paths_are_made_ready_together(
    most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    far = target("x y", "x^40 - 3*x^21*y + 7*y^2 - 1", "y^3 + x^5*y - 2*x + 5")
    expected, _ = choose(far, "polyhedral", (), np.random.default_rng(0), 1)
    cells = mixed_cells(far.supports, np.random.default_rng(0))
    blocks = list(cells.blocks(most))
    assert np.array_equal(np.concatenate([b.edges for b in blocks]), cells.edges)
    assert all(b.mixed_volume <= most or len(b.edges) == 1 for b in blocks)
    monkeypatch.setattr("nag.solving.start.polyhedral.PATHS_AT_ONCE", most)
    start, _ = choose(far, "polyhedral", (), np.random.default_rng(0), 1)
    assert np.array_equal(start.points, expected.points)


def test_few_paths_give_way_to_fewer_of_a_polyhedral_start() -> None:
    each = target("x y", "x^10 - 3*x^6*y + 7*y^2 - 1", "y^3 + x^5*y - 2*x + 5")
    start, reason = choose(each, "auto", (), np.random.default_rng(0), 1)
    assert start.name == "polyhedral" and len(start.points) == 30
    assert "mixed volume 30" in reason


def test_a_mixed_volume_that_is_bezouts_number_needs_no_mixed_cells(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def none(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr("nag.solving.start.mixed_cells.mixed_cells", none)
    start, reason = choose(benchmark("katsura-8"), "auto", (), np.random.default_rng(0), 1)
    assert start.name == "total" and start.known.bound == 256
    assert "mixed volume 256" in reason


@pytest.mark.parametrize(("name", "chosen"), [("reimer 5", "polyhedral"), ("katsura 9", "total")])
def test_where_no_paths_are_saved_some_in_doubles_tell_the_start(name: str, chosen: str) -> None:
    system = make_classic(name).system
    each = Target.of(system.polynomials, system.n)
    start, reason = choose(each, "auto", (), np.random.default_rng(0), 1)
    assert start.name == chosen
    assert ("doubles finish" in reason) == (chosen == "polyhedral")


@pytest.mark.parametrize("seed", range(30))
def test_bezouts_number_is_the_mixed_volume_just_where_sets_of_coordinates_say_so(
    seed: int,
) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 5))
    degrees = rng.integers(1, 4, n).tolist()
    supports = []
    for d in degrees:
        mixed = rng.multinomial(d, np.full(n + 1, 1 / (n + 1)), 6)[:, 1:]
        vertices = d * np.eye(n + 1, dtype=np.int64)[rng.random(n + 1) < 0.8, 1:]
        linear = np.eye(n, dtype=np.int64)[:1] * d
        supports.append(np.unique(np.concatenate([mixed, vertices, linear]), axis=0))
    volume = mixed_cells(tuple(supports), rng).mixed_volume
    assert has_bezouts_volume(supports) == (volume == prod(degrees))


def test_unknown_kinds_and_too_many_paths_are_refused() -> None:
    with pytest.raises(ValueError, match="auto, total"):
        choose(EIGENVALUES, "best", (), np.random.default_rng(0), 1)
    names = [f"x{i}" for i in range(8)]
    huge = target(" ".join(names), *(f"{v}^10 + {names[i - 1]} - 1" for i, v in enumerate(names)))
    with pytest.raises(StartError, match="100000000 paths"):
        total_degree(huge, np.random.default_rng(0))


def test_scaling_makes_coefficients_of_one_size() -> None:
    f = [
        parse_polynomial("1000000*x^2 - 4", ["x", "y"]),
        parse_polynomial("x*y/1000000000 - 1", ["x", "y"]),
    ]
    scales = variable_scales(f, 2)
    for each in f:
        sizes = [abs(float(c)) for c in scaled_terms(each, scales).values()]
        assert max(sizes) / min(sizes) < 4
        assert 1 <= max(sizes) < 2


def test_rows_with_the_same_monomials_become_orthogonal_and_keep_their_zeros() -> None:
    f = [
        dict(parse_polynomial(t, ["x", "y"]).terms)
        for t in ("x*y - 2*x + 3*y - 6", "1001*x*y - 2000*x + 3001*y - 6003")
    ]
    rows = independent_rows(f)
    matrix = np.array([[float(row[e]) for e in f[0]] for row in rows])
    assert np.allclose(matrix @ matrix.T, np.eye(2), atol=1e-6)
    before = np.array([[float(row[e]) for e in f[0]] for row in f])
    assert np.linalg.matrix_rank(np.vstack([before, matrix]), tol=1e-6) == 2


def test_a_generic_start_has_its_points_as_zeros() -> None:
    equations = "x^3 + y*z - 2", "y^2 - x - 1", "z + w + 3*x - 1", "w^2*x^2 + z"
    system = target("x y z w", *equations)
    start = total_degree(system, np.random.default_rng(5), generic=True)
    assert len(start.points) == 3 * 2 * 4
    assert np.abs(values(start.homotopy, start.points, 1.0)).max() < 1e-12
    affine = start.affine(start.points[:])
    distances = np.abs(affine[:, None] - affine[None]).max(axis=2) + np.eye(len(affine))
    assert distances.min() > 1e-3
    square = jacobian(start.homotopy, start.points, 1.0)[:, :, 1:]
    assert np.linalg.svd(square, compute_uv=False).min() > 1e-3


@pytest.mark.parametrize("coefficients", ["3 5", "7/3 -1/11", "4/7 1"])
def test_linear_equations_are_held_exactly(coefficients: str) -> None:
    a, b = coefficients.split()
    system = target("x y z", f"{a}*x + {b}*y - 1", "x^2 + y*z - 3", "z^2 - x*y")
    rows = total_degree(system, np.random.default_rng(0)).homotopy.A0
    assert rows.shape == (1, 4)
    held = [Fraction(float(c.real)) for c in rows[0]]
    exact = [system.rows[0].get(e, Fraction(0)) for e in [(0,) * 3, (1, 0, 0), (0, 1, 0)]]
    assert not rows.imag.any()
    assert all(h * exact[0] == e * held[0] for h, e in zip(held, exact, strict=False))


def test_linear_equations_that_doubles_do_not_hold_are_tracked_as_polynomials() -> None:
    system = target("x y", f"{10**17 + 3}*x + y - 1", "x^2 + y^2 - 3")
    assert len(total_degree(system, np.random.default_rng(0)).homotopy.A0) == 0


def test_zeros_at_infinity_of_linear_equations_stay_there() -> None:
    equations = "x^2 + y^2 - 1", "u^2 + v^2 - 4", "3*x + 5*u - 1", "3*y + 5*v - 2/3"
    start = total_degree(target("x y u v", *equations), np.random.default_rng(0))
    status = track(start.homotopy, start.points).status
    assert sorted(status) == [PathStatus.REGULAR] * 2 + [PathStatus.AT_INFINITY] * 2
