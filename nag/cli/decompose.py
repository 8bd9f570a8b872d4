"""The command ``nag decompose``: the irreducible components of a case, and the mobility."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

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
from nag.cli.running import Answer, as_chosen, run_row
from nag.cli.sweep import run as run_sweep
from nag.cli.sweep import sweep_of

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.mechanism.model import Model
    from nag.witness.witness import Decomposition

MOST_STARTS = 10**6


def _starts(text: str) -> int:
    return whole(text, 1, MOST_STARTS)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag decompose``."""
    add_case(parser)
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


def run(arguments: argparse.Namespace) -> Answer:
    """The irreducible components of a case."""
    if arguments.sweep is not None:
        return run_sweep(arguments)
    if arguments.starts is not None and arguments.method != "sampling":
        raise UsageError("--starts: is for --method sampling")
    case, model = read_problem(arguments)
    model = _in_coordinates(arguments, case, model)
    if arguments.modes == "all":
        return _all_modes(arguments, case)
    from nag.decomposition.through import accounted, through_points
    from nag.files.export import document
    from nag.files.problem import origin, points_of
    from nag.report.answer import answer_lines
    from nag.witness.frame import expanded

    case, model, decomposition = _decomposed(arguments, case, model)
    if arguments.expand:
        decomposition = expanded(decomposition)
    points = through_points(decomposition, points_of(case, model), arguments.threads)
    decomposition = accounted(decomposition, points)
    return Answer(
        answer_lines(decomposition, case, model, points, run_row(arguments)),
        decomposition.complete,
        lambda: document(decomposition, origin(case, model)),
        proof_asked_for(arguments, decomposition),
    )


def _in_coordinates(arguments: argparse.Namespace, case: Case, model: Model | None) -> Model | None:
    """The model that is decomposed, in the coordinates that were asked for."""
    known = case.assembly if model is None and case.is_table else model
    for option, value in (("coordinates", None), ("modes", "reference")):
        given = getattr(arguments, option) != value
        if given and model is None and (known is None or option == "modes"):
            raise only_assembled(arguments.case, case, f"--{option}")
    if known is None:
        return None
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
    if arguments.coordinates != "joint" or known.formulation != "E":
        return model
    if arguments.formulation is not None:
        raise UsageError(
            f"--coordinates joint: formulation {known.formulation} has none; use --formulation H"
        )
    arguments.formulation = "H"
    return read_problem(arguments)[1]


def _decomposed(
    arguments: argparse.Namespace, case: Case, model: Model | None
) -> tuple[Case, Model | None, Decomposition]:
    """The components, and the case or the model in whose coordinates they are."""
    from nag.files.problem import decomposed, symmetries_of, system_of

    options = {**as_chosen(arguments), "progress": arguments.progress}
    if arguments.method == "sampling":
        from nag.decomposition.discovery import discover

        starts = {} if arguments.starts is None else {"starts": arguments.starts}
        starts["symmetries"] = symmetries_of(case, model)
        return case, model, discover(system_of(case, model), **options, **starts)
    decomposition = decomposed(case, model, **options)
    known = model if case.assembly is None else case.assembly
    if arguments.coordinates != "euler" or known is None or known.formulation == "E":
        return case, model, decomposition
    if model is None:
        from nag.files.dh_case import in_formulation
        from nag.mechanism.dh_euler import euler_closings

        _, answer = euler_closings(case.assembly, decomposition, threads=arguments.threads)
        return in_formulation(case, "E"), None, answer
    from nag.mechanism.coordinates import euler_decomposition

    return case, *euler_decomposition(model, decomposition, threads=arguments.threads)


def _all_modes(arguments: argparse.Namespace, case: Case) -> Answer:
    """Decompose one combination of modes of each class, as `run` does the one of the reference."""
    from nag.files.modes_export import document
    from nag.mechanism.mode_decomposition import decompose_modes
    from nag.mechanism.model import ModelError
    from nag.report.modes import modes_lines

    try:
        answer = decompose_modes(
            case.mechanism,
            arguments.formulation or "auto",
            arguments.coordinates or ("joint" if arguments.formulation == "H" else "euler"),
            **as_chosen(arguments),
            progress=arguments.progress,
        )
    except ModelError as error:
        raise UsageError(f"{arguments.case}: {error}") from None
    lines = modes_lines(answer, case.title, run_row(arguments))
    return Answer(lines, answer.complete, lambda: document(answer, case))
