"""The command ``nag decompose``: the irreducible components of a case, and the mobility."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    UsageError,
    add_case,
    add_certify,
    add_running,
    only_assembled,
    read_problem,
    whole,
)
from nag.cli.certify import proof_asked_for
from nag.cli.running import CommandAnswer, chosen_run, name_case, run_row
from nag.cli.sweep import run as run_sweep
from nag.cli.sweep import sweep_of
from nag.mechanism import PLATFORM_ALONE

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.mechanism.problem import Problem
    from nag.tracking.run import Run
    from nag.witness.witness import Decomposition

MOST_STARTS = 10**6


def _starts(text: str) -> int:
    return whole(text, 1, MOST_STARTS)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag decompose``."""
    add_case(parser, exports=True)
    add_running(parser)
    add_certify(parser)
    parser.add_argument(
        "--expand",
        action="store_true",
        help="list every component, not one of each orbit of the system's symmetries",
    )
    parser.add_argument(
        "--method",
        choices=("complete", "sampling"),
        default="complete",
        help="find all components, or those that Newton's method reaches from random points, for "
        "systems that are too large; that is never complete (default: complete)",
    )
    parser.add_argument(
        "--coordinates",
        choices=("joint", "euler"),
        help="coordinates of a mechanism's components: those of the joints, or Euler parameters of "
        "the bodies, to which components in joint coordinates are carried over (default: those of "
        "the formulation)",
    )
    parser.add_argument(
        "--modes",
        choices=("reference", "all"),
        default="reference",
        help="assembly modes of a mechanism's joints: that of the reference configuration, or "
        "every combination, one of each class of like ones (default: reference)",
    )
    parser.add_argument(
        "--starts",
        type=_starts,
        metavar="N",
        help="with --method sampling: number of random points (default: 100)",
    )
    parser.add_argument(
        "--sweep",
        type=sweep_of,
        metavar="NAME=FIRST:LAST:COUNT",
        help="the components for so many values of a parameter: found for a general value, then "
        "followed by parameter homotopy",
    )


def run(arguments: argparse.Namespace) -> CommandAnswer:
    """The irreducible components of a case."""
    if arguments.sweep is not None:
        return run_sweep(arguments)
    if arguments.starts is not None and arguments.method != "sampling":
        raise UsageError("--starts: is for --method sampling")
    case, problem = read_problem(arguments)
    problem = _in_coordinates(arguments, case, problem)
    if arguments.modes == "all":
        return _all_modes(arguments, case)
    from nag.decomposition.through import note_doubts, through_points
    from nag.files.export import Origin
    from nag.report.answer import answer_lines
    from nag.witness.frame import expand_orbits

    def document_of(found: Decomposition) -> dict[str, Any] | None:
        same = found.system == problem.system
        return found.document(**Origin.of(case, problem).head) if same else None

    problem, decomposition = _decompose(arguments, problem, chosen_run(arguments, document_of))
    if arguments.expand:
        decomposition = expand_orbits(decomposition)
    points = through_points(decomposition, problem.named, arguments.threads)
    decomposition = note_doubts(decomposition, points)
    return CommandAnswer(
        answer_lines(decomposition, case, problem, points, run_row(arguments)),
        decomposition.complete,
        lambda: decomposition.document(**Origin.of(case, problem).head),
        proof_asked_for(arguments, decomposition),
    )


def _in_coordinates(arguments: argparse.Namespace, case: Case, problem: Problem) -> Problem:
    """The problem that is decomposed, in the coordinates that were asked for."""
    if arguments.coordinates is not None and problem.formulation is None:
        raise only_assembled(case, "--coordinates")
    if arguments.modes != "reference" and problem.mechanism is None:
        raise only_assembled(case, "--modes")
    if problem.formulation is None:
        return problem
    asked = (arguments.formulation, arguments.coordinates, arguments.modes)
    if asked == (None, None, "reference") and arguments.method != "sampling":
        from nag.mechanism.problem import problem_within_reach

        problem = problem_within_reach(problem)
    others = {
        "--expand": arguments.expand,
        "--method sampling": arguments.method == "sampling",
        "--certify": arguments.certify,
        "--certify-paths": arguments.certify_paths,
    }
    if arguments.modes == "all" and any(others.values()):
        option = next(name for name, given in others.items() if given)
        raise UsageError(f"{option}: is not for --modes all")
    if arguments.coordinates == "euler" and others["--method sampling"]:
        raise UsageError("--coordinates euler: --method sampling finds no other; use --formulation")
    if arguments.coordinates is not None and problem.formulation == PLATFORM_ALONE:
        raise UsageError(f"--coordinates: formulation {PLATFORM_ALONE} has those of a pose only")
    if arguments.method == "sampling" and problem.formulation == PLATFORM_ALONE:
        raise UsageError(
            f"--method sampling: finds no poses; leave out formulation {PLATFORM_ALONE}"
        )
    if arguments.coordinates != "joint" or problem.formulation != "E":
        return problem
    if arguments.formulation is not None:
        raise UsageError("--coordinates joint: formulation E has none; use --formulation H")
    arguments.formulation = "H"
    return read_problem(arguments)[1]


def _decompose(
    arguments: argparse.Namespace, problem: Problem, run: Run
) -> tuple[Problem, Decomposition]:
    """The components, and the problem in whose coordinates they are."""
    if arguments.method == "sampling":
        from nag.decomposition.discovery import discover

        starts = {} if arguments.starts is None else {"starts": arguments.starts}
        starts["symmetries"] = problem.symmetries
        return problem, discover(problem.system, run=run, **starts)
    decomposition = problem.decompose(run=run)
    if arguments.coordinates != "euler" or problem.formulation is None:
        return problem, decomposition
    from nag.mechanism.coordinates import carry_to_euler

    return carry_to_euler(problem, decomposition, threads=arguments.threads)


def _all_modes(arguments: argparse.Namespace, case: Case) -> CommandAnswer:
    """Decompose one combination of modes of each class, as `run` does the one of the reference."""
    from nag.mechanism.model import ModelError
    from nag.mechanism.shown import modes_lines
    from nag.questions import decompose_modes

    try:
        answer = decompose_modes(
            case.mechanism,
            formulation=arguments.formulation or "auto",
            coordinates=arguments.coordinates,
            run=chosen_run(arguments),
        )
    except ModelError as error:
        raise UsageError(f"{arguments.case}: {error}") from None
    lines = modes_lines(answer, case.title, run_row(arguments))
    return CommandAnswer(lines, answer.complete, lambda: answer.document(*name_case(case)))
