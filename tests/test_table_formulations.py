"""A table in half-angles and in Euler parameters: the same closings, each exactly carried over."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest
from linkages import CASES, kinds
from solved import components_of

import nag
from nag.algebra.number import is_zero
from nag.cli import main
from nag.files.cases import read_case
from nag.files.export import read_export
from nag.mechanism.coordinates import carry_to_euler
from nag.mechanism.dh import DHModel, dh_euler_model
from nag.mechanism.loop_product import displacement
from nag.mechanism.problem import problem_of

# Those that Euler parameters decompose within a second; tests/many_seeds.py has the others.
TABLES = [
    "spatial/bennett-isogram-equilateral",
    "spatial/planar-four-bar",
    "spherical/flat-foldable-vertex",
    "spherical/four-bar",
    "spherical/four-bar-equal",
    "spherical/four-bar-equal-opposite",
    "spherical/four-bar-kite",
    "spherical/hooke-joint",
    "spherical/orthogonal-four-bar",
    "spherical/triangle",
]


def table(name: str) -> DHModel:
    made = read_case(CASES / f"{name}.toml").assembly
    assert isinstance(made, DHModel)
    return made


@pytest.mark.parametrize("name", TABLES)
def test_both_formulations_have_the_same_components_in_euler_parameters(name: str) -> None:
    made = table(name)
    target, carried = carry_to_euler(problem_of(made), components_of(made.system))
    direct = components_of(target.system, tuple(target.symmetries))
    assert kinds(carried) == kinds(direct)


@pytest.mark.parametrize("name", ["spatial/goldberg-5r", "spatial/general-6r", "spatial/sarrus"])
def test_closings_in_half_angles_satisfy_the_equations_in_euler_parameters(name: str) -> None:
    made = table(name)
    target = dh_euler_model(made.loop)
    for component in components_of(made.system).components:
        for x in component.points[:4]:
            point = target.of_half_angles(made, x)
            values = [f(point) for f in target.system.polynomials]
            assert max(map(abs, values)) < 1e-8 * max(1, *map(abs, point)) ** 2


def test_an_exact_closing_is_an_exact_one_in_euler_parameters() -> None:
    made = table("spatial/bennett")
    target = dh_euler_model(made.loop)
    closing = (Fraction(0), Fraction(-150, 101))
    (f,) = made.system.polynomials
    assert f(closing) == 0
    point = target.of_half_angles(made, closing)
    assert all(is_zero(g(point)) for g in target.system.polynomials)


def test_a_table_closes_as_loops_of_mechanisms_do() -> None:
    made = table("spatial/bennett")
    turns = made.half_angles((0, -150 / 101))
    values = made.charts.at((Fraction(0), Fraction(-150, 101)), lambda x: x)
    values |= made.closure.recover(values.__getitem__, lambda x: x)
    assert [turn.joint for turn in values] == list(turns) and len(made.closure.lost) == 2
    whole = [*made.closure.kept, *made.closure.eliminated]
    real, *others = (x for part in displacement(whole, values, lambda x: x) for x in part)
    assert real != 0 and not any(others)


def test_a_known_answer_is_that_of_its_own_formulation() -> None:
    case = read_case(CASES / "spatial" / "bennett.toml")
    assert problem_of(case, formulation="H").system is case.system
    other = problem_of(case, formulation="E")
    assert case.known_in("H") and case.known_in(other.formulation) == ()
    assert other.system.n == 8 and len(other.symmetries) == 3


def test_a_closing_has_the_same_mobility_in_both_formulations(capsys) -> None:
    case = str(CASES / "spatial" / "bennett.toml")
    at = "x_J1 = 0, x_J2 = -150/101"
    assert main(["mobility", case, "--at", at, "--check", "--local", "--quiet"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "formulation E, 10 equations in 8 unknowns, agrees: local dimension 1" in text


def test_a_table_is_decomposed_in_the_coordinates_that_were_asked_for(capsys) -> None:
    case = str(CASES / "spherical" / "triangle.toml")
    for options in (["--formulation", "E"], ["--coordinates", "euler"]):
        assert main(["decompose", case, *options, "--quiet"]) == 0
        text = capsys.readouterr().out
        assert "8 components of dimension 0" in text and "2 closings" in text


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["decompose", "--formulation", "S"], "a table has formulations H and E"),
        (["decompose", "--coordinates", "joint", "--formulation", "E"], "use --formulation H"),
        (["decompose", "--modes", "all"], "--modes is for assembled mechanisms"),
        (["mobility", "--local"], "give --at"),
    ],
)
def test_what_a_table_has_not_is_refused_with_one_line(arguments, text: str, capsys) -> None:
    command, *options = arguments
    assert main([command, str(CASES / "spherical" / "triangle.toml"), *options]) == 2
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 1 and text in lines[0]


def test_what_is_known_in_a_formulation_is_compared_in_it_and_exported(tmp_path, capsys) -> None:
    written = (CASES / "spatial" / "bennett.toml").read_text()
    for degree, text in ((2, "agrees with what is known"), (3, "differs from what is known")):
        case, export = tmp_path / "case.toml", tmp_path / "export.json"
        known = f'degree = {degree}\nformulation = "H"\n'
        case.write_text(written.replace("degree = 2\n", known))
        assert main(["decompose", str(case), "--json", str(export), "--quiet"]) == 0
        assert text in capsys.readouterr().out
        origin = read_export(export).origin
        assert (origin.kind, origin.formulation) == ("mechanism", "H")
        assert origin.reason == read_case(case).assembly.reason
        assert main(["decompose", str(case), "--formulation", "E", "--quiet"]) == 0
        assert "is known" not in capsys.readouterr().out


def test_points_that_are_known_in_a_formulation_are_compared_in_it(tmp_path, capsys) -> None:
    written = (CASES / "spherical" / "triangle.toml").read_text()
    case = tmp_path / "case.toml"
    case.write_text(written.replace("degree = 1\n", 'degree = 1\nformulation = "H"\n'))
    assert main(["solve", str(case), "--quiet"]) == 0
    assert "agrees with what is known" in capsys.readouterr().out


def test_parts_that_may_be_assembled_are_exported_as_a_mechanism(tmp_path) -> None:
    export = tmp_path / "export.json"
    case = CASES / "planar" / "four-bar.toml"
    assert main(["decompose", str(case), "--json", str(export), "--quiet"]) == 0
    origin = read_export(export).origin
    assert (origin.kind, origin.formulation) == ("mechanism", None)


def test_long_irrational_equations_are_printed_in_decimals(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = ['{ a = 120, alpha = "5*pi/18" }', '{ a = 75, alpha = "28.6056*pi/180" }'] * 2
    path = tmp_path / "table.toml"
    path.write_text(f'title = "t"\nkind = "dh"\njoint = [{", ".join(rows)}]\n')
    assert main(["model", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("equations, to 15 digits"))
    assert max(map(len, lines)) < 200
    printed = [line.removesuffix(" = 0") for line in lines[start + 1 : start + 3]]
    exact = problem_of(read_case(path)).system
    again = nag.system(printed, exact.variables)
    for ours, theirs in zip(again.polynomials, exact.polynomials, strict=True):
        for e, c in theirs.terms.items():
            assert float(ours.terms[e]) == pytest.approx(float(c), rel=1e-14)
