"""Tubes hold the paths that they are proved for, and no path changes from one to another."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import nag
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.cli import main
from nag.decomposition.decompose import decompose
from nag.files.cases import read_case
from nag.files.export import export_of, write_decomposition
from nag.files.json_schema import schema
from nag.files.solutions_export import write_solutions
from nag.numerics.discs import DiscPolynomials, Discs
from nag.solving.certified_paths import prove_paths
from nag.solving.solve import solve
from nag.tracking.certified_paths import are_distinct, certified_paths, prove_zeros_near
from nag.tracking.compiled import CompiledRows
from nag.tracking.homotopy import Homotopy
from nag.tracking.moving_discs import MovingSystem, series_product, values_along
from nag.tracking.settings import Settings
from nag.tracking.track import track
from nag.witness.certified_loops import prove_all, prove_monodromy
from nag.witness.moving import witness_at

CASES = Path(__file__).parents[1] / "cases"
x, y = Polynomial.variables(2)

coefficients = st.lists(st.fractions(-9, 9, max_denominator=64), min_size=3, max_size=3)
parameters = st.fractions(-1, 1, max_denominator=32)


def series(values: list[Fraction]) -> Discs:
    """Real numbers, exact in doubles, as a series for one point in one variable."""
    return Discs(np.array(values, dtype=complex)[:, None, None], np.zeros((3, 1, 1)))


def within(value: Fraction, found: Discs, s: Fraction) -> bool:
    """Whether a real number is one that a series has at s."""
    mid = [Fraction(c.real) for c in found.mid.ravel()]
    room = sum(Fraction(r) * abs(s) ** k for k, r in enumerate(found.rad.ravel()))
    return abs(sum(c * s**k for k, c in enumerate(mid)) - value) <= room


def value(values: list[Fraction], s: Fraction) -> Fraction:
    return sum((Fraction(float(c)) * s**k for k, c in enumerate(values)), start=Fraction(0))


@given(coefficients, coefficients, parameters)
def test_a_product_of_series_holds_the_exact_products(a, b, s) -> None:
    a, b = ([float(c) for c in v] for v in (a, b))
    assert within(value(a, s) * value(b, s), series_product(series(a), series(b)), s)


@given(coefficients, parameters)
def test_a_polynomial_of_a_series_holds_the_exact_values(a, s) -> None:
    a = [float(c) for c in a]
    (z,) = Polynomial.variables(1)
    f = z**3 / 7 - 5 * z**2 + Fraction(1, 3)
    system = DiscPolynomials.of([f], np.zeros((0, 2), dtype=complex))
    assert within(f([value(a, s)]), values_along(system, series(a)), s)


def avoided(gap: Fraction) -> Homotopy:
    """``x = t +- sqrt((t - 1/2)^2 + gap^2)``: two paths that come close to each other and part."""
    fixed = {(0, 2): Fraction(1), (2, 0): -Fraction(1, 4) - gap**2}
    moving = {(1, 1): Fraction(-2), (2, 0): Fraction(1)}
    rows = CompiledRows(2, (((0, fixed), (1, moving)),), ((0, 1),), (0,), np.array([[2]]))
    return Homotopy(rows, factors=((1.0, 0.0), (0.0, 1.0)))


def ends_of(gap: Fraction, t: int) -> np.ndarray:
    root = float(Fraction(1, 4) + gap**2) ** 0.5
    return np.array([[1, t + root], [1, t - root]], dtype=complex)


GAP = Fraction(1, 200)
CHART = np.array([[1.0, 0.0]], dtype=complex)


def test_a_tracker_with_long_steps_jumps_where_tubes_do_not() -> None:
    homotopy = avoided(GAP)
    system = MovingSystem.of(homotopy, CHART)
    starts = prove_zeros_near(system, ends_of(GAP, 1), 1.0)
    assert are_distinct(starts)
    found = certified_paths(system, starts)
    assert found.reached.tolist() == [0.0, 0.0]
    known = prove_zeros_near(system, ends_of(GAP, 0), 0.0)
    assert found.ends.same(known).all()
    # The same paths with steps that nothing holds back.
    careless = Settings(
        tolerance=1.0, contraction=1.0, newton=1.0, floor=1.0, radius_factor=100.0, safety=1.0,
        order=1, radius=0.0, digits=16, retries=0,
    )  # fmt: skip
    jumped = track(homotopy, ends_of(GAP, 1), careless, endgame=False)
    ends = jumped.points[:, 1] / jumped.points[:, 0]
    exact = ends_of(GAP, 0)[:, 1]
    assert np.abs(ends[0] - exact[0]) < 1e-6
    assert np.abs(ends[1] - exact[0]) < 1e-6


def test_paths_that_meet_are_not_proved_beyond_where_they_do() -> None:
    system = MovingSystem.of(avoided(Fraction(0)), CHART)
    starts = prove_zeros_near(system, ends_of(Fraction(0), 1), 1.0)
    found = certified_paths(system, starts)
    assert (found.reached > 0.5).all()
    assert (found.reached < 0.51).all()


def test_a_double_zero_and_what_is_no_zero_are_not_located() -> None:
    system = MovingSystem.of(avoided(Fraction(0)), CHART)
    points = np.array([[1, 0.5], [1, 0.25]], dtype=complex)
    assert not prove_zeros_near(system, points, 0.5).proved.any()


def test_all_paths_of_katsura_are_proved_and_lead_to_all_solutions() -> None:
    result = solve(read_case(CASES / "benchmarks" / "katsura-6.toml").system)
    proved = prove_paths(result)
    assert proved.distinct
    assert (proved.arrived, proved.followed, proved.lost) == (64, 0, 0)
    assert sorted(proved.ends.tolist()) == list(range(64))


def test_paths_to_infinity_end_in_no_solution() -> None:
    # Circle and cubic go through the two circular points at infinity, where they are transversal.
    circle, cubic = x**2 + y**2 - 3, x * (x**2 + y**2) + x**2 - 2 * y**2 + y - 5
    proved = prove_paths(solve(PolynomialSystem(("x", "y"), (circle, cubic)), start="total"))
    assert (proved.arrived, proved.followed, proved.lost) == (6, 0, 0)
    assert sorted(proved.ends.tolist()) == [-1, -1, 0, 1, 2, 3]


def test_paths_to_singular_ends_are_proved_to_the_endgame_only() -> None:
    # Five of the six zeros by Bezout's number come together at infinity.
    system = PolynomialSystem(("x", "y"), (y - x**2, x * (y - x**2) - x + 2))
    proved = prove_paths(solve(system, start="total"))
    assert (proved.arrived, proved.followed, proved.lost) == (1, 5, 0)
    assert proved.solutions.tolist() == [0]


def test_loops_prove_that_the_curves_of_a_rhombus_are_irreducible() -> None:
    system = read_case(CASES / "rhombus.toml").system
    for component in decompose(system).components:
        proved = prove_monodromy(system, component, np.random.default_rng(1))
        assert proved.connected
        assert [1, 0] in [places.tolist() for places in proved.permutations]


def test_points_of_two_curves_are_never_connected() -> None:
    first, second = x**2 + y**2 - 1, x**2 + 2 * y**2 - 3
    system = PolynomialSystem(("x", "y"), (first * second,))
    curves = decompose(system).components
    cut = curves[0].slice
    points = []
    for f in (first, second):
        single = PolynomialSystem(("x", "y"), (f,))
        points.append(witness_at(single, decompose(single).components[0], cut).points)
    together = np.vstack(points)
    both = replace(
        curves[0],
        points=together,
        radii=np.full(together.shape, 1e-15),
        digits=np.full(len(together), 16),
        fibres=(),
    )
    proved = prove_monodromy(system, both, np.random.default_rng(0), most=2)
    assert not proved.connected
    assert len(proved.permutations) == 2
    for places in proved.permutations:
        assert {p // 2 for p in places[:2]} == {0}
        assert {p // 2 for p in places[2:]} == {1}


def test_the_command_proves_paths_of_exports_of_both_kinds(tmp_path: Path, capsys) -> None:
    system = PolynomialSystem(("x", "y"), (x**2 + y**2 - 2, x * y**2 - 1))
    solved, decomposed = tmp_path / "solved.json", tmp_path / "decomposed.json"
    write_solutions(solve(system, start="total"), solved)
    write_decomposition(decompose(PolynomialSystem(("x", "y"), (x * y - 1,))), decomposed)
    for export, line in (
        (solved, "6 of 6 proved from t = 1 on"),
        (decomposed, "1 of 1 components are proved to lie on one irreducible"),
    ):
        target = tmp_path / f"certificate-{export.name}"
        assert main(["certify", str(export), "--paths", "--json", str(target)]) == 0
        assert line in capsys.readouterr().out
        jsonschema.validate(json.loads(target.read_text()), schema("nag-certificate"))


@pytest.mark.parametrize("command", ["solve", "decompose"])
def test_a_system_without_paths_says_so(command: str, tmp_path: Path, capsys) -> None:
    case = tmp_path / "case.toml"
    case.write_text(
        'title = "t"\nkind = "system"\nvariables = ["x", "y"]\nequations = ["x*y - 1"]\n'
    )
    status = main([command, str(case), "--certify-paths", "--quiet"])
    text = capsys.readouterr().out
    assert status == (1 if command == "solve" else 0)
    assert ("fewer equations than variables" in text) == (command == "solve")


def test_a_point_that_is_no_solution_is_the_end_of_no_path() -> None:
    result = solve(nag.system(["x^3 - 2*y^2 + 1", "y^3 + x*y - 3"]))
    assert len(prove_paths(result).solutions) == 9
    for off in (1e-3, 0.3):
        first, *others = result.solutions
        moved = replace(result, solutions=(replace(first, point=first.point + off), *others))
        assert prove_paths(moved).solutions.tolist() == list(range(1, 9))


def test_a_point_off_a_curve_is_connected_with_none() -> None:
    answer = decompose(nag.system(["x*y - z", "x*z - 1"]))
    assert prove_all(answer)[0].connected
    written = answer.document()
    written["components"][0]["points"][0][0][0] += 1e-3
    assert not prove_all(export_of(written).decomposition)[0].connected
