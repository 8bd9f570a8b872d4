"""Families solved by loops of their parameters, one solution of each class, and confirmed."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from evaluated import values
from systems import family

import nag
from nag.algebra.family import Family
from nag.algebra.polynomial import Polynomial
from nag.algebra.rational_map import MapGroup, RationalMap
from nag.algebra.symmetric_family import SymmetricFamily
from nag.cli import main
from nag.errors import StartError
from nag.files.solutions_export import export_text
from nag.solving import solve_classes
from nag.solving.kantorovich import Confirmation
from nag.solving.parameter import solve_generic, solve_targets
from nag.solving.parameter_line import parameter_line
from nag.solving.solve_classes import ClassEnds, track_classes
from nag.solving.start.scalings import nearest_scaling, random_scaling, scaling_weights
from nag.tracking.paths import PathStatus

# Symmetric in x and y, and even.
EVEN = family(
    "x y", "a b c d", "x^4 + y^4 + a*x*y + b", "x^3*y + x*y^3 + c*(x^2 + y^2) + c^2*x*y + d"
)
TARGET = (Fraction(3), Fraction(-7), Fraction(1, 2), Fraction(5, 3))


def symmetric(of: Family) -> SymmetricFamily:
    names = Polynomial.variables(of.n + len(of.parameters))
    x, y = names[:2]
    one = Polynomial.constant(names[0].n, 1)
    maps = [RationalMap((y, x), (one, one)), RationalMap((-x, -y), (one, one))]
    return SymmetricFamily(of, MapGroup.generated(maps))


def sets_agree(first: np.ndarray, second: np.ndarray) -> bool:
    apart = np.linalg.norm(first[:, None] - second[None], axis=2)
    return len(first) == len(second) and apart.min(axis=0).max() < 1e-9 > apart.min(axis=1).max()


def test_loops_of_parameters_find_what_a_start_system_finds() -> None:
    expected = solve_generic(EVEN, seed=1)
    count = len(expected.points)
    assert expected.complete and count > 8
    (reference,) = solve_targets(expected, [TARGET])
    for given in (EVEN, symmetric(EVEN)):
        solved = solve_generic(given, start="parameter", count=count, seed=4)
        assert solved.complete and len(solved.points) == count
        (result,) = solve_targets(solved, [TARGET])
        assert result.complete
        assert sets_agree(result.points, reference.points)
        assert len(result.real) == len(reference.real)


def test_only_one_of_each_class_is_tracked() -> None:
    solved = solve_generic(symmetric(EVEN), seed=2)
    classes = len(solved.points) // 4
    (result,) = solve_targets(solved, [TARGET])
    assert solved.classes.members.shape == (4, classes, 2)
    assert result.paths.tracked == result.paths.regular == classes


@pytest.mark.parametrize("seed", range(4))
def test_loops_go_as_far_as_solutions_meet(seed: int) -> None:
    # Lengths of legs, squared, of a platform as large as 3: with lengths of about 1 none meet.
    platform = family(
        "x y c s",
        "k l m",
        "x^2 + y^2 - k",
        "(x + 23/17*c - 31/11)^2 + (y + 23/17*s)^2 - l",
        "(x + 7/9*c - 13/12*s - 19/14)^2 + (y + 7/9*s + 13/12*c - 37/16)^2 - m",
        "c^2 + s^2 - 1",
    )
    solved = solve_generic(platform, start="parameter", count=6, seed=seed)
    assert len(solved.points) == 6 and solved.complete


def test_without_a_known_number_loops_prove_nothing() -> None:
    solved = solve_generic(symmetric(EVEN), seed=2)
    assert not solved.complete
    (result,) = solve_targets(solved, [TARGET])
    assert not result.complete and "not known whether all" in result.notes[0]


def test_a_wrong_number_of_solutions_is_not_reached() -> None:
    solved = solve_generic(symmetric(EVEN), count=40, seed=2)
    assert not solved.complete


def test_the_answer_does_not_depend_on_threads() -> None:
    given = symmetric(EVEN)
    one, two = (solve_generic(given, seed=3, threads=threads) for threads in (1, 2))
    assert np.array_equal(one.points, two.points) and np.array_equal(one.values, two.values)


def test_what_is_lost_on_one_way_is_found_on_another(monkeypatch: pytest.MonkeyPatch) -> None:
    scaled = family(
        "x y", "a b c d", "x^4 + y^4 + a*x*y + b", "x^3*y + x*y^3 + c*(x^2 + y^2) + d*x*y + b"
    )
    solved = solve_generic(scaled, start="parameter", count=16, seed=1)
    assert solved.complete
    (expected,) = solve_targets(solved, [TARGET])
    ways = []

    def losing(*arguments: object) -> ClassEnds:
        ends = track_classes(*arguments)
        ways.append(ends)
        if len(ways) > 1:
            return ends
        status = ends.status.copy()
        status[5] = PathStatus.FAILED
        return replace(ends, status=status)

    monkeypatch.setattr(solve_classes, "track_classes", losing)
    (result,) = solve_targets(solved, [TARGET])
    assert len(ways) == 2 and result.complete
    assert sets_agree(result.points, expected.points)


def test_units_do_not_matter() -> None:
    lengths = family("x y", "a b c", "x^2 + y^2 - a", "x*y - b + c*x")
    solved = solve_generic(lengths, start="parameter", count=4, seed=1)
    for unit in (Fraction(1), Fraction(1, 10**8), Fraction(10**8)):
        (result,) = solve_targets(solved, [(25 * unit**2, 12 * unit**2 + 3 * unit**2, unit)])
        assert result.complete and len(result.solutions) == 4
        assert np.abs(result.points / float(unit) - [3, 4]).max(axis=1).min() < 1e-12


def test_solutions_that_meet_or_leave_are_not_counted() -> None:
    roots = family("x", "a b", "a*x^2 + x + b")
    solved = solve_generic(roots, start="parameter", count=2, seed=1)
    assert len(solved.points) == 2
    far, double, plain = solve_targets(
        solved,
        [
            (Fraction(0), Fraction(3)),
            (Fraction(1), Fraction(1, 4)),
            (Fraction(1), Fraction(-2)),
        ],
    )
    assert [s.point.real.round(12).tolist() for s in far.solutions] == [[-3.0]]
    assert far.complete and far.paths.at_infinity == 1
    assert len(double.solutions) == 0 and not double.complete
    assert sorted(plain.points.real.ravel().round(12)) == [-2.0, 1.0]


def test_a_line_of_parameters_has_the_systems_between() -> None:
    rng = np.random.default_rng(0)
    # Where a parameter enters in higher degree, the line's own parameter is one more unknown.
    for of, extra in ((EVEN, 1), (family("x", "a b", "x^2 - a*x + b"), 0)):
        k = len(of.parameters)
        first, second = rng.normal(size=(2, k)) + 1j * rng.normal(size=(2, k))
        line = parameter_line(of, first, second)
        assert 1 + of.n + extra == line.homotopy.N
        x = rng.normal(size=(1, of.n)) + 0j
        for t in (0.0, 0.3, 1.0):
            z = line.starts(x)
            z[:, 1 + of.n :] = t
            found = values(line.homotopy, z, t)[0]
            found[: of.n] *= line.homotopy.rows.scales
            between = t * first + (1 - t) * second
            wanted = [f([*x[0], *between], float) for f in of.polynomials]
            assert np.abs(found[: of.n] - wanted).max() < 1e-12
            assert not found[of.n :].any()


def test_scalings_carry_solutions_to_solutions() -> None:
    cubic = family("x y", "a b c", "x^2 + a*y - b", "x*y - c*a")
    weights = scaling_weights(cubic)
    rng = np.random.default_rng(1)
    # Lengths of x and of y; the equations say how a, b and c then change.
    assert len(weights) == 2
    z = rng.normal(size=5) + 0j
    z[3] = z[0] ** 2 + z[2] * z[1]
    z[4] = z[0] * z[1] / z[2]
    moved = z * random_scaling(weights, rng)
    assert max(abs(f(list(moved), float)) for f in cubic.polynomials) < 1e-12
    assert np.abs(moved - z).max() > 0.1
    near = nearest_scaling(weights, z[2:], moved[2:], rng)
    assert np.abs(near[2:] * z[2:] - moved[2:]).max() < 1e-9
    assert scaling_weights(family("x", "a", "x^2 + x + 1 - a")).shape == (0, 2)


def confirmed(of: Family, values: list[float], points: list[list[complex]]):
    return Confirmation(of)(np.array(points, dtype=complex), np.array(values, dtype=complex))


def test_regular_zeros_are_confirmed_and_double_ones_are_not() -> None:
    square = family("x", "a b", "x^2 - a*x + b")
    good = confirmed(square, [0.0, -2.0], [[1.4142], [-1.5]])
    assert good.regular.all() and (good.accuracy < 1e-14).all()
    assert np.abs(good.points.ravel() - [2**0.5, -(2**0.5)]).max() < 1e-15
    assert not confirmed(square, [2.0, 1.0], [[1.0], [1.001]]).regular.any()


def test_balls_of_close_zeros_hold_one_each() -> None:
    square = family("x", "a b", "x^2 - a*x + b")
    gap = 2.0**-20
    both = confirmed(square, [2 + gap, 1 + gap], [[1.0], [1 + gap]])
    assert both.regular.all()
    assert (both.isolation < gap).all()
    assert not both.same(both.points[::-1]).any()
    assert both.same(both.points).all()


@pytest.mark.parametrize("size", [1e-12, 1e-6, 1e6, 1e12])
def test_zeros_with_coordinates_of_all_sizes_are_confirmed(size: float) -> None:
    product = family("x y", "a b", "x*y - a", "x - b*y")
    x, y = 1 / (2 * size), size
    found = confirmed(product, [0.5, x / y], [[x * (1 + 1e-6), y * (1 - 1e-6)]])
    assert found.regular[0] and found.accuracy[0] < 1e-12
    assert abs(found.points[0, 0] / x - 1) < 1e-12 > abs(found.points[0, 1] / y - 1)


def test_zeros_with_vanishing_coordinates_are_confirmed() -> None:
    circle = family("x y", "a b", "x^2 + y^2 - a", "x*y - b")
    found = confirmed(circle, [2.0, 0.0], [[1.4142, 1e-9], [1e-5, -1.4142]])
    assert found.regular.all()
    assert np.abs(found.points - [[2**0.5, 0], [0, -(2**0.5)]]).max() < 1e-15
    assert not found.same(found.points[::-1]).any()
    assert not confirmed(circle, [0.0, 0.0], [[1e-9, 1e-9], [0.0, 0.0]]).regular.any()


def test_ill_conditioned_zeros_are_confirmed_in_more_digits() -> None:
    near = family("x y", "a b", "x + y - 2 + a*(x - 1)^2", "x + (1 + b)*y - 2 - b")
    found = confirmed(near, [1.0, 2.0**-30], [[1 + 1e-12, 1 - 1e-12]])
    assert found.regular[0] and found.precision[0] > 16
    assert np.abs(found.points - 1).max() < 1e-15


CASE = """
title = "Two circles"
kind = "system"
variables = ["x", "y"]
equations = ["x^2 + y^2 - p", "x*y - q"]
[parameters]
p = 5
q = 2
[family]
parameters = ["p", "q"]
solutions = 4
[[family.map]]
image = { x = "y", y = "x" }
"""


def test_the_command_solves_by_way_of_the_family(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    assert main(["solve", str(path), "--start", "parameter"]) == 0
    text = capsys.readouterr().out
    assert "4 isolated solutions, 4 real" in text and "2 classes of 2" in text
    path.write_text(CASE.replace("solutions = 4", "solutions = 6"))
    assert main(["solve", str(path), "--start", "parameter"]) == 1
    assert main(["solve", str(path), "--start", "total"]) == 0
    path.write_text(CASE.partition("[family]")[0])
    assert main(["solve", str(path), "--start", "parameter"]) == 2
    assert "is for a case with a [family]" in capsys.readouterr().err


THREE_QUADRICS = """
title = "Three quadrics"
kind = "system"
variables = ["x", "y", "z"]
equations = ["x^2 + y*z - p", "y^2 + x*z - 2", "z^2 + x*y - q*x - 3"]
[parameters]
p = 1
q = "1/2"
[family]
parameters = ["p", "q"]
"""


@pytest.mark.parametrize("known", ["", "solutions = 8\n"])
@pytest.mark.parametrize("start", ["auto", "parameter", "total"])
def test_a_case_with_a_family_is_solved_the_same_way_by_command_and_function(
    known: str, start: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, export = tmp_path / "case.toml", tmp_path / "export.json"
    path.write_text(THREE_QUADRICS + known)
    status = main(["solve", str(path), "--start", start, "--json", str(export), "--quiet"])
    by_function = nag.solve(nag.read_case(path), start=start)
    assert export.read_text() == export_text(by_function, "Three quadrics", path.name)
    assert status == (0 if by_function.complete else 1)
    by_loops = start == "parameter" or (start == "auto" and bool(known))
    assert by_function.reason.startswith("parameter homotopy") is by_loops
    assert by_function.system == nag.read_case(path).system


@pytest.mark.parametrize("claimed", [2, 4, 6])
def test_what_algebra_decides_needs_no_number_of_solutions_that_a_case_claims(
    claimed: int, tmp_path: Path
) -> None:
    path = tmp_path / "case.toml"
    path.write_text(CASE.replace("solutions = 4", f"solutions = {claimed}"))
    result = nag.solve(nag.read_case(path))
    assert result.complete and len(result.solutions) == 4


def test_loops_of_parameters_are_refused_where_there_is_no_family() -> None:
    with pytest.raises(StartError, match=r"^start: 'parameter' is for a case with"):
        nag.solve(["x^2 - 2"], start="parameter")


@pytest.mark.parametrize(
    ("equations", "given", "complete", "said"),
    [
        # The family's solutions fall into two sets of 5 and 2 that no loop connects.
        (("(x^2 - p*y + 1)*(x*y - q)", "y^2*x - x - p"), 5, False, "7 are counted modulo primes"),
        (("x^2 + y^2 - p", "3*x*y - q"), 4, True, "Bezout's bound agrees"),
        (("x^2*y - p", "x*y^2 - q + x"), 4, True, "a count modulo two primes agrees"),
        # Beside the line x = 0 nothing counts isolated zeros.
        (("x*(x - p)", "x*(y - q)"), 1, True, "rests on the given number of solutions, 1, not"),
    ],
)
def test_a_number_of_solutions_that_a_case_gives_is_checked_or_said_not_to_be(
    equations: tuple[str, str], given: int, complete: bool, said: str, tmp_path: Path
) -> None:
    text = THREE_QUADRICS.replace('["x", "y", "z"]', '["x", "y"]') + f"solutions = {given}\n"
    lines = [f"equations = {list(equations)}" if "equations" in x else x for x in text.split("\n")]
    path = tmp_path / "case.toml"
    path.write_text("\n".join(lines))
    result = nag.solve(nag.read_case(path), start="parameter")
    assert len(result.solutions) == given and result.complete is complete
    assert said in " ".join((result.reason, *result.notes))
    # Many members are judged as one is.
    members = nag.solve_family(path, values={"p": [3, 5], "q": [2, 7]})
    assert members.counts.tolist() == [given] * 2
    assert members.complete.tolist() == [complete] * 2
    assert said in " ".join((members.start.detail, *members.start.notes))


@pytest.mark.parametrize("count", [-1, 0, 2.5, "foo"])
def test_a_number_of_solutions_is_a_whole_number(count: object) -> None:
    for how in ({"start": "parameter"}, {"known": ([1], [[1], [-1]])}):
        with pytest.raises(nag.NagError, match=r"^count: .* is given; give a whole number from 1"):
            nag.solve_family("x^2 - a", ["a"], [[1]], count=count, **how)


def test_a_number_that_is_too_small_makes_no_member_complete() -> None:
    known = ([1], [[1]])
    for how in ({"start": "parameter"}, {"known": known}):
        found = nag.solve_family("x^2 - a", ["a"], [[1], [2]], count=1, **how)
        assert not found.complete.any()
        assert "2 are counted modulo primes" in found.start.notes[0]
