"""The command ``nag eliminate``: exact equations of a component in some of its variables."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import UsageError, error_in_file, read_case_file, read_problem, whole
from nag.cli.running import CommandAnswer, answer_of, chosen_run, name_case
from nag.cli.witness_input import (
    ReadComponents,
    add_component,
    add_input,
    asked_point,
    component_of,
    doubt_rows,
    is_export,
    numbered_row,
    read_components,
    real_point_at,
)

if TYPE_CHECKING:
    import numpy as np

    from nag.algebra.number import Number
    from nag.algebra.system import PolynomialSystem
    from nag.files.cases import Case
    from nag.interpolation.point_cloud import AmbientVariables, Cloud
    from nag.mechanism.problem import Problem
    from nag.tracking.run import Run
    from nag.witness.witness import WitnessSet

MOST_DEGREE = 100
# Of more variables a message names the first.
MOST_NAMES = 12


def _degree(text: str) -> int:
    return whole(text, 1, MOST_DEGREE)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag eliminate``."""
    add_input(parser)
    parser.add_argument(
        "--onto",
        metavar="NAMES",
        help="variables of the equations, with commas: a0,a2,c2 (default: essential ones)",
    )
    add_component(
        parser,
        "number of the component, in the order of `nag decompose` (default: 1, of a "
        "mechanism the one through the reference configuration)",
    )
    parser.add_argument(
        "--at",
        metavar="POINT",
        help='the component through a point instead, exact and regular, or complex: "x = 0, '
        'y = 1/2", the name of a point of the case, or `reference`',
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
        case, cloud, top, tail, alike = _begin(options)
        onto = _read_names(options.onto, cloud.ambient.system)
        how = options.degree, options.polynomial, options.progress
        found = eliminate_component(cloud, alike, onto, *how)
    except (SourceError, InterpolationError) as error:
        raise error_in_file(options.case, error) from None
    complete = not found.note and not tail
    tail = [*([("open", found.note)] if found.note else []), *tail, checked_row(found)]
    if options.onto is None and not found.generators:
        names = ",".join(cloud.ambient.system.own_variables[:MOST_NAMES])
        tail.append(("hint", f"--onto {names} gives equations in these variables"))
    blocks = [*top, *found.rows()], elimination_lines(found)
    said = f"coefficients recognised in {found.digits} digits" if found.digits else ""
    return answer_of(options, case, blocks, tail, found.document(), complete, said=said)


def _read_names(text: str | None, system: PolynomialSystem) -> tuple[int, ...] | None:
    """Indices of the variables that ``--onto`` names."""
    from nag.errors import NagError
    from nag.questions import place_variables

    if text is None:
        return None
    try:
        return place_variables([name.strip() for name in text.split(",")], system)
    except NagError as error:
        names = ", ".join(system.own_variables[:MOST_NAMES])
        more = f"; they are {names}{', ...' if system.n > MOST_NAMES else ''} (of a mechanism "
        more += "--formulation E has Euler parameters)"
        unknown = "is not one of the variables" in str(error)
        raise UsageError(f"--{error}{more if unknown else ''}") from None


Labelled = list[tuple[str, str]]
Begun = tuple[tuple[str, str], "Cloud", Labelled, Labelled, Mapping[int, "WitnessSet"]]


def _begin(options: argparse.Namespace) -> Begun:
    """What is begun with.

    Title and file of the case, the points, what is said of them at the top and below, and the
    components that may be conjugates of this one, by their numbers, this one first.
    """
    import numpy as np

    from nag.interpolation.point_cloud import AmbientVariables, Cloud
    from nag.interpolation.precise_samples import SourceError, source_of_component
    from nag.questions import list_alike
    from nag.report.model import body_rows

    rng = np.random.default_rng([options.seed, 4])
    run = chosen_run(options)
    problem, top, complex_point = None, [], None
    if not is_export(options.case):
        if options.component is None and options.formulation is None:
            options.formulation = _default_formulation(options)
        case, problem = read_problem(options)
        top = body_rows(problem)
        assembled = problem.mechanism is not None
        if options.at is not None and not assembled:
            complex_point = _complex_point(options, problem)
        through = options.at is not None and complex_point is None
        if through or (assembled and options.component is None):
            return _through_point(options, case, problem, rng, run, top)
    elif options.at is not None:
        raise UsageError("--at: is for cases; of an export name a --component")
    found = read_components(options)
    number = options.component or 1
    if complex_point is not None:
        number = _number_through(found, complex_point, run)
    component = component_of(found, number, "--component")
    system = found.decomposition.system
    ambient = AmbientVariables.itself(system) if problem is None else _ambient(problem)
    if component.dimension == 0:
        raise SourceError("the component is a point; there is nothing to eliminate from")
    top = [numbered_row(number, component), *top]
    tail = [*doubt_rows(found), *([("open", component.note)] if component.note else [])]
    cloud = Cloud(source_of_component(system, component), ambient, rng, run)
    return found.case, cloud, top, tail, list_alike(found.decomposition, number)


def _complex_point(
    options: argparse.Namespace, problem: Problem
) -> tuple[Number | complex, ...] | None:
    """The point of ``--at``, if a coordinate is complex: None of an exact one."""
    points = {point.name: point.at for point in problem.points}
    at = asked_point(options.case, options.at, problem.system, points)
    return at if any(isinstance(x, complex) for x in at) else None


def _number_through(found: ReadComponents, point: tuple[Number | complex, ...], run: Run) -> int:
    """The number of the one component through a point that is known in doubles.

    Raises:
        UsageError: if there is not one.
    """
    from nag.witness.membership import Membership, locate_point

    located = locate_point(found.decomposition, point, run=run)
    numbers = [i for i, a in enumerate(located.answers, 1) if a is Membership.MEMBER]
    if located.open or len(numbers) != 1:
        on = f"on components {', '.join(map(str, numbers))}" if numbers else "on no component"
        said = (
            "it is not known on which components the point lies"
            if located.open
            else (f"the point lies {on}")
        )
        raise UsageError(f"--at: {said}; name a --component")
    return numbers[0]


def _default_formulation(options: argparse.Namespace) -> str | None:
    """Euler parameters for a mechanism, in which the papers write; nothing for a system."""
    case = read_case_file(options.case, options.set)
    return None if case.mechanism is None else "E"


def _through_point(
    options: argparse.Namespace,
    case: Case,
    problem: Problem,
    rng: np.random.Generator,
    run: Any,
    top: Labelled,
) -> Begun:
    from nag.interpolation.point_cloud import Cloud
    from nag.interpolation.precise_samples import SourceError, source_at

    ambient = _ambient(problem)
    points = {point.name: point.at for point in problem.points}
    name = options.at or "reference"
    if name in points:
        point = tuple(points[name])
    else:
        whole = real_point_at(name, ambient.system)
        point = tuple(whole[i] for i in ambient.kept)
        if any(f(point) != x for f, x in zip(ambient.images, whole, strict=True)):
            raise UsageError("--at: the point does not satisfy the equations")
    try:
        source = source_at(problem.system, point, rng)
    except SourceError as error:
        what = "the reference configuration: " if name == "reference" else "--at: "
        raise UsageError(f"{options.case}: {what}{error}; or name a --component") from None
    which = "the reference configuration" if name == "reference" else name
    top = [("component", f"through {which}, of dimension {source.dimension}"), *top]
    return name_case(case), Cloud(source, ambient, rng, run), top, [], {}


def _ambient(problem: Problem) -> AmbientVariables:
    """All variables of a mechanism, where linear equations left only some in its system."""
    from nag.interpolation.point_cloud import AmbientVariables

    made = problem.mechanism
    elimination = None if made is None else getattr(made.form, "elimination", None)
    if elimination is None or elimination.system.variables != problem.system.variables:
        return AmbientVariables.itself(problem.system)
    names, kept = elimination.original_variables, elimination.kept
    return AmbientVariables.of(problem.system, names, kept, elimination.images)
