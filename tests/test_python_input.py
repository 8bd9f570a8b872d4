"""What a Python session gives is read exactly, or refused with the argument and the mend."""

from __future__ import annotations

import subprocess
import sys
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

import nag
from nag.algebra.from_python import exact_number, system
from nag.algebra.number import square_root
from nag.algebra.symmetry import SymmetryError
from nag.algebra.tokens import natural_order


@pytest.mark.parametrize(
    ("value", "exact"),
    [
        (3, Fraction(3)),
        (Fraction(5, 6), Fraction(5, 6)),
        (Decimal("1e-3"), Fraction(1, 1000)),
        ("5/6", Fraction(5, 6)),
        ("sqrt(2)/2", square_root(Fraction(1, 2))),
        (0.1, Fraction(1, 10)),
        (1e-20, Fraction(1, 10**20)),
        (np.float32(0.1), Fraction(1, 10)),
        (np.float64(0.25), Fraction(1, 4)),
        (np.int64(-7), Fraction(-7)),
    ],
)
def test_numbers_of_every_kind_are_exact(value: Any, exact: Any) -> None:
    assert exact_number(value) == exact


@given(st.floats(1e-200, 1e200) | st.floats(-1e200, -1e-200))
def test_a_float_is_its_shortest_decimal(value: float) -> None:
    exact = exact_number(value)
    assert exact == Fraction(repr(value))
    assert float(exact) == value


@pytest.mark.parametrize("value", [None, True, 1j, float("nan"), float("inf"), "x", [1], "1/0"])
def test_what_is_no_number_is_refused_by_its_place(value: Any) -> None:
    with pytest.raises(ValueError, match=r"^axis\[2\]: "):
        exact_number(value, "axis[2]")


def test_variables_are_in_alphabetical_order_with_numbers_by_value() -> None:
    assert system(["x10*b + x2", "a - x2"]).variables == ("a", "b", "x2", "x10")
    names = ["y", "x" + "1" * 5000, "x10", "x02", "x1y10", "x1y9", "x0", "x"]
    in_order = ["x", "x0", "x1y9", "x1y10", "x02", "x10", "x" + "1" * 5000, "y"]
    assert sorted(names, key=natural_order) == in_order
    assert system(["y - x"], "y x").variables == ("y", "x")


def test_parameters_are_no_variables() -> None:
    made = system(["x = a*y"], parameters={"a": 0.5}, groups=[["y"], [0]])
    assert made.text() == ["x - 1/2*y"]
    assert made.groups == ((1,), (0,))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((["x", "y +"],), r"equations\[1\]: column 4: something is missing"),
        ((["x", None],), r"equations\[1\]: nothing is no number"),
        ((["x + z"], "x y"), r"equations\[0\]: column 5: unknown name 'z'"),
        ((["x"], "x x"), "variables: 'x' is there twice"),
        ((["x"], ["2x"]), "variables: '2x' cannot name a variable"),
        (([nag.Polynomial.variable(2, 0)],), "variables: a nag.Polynomial has no names in it"),
        (([nag.Polynomial.variable(2, 0)], "x"), r"equations\[0\]: a polynomial in 2 variables"),
        (({"x": 1},), "equations: something of type dict"),
    ],
)
def test_equations_that_make_no_sense_are_refused(arguments: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        system(*arguments)


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"seed": -1}, "seed: -1 is given; give a whole number from 0 up"),
        ({"seed": 1.0}, "seed: 1.0 is given"),
        ({"threads": 0}, "threads: 0 is given; give a whole number from 1 up"),
        ({"settings": "quick"}, "settings: 'quick' is unknown; use fast, default, careful"),
    ],
)
def test_arguments_of_a_run_are_checked_before_it(keywords: Any, message: str) -> None:
    for run in (nag.solve, nag.decompose):
        with pytest.raises(ValueError, match=message):
            run(["x^2 - 2"], **keywords)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (3, "system: something of type int is given"),
        (None, "system: something of type NoneType is given"),
        ({"x": 1}, "system: something of type dict is given"),
    ],
)
def test_what_is_no_problem_is_refused(given: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        nag.decompose(given)


def test_a_graph_is_pointed_to_from_graph() -> None:
    networkx = pytest.importorskip("networkx")
    with pytest.raises(ValueError, match=r"nag\.Mechanism\.from_graph\(graph, ground=\.\.\.\)"):
        nag.decompose(networkx.path_graph(3))


def test_symmetries_are_maps_signs_or_signed_permutations() -> None:
    circles = ["(x^2 + y^2 - 1)*(x^2 + y^2 - 4)*(x - 3*y)*(x + 3*y)"]
    flip = nag.SignedPermutation.of_signs((-1, 1))
    answers = [nag.decompose(circles, symmetries=[g]) for g in ({"x": "-x"}, (-1, 1), flip)]
    assert [c.orbit for c in answers[0].components] == [2, 1, 1]
    assert answers[0] == answers[1] == answers[2]


@pytest.mark.parametrize(
    ("symmetry", "message"),
    [
        ({"x": "z"}, r"symmetries\[0\]: unknown variable 'z'"),
        ((1, 2), r"symmetries\[0\]: each variable must have a sign"),
        ("x", r"symmetries\[0\]: give a dict"),
        ((-1, 1), "symmetries: it does not become a combination"),
    ],
)
def test_what_is_no_symmetry_is_refused(symmetry: Any, message: str) -> None:
    with pytest.raises(SymmetryError, match=message):
        nag.decompose(["x*y + x - y"], symmetries=[symmetry])


def test_a_models_symmetries_are_used() -> None:
    case = nag.read_case("cases/spatial/assembled-4r.toml")
    model = nag.model(case.mechanism, "E")
    assert [g.n for g in model.symmetries] == [8, 8, 8]
    answer = nag.decompose(model)
    assert [(c.degree, c.orbit) for c in answer.components] == [(1, 8)]


def test_cases_and_mechanisms_are_the_same_problem() -> None:
    case = nag.read_case("cases/bennett.toml")
    assert nag.decompose(case) == nag.decompose(case.mechanism)


def test_nothing_that_is_given_loads_sympy_or_networkx() -> None:
    code = (
        "import sys, nag; nag.system(['x^2 - 2*y', 0.5, 'x = y']); nag.solve('x^2 = 2'); "
        "print(*sorted({'sympy', 'networkx'} & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True
    )
    assert done.stdout == "\n"


@pytest.mark.parametrize(
    ("equations", "message"),
    [
        (["x^2 + I", "y - x"], r"equations\[0\]: 'I' looks like the imaginary unit"),
        (["y - x", "x^2 + 1+2*i"], r"equations\[1\]: 'i' looks like .* list all variables"),
        (["x^2 - 2i"], "'i' looks like"),
        (["x^2 + j", "y - x"], r"equations\[0\]: 'j' looks like the imaginary unit"),
        (["x^2 + J", "y - x"], r"equations\[0\]: 'J' looks like the imaginary unit"),
        (["x^2 - 2j"], "'j' looks like"),
        (["x^2 + ii", "y - x"], r"equations\[0\]: 'ii' looks like the imaginary unit"),
        (["x^2 - 2im"], "'im' looks like"),
    ],
)
def test_the_imaginary_unit_is_never_taken_for_a_variable(equations: Any, message: str) -> None:
    for command in (nag.system, nag.solve, nag.decompose):
        with pytest.raises(ValueError, match=message) as refused:
            command(equations)
        assert "\n" not in str(refused.value)


@pytest.mark.parametrize("name", ["nan", "NaN", "inf", "Infinity"])
def test_what_is_no_finite_number_is_a_variable_only_where_it_is_listed(name: str) -> None:
    texts = [f"x + {name}*y = 1", "x - y = 2"]
    message = f"equations\\[0\\]: '{name}' looks like a value that is no finite number; if it is"
    for command in (nag.system, nag.solve, nag.decompose):
        with pytest.raises(nag.EquationError, match=message) as refused:
            command(texts)
        assert "\n" not in str(refused.value)
    assert nag.system(texts, ["x", "y", name]).variables == ("x", "y", name)
    assert nag.system(texts, parameters={name: 2}).variables == ("x", "y")


@pytest.mark.parametrize(
    "numbers",
    [[1, 0, -2], (1.0, 0, -2), np.array([1, 0, -2]), np.poly1d([1, 0, -2]), [Fraction(1, 2)]],
)
def test_numbers_alone_are_no_equations(numbers: Any) -> None:
    for variables in (None, "x"):
        with pytest.raises(nag.EquationError, match="of numbers is given; the roots of a poly"):
            nag.solve(numbers, variables)


def test_numbers_of_pandas_alone_are_no_equations() -> None:
    pandas = pytest.importorskip("pandas")
    with pytest.raises(nag.EquationError, match="an array of numbers is given; the roots"):
        nag.solve(pandas.Series([1.0, 0, -2]))
    assert nag.solve(pandas.Series(["x - 1"])).variables == ("x",)


def test_zeros_are_equations_that_came_out_empty() -> None:
    assert len(nag.system([0, 0], ["x"]).polynomials) == 2


def test_the_nodes_of_a_graph_are_no_equations() -> None:
    graph = pytest.importorskip("networkx").Graph([("a", "b")])
    for ask in (nag.system, nag.solve, nag.decompose, nag.mobility, nag.model):
        with pytest.raises(nag.NagError, match="networkx graph is given; make it a mechanism"):
            ask(graph)


def test_the_imaginary_unit_is_refused_wherever_numbers_are_read() -> None:
    with pytest.raises(ValueError, match=r"nonzero\[0\]: 'I' looks like"):
        nag.system(["x^2 - 1"], nonzero=["x - I"])
    with pytest.raises(ValueError, match=r"parameters\['a'\]: 'i' looks like .* called 'I' here"):
        nag.system(["x^2 - a"], parameters={"a": "i"})
    with pytest.raises(ValueError, match=r"'i' looks like .* or list it among the variables"):
        nag.system(["x^2 - i"], ["x"])
    with pytest.raises(ValueError, match="terms: give a dict"):
        nag.Polynomial(1, {(1,): 1j})


def test_a_variable_that_is_listed_may_have_any_letter() -> None:
    assert nag.system(["x^2 + I"], ["x", "I"]).variables == ("x", "I")
    assert nag.system(["i^2 + j"], "i j").variables == ("i", "j")
    known = nag.system(["x^2 + I"], parameters={"I": 3})
    assert str(known.polynomials[0]) == str(nag.system(["x^2 + 3"]).polynomials[0])


def test_an_equation_may_be_a_complex_number_as_it_may_be_a_real_one() -> None:
    assert nag.system(["x^2 - 1", 1 + 2j]).text() == ["x^2 - 1", "2*I + 1", "I^2 + 1"]
    assert nag.system(["x^2 - 1", np.complex64(2)]) == nag.system(["x^2 - 1", 2])
    never = nag.solve(["x^2 - 1", 1 + 2j])
    assert never.complete and not never.solutions


@pytest.mark.parametrize("name", ["π", "Pi"])
def test_pi_is_the_constant_by_each_of_its_names_unless_it_is_declared(name: str) -> None:
    texts = [f"{name}*x^2 + y^2 = 5", "x*y = 2"]
    constant = nag.system(["pi*x^2 + y^2 = 5", "x*y = 2"])
    assert nag.system(texts) == nag.system(texts, "x y") == constant
    assert nag.system(texts, ["x", "y", name]).variables == ("x", "y", name)
    assert nag.system(texts, parameters={name: 3}) == nag.system(["3*x^2 + y^2 = 5", "x*y = 2"])
    assert nag.system("x = a", parameters={"a": f"{name}/2"}) == nag.system("x = pi/2")


def test_a_name_is_not_both_the_unit_and_something_else() -> None:
    for how in ({"variables": "x i"}, {"parameters": {"i": 2}}):
        with pytest.raises(nag.EquationError, match=r"^imaginary: 'i' is taken; write a letter"):
            nag.system(["x^2 - i"], imaginary="i", **how)  # type: ignore[arg-type]


def test_one_end_point_lies_on_a_set_and_several_do() -> None:
    (one,) = nag.solve(["x^2 + t", "y - x"]).notes
    assert one.endswith("1 end point lies on it and is no isolated solution")
    (two,) = nag.solve(["(x^2 + t)*(x - 3*t)", "y - x"]).notes
    assert "end points lie on it and are no" in two


@pytest.mark.parametrize("ask", [nag.system, nag.solve, nag.decompose, nag.problem])
@pytest.mark.parametrize("how", [{}, {"variables": ""}])
def test_no_equations_in_no_variables_are_refused(ask: Any, how: Any) -> None:
    with pytest.raises(nag.NagError, match=r"^equations: none are given; give texts"):
        ask([], **how)
    assert nag.decompose([], "x y").dimension == 2


def test_names_are_given_in_the_same_ways_everywhere() -> None:
    found = nag.decompose(["z = x^2", "y = x^3"])
    ways = ["y, z", "y z", ["y", "z"], sympy.symbols("y z")]
    assert len({str(nag.eliminate(found, names).equations) for names in ways}) == 1
    assert {found[0].project(names).degree for names in ways} == {3}
    assert found[0].project(sympy.Symbol("y")).degree == found[0].project("y").degree == 1
    assert nag.system("x*y*z", groups=["x, y", "z"]).groups == ((0, 1), (2,))
    indexed = nag.system("x[1,2] - y", "x[1,2], y")
    assert indexed.variables == ("x[1,2]", "y")
    assert [str(f) for f in nag.eliminate(indexed, "x[1,2], y").equations] == ["x[1,2] - y"]


@pytest.mark.parametrize("point", [b"10", bytearray(b"10"), {1, 2}, (x for x in (1, 1)), "11"])
def test_a_point_has_numbers_in_an_order_that_can_be_read_again(point: Any) -> None:
    system, line = nag.system("x - y"), nag.decompose("x - y")
    for ask in (
        lambda: nag.member(line, point),
        lambda: line[0].contains(point),
        lambda: nag.local_dimension(system, point),
    ):
        with pytest.raises(nag.NagError, match=r"point: .* (is given|is the name of none); give "):
            ask()


def test_symbols_of_one_name_are_one_symbol() -> None:
    x, real, y = sympy.Symbol("x"), sympy.Symbol("x", real=True), sympy.Symbol("y")
    message = "two symbols are named 'x', with different assumptions; use one of them throughout"
    for place, ask in (
        ("equations[1]", lambda: nag.solve([real - 1, x - y])),
        ("equations[0]", lambda: nag.solve([real - x])),
        ("nonzero[0]", lambda: nag.system([real - 1], nonzero=[x])),
        ("variables", lambda: nag.system([real - 1], [x])),
        ("parameters", lambda: nag.system([real - y], parameters={x: 1})),
    ):
        with pytest.raises(nag.EquationError) as refused:
            ask()
        assert str(refused.value) == f"{place}: {message}"
    assert nag.system([real - 1, real - y], [real, y]).variables == ("x", "y")
    assert nag.system([real - 1, "x - y"], "x y").variables == ("x", "y")


def test_what_is_no_equation_gets_advice_that_mends_it() -> None:
    x = sympy.Symbol("x")
    for equation, message in (
        (sympy.Eq(1, 2), "the equation never holds, as sympy says, so there is no solution; corre"),
        (sympy.Eq(1, 1), "the equation always holds, as sympy says; leave it out"),
        (x - 1 == 0, "a truth value is given, as == of Python gives; write Eq"),
        (x**0.5 - 1, "for the root take a variable w, with the equation w\\^2 = x"),
        (sympy.sqrt(x) - 1, "for the root take a variable w, with the equation w\\^2 = x"),
        ("sqrt(x) - 1", "for the root take a variable w, with the equation w\\^2 = x"),
    ):
        with pytest.raises(nag.EquationError, match=rf"equations\[1\]: .*{message}"):
            nag.solve(["x - 1", equation])


def test_a_table_of_points_is_refused_with_the_dict_that_it_makes() -> None:
    frame = pytest.importorskip("pandas").DataFrame([[0, 0], [1, 0], [0, 1]], index=list("ABC"))
    bars = ["AB", "BC", "CA"]
    with pytest.raises(nag.MechanismError, match=r"a table is given; .* frame.T.to_dict\('list'\)"):
        nag.Framework.of(frame, bars)
    placed = nag.Framework.of(frame.T.to_dict("list"), bars)
    assert placed == nag.Framework.of({"A": (0, 0), "B": (1, 0), "C": (0, 1)}, bars)
