"""Systems with complex coefficients: zeros of these and not of their conjugates."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

import nag
from nag.algebra.from_python import coordinates
from nag.cli import main
from nag.cli.witness_input import point_at
from nag.decomposition import discover
from nag.files.cases import freed_system
from nag.real.curve import PieceKind
from nag.real.real_pieces import Reality
from nag.real.real_samples import sample_real
from nag.witness.membership import Membership


def complex_system(*equations: str) -> nag.PolynomialSystem:
    """Equations in which I is the imaginary unit."""
    names = [name for name in "xyz" if any(name in text for text in equations)]
    return nag.system(list(equations), variables=names)


def points_of(result: nag.SolveResult) -> np.ndarray:
    """Solutions without the imaginary unit, in the order of their parts."""
    points = np.array([s.point[:-1] for s in result.solutions])
    return points[np.lexsort(np.round([points[:, 0].imag, points[:, 0].real], 6))]


def test_a_square_root_of_an_imaginary_number_has_two_values() -> None:
    result = nag.solve("x^2 + I", "x")
    assert result.complete
    root = np.sqrt(-1j)
    assert np.allclose(points_of(result)[:, 0], sorted([root, -root], key=lambda z: z.real))
    assert not result.real


@settings(max_examples=12, deadline=None)
@given(
    st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9)), min_size=3, max_size=6).filter(
        lambda c: c[0] != (0, 0)
    )
)
def test_zeros_of_one_polynomial_are_those_of_its_companion_matrix(
    coefficients: list[tuple[int, int]],
) -> None:
    numbers = [complex(*c) for c in coefficients]
    degree = len(numbers) - 1
    text = " + ".join(f"({a} + {b}*I)*x^{degree - k}" for k, (a, b) in enumerate(coefficients))
    result = nag.solve([text], "x")
    assert result.complete
    assert sum(s.multiplicity for s in result.solutions) == degree
    for solution in result.solutions:
        assert solution.point[-1] == pytest.approx(1j)
        value = np.polyval(numbers, solution.point[0])
        scale = np.polyval(np.abs(numbers), abs(solution.point[0]))
        assert abs(value) <= 1e-6 * scale


def test_components_of_the_conjugate_system_are_left_out() -> None:
    system = nag.system("(x + I*y)*(x - 3*I*z)^2*(z^2 - x*I + 1)", "x y z")
    answer = nag.decompose(system)
    assert answer.complete
    found = [(c.dimension, c.degree, c.multiplicity) for c in answer.components]
    assert sorted(found) == [(2, 1, 1), (2, 1, 2), (2, 2, 1)]
    for component in answer.components:
        assert np.allclose(component.points[:, -1], 1j)
    line = answer.components[0] if answer.components[0].multiplicity == 1 else answer.components[1]
    assert line.contains([-1j, 1, 0.3, 1j])
    assert not line.contains([1j, 1, 0.3, 1j])


def test_notes_of_a_sample_of_components_count_those_of_one_side() -> None:
    found = discover(nag.system("(x^2 + I*y^2 - z)*(x - I*y)", "x y z"), starts=10)
    note = re.search(r"from (\d+) of 10 random points", "; ".join(found.notes))
    assert note and 0 < int(note[1]) < 10


def test_real_solutions_are_told_from_others() -> None:
    result = nag.solve(["(x^2 - 4)*(x - I)", "y + I*x - 2*I"], "x y")
    assert [np.round(s.point[:2], 12).tolist() for s in result.real] == [[2, 0]]


@pytest.mark.parametrize("given", [1 + 2j, "numpy", "sympy", "1 + 2*I"])
def test_complex_numbers_of_python_are_parameters(given: object) -> None:
    value = {"numpy": np.complex128(1 + 2j), "sympy": 1 + 2 * sympy.I}.get(str(given), given)
    system = nag.system(["x^2 - a"], parameters={"a": value})
    assert system.text() == ["x^2 - 2*I - 1", "I^2 + 1"]
    assert system.imaginary


def test_sympys_imaginary_unit_is_read() -> None:
    x, y = sympy.symbols("x y")
    system = nag.system([sympy.I**3 * x + y, (1 + sympy.I) * x * y - 1])
    assert system.text() == ["-x*I + y", "x*y*I + x*y - 1", "I^2 + 1"]


def test_a_variable_called_like_the_unit_is_asked_about() -> None:
    with pytest.raises(
        nag.EquationError,
        match=r"if it is, give imaginary='I' as well, else list all variables, variables='x y'",
    ):
        nag.system(["x^2 + I"])
    assert nag.system(["x^2 + I"], ["x", "I"]).n == 2
    assert not nag.system(["x^2 + I"], ["x", "I"]).imaginary
    assert nag.system(["x^2 + i"], imaginary="i").text() == ["x^2 + I", "I^2 + 1"]
    # A variable may be called I where the unit is sympy's: the unit has another name then.
    x, letter = sympy.symbols("x I")
    assert nag.system([x**2 + sympy.I * letter]).variables == ("I", "x", "imaginary_unit")


def test_certificates_count_the_zeros_of_one_side(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "case.toml"
    case.write_text(
        'title = "t"\nkind = "system"\nvariables = ["x", "y"]\nimaginary = "i"\n'
        'equations = ["(3 + 4*i)*x^2 - y", "x*y - i*x - 2"]\n'
    )
    export = tmp_path / "solutions.json"
    assert main(["solve", str(case), "--json", str(export), "--quiet", "--certify"]) == 0
    said = capsys.readouterr().out
    assert "3 isolated solutions, 0 real" in said
    assert "certified  3 of 3 solutions" in said
    assert "there are no more isolated zeros than half of Bezout's number" in said
    again = nag.read_solutions(export)
    assert again.result.system.imaginary
    assert len(again.result.solutions) == 3


def test_an_imaginary_unit_that_is_a_variable_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "case.toml"
    case.write_text(
        'title = "t"\nkind = "system"\nvariables = ["x"]\nimaginary = "x"\nequations = ["x"]\n'
    )
    assert main(["solve", str(case)]) == 2
    assert "imaginary: 'x' is taken; write a letter of its own" in capsys.readouterr().err


CASE = """\
title = "a square root"
kind = "system"
variables = ["x", "y"]
equations = ["x^2 - c", "y - x/d"]
[parameters]
a = 2
c = "(a + I)^2"
d = "1/(1 - I)"
"""


def with_parameters(folder: Path, text: str = CASE) -> Path:
    path = folder / "case.toml"
    path.write_text(text)
    return path


def test_parameters_of_a_case_may_be_complex(tmp_path: Path) -> None:
    path = with_parameters(tmp_path)
    case = nag.read_case(path)
    assert {name: str(value) for name, value in case.parameters.items()} == {
        "a": "2",
        "c": "3 + 4*I",
        "d": "1/2 + 1/2*I",
    }
    assert np.allclose(points_of(nag.solve(case)), [[-2 - 1j, -3 + 1j], [2 + 1j, 3 - 1j]])
    for value in (2j, "2*I", np.complex128(2j), 2 * sympy.I):
        found = points_of(nag.solve(nag.read_case(path, {"c": value})))
        assert np.allclose(found[:, 0], [-1 - 1j, 1 + 1j])


def test_parameters_whose_imaginary_parts_cancel_are_real(tmp_path: Path) -> None:
    text = CASE.replace('"(a + I)^2"', '"I^2 + 5"').replace('"1/(1 - I)"', '"(1 + I)^-2*I"')
    case = nag.read_case(with_parameters(tmp_path, text))
    assert (case.parameters["c"], case.parameters["d"]) == (4, 0.5)
    assert not case.system.imaginary


def test_complex_parameters_are_freed(tmp_path: Path) -> None:
    found = freed_system(nag.read_case(with_parameters(tmp_path)), ["c"])
    assert found.variables == ("x", "y", "c", "I")
    assert found.imaginary


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("1/(1 - I)", "1/(I^2 + 1)", "d: column 2: division by zero"),
        ("1/(1 - I)", "sqrt(I)", "d: column 1: sqrt of a complex number is not worked out"),
        ("(a + I)^2", "a + i", "c: 'i' looks like the imaginary unit; it is called 'I' here"),
        ('"x", "y"', '"x", "y", "I"', "c: unknown name 'I'"),
        ("a = 2", "a = 2\nI = 3", "a square root"),
        ("[parameters]", 'imaginary = "a"\n[parameters]', "c: unknown name 'I'"),
        (
            "[parameters]",
            '[[point]]\nname = "p"\nat = { x = "I +", y = 1 }\n[parameters]',
            "at: x: column 4: something is missing after '+'",
        ),
        ('"system"', '"dh"', "belongs to a case of kind 'system'"),
    ],
)
def test_what_is_wrong_with_complex_parameters_is_one_line(
    old: str, new: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["show", str(with_parameters(tmp_path, CASE.replace(old, new)))])
    shown = capsys.readouterr()
    assert message in shown.out + shown.err
    assert len(shown.err.splitlines()) <= 1


def test_lengths_are_not_complex(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = Path("cases/planar-four-bar.toml").read_text()
    text = text.replace("[parameters]", '[parameters]\nbb = "1 + I"')
    assert main(["show", str(with_parameters(tmp_path, text))]) == 2
    assert "unknown name 'I'" in capsys.readouterr().err


def test_complex_constants_of_bertini_may_be_set(tmp_path: Path) -> None:
    path = tmp_path / "input"
    path.write_text(
        "variable_group x;\nconstant a, b;\na = 1 + I;\nb = a^2;\nfunction f;\nf = x - b;\n"
    )
    assert np.allclose(points_of(nag.solve(path)), [[2j]])
    case = nag.read_case(path, {"a": "2 - I"})
    assert str(case.parameters["b"]) == "3 - 4*I"
    assert np.allclose(points_of(nag.solve(case)), [[3 - 4j]])


CIRCLE = ("(x^2 + y^2 - 1)^2*(x - 2)", "(x^2 + y^2 - 1)^2*(y - I)")


def test_a_real_curve_of_complex_equations_is_found() -> None:
    curve = next(c for c in nag.decompose(complex_system(*CIRCLE)).components if c.dimension)
    found, real = nag.find_real_points(curve), nag.find_real_curve(curve)
    assert (found.reality, found.each_piece, found.dimensions) == (Reality.FOUND, True, (1,))
    assert np.abs((found.points**2).sum(axis=1) - 1).max() < 1e-12
    assert (real.variables, real.counted()) == (("x", "y"), {PieceKind.CLOSED_LOOP: 1})
    samples = sample_real(curve, 5).points
    assert np.abs((samples[:, :2].real ** 2).sum(axis=1) - 1).max() < 1e-12
    assert np.array_equal(samples.imag, np.tile([0, 0, 1], (5, 1)))


def test_curves_that_are_not_their_own_conjugates_have_isolated_real_points() -> None:
    """The plane x = i y + 1 and a sphere meet in a circle through one real point, or in two."""
    (conic,) = nag.decompose(complex_system("x - I*y - 1", "x^2 + y^2 + z^2 - 5")).components
    found = nag.find_real_points(conic)
    assert found.reality is Reality.FOUND and found.each_piece
    assert sorted(found.points.round(12).tolist()) == [[1, 0, -2], [1, 0, 2]]
    curve = nag.find_real_curve(conic)
    assert curve.complete and curve.counted() == {PieceKind.POINT: 2}
    (conic,) = nag.decompose(complex_system("x - I*y - 1", "x^2 + y^2 + z^2 + 5")).components
    assert nag.find_real_points(conic).reality is Reality.NONE


def test_a_finite_set_of_complex_equations_has_the_real_points_that_solve_says() -> None:
    given = complex_system("(x - 1)*(x - I)", "y - 2")
    kinds = [nag.find_real_points(c) for c in nag.decompose(given).components]
    assert sorted(len(kind) for kind in kinds) == [0, 1]
    (real,) = (kind.points for kind in kinds if len(kind))
    assert real.tolist() == [[1, 2]] == [s.point[:2].real.tolist() for s in nag.solve(given).real]


def test_membership_and_local_dimension_take_complex_points() -> None:
    found = nag.decompose(complex_system("(x - I*y)*(x^2 + y*I + z^2)"))
    for point in ([1j, 1, "1 + 2*I"], {"x": "I", "y": 1, "z": 1 + 2j}, [1j, 1, 1 + 2j, 1j]):
        answers = nag.member(found, point).answers
        assert {c.degree: a for c, a in zip(found.components, answers, strict=True)} == {
            1: Membership.MEMBER,
            2: Membership.FOREIGN,
        }
        assert nag.local(found.system, point).dimension == 2
    sampled = found.components[0].sample(0, 1)[0]
    assert found.components[0].contains(sampled[:3]) and found.components[0].contains(sampled)
    assert nag.member("x^2 + y^2", [1j, 1]).complete


def test_singular_points_of_complex_equations_are_told_without_the_unit(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "cusp.txt").write_text("imaginary I\ny^2 - I*x^3\n")
    assert main(["singular", str(tmp_path / "cusp.txt"), "--quiet"]) == 0
    out = capsys.readouterr().out
    assert "point   x = 0, y = 0\n" in out and "tangent cone y^2 = 0" in out
    assert "tangent space" not in out
    points = nag.singular(tmp_path / "cusp.txt")[0].to_numpy()
    assert points.shape == (1, 2) and not points.any()


def test_components_of_complex_equations_meet_and_have_singular_points() -> None:
    found = nag.decompose(complex_system("x - I*y + z^2", "(x + y + I*z)*(x - I*y + 2)"))
    conic = next(i for i, c in enumerate(found.components, 1) if c.degree == 2)
    line = next(i for i, c in enumerate(found.components, 1) if c.degree == 1)
    assert nag.intersect(found, conic, line).components[0].degree == 1
    assert len(nag.singular(found).sets) == 2
    assert nag.singular(nag.decompose(complex_system(*CIRCLE))).complete


def test_real_points_that_conjugate_sets_share_count_once() -> None:
    found = real_points_of_first("x^2 + y^2 + z^2 + I*(x - y)")
    assert (found.points.round(9).tolist(), found.dimensions) == ([[0, 0, 0]], (0,))
    found = real_points_of_first("z + I*((x^2 + y^2 - 4)^2 + x^2)")
    assert sorted(found.points.round(6).tolist()) == [[0, -2, 0], [0, 2, 0]]
    assert found.each_piece


def real_points_of_first(*equations: str) -> nag.RealPieces:
    return nag.find_real_points(nag.decompose(complex_system(*equations)).components[0])


def test_real_samples_are_of_all_sets_that_have_real_points() -> None:
    surface = nag.decompose(complex_system("z + I*(x^2 + y^2 + 1)*(x^2 + y^2 - 4)"))
    points = nag.sample(surface, count=6, real=True).points[:, :3]
    assert np.abs((points**2).sum(axis=1) - 4).max() < 1e-12
    surface = nag.decompose(complex_system("z + I*(x^2 + y^2 - 4)*(x^2 + y^2 - 1)"))
    points = nag.sample(surface, count=20, real=True).points[:, :2]
    assert set((points**2).sum(axis=1).real.round(9)) == {1, 4}


def test_points_that_are_nearly_real_are_not_called_so() -> None:
    for component in nag.decompose("(x - 1)^2 + 1/10^60").components:
        assert nag.find_real_points(component).reality is Reality.NONE
    for component in nag.decompose("(x - 1)^2 - 1/10^60").components:
        assert nag.find_real_points(component).points.tolist() == [[1]]
    kinds = [nag.find_real_points(c) for c in nag.decompose("x^4 - 4").components]
    assert [(len(kind), kind.each_piece) for kind in kinds] == [(1, True)] * 2 + [(0, True)] * 2


def test_dimensions_at_real_points_are_said_where_the_set_is_smooth() -> None:
    """Real points at which complex sheets meet lie on less than the component's dimension."""
    cone = nag.decompose("x^2 + y^2 + z^2").components[0]
    assert set(nag.find_real_points(cone).dimensions) == {-1}
    # Two conjugate surfaces, which meet in a circle.
    for component in nag.decompose(["x^2 + y^2 + z^2 + w^2 - 1", "x*y + z*w - 1/2"]).components:
        assert set(nag.find_real_points(component).dimensions) == {1}
    sphere = nag.decompose("x^2 + y^2 + z^2 - 1").components[0]
    assert set(nag.find_real_points(sphere).dimensions) == {2}


def test_degrees_and_sympys_equations_are_those_without_the_unit() -> None:
    given = complex_system("x^2 + I*y")
    assert given.degrees[:-1] == (2,)
    x, y = sympy.symbols("x y")
    assert given.to_sympy() == [x**2 + sympy.I * y]


def test_multidegrees_count_groups_of_the_systems_own_variables(tmp_path: Path) -> None:
    given = nag.system(["x^2 + I*y^2 - 2"], ["x", "y"], groups=[["x"], ["y"]])
    found = nag.decompose(given)
    assert found[0].multidegree.tolist() == [2, 2]
    nag.write(found, tmp_path / "a.json")
    assert nag.read(tmp_path / "a.json") == found


@pytest.mark.parametrize(
    ("equation", "kinds"),
    [
        ("x*y + I*x", {1: 1, -1: 1}),
        ("(x^2 + y^2 - 1)*(y - I)*(x + I*y - 2)", {1: 1, 0: 1, -1: 1}),
        ("x*(x + I*y - 1)", {1: 1, 0: 1}),
    ],
)
def test_real_points_of_complex_curves_beside_real_ones_are_decided(
    equation: str, kinds: dict[int, int]
) -> None:
    """Real dimensions of the components, -1 for none; each meets the real ones in points."""
    found = [nag.find_real_points(c) for c in nag.decompose(complex_system(equation)).components]
    assert all(each.each_piece for each in found)
    dimensions = [max(each.dimensions, default=-1) for each in found]
    assert {d: dimensions.count(d) for d in set(dimensions)} == kinds
    assert {each.reality for each in found if not len(each)} <= {Reality.NONE}


@pytest.mark.parametrize(
    ("equations", "kinds"),
    [
        ("(x - I)*(x^2 + y^2 + z^2 - 1)", {2: 1, -1: 1}),
        ("(x - I)*(z - y)", {2: 1, -1: 1}),
        ("(x^2 + y^2 + z^2 + 1 + I*(x - y))*(x^2 + y^2 + z^2 - 4)", {2: 1, -1: 1}),
        ("(x^2 + y^2 + z^2 + I*(x - y))*(x^2 + y^2 + z^2 - 4)", {2: 1, 0: 1}),
        # The product of what has no real points and a line's plane is no product over Q.
        ("(x - I)*(z + I*y - 2)*z", {2: 1, 1: 1, -1: 1}),
    ],
)
def test_real_points_of_complex_surfaces_beside_real_ones_are_decided(
    equations: str, kinds: dict[int, int]
) -> None:
    """Real dimensions of the components, -1 for none, which is proved."""
    found = [nag.find_real_points(c) for c in nag.decompose(complex_system(equations)).components]
    assert all(each.each_piece for each in found)
    dimensions = [max(each.dimensions, default=-1) for each in found]
    assert {d: dimensions.count(d) for d in set(dimensions)} == kinds
    assert {each.reality for each in found if not len(each)} <= {Reality.NONE}


def test_named_points_may_be_complex(tmp_path: Path) -> None:
    file = tmp_path / "case.toml"
    file.write_text(
        'title = "t"\nkind = "system"\nvariables = ["x", "y"]\nimaginary = "I"\n'
        'equations = ["(x - I*y)*(x + y - 2)"]\n'
        '[[point]]\nname = "p"\nat = { x = "2*I - 1", y = "2 + I" }\n'
        '[[point]]\nname = "q"\nat = { x = 1, y = 1 }\n'
    )
    case = nag.read_case(file)
    assert [point.at for point in case.points] == [(-1 + 2j, 2 + 1j, 1j), (1, 1, 1j)]
    on = [len(nag.member(file, name).on) for name in ("p", "q")]
    assert on == [1, 1] and nag.local(file, "p").dimension == 1
    assert main(["decompose", str(file), "--quiet"]) == 0


COMPLEX_FAMILY = """
title = "Two parabolas"
kind = "system"
variables = ["x", "y"]
imaginary = "i"
equations = ["x^2 - i*a*y", "y^2 - a*x + b"]
[parameters]
a = "3 + 4*i"
b = "1 + 2*i"
[family]
parameters = ["a"]
"""


def residuals(points: np.ndarray, a: complex) -> np.ndarray:
    """Of the members of that family."""
    x, y = points.T
    return np.abs([x**2 - 1j * a * y, y**2 - a * x + 1 + 2j]).max(axis=0)


def test_families_may_have_complex_coefficients_and_values() -> None:
    equations = ["x^2 - I*a*y", "y^2 - a*x + (1 + 2*I)"]
    values = [1, 1 + 1j, 2.5, 0]
    found = nag.solve_family(equations, ["a"], np.array(values)[:, None], "x y")
    # Where a = 0 both are squares, and there are two double zeros.
    assert found.complete.all()
    assert found.counts.tolist() == [4, 4, 4, 2]
    assert found.variables == ("x", "y") and found.points.shape == (4, 4, 2)
    for a, points in zip(values, found, strict=True):
        assert residuals(points, a).max() < 1e-12
    known = nag.solve_family(equations, ["a"], [[2]], "x y", known=([1], found.at(0)), count=4)
    assert residuals(known.at(0), 2).max() < 1e-12 and known.complete.all()
    named = nag.solve_family(["x^2 = j*a"], ["a"], [[4]], imaginary="j")
    assert np.abs(named.at(0) ** 2 - 4j).max() < 1e-12


def test_complex_members_of_real_families_are_solved_by_themselves() -> None:
    found = nag.solve_family(["x^2 - a", "x*y - b"], ["a", "b"], [[1j, 1], [0, 1j], [0, 0]])
    assert found.complete.all()
    # Two; none; and a line, on which none is isolated.
    assert found.counts.tolist() == [2, 0, 0]


def test_members_of_complex_families_in_files_are_solved(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, values, out = (tmp_path / name for name in ("case.toml", "values.csv", "points.npz"))
    case.write_text(COMPLEX_FAMILY)
    values.write_text("a\n1\n(1+2j)\n2*I\n-0.5 + 2i\n0\n")
    said = ["family", str(case), "--values", str(values), "--points", str(out), "--quiet"]
    assert main(said) == 0
    assert "5 of 5 members" in capsys.readouterr().out
    with np.load(out) as arrays:
        assert arrays["variables"].tolist() == ["x", "y"]
        assert arrays["values"].ravel().tolist() == [1, 1 + 2j, 2j, -0.5 + 2j, 0]
        for a, points, status in zip(
            arrays["values"].ravel(), arrays["points"], arrays["status"], strict=True
        ):
            assert residuals(points[status <= 1], a).max() < 1e-12
    assert main(["solve", str(case), "--set", "a=1+i", "--quiet"]) == 0
    assert "4 isolated solutions, 0 real" in capsys.readouterr().out
    by_loops = nag.solve(case, start="parameter")
    assert by_loops.solutions
    points = np.array([s.point for s in by_loops.solutions])
    assert residuals(points[:, :2], 3 + 4j).max() < 1e-9 and (points[:, 2] == 1j).all()


def test_symmetries_of_complex_families_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "case.toml"
    case.write_text(COMPLEX_FAMILY + '[[family.map]]\nimage = { x = "-x" }\n')
    assert main(["solve", str(case)]) == 2
    said = capsys.readouterr().err
    assert "[family]: map: is not for a family with complex coefficients; leave it out" in said


def test_components_are_followed_along_a_parameter_of_complex_equations(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "case.toml"
    case.write_text(COMPLEX_FAMILY.partition("[family]")[0].replace(', "y^2 - a*x + b"', ""))
    text = case.read_text().replace("i*a*y", "i*a*y + b")
    case.write_text(text)
    assert main(["decompose", str(case), "--sweep", "a=0:2:3", "--quiet"]) == 0
    said = capsys.readouterr().out
    # A parabola, which is two lines where a = 0.
    assert "2 components of dimension 1, degree 1" in said
    assert said.count("1 component of dimension 1, degree 2") == 2
    assert "followed  3 of 3 values" in said


NAMED = """
title = "A line and a point"
kind = "system"
variables = ["x", "y"]
imaginary = "i"
equations = ["(x - i*y)*(x^2 + y - a)", "(x - i*y)*(x - b)"]
[parameters]
a = "3 + i"
b = 2
[[point]]
name = "on the line"
at = { x = "i*b", y = "b" }
[[point]]
name = "q"
at = { x = "b", y = "a - 4" }
"""


def test_points_are_made_of_parameters_and_the_unit(tmp_path: Path) -> None:
    file = tmp_path / "case.toml"
    file.write_text(NAMED)
    points = {point.name: point.at for point in nag.read_case(file).points}
    assert points == {"on the line": (2j, 2, 1j), "q": (2, -1 + 1j, 1j)}
    # Of real equations as well.
    file.write_text(
        'title = "t"\nkind = "system"\nvariables = ["x", "y"]\nequations = ["x^2 + y^2 + b"]\n'
        '[parameters]\nb = 1\n[[point]]\nname = "p"\nat = { x = "I*b", y = 0 }\n'
    )
    assert nag.read_case(file).points[0].at == (1j, 0)
    assert nag.local(file).dimension == 1


def test_a_unit_has_the_cases_own_name_in_points(tmp_path: Path) -> None:
    file = tmp_path / "case.toml"
    file.write_text(NAMED)
    given = [{"x": "i", "y": 1}, {"x": "I", "y": 1}, ("i", 1), (1j, 1), (1j, 1, 1j)]
    assert {nag.local(file, point).dimension for point in given} == {1}


@pytest.mark.parametrize(
    ("command", "point", "said"),
    [
        ("local", ["q"], "isolated, of multiplicity 1"),
        ("local", ["--at", "q"], "isolated, of multiplicity 1"),
        ("local", ["--at", "on the line"], "local dimension 1"),
        ("local", ["--at", "x = i, y = 1"], "local dimension 1"),
        ("member", ["--at", "q"], "on 1 of 2 components; local dimension 0"),
        ("member", ["--at", "x = i, y = 1"], "on 1 of 2 components; local dimension 1"),
        ("eliminate", ["--at", "on the line", "--onto", "x,y"], "x - y*i = 0"),
        ("eliminate", ["--at", "x = -2, y = 2*i", "--onto", "x,y,i"], "x - y*i = 0"),
    ],
)
def test_commands_take_complex_points(
    command: str,
    point: list[str],
    said: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    file = tmp_path / "case.toml"
    file.write_text(NAMED)
    assert main([command, str(file), *point, "--quiet"]) == 0
    assert said in capsys.readouterr().out


@pytest.mark.parametrize(
    ("point", "said"),
    [
        ("q", "the component is a point; there is nothing to eliminate from"),
        ("x = 1, y = i", "--at: it does not satisfy the equations"),
        ("r", "has no point 'r'; it has 'on the line', 'q'"),
    ],
)
def test_what_cannot_be_eliminated_from_is_said(
    point: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "case.toml"
    file.write_text(NAMED)
    assert main(["eliminate", str(file), "--at", point, "--quiet"]) == 2
    assert said in capsys.readouterr().err


def test_points_of_the_conjugate_system_are_refused_in_exports(tmp_path: Path) -> None:
    system = nag.system(["x*y - I", "x^2 + y - 1"], imaginary="I")
    for name, found in (("solved", nag.solve(system)), ("decomposed", nag.decompose(system))):
        path = tmp_path / f"{name}.json"
        nag.write(found, path)
        text = json.loads(path.read_text())
        places = text["solutions"] if name == "solved" else text["components"]
        for each in places:
            key = "point" if name == "solved" else "points"
            points = [each[key]] if name == "solved" else each[key]
            for point in points:
                for entry in point:
                    entry[1] = -entry[1]
        path.write_text(json.dumps(text))
        with pytest.raises(nag.NagError, match="conjugate system"):
            nag.certify(path)


@pytest.mark.parametrize("digits", [14, 16, 20, 60])
def test_nearly_real_zeros_of_complex_equations_are_not_real(digits: int) -> None:
    off = f"I/10^{digits}"
    for equations in (
        [f"x - 1 - {off}", "y - x"],
        [f"x^2 - 2 - {off}", "y^3 - x"],
        [f"(x - 1)^2*(x - I) - {off}", "y - x"],
    ):
        assert not nag.solve(nag.system(equations, imaginary="I")).real


def test_real_zeros_of_complex_equations_are_real() -> None:
    for equations, count in (
        (["(x^2 - 2)*(x - I)", "y^3 - x"], 2),
        (["(x - 1)^2*(x - I)", "y - x"], 1),
        (["x^2 + I*y - 4 - 5*I", "x*y - 10"], 1),
    ):
        assert len(nag.solve(nag.system(equations, imaginary="I")).real) == count


@pytest.mark.parametrize(
    ("equations", "count"),
    [
        (["x*(x - I*y)", "x*(y - 2 + I)"], "1 end point lies on it"),
        (
            ["(x-1)*(y-I)*(z-2)", "(x-1)*(z+I)*(y+3)", "(y - I)*(z + I)*x"],
            "3 end points lie on it",
        ),
    ],
)
def test_notes_count_the_points_of_the_system_and_not_those_of_its_conjugate(
    equations: list[str], count: str
) -> None:
    found = nag.solve(nag.system(equations, imaginary="I"))
    (note,) = [n for n in found.notes if "positive dimension" in n]
    assert count in note and len(found.on_components) == int(count[0])


@pytest.mark.parametrize(
    "equations",
    [
        ["(x - I)^2*(y + x) - 1", "(y + 2*I)^2*(y + x) - I*x"],
        ["x^3 - I*x^2*y + y^2 - 1", "x^3 - I*x^2*y + x*y - I"],
        ["x^2*y - I", "x*y^2 - x + I"],
    ],
)
def test_a_bound_counts_the_zeros_of_the_system_and_not_those_of_its_conjugate(
    equations: list[str],
) -> None:
    found = nag.solve(nag.system(equations, imaginary="I"), start="total")
    (number,) = re.findall(r"no more than (\d+)", found.reason)
    assert int(number) == len(found) and found.complete


@pytest.mark.parametrize(
    ("equations", "onto", "found"),
    [
        (["x - I*y"], "x,y", ["x - I*y"]),
        (["y - I*x^2", "z - (1 + 2*I)*x^3"], "y,z", ["(3 - 4*I)*y^3 - I*z^2"]),
        (["y - I*x^2", "z - x^3"], "x,y,z", ["x*z + y^2", "x*y - I*z", "x^2 + I*y"]),
        (["(x^2 + y^2 - 1)*(x - 2*I*y)*(x + 2*I*y + 3)"], "x,y", None),
        (["x^2 - 2*I*y^2"], "x,y", ["x - (1 + I)*y"]),
        (["y - I*sqrt(2)*x^2", "z - x^3"], "y,z", ["y^3 + 2*I*sqrt(2)*z^2"]),
    ],
)
def test_equations_of_a_complex_component_are_its_own_and_not_those_of_its_conjugate(
    equations: list[str], onto: str, found: list[str] | None
) -> None:
    components = nag.decompose(complex_system(*equations))
    images = [nag.eliminate(components, onto, k) for k in range(1, len(components) + 1)]
    for image, component in zip(images, components, strict=True):
        assert image.defines and image.self_conjugate and image.imaginary == "I"
        assert image.to_sympy() == [sympy.sympify(f) for f in image.equations]
        for point in component.points:
            at = dict(zip(components.system.own_variables, point, strict=False))
            assert all(abs(f.subs(at).evalf()) < 1e-9 for f in image.to_sympy())
    if found is None:
        factors = {"x^2 + y^2 - 1", "x - 2*y*I", "x + 2*y*I + 3"}
        assert {f for image in images for f in image.equations} == factors
    else:
        expected = [sympy.sympify(f) for f in found]
        ratios = [
            [sympy.simplify(f / g) for f, g in zip(i, expected, strict=True)]
            for i in (image.to_sympy() for image in images)
        ]
        assert any(all(r.is_number for r in own) for own in ratios)


def test_maps_of_a_complex_component_have_gaussian_coefficients() -> None:
    found = nag.eliminate(complex_system("x^2 + y^2 + z^2 - 1", "x - I*y"))
    assert found.variables == ("x", "y", "z") and found.names == ("x",) and not found.missing
    assert "y = -x*I" in str(found) and found.defines


def test_conjugates_over_the_gaussian_rationals_are_taken_together() -> None:
    found = nag.eliminate(complex_system("x^2 - I*y^2"), "x,y")
    assert found.equations == ("x^2 - y^2*I",) and found.together == (1, 2)
    assert "of components 1 and 2 together" in repr(found)


def test_an_image_that_is_not_its_own_conjugate_says_so_at_the_prompt() -> None:
    found = nag.eliminate(nag.decompose("x^2 + y^2"), "x,y")
    assert found.self_conjugate is False and not found.defines
    assert "1 equation of it and its conjugate together" in repr(found)


def test_what_is_handed_out_are_the_values_of_the_variables_in_their_order() -> None:
    roots = nag.solve(["x^2 = I", "y = 2*x"], imaginary="I")
    assert roots[0].to_numpy().tolist() == roots.to_numpy()[0].tolist() == [*roots[0].point[:2]]
    assert roots[:1].to_numpy().shape == (1, 2)
    assert [*roots[0].to_sympy()] == [*sympy.symbols("x y")]
    assert [*roots[0].to_sympy("u, v")] == [*sympy.symbols("u v")]
    assert roots[1:].to_dataframe().columns[:2].tolist() == ["x", "y"]
    real = nag.solve(["x^2 = 2", "y = 2*x"])[0]
    assert repr(roots[0]).count(", ") == repr(real).count(", ")


def test_too_few_coordinates_are_counted_without_the_imaginary_unit() -> None:
    circle = nag.system("x^2 + y^2 = I", imaginary="I")
    for point in ((1,), {"x": 1}, {"x": 1, "z": 2}, (1, 2, 3, 4)):
        for ask in (nag.local, nag.member):
            with pytest.raises(nag.NagError) as error:
                ask(circle, point)
            assert "I" not in str(error.value)
    with pytest.raises(nag.NagError, match=r"1 coordinate is given; there are 2 variables: x, y$"):
        nag.local(circle, (1,))


@pytest.mark.parametrize(
    "ask",
    [
        lambda *given, **how: nag.local(*given, (0, 1), **how).dimension,
        lambda *given, **how: nag.member(*given, {"v": 1, "u": 0}, **how).numbers,
        lambda *given, **how: nag.sample(*given, **how).points.shape,
        lambda *given, **how: len(nag.singular(*given, **how)),
        lambda *given, **how: nag.intersect(*given, 1, 1, **how).dimension,
        lambda *given, **how: len(nag.eliminate(*given, **how).equations),
        lambda *given, **how: bool(nag.certify(*given, **how)),
        lambda *given, **how: nag.model(*given, **how).system.variables,
        lambda *given, **how: nag.find_real_points(*given, **how).points.tolist(),
    ],
)
def test_every_question_of_equations_takes_the_letter_of_the_unit(ask: Any) -> None:
    """And the variables in an order of one's own, in which a point is given."""
    equations, system = "v - i*u - 1", nag.system("v - i*u - 1", "u v", imaginary="i")
    assert ask(equations, variables="u v", imaginary="i") == ask(system)
    for known in (system, nag.decompose(system)[0]):
        with pytest.raises(nag.NagError, match=r"^imaginary: is for equations; what is given has"):
            ask(known, imaginary="i")


@pytest.mark.parametrize(
    ("root", "value"),
    [
        ("sqrt(-3)", "sqrt(3)*I"),
        ("sqrt(-4)/2", "I"),
        ("sqrt(-2)*sqrt(-8)", "-4"),
        ("sqrt(2 - sqrt(5))", "sqrt(sqrt(5) - 2)*I"),
        ("sqrt(I*I)", "I"),
    ],
)
def test_roots_of_negative_numbers_are_multiples_of_the_unit(
    root: str, value: str, tmp_path: Path
) -> None:
    wanted = nag.system(["x^2 - 2*I^2", f"y - ({value})*x"], "x y")
    assert nag.system(["x^2 + 2 + 0*I", f"y - {root}*x"], "x y") == wanted
    assert nag.system(["x^2 + 2", "y - a*x + 0*I"], "x y", parameters={"a": root}) == wanted
    assert nag.system(["x^2 + 2", f"y - {root}*x"], "x y") == wanted
    text, case = tmp_path / "roots.txt", tmp_path / "roots.toml"
    text.write_text(f"variables x y\nx^2 + 2\ny = {root}*x\n")
    case.write_text(
        'title = "roots"\nkind = "system"\nvariables = ["x", "y"]\n'
        f'equations = ["x^2 + 2", "y - {root}*x"]\n'
    )
    for file in (text, case):
        assert nag.read_case(file).system == wanted


@pytest.mark.parametrize("function", ["sqrt", "cos"])
def test_functions_of_complex_numbers_are_refused_as_that(function: str) -> None:
    with pytest.raises(nag.EquationError, match=f"{function} of a complex number is not worked"):
        nag.system([f"x - {function}(1 + I)"], "x")
    with pytest.raises(nag.EquationError, match=f"{function} of a variable is no polynomial"):
        nag.system([f"x*I - {function}(x)"], "x")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1.5-2.25i", 1.5 - 2.25j),
        ("-0.125i", -0.125j),
        ("1e+200+0i", 1e200),
        ("(1.5e-3-2j)", 1.5e-3 - 2j),
        ("1/2 + 2I", 0.5 + 2j),
        ("3i/4", 0.75j),
    ],
)
def test_a_coordinate_is_read_as_points_are_printed(
    text: str, value: complex, tmp_path: Path
) -> None:
    at = nag.system("x*y - 2")
    assert complex(coordinates([text, 1], ["x", "y"])[0]) == value
    assert complex(point_at(f"x = {text}, y = 1", at)[0]) == value
    case = tmp_path / "case.toml"
    case.write_text(
        'title = "a point"\nkind = "system"\nvariables = ["x"]\nequations = ["x^2 - 1"]\n'
        f'[[point]]\nname = "p"\nat = {{ x = "{text}" }}\n'
    )
    (point,) = nag.read_case(case).points
    assert complex(point.at[0]) == value


def test_the_singular_points_that_are_printed_are_taken_as_points(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "curve.txt"
    file.write_text("(y^2 + 4)^2 - x^3\n")
    assert main(["singular", str(file), "--quiet"]) == 0
    points = re.findall(r"^point +(.*)$", capsys.readouterr().out, re.MULTILINE)
    assert sorted(points) == ["x = 0, y = -2i", "x = 0, y = 2i"]
    for point in points:
        assert main(["local", str(file), "--at", point, "--quiet"]) == 0
        assert "a singular point" in capsys.readouterr().out
