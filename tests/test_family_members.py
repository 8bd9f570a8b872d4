"""Many members of a family, solved together: as each by itself, complete where that is known."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pytest
from hypothesis import given
from hypothesis import strategies as st
from systems import family

import nag
from nag.cli import main
from nag.files.member_values import read_member_values
from nag.numerics.double_sums import ComplexSums, RealSums
from nag.solving.family_members import solve_members
from nag.solving.member_lines import MemberLines
from nag.solving.parameter import solve_generic, solve_targets
from nag.tracking.paths import PathStatus

CONICS = family("x y", "a b c", "x^2 + a*x*y + b*y^2 - 1", "c*x^2 + (a^2 + b)*y - 2")
SQUARES = family("x", "a b", "x^2 - 2*a*x + b")
CASE = """
title = "Conic and line"
kind = "system"
variables = ["x", "y"]
equations = ["x^2 + y^2 - r", "x - a*y"]
[parameters]
r = 2
a = 1
[family]
parameters = ["r", "a"]
solutions = 2
"""
doubles = st.floats(-1e6, 1e6).filter(lambda x: x == 0 or abs(x) > 1e-60)


def distances(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Of all points of one set from all of the other, relative to their sizes."""
    apart = np.linalg.norm(first[:, None] - second[None], axis=2)
    return apart / (1 + np.linalg.norm(first, axis=1))[:, None]


def fractions(row: np.ndarray) -> list[Fraction]:
    return [Fraction(v) for v in row.tolist()]


@pytest.mark.parametrize("seed", range(5))
def test_members_have_the_solutions_that_each_has_by_itself(seed: int) -> None:
    solved = solve_generic(CONICS, seed=seed)
    values = np.random.default_rng(seed).standard_normal((25, 3))
    found = solve_members(solved, values)
    assert found.points.shape == (25, 4, 2) and found.complete.all()
    for k, (own,) in enumerate(solve_targets(solved, [fractions(row)]) for row in values):
        apart = distances(own.points, found.at(k))
        assert apart.shape == (4, 4)
        assert max(apart.min(axis=0).max(), apart.min(axis=1).max()) < 1e-12


def test_answers_depend_neither_on_other_members_nor_on_threads() -> None:
    solved = solve_generic(CONICS, seed=1)
    values = np.random.default_rng(1).standard_normal((2100, 3))
    one, two = (solve_members(solved, values, threads=threads) for threads in (1, 2))
    backwards = solve_members(solved, values[::-1])
    for name in ("points", "status", "errors", "one_by_one", "complete"):
        assert np.array_equal(getattr(one, name), getattr(two, name), equal_nan=True)
        turned = getattr(backwards, name)[::-1]
        assert np.array_equal(getattr(one, name), turned, equal_nan=name == "points")


@pytest.mark.parametrize("imaginary", ["", "*I"])
@pytest.mark.parametrize("seed", range(3))
def test_members_with_infinitely_many_solutions_have_the_isolated_ones(
    seed: int, imaginary: str
) -> None:
    values = np.random.default_rng(seed).standard_normal((40, 2))
    # A circle, and four points beside it.
    conics = [f"x^2 - a*y - b{imaginary}", "y^2 - b*x - 7"]
    equations = [f"(x^2 + y^2 - 1)*({conic})" for conic in conics]
    found = nag.solve_family(equations, "a b", values, variables="x y", seed=seed)
    assert found.complete.all() and not found.one_by_one.any()
    expected = nag.solve_family(conics, "a b", values, variables="x y", seed=seed)
    assert found.points.shape == expected.points.shape == (40, 4, 2)
    for k in range(40):
        apart = distances(expected.at(k), found.at(k))
        assert max(apart.min(axis=0).max(), apart.min(axis=1).max()) < 1e-12


def test_columns_of_no_parameter_are_refused_by_their_place(tmp_path: Path) -> None:
    table = tmp_path / "values.csv"
    table.write_text("a,b\n1,2\n")
    with pytest.raises(nag.InputError, match=r"values\.csv: line 1: 'b' does not occur"):
        nag.solve_family(["x^2 - a"], values=table)


def test_what_does_not_end_regularly_is_solved_by_itself() -> None:
    # Two roots, a double root, and one that is as good as one in doubles.
    values = [[2.0, 3.0], [1.0, 1.0], [1.0, 1.0 - 2.0**-50]]
    found = solve_members(solve_generic(SQUARES, seed=2), values)
    assert found.one_by_one.tolist()[:2] == [False, True]
    assert found.complete.all() and found.counts.tolist() == [2, 1, 2]
    assert found.status[1].tolist() == [PathStatus.SINGULAR, PathStatus.AT_INFINITY]
    assert np.isnan(found.points[1, 1]).all() and np.isinf(found.errors[1, 1])
    assert np.allclose(np.sort(found.at(2).real.ravel()), [1 - 2.0**-25, 1 + 2.0**-25], rtol=1e-14)


@pytest.mark.parametrize("size", [1e14, 1e16, 1e300, 1e-200, 1e14j])
def test_a_member_far_from_random_parameters_is_solved_without_its_family(size: complex) -> None:
    found = nag.solve_family(["x^2 - a", "x*y + y^2 - 2*x"], ["a"], [[size], [2.0]])
    assert found.complete.all() and found.counts.tolist() == [4, 4]
    roots = found.points[0, :, 0] / np.sqrt(complex(size))
    assert np.allclose(np.sort(roots.real), [-1, -1, 1, 1], rtol=1e-14)
    assert np.abs(roots.imag).max() < 1e-14


def test_members_with_fewer_solutions_are_complete_without_the_others() -> None:
    found = nag.solve_family("a*x^2 - 2*x + b", ["a", "b"], [[1, -3], [0, 4]], seed=1)
    assert found.counts.tolist() == [2, 1] and found.complete.all()
    assert found.at(1).tolist() == [[2]] and found.status[1, 1] == PathStatus.AT_INFINITY


def test_points_of_a_curve_are_no_isolated_solutions() -> None:
    # Where a = 0 both equations are the same line.
    found = nag.solve_family(["x + y - 1", "a*(x^2 - y) + x + y - 1"], ["a"], [[0], [1]], seed=3)
    assert found.complete.tolist()[1] and found.counts.tolist() == [0, 2]
    assert found.one_by_one.tolist() == [True, False]


@pytest.mark.parametrize("size", [1e-5, 1e-10, 1e-17, 1e-100])
def test_solutions_of_small_members_are_real_where_those_of_large_ones_are(size: float) -> None:
    circles = ["x^2 + y^2 = r^2", "x = d"]
    found = nag.solve_family(circles, ["r", "d"], [[size, 2 * size], [2 * size, size]])
    assert found.real_counts.tolist() == [0, 2] and found.complete.all()
    assert len(found.real(0)) == 0 and len(found.to_dataframe(real=True)) == 2


@pytest.mark.parametrize("a", [-1e-17, -1e-10, -1e-24, 1e-17, 1e-24])
def test_close_solutions_are_real_as_they_are_of_each_member_by_itself(a: float) -> None:
    found = nag.solve_family("(x - 5)^2 = a", ["a"], [[a]])
    own = nag.solve([f"(x - 5)^2 = {Fraction(a)}"])
    assert found.counts.tolist() == [len(own)] == [2]
    assert found.real_counts.tolist() == [len(own.real)] == [2 if a > 0 else 0]


@pytest.mark.parametrize("r", [4.0, 1e-20, -1e-20, -1e-26])
def test_a_solution_whose_conjugate_may_be_missing_is_real_within_its_error(r: float) -> None:
    found = nag.solve_family(["x = d", "y^2 = r"], "d r", [[1, r]], known=([1, 1], [[1, 1]]))
    assert not found.complete[0] and found.counts.tolist() == [1]
    assert found.real_counts.tolist() == [int(r > 0)]


@pytest.mark.parametrize("a", [1e-12, 1e-15, 1e-17, 0])
def test_solutions_of_complex_members_are_real_as_exact_equations_say(a: float) -> None:
    found = nag.solve_family("(x - 5)*(x - 6 - a)", ["a"], [[1j * a], [1]])
    assert found.real_counts.tolist() == [1 if a else 2, 2] and not found.one_by_one.any()


@pytest.mark.parametrize(
    ("equations", "values", "counts", "infinite"),
    [
        (["(x - a)*(y - 1)", "(x - 1)*(y - b)"], [[1, 1], [2, 3], [1, 2]], [0, 2, 0], [1, 0, 1]),
        # General members have no solutions at all.
        (["x - a", "x - b + 0*y"], [[1, 1], [2, 3]], [0, 0], [1, 0]),
        # All members have a line.
        (["x*(y - a)", "x*(y^2 - b - x)"], [[2, 3], [5, 7]], [1, 1], [1, 1]),
    ],
)
def test_members_with_a_set_of_positive_dimension_are_told(
    equations: list[str], values: list[list[int]], counts: list[int], infinite: list[int]
) -> None:
    found = nag.solve_family(equations, ["a", "b"], values, variables="x y")
    assert found.counts.tolist() == counts and found.complete.all()
    assert found.positive_dimensional.tolist() == infinite
    texts = [equation.replace("a", "({})").replace("b", "({})") for equation in equations]
    for (a, b), expected in zip(values, infinite, strict=True):
        own = nag.solve([texts[0].format(a), texts[1].format(b)], "x y")
        assert own.positive_dimensional == expected
    members = found.document()["members"]
    assert [each["positive_dimensional"] for each in members] == infinite
    told = f"; {sum(infinite)} with a set of positive dimension besides"
    assert told in repr(found) and told in str(found)
    numbers = [k + 1 for k, each in enumerate(infinite) if each]
    assert f"member{'s' * (len(numbers) > 1)} {', '.join(map(str, numbers))}" in str(found)
    frame = found.to_dataframe()
    assert frame["positive_dimensional"].tolist() == np.repeat(infinite, counts).tolist()
    each = found.to_dataframe(members=True)
    assert each["member"].tolist() == list(range(len(values))) and each["a"].dtype == float
    assert each.drop(columns=["member", "a", "b"]).to_dict("records") == members


def test_the_command_names_members_with_a_set_of_positive_dimension(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, table = tmp_path / "lines.toml", tmp_path / "values.csv"
    nag.write(nag.system(["(x - a)*(y - 1)", "(x - 1)*(y - b)"], "x y a b"), case)
    table.write_text("a,b\n1,1\n2,3\n1,2\n")
    assert main(["family", str(case), "--values", str(table)]) == 0
    told = "members 1, 3 have a solution set of positive dimension besides"
    assert told in capsys.readouterr().out


def test_members_keep_the_index_of_a_frame() -> None:
    frame = pandas.DataFrame({"a": [4.0, 9.0, 0.0], "b": [1, 2, 3]}, index=[2, 0, 1])
    found = nag.solve_family(["x^2 - a", "y - b"], values=frame)
    table = found.to_dataframe(real=True)
    assert table["member"].tolist() == [2, 2, 0, 0, 1] and table["member"].dtype == np.int64
    joined = table.join(frame.add_suffix("_given"), on="member")
    assert joined["a"].tolist() == joined["a_given"].tolist()
    # Python's indices are places, as of any sequence.
    assert np.allclose(np.sort(found.real(0)[:, 0]), [-2, 2])
    named = nag.solve_family("x^2 = a", "a", pandas.Series([1, 4], name="a", index=["p", "q"]))
    assert named.to_dataframe()["member"].tolist() == ["p", "p", "q", "q"]
    plain = nag.solve_family("x^2 = a", "a", [1, 4]).to_dataframe()
    assert plain["member"].tolist() == [0, 0, 1, 1]
    wrong = pandas.Series([1, np.nan], name="a", index=["p", "q"])
    with pytest.raises(nag.NagError, match="those of member 2, q in the index, are not all finite"):
        nag.solve_family("x^2 = a", "a", wrong)


def test_nothing_is_complete_where_the_family_is_not_known_to_be() -> None:
    solved = solve_generic(CONICS, start="parameter", seed=1)
    assert not solved.complete
    values = np.random.default_rng(1).standard_normal((3, 3))
    assert not solve_members(solved, values).complete.any()


def test_a_known_member_is_a_start() -> None:
    roots = nag.solve_family(
        "x^2 - s", ["s"], [[4], [-9]], known=([1], [[1], [-1]]), count=2, seed=4
    )
    assert roots.complete.all()
    assert sorted(roots.real(0).ravel().tolist()) == [-2, 2]
    assert len(roots.real(1)) == 0 and np.allclose(abs(roots.at(1)), 3, rtol=1e-15)
    with pytest.raises(nag.StartError, match="1 of 1 solutions are not regular"):
        nag.solve_family("x^2 - s", ["s"], [[4]], known=([0], [[0]]))


def test_parameters_may_be_complex_and_of_very_different_sizes() -> None:
    values = np.array([[1e-9, 3e7], [2e5 + 1j, 1e-3j]])
    found = nag.solve_family("a*x^2 - b", ["a", "b"], values, seed=5)
    assert found.complete.all()
    expected = np.sqrt(values[:, 1] / values[:, 0])
    assert np.allclose(found.points[..., 0] ** 2, expected[:, None] ** 2, rtol=1e-14)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"values": 1.0}, r"values: have shape \(\)"),
        ({"values": [[float("nan")]]}, "values: those of member 1 are not all finite"),
        ({"values": "ab"}, "ab: cannot be read"),
        ({"values": ["a", "b"]}, "values: column 1: unknown name 'a'"),
        ({"equations": ["x^2 - s", "x"]}, "2 equations for 1 unknown: x"),
        ({"parameters": ["t"]}, "parameters: 't' does not occur"),
        ({"equations": ["x^2 - I*s", "x"], "variables": ["x"]}, "2 equations for 1 unknown: x"),
    ],
)
def test_what_does_not_fit_is_said(change: dict, message: str) -> None:
    asked = {"equations": "x^2 - s", "parameters": ["s"], "values": [[1]], **change}
    with pytest.raises(nag.NagError, match=message):
        nag.solve_family(**asked)


def test_factors_of_members_are_those_of_the_exact_coefficients() -> None:
    values = np.array([[0.1, 1 / 3, -7.0], [1e10, 1e-10, 3.7]])
    lines = MemberLines(family("x", "a b c", "(a - b)^3*x^2 + (a*b*c - 1/7)*x + 1"), np.ones(3))
    line = lines.to(values.astype(complex))
    members, rows = line.homotopy.members, line.homotopy.rows
    for row, factors, rest in zip(values, members.factors, members.rest, strict=True):
        a, b, c = fractions(row)
        wanted = {2: (a - b) ** 3, 1: a * b * c - Fraction(1, 7), 0: Fraction(1)}
        found: dict[int, Fraction] = {}
        sizes: dict[int, Fraction] = {}
        for p, terms in rows.parts[0]:
            for e, coefficient in terms.items():
                if e[2] == 0:
                    value = Fraction(factors[p, 0].real) + Fraction(rest[p].real)
                    found[e[1]] = found.get(e[1], 0) + coefficient * value
                    sizes[e[1]] = sizes.get(e[1], 0) + abs(coefficient * value)
        scale = found[0] / wanted[0]
        for e, value in wanted.items():
            assert abs(found[e] - scale * value) <= Fraction(1, 10**29) * sizes[e]


@given(a=doubles, b=doubles, c=doubles, d=doubles)
def test_sums_of_two_doubles_have_twice_the_digits(a: float, b: float, c: float, d: float) -> None:
    def exact(x: RealSums) -> Fraction:
        return Fraction(float(x.high[0])) + Fraction(float(x.low[0]))

    first, second = (ComplexSums.of(np.array([complex(*z)])) for z in ((a, b), (c, d)))
    product, total = first * second, first + second
    a, b, c, d = map(Fraction, (a, b, c, d))
    size = abs(a * c) + abs(b * d) + abs(a * d) + abs(b * c)
    assert abs(exact(product.real) - (a * c - b * d)) <= size / 10**30
    assert abs(exact(product.imaginary) - (a * d + b * c)) <= size / 10**30
    assert exact(total.real) == pytest.approx(a + c, rel=1e-30)
    assert abs(exact(total.real) - (a + c)) <= (abs(a) + abs(c)) / 10**30


def test_the_command_writes_arrays_and_counts(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, table = tmp_path / "case.toml", tmp_path / "values.csv"
    case.write_text(CASE)
    # A parameter without a column has the value of the case.
    table.write_text("a\n1\n0.5\n-7\n")
    words = ["family", str(case), "--values", str(table), "--quiet"]
    points, document = tmp_path / "points.npz", tmp_path / "answer.json"
    assert main([*words, "--points", str(points), "--json", str(document)]) == 0
    assert "complete   3 of 3 members" in capsys.readouterr().out
    with np.load(points, allow_pickle=False) as arrays:
        assert arrays["points"].shape == (3, 2, 2) and arrays["complete"].all()
        x, y = arrays["points"][2].T
        assert np.allclose(x, -7 * y) and np.allclose(x**2 + y**2, 2)
    assert [each["real"] for each in json.loads(document.read_text())["members"]] == [2, 2, 2]
    array = tmp_path / "values.npy"
    np.save(array, np.array([[0.0, 1.0], [1.0, 0.0]]))
    words[3] = str(array)
    assert main(words) == 0
    assert "1 member has fewer than 2 solutions" in capsys.readouterr().out


def test_values_in_a_table_are_read_as_in_a_case(tmp_path: Path) -> None:
    texts = {
        "1/3": 1 / 3,
        "sqrt(2)": 2**0.5,
        "0.1": 0.1,
        " -7e-3": -7e-3,
        "2*cos(pi/3)": 1.0,
        "(1+2j)": 1 + 2j,
        "1/3 + I/2": 1 / 3 + 0.5j,
        "1 + 2*I": 1 + 2j,
    }
    table = tmp_path / "values.csv"
    table.write_text("".join(f"{text}\n" for text in ["a", *texts]))
    assert read_member_values(table, ["a"], [0])[:, 0].tolist() == list(texts.values())


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "is empty; its first line names parameters, of r, a"),
        ("r,b\n1,2\n", "line 1: 'b' is no parameter of the family"),
        ("r,r\n1,2\n", "line 1: 'r' is there twice"),
        ("r,a\n1\n", "line 2: 1 values, not 2"),
        ("r\nx\n", "line 2: 'x' is no number; write 0.5, or as in a case 1/3, sqrt(2), 1 + 2*I"),
        ("r\n1/0\n", "line 2: '1/0' is no number"),
        ("r,a\n1,9^9^9^9\n", "line 2: '9^9^9^9' is no number"),
        ("r\n", "has no values below its first line"),
        ("r\n1\ninf\n", "values.csv: line 3: 'inf' is not finite; leave the line out"),
    ],
)
def test_a_bad_table_is_one_line(
    content: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, table = tmp_path / "case.toml", tmp_path / "values.csv"
    case.write_text(CASE)
    table.write_text(content)
    assert main(["family", str(case), "--values", str(table)]) == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("content", [b"", b"not numpy", b"\x93NUMPY\x01\x00"])
def test_a_bad_array_is_one_line(
    content: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, array = tmp_path / "case.toml", tmp_path / "values.npy"
    case.write_text(CASE)
    array.write_bytes(content)
    assert main(["family", str(case), "--values", str(array)]) == 2
    assert "is no array of NumPy's" in capsys.readouterr().err


def test_columns_are_matched_by_their_names() -> None:
    equations = ["x^2 + y^2 = r", "x = a*y"]
    rows = nag.solve_family(equations, ["r", "a"], [[2, 1], [8, -1]])
    for table in ({"a": [1, -1], "r": [2, 8]}, pandas.DataFrame({"a": [1, -1], "r": [2, 8]})):
        assert nag.solve_family(equations, ["r", "a"], table) == rows


@pytest.mark.parametrize(
    ("table", "text"),
    [
        ({"a": [1]}, "values: 0 columns have the name 'r'; give one"),
        (
            {"a": [1], "r": [1], "s": [1]},
            "values: column 's' is no parameter, leave it out; they are r, a",
        ),
        ({"a": [1, 2], "r": [1]}, "values: the columns have different lengths"),
    ],
)
def test_columns_that_do_not_fit_are_told(table: dict[str, list[int]], text: str) -> None:
    with pytest.raises(nag.NagError) as error:
        nag.solve_family(["x^2 + y^2 = r", "x = a*y"], ["r", "a"], table)
    assert str(error.value) == text


def test_a_frame_has_a_row_for_each_solution() -> None:
    found = nag.solve_family("x^2 = a", ["a"], [[4], [-1], [0]])
    frame = found.to_dataframe()
    facts = ["real", "error", "positive_dimensional"]
    assert list(frame.columns) == ["member", "a", "x", *facts]
    assert frame["member"].tolist() == [0, 0, 1, 1, 2]
    assert frame["real"].tolist() == [True, True, False, False, True]
    assert frame["a"].dtype == float and frame["x"].dtype == complex
    real = found.to_dataframe(real=True)
    assert real["member"].tolist() == [0, 0, 2] and real["x"].dtype == float
    assert nag.solve_family("x^2 = a", ["a"], [[1j]]).to_dataframe()["a"].tolist() == [1j] * 2
    assert found.real_counts.tolist() == [2, 0, 1] == [len(found.real(k)) for k in range(3)]
    assert [len(points) for points in found] == [2, 2, 1]
    assert [len(points) for points in found[::-1]] == [1, 2, 2] and len(found[-1]) == 1
    assert repr(found) == "<FamilySolutions: 5 solutions of 3 members>"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "is empty; its first line names parameters, of a, x"),
        ("a,d\n1,2\n", "line 1: 'd' does not occur; the names are a, x"),
        (
            "1,2\n3,4\n",
            "line 1: '1' does not occur; write a line of names above the numbers, of a, x",
        ),
        ("a;x\n1;2\n", "line 1: 'a;x' does not occur; write commas between names"),
        ("a\n1\nnan\n", "line 3: 'nan' is not finite"),
    ],
)
def test_a_bad_table_for_a_system_without_parameters_is_one_line_that_names_it(
    content: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    system, table = tmp_path / "system.txt", tmp_path / "values.csv"
    system.write_text("x^2 = a\n")
    table.write_text(content)
    assert main(["family", str(system), "--values", str(table)]) == 2
    assert f"nag: {table}: {message}" in capsys.readouterr().err


def test_values_of_one_parameter_are_any_list_of_numbers(tmp_path: Path) -> None:
    wanted = nag.solve_family("x^2 = a", "a", [[1], [4]])
    series = pandas.Series([1, 4], name="a", index=["one", "two"])
    np.save(tmp_path / "values.npy", np.array([1, 4]))
    for values in ([1, 4], (1.0, 4.0), np.array([1, 4]), series, tmp_path / "values.npy"):
        assert nag.solve_family("x^2 = a", "a", values) == wanted
    # A column has the name of its parameter, unless it is said which that is.
    assert nag.solve_family("x^2 = a", values=series) == wanted
    assert nag.solve_family("x^2 = a", "a", series.rename("height")) == wanted
    with pytest.raises(nag.NagError, match="'height' does not occur"):
        nag.solve_family("x^2 = a", values=series.rename("height"))
    with pytest.raises(nag.NagError, match=r"shape \(2,\); give 2 parameters for each member"):
        nag.solve_family("x^2 = a + b", "a, b", [1, 4])
    for table in ({"a": 1}, {"a": [[1]]}):
        with pytest.raises(nag.NagError, match="column 'a' is no list; give a number for each"):
            nag.solve_family("x^2 = a", "a", table)


def test_a_column_of_no_parameter_is_told_wherever_the_table_is(tmp_path: Path) -> None:
    table, file = {"a": [1, 2], "k": [3, 4]}, tmp_path / "values.csv"
    file.write_text("a,k\n1,3\n2,4\n")
    for values in (table, pandas.DataFrame(table), file):
        with pytest.raises(nag.NagError, match="'k' is no parameter"):
            nag.solve_family("x^2 = a", "a", values)


def test_a_table_may_begin_with_a_mark_of_its_encoding(tmp_path: Path) -> None:
    table = tmp_path / "values.csv"
    table.write_text("a\n1\n4\n", encoding="utf-8-sig")
    for parameters in ("a", None):
        assert len(nag.solve_family("x^2 = a", parameters, table)) == 2


@pytest.mark.parametrize("start", ["auto", "total", "polyhedral", "multihomogeneous"])
@pytest.mark.parametrize("equations", [["x*y - y*x"], ["x*y - y*x", "y*z - x"]])
def test_a_family_with_an_equation_that_vanishes_has_no_isolated_solutions(
    equations: list[str], start: str
) -> None:
    found = nag.solve_family(equations, ["x"], [[1], [2]], start=start)
    assert found.complete.all() and not found.counts.any()


@pytest.mark.parametrize("values", [["1/4", "4"], [["1/4"], [4]], {"a": ["1/4", 4.0]}])
def test_values_may_be_texts_of_numbers(values: Any) -> None:
    found = nag.solve_family("x^2 = a", "a", values)
    assert sorted(abs(x[0]) for member in found for x in member) == pytest.approx([0.5, 0.5, 2, 2])


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([True, False], "values: True or False is among them"),
        ([[True], [2]], "values: True or False is among them"),
        (np.array([True]), "values: True or False is among them"),
        (["1/0"], "values: column 2: division by zero"),
        ([[1], [1, 2]], "values: are no numbers"),
    ],
)
def test_values_that_are_none_are_refused_in_one_line(values: Any, message: str) -> None:
    with pytest.raises(nag.NagError, match=re.escape(message)):
        nag.solve_family("x^2 = a", "a", values)
