"""For which parameters members of a family are singular: conditions against known discriminants."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest
from discriminants import disagreement_with_discriminant, family

import nag
from nag.cli import main
from nag.decomposition import singular_parameters
from nag.decomposition.singular_members import SingularParameters
from nag.witness.witness import PathCounts

# Equations, variables with the parameters last, how many these are, and for each set of parameters
# its equations.
FAMILIES = {
    "the cubic discriminant": (
        "x^3 + a*x^2 + b*x + c",
        "x a b c",
        3,
        {"4*a^3*c - a^2*b^2 - 18*a*b*c + 4*b^3 + 27*c^2 = 0"},
    ),
    "degree 5 in two parameters": (
        "y^2 - x^4 - a*x^2 - b*x - 1",
        "x y a b",
        2,
        {"4*a^3*b^2 - 16*a^4 + 27*b^4 - 144*a*b^2 + 128*a^2 - 256 = 0"},
    ),
    "irrational values": ("y^2 - x^3 + x - a", "x y a", 1, {"27*a^2 - 4 = 0"}),
    "irrational planes": (
        "y^2 - x^3 + x - a - b",
        "x y a b",
        2,
        {"27*a^2 + 54*a*b + 27*b^2 - 4 = 0"},
    ),
    "conjugate lines of two kinds": (
        "y^2 - (x^3 - 2)*(x - a)*(x - b)",
        "x y a b",
        2,
        {"a - b = 0", "a^3 - 2 = 0", "b^3 - 2 = 0"},
    ),
    "far from the origin": (
        "(x - 1000000)^3 + (y - 7)^2 + (a - 1000)*(x - 1000000) + b",
        "x y a b",
        2,
        {"4*a^3 - 12000*a^2 + 27*b^2 + 12000000*a - 4000000000 = 0"},
    ),
    "values of two kinds": (
        "y^2 - x^5 + 2*x^2 - a",
        "x y a",
        1,
        {"a = 0", "3125*a^3 - 3456 = 0"},
    ),
    "lines that meet": (
        "x*y*z - a*x - b*y - c",
        "x y z a b c",
        3,
        {"a = 0 and c = 0", "b = 0 and c = 0"},
    ),
    "conjugate points of two kinds": (
        "x*(a^3 - 2) + y*(b - a)*(b^2 + 1)",
        "x y a b",
        2,
        {"a - b = 0 and b^3 - 2 = 0", "b^2 + 1 = 0 and a^3 - 2 = 0"},
    ),
    "all members": ("(x^2 - a)*(y - b)", "x y a b", 2, {"all values"}),
    "no members": ("x*y - 1 + 0*a", "x y a", 1, set()),
}


@pytest.mark.parametrize("name", FAMILIES)
def test_conditions_are_those_of_exact_elimination(name: str) -> None:
    equation, variables, count, expected = FAMILIES[name]
    found = singular_parameters(nag.system(equation, variables), count)
    assert (set(found.texts()), found.complete, found.notes) == (expected, True, ())


def test_a_discriminant_of_degree_twelve_is_found() -> None:
    """That of ternary cubics has degree 12; with a = b = 0 the member is Fermat's, smooth."""
    family = nag.system("x^3 + y^3 + 1 + a*(x^2*y + 2*y + x) + b*(x*y^2 + 3*x^2 - 1)", "x y a b")
    found = singular_parameters(family, 2)
    assert found.complete
    assert [(s.dimension, s.degree, s.proof) for s in found.sets] == [(1, 12, "reduction")]
    ((discriminant,),) = found.conditions
    assert discriminant([Fraction(0), Fraction(0)]) != 0


def test_a_condition_of_too_many_terms_is_open(tmp_path: Path, capsys) -> None:
    file = tmp_path / "family.toml"
    file.write_text(
        'title = "a family"\nkind = "system"\nvariables = ["x", "y"]\n'
        'equations = ["x^4 + y^2*x + 1 + a*x^2*y + b*x + c*y"]\n[parameters]\na = 1\nb = 1\nc = 1\n'
    )
    assert main(["singular", str(file), "--free", "a,b,c", "--quiet"]) == 1
    out = capsys.readouterr().out
    assert "singular  it is not known for which parameters\nopen" in out
    assert "all values" not in out and "= 0" not in out


def test_it_is_said_what_conditions_rest_on(tmp_path: Path, capsys) -> None:
    file = tmp_path / "family.toml"
    file.write_text(
        'title = "a family"\nkind = "system"\nvariables = ["x", "y"]\n'
        'equations = ["y^2 - x^3 + x - a"]\n[parameters]\na = 1\n'
    )
    assert main(["singular", str(file), "--free", "a", "--quiet"]) == 0
    out = capsys.readouterr().out
    assert "singular  27*a^2 - 4 = 0\n          dimension 0, degree 2; proved by reduction" in out


def test_parameters_are_freed_as_the_command_frees_them(tmp_path: Path) -> None:
    file = tmp_path / "family.toml"
    file.write_text(
        'title = "a family"\nkind = "system"\nvariables = ["x", "y"]\n'
        'equations = ["y^2 - x^3 + x - a"]\n[parameters]\na = 1\n'
    )
    of_case = nag.singular(file, free="a")
    assert of_case.texts() == ["27*a^2 - 4 = 0"] and len(of_case) == 1
    assert nag.singular("a + x^3 - x - y^2", free=["a"]).texts() == of_case.texts()
    assert repr(of_case) == "<SingularParameters: singular 27*a^2 - 4 = 0>"
    assert list(of_case.to_dataframe().degree) == [2] and of_case[0] == of_case.sets[0]
    for given, how, said in (
        (file, {"free": "b"}, "'b' is no parameter"),
        ("x^2 - a", {"free": "b"}, "free: 'b' does not occur"),
        ("x^2 - a", {"free": "a", "component": 1}, "component: is of components"),
        ("x^2 - a", {"free": "a, a"}, "each once"),
    ):
        with pytest.raises(nag.NagError, match=said):
            nag.singular(given, **how)


def test_a_groebner_basis_proves_that_no_set_is_missing() -> None:
    found = singular_parameters(nag.system("y^2 - x^5 + 2*x^2 - a", "x y a"), 1)
    assert found.proved and {each.proof for each in found.sets} == {"reduction"}


def test_a_family_of_singular_members_is_seen_whatever_the_unit_of_its_parameter() -> None:
    found = singular_parameters(nag.system("(x^2 - 1000000000000*a)*(y - b)", "x y a b"), 2)
    assert (found.texts(), found.complete) == (["all values"], True)


@pytest.mark.parametrize(
    ("nonzero", "expected"),
    [
        ("1", {"all values"}),
        ("x", {"a - b = 0", "a^2 + a*b + b^2 = 0"}),
        ("x*(x - y)", {"a^2 + a*b + b^2 = 0"}),
        ("x*(a^3 - b^3)", set()),
    ],
)
def test_singular_points_that_are_excluded_do_not_count(nonzero: str, expected: set[str]) -> None:
    cubics = nag.system("x^2*(x - a) - y^2*(y - b)", "x y a b", nonzero=nonzero)
    found = singular_parameters(cubics, 2)
    assert (set(found.texts()), found.complete) == (expected, True)


@pytest.mark.parametrize("complete", [False, True])
def test_no_parameters_are_named_where_nothing_is_known(complete: bool) -> None:
    notes = () if complete else ("paths failed",)
    rows = SingularParameters(("a",), (), PathCounts(), complete, notes).rows()
    assert (("singular", "for no parameters") in rows) is complete


@pytest.mark.parametrize("number", [3, 6, 14, 18])
def test_conditions_are_the_factors_of_discriminants(number: int) -> None:
    of = family(number, seed=7)
    found = singular_parameters(of.system, of.count, seed=7)
    assert found.complete
    assert disagreement_with_discriminant(of, found) == ""
