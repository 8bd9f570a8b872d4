"""The command ``nag local``: the local dimension of the solution set at a point."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import UsageError, add_case, add_running, read_problem
from nag.cli.running import CommandAnswer, answer_of, chosen_run, name_case
from nag.cli.witness_input import POINT_AT, Points, add_point, chosen_point

if TYPE_CHECKING:
    from nag.algebra.number import Number
    from nag.algebra.system import PolynomialSystem
    from nag.mechanism.problem import Problem
    from nag.numerics.local_dimension import LocalDimension

FORMAT = "nag-local-dimension"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag local`` has besides those of every command that runs a case."""
    add_case(parser, POINT_AT, exports=True)
    add_running(parser)
    add_point(parser, " (default: all points)")
    parser.add_argument(
        "--check",
        action="store_true",
        help="decompose the case as well, and compare with the components through the point",
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """The local dimension at points."""
    case, problem = read_problem(options)
    from nag.algebra.number import number_text
    from nag.decomposition.through import zero_at

    system = problem.system
    chosen = chosen_points(options, problem)
    found = {name: local_dimension_at(system, at, options) for name, at in chosen.items()}
    zeros = {name: zero_at(system, chosen[name], one) for name, one in found.items()}
    through = _through(problem, zeros, options) if options.check else {}
    complete = all(one.decided for one in found.values())
    blocks = []
    for name, one in found.items():
        rows = [("point", _point_text(name, chosen[name], system)), *one.rows()]
        if name in through:
            text, agrees = through[name](one)
            rows.append(("components", text))
            complete &= agrees
        blocks.append(rows)
    fields = {
        "format": FORMAT,
        "variables": list(system.variables),
        "points": [
            {"name": name, "at": [number_text(x) for x in chosen[name]], **one.document()}
            for name, one in found.items()
        ],
    }
    return answer_of(
        options, name_case(case), blocks, (), fields, complete, rests_on=["seed"], width=10
    )


def chosen_points(
    options: argparse.Namespace, problem: Problem
) -> Mapping[str, tuple[Number | complex, ...]]:
    """The points that the command line asks for, by name; all named ones if it names none.

    Raises:
        UsageError: if there are none, or the asked one does not exist.
    """
    points: Points = {point.name: point.at for point in problem.points}
    if options.at is None and options.point is None and points:
        return points
    return {options.point or "": chosen_point(options, problem.system, points)}


def local_dimension_at(
    system: PolynomialSystem, at: tuple[Number | complex, ...], options: argparse.Namespace
) -> LocalDimension:
    """The local dimension at a point, which may be a rounded one.

    Raises:
        UsageError: if it is not near a solution.
    """
    from nag.numerics.local_dimension import NoSolution, local_dimension_near

    try:
        return local_dimension_near(system, at, seed=options.seed)
    except NoSolution as reason:
        text = f"{options.case}: {reason}, give a solution of the equations"
        raise UsageError(text) from None


def _point_text(name: str, at: tuple[Number | complex, ...], system: PolynomialSystem) -> str:
    from nag.algebra.system import values_text

    own = system.own_variables
    values = values_text(own, at[: len(own)])
    return f"{name}: {values}" if name else values


def _through(
    problem: Problem,
    chosen: Mapping[str, tuple[Number | complex, ...]],
    options: argparse.Namespace,
) -> dict[str, Any]:
    """For each point what the components through it say, beside a local dimension."""
    from nag.decomposition.through import through_points
    from nag.witness.frame import expand_orbits

    decomposition = problem.decompose(run=chosen_run(options))
    components = expand_orbits(decomposition).components
    known = through_points(decomposition, list(chosen.items()), options.threads)

    def compare(name: str) -> Any:
        through = next(one for one in known if one.name == name)

        def text(found: LocalDimension) -> tuple[str, bool]:
            if not through.solution or through.doubt:
                return f"not known: {through.doubt or 'the point is a rounded one'}", False
            largest = max(components[i].dimension for i in through.components)
            agrees = found.lower <= largest <= found.upper
            count = len(through.components)
            said = f"{count} through the point, the largest of dimension {largest}: "
            return said + ("agrees" if agrees else "DISAGREES"), agrees

        return text

    return {name: compare(name) for name in chosen}
