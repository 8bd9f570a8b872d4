"""What is written as a case is read again, equal: cases, mechanisms, parts and systems."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from linkages import CASES

import nag
from nag.mechanism.dh import Row
from nag.mechanism.joint_types import JOINT_TYPES

SHIPPED = sorted(path.relative_to(CASES).as_posix() for path in CASES.rglob("*.toml"))


def again(given: Any, folder: Path, **how: Any) -> nag.Case:
    path = folder / "again.toml"
    nag.write(given, path, **how)
    read = nag.read(path)
    assert isinstance(read, nag.Case)
    return read


@pytest.mark.parametrize("folder", sorted({name.rpartition("/")[0] for name in SHIPPED}))
def test_shipped_cases_and_what_they_describe_are_read_again(folder: str, tmp_path: Path) -> None:
    for name in (n for n in SHIPPED if n.rpartition("/")[0] == folder):
        case = nag.read_case(CASES / name)
        assert again(case, tmp_path) == case, name
        assert again(case.described, tmp_path).described == case.described, name


def test_values_that_were_set_are_those_of_the_case(tmp_path: Path) -> None:
    case = nag.read_case(CASES / "rhombus.toml", {"b": "sqrt(2)"})
    assert again(case, tmp_path) == case != nag.read_case(CASES / "rhombus.toml")
    assert not again(case, tmp_path).truth


@cache
def parts() -> dict[str, Any]:
    """Something of every kind that a case describes."""
    placed = nag.Framework.of({"A": (0, 0), "B": ("1/3", 0.25), "C": (1, "sqrt(2)")}, ["AB", "BC"])
    by_lengths = nag.Framework.of("ABC", ["AB", "BC", "CA"], [3, "sqrt(5)", 4])
    plate = {"P": (0, 0), "Q": (2, 0), "R": (1, "1/7")}
    linkage = nag.Linkage.of({"base": plate, "rod": ("P", "S", 2), "other": "QS3"}, "base")
    rows = [{"a": "5/3", "alpha": "pi/3"}, {"a": 1, "d": "1/2", "alpha": 0}, {"alpha": "pi"}]
    table = nag.DHLoop.of([*rows, {"a": 1, "alpha": "pi/2", "theta": "pi/5"}])
    angles = ["2*pi/7", "pi/8", "pi/12", "1/2", "-3*pi/5", "sqrt(2)"]
    six = nag.DHLoop.of([{"a": 1, "d": "1/3", "alpha": angle} for angle in angles])
    sides = ["AB", "BC", "CA", "AD", "BD", "CD"]
    closed = nag.DHLoop.of([{"a": 1, "alpha": 0, "theta": "pi/2"}] * 4)
    steps = [(name, JOINT_TYPES[name]) for name in JOINT_TYPES]
    joints, given = (
        [],
        {"point": (0, "1/3", "sqrt(2)"), "axis": (0, 1, 2), "second_axis": (1, 0, 0)},
    )
    for i, (name, of_type) in enumerate(steps):
        vectors = {key: given[key] for key in of_type.fields}
        joints.append(nag.Joint(f"J {i}", name, (f"b{i}", f"b{(i + 1) % len(steps)}"), **vectors))
    bodies = [nag.Body("b1", ("1/2", "1/2", "1/2", "1/2"))]
    return {
        "framework by places": placed,
        "framework by lengths": by_lengths,
        "framework in space": nag.Framework.of("ABCD", sides, [3, 4, 5, 4, 4, 4], dimension=3),
        "linkage": linkage,
        "table": table,
        "table of many angles": six,
        "closed table": closed,
        "mechanism of all joints": nag.Mechanism("b0", tuple(joints), tuple(bodies)),
        "system": nag.system(["x^2 - I*y", "y - sqrt(2)"], imaginary="I"),
    }


@pytest.mark.parametrize("kind", parts())
def test_parts_are_read_again_as_the_same_kind_of_thing(kind: str, tmp_path: Path) -> None:
    part = parts()[kind]
    case = again(part, tmp_path)
    assert type(case.described) is type(part) and case.described == part
    assert again(case, tmp_path) == case
    if "of all joints" not in kind:
        assert nag.model(case) == nag.model(part)


def test_half_angles_of_any_scale_are_one(tmp_path: Path) -> None:
    row, other = (Row("J", 1, 0, (c, s)) for c, s in ((1, 2), (Fraction(-1, 3), Fraction(-2, 3))))
    assert row == other and row.alpha == other.alpha == (1, 2)
    assert Row("J", 1, 0, (0, -3)).alpha == (0, 1)


def test_a_title_changes_nothing_else(tmp_path: Path) -> None:
    case = nag.read_case(CASES / "planar" / "four-bar.toml")
    titled = again(case, tmp_path, title="another one")
    assert titled.title == "another one" and replace(titled, title=case.title) == case


def test_robots_are_read_again_as_mechanisms_with_what_is_known(tmp_path: Path) -> None:
    page = (CASES.parent / "docs" / "formats.md").read_text()
    for name, language in (("bar.urdf", "xml"), ("robot.toml", "toml")):
        block = page.partition(f"```{language}\n")[2].partition("```")[0]
        (tmp_path / name).write_text(block)
    case = nag.read(tmp_path / "robot.toml")
    assert isinstance(case, nag.Case) and case.truth and case.parameters
    assert again(case, tmp_path) == case


def test_systems_mechanisms_and_models_are_read_again(tmp_path: Path) -> None:
    system = nag.system(["x^2 - sqrt(2)*y'", "y' + I*x - 1/3"], ["y'", "x"], groups=[[0], [1]])
    case = again(system, tmp_path, title="two")
    assert case.system == system and case.title == "two"
    mechanism = nag.read_case(CASES / "bennett.toml").mechanism
    for given in (mechanism, nag.model(mechanism), nag.problem(mechanism)):
        assert again(given, tmp_path).mechanism == mechanism
    assert nag.model(again(nag.model(mechanism), tmp_path)) == nag.model(mechanism)


def test_what_has_no_title_is_titled_by_what_it_is(tmp_path: Path) -> None:
    assert again(nag.system("x^2 - 1"), tmp_path).title == "a polynomial system"
    assert again(nag.problem("x^2 - 1"), tmp_path).title == "a polynomial system"
    assert again(nag.model(CASES / "bennett.toml"), tmp_path).title == "a mechanism"


def test_an_ending_of_pythons_names_sympy(tmp_path: Path) -> None:
    nag.write(["x^2 - 1"], tmp_path / "a.py")
    assert "from sympy import" in (tmp_path / "a.py").read_text()


@pytest.mark.parametrize("ending", ["m2", "sing", "phc", "bertini", "jl", "txt"])
def test_an_ending_names_another_program(ending: str, tmp_path: Path) -> None:
    system, path = nag.system(["x^2 - 1/3*y", "x*y - 2"]), tmp_path / f"a.{ending}"
    nag.write(system, path)
    assert nag.read(path).system == system
    nag.write(
        system,
        tmp_path / "other",
        format={"jl": "hc", "sing": "singular"}.get(ending, ending.replace("txt", "text")),
    )
    assert (tmp_path / "other").read_text().splitlines()[1:] == path.read_text().splitlines()[1:]
    foreign = nag.read(path)
    assert again(foreign, tmp_path) == foreign


@pytest.mark.parametrize(
    ("given", "how", "message"),
    [
        (lambda: nag.system("x", nonzero="x - 1"), {}, "cannot say what is nonzero"),
        (lambda: nag.system("x"), {"title": "a\nb"}, "title: holds a line break"),
        (lambda: nag.system("x"), {"format": "m2", "title": "a\nb"}, "title: holds a line break"),
        (
            lambda: replace(nag.read("cases/rhombus.toml"), title="a\nb", text=""),
            {},
            "title: holds a line break",
        ),
        (lambda: nag.decompose("x"), {"format": "m2"}, "format: is for cases and equations"),
        (lambda: nag.system("x"), {"format": "word"}, "format: 'word' is unknown"),
        (lambda: 3, {}, "result: 3 is given; give an answer"),
    ],
)
def test_what_cannot_be_said_is_refused(given: Any, how: Any, message: str, tmp_path: Path) -> None:
    with pytest.raises(nag.NagError, match=message) as refused:
        nag.write(given(), tmp_path / "a.toml", **how)
    assert "\n" not in str(refused.value) and not (tmp_path / "a.toml").exists()


def links(name: str) -> dict[str, str]:
    return {name: "AD2", "left": "AB1", "top": "BC2", "right": "CD1"}


def rows(name: str) -> list[dict[str, str]]:
    return [{"name": n, "a": "1", "alpha": "pi/2"} for n in (name, "J2", "J3", "J4")]


PARTS = {
    "link": lambda name: nag.Linkage.of(links(name), name),
    "point": lambda name: nag.Framework.of([name, "B", "C"], [(name, "B"), "BC"], [1, 2]),
    "joint": lambda name: nag.DHLoop.of(rows(name)),
}


@pytest.mark.parametrize("part", PARTS)
def test_parts_have_the_names_that_a_case_can_have(part: str, tmp_path: Path) -> None:
    for name in ("Gestell_é", "1", "1a", "sin"):
        made = PARTS[part](name)
        nag.write(made, tmp_path / "parts.toml")
        assert nag.read(tmp_path / "parts.toml").described == made
    for name in ("r t", "Gestell é", "a-b", ""):
        with pytest.raises(nag.MechanismError, match=f"{name!r} cannot name a {part}; use") as no:
            PARTS[part](name)
        assert "\n" not in str(no.value)


@pytest.mark.parametrize(("joint", "body"), [("J\n1", "b"), ("", "b"), ("J", "b\n"), ("J", " ")])
def test_a_mechanism_has_the_names_that_a_case_can_have(joint: str, body: str) -> None:
    with pytest.raises(nag.MechanismError, match="is no name; write a text in one line"):
        nag.Mechanism("a", (nag.Joint(joint, "revolute", ("a", body), (0, 0, 0), (0, 0, 1)),))


def test_a_table_that_cannot_be_read_is_not_written(tmp_path: Path) -> None:
    row = {"a": 1, "alpha": "pi/3"}
    loop = nag.DHLoop.of([row, row, {**row, "theta": 1}, {**row, "theta": 2}])
    with pytest.raises(nag.NagError, match="2 open angles; leave at least three open"):
        nag.write(loop, tmp_path / "loop.toml")
    assert not list(tmp_path.iterdir())
