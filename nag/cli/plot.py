"""The command ``nag plot``: pictures of real curves, motions and mechanisms."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    UsageError,
    add_formulation,
    add_reading,
    add_tracking,
    is_json,
    parse_circuit,
    problem_of_case,
    read_given_case,
)
from nag.cli.chart_files import check_picture
from nag.cli.running import CommandAnswer, chosen_run, name_case, run_row
from nag.cli.witness_input import (
    add_component,
    component_of,
    doubt_rows,
    read_components,
)
from nag.errors import ComponentError, InputError, NagError
from nag.pictures.plot import DRAWN, KINDS, choose_picture, find_drawn

if TYPE_CHECKING:
    from nag.algebra.system import PolynomialSystem
    from nag.pictures.plot import Picture
    from nag.text.table import Row
    from nag.witness.witness import WitnessSet


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag plot``."""
    parser.add_argument(
        "case", metavar="EXPORT_OR_CASE", help="export of `nag decompose --json`, or case file"
    )
    add_formulation(parser)
    add_reading(parser)
    add_tracking(parser)
    parser.add_argument(
        "--onto",
        type=_pair_or_triple,
        metavar="X,Y[,Z]",
        help="two variables of the equations, or three: draw the real points of the components of "
        "dimension one, or where there is none, in three variables, of dimension two; with "
        "--point two of the coordinates x, y and z",
    )
    add_component(parser, "draw that component alone, by its number (default: all)")
    parser.add_argument(
        "--joints",
        type=_pair,
        metavar="A,B",
        help="draw the angles or slides of two joints against each other, along the motion",
    )
    parser.add_argument(
        "--point",
        metavar="NAME",
        help="draw the path of a joint's point, or of a point of a framework, along the motion",
    )
    parser.add_argument(
        "--circuit",
        type=parse_circuit,
        default="reference",
        metavar="WHICH",
        help="as of nag motion (default: reference; all where no configuration is given)",
    )
    parser.add_argument("--graph", action="store_true", help="draw the graph of bodies and joints")
    parser.add_argument(
        "--mechanism",
        action="store_true",
        help="draw the mechanism at its reference configuration; where there is none, or with "
        "--circuit, once on each circuit",
    )
    parser.add_argument(
        "--tree", action="store_true", help="draw all components by their dimensions"
    )
    parser.add_argument(
        "--out", metavar="FILE", required=True, help=f"the picture: {', '.join(KINDS)}"
    )


def _pair(text: str) -> tuple[str, ...]:
    names = _names(text)
    if len(names) != 2:
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is none; write two names, as in x,y")
    return names


def _pair_or_triple(text: str) -> tuple[str, ...]:
    names = _names(text)
    if len(names) not in (2, 3):
        raise argparse.ArgumentTypeError(
            f"{text[:40]!r} is none; write two names, as in x,y, or three"
        )
    return names


def _names(text: str) -> tuple[str, ...]:
    """Names between commas; none where one is missing or there twice."""
    names = tuple(name.strip() for name in text.split(","))
    return names if all(names) and len(set(names)) == len(names) else ()


def run(options: argparse.Namespace) -> CommandAnswer:
    """A picture.

    Raises:
        UsageError: if it is not said what to draw, or that is not there.
    """
    try:
        kind = choose_picture(vars(options), "--")
    except NagError as error:
        raise UsageError(str(error)) from None
    check_picture("out", options.out, options.case)
    if options.component and kind != "onto":
        raise UsageError("--component is for --onto")
    try:
        return (_of_components if kind in ("onto", "tree") else _of_mechanism)(options, kind)
    except (UsageError, InputError):
        raise
    except ComponentError as error:
        raise ComponentError(f"{options.case}: {error}") from None
    except NagError as error:
        argument = str(error).partition(":")[0]
        named = argument in (*DRAWN, "component")
        raise UsageError(f"--{error}" if named else f"{options.case}: {error}") from None


def _of_components(options: argparse.Namespace, kind: str) -> CommandAnswer:
    from nag.pictures.plot import plot_components, variables_onto

    def check(system: PolynomialSystem, _: Any) -> None:
        if kind == "onto":
            variables_onto(options.onto, system.own_variables)

    found = read_components(options, check, real=kind == "onto")
    answer = found.decomposition
    chosen: dict[int, WitnessSet] = {}
    if kind == "onto":
        numbers = [options.component] if options.component else []
        if not numbers:
            numbers = list(find_drawn(answer, options.onto))
        chosen = {number: component_of(found, number, "--component") for number in numbers}
    picture = plot_components(
        answer, kind, options.onto, found.title, options.out, chosen_run(options), chosen
    )
    return _drawn(options, found.case, picture, doubt_rows(found.decomposition))


def _of_mechanism(options: argparse.Namespace, kind: str) -> CommandAnswer:
    from nag.pictures.plot import plot_mechanism

    if is_json(options.case):
        raise UsageError(f"{options.case}: is an export; --{kind} is for cases of mechanisms")
    case = read_given_case(options)
    picture = plot_mechanism(
        problem_of_case(case, options.formulation or "auto"),
        kind,
        getattr(options, kind),
        case.title,
        options.out,
        chosen_run(options),
        onto=options.onto,
        circuit=options.circuit,
    )
    return _drawn(options, name_case(case), picture)


def _drawn(
    options: argparse.Namespace,
    case: tuple[str, str],
    picture: Picture,
    doubts: Sequence[Row] = (),
) -> CommandAnswer:
    from nag.text.table import sheet

    notes = [*doubts, *picture.notes]
    tail = [*notes, ("picture", picture.path), run_row(options)]
    return CommandAnswer(sheet(case[0], [*picture.rows, *tail]), not notes)
