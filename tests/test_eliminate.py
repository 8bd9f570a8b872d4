"""nag eliminate finds the papers' generators from the mechanism alone, and proves them."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from systems import system

import nag
from nag.algebra.expression import parse_polynomial
from nag.algebra.groebner import Ideal, ideal_of
from nag.algebra.number import cosine, square_root
from nag.algebra.polynomial import Polynomial
from nag.cli import main
from nag.files.json_schema import schema
from nag.interpolation.image_ideal import image_ideal
from nag.interpolation.point_cloud import AmbientVariables, Cloud
from nag.interpolation.precise_samples import SourceError, source_at
from nag.questions import ambient_variables
from nag.symbolic import bennett, bricard
from nag.tracking.run import Run
from tests.linkages import CASES, exact

OWN = exact("7/4", "5/6", "1/3")


def eliminated(tmp_path: Path, *argv: str, status: int = 0) -> dict[str, Any]:
    target = tmp_path / "eliminated.json"
    assert main(["eliminate", *argv, "--quiet", "--json", str(target)]) == status
    content = json.loads(target.read_text())
    jsonschema.validate(content, schema("nag-elimination"))
    return content


def polynomials(texts: list[str], names: list[str]) -> list[Polynomial]:
    return [parse_polynomial(text, names) for text in texts]


def equations_of(content: dict[str, Any]) -> Ideal:
    texts = [e["polynomial"] for e in content["equations"]]
    return ideal_of(polynomials(texts, content["onto"]), content["onto"])


def proofs_of(content: dict[str, Any]) -> set[str]:
    return {x["proof"] for x in (*content["equations"], *content["maps"])}


def check_maps(content: dict[str, Any], expected: dict[str, tuple[Any, Any]]) -> None:
    """Maps, and expected ones as numerator and denominator, agree modulo the equations."""
    ideal, names = equations_of(content), content["onto"]
    assert {m["variable"] for m in content["maps"]} == set(expected)
    for m in content["maps"]:
        above, below = polynomials([m["numerator"], m["denominator"]], names)
        numerator, denominator = expected[m["variable"]]
        difference = above * denominator - below * numerator
        assert not difference or ideal_of([difference], names) + ideal == ideal


def named(bodies: list[tuple], letters: str, names: list[str]) -> dict[str, Any]:
    """Euler parameters of bodies by their names, without those in ``names``."""
    values = {
        f"{x}{i}": v for x, body in zip(letters, bodies, strict=True) for i, v in enumerate(body)
    }
    return {k: v for k, v in values.items() if k not in names}


def test_bricards_ideal_and_the_map_of_equation_10(tmp_path) -> None:
    content = eliminated(tmp_path, str(CASES / "bricard-cube.toml"), "--onto", "a0,a2,c2")
    names = ["a0", "a2", "c2"]
    printed = ["2*a2^2 + 2*a0^2 - 1", "16*a0^2*(c2^2 - 2*c2*a2 - a0^2) + 1"]
    assert equations_of(content) == ideal_of(polynomials(printed, names), names)
    assert len(content["equations"]) == 2 and content["defines"] is True
    assert content["zeros"] == {"dimension": 1, "degree": 8}
    assert proofs_of(content) == {"substitution"}
    # With all of (10) times 4 a0: its only denominators are 2 a0 and 4 a0.
    a0, a2, c2 = Polynomial.variables(3)
    expected = {
        **{f"a{i}": (v, 1) for i, v in enumerate((a0, a0, a2, -a2)) if i in (1, 3)},
        **dict.fromkeys(("b0", "d1"), (Polynomial.constant(3, 1), 2)),
        **dict.fromkeys(("b1", "d0"), (2 * a2 * (a2 - c2), 1)),
        **dict.fromkeys(("b2", "d3"), (a2, 2 * a0)),
        "b3": (2 * a0 * (a2 - c2), 1),
        "d2": (-2 * a0 * (a2 - c2), 1),
        "c0": (4 * a0**2 - 1, 4 * a0),
        "c1": (1 - 4 * a0**2, 4 * a0),
        "c3": (2 * a2 - c2, 1),
        **dict.fromkeys(("e0", "e1"), (Polynomial.constant(3, 1), 4 * a0)),
        **dict.fromkeys(("e2", "e3"), (c2 - a2, 1)),
    }
    check_maps(content, expected)
    point = exact("1/2", "1/2", "1/2")
    values = named(bricard.essential_to_all(*point), "abcde", names)
    assert values == {
        k: (n(point) if isinstance(n, Polynomial) else n)
        / (d(point) if isinstance(d, Polynomial) else Fraction(d))
        for k, (n, d) in expected.items()
    }


def test_bennetts_ideal_and_the_maps_of_equations_16_to_19(tmp_path) -> None:
    names = ["a0", "a2", "c0", "c2"]
    content = eliminated(tmp_path, str(CASES / "bennett.toml"), "--onto", ",".join(names))
    a0, a2, c0, c2 = Polynomial.variables(4)
    g0, g1, g3 = bennett.variety(OWN, a0, a2, c0, c2)
    g4, _ = bennett.g_4(OWN, a0, c0)
    assert equations_of(content) == ideal_of([g0, g1, g3], names)
    assert ideal_of([g0, g1, g3], names) == ideal_of([g0, g1, g3, g4], names)
    assert len(content["equations"]) == 3 and content["defines"] is True
    assert content["zeros"] == {"dimension": 1, "degree": 8}
    assert proofs_of(content) == {"substitution"}
    # The reference configuration lies on I_{3,1}, where b has the other sign.
    a, b, c = bennett.essential_to_all(OWN, a0, a2, c0, c2)
    expected = named([a, tuple(-x for x in b), c], "abc", names)
    check_maps(content, {k: (v, 1) for k, v in expected.items()})
    assert all("*a" not in m["denominator"] for m in content["maps"])


def test_the_slider_cranks_quartic(tmp_path) -> None:
    content = eliminated(tmp_path, str(CASES / "slider-crank.toml"), "--onto", "c1,c2,c3")
    q = "c3^4 - 2*c3^2*c2^2 + c2^4 - 8*c3^2*c1^2 - 8*c2^2*c1^2 + 16*c1^4 + 8*(c3^2 + c2^2 - 2*c1^2)"
    texts = [e["polynomial"] for e in content["equations"]]
    assert polynomials(texts, content["onto"]) == polynomials([q], content["onto"])
    assert content["dimension"] == 2 and content["degree"] == 4 and content["defines"] is True
    assert proofs_of(content) == {"reduction"}
    # (s1, s2, s3) and its negative lie over the same point.
    assert content["maps"] == [] and content["missing"] == ["s1", "s2", "s3"]


def test_the_four_bars_antiparallelogram(tmp_path) -> None:
    case = str(CASES / "four-bar-free.toml")
    onto = ["c0", "s0", "c1", "s1", "c2", "s2", "c3", "s3"]
    content = eliminated(tmp_path, case, "--component", "2", "--onto", ",".join(onto))
    a, b = 2, 1
    plus, minus = a**2 + b**2, a**2 - b**2
    printed = [
        f"{a}*c0 - {b}*c1 - {a}*c2 + {b}*c3",
        f"{a}*s0 - {b}*s1 - {a}*s2 + {b}*s3",
        *(f"c{j}^2 + s{j}^2 - 1" for j in range(3)),
        f"{2 * a * b}*s1*(s2 - s0) + {2 * b * b}*s1^2 - {minus}*(c2*c0 - 1) - {plus}*s2*s0",
        f"{2 * a * b}*(c2*s1 - c1*s0) + {2 * b * b}*c1*s1 + {minus}*s2*c0 - {plus}*c2*s0",
        f"{2 * a * b}*(s2*c1 - s1*c0) + {2 * b * b}*c1*s1 - {plus}*s2*c0 + {minus}*c2*s0",
        f"{2 * a * b}*c1*(c2 - c0) - {2 * b * b}*s1^2 - {plus}*(c2*c0 - 1) - {minus}*s2*s0",
    ]
    assert equations_of(content) == ideal_of(polynomials(printed, onto), onto)
    assert len(content["equations"]) == len(printed)
    assert proofs_of(content) == {"reduction"}


@pytest.mark.parametrize("name", ["bennett", "bricard-cube"])
def test_essential_variables_are_found(name, tmp_path) -> None:
    content = eliminated(tmp_path, str(CASES / f"{name}.toml"))
    assert content["missing"] == [] and proofs_of(content) == {"substitution"}
    ideal, onto = equations_of(content), content["onto"]
    assert len(onto) + len(content["maps"]) == len(content["variables"])
    assert (ideal.dimension, ideal.degree) == (1, 8) and len(onto) == 3


def test_essential_variables_of_three_bars_are_those_of_the_paper(tmp_path) -> None:
    """Their maps to b2 and b3 are of degree 3."""
    content = eliminated(tmp_path, str(CASES / "triangle.toml"))
    assert content["onto"] == ["a0", "a1", "a2", "a3", "b0", "b1"]
    assert [m["variable"] for m in content["maps"]] == ["b2", "b3"]


def test_essential_variables_by_polynomials_only(tmp_path) -> None:
    content = eliminated(tmp_path, str(CASES / "bricard-cube.toml"), "--polynomial")
    assert content["missing"] == [] and proofs_of(content) == {"substitution"}
    assert {m["denominator"] for m in content["maps"] if "a" in m["denominator"]} == set()


def test_a_variable_that_is_not_essential(tmp_path) -> None:
    """T25 remark 2.1: x is essential for y = x^2, and y is not."""
    case = tmp_path / "parabola.toml"
    case.write_text(
        'title = "Parabola"\nkind = "system"\nvariables = ["x", "y"]\nequations = ["y - x^2"]\n'
        '[[point]]\nname = "one"\nat = { x = 1, y = 1 }\n'
    )
    content = eliminated(tmp_path, str(case))
    assert content["onto"] == ["x"] and content["equations"] == []
    assert [(m["variable"], m["numerator"]) for m in content["maps"]] == [("y", "x^2")]
    content = eliminated(tmp_path, str(case), "--onto", "y", "--at", "one")
    assert content["equations"] == content["maps"] == [] and content["missing"] == ["x"]


def test_threads_and_repeated_runs_give_the_same_text(tmp_path, capsys) -> None:
    argv = [str(CASES / "planar-four-bar.toml"), "--onto", "c1,s1"]
    first, second = (eliminated(tmp_path, *argv, "--threads", n) for n in ("1", "2"))
    assert first == second
    out = capsys.readouterr().out
    assert "bodies     cosine and sine c1, s1 of B1, c2, s2 of B2, c3, s3 of B3" in out
    assert "c1^2 + s1^2 - 1 = 0" in out
    # In doubles nothing but rounding is left of what vanishes.
    assert "  s2 = 0\n" in out


SPACE = """
title = "A line and a twisted cubic, doubled, and what is not rational"
kind = "system"
variables = ["x", "y", "z"]
equations = ["{}"]
[[point]]
name = "crossing"
at = {{ x = 0, y = 0, z = 0 }}
[[point]]
name = "beside"
at = {{ x = 2, y = 7, z = 1 }}
"""


def space(tmp_path: Path, *equations: str) -> str:
    file = tmp_path / "space.toml"
    file.write_text(SPACE.format('", "'.join(equations)))
    return str(file)


def test_a_double_curve_is_proved_by_a_power(tmp_path) -> None:
    case = space(tmp_path, "(y - x^2)^2", "z - x^3")
    content = eliminated(tmp_path, case, "--onto", "x,y,z")
    names = ["x", "y", "z"]
    expected = ["x^2 - y", "x*y - z", "y^2 - x*z"]
    assert equations_of(content) == ideal_of(polynomials(expected, names), names)
    assert content["zeros"] == {"dimension": 1, "degree": 3} and content["defines"] is True
    assert proofs_of(content) == {"reduction"}


@pytest.mark.parametrize(
    ("equations", "argv", "part"),
    [
        (
            ["y - x^2", "z - x^3"],
            ["--onto", "x,w"],
            "'w' is not one of the variables; they are x, y",
        ),
        (["y - x^2", "z - x^3"], ["--onto", "x,x"], "a variable is given twice"),
        (["y - x^2", "z - x^3"], ["--onto", ""], "no variable is given"),
        (["y - x^2", "z - x^3"], ["--degree", "0"], "is not between 1 and 100"),
        (["y - x^2", "z - x^3"], ["--degree", "x"], "is not a whole number"),
        (["y - x^2", "z - x^3"], ["--component", "2"], "there is one component"),
        (["y - x^2", "z - x^3"], ["--at", "x = 1"], "no value for y"),
        (["y - x^2", "z - x^3"], ["--at", "beside"], "does not satisfy the equations"),
        (["y - x^2", "z - x^3"], ["--at", "crossing", "--component", "1"], "one of the two"),
        (["x*y", "z"], ["--at", "crossing"], "it is singular; name a component (--comp"),
        (["x - 1", "y", "z"], [], "the component is a point"),
        (["x^2 - cos(1)*y", "z"], [], "coefficients other than rational numbers and sums of"),
    ],
)
def test_bad_input_gets_one_line(tmp_path, capsys, equations, argv, part) -> None:
    assert main(["eliminate", space(tmp_path, *equations), "--quiet", *argv]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("nag: ") and err.count("\n") == 1
    assert part in err


@pytest.mark.parametrize(
    ("onto", "found", "maps"),
    [
        ("y,z", ["6*y^3 - sqrt(2)*z^2"], {"x": ("sqrt(6)*y^2", "z")}),
        ("x,y", ["x^2 - sqrt(2)*y"], {"z": ("sqrt(3)*x*y", "1")}),
    ],
)
def test_equations_with_square_roots_have_such_coefficients(tmp_path, onto, found, maps) -> None:
    content = eliminated(
        tmp_path, space(tmp_path, "x^2 - sqrt(2)*y", "z - sqrt(3)*x*y"), "--onto", onto
    )
    names = content["onto"]
    texts = [e["polynomial"] for e in content["equations"]]
    assert polynomials(texts, names) == polynomials(found, names)
    for m in content["maps"]:
        above, below = polynomials([m["numerator"], m["denominator"]], names)
        numerator, denominator = polynomials(list(maps[m["variable"]]), names)
        assert above * denominator == below * numerator
    # Proofs are made over the rational numbers alone.
    assert proofs_of(content) == {"points"}
    assert content["defines"] is True


def test_a_component_is_sampled_through_a_point_with_square_roots() -> None:
    circles = system("x y z", "x^2 + y^2 - 5", "z - sqrt(3)*x*y")
    root = square_root(Fraction(2))
    source = source_at(
        circles, (root, square_root(Fraction(3)), 3 * root), np.random.default_rng(0)
    )
    cloud = Cloud(source, AmbientVariables.itself(circles), np.random.default_rng(1), Run())
    found = image_ideal(cloud, (0, 2))
    names = [circles.variables[i] for i in found.coordinates]
    # The square of the last equation, with the first one's y^2.
    assert list(found.generators) == polynomials(["3*x^4 - 15*x^2 + z^2"], names)
    with pytest.raises(SourceError, match="coordinates other than rational numbers"):
        source_at(circles, (cosine(1), *source.exact[1:]), np.random.default_rng(0))


@pytest.mark.parametrize(
    ("equations", "onto", "defines", "self_conjugate", "together", "found"),
    [
        (["y^2 + 5*x^2", "z"], "x,y", False, False, [], ["y^2 + 5*x^2"]),
        (["y^2 - 5*x^2", "z"], "x,y", False, None, [1, 2], ["y^2 - 5*x^2"]),
        (["y^3 - 2*x^3", "z - x*y"], "x,y", False, None, [1, 2, 3], ["y^3 - 2*x^3"]),
        (["y^2 + 1", "z - x*y^2"], "x,z", True, True, [], ["x + z"]),
        (["x^2 + y^2 - 1", "z"], "x,y", True, True, [], ["x^2 + y^2 - 1"]),
    ],
)
def test_equations_are_those_of_the_component_asked_for_only_if_it_is_rational(
    tmp_path, equations, onto, defines, self_conjugate, together, found
) -> None:
    content = eliminated(tmp_path, space(tmp_path, *equations), "--onto", onto)
    names = onto.split(",")
    assert equations_of(content) == ideal_of(polynomials(found, names), names)
    assert (content["defines"], content["self_conjugate"]) == (defines, self_conjugate)
    assert content["together"] == together and content["defines_union"] is True


def test_skew_conjugate_lines_and_their_equations_are_told_apart(tmp_path, capsys) -> None:
    # x = i z, y = i (z + 1) and its conjugate: no plane holds both, four quadrics do.
    case = space(tmp_path, "x^2 + z^2", "y^2 + (z + 1)^2", "x*(z + 1) - y*z")
    content = eliminated(tmp_path, case, "--onto", "x,y,z")
    assert content["defines"] is False and content["self_conjugate"] is False
    assert all("^2" in e["polynomial"] or "*" in e["polynomial"] for e in content["equations"])
    assert "not its own conjugate: the equations hold on both" in " ".join(
        capsys.readouterr().out.split()
    )


def test_a_map_to_a_variable_that_is_zero_is_zero(tmp_path) -> None:
    content = eliminated(tmp_path, space(tmp_path, "y - x^2", "z"), "--onto", "x,y")
    (zero,) = content["maps"]
    assert (zero["variable"], zero["numerator"], zero["denominator"]) == ("z", "0", "1")


def test_too_many_monomials_are_refused_before_they_are_made(tmp_path, capsys) -> None:
    names = [f"v{i}" for i in range(30)]
    squares = " + ".join(f"{name}^2" for name in names)
    case = tmp_path / "sphere.toml"
    case.write_text(
        f'title = "Sphere"\nkind = "system"\nvariables = {names}\nequations = ["{squares} = 1"]\n'
    )
    at = ", ".join(f"{name} = {int(name == 'v0')}" for name in names)
    argv = ["eliminate", str(case), "--quiet", "--at", at, "--onto", ",".join(names)]
    assert main(argv) == 1
    out = " ".join(capsys.readouterr().out.split())
    assert "open 496 monomials of degree up to 2 in 30 variables are more than 400" in out


def test_the_function_answers_as_the_command_does(tmp_path) -> None:
    case = CASES / "bennett.toml"
    for words, named in [
        ((), {}),
        (("--component", "1"), {"component": 1}),
        (("--formulation", "H"), {"formulation": "H"}),
        (("--at", "reference", "--formulation", "H"), {"point": "reference", "formulation": "H"}),
    ]:
        said = eliminated(tmp_path, str(case), *words)
        found = nag.eliminate(case, **named).document()
        assert found == {name: said[name] for name in found}
    # A mechanism, its case and its file are one and the same.
    mechanism = nag.read_case(case).mechanism
    assert nag.eliminate(mechanism).document() == nag.eliminate(case).document()


def test_a_point_is_given_in_all_variables_of_a_mechanism() -> None:
    problem = nag.problem(CASES / "bennett.toml", formulation="E")
    whole = ambient_variables(problem)
    at = dict(
        zip(whole.system.variables, (f(problem.reference) for f in whole.images), strict=True)
    )
    assert len(at) == 12 and problem.system.n == 8
    through = nag.eliminate(problem, point=at)
    assert through.document() == nag.eliminate(problem, point="reference").document()
    with pytest.raises(nag.NagError, match="point: it does not satisfy the equations"):
        nag.eliminate(problem, point=at | {"a0": 2})


def test_a_rounded_point_is_looked_for_on_all_components() -> None:
    found = nag.eliminate("(x^2 + y^2 - 1)*(x - y)", "x, y", point=(0.28, 0.96))
    assert found.equations == ("x^2 + y^2 - 1",)


def test_an_unknown_variable_of_a_mechanism_names_the_formulation(capsys) -> None:
    case = str(CASES / "bricard-cube.toml")
    assert main(["eliminate", case, "--quiet", "--formulation", "H", "--onto", "a0"]) == 2
    assert (
        "formulation E has Euler parameters, H half-angles (--formulation)"
        in capsys.readouterr().err
    )


def test_the_model_says_whose_the_variables_are(capsys) -> None:
    assert main(["model", str(CASES / "bennett.toml"), "--formulation", "E"]) == 0
    out = capsys.readouterr().out
    assert "Euler parameters a0 to a3 of B1, b0 to b3 of B2, c0 to c3 of B3" in out
    assert "  a0 = 6/5*a1, a2 = -171/478*a3, c0 = 5/2*c1, c2 = 2/5*c3\n" in out


FOUR_BAR = """
title = "Coupler curve"
kind = "linkage"
ground = "base"
link = [
  { name = "base", pins = ["A", "D"], length = 4 },
  { name = "crank", pins = ["A", "B"], length = 2 },
  { name = "coupler", pins = ["B", "C", "P"], shape = [[0, 0], [3, 0], ["3/2", 2]] },
  { name = "rocker", pins = ["C", "D"], length = "7/2" },
]
"""


def test_a_coupler_point_draws_a_tricircular_sextic(tmp_path: Path) -> None:
    case = tmp_path / "coupler.toml"
    case.write_text(FOUR_BAR)
    content = eliminated(tmp_path, str(case), "--onto", "x_P,y_P")
    (sextic,) = polynomials([e["polynomial"] for e in content["equations"]], ["x_P", "y_P"])
    leading = {e: c for e, c in sextic.terms.items() if sum(e) == 6}
    x, y = Polynomial.variables(2)
    assert sextic.degree == 6
    assert Polynomial(2, leading) == leading[6, 0] * (x**2 + y**2) ** 3
    # The crank along the base: the triangle of B, C and D tells how the coupler is turned.
    c = (3**2 + 2**2 - Fraction(7, 2) ** 2) / (2 * 3 * 2)
    s = square_root(1 - c**2)
    assert sextic((2 + Fraction(3, 2) * c - 2 * s, Fraction(3, 2) * s + 2 * c)) == 0
    assert nag.eliminate(case, "x_P, y_P").generators == (sextic,)


def test_pins_that_are_not_asked_for_are_no_variables(tmp_path: Path, capsys) -> None:
    case = tmp_path / "coupler.toml"
    case.write_text(FOUR_BAR)
    content = eliminated(tmp_path, str(case), "--onto", "c_crank,x_B")
    assert "x_P" not in {m["variable"] for m in content["maps"]}
    capsys.readouterr()
    assert main(["eliminate", str(case), "--onto", "x_Q,y_P", "--quiet"]) == 2
    assert "x_P and y_P are the place of its pin P" in capsys.readouterr().err
