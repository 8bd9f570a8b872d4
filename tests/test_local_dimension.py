"""The local dimension of zero sets at points: tangent and local dimension, multiplicity, bounds."""

from __future__ import annotations

import json
import warnings
from fractions import Fraction

import jsonschema
import numpy as np
import pytest
from linkages import CASES
from local_dimension_changes import judged, right
from local_dimension_of_cases import judged as at_witness_point
from local_points import ALL, MECHANISMS, SETS, ZEROS, Known, known, plain
from singular_zeros import polynomials

import nag
from nag.algebra.expression import parse_number
from nag.cli import main
from nag.files.json_schema import schema
from nag.numerics.local_dimension import NoSolution
from nag.numerics.singular_point import Place, analyse

LARGE = {"DZ1", "two curves of order 40"}
SLOW = LARGE | {n for n in MECHANISMS if n.startswith(("Bricard", "Sarrus", "Wunderlich"))}


def as_known(found: nag.LocalDimension) -> tuple[int | None, int | None, int]:
    return found.tangent_dimension, found.dimension, found.multiplicity or 0


@pytest.mark.parametrize("name", sorted(set(ALL) - LARGE))
def test_tangent_and_local_dimension_at_given_points(name: str) -> None:
    point = ALL[name]
    found = nag.local_dimension(point.system, point.point)
    assert as_known(found) == (point.tangent, point.dimension, point.multiplicity), found.reason


@pytest.mark.parametrize("name", sorted(set(MECHANISMS | SETS) - SLOW))
def test_they_are_the_same_in_other_coordinates_beside_the_point(name: str) -> None:
    found, _ = judged(ALL[name], seed=7)
    assert right(ALL[name], found) and found.decided, found.reason


@pytest.mark.parametrize("name", sorted(MECHANISMS | SETS))
def test_a_rounded_point_is_sharpened_to_the_exact_one(name: str) -> None:
    point = (MECHANISMS | SETS)[name]
    rounded = np.array([float(x) for x in point.point]) + 1e-10
    found = nag.local_dimension(point.system, rounded)
    assert found.dimension == point.dimension
    if found.tangent_dimension == point.tangent > point.dimension and point.multiplicity:
        assert np.abs(found.point - [float(x) for x in point.point]).max() < 1e-15


@pytest.mark.parametrize("size", [Fraction(1000), Fraction(1, 10**6)])
@pytest.mark.parametrize("name", ["rhombus, folded", "a prism of parallel bars", "cbms2", "DZ2"])
def test_the_unit_of_length_does_not_matter(name: str, size: Fraction) -> None:
    point = ALL[name]
    images = [x * (1 / size) for x in nag.Polynomial.variables(point.system.n)]
    system = plain([f.compose(images) for f in point.system.polynomials])
    at = np.array([complex(x) * float(size) for x in point.point])
    for offset in (0.0, 1e-9 * float(size)):
        found = nag.local_dimension(system, at + offset)
        assert as_known(found) == (point.tangent, point.dimension, point.multiplicity)


@pytest.mark.parametrize(
    "point", [["sqrt(2)", "sqrt(3)", "sqrt(6)"], ["sqrt(2+sqrt(3))", "1", "sqrt(2+sqrt(3))"]]
)
def test_points_in_square_roots_are_judged_modulo_primes(point: list[str]) -> None:
    x, y, z = nag.Polynomial.variables(3)
    at = [parse_number(text) for text in point]
    squares = [a * a for a in at]
    equations = [x**2 - squares[0], (y**2 - squares[1]) * (z - x * y), (z - x * y) ** 2]
    found = nag.local_dimension(plain([*equations, (y**2 - squares[1]) ** 2]), at)
    assert (found.dimension, found.multiplicity) == (0, 3)
    assert found.arithmetic == "modulo 2 primes"


def test_the_corank_sequence_is_that_of_the_macaulay_matrices() -> None:
    assert nag.local_dimension(ZEROS["cbms1"].system, [0, 0, 0]).coranks == (1, 4, 7, 10, 11)
    crossing = nag.local_dimension(*_known(MECHANISMS["rhombus, folded"]))
    assert (crossing.hyperplanes, crossing.coranks) == (1, (1, 2))


def _known(point: Known) -> tuple[nag.PolynomialSystem, tuple]:
    return point.system, point.point


def test_dayton_and_zeng_s_point_of_multiplicity_131() -> None:
    found = nag.local_dimension(ALL["DZ1"].system, [0] * 4)
    assert as_known(found) == (4, 0, 131)
    assert found.coranks == (1, 5, 15, 31, 53, 78, 100, 116, 126, 130, 131)


WITNESSED = (
    "rhombus",
    "double-rhombus",
    "planar/peaucellier",
    "literature/sphere-curve-lines-point",
)


@pytest.mark.parametrize("name", WITNESSED)
def test_it_is_the_dimension_of_the_component_at_its_generic_points(name: str) -> None:
    system = nag.read_case(CASES / f"{name}.toml").system
    for component in nag.decompose(system).components:
        assert at_witness_point(system, component).dimension == component.dimension


@pytest.mark.parametrize("at", [(0, 0, 0), (1, -1, Fraction(1, 2)), (2**0.5, 1.0, 2**-0.5)])
def test_a_common_factor_of_the_equations_is_a_hypersurface(at: tuple) -> None:
    """Points of a surface, isolated and embedded ones among them."""
    surface = "(x - y*z*(x^2 - 1))*(x*y^2 - 2*z)^2"
    system = nag.system([f"{surface}*({f})^2" for f in ("x - y", "y + z", "x + y*z")], "x y z")
    found = nag.local_dimension(system, at)
    assert found.dimension == 2 and "common factor" in found.reason


@pytest.mark.parametrize("seed", [5, 11, 18])
def test_a_singular_zero_that_costs_too_much_is_not_passed_over(seed: int) -> None:
    """Beside it there are regular zeros within the point's error."""
    point = SETS["a line that touches a surface to order 12"]
    found, _ = judged(point, seed)
    assert right(point, found)


def test_curves_at_a_small_angle_are_followed() -> None:
    """In these coordinates it is 0.3 degrees, and the inverse of a Jacobian between them 1e14."""
    point = ZEROS["an umbrella's handle and a line"]
    found, _ = judged(point, seed=79)
    assert right(point, found) and found.decided, found.reason


@pytest.mark.parametrize("digits", [30, 50, 90])
def test_what_only_long_coefficients_tell_from_zero_is_not_zero(digits: int) -> None:
    x, y, small = "(2*u - v - 1/3)", "(u + 3*v + 2/3)", f"1/10^{digits}"
    at = (Fraction(1, 21), Fraction(-5, 21))
    nearly_a_curve = [f"({y} - {x}^2)^2", f"({y} - {x}^2)*{x} - {small}*{x}^3"]
    nearly_triple = [f"{x}^3 + {small}*{x}^2", f"{y} - {x}"]
    isolated = nag.local_dimension(nag.system(nearly_a_curve, "u v"), at)
    assert as_known(isolated) == (2, 0, 6)
    for equations, multiplicity in ((nearly_a_curve, 6), (nearly_triple, 2)):
        beside = np.array([float(c) + 1e-10 for c in at])
        found = nag.local_dimension(nag.system(equations, "u v"), beside)
        assert not found.decided or (found.dimension, found.multiplicity) == (0, multiplicity)
        assert found.lower == 0


def test_a_cluster_of_zeros_is_left_undecided() -> None:
    system = plain(polynomials("x y", "x^3 + 1/10^20*x^2", "y - x"))
    found = nag.local_dimension(system, np.array([1e-9, 1e-9]))
    assert not found.decided and found.tangent_dimension is None
    exact = nag.local_dimension(system, [0, 0])
    assert as_known(exact) == (1, 0, 2)


def test_a_multiplicity_beyond_what_is_worked_out_leaves_both_bounds(monkeypatch) -> None:
    monkeypatch.setattr("nag.numerics.dual_space.MOST_FUNCTIONALS", 20)
    found = nag.local_dimension(plain(polynomials("x y", "x^6", "y^6")), [0, 0])
    assert (found.lower, found.upper, found.isolated) == (0, 1, None)
    assert not found.decided and "grows" in found.reason


@pytest.mark.parametrize("order", [1000])
def test_high_orders_of_contact_do_not_pass_for_curves(order: int, monkeypatch) -> None:
    monkeypatch.setattr("nag.numerics.dual_space.MOST_FUNCTIONALS", 40)
    system = plain(polynomials("x y", "x*y", f"x^{order} + y^{order}"))
    assert nag.local_dimension(system, [0, 0]).lower == 0


def test_a_smooth_curve_along_which_equations_nearly_vanish_is_no_component() -> None:
    equations = polynomials("x y", "y - x^40", "y^20")
    end = analyse(equations, np.zeros(2), 1e-15, np.random.default_rng(0), None)
    assert end.place is not Place.ON_COMPONENT


def test_a_point_that_is_no_solution_is_refused() -> None:
    circle = known("x y", "x^2 + y^2 - 1", [1, 0], 1, 1).system
    with pytest.raises(NoSolution, match="equation 1"):
        nag.local_dimension(circle, [1, 1])
    with pytest.raises(ValueError, match="2 variables"):
        nag.local_dimension(circle, [1, 0, 0])


CROSS = """
title = "A circle, a line, and a double point"
kind = "system"
variables = ["x", "y"]
equations = ["(x^2 + y^2 - 1)*(x - y)*(x - 3)^2", "(x^2 + y^2 - 1)*(x - y)*(y - 5)"]
[[point]]
name = "crossing"
at = { x = "sqrt(2)/2", y = "sqrt(2)/2" }
[[point]]
name = "double"
at = { x = 3, y = 5 }
"""


@pytest.fixture
def case(tmp_path) -> str:
    file = tmp_path / "cross.toml"
    file.write_text(CROSS)
    return str(file)


def test_the_command_says_what_the_decomposition_says(case, tmp_path, capsys) -> None:
    file = tmp_path / "local.json"
    assert main(["local", case, "--quiet", "--check", "--json", str(file)]) == 0
    text = capsys.readouterr().out
    assert "local dimension 1, tangent dimension 2: a singular point" in text
    assert "isolated, of multiplicity 2" in text
    assert text.count(": agrees") == 2 and "DISAGREES" not in text
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-local-dimension"))
    kinds = {p["name"]: (p["local_dimension"], p["multiplicity"]) for p in document["points"]}
    assert kinds == {"crossing": (1, 0), "double": (0, 2)}


def test_the_command_takes_rounded_points_and_refuses_others(case, capsys) -> None:
    assert main(["local", case, "--at", "x = 0.70710678, y = 0.70710677"]) == 0
    assert "local dimension 1, tangent dimension 2" in capsys.readouterr().out
    assert main(["local", case, "--at", "x = 1, y = 2"]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert main(["local", case, "other"]) == 2
    assert "has no point 'other'" in capsys.readouterr().err


def test_complex_points_that_are_no_solutions_are_refused_as_real_ones_are(
    tmp_path, capsys
) -> None:
    equations = ["(x^2 + y^2 - 1)*(x - 2)", "(x^2 + y^2 - 1)*(y - 3)"]
    file = tmp_path / "case.toml"
    listed = f'variables = ["x", "y"]\nequations = {json.dumps(equations)}\n'
    file.write_text(f'title = "t"\nkind = "system"\n{listed}')
    for at, k in (("x = 2, y = 7", 2), ("x = 2 + I, y = 7", 1), ("x = 2 + I/10^6, y = 3", 1)):
        assert main(["local", str(file), "--at", at]) == 2
        told = capsys.readouterr()
        assert f"equation {k} does not vanish at the point" in told.err and not told.out
    # Solutions are answered, rounded ones too.
    known = {(2, 3): 0, ("2*I", "sqrt(5)"): 1, ("2*I", 2.236067977): 1, (2 + 1e-10j, 3): 0}
    assert {at: nag.local(equations, at).dimension for at in known} == known
    # Where coefficients are complex, so is every point.
    line = nag.system(["x + I*y"], imaginary="I")
    assert nag.local(line, (0, 0)).dimension == 1
    with pytest.raises(NoSolution, match="equation 1 does not vanish"):
        nag.local(line, (1, 2))


@pytest.mark.parametrize("digits", [8, 9, 12])
@pytest.mark.parametrize(
    "equations",
    [
        ["x^2 + y^2 + I*x - 2", "x*y - 1 - I"],
        ["x^5 + y^3 + I*x - 2", "x*y^6 - 1 - I"],
        ["x^5 + y^3 + 3*x - 2", "x*y^6 - 7"],
    ],
)
def test_zeros_that_are_written_in_eight_digits_are_solutions(
    equations: list[str], digits: int, tmp_path
) -> None:
    def written(z: complex) -> str:
        return f"{z.real:.{digits - 1}e} + {z.imag:.{digits - 1}e}*I"

    file = tmp_path / "case.toml"
    head = 'kind = "system"\ntitle = "t"\nvariables = ["x", "y"]\n'
    head += f"equations = {json.dumps(equations)}\n"
    file.write_text(head)
    points = [z[:2] for z in nag.solve(file).points]
    file.write_text(
        head
        + "".join(
            f'[[point]]\nname = "p{k}"\nat = {{ x = "{written(x)}", y = "{written(y)}" }}\n'
            for k, (x, y) in enumerate(points)
        )
    )
    for k in range(len(points)):
        assert nag.local(file, f"p{k}").isolated


def squares(count: int) -> str:
    """x of the last number is the first one squared so many times."""
    return ", ".join(f"x{i + 1} - x{i}^2" for i in range(count))


@pytest.mark.parametrize(
    ("last", "count", "offset"),
    [("x{0}", 9, 0), ("x{0}", 9, 1e-9), ("y^2 - x{0}, y*x0", 7, 0)],
)
def test_a_contact_of_high_order_is_not_taken_for_a_curve(
    last: str, count: int, offset: float
) -> None:
    """x0^64 and more is nothing to any digits beside 0, and there is no other zero."""
    names = [f"x{i}" for i in range(count + 1)] + ["y"] * ("y" in last)
    equations = f"{squares(count)}, {last.format(count)}".split(", ")
    found = nag.local_dimension(nag.system(equations, names), [offset] * len(names))
    assert found.lower == 0


def test_a_curve_of_equations_with_many_zeros_is_told_from_such_a_contact() -> None:
    equations = f"{squares(11)}, (x11 - y)*y, (x11 - y)*(y - x0)".split(", ")
    names = [f"x{i}" for i in range(12)] + ["y"]
    found = nag.local_dimension(nag.system(equations, names), [0] * 13)
    assert (found.tangent_dimension, found.lower) == (2, 1)


@pytest.mark.parametrize("name", ["griewank-osborne", "cbms1", "cbms2", "kss-5", "mth191"])
def test_points_of_cases_have_the_published_multiplicities(name: str, tmp_path) -> None:
    target, path = tmp_path / "local.json", CASES / "benchmarks" / f"{name}.toml"
    assert main(["local", str(path), "--quiet", "--json", str(target)]) == 0
    [point] = json.loads(target.read_text())["points"]
    [published] = [
        c.multiplicity for c in nag.read_case(path).truth if c.multiplicity not in (1, None)
    ]
    assert (point["local_dimension"], point["multiplicity"]) == (0, published)


@pytest.mark.parametrize(
    ("name", "point", "tangent", "dimension"),
    [
        ("planar/four-bar-kite", "fold", 2, 1),
        ("planar/wunderlich-12-bar", "all on a line", 6, 2),
        ("rhombus", "stretched", 2, 1),
        ("rhombus", "sides folded back", 2, 1),
        ("rhombus", "coupler folded back", 2, 1),
    ],
)
def test_points_of_links_and_bars_have_names(name, point, tangent, dimension) -> None:
    case = nag.read_case(CASES / f"{name}.toml")
    (at,) = (p.at for p in case.points if p.name == point)
    found = nag.local_dimension(case.system, at)
    assert (found.tangent_dimension, found.dimension) == (tangent, dimension)


def test_points_that_went_astray_along_a_set_are_no_warnings() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = nag.local_dimension(nag.system(["x^64 + y^2", "y - x^61*z", "z - x^2"]), [0, 0, 0])
    assert (found.dimension, found.multiplicity) == (0, 64)
