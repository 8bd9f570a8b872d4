"""One problem, whatever it is given as."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

import nag
from nag.mechanism.coordinates import carry_to_euler
from nag.mechanism.linkage import pin_model
from nag.mechanism.parts import FormulationError
from nag.mechanism.problem import Problem, problem_of

CASES = Path(__file__).parent.parent / "cases"


def case(name: str) -> nag.Case:
    return nag.read_case(CASES / f"{name}.toml")


# Each the same mechanism, parts or equations, given in every way there is.
GIVEN: dict[str, Callable[[], list[Any]]] = {
    "mechanism": lambda: [
        case("bennett"),
        case("bennett").mechanism,
        nag.model(case("bennett").mechanism),
    ],
    "table": lambda: [case("spatial/bennett"), case("spatial/bennett").assembly],
    "linkage": lambda: [case("planar/four-bar"), case("planar/four-bar").assembly],
    "framework": lambda: [case("planar/braced-square"), case("planar/braced-square").assembly],
    "equations": lambda: [case("triangle"), case("triangle").system],
}


@pytest.mark.parametrize("name", GIVEN)
def test_a_problem_is_the_same_whatever_it_is_given_as(name: str) -> None:
    problems = [problem_of(given) for given in GIVEN[name]()]
    problems.append(problem_of(problems[0]))
    for problem in problems:
        assert problem.system == problems[0].system
        assert problem.reference == problems[0].reference
        assert problem.formulation == problems[0].formulation
        assert problem.freedoms_left_out == problems[0].freedoms_left_out
        assert problem.model.__class__ is problems[0].model.__class__


def test_parts_are_decomposed_and_solved_as_their_case_is() -> None:
    given = case("planar/braced-square")
    kinds = [
        [(c.dimension, c.degree, c.orbit) for c in nag.decompose(one).components]
        for one in (given, given.assembly, problem_of(given))
    ]
    assert kinds[0] == kinds[1] == kinds[2] != []
    solved = [nag.solve(one).points for one in (given, given.assembly)]
    assert len(solved[0]) > 0 and (solved[0] == solved[1]).all()


@pytest.mark.parametrize("name", ["bennett", "spatial/bennett", "planar/four-bar"])
def test_a_case_moves_as_what_it_describes(name: str) -> None:
    given = case(name)
    reports = [nag.mobility(one) for one in (given, given.mechanism or given.assembly)]
    assert str(reports[0]) == str(reports[1])


def test_pins_have_the_freedoms_of_the_linkage_that_they_are_of() -> None:
    parts = case("planar/four-bar").assembly
    turns, pins = problem_of(parts), problem_of(pin_model(parts))
    assert turns.model.gruebler_kutzbach == pins.model.gruebler_kutzbach == 1
    assert turns.space == pins.space == "planar"


def test_a_formulation_is_for_what_has_one() -> None:
    for given in (case("planar/four-bar"), case("triangle"), ["x^2 - 1"]):
        with pytest.raises(FormulationError, match="formulation E: is for mechanisms and tables"):
            problem_of(given, formulation="E")
    assert problem_of(case("spatial/bennett"), formulation="E").formulation == "E"
    assert problem_of(case("bennett"), formulation="E").formulation == "E"


@pytest.mark.parametrize("name", ["bennett", "spatial/bennett"])
def test_mechanisms_and_tables_are_carried_to_euler_parameters_by_one_function(name: str) -> None:
    problem = problem_of(case(name))
    other, answer = carry_to_euler(problem, problem.decompose())
    assert other.formulation == "E" and answer.system == other.system
    assert answer.complete and {c.dimension for c in answer.components} == {1}
    assert carry_to_euler(other, answer) == (other, answer)


def test_a_problem_lifts_to_bodies_where_there_are_bodies() -> None:
    problem = problem_of(case("bennett"))
    assert problem.lift(problem.reference).euler.keys() == set(problem.model.mechanism.body_names)
    with pytest.raises(nag.NagError, match="lift"):
        Problem(nag.system(["x"])).lift((Fraction(0),))
