"""What the commands ask is asked in Python of whatever describes it, files among that."""

from __future__ import annotations

import ast
import copy
import inspect
import json
import pickle
import pkgutil
import re
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pytest
import sympy
from linkages import CASES

import nag
from nag.cli import main
from nag.questions import EQUATION_OPTIONS, FILE_OPTIONS
from nag.real.curve import PictureVerdict
from nag.solving.certified_paths import PathsError

CIRCLE_AND_LINE = "(x^2 + y^2 - 1)*(x - y)"
NAG = Path(nag.__file__).parent


@pytest.fixture(scope="module")
def export(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("exports") / "found.json"
    nag.write(nag.decompose(CIRCLE_AND_LINE), path)
    return path


def test_what_is_written_is_read_again_equal(export: Path, tmp_path: Path) -> None:
    assert nag.read(export) == nag.decompose(CIRCLE_AND_LINE)
    solved = nag.solve(["x^2 + y^2 - 1", "x - y"])
    nag.write(solved, tmp_path / "solved.json")
    assert nag.read(tmp_path / "solved.json") == solved
    met = nag.intersect(export, 1, 2)
    nag.write(met, tmp_path / "met.json")
    assert nag.read(tmp_path / "met.json") == met
    assert nag.read(CASES / "bennett.toml").kind == "mechanism"


def test_files_cases_mechanisms_and_models_are_asked_alike() -> None:
    path = CASES / "bennett.toml"
    case = nag.read(path)
    every = (path, str(path), case, case.mechanism)
    for given in (*every, nag.model(path)):
        assert [(c.dimension, c.degree) for c in nag.decompose(given)] == [(1, 2)]
        assert nag.local(given).dimension == 1
    for given in (*every, nag.model(path), nag.problem(path)):
        assert nag.mobility(given).local_dimension == 1
        assert nag.model(given).system == nag.model(path).system


def test_modes_are_asked_of_models_as_of_mechanisms() -> None:
    path = CASES / "robots" / "tripteron.toml"
    found = nag.modes(path)
    assert nag.modes(nag.model(path)) == nag.modes(nag.problem(path)) == found


def test_a_system_is_taken_as_it_is_and_an_answer_names_its_own() -> None:
    system = nag.system(["x^2 - 2"])
    assert nag.system(system) is system
    with pytest.raises(nag.NagError, match=r"^variables: a nag\.PolynomialSystem is given"):
        nag.system(system, variables="x")
    with pytest.raises(nag.NagError, match=r"a SolveResult is given.* are its `system`"):
        nag.system(nag.solve(system))


def test_components_are_asked_by_their_numbers(export: Path) -> None:
    found = nag.read(export)
    for given in (export, str(export), found, CIRCLE_AND_LINE):
        line, circle = 1, 2
        assert [c.degree for c in nag.member(given, ("3/5", "4/5")).on] == [2]
        assert np.ptp(nag.sample(given, line, count=4).points @ [1, -1]) < 1e-12
        assert nag.sample(given, circle, count=3, real=True).points.imag.max() == 0
        assert [s.dimension for s in nag.singular(given, circle).sets] == [0, 0]
        assert sum(c.degree for c in nag.intersect(given, line, circle)) == 2
        assert nag.eliminate(given, component=circle, onto="x,y").equations == ("x^2 + y^2 - 1",)
        if given is not CIRCLE_AND_LINE:
            assert nag.certify(given)


def test_points_go_by_names_mappings_and_numbers() -> None:
    case = CASES / "slider-crank.toml"
    names = [point.name for point in nag.read(case).points]
    by_name = nag.local(case, names[0])
    at = dict(zip(nag.read(case).system.variables, nag.read(case).points[0].at, strict=True))
    assert by_name == nag.local(case, at) == nag.local(case, tuple(at.values()))
    with pytest.raises(nag.NagError, match=r"which one\? give a name \('singular, s1 = -1'"):
        nag.local(case)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda: nag.solve("missing.toml"), "missing.toml"),
        (lambda: nag.sample("x - y", component=2), "there is one component, number 1"),
        (lambda: nag.sample("x - y", 2), "component: 2: there is one component, number 1"),
        (lambda: nag.sample("x - y", component=0), "component: 0"),
        (lambda: nag.intersect("x - y", 1, 2), "second: 2"),
        (
            lambda: nag.local("x^2 - 1"),
            "which one\\? give a dict, {'x': 1, ...} or 1 num",
        ),
        (lambda: nag.member("x*y"), "which one\\? give a dict, {'x': 1, ...} or 2 num"),
        (lambda: nag.solve_family("cases/rhombus.toml"), "values: none are given"),
        (lambda: nag.solve_family("x^2 - a", values=[[1]]), "parameters: which are they"),
        (
            lambda: nag.solve("x^2 - 1", set={"a": 1}),
            r"set: says how a file is read; equations are given; nag.system\(equations, param",
        ),
        (
            lambda: nag.decompose(nag.system("x"), format="phc"),
            "format: says how a file is read; a PolynomialSystem is given; give the name of the f",
        ),
        (lambda: nag.check_statements("x^2 - 1"), "^given: the papers give no components of it"),
        (
            lambda: nag.plot(nag.solve(["x^2 - 1", "y"]), "a.svg", onto="x y"),
            "onto: there is no component of dimension 1 to draw",
        ),
        (lambda: nag.certify(3), "system: something of type int is given"),
        (
            lambda: nag.write(nag.local("x*y", (0, 1)), "file.txt"),
            "a file that ends in .txt holds no export, which is JSON; name it .json$",
        ),
        (
            lambda: nag.write("x*y", "points.csv"),
            "no case and no equations are written to a file that ends in .csv; name it .toml",
        ),
        (
            lambda: nag.write_report("cases/bennett.toml", "report.json"),
            "report.json: a file that ends in .json holds no page; name it .html",
        ),
        (
            lambda: nag.write(nag.find_real_points("x^2 - 1", 1), "file"),
            "RealPieces is given; give an answer .* others are kept by pickle",
        ),
        (
            lambda: nag.write(3, "file"),
            "3 is given; give an answer that a command writes as JSON",
        ),
        (
            lambda: nag.eliminate("x - y", onto="z"),
            "'z' is not one of the variables; they are x, y",
        ),
        (lambda: nag.eliminate(["x", "y"]), "nothing to eliminate from"),
        (lambda: nag.eliminate("x*y", point=(0, 0)), "it is singular; name a component"),
        (lambda: nag.eliminate("x*y", point=(1, 2)), "point: it does not satisfy the equations"),
        (lambda: nag.eliminate("x*y", component=1, point=(0, 1)), "component names one already"),
        (lambda: nag.solve(np.array([1.0, 0, -2])), "an array of numbers is given; the roots of"),
        (
            lambda: nag.solve_family(["x = p", "y = q*x"], ["p"], {"p": [1], "q": [2]}),
            "2 equations for 3 unknowns: q, x, y; a family has as many of both, so name parameters",
        ),
        (lambda: nag.mobility("x - y"), "equations are given, which have no bodies; ask nag.local"),
        (lambda: nag.decompose("x*y", method="some"), "method: 'some' is unknown"),
        (lambda: nag.decompose("x*y", starts=3), 'starts: is for method="sampling"'),
        (lambda: nag.decompose("x*y", coordinates="euler"), "coordinates: is for mechanisms"),
        (lambda: nag.sample(nag.decompose("x"), formulation="E"), "formulation: components are"),
    ],
)
def test_what_makes_no_sense_is_one_line(ask, message: str) -> None:
    with pytest.raises(nag.NagError, match=message) as raised:
        ask()
    assert "\n" not in str(raised.value)


def test_an_export_with_a_point_left_out_is_refused(export: Path, tmp_path: Path) -> None:
    value = json.loads(export.read_text())
    circle = value["components"][1]
    circle["degree"] = 1
    for key in ("points", "radii", "digits"):
        del circle[key][1:]
    circle["cut_by"] = [{"equations": 1, "points": 1, "unknowns": [[]]}]
    changed = tmp_path / "changed.json"
    changed.write_text(json.dumps(value))
    with pytest.raises(nag.ComponentError, match="component 2: the sum of its points"):
        nag.member(changed, (1, 0))


def test_what_has_a_length_is_false_where_that_is_zero() -> None:
    assert not nag.solve("x^2 + y^2 - 1") and nag.solve("x^2 - 1")
    assert not nag.decompose(["1"]) and nag.decompose("x^2 + y^2 - 1")
    assert not nag.system([], variables="x") and nag.system(["x"])
    never_real = nag.find_real_points(nag.decompose("x^2 + 1", variables="x").components[0])
    assert len(never_real) == 0 and not never_real
    for module in pkgutil.walk_packages(nag.__path__, "nag."):
        if module.name.endswith("__main__"):
            continue
        for kind in vars(import_module(module.name)).values():
            if isinstance(kind, type) and kind.__module__ == module.name:
                assert not vars(kind).keys() >= {"__len__", "__bool__"}, kind


def test_results_are_sequences_and_tables() -> None:
    solved, found = nag.solve(["x^2 - 2", "y - x"]), nag.decompose(CIRCLE_AND_LINE)
    assert len(solved) == 2 and list(solved) == list(solved.solutions) == [solved[0], solved[-1]]
    assert len(found) == 2 and found[:1] == found.components[:1] and [*found] == [*found.components]
    assert solved.to_numpy().shape == (2, 2) and solved.to_numpy().flags.writeable
    for result in (solved, found):
        again = pickle.loads(pickle.dumps(result))
        assert again == copy.deepcopy(result) == result and "\n" not in repr(result)


def test_solutions_are_shown_in_one_line_and_printed_a_line_each() -> None:
    solved = nag.solve(["x^60 - 1"])
    assert repr(solved.solutions) == "<Solutions: 60 isolated solutions, 2 real>"
    assert repr(solved[:1]) in (
        "<Solutions: 1 isolated solution, 1 real>",
        "<Solutions: 1 isolated solution, 0 real>",
    )
    title, first, *_, last = str(solved.solutions).splitlines()
    assert title == repr(solved.solutions) and first == repr(solved[0]) and last == "and 20 more"


def test_results_are_frames_of_pandas() -> None:
    solved = nag.solve(["x^2 - 2", "y - x"]).to_dataframe()
    assert list(solved.columns)[:3] == ["x", "y", "multiplicity"] and len(solved) == 2
    real = nag.solve(["x^3 - 8", "y - x"]).to_dataframe(real=True)
    assert real["x"].tolist() == [2.0] and real["x"].dtype == float
    complex_ = nag.solve(["x^2 + 1", "y - x"])
    nothing = complex_.to_dataframe(real=True)
    assert list(nothing.columns)[:3] == ["x", "y", "multiplicity"] and len(nothing) == 0
    frame = complex_.to_dataframe()
    frame.loc[:, "x"] = 0
    assert frame["x"].tolist() == [0, 0]
    assert abs(complex_.points[:, 0]).tolist() == pytest.approx([1, 1])
    circle = nag.decompose("x^2 + y^2 = 1")
    for answer in (circle[0], nag.sample(circle), complex_):
        frame, parted = answer.to_dataframe(), answer.to_dataframe(parts=True)
        assert {str(parted[name].dtype) for name in parted} <= {"float64", "int64", "bool"}
        assert [*parted.columns][:2] == ["x.real", "x.imag"]
        assert (parted["x.real"] + 1j * parted["x.imag"]).tolist() == frame["x"].tolist()
    gaussian = nag.solve(nag.system(["x - I"], imaginary="I")).to_dataframe()
    assert list(gaussian.columns)[:2] == ["x", "multiplicity"] and gaussian["x"].tolist() == [1j]
    found = nag.decompose(CIRCLE_AND_LINE).to_dataframe()
    assert found["degree"].tolist() == [1, 2] and found["number"].tolist() == [1, 2]
    for given, real in ((CIRCLE_AND_LINE, False), (CIRCLE_AND_LINE, True), (["x^2 - 4"], True)):
        samples = nag.sample(given, count=3, real=real)
        assert list(samples.to_dataframe().columns) == list(samples.variables)
        assert np.array_equal(samples.to_dataframe().to_numpy(), samples.points)
        assert samples.to_numpy().dtype == (np.float64 if real else np.complex128)


def test_components_solutions_and_circuits_alone_are_arrays_frames_and_values() -> None:
    for equations, columns in (("x^2 + y^2 = 1", ["x", "y"]), ("x^2 + 2*y^2 = i", ["x", "y"])):
        unit = "i" if equations.endswith("i") else None
        component = nag.decompose(equations, imaginary=unit)[0]
        assert list(component.to_dataframe().columns) == [*columns, "error"]
        array = component.to_numpy()
        assert array.shape == (2, 2) and array.flags.writeable
        assert np.array_equal(component.to_dataframe()[columns].to_numpy(), array)
        assert [[complex(v) for v in p.values()] for p in component.to_sympy()] == array.tolist()
        solved = nag.solve([equations, "x - y"], imaginary=unit)
        for names in ("x, y", solved.system.own_variables):
            assert solved[0].to_sympy(names) == solved.to_sympy()[0]
    with pytest.raises(nag.NagError, match="variables: 1 is given for 2 coordinates"):
        solved[0].to_sympy(["x"])
    moves = nag.motion(CASES / "planar" / "four-bar.toml", samples=12)
    frame = moves[0].to_dataframe()
    assert len(frame) == len(moves[0])
    whole = moves.to_dataframe()
    assert whole[whole["circuit"] == 1][list(frame.columns)].equals(frame)


def test_families_are_solved_of_whatever_describes_one(tmp_path: Path) -> None:
    values = [[2.0, 1.0], [8.0, -1.0]]
    equations = ["x^2 + y^2 = r", "x = a*y"]
    expected = nag.solve_family(equations, ["r", "a"], values)
    columns = {"a": [1.0, -1.0], "r": [2.0, 8.0]}
    (tmp_path / "values.csv").write_text("a,r\n1,2\n-1,8\n")
    np.save(tmp_path / "values.npy", values)
    case = tmp_path / "case.toml"
    case.write_text(
        'title = "Circles"\nkind = "system"\nvariables = ["x", "y"]\n'
        'equations = ["x^2 + y^2 = r", "x = a*y"]\nparameters = { r = 1, a = 1 }\n'
    )
    for given in (equations, nag.system(equations), case, str(case), nag.read(case)):
        for asked in (
            nag.solve_family(given, "r a", values),
            nag.solve_family(given, ["r", "a"], tmp_path / "values.npy"),
            nag.solve_family(given, values=columns),
            nag.solve_family(given, values=tmp_path / "values.csv"),
        ):
            assert asked.complete.all() and asked.counts.tolist() == [2, 2]
            for one, other in zip(asked, expected, strict=True):
                assert np.allclose(sorted(one[:, 0].real), sorted(other[:, 0].real))
    four_bar = nag.model(CASES / "planar" / "four-bar.toml")
    angle = four_bar.system.variables[0]
    assert len(nag.solve_family(four_bar, [angle], [[0.5], [0.25]])) == 2
    for given, message in (
        (CASES / "bennett.toml", "parameters: 'a' does not occur; the names are x_J1, x_J2"),
        (CASES / "rhombus.toml", "5 equations for 6 unknowns"),
    ):
        with pytest.raises(nag.NagError, match=message):
            nag.solve_family(given, ["a"], [[1]])


def test_that_nothing_is_missing_is_said_apart_from_what_is_proved_of_points() -> None:
    linkage = ["c1 + c2 = 1", "s1 + s2 = 1/2", "c1^2 + s1^2 = 1", "c2^2 + s2^2 = 1"]
    for given, complete in (
        (nag.solve(["x^2 + y^2 - 1", "x - y"]), "proved"),
        (nag.solve(linkage), "on evidence"),
        (nag.decompose(CASES / "rhombus.toml"), "not proved"),
    ):
        proved = nag.certify(given)
        assert repr(proved) == f"<Certified: all points proved; complete: {complete}>"
        assert proved.all_proved and bool(proved) and proved.document()["all_proved"]
        assert proved.complete is proved.document()["complete"] is (complete == "proved")
        (said,) = (value for label, value in proved.rows if label == "complete")
        assert said.startswith("proved: ") == proved.complete
        assert ("on evidence these are all" in said) == (complete == "on evidence")
    refuted = nag.certify(replace(given, components=(*given.components, given.components[0])))
    assert not refuted and not refuted.all_proved and not refuted.document()["all_proved"]
    assert repr(refuted).startswith("<Certified: NOT all proved; ")


def test_the_document_of_a_certificate_says_of_paths_what_the_certificate_says(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def refuse(found: nag.SolveResult) -> None:
        raise PathsError("they are too long")

    monkeypatch.setattr("nag.solving.certified_paths.prove_paths", refuse)
    proved = nag.certify(nag.solve(["x^2 + y^2 - 1", "x - y"]), paths=True)
    assert not proved and proved.document()["all_proved"] is False
    assert proved.complete and repr(proved) == "<Certified: NOT all proved; complete: proved>"


def test_points_without_their_system_are_refused_by_who_certifies() -> None:
    found = nag.solve("x^2 - 2")
    for given, kind in ((found[0], "Solution"), (found[:1], "Solutions"), ([*found], "Solution")):
        with pytest.raises(nag.NagError) as error:
            nag.certify(given)
        text = "points are proved together with their system: give all that nag.solve returned"
        assert str(error.value) == f"given: {kind} is given; {text}"
    with pytest.raises(nag.NagError, match="members are proved one by one: give what"):
        nag.certify(nag.solve_family("x^2 - a", ["a"], [[1]]))


def test_what_is_not_solved_yet_is_solved_or_decomposed_to_be_certified() -> None:
    roots, curve = nag.certify(["x^2 - 2", "x*y - 1"]), nag.certify(CIRCLE_AND_LINE)
    assert roots and len(roots.found) == 2 and isinstance(roots.found, nag.SolveResult)
    assert curve and len(curve.found) == 2 and isinstance(curve.found, nag.Decomposition)
    bennett = CASES / "bennett.toml"
    for given in (bennett, nag.read(bennett).mechanism, nag.decompose(bennett)[0]):
        assert nag.certify(given).found.dimension == 1
    assert nag.certify(nag.solve("x^2 - 2")) == nag.certify("x^2 - 2")


def test_components_come_by_other_methods_and_in_other_coordinates() -> None:
    bennett = CASES / "bennett.toml"
    some = nag.decompose(CIRCLE_AND_LINE, method="sampling", starts=20)
    assert {c.degree for c in some} <= {1, 2} and not some.complete
    joint, euler = (nag.decompose(bennett, coordinates=which) for which in ("joint", "euler"))
    assert joint == nag.decompose(bennett, formulation="H")
    names = nag.problem(bennett, formulation="E").system.variables
    assert euler.system.variables == names and {c.dimension for c in euler} == {1}
    circles = "(x^2 + y^2 - 1)*(x - y)*(x + y)"
    by_orbit = nag.decompose(circles, symmetries=[{"x": "-x"}])
    assert len(by_orbit.components) == 2 and len(by_orbit) == 3
    assert len(nag.decompose(circles, expand=True).components) == 3
    assert len(nag.decompose(circles, symmetries=[{"x": "-x"}], expand=True)) == 3


def test_a_component_is_named_by_a_point_of_it() -> None:
    through = nag.eliminate(CIRCLE_AND_LINE, "x,y", point=("3/5", "4/5"))
    assert through.equations == ("x^2 + y^2 - 1",)


def test_how_a_file_is_read_is_said_in_every_question(tmp_path: Path) -> None:
    rhombus = CASES / "rhombus.toml"
    kite = nag.read(rhombus, set={"b": 2})
    assert nag.decompose(rhombus, set={"b": 2}) == nag.decompose(kite)
    assert nag.problem(rhombus, set={"b": "2"}).system == kite.system
    assert nag.local(rhombus, "stretched", set={"b": 1}) == nag.local(rhombus, "stretched")
    (tmp_path / "line").write_text("2\n x - y;\n x + y;\n")
    assert len(nag.solve(tmp_path / "line", format="phc")) == 1
    assert nag.solve(system=["x^2 - 1"]) == nag.solve(["x^2 - 1"])
    with pytest.raises(nag.NagError, match="hold: is for robots"):
        nag.mobility(CASES / "bennett.toml", hold="B0")
    with pytest.raises(nag.NagError, match="set: says how a file is read; a Case is given; give"):
        nag.decompose(kite, set={"b": 2})


def test_polynomials_are_sympys_and_back() -> None:
    sympy = pytest.importorskip("sympy")
    system = nag.system(["x^2 - sqrt(2)*y + 1/3", "y^3 - (1 + sqrt(3)/2)*x"])
    again = nag.system(system.to_sympy(), system.variables)
    assert again == system
    (first, _) = nag.solve(["x^2 - 2", "y - x"]).to_sympy()
    assert abs(first[sympy.Symbol("x")] ** 2 - 2) < 1e-12


def test_names_that_types_are_checked_by_are_those_that_are_there() -> None:
    tree = ast.parse((NAG / "__init__.pyi").read_text("utf-8"))
    classes = {
        alias.name: statement.module
        for statement in tree.body
        if isinstance(statement, ast.ImportFrom)
        for alias in statement.names
        if alias.asname is not None
    }
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    assert classes.keys() | functions.keys() == nag._HOME.keys()
    assert classes.items() <= nag._HOME.items()
    for name, node in functions.items():
        assert _written(node) == _taken(getattr(nag, name)), name


def _written(node: ast.FunctionDef) -> list[tuple[str, object]]:
    """The arguments of a function that is written for checkers of types, with their defaults."""
    given = [*node.args.args, *node.args.kwonlyargs]
    defaults: list[object] = [
        *[inspect.Parameter.empty] * (len(node.args.args) - len(node.args.defaults)),
        *map(ast.literal_eval, node.args.defaults),
        *map(ast.literal_eval, node.args.kw_defaults),
    ]
    found = [(arg.arg, default) for arg, default in zip(given, defaults, strict=True)]
    options = "" if node.args.kwarg is None else ast.unparse(node.args.kwarg.annotation)  # type: ignore[arg-type]
    files, run = [*FILE_OPTIONS.items()], [("run", nag.Run())]
    equations = [(name, None) for name in EQUATION_OPTIONS]
    unpacked = {"FileOptions": files, "RunOptions": run, "Options": [*files, *run], "": []}
    unpacked["QuestionOptions"] = [*equations, *files, *run]
    return [*found, *unpacked[options.removeprefix("Unpack[").removesuffix("]")]]


def _taken(function: Any) -> list[tuple[str, object]]:
    """The arguments that a function takes; the run is the last."""
    taken = inspect.signature(function).parameters.values()
    return [(p.name, p.default) for p in sorted(taken, key=lambda p: p.name == "run")]


BARS = {"base": "AD2", "left": "AB1", "top": "BC2", "right": "CD1"}


def test_freedoms_are_counted_of_whatever_describes_a_mechanism() -> None:
    path = CASES / "bennett.toml"
    case = nag.read(path)
    every = (path, str(path), case, case.mechanism, nag.model(path), nag.problem(path))
    assert {nag.gruebler_kutzbach(given) for given in every} == {-2}
    linkage = nag.Linkage.of(BARS, "base")
    assert nag.gruebler_kutzbach(linkage) == nag.gruebler_kutzbach(nag.model(linkage)) == 1
    with pytest.raises(nag.MechanismError, match="equations are given, which have no bodies"):
        nag.gruebler_kutzbach("x^2 + y^2 = 1")


def test_the_model_of_equations_is_these(tmp_path: Path) -> None:
    system = nag.system("x^2 + y^2 = 1")
    file = tmp_path / "circle.m2"
    nag.write(system, file)
    for given in (system, "x^2 + y^2 = 1", file, nag.problem(system), nag.read(file)):
        assert nag.model(given).system == system
    with pytest.raises(nag.NagError, match=r"space: is for a nag\.Mechanism"):
        nag.model(system, space="spatial")


def test_equations_and_files_of_other_programs_are_written(tmp_path: Path) -> None:
    nag.write(["x^2 + y^2 - 1", "x - y"], tmp_path / "a.phc")
    nag.write(tmp_path / "a.phc", tmp_path / "a.m2")
    nag.write(tmp_path / "a.m2", tmp_path / "a.toml")
    system = nag.system(["x^2 + y^2 - 1", "x - y"])
    assert all(nag.read(tmp_path / f"a.{end}").system == system for end in ("phc", "m2", "toml"))


@pytest.mark.parametrize("ending", [".m2", ".toml", ".phc", ".txt", ".sing", ".bertini"])
def test_exports_are_not_written_to_what_is_called_otherwise(ending: str, tmp_path: Path) -> None:
    for found in (nag.decompose("x^2 - 1"), nag.solve("x^2 - 1")):
        with pytest.raises(nag.NagError, match=rf"ends in \{ending} holds no export"):
            nag.write(found, tmp_path / f"found{ending}")
        nag.write(found.system, tmp_path / f"found{ending}")
    assert nag.read(tmp_path / f"found{ending}").system == found.system
    with pytest.raises(nag.NagError, match=r"path: no case .* ends in \.json; name it \.toml"):
        nag.write(found.system, tmp_path / "found.json")


def test_real_points_are_asked_of_whatever_has_one_component(export: Path, tmp_path: Path) -> None:
    circle = nag.decompose("x^2 + y^2 = 1")
    nag.write(circle, tmp_path / "circle.json")
    for given in (circle[0], circle, tmp_path / "circle.json", "x^2 + y^2 = 1"):
        assert nag.find_real_curve(given) == nag.find_real_curve(circle[0])
        assert nag.find_real_points(given) == nag.find_real_points(circle[0])
    both = nag.decompose(CIRCLE_AND_LINE)
    for question in (nag.find_real_curve, nag.find_real_points):
        assert question(export, 2) == question(both[1])
        with pytest.raises(nag.NagError, match=r"component: which one. 1 and 2 .*give the number"):
            question(export)
        with pytest.raises(nag.NagError, match="component: 3: there are components 1 to 2"):
            question(both, 3)
    # Of components of several dimensions there is one curve.
    beside = nag.decompose(["(x^2 + y^2 - 1)*(x - 2)", "(x^2 + y^2 - 1)*(y - 3)"])
    assert len(beside) == 2 and nag.find_real_curve(beside).verdict is PictureVerdict.COMPLETE
    with pytest.raises(nag.NagError, match="component: it has dimension 2; a curve has 1"):
        nag.find_real_curve("x^2 + y^2 + z^2 = 1")


def test_parameters_of_mechanisms_make_no_family() -> None:
    with pytest.raises(nag.NagError, match="is a mechanism, and parameters are freed in polynom"):
        nag.solve_family(CASES / "bennett.toml", ["m0"], [[1], [2]])
    with pytest.raises(nag.NagError, match="parameters: 'm9' does not occur; the names are x_J1"):
        nag.solve_family(CASES / "bennett.toml", ["m9"], [[1], [2]])


def test_modes_of_parts_are_refused_in_words() -> None:
    with pytest.raises(nag.MechanismError, match=r"^mechanism: parts are given that may be assem"):
        nag.modes(nag.Linkage.of(BARS, "base"))


def texts_in(tree: ast.AST) -> list[str]:
    """Texts that a program may say, which its docstrings are not."""
    silent = set()
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        first = body[0] if isinstance(body, list) and body else None
        if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
            silent.add(first.value)
    constants = (n for n in ast.walk(tree) if isinstance(n, ast.Constant) and n not in silent)
    return [n.value for n in constants if isinstance(n.value, str)]


def test_options_are_named_by_commands_alone() -> None:
    """Who asks in Python reads what to do, and a command adds what its option is called."""
    # What reports print is read on the command line.
    commands = {"cli", "bench", "report"}
    files = [f for f in NAG.rglob("*.py") if f.relative_to(NAG).parts[0] not in commands]
    said = {
        f"{file.relative_to(NAG)}: {text}"
        for file in files
        for text in texts_in(ast.parse(file.read_text("utf-8")))
        if re.search(r"--[a-z]", text)
    }
    assert not said


def test_a_command_adds_the_option_that_mends_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    case = str(CASES / "planar" / "five-bar.toml")
    with pytest.raises(nag.NagError, match=r"drive joints to values$") as error:
        nag.motion(case)
    assert error.value.keyword == "drive" and pickle.loads(pickle.dumps(error.value)).keyword
    assert main(["motion", case, "--quiet"]) == 2
    assert capsys.readouterr().err.endswith("drive joints to values (--drive)\n")


def test_what_is_listed_at_the_prompt_can_be_asked() -> None:
    assert not {"Any", "import_module"} & {*dir(nag)}


def test_variables_are_named_by_texts_and_symbols() -> None:
    x, y, z = sympy.symbols("x y z")
    found = nag.eliminate([y - x**2, z - x**3], "y, z")
    for onto in ("y z", "y,z", ["y", "z"], (y, z), [y, "z"]):
        assert nag.eliminate([y - x**2, z - x**3], onto) == found
    assert found.to_sympy() == [y**3 - z**2]
    for unit in (1, sympy.I):
        maps = nag.eliminate([y - unit * x**2, z - x**3], [y, z]).maps_to_sympy()
        assert sympy.simplify(maps[x].subs({y: unit * x**2, z: x**3})) == x
    for degree in (0, -3, True, 2.0):
        with pytest.raises(nag.NagError, match=r"degree: .* give a whole number from 1 up"):
            nag.eliminate("x - y", "x, y", degree=degree)
    with pytest.raises(nag.NagError, match="onto: no variable is given"):
        nag.eliminate("x - y", "")


@pytest.mark.parametrize("text", ["x^2 - 1, x - y", "x^2 - 1; x - y;", "x[1,2] - 1, x[1,2] - y"])
def test_several_equations_in_one_text_are_asked_for_in_a_list(text: str) -> None:
    with pytest.raises(nag.NagError, match=r"equations: several equations in one text; give a l"):
        nag.system(text)
    assert nag.system("x_{1,2}^2 - 1").variables == ("x_{1,2}",)


def test_a_solution_is_a_point_that_is_known_to_doubles() -> None:
    found, roots = nag.decompose(CIRCLE_AND_LINE), nag.solve(["x^2 + y^2 - 1", "x - y"])
    for root in roots:
        assert len(nag.member(found, root).on) == 2 and found[0].contains(root)
        assert nag.local(CIRCLE_AND_LINE, root).dimension == 1
    assert (
        nag.local(
            nag.system("x^2 - 2*I*y", imaginary="I"),
            nag.solve(["x^2 - 2*I*y", "y - 1"], imaginary="I")[0],
        ).dimension
        == 1
    )


def test_a_component_meets_equations_however_they_are_given() -> None:
    x = sympy.Symbol("x")
    circle = nag.decompose(CIRCLE_AND_LINE)[1]
    met = circle.intersect(nag.system("x", "x y"))
    assert met == circle.intersect("x = 0") == circle.intersect([x]) and len(met) == 2
    with pytest.raises(nag.NagError, match=r"equations.*'z'"):
        circle.intersect("z")


def test_equations_of_an_image_are_in_the_names_of_its_variables() -> None:
    found = nag.eliminate(["y - x^2", "z - x^3"], "y, z")
    assert found[0] == "y^3 - z^2"
    assert list(found) == list(found.equations)
    assert len(found.generators) == len(found)


def test_the_imaginary_unit_is_no_coordinate_of_a_point_that_is_shown() -> None:
    asked = nag.problem("x^2 + I*y - 1", imaginary="I")
    assert "at (1, 0)\n" in str(nag.local(asked, (1, 0)))
    assert "2 points in 2 coordinates" in str(nag.sample(asked, count=2))


def test_what_an_option_of_decompose_asks_has_a_function(tmp_path) -> None:
    swept = nag.sweep_parameter("cases/rhombus.toml", "b", ["1/2", 1])
    assert [len(each.decomposition.components) for each in swept] == [2, 3]
    assert swept.complete and swept.followed_count == 2
    assert list(swept.to_dataframe()["b"]) == [0.5, 0.5, 1.0, 1.0, 1.0]
    alone = nag.decompose("cases/rhombus.toml", set={"b": "1/2"})
    kinds = sorted((c.dimension, c.degree) for c in alone.components)
    assert sorted((c.dimension, c.degree) for c in swept[0].decomposition.components) == kinds
    with pytest.raises(nag.NagError, match="q: is no parameter"):
        nag.sweep_parameter("cases/rhombus.toml", "q", [1, 2])
    with pytest.raises(nag.NagError, match="values: give two or more"):
        nag.sweep_parameter("cases/rhombus.toml", "b", [1])
    with pytest.raises(nag.NagError, match="a case with parameters"):
        nag.sweep_parameter("x^2 - b", "b", [1, 2])
    twice = nag.sweep_parameter("cases/rhombus.toml", "b", [1, "1/2", 1])
    assert [each.value for each in twice] == [1, Fraction(1, 2), 1]
    assert twice[0] == twice[2] and twice[1] == swept[0] and twice.followed_count == 3
    same = nag.sweep_parameter("cases/rhombus.toml", "b", [1, 1])
    assert same[0] == same[1] and not same[0].followed and same.complete
    assert [(c.dimension, c.degree) for c in same[0].decomposition] == [(1, 2)] * 3
    modes = nag.decompose_modes("cases/bennett.toml")
    assert [len(each.modes.members) for each in modes] == [8, 8]
    assert nag.decompose_modes(nag.read("cases/bennett.toml").mechanism) == modes


def test_pages_are_written_as_the_commands_write_them(tmp_path) -> None:
    case = nag.read("cases/bennett.toml")
    one, other = tmp_path / "one.html", tmp_path / "other.html"
    assert main(["report", "cases/bennett.toml", "--html", str(one)]) == 0
    report = nag.write_report("cases/bennett.toml", other)
    assert one.read_bytes() == other.read_bytes()
    assert report.complete and report.decomposition == nag.decompose("cases/bennett.toml")
    assert nag.write_report(case.mechanism, other).complete
    with pytest.raises(nag.NagError, match="reports are of mechanisms"):
        nag.write_report("x^2 - 1", other)
    (tmp_path / "folder").mkdir()
    same = tmp_path / "folder" / "bennett.toml"
    assert main(["motion", "cases/bennett.toml", "--html", str(one)]) == 0
    nag.write(nag.motion("cases/bennett.toml"), same.with_suffix(".html"), title=case.title)
    assert same.with_suffix(".html").read_bytes() == one.read_bytes()
    bars = {"base": "AE3", "crank": "AB2", "left": "BC2", "right": "CD3", "rocker": "DE2"}
    five_bar = nag.Linkage.of(bars, "base")
    nag.write(nag.driven_motion(five_bar, "A", [0.0, 0.5], samples=24), other)
    assert other.read_text().startswith("<!")
    with pytest.raises(nag.NagError, match=r"name it \.json, or \.html"):
        nag.write(nag.motion("cases/bennett.toml"), tmp_path / "motion.txt")


def test_statements_of_the_papers_are_checked_as_by_the_command(tmp_path) -> None:
    file = tmp_path / "statements.json"
    assert main(["check", "cases/slider-crank.toml", "--json", str(file)]) == 0
    found = nag.check_statements("cases/slider-crank.toml")
    assert json.loads(file.read_text())["sections"] == found.document()["sections"]
    assert found.complete and len(found) == 10
    with pytest.raises(nag.NagError, match="the papers give no components of it"):
        nag.check_statements("x^2 - 1")


def test_answers_have_the_documents_that_commands_write(tmp_path: Path) -> None:
    def written(*words: str) -> dict[str, object]:
        file = tmp_path / "answer.json"
        assert main([*words, "--json", str(file), "--quiet"]) == 0
        return json.loads(file.read_text("utf-8"))

    system, values = tmp_path / "system.txt", tmp_path / "values.csv"
    system.write_text("x^2 = a\n")
    values.write_text("a\n1\n-2\n")
    rhombus, bennett = str(CASES / "rhombus.toml"), str(CASES / "bennett.toml")
    for answer, document in (
        (
            nag.solve_family(system, "a", values),
            written("family", str(system), "--values", str(values)),
        ),
        (
            nag.sweep_parameter(rhombus, "b", [1, 2]),
            written("decompose", rhombus, "--sweep", "b=1:2:2"),
        ),
        (nag.mobility(bennett), written("mobility", bennett)),
    ):
        assert answer.document().items() <= document.items()


@pytest.mark.parametrize("text", ["data/system", "nofile.xyz"])
def test_a_text_that_looks_like_a_path_is_said_to_be_no_file(text: str) -> None:
    hint = r" \(no file of this name; read as an equation\)$"
    with pytest.raises(nag.EquationError, match=hint):
        nag.solve(text)
    with pytest.raises(nag.EquationError, match=r"divisor contains a variable; [^()]*$"):
        nag.solve("1/x - 2")


@pytest.mark.parametrize("ask", [nag.solve, nag.decompose, nag.singular, nag.mobility, nag.model])
def test_a_word_is_the_name_of_a_file_and_no_equation(ask: Callable[[str], object]) -> None:
    with pytest.raises(nag.NagError, match="'system' is no file that is there"):
        ask("system")
    assert len(nag.solve(["system"])) == len(nag.solve("x")) == 1


def test_a_multiplicity_that_is_not_known_is_none_and_a_question_mark(tmp_path: Path) -> None:
    """Where two components meet as sets, how often a point counts is not asked."""
    met, file = nag.intersect("(x^2 + y^2 - 1)*(x - 1)", 1, 2), tmp_path / "met.json"
    nag.write(met, file)
    for found in (met, nag.read(file)):
        assert [c.multiplicity for c in found] == [None] and not found[0].is_multiple
        assert found.to_dataframe()["multiplicity"].isna().all()
        assert found.rows()[1][3] == "?" and "multiplicity not known" in str(found)
    assert nag.read(file) == met
    # Files say 0, as they always did.
    assert json.loads(file.read_text())["components"][0]["multiplicity"] == 0
    assert nag.certify(met).found == met
    assert nag.member(met, (1, 0)).rows()[1][3] == "?"
    assert not nag.singular(met, 1).complete and len(nag.sample(met, count=1)) == 1
    nag.plot(met, tmp_path / "tree.svg", tree=True)
    assert nag.local("x^2 - y^3", (0, 0)).multiplicity is None
    assert nag.local(["x^2", "y"], (0, 0)).multiplicity == 2
    assert nag.mobility("cases/bennett.toml").multiplicity is None


def test_points_are_told_by_the_names_that_they_have() -> None:
    """A row of a table and a solution have their variables in an order of their own."""
    line = nag.decompose("x + 2*y - 1", "x y")
    found = nag.solve(["x + 2*y = 1", "x = 3"], "y x")[0]
    assert found.variables == ("y", "x")
    given = [
        pandas.Series({"y": 0.0, "x": 1.0}),
        pandas.Series([1.0, 0.0]),
        found,
        found.to_sympy(),
    ]
    for point in given:
        assert nag.member(line, point) and line[0].contains(point)
        assert nag.local("x + 2*y - 1", point).dimension == 1
    with pytest.raises(nag.NagError, match="point: a table is given; give one point"):
        nag.member(line, pandas.DataFrame({"x": [1.0], "y": [0.0]}))


def test_equations_are_a_column_of_a_table_and_no_table() -> None:
    table = pandas.DataFrame({"e": ["x^2 - 1", "x - y"]})
    assert nag.solve(table["e"]) == nag.solve(["x^2 - 1", "x - y"])
    with pytest.raises(nag.NagError, match="something of type DataFrame is given; give texts"):
        nag.solve(table)


def test_a_variable_that_is_called_like_a_column_has_its_own() -> None:
    roots = nag.solve(["real^2 - 1", "error - real"]).to_dataframe()
    assert roots["real"].tolist() == [1, -1] and roots["real_"].tolist() == [True, True]
    component = nag.decompose("error - x")[0].to_dataframe()
    assert component["error"].tolist() == component["x"].tolist() and "error_" in component
    family = nag.solve_family("member^2 - real", "real", [4.0]).to_dataframe()
    assert family["real"].tolist() == [4, 4] and family["member"].abs().tolist() == [2, 2]
    facts = ["real_", "error", "positive_dimensional"]
    assert [*family.columns] == ["member_", "real", "member", *facts]
    assert [*nag.find_real_curve("edge^2 + x^2 - 1").to_dataframe()] == ["edge_", "edge", "x"]


def test_solutions_are_chosen_by_arrays_as_well() -> None:
    roots = nag.solve(["x^3 - x", "y - x"])
    assert roots[[0, 2]] == roots[np.array([True, False, True])] == [roots[0], roots[2]]
    assert len(roots[[]]) == 0 and roots[np.int64(1)] == roots[1]
    with pytest.raises(IndexError, match="index 3 of 3, counted from 0"):
        roots[3]
    with pytest.raises(TypeError, match="'x' is no index; give a whole number"):
        roots["x"]


def test_whatever_holds_several_is_chosen_from_in_the_same_ways() -> None:
    frame = (roots := nag.solve(["x^3 - x", "y - x"])).to_dataframe()
    assert roots[frame.real] == roots[:] and roots[frame.x.map(abs) < 0.5] == [roots[0]]
    lines, points = nag.decompose("x*y"), nag.sample("x^2 + y^2 - 1", count=3)
    assert lines[[True, False]] == lines[[0]] == lines[:1]
    assert (points[np.array([2, -3])] == points.points[[2, 0]]).all()
    for several in (roots, lines, points):
        for wrong in (frame, "x", None, (0, 1), 0.5, [0.5], ["x"], np.ones((2, 2), bool)):
            with pytest.raises(TypeError, match="is no index; give a whole number") as refused:
                several[wrong]
            assert "\n" not in str(refused.value)
        for index in (9, [9], np.array([0, -9])):
            with pytest.raises(IndexError, match=r"index -?9 of [23], counted from 0"):
                several[index]
        with pytest.raises(IndexError, match=r"1 truth values for [23]; give one for each"):
            several[[True]]


def test_entries_are_found_and_counted_whole() -> None:
    answers = (nag.solve("x^3 - x"), nag.decompose("x*y"), nag.sample("x^2 + y^2 - 1", count=3))
    for several in answers:
        assert several.index(several[1]) == 1 and several.count(several[1]) == 1
        assert several.index(several[-1], 1) == len(several) - 1 and several.count(3) == 0
        with pytest.raises(ValueError, match=r"3 is none of the [23]"):
            several.index(3)


def test_a_component_says_of_itself_what_its_decomposition_says() -> None:
    found = nag.decompose("x^2 + y^2 = i", imaginary="i")
    own = found[0].document()
    assert own.items() <= found.document()["components"][0].items()


def test_what_is_found_knows_its_variables() -> None:
    circle = nag.decompose("x^2 + y^2 = i", imaginary="i")
    answers = (circle, circle[0], nag.solve(["x^2 = i", "y = x"], imaginary="i"))
    answers += (
        nag.sample(circle),
        nag.singular("x*y"),
        nag.solve_family("x*y = a", "a, y", [[1, 2]]),
    )
    assert [each.variables for each in answers] == [("x", "y")] * 5 + [("x",)]
