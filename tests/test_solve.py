"""Solving: every isolated solution once, with its multiplicity; everything else said apart."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from systems import system

import nag
from nag.algebra.branches import search_branches
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose
from nag.errors import StartError
from nag.files.cases import read_case
from nag.mechanism.model import model
from nag.numerics import system_facts
from nag.numerics.coincidence import clusters, conjugates_present
from nag.solving.shown import answer_text
from nag.solving.solutions import SolveResult
from nag.solving.solve import solve

BENCHMARKS = Path(__file__).parent.parent / "cases" / "benchmarks"


def multiplicities(result: SolveResult) -> Counter[int]:
    return Counter(s.multiplicity for s in result.solutions)


def sorted_points(result: SolveResult) -> np.ndarray:
    points = result.points
    return points[np.lexsort((np.rint(points * 1e6)).T)]


@pytest.mark.parametrize(
    "name",
    [
        "griewank-osborne",
        "cbms1",
        "cbms2",
        "mth191",
        "kss-5",
        "caprasse",
        "planar-3-rpr",
        "inverse-6r",
        "inverse-6r-clustered",
        "chandra-8",
        "stewart-gough",
        "katsura-6",
        "cyclic-5",
        "noon-5",
        "eco-8",
    ],
)
def test_benchmarks_have_the_solutions_that_are_known(name: str) -> None:
    case = read_case(BENCHMARKS / f"{name}.toml")
    known: Counter[int] = Counter()
    for truth in case.truth:
        known[truth.multiplicity] += truth.count
    result = solve(case.system or model(case.mechanism).system, seed=1)
    assert multiplicities(result) == known
    assert result.complete
    assert result.paths.failed == 0
    assert max(s.residual for s in result.solutions) < 1e-14
    assert max(s.accuracy for s in result.solutions) < 1e-10


@pytest.mark.parametrize("start", ["auto", "total", "multihomogeneous", "polyhedral"])
def test_every_start_system_leads_to_the_same_solutions(start: str) -> None:
    f = system("x y", "x^2*y + 3*x*y - 2", "x*y^2 - 5*y + x + 1")
    result = solve(f, start=start, seed=3)
    assert result.complete
    reference = solve(f, start="total", seed=0)
    assert np.allclose(sorted_points(result), sorted_points(reference), atol=1e-9)


def test_solutions_on_coordinate_hyperplanes_are_solutions_like_others() -> None:
    f = system("x y z", "x*(x - 2)", "y*(x + y - 5)", "z*(z - x - 1)")
    wanted = {(x, y, z) for x in (0, 2) for y in (0, 5 - x) for z in (0, 1 + x)}
    for start in ("auto", "polyhedral", "total"):
        result = solve(f, start=start, seed=2)
        assert result.complete
        assert {tuple(np.rint(p.real)) for p in result.points} == wanted
        assert np.abs(result.points - np.rint(result.points.real)).max() < 1e-12


def test_a_multiple_solution_at_the_origin_has_its_multiplicity() -> None:
    for start in ("total", "polyhedral"):
        result = solve(system("x y", "x^2 + y^3", "y^2 - x^3"), start=start)
        origin = [s for s in result.solutions if np.abs(s.point).max() < 1e-10]
        assert [s.multiplicity for s in origin] == [4]
        assert sum(s.multiplicity for s in result.solutions) == 9
        assert result.complete


def test_as_many_zeros_as_the_mixed_volume_are_all(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("a path is followed to infinity")

    names = "w x y z"
    # Noonburg's system has 3^4 - 2 * 4 zeros.
    noon = [f"10*{v}*({names.replace(' ', '^2+')}^2 - {v}^2) - 11*{v} + 10" for v in names.split()]
    monkeypatch.setattr("nag.tracking.ends.follow.follow", refuse)
    result = solve(system(names, *noon), start="auto", seed=2)
    assert result.complete
    assert (len(result.solutions), result.paths.at_infinity) == (73, 8)
    assert result.reason.endswith("the mixed volume leaves no more than 73")


@pytest.mark.parametrize(
    ("equations", "start", "method"),
    [
        (("x^2*y - 1", "x + y^2 - 3"), "auto", "by_algebra"),
        (("x^2*y - 1", "x + y^2 - 3"), "total", "by_paths"),
        (("x^4 + y^2 - 1", "(x^4 - y^3*x + 3*x - 2)*(x*y^3 + x^3 + 7)"), "auto", "by_branches"),
    ],
)
def test_an_answer_names_the_method_that_made_it(
    equations: tuple[str, ...], start: str, method: str
) -> None:
    result = solve(system("x y", *equations), start=start)
    assert result.method == method


def test_what_is_known_of_a_system_is_not_worked_out_again(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[PolynomialSystem] = []

    def search(of: PolynomialSystem) -> object:
        asked.append(of)
        return search_branches(of)

    monkeypatch.setattr(system_facts, "search_branches", search)
    given = read_case(BENCHMARKS / "katsura-6.toml").system
    assert decompose(given).complete
    # The system is solved, and so is what is left of it on a plane, to see that it is finite.
    assert len(asked) == 2 and asked.count(given) == 1


def test_curves_are_told_apart_from_isolated_points() -> None:
    f = system("x y", "(x^2 + y^2 - 1)*(x - 2)", "(x^2 + y^2 - 1)*(y - 3)")
    result = solve(f, seed=1)
    assert np.allclose(result.points, [[2, 3]])
    assert result.positive_dimensional
    on = result.on_components
    assert np.abs((on**2).sum(axis=1) - 1).max() < 1e-6
    assert result.complete
    assert any("positive dimension" in note for note in result.notes)


def test_a_set_that_is_not_finite_is_said_to_be_so_at_its_first_point() -> None:
    f = system("x y z", "x^2 + y^2 - 2*z", "x*z + y - z - 1", "x^2 + y^2 - 3*z + x*z + y - 1")
    assert len(solve(f, seed=1).on_components) > 1
    result = solve(f, seed=1, finite=True)
    assert len(result.on_components) == 1
    assert result.positive_dimensional and not result.complete


def test_some_paths_tell_that_a_set_is_not_finite() -> None:
    # Ten quadrics through a linear space of dimension 4.
    rng, names = np.random.default_rng(1), [f"x{i}" for i in range(10)]

    def form() -> str:
        terms = [f"{c}*{name}" for c, name in zip(rng.integers(1, 10, 10), names, strict=True)]
        return " + ".join([*terms, "1"])

    equations = [" + ".join(f"{x}*({form()})" for x in names[4:]) for _ in names]
    result = solve(system(" ".join(names), *equations), seed=1, finite=True)
    assert result.positive_dimensional and not result.complete
    assert 8 <= result.paths.tracked <= 32


def test_what_must_not_vanish_is_seen_at_zeros_that_are_badly_conditioned(tmp_path) -> None:
    # A line-symmetric 6R, which moves, but for 1e-12: at most 16 closings (Primrose 1986).
    rows = [("1", "1/2", "1/3"), ("2", "1/3", "1/2"), ("3/2", "2", "-1/5")] * 2
    rows[5] = ("3/2+1/10^12", "2", "-1/5")
    joints = [f'{{a = "{a}", alpha_half_tangent = "{t}", d = "{d}"}}' for a, t, d in rows]
    path = tmp_path / "near.toml"
    path.write_text(f'title = "t"\nkind = "dh"\njoint = [{", ".join(joints)}]\n')
    result = solve(read_case(path).system)
    assert (len(result.solutions), result.excluded) == (16, 8)


def test_a_double_line_is_no_isolated_solution() -> None:
    result = solve(system("x y z", "x^2", "x*y + y^2", "z^2*y - y + x"), seed=1)
    assert result.solutions == ()
    assert result.positive_dimensional


def test_fewer_equations_than_variables_have_no_isolated_solution() -> None:
    result = solve(system("x y z", "x^2 + y^2 - 1", "z - x*y"), seed=0)
    assert result.solutions == ()
    assert len(result.on_components) == 4
    assert result.positive_dimensional


CURVE = [
    "(x + 2*y - 1)*({g}) + (z - 3)*({h})",
    "(2*x - z + 1)*({g}) + (y + 2)*({h})",
    "(y - z + 2)*({g}) + (x - y + 1)*({h})",
]


@pytest.mark.parametrize(
    ("nonzero", "counts"),
    [(("x - 5",), True), (("y - x^2",), False), (("x - 5", "(y - x^2)*(x + y)"), False)],
)
def test_a_curve_on_which_something_vanishes_that_must_not_is_no_solution_set(
    nonzero: tuple[str, ...], counts: bool
) -> None:
    of = system("x y z", *(f.format(g="y - x^2", h="x*z - y^2 + z") for f in CURVE))
    result = solve(replace(of, nonzero=system("x y z", *nonzero).polynomials))
    assert result.complete and result.positive_dimensional == counts
    assert result.perhaps_infinite == counts == ("positive dimension" in answer_text(result))
    assert len(result.on_components if counts else result.on_excluded) > 0


def test_whether_a_double_curve_is_excluded_may_be_undecided() -> None:
    of = system("x y z", *(f.format(g="(y - x^2)^2", h="z - x*y + 1") for f in CURVE))
    result = solve(replace(of, nonzero=system("x y z", "y - x^2").polynomials))
    assert not result.positive_dimensional and result.perhaps_infinite
    assert "could not be decided" in answer_text(result)
    assert any("was not decided" in note for note in result.notes)


@pytest.mark.parametrize(
    ("equations", "nonzero", "points"),
    [
        (["x*(y - 1)", "x*(y + x)"], "x", 1),
        (["x*(y - 1)", "x*(y + x)"], "y - 1", 0),
        (["x*y - z^2 + x"], "x*y - z^2 + x", 0),
        (["(y - x)*(y^2 - x^3 + 1)", "y - x"], "y^2 - x^2", 0),
    ],
)
def test_what_is_left_where_sets_of_positive_dimension_are_excluded(
    equations: list[str], nonzero: str, points: int
) -> None:
    result = solve(system("x y z" if "z" in nonzero else "x y", *equations, nonzero=(nonzero,)))
    answer = decompose(result.system)
    assert result.complete and answer.complete
    assert len(result.solutions) == points == sum(not c.dimension for c in answer.components)
    assert result.positive_dimensional == result.perhaps_infinite
    assert result.positive_dimensional == any(c.dimension for c in answer.components)


def test_overdetermined_systems_keep_only_common_solutions() -> None:
    f = system("x y", "x^2 + y^2 - 5", "x*y - 2", "x + y - 3")
    result = solve(f, seed=4)
    assert {tuple(np.round(p.real, 12)) for p in result.points} == {(1, 2), (2, 1)}
    assert result.complete
    assert len(result.real) == 2
    inconsistent = solve(system("x y", "x^2 + y^2 - 5", "x*y - 2", "x + y - 4"), seed=4)
    assert inconsistent.solutions == () and inconsistent.complete


def test_points_where_a_polynomial_must_not_vanish_are_excluded() -> None:
    f = system("x y", "x^2 - 3*x + 2", "y - x")
    x = Polynomial.variable(2, 0)
    result = solve(PolynomialSystem(f.variables, f.polynomials, nonzero=[x - 1]))
    assert np.allclose(result.points, [[2, 2]])
    assert result.excluded == 1


def test_constants_and_empty_systems_need_no_paths() -> None:
    assert solve(system("x", "x - x + 3")).solutions == ()
    assert solve(system("x", "x - x + 3")).complete
    assert len(solve(PolynomialSystem((), ())).solutions) == 1


def test_no_solutions_at_all() -> None:
    result = solve(system("x y", "x + y - 1", "x + y - 2"))
    assert result.solutions == () and not result.positive_dimensional and result.complete


def test_badly_scaled_systems_are_scaled() -> None:
    big = 10**9
    f = system("x y", f"x^2 - {big**2}", f"{big}*y^2*x - 4")
    result = solve(f, seed=2)
    assert len(result.solutions) == 4
    assert np.allclose(np.abs(result.points[:, 0]), big)
    assert np.allclose(np.abs(result.points[:, 1]), 2 / big)


def test_same_seed_same_answer_for_any_number_of_threads() -> None:
    f = read_case(BENCHMARKS / "katsura-7.toml").system
    one, two = solve(f, seed=5, threads=1), solve(f, seed=5, threads=2)
    assert one.points.tobytes() == two.points.tobytes()
    assert one.paths == two.paths
    assert [s.condition for s in one.solutions] == [s.condition for s in two.solutions]


def test_too_many_paths_are_refused_with_one_line() -> None:
    n = 12
    variables = [f"x{i}" for i in range(n)]
    x = Polynomial.variables(n)
    dense = sum(x, Polynomial.constant(n, 1))
    polynomials = [dense * (v - i) ** 4 + i + 2 for i, v in enumerate(x)]
    with pytest.raises(StartError, match="paths"):
        solve(PolynomialSystem(variables, polynomials), start="total")


def test_clusters_join_points_within_their_errors() -> None:
    points = np.array([[1, 2], [1 + 1e-9, 2], [1, 2.001], [1, 2 - 1e-9]], dtype=complex)
    groups = clusters(points, np.full(4, 1e-12))
    assert [g.tolist() for g in groups] == [[0, 1, 3], [2]]


def test_a_missing_conjugate_is_noticed() -> None:
    roots = np.array([[1 + 1j], [3], [1 - 1j], [2j], [-2j]])
    errors, simple = np.full(5, 1e-14), np.ones(5, dtype=int)
    real = roots[:, 0].imag == 0
    assert conjugates_present(roots, errors, simple, real)
    for missing in range(5):
        left = np.arange(5) != missing
        present = conjugates_present(roots[left], errors[left], simple[left], real[left])
        assert present == real[missing]
    assert not conjugates_present(roots, errors, np.array([2, 1, 1, 1, 1]), real)


def test_rational_solutions_are_found_to_rounding() -> None:
    half = Fraction(1, 2)
    x = Polynomial.variables(2)
    f = [(x[0] - half) * (x[0] - 3), (x[1] + half) * (x[1] - x[0])]
    points = sorted_points(solve(PolynomialSystem(("x", "y"), f)))
    wanted = {(0.5, -0.5), (0.5, 0.5), (3.0, -0.5), (3.0, 3.0)}
    assert {tuple(np.round(p.real, 12)) for p in points} == wanted


@pytest.mark.parametrize("gap", ["1/10^5", "1/10^6", "1/10^12", "1/10^20"])
def test_zeros_close_together_are_not_taken_for_a_double_one(gap: str) -> None:
    result = solve(system("x y", f"(x - 1)*(x - 1 - {gap})*(x + 2)", "(y - x)*(y + 3)"))
    assert all(s.multiplicity == 1 for s in result.solutions)
    assert len(result.solutions) == 6
    assert result.complete


@pytest.mark.parametrize("power", [8, 12, 20])
def test_close_roots_of_one_polynomial_are_not_taken_for_a_double_one(power: int) -> None:
    result = solve(system("x", f"x^{power} - (10*x - 1)^2"))
    assert all(s.multiplicity == 1 for s in result.solutions)
    assert len(result.solutions) == power
    assert result.complete


@pytest.mark.parametrize("seed", [0, 1])
def test_grids_of_all_sizes_are_found_whole(seed: int) -> None:
    first = "(x - 10^6)*(x - 1)*(x - 1/10^6)*(x + 3)"
    second = "(y - 10^6)*(y + 1/10^6)*(y - 2)*(x + y + 5)"
    result = solve(system("x y", first, second), seed=seed)
    assert result.complete
    assert len(result.solutions) == 16


@pytest.mark.parametrize("power", [9, 12, 15])
@pytest.mark.parametrize("seed", [0, 1])
def test_solutions_far_out_are_not_called_infinite(power: int, seed: int) -> None:
    result = solve(system("x y", f"x^3/10^{power} + x^2 - y - 1", "y^2 - x + 2"), seed=seed)
    assert result.complete
    assert len(result.solutions) == 6


@pytest.mark.parametrize("power", [6, 10, 14, 18])
def test_more_equations_than_unknowns_are_checked_exactly(power: int) -> None:
    result = solve(system("x y", "x^2 - 1", "y^2 - 1", f"x + y - 2 + 1/10^{power}"))
    assert result.complete
    assert len(result.solutions) == 0
    assert len(solve(system("x y", "x^2 - 1", "y^2 - 1", "x + y - 2")).solutions) == 1


def test_a_root_of_high_multiplicity_is_one_solution() -> None:
    result = solve(system("x", "x^12*(x - 1)"))
    assert result.complete
    assert sorted((s.multiplicity, round(s.point[0].real, 9)) for s in result.solutions) == [
        (1, 1.0),
        (12, 0.0),
    ]


def test_imaginary_parts_count_beside_the_error_of_their_own_coordinate() -> None:
    # Of two conjugate zeros x is 8e14, but for rounding real, and z is 7e-14 times i.
    found = nag.solve(
        [
            "100000*x^2*y*z^2 - 3/4*y^3 + 9/100",
            "15000*x*y^2 - 7/90*y^2*z - 90000",
            "1/125*x*y + 17/25000*y - 50000",
        ]
    )
    assert found.complete
    assert len(found.solutions) == 8
    assert sum(s.real for s in found.solutions) == 2
