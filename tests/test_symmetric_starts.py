"""Start systems that the symmetries of a target keep, and turns of their toric paths."""

from __future__ import annotations

import numpy as np
import pytest

from nag.numerics.coincidence import coincident
from nag.solving.solutions import SolveResult
from nag.solving.solve import solve
from nag.solving.start import polyhedral as starts
from nag.solving.start.invariance import (
    RowSymmetry,
    choose_invariant,
    close_under,
    find_invariant,
    find_orbits,
    find_row_symmetries,
    list_elements,
)
from nag.solving.start.mixed_cells import mixed_cells
from nag.solving.start.polyhedral import (
    CoordinateTurns,
    binomial_solutions,
    by_degeneration,
    polyhedral,
)
from nag.solving.start.target import Target, unit
from nag.tracking.paths import Ball, PathBranch
from tests.systems import benchmark, system

CYCLIC = ("cyclic-5", "cyclic-6", "cyclic-7")
# Equations in unknowns h alone, each twice: with coefficients that the interchange of x and y
# keeps, x = y are curves of zeros.
TWICE = (
    "h1*x1 + h2*x2 - 1",
    "x1^2 + 3*x1*x2 - 2*x2^2 + x1 - 5*h2",
    "h1*y1 + h2*y2 - 1",
    "y1^2 + 3*y1*y2 - 2*y2^2 + y1 - 5*h2",
    "h1*h2 + 7*h1 + x1*y1 - 11",
    "h1^2 - 3*h2 + x2 + y2 + 4",
)


def values(rows: list[dict[tuple[int, ...], complex]], y: np.ndarray) -> np.ndarray:
    """The rows' values at a point."""
    return np.array([sum(c * np.prod(y ** np.array(e)) for e, c in row.items()) for row in rows])


def terms(
    supports: tuple[np.ndarray, ...], coefficients: tuple[np.ndarray, ...]
) -> list[dict[tuple[int, ...], complex]]:
    """Rows by their exponents."""
    pairs = zip(supports, coefficients, strict=True)
    return [{tuple(e): c for e, c in zip(s.tolist(), own, strict=True)} for s, own in pairs]


def assert_keeps(
    symmetry: RowSymmetry, rows: list[dict[tuple[int, ...], complex]], y: np.ndarray
) -> None:
    """The rows at the image of a point are rows at the point, up to signs."""
    expected = np.array(symmetry.signs) * values(rows, y)[list(symmetry.rows)]
    assert np.allclose(values(rows, symmetry.map.of_point(y)), expected, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("name", CYCLIC)
def test_symmetries_carry_rows_to_rows(name: str) -> None:
    target = benchmark(name).sparsest
    found = list_elements(find_row_symmetries(target))
    n = target.n
    # Rotations and reflections; with an even number of variables also the change of all signs.
    assert len(found) == (4 * n if n % 2 == 0 else 2 * n) - 1
    y = unit(np.random.default_rng(1), n)
    rows = [{e: complex(c) for e, c in row.items()} for row in target.rows]
    for symmetry in found.values():
        assert_keeps(symmetry, rows, y)


@pytest.mark.parametrize("name", [*CYCLIC, "noon-5"])
def test_invariant_coefficients_are_kept_by_their_symmetries(name: str) -> None:
    target, rng = benchmark(name).sparsest, np.random.default_rng(2)
    free = [unit(rng, len(s)) for s in target.supports]
    found = list(list_elements(find_row_symmetries(target)).values())
    coefficients, kept = choose_invariant(target.supports, free, found)
    assert kept
    rows, y = terms(target.supports, coefficients), unit(rng, target.n)
    for symmetry in kept:
        assert_keeps(symmetry, rows, y)
    assert all(np.allclose(np.abs(c), 1) for c in coefficients)


def test_a_symmetry_that_asks_for_a_zero_coefficient_is_left_out() -> None:
    # The supports have a constant in each row, which the change of signs of x would negate.
    target = Target.of(system("x y", "x^3 - 2*x", "y^2 + y*x^2 - 3").polynomials, 2)
    symmetries = find_row_symmetries(target)
    assert len(symmetries) == 1
    free = [np.ones(len(s), dtype=complex) for s in target.supports]
    assert choose_invariant(target.supports, free, symmetries)[1] == ()


def test_coefficients_that_are_not_generic_are_left_to_fewer_symmetries() -> None:
    target, rng = benchmark("cyclic-6").sparsest, np.random.default_rng(3)
    free = [unit(rng, len(s)) for s in target.supports]
    generators = find_row_symmetries(target)
    none = find_invariant(target.supports, free, generators, lambda _: False)
    # The change of all signs keeps each coefficient where it is.
    assert [g.map.sources for g in none[1]] == [tuple(range(6))]
    assert all(map(np.array_equal, none[0], free))
    every = find_invariant(target.supports, free, generators, lambda _: True)
    assert len(list_elements(every[1])) == 23


def test_images_of_some_solutions_are_all(monkeypatch: pytest.MonkeyPatch) -> None:
    target, rng = benchmark("cyclic-6").sparsest, np.random.default_rng(4)
    cells = mixed_cells(target.supports, rng)
    near = [unit(rng, len(s)) for s in target.supports]
    reflection = [g for g in find_row_symmetries(target) if len(set(g.rows)) == 6][:1]
    coefficients, kept = choose_invariant(target.supports, near, reflection)
    whole, _ = by_degeneration(cells, coefficients, 1)
    orbits = find_orbits(whole, kept)
    assert orbits is not None
    few = whole.holding(whole.points[orbits.chosen], whole.errors[orbits.chosen])
    assert len(close_under(few, kept, 1000).points) == len(whole.points)
    # A point that is no solution has an image that is none.
    assert find_orbits(few, kept) is None or len(few.points) == len(whole.points)


def assert_same_solutions(one: SolveResult, other: SolveResult) -> None:
    """Both have the same solutions, to twelve digits."""
    assert len(one.solutions) == len(other.solutions)
    assert all(coincident(other.solutions.points, x, 1e-12).any() for x in one.solutions.points)


@pytest.mark.parametrize("name", ["cyclic-7", "noon-5", "kss-5", "caprasse"])
def test_one_path_of_each_orbit_leads_to_the_ends_of_all(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = benchmark(name)
    monkeypatch.setattr(starts, "MANY", 1 << 60)
    cells = mixed_cells(given.sparsest.supports, np.random.default_rng(0))
    plain = polyhedral(given.sparsest, cells, np.random.default_rng(1), 1)
    monkeypatch.setattr(starts, "MANY", 0)
    start = polyhedral(given.sparsest, cells, np.random.default_rng(1), 1)
    assert plain.known.orbits is None
    assert len(start.points) == len(plain.points) == cells.mixed_volume
    orbits = start.known.orbits
    assert orbits is not None
    assert len(orbits.chosen) < len(start.points)
    moved = np.take_along_axis(start.points[orbits.chosen][orbits.orbit], orbits.sources, axis=1)
    turned = (moved * orbits.signs * start.points.conj()).sum(axis=1)
    assert np.allclose(np.abs(turned), 1, atol=1e-12)


def test_answers_do_not_depend_on_symmetries_of_the_start(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    variables = [f"x{i}" for i in range(6)]
    sums = [
        " + ".join("*".join(variables[(i + k) % 6] for k in range(d)) for i in range(6))
        for d in range(1, 6)
    ]
    cyclic = system(" ".join(variables), *sums, "*".join(variables) + " - 1")
    for given in (cyclic, system("h1 h2 x1 x2 y1 y2", *TWICE)):
        monkeypatch.setattr(starts, "MANY", 1 << 60)
        plain = solve(given, start="polyhedral", seed=1)
        monkeypatch.setattr(starts, "MANY", 0)
        symmetric = solve(given, start="polyhedral", seed=1)
        assert plain.complete
        assert symmetric.complete
        assert_same_solutions(plain, symmetric)


def test_turns_keep_systems_of_their_supports() -> None:
    target, rng = benchmark("cyclic-6").sparsest, np.random.default_rng(5)
    turns = CoordinateTurns.of(target.supports)
    assert turns.elements.shape == (6, 6)
    rows = terms(target.supports, tuple(unit(rng, len(s)) for s in target.supports))
    y = unit(rng, 6)
    before = values(rows, y)
    for angles in turns.elements:
        factors = values(rows, y * np.exp(2j * np.pi * angles / turns.order)) / before
        assert np.allclose(np.abs(factors), 1, atol=1e-12)


@pytest.mark.parametrize("powers", [(2, 2), (2, 6), (4, 6), (3, 1)])
def test_turns_of_powers_are_products_of_those_of_each(powers: tuple[int, int]) -> None:
    support = np.concatenate([np.zeros((1, 2), dtype=np.int64), np.diag(powers)])
    turns = CoordinateTurns.of((support, support))
    # Most of these groups are not cyclic: they have more elements than the order of any.
    assert len(np.unique(turns.elements, axis=0)) == powers[0] * powers[1] == len(turns.elements)
    assert not ((turns.elements * powers) % turns.order).any()


def test_supports_that_no_turns_keep_have_the_identity_alone() -> None:
    line = np.array([[0, 0], [1, 0], [0, 1]])
    assert CoordinateTurns.of((line, line)).elements.tolist() == [[0, 0]]
    # Of lower rank: infinitely many turns.
    assert CoordinateTurns.of((line[:2], line[:2])).elements.tolist() == [[0, 0]]


def test_turned_solutions_of_binomials_are_all() -> None:
    target, rng = benchmark("cyclic-6").sparsest, np.random.default_rng(6)
    cells = mixed_cells(target.supports, rng)
    coefficients = tuple(unit(rng, len(s)) for s in target.supports)
    turns = CoordinateTurns.of(cells.supports)
    every, _ = binomial_solutions(cells, coefficients)
    some, owners = binomial_solutions(cells, coefficients, turns)
    assert len(some) * 6 == len(every) == cells.mixed_volume == len(owners) * 6
    points = np.concatenate([np.ones((len(some), 1)), np.exp(1j * some)], axis=1)
    images = turns.of_points(points)[:, 1:]
    assert all(coincident(images, np.exp(1j * x), 1e-10).any() for x in every)


@pytest.mark.parametrize(
    ("equations", "inside"),
    [
        (("x*y - 1", "x + y + 3"), True),
        (("x*y + x^2*y - 1", "x + y"), True),
        (("x*y + x - 1", "x + y"), False),
        (("x*y", "x + y - 1"), False),
        (("x^2 + 2*x - 3", "y^3 - y + 1"), True),
        (("x - 1", "y - x"), False),
    ],
)
def test_equations_say_where_no_coordinate_vanishes(
    equations: tuple[str, str], inside: bool
) -> None:
    assert Target.of(system("x y", *equations).polynomials, 2).in_torus is inside


@pytest.mark.parametrize("start", ["polyhedral", "monodromy"])
def test_equations_that_depend_on_each_other_leave_no_isolated_zeros(start: str) -> None:
    # No coordinate vanishes, and one row is zero.
    given = system("x y z", "x*y*z - 1", "x + y", "3*x + 3*y")
    assert Target.of(given.polynomials, 3).in_torus
    assert len(solve(given, start=start).solutions) == 0


def test_signs_are_those_of_balls_and_branches() -> None:
    sources, signs = np.array([0, 2, 1]), np.array([1, -1, 1], dtype=np.int8)
    centre = np.arange(12.0).reshape(3, 2, 2)
    moved = Ball(centre, np.array([1.0, 2.0, 3.0])).permute(sources, signs)
    assert moved.centre.tolist() == [
        centre[0].tolist(),
        (-centre[2]).tolist(),
        centre[1].tolist(),
    ]
    assert moved.radii.tolist() == [1.0, 3.0, 2.0]
    branch = PathBranch(2, (0, 1, 3), np.array([0, 0.5j, 2.0]), np.array([0, 1.0, 2.0]))
    image = branch.permute(sources, signs, ((0, 1, 2),))
    assert image.orders == (0, 3, 1)
    assert np.allclose(np.exp(image.logs), [1, -np.exp(2.0), np.exp(0.5j)])
    assert image.bends.tolist() == [0, 2.0, 1.0]
