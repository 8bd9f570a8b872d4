"""The command ``nag mobility``: how a mechanism moves at a configuration."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    UsageError,
    add_case,
    add_running,
    budget_seconds,
    error_in_file,
    problem_of_case,
    read_given_case,
)
from nag.cli.running import (
    CommandAnswer,
    answer_document,
    answer_of,
    chosen_run,
    name_case,
    say_first,
)
from nag.cli.witness_input import real_point_at
from nag.errors import NagError
from nag.mechanism import BUDGET

if TYPE_CHECKING:
    from nag.algebra.number import Number
    from nag.files.cases import Case
    from nag.mechanism.mobility_at import Detail
    from nag.mechanism.mobility_report import Alike, MobilityReport
    from nag.mechanism.other_equations import OtherEquations
    from nag.mechanism.problem import Problem
    from nag.tracking.run import Run

# Labels are as wide as the widest from the first line on.
WIDTH = len("components")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag mobility`` has besides those of every command that runs a case."""
    add_case(
        parser,
        "a configuration in the variables of `nag model`: 'c1 = 3/5, s1 = 4/5', all of them, "
        "where a rounded one stands for the configuration next to it "
        "(default: the reference configuration; of parts that are not assembled a general one); of "
        "a framework in the plane the points' x_P and y_P, the first bar from (0, 0) to (1, 0)",
    )
    add_running(parser)
    how_far = parser.add_mutually_exclusive_group()
    how_far.add_argument(
        "--local",
        action="store_true",
        help="counting, tangent and local dimension only, and no component",
    )
    how_far.add_argument(
        "--components",
        action="store_true",
        help="decompose all configurations, whatever passes through this one",
    )
    parser.add_argument(
        "--budget",
        type=budget_seconds,
        default=BUDGET,
        metavar="SECONDS",
        help="how much work the degree of the component through a smooth configuration is worth, "
        f"in seconds of a common processor (default: {BUDGET}); one that takes more is bounded "
        "from below; work is counted and not timed, so that the same seed gives the same answer on "
        "any machine",
    )
    parser.add_argument(
        "--of",
        metavar="BODY",
        help="say how this body moves against the ground: its freedoms, and what they are",
    )
    parser.add_argument(
        "--tolerance",
        type=_tolerance,
        metavar="T",
        help="of a mechanism that does not move as it is given, yet can be assembled: whether it "
        "nearly moves, its loops opening by no more than T radians, and T times its size",
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


def _tolerance(text: str) -> float:
    from nag.mechanism.nearly_mobile import check_tolerance

    try:
        return check_tolerance(float(text))
    except NagError as error:
        raise argparse.ArgumentTypeError(str(error).removeprefix("tolerance: ")) from None
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no number; write one like 1e-3") from None


def run(options: argparse.Namespace) -> CommandAnswer:
    """How a mechanism moves at a configuration."""
    case, problem = _read_moving(options)
    at = None if options.at is None else real_point_at(options.at, problem.system)
    others = iter(()) if problem is None or not options.check else _other_equations(problem, at)
    here = at or (None if problem is None else problem.reference)
    from nag.mechanism.mobility_report import is_so_far

    def document_of(early: MobilityReport) -> dict[str, Any]:
        return answer_document(options, name_case(case), _fields(options, early, here), False)

    said: list[tuple[str, str]] = []
    for report in _reports(options, problem or case, at, chosen_run(options, document_of)):
        # At once there is nothing to say before the answer.
        if not options.local and not is_so_far(said):
            said = report.early_rows()
            say_first(options, name_case(case), said, width=WIDTH)
    rows = report.rows()
    if is_so_far(said):
        rows = [*said, *(row for row in rows if row not in said)]
    rows += _unsaid_rows(options, report)
    known_of = report.body_text is not None or report.local_dimension == 0
    complete = options.of is None or known_of
    complete &= report.complete
    rows += case.note_rows
    rows += _elsewhere_rows(report, case, problem) if at is None else []
    known = _beside_known(report, case) if at is None else None
    beside: dict[str, Any] | None = None
    if known is not None:
        text, agree, beside = known
        rows.append(("known", text))
        complete &= agree
    compared: dict[str, Any] | None = None
    if options.check:
        text, agree, compared = _compare(options, report, next(others, None))
        rows.append(("check", text))
        complete &= agree
    fields = _fields(options, report, here) | {"known": beside, "check": compared}
    said = f"budget {options.budget:g} s" if _is_limited(options, report) else ""
    return answer_of(options, name_case(case), (), rows, fields, complete, said=said, width=WIDTH)


def _fields(
    options: argparse.Namespace, report: MobilityReport, at: Sequence[Number] | None
) -> dict[str, Any]:
    """What the document says, but for what the case knows and other equations say."""
    from nag.algebra.number import number_text
    from nag.files.answer_export import fields_of

    return {
        **fields_of(report),
        "budget": options.budget if _is_limited(options, report) else None,
        "configuration": [number_text(x) for x in at or ()],
    }


def _unsaid_rows(options: argparse.Namespace, report: MobilityReport) -> Iterator[tuple[str, str]]:
    """What was asked for and the report does not say, with the reason."""
    if options.of is not None and report.body_text is None:
        if report.local_dimension == 0:
            yield "of", f"{options.of}: no freedom, it stands still"
        else:
            yield "of", f"{options.of}: not known: {report.unclear}"
    if options.tolerance is not None and report.near is None:
        yield (
            "tolerance",
            "not looked at: that is for what does not move as it is given, but for parts that move "
            "by themselves, at its reference configuration, or at a real assembly of its parts",
        )


def _elsewhere_rows(
    report: MobilityReport, case: Case, problem: Problem | None
) -> list[tuple[str, str]]:
    """Where a mechanism is known to move with other numbers of freedoms than at its reference."""
    if problem is None or report.local is None or not report.local.smooth:
        return []
    known = {t.dimension for t in case.truth if t.formulation == problem.formulation} - {0}
    if len(known) < 2:
        return []
    freedoms = " and ".join(str(d + problem.free) for d in sorted(known))
    text = f"motions with {freedoms} freedoms are known of it: `nag singular` looks for where they "
    return [("elsewhere", f"{text}meet, and `nag mobility --at` takes such a configuration")]


def _beside_known(report: MobilityReport, case: Case) -> tuple[str, bool, dict[str, Any]] | None:
    """What the case knows of its reference configuration, whether it is so, and as JSON."""
    known = case.truth_at_reference
    if known is None:
        return None
    from nag.report.agreement import AgreementKind, compare_at_reference, reference_text

    verdict = compare_at_reference(report, known)
    found = {
        "tangent_dimension": known.tangent_dimension,
        "local_dimension": known.dimension,
        "source": known.source,
        "verdict": str(verdict),
    }
    return reference_text(verdict, known), verdict is not AgreementKind.DIFFERS, found


def _other_equations(problem: Problem, at: tuple[Number, ...] | None) -> Iterator[OtherEquations]:
    """Equations to compare with, those of a mechanism only made when they are asked for.

    Raises:
        UsageError: if there are none.
    """
    from nag.mechanism.other_equations import other_equations

    found = other_equations(problem, at)
    if problem.mechanism is not None and at is None:
        return found
    first = next(found, None)
    if first is None:
        raise UsageError(
            "--check: there is no second formulation: that is for mechanisms with loops at their "
            "reference configuration, for tables in half-angles, linkages and frameworks; one in "
            "space needs other bars to pin, and no --at"
        )
    return iter([first])


def _is_limited(options: argparse.Namespace, report: MobilityReport) -> bool:
    """Whether the answer may depend on the budget."""
    if options.local or options.components or options.curves or report.local is None:
        return report.least_degree is not None
    from nag.mechanism.mobility_at import ALL_COMPONENTS

    return report.local.lower > 0 and report.rests_on != ALL_COMPONENTS


def _read_moving(options: argparse.Namespace) -> tuple[Case, Problem | None]:
    """The case, and its problem; None if it is a mechanism without loops.

    Raises:
        UsageError: if nothing moves in it, or no configuration of it is known or given.
    """
    from nag.mechanism.mobility_at import check_body, product_of_loops, tree_of
    from nag.mechanism.problem import in_real_coordinates

    case = read_given_case(options)
    try:
        check_body(options.of, case.mechanism or case.assembly)
    except NagError as error:
        raise UsageError(f"--{error}") from None
    if tree_of(case) is not None:
        if options.at is not None:
            raise UsageError(f"--at: {options.case} has no loop, so that it has no equations")
        return case, None
    problem = None
    if case.kind == "mechanism" and options.at is None and options.formulation is None:
        problem = product_of_loops(case.mechanism, _detail(options), chosen_run(options))
    if problem is None:
        problem = problem_of_case(case, options.formulation or "auto")
    if problem.model is None:
        raise UsageError(
            f"{options.case}: is a polynomial system, no mechanism; ask `nag local` or "
            "`nag decompose`"
        )
    if options.at is not None:
        return case, in_real_coordinates(problem)
    if problem.reference is None:
        from nag.mechanism.real_assemblies import obstacle

        reason = obstacle(problem.parts)
        if reason:
            raise UsageError(f"{options.case}: it cannot be assembled (proved): {reason}")
        if options.local:
            raise UsageError(
                f"{options.case}: its parts are not assembled: give --at, or leave out --local"
            )
    return case, problem


def _detail(options: argparse.Namespace) -> Detail:
    """What is asked for."""
    if options.components or options.curves:
        return "curves" if options.curves else "components"
    return "local" if options.local else "through"


def _reports(
    options: argparse.Namespace,
    given: Case | Problem,
    at: tuple[Number, ...] | None,
    how: Run,
    budget: float | None = None,
) -> Iterator[MobilityReport]:
    """What is known of a configuration, and then what is known more."""
    from nag.mechanism.mobility_at import NoAssembly, mobility_in_steps
    from nag.numerics.local_dimension import NoSolution

    budget = options.budget if budget is None else budget
    try:
        yield from mobility_in_steps(
            given,
            at,
            detail=_detail(options),
            budget=budget,
            of=options.of,
            tolerance=options.tolerance,
            run=how,
        )
    except NoAssembly as reason:
        raise error_in_file(options.case, reason) from None
    except NoSolution as reason:
        raise UsageError(f"--at: {reason}; it is no configuration of the mechanism") from None


def _compare(
    options: argparse.Namespace, report: MobilityReport, equations: OtherEquations | None
) -> tuple[str, bool, dict[str, Any] | None]:
    """What other equations say, whether it agrees, and that as a JSON object."""
    if equations is None:
        return "no other formulation covers this mechanism", True, None
    # A smooth configuration lies on one component, of a degree that depends on the coordinates,
    # unless these depend linearly on each other.
    smooth = report.local is None or report.local.smooth
    budget = 0 if smooth and equations.alike != "degrees" else None
    *_, other = _reports(options, equations.problem, equations.at, chosen_run(options), budget)
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
