"""nag check: every statement is decided, misprints are those of the errata, liars are caught."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from linkages import four_bar
from solved import components_of

from nag.check import bennett_geometry, joints, known_planar
from nag.check import four_bar as four_bar_statements
from nag.check.four_way import Compared, four_ways
from nag.check.identities import identity
from nag.check.known import KnownDecomposition, PaperComponent, Parametrisation
from nag.check.mechanisms import (
    ComparedMechanism,
    KnownMechanism,
    bennett_parameters,
    degree_in_half_angles,
    known_bennett,
    known_bricard,
)
from nag.check.mechanisms import four_ways as mechanism_ways
from nag.check.planar_mechanism import equal_sides
from nag.check.statement import (
    DecidedStatement,
    Statement,
    Verdict,
    VerdictKind,
    statement,
    summary,
)
from nag.check.subjects import BENNETT, SUBJECTS, recognised, same_mechanism
from nag.cli import main
from nag.files.cases import read_case
from nag.mechanism.mobility_at import mobility
from nag.mechanism.model import model

ROOT = Path(__file__).parent.parent
CASES = ROOT / "cases"
STATEMENTS = [s for subject in SUBJECTS.values() for s in subject.statements]


def decomposed(system):
    return components_of(system)


@pytest.mark.parametrize("subject", SUBJECTS)
def test_every_statement_of_the_papers_is_decided_exactly(subject: str) -> None:
    for s in SUBJECTS[subject].statements:
        verdict = s.verdict()
        assert DecidedStatement.of(s, verdict).is_as_expected, (s.place, s.text, verdict)
        assert verdict.kind in (VerdictKind.EXACT, VerdictKind.FAILS)
        assert verdict.how
        assert bool(verdict.counterexample) is (verdict.kind is VerdictKind.FAILS)


def test_statements_are_many_and_told_apart() -> None:
    assert len(STATEMENTS) == len({(s.place, s.text) for s in STATEMENTS}) == 144
    assert all(s.place.startswith(("T25 ", "PT13 ")) for s in STATEMENTS)


def test_misprints_are_those_of_the_errata_and_the_other_way_round() -> None:
    errata = (CASES / "ERRATA.md").read_text("utf-8")
    papers = dict(re.findall(r"^## (\w+)\n(.*?)(?=^## |\Z)", errata, re.MULTILINE | re.DOTALL))
    for paper, text in papers.items():
        rows = re.findall(r"^\| ([^|]+?) \|", text, re.MULTILINE)
        rows = [row for row in rows if row not in ("where", "---")]
        places = [s.place for s in STATEMENTS if s.misprint and s.place.startswith(f"{paper} ")]
        places = [place.removeprefix(f"{paper} ") for place in places]
        assert all(any(row.startswith(place) for row in rows) for place in places)
        assert all(any(row.startswith(place) for place in places) for row in rows)
        assert len(rows) == len(places) > 0


def test_a_false_identity_is_refuted_at_an_exact_point() -> None:
    verdict = identity("x y", lambda x, y: {"f": x**2 - y}, (Fraction(2), Fraction(1, 3)))
    assert verdict.kind is VerdictKind.FAILS
    assert verdict.counterexample == "at x = 2, y = 1/3: f is 11/3, not 0"


def test_an_identity_with_a_root_needs_the_right_root() -> None:
    def formula(cos, sin):
        return {"circle": cos**2 + sin**2 - 1}

    at = (Fraction(3, 5), Fraction(4, 5))
    right, wrong = (("sin", lambda cos: 1 - cos**2),), (("sin", lambda cos: 2 - cos**2),)
    assert identity("cos", formula, at, right).kind is VerdictKind.EXACT
    assert identity("cos", formula, at, wrong).kind is VerdictKind.FAILS


def test_a_known_misprint_that_holds_is_not_settled() -> None:
    @statement("T25 nowhere", "1 = 1", True)
    def one() -> Verdict:
        return Verdict(VerdictKind.EXACT, "counted")

    assert not DecidedStatement.of(one, one.verdict()).is_as_expected
    assert DecidedStatement.of(replace(one, misprint=False), one.verdict()).is_as_expected
    assert not DecidedStatement.of(one, Verdict(VerdictKind.OPEN, "too large")).is_as_expected
    fails = Verdict(VerdictKind.FAILS, "", "x = 0")
    pairs = [DecidedStatement.of(replace(one, misprint=False), fails)]
    assert summary(pairs).endswith("1 fail and are not in cases/ERRATA.md")


def test_mended_formulas_are_tested_too() -> None:
    """Were a mended formula wrong, its misprint would be left open."""
    wrong = bennett_geometry.misprinted(
        "m0", lambda m0: {"printed": m0}, lambda m0: {"mended": m0 - 1}, (Fraction(1),)
    )
    assert wrong.kind is VerdictKind.OPEN
    assert bennett_geometry.axis_2.verdict().how.startswith("mended, it is an identity")


def test_points_of_counterexamples_are_what_they_are_said_to_be() -> None:
    assert "p_2 is 1 there" in joints.revolute_12.verdict().counterexample
    assert "is 4/5 there" in four_bar_statements.three_components.verdict().counterexample


def wrong_component(part: PaperComponent) -> PaperComponent:
    return PaperComponent(
        part.place, lambda v: [*part.generators(v), v[0] - v[2]], part.parametrisation
    )


def verdicts(known: KnownDecomposition) -> list[Verdict]:
    return [s.verdict() for s in four_ways(known, decomposed)]


def test_all_four_ways_catch_what_is_wrong() -> None:
    right = known_planar.fixed_four_bar({"a": Fraction(2), "b": Fraction(1)})
    kinds = [v.kind for v in verdicts(right)]
    assert kinds == [
        VerdictKind.NUMERICAL,
        VerdictKind.EXACT,
        VerdictKind.NUMERICAL,
        VerdictKind.EXACT,
    ]
    first, *rest = right.components
    missing = replace(right, components=(first,))
    assert verdicts(missing)[0].kind is VerdictKind.FAILS
    smaller = replace(right, components=(wrong_component(first), *rest))
    assert [v.kind for v in verdicts(smaller)[:2]] == [VerdictKind.FAILS, VerdictKind.FAILS]
    elsewhere = Parametrisation("t", lambda t: [t] * 6)
    astray = replace(right, components=(replace(first, parametrisation=elsewhere), *rest))
    assert verdicts(astray)[1].kind is VerdictKind.FAILS
    larger = PaperComponent("", lambda v: first.generators(v)[:3], first.parametrisation)
    assert verdicts(replace(right, components=(larger, *rest)))[3].kind is VerdictKind.FAILS


@pytest.mark.parametrize(
    ("name", "components"),
    [
        ("bennett", None),
        ("bricard-cube", None),
        ("bennett-variety", 1),
        ("bricard-variety", 1),
        ("four-bar", 2),
        ("planar-four-bar", 2),
        ("rhombus-free", 3),
        ("double-rhombus", 9),
        ("gonzalez", 6),
        ("slider-crank", 1),
        ("triangle", 1),
        ("graph-curve", 1),
    ],
)
def test_numerical_mobility_and_degree_are_the_symbolic_ones(
    name: str, components: int | None
) -> None:
    found = recognised(read_case(CASES / f"{name}.toml"), decomposed)
    assert found is not None
    answers = [s.verdict() for s in found.comparison]
    assert [v.kind for v in answers] == [
        VerdictKind.NUMERICAL,
        VerdictKind.EXACT,
        VerdictKind.NUMERICAL,
        VerdictKind.EXACT,
    ]
    assert answers[0].digits is not None and answers[0].digits >= 10
    if components is not None:
        assert f"on one of {components}" in answers[0].how


@pytest.mark.parametrize(
    "known",
    [known_bricard(), *(known_bennett(tuple(map(Fraction, m))) for m in BENNETT)],
    ids=lambda known: known.name,
)
def test_mobility_at_the_reference_is_the_symbolic_dimension(known: KnownMechanism) -> None:
    """The local dimension test and the components through it know none of the papers' formulas."""
    report = mobility(known.mechanism)
    symbolic = ComparedMechanism(known, decomposed).ideal.dimension
    assert report.local_dimension == symbolic == 1
    assert {dimension for dimension, _ in report.components} == {symbolic}
    assert report.overconstrained and report.gruebler_kutzbach < symbolic


def test_mobility_of_the_parallelogram_is_the_symbolic_dimension() -> None:
    sides = equal_sides(four_bar())
    assert sides is not None and sides.sides == (2, 1)
    known = known_planar.fixed_four_bar(dict(zip("ab", sides.sides, strict=True)))
    dimensions = {part.dimension for part in Compared(known, decomposed).ideals}
    assert dimensions == {mobility(four_bar()).local_dimension} == {1}


def test_cases_of_other_mechanisms_are_not_taken_for_known_ones(tmp_path) -> None:
    text = (CASES / "bennett.toml").read_text("utf-8")
    moved = tmp_path / "other.toml"
    moved.write_text(text.replace("point = [1, 0, 0]", "point = [1, 0, 1]"), "utf-8")
    assert recognised(read_case(moved), decomposed) is None
    ball = tmp_path / "ball.toml"
    head, name, joint = text.partition('name = "J1"')
    joint = re.sub('"revolute"', '"spherical"', re.sub(r"axis = .*\n", "", joint, count=1), count=1)
    ball.write_text(head + name + joint, "utf-8")
    assert recognised(read_case(ball), decomposed) is None
    renamed = tmp_path / "renamed.toml"
    renamed.write_text(text.replace("B2", "coupler").replace("J1", "hinge"), "utf-8")
    assert recognised(read_case(renamed), decomposed) is not None


@pytest.mark.parametrize(
    ("name", "m"),
    [
        ("bennett", "7/4, 5/6, 1/3"),
        ("spatial/bennett-h-negative", "3, -1/2, -2/7"),
        ("spatial/bennett-h-q5-zero", "2, 4/3, 1/3"),
    ],
)
def test_bennetts_parameters_are_found_from_his_axes(name: str, m: str, tmp_path) -> None:
    case = read_case(CASES / f"{name}.toml")
    reference = case.mechanism
    assert reference is not None
    [found, *_] = [p for p in bennett_parameters(reference) if ", ".join(map(str, p)) == m]
    assert same_mechanism(reference, known_bennett(found).mechanism)
    text = (CASES / f"{name}.toml").read_text("utf-8").replace("[0, 0, 1]", "[0, 0, -2]")
    turned = tmp_path / "turned.toml"
    turned.write_text(text, "utf-8")
    for one in (case, read_case(turned)):
        known = recognised(one, decomposed)
        assert known is not None and known.subject is SUBJECTS["bennett"]


def test_a_cases_own_parameters_name_the_mechanism() -> None:
    """Lemma 5.2: (-2, -2, -1/5) has the same points as (-2, 1/2, -5)."""
    given = {"m0": "-2", "m1": "1/2", "m2": "-5"}
    known = recognised(read_case(CASES / "bennett.toml", given), decomposed)
    assert known is not None and "m = (-2, 1/2, -5)" in known.comparison[0].place


def test_parameters_may_be_too_large_for_doubles() -> None:
    known = known_bennett((Fraction(3**200, 7**100), Fraction(5, 6), Fraction(1, 3)))
    assert len(known.name) < 100
    kinds = [s.verdict().kind for s in mechanism_ways(known, decomposed)]
    assert kinds == [
        VerdictKind.NUMERICAL,
        VerdictKind.EXACT,
        VerdictKind.NUMERICAL,
        VerdictKind.EXACT,
    ]


def test_half_angles_of_bricards_cube_have_degree_8_exactly() -> None:
    system = model(known_bricard().mechanism, "H").system
    assert {degree_in_half_angles(system, seed) for seed in (1, 2, 3)} == {8}


def test_the_command_prints_every_statement_and_its_answer(capsys) -> None:
    assert main(["check", str(CASES / "slider-crank.toml"), "--quiet"]) == 0
    text = capsys.readouterr().out
    assert re.search(r"^holds to 1\d digits", text, re.MULTILINE)
    assert "answer  10 statements: 8 hold exactly, 2 hold numerically, 0 fail" in text


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "give either a case file or --all, and not both"),
        (["--all", str(CASES / "bennett.toml")], "give either a case file or --all"),
        ([str(CASES / "rhombus-chain-2.toml")], "the papers give no components of it"),
        (["nowhere.toml"], "nowhere.toml"),
    ],
)
def test_bad_input_is_one_line(arguments: list[str], message: str, capsys) -> None:
    assert main(["check", *arguments, "--quiet"]) == 2
    captured = capsys.readouterr()
    assert message in captured.err
    assert captured.err.count("\n") == 1 and not captured.out


def test_an_unexpected_failure_is_an_incomplete_answer(monkeypatch, capsys) -> None:
    wrong = Statement("T25 nowhere", "0 = 1", lambda: Verdict(VerdictKind.FAILS, "", "0 is not 1"))
    monkeypatch.setitem(
        SUBJECTS, "slider crank", replace(SUBJECTS["slider crank"], statements=(wrong,))
    )
    assert main(["check", str(CASES / "slider-crank.toml"), "--quiet"]) == 1
    words = " ".join(capsys.readouterr().out.split())
    assert "1 fail and are not in cases/ERRATA.md" in words
