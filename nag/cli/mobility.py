"""The command ``nag mobility``: how a mechanism moves at a configuration."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    UsageError,
    add_case,
    add_running,
    read_case_file,
    read_problem,
)
from nag.cli.running import CommandAnswer, answer_of, chosen_run, name_case
from nag.cli.witness_input import point_at

if TYPE_CHECKING:
    from nag.algebra.number import Number
    from nag.files.cases import Case
    from nag.mechanism.mobility_report import Alike, MobilityReport
    from nag.mechanism.other_equations import OtherEquations
    from nag.mechanism.problem import Problem

FORMAT = "nag-mobility"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag mobility`` has besides those of every command that runs a case."""
    add_case(parser)
    add_running(parser)
    parser.add_argument(
        "--at",
        metavar="VALUES",
        help="a configuration in the variables of `nag model`: 'c1 = 3/5, s1 = 4/5', all of them, "
        "where a rounded one stands for the configuration next to it "
        "(default: the reference configuration; of parts that are not assembled a general one); of "
        "a framework in the plane the points' x_P and y_P, the first bar from (0, 0) to (1, 0)",
    )
    parser.add_argument(
        "--local",
        action="store_true",
        help="do not decompose: counting, tangent and local dimension only",
    )
    parser.add_argument(
        "--curves",
        action="store_true",
        help="the genus of each curve through the configuration (0 is a rational motion), and in "
        "a loop of revolute joints its bonds",
    )
    parser.add_argument(
        "--check",
        action="store_true",
        help="do it all again in another formulation of the mechanism, and compare",
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """How a mechanism moves at a configuration."""
    case, problem = _read_moving(options)
    at = None if options.at is None else point_at(options.at, problem.system.variables)
    other, comparable = None, problem is not None
    if options.check and problem is not None:
        from nag.mechanism.other_equations import other_equations

        other = next(other_equations(problem, at), None)
        comparable = other is not None or (problem.mechanism is not None and at is None)
    if options.check and not comparable:
        raise UsageError(
            "--check: there is no second formulation: that is for mechanisms with loops at their "
            "reference configuration, for tables in half-angles, linkages and frameworks; one in "
            "space needs other bars to pin, and no --at"
        )
    from nag.algebra.number import number_text
    from nag.mechanism.mobility_report import MobilityStatus

    report = _report(options, problem or case, at)
    rows = report.rows()
    complete = report.status is not MobilityStatus.UNDECIDED and not report.open
    complete &= not any(curve.note for curve in report.curves)
    compared: dict[str, Any] | None = None
    if options.check:
        text, agree, compared = _compare(options, report, other)
        rows.append(("check", text))
        complete &= agree
    here = at or (None if problem is None else problem.reference)
    fields = {
        "format": FORMAT,
        "configuration": [number_text(x) for x in here or ()],
        **report.document(),
        "check": compared,
    }
    return answer_of(options, name_case(case), (), rows, fields, complete)


def _read_moving(options: argparse.Namespace) -> tuple[Case, Problem | None]:
    """The case, and its problem; None if it is a mechanism without loops.

    Raises:
        UsageError: if nothing moves in it, or no configuration of it is known or given.
    """
    from nag.mechanism.mobility_at import tree_of
    from nag.mechanism.problem import in_real_coordinates

    case = read_case_file(options.case, options.set)
    if tree_of(case) is not None:
        if options.at is not None:
            raise UsageError(f"--at: {options.case} has no loop, so that it has no equations")
        return case, None
    case, problem = read_problem(options)
    if problem.model is None:
        raise UsageError(f"{options.case}: is a polynomial system; `nag local` is for those")
    if options.at is not None:
        return case, in_real_coordinates(problem)
    if problem.reference is None:
        from nag.mechanism.real_assemblies import obstacle

        reason = obstacle(problem.parts)
        if reason:
            raise UsageError(f"{options.case}: its parts have no real assembly: {reason}")
        if options.local:
            raise UsageError(
                f"{options.case}: its parts are not assembled: give --at, or leave out --local"
            )
    return case, problem


def _report(
    options: argparse.Namespace, given: Case | Problem, at: tuple[Number, ...] | None
) -> MobilityReport:
    from nag.mechanism.mobility_at import NoAssembly, mobility
    from nag.numerics.local_dimension import NoSolution

    detail = "curves" if options.curves else "local" if options.local else "components"
    try:
        return mobility(given, at, detail=detail, run=chosen_run(options))
    except NoAssembly as reason:
        raise UsageError(f"{options.case}: {reason}") from None
    except NoSolution as reason:
        raise UsageError(f"--at: {reason}; it is no configuration of the mechanism") from None


def _compare(
    options: argparse.Namespace, report: MobilityReport, equations: OtherEquations | None
) -> tuple[str, bool, dict[str, Any] | None]:
    """What other equations say, whether it agrees, and that as a JSON object."""
    if equations is None:
        return "no other formulation covers this mechanism", True, None
    other = _report(options, equations.problem, equations.at)
    agree = other.same_motion(report, equations.alike)
    text = (
        f"{equations.name}, {other.equations} equations in {other.variables} "
        f"unknowns, {'agrees' if agree else 'DISAGREES'}: local dimension "
        f"{other.local_dimension}, tangent dimension {other.tangent_dimension}"
        f"{_alike_text(other, equations.alike)}"
    )
    if other.open:
        text += f"; its components are not known: {other.open}"
    found = {
        "formulation": equations.name.removeprefix("formulation "),
        "tangent_dimension": other.tangent_dimension,
        "local_dimension": other.local_dimension,
        "agrees": agree,
    }
    return text, agree and not other.open, found


def _alike_text(other: MobilityReport, alike: Alike) -> str:
    """What was compared of the components."""
    if other.components is None or alike == "dimensions":
        return ""
    what = {"counts": "dimension", "degrees": "dimension and degree"}[alike]
    return f"; components of each {what} were counted"
