"""The command ``nag eliminate``: exact equations of a component in some of its variables."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from nag.algebra.tokens import list_names
from nag.cli.arguments import (
    UsageError,
    error_in_file,
    has_components,
    problem_of_case,
    read_given_case,
    whole,
)
from nag.cli.running import CommandAnswer, answer_of, chosen_run, name_case
from nag.cli.witness_input import (
    add_component,
    add_input,
    asked_point,
    component_of,
    doubt_rows,
    numbered_row,
    read_components,
)
from nag.errors import NagError

if TYPE_CHECKING:
    from nag.algebra.number import Number
    from nag.algebra.system import PolynomialSystem
    from nag.files.cases import Case
    from nag.mechanism.problem import Problem
    from nag.questions import ChosenComponent

MOST_DEGREE = 100


def _degree(text: str) -> int:
    return whole(text, 1, MOST_DEGREE)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag eliminate``."""
    add_input(
        parser,
        'the component through a point instead, exact and regular, or complex: "x = 0, y = 1/2", '
        "the name of a point of the case, or `reference`",
    )
    parser.add_argument(
        "--onto",
        metavar="NAMES",
        help="variables of the equations, with commas: a0,a2,c2 (default: essential ones); of a "
        "linkage x_P,y_P, the place of its pin P, whose equation is that of the curve which this "
        "point of a coupler draws",
    )
    add_component(
        parser,
        "number of the component, in the order of `nag decompose` (default: 1, of a "
        "mechanism the one through the reference configuration)",
    )
    parser.add_argument(
        "--degree",
        type=_degree,
        metavar="D",
        help="all equations up to this degree (default: until they define the image)",
    )
    parser.add_argument(
        "--polynomial", action="store_true", help="only polynomial maps to the other variables"
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """Equations of a component's image, and maps to the other variables."""
    if options.at is not None and options.component is not None:
        raise UsageError("--at: --component names a component already; give one of the two")
    from nag.interpolation.image_ideal import eliminate_component
    from nag.interpolation.precise_samples import SourceError
    from nag.interpolation.shown import checked_row, elimination_lines
    from nag.interpolation.vanishing import InterpolationError

    try:
        case, chosen, top, tail = _begin(options)
        cloud = chosen.cloud
        onto = _read_names(options.onto, cloud.ambient.system)
        how = options.degree, options.polynomial, options.progress
        found = eliminate_component(cloud, chosen.alike, onto, *how)
    except (SourceError, InterpolationError) as error:
        raise error_in_file(options.case, error) from None
    complete = not found.note and not tail
    tail = [*([("open", found.note)] if found.note else []), *tail, checked_row(found)]
    if options.onto is None and not found.generators:
        from nag.algebra.tokens import MOST_NAMES

        names = ",".join(cloud.ambient.system.own_variables[:MOST_NAMES])
        tail.append(("hint", f"--onto {names} gives equations in these variables"))
    blocks = [*top, *found.rows()], elimination_lines(found)
    said = f"coefficients recognised in {found.digits} digits" if found.digits else ""
    return answer_of(options, case, blocks, tail, found.document(), complete, said=said)


def _read_names(text: str | None, system: PolynomialSystem) -> tuple[int, ...] | None:
    """Indices of the variables that ``--onto`` names."""
    from nag.questions import place_variables

    if text is None:
        return None
    try:
        return place_variables(list_names(text), system)
    except NagError as error:
        raise UsageError(f"--{error}").mended_by(error.keyword) from None


Labelled = list[tuple[str, str]]
Begun = tuple[tuple[str, str], "ChosenComponent", Labelled, Labelled]


def _begin(options: argparse.Namespace) -> Begun:
    """Title and file of the case, the component, and what is said of it at the top and below."""
    from nag.interpolation.precise_samples import SourceError
    from nag.questions import choose_component
    from nag.report.model import body_rows

    run, number = chosen_run(options), options.component
    if has_components(options.case):
        if options.at is not None:
            raise UsageError("--at: is for cases; of an export name a --component")
        read = read_components(options)
        component_of(read, number or 1, "--component")
        chosen = choose_component(read.decomposition, number or 1, None, run)
        return read.case, chosen, *_said(chosen)
    case, problem, point = _asked_in(options)
    try:
        chosen = choose_component(problem, number, point, run, list_names(options.onto or ()))
    except SourceError:
        raise
    except NagError as error:
        argument, _, reason = str(error).partition(": ")
        option = {"point": "--at", "component": "--component"}.get(argument)
        text = f"{option}: {reason}" if option else f"{case.path}: {error}"
        raise UsageError(text).mended_by(error.keyword) from None
    top, tail = _said(chosen)
    return name_case(case), chosen, [*top, *body_rows(problem)], tail


def _asked_in(
    options: argparse.Namespace,
) -> tuple[Case, Problem, str | tuple[Number | complex, ...] | None]:
    """The case, its problem, and the point of ``--at``: the name of one, or coordinates."""
    from nag.questions import ambient_variables, formulation_of_component

    case = read_given_case(options, exports=True)
    asked = options.formulation or "auto"
    problem = problem_of_case(case, formulation_of_component(case, options.component, asked))
    points = {point.name: point.at for point in problem.points}
    point = options.at
    if point is not None and point.strip() in points:
        point = point.strip()
    elif point is not None:
        point = asked_point(options.case, point, ambient_variables(problem).system, points)
    return case, problem, point


def _said(chosen: ChosenComponent) -> tuple[Labelled, Labelled]:
    """Which component it is, and what is not known of it and of the others."""
    found = chosen.found
    if found is None:
        place = chosen.place
        where = "the reference configuration" if place == "reference" else place
        through = f"through {where}, of dimension {chosen.cloud.source.dimension}"
        return [("component", through)], []
    component = found.components[chosen.number - 1]
    tail = [*doubt_rows(found), *([("open", component.note)] if component.note else [])]
    return [numbered_row(chosen.number, component)], tail
