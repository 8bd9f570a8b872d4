"""What the commands that work with components start from: an export, or a case that is decomposed.

Components are numbered from 1 in the order of the export; of an orbit, each one has a number.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from nag.cli.arguments import (
    UsageError,
    add_formulation,
    add_reading,
    add_running,
    has_components,
    read_problem,
    refuse_reading,
)
from nag.cli.running import chosen_run
from nag.errors import NagError

if TYPE_CHECKING:
    from nag.algebra.number import Number
    from nag.algebra.system import PolynomialSystem
    from nag.witness.witness import Decomposition, WitnessSet

ONE_POINT = (
    "which point? write either --at 'x = 1, y = 2', or the name of a point of the case behind the "
    "file"
)
# What `--at` is for, where a point is asked about.
POINT_AT = "the point itself: 'x = 1/2, y = sqrt(3)/2', all variables; or its name"
Points = Mapping[str, tuple["Number", ...]]
Check = Callable[["PolynomialSystem", Points], object]


@dataclass(frozen=True)
class ReadComponents:
    """A decomposition, with every component of each orbit, and where it came from.

    Attributes:
        title: title of the case.
        file: name of the case file, without its folder.
        points: named points of the case; none if an export was given.
        export: the export that it was read from; empty if a case was decomposed.
        obstacle: where real points are asked for, why parts that are given by lengths have no real
            assembly; empty if nothing proves it.
    """

    decomposition: Decomposition
    title: str
    file: str
    points: Points
    export: str = ""
    obstacle: str = ""

    @property
    def case(self) -> tuple[str, str]:
        """Title and file."""
        return self.title, self.file


def add_input(parser: argparse.ArgumentParser, at: str = "") -> None:
    """The export or case, which ``arguments.case`` holds, and how paths are tracked from it.

    Args:
        at: what ``--at`` gives where the file is no robot, as of `add_reading`.
    """
    parser.add_argument(
        "case", metavar="EXPORT_OR_CASE", help="export of `nag decompose --json`, or case file"
    )
    add_formulation(parser)
    add_reading(parser, at)
    add_running(parser)


def add_component(parser: argparse.ArgumentParser, text: str, default: int | None = None) -> None:
    """The option for a component by its number; ``text`` says which one is meant."""
    parser.add_argument(
        "--component", type=component_number, default=default, metavar="K", help=text
    )


def read_components(
    options: argparse.Namespace, check: Check | None = None, real: bool = False
) -> ReadComponents:
    """The decomposition to work with; a case is decomposed, or what an export of solutions answers.

    Args:
        check: called with the system and the named points before a case is decomposed.
        real: whether real points are asked for, so that a case needs coordinates that are real
            where its configurations are.

    Raises:
        nag.errors.InputError: if the file cannot be read.
    """
    from nag.witness.frame import expand_orbits

    if has_components(options.case):
        from nag.files.export import read_export

        refuse_reading(options)
        export = read_export(options.case)
        if check is not None:
            check(export.decomposition.system, {})
        origin = export.origin
        title = origin.title if origin else "a system built in memory"
        file = origin.file if origin else Path(options.case).name
        return ReadComponents(expand_orbits(export.decomposition), title, file, {}, options.case)

    case, problem = read_problem(options)
    reason = ""
    if real:
        from nag.mechanism.problem import in_real_coordinates
        from nag.mechanism.real_assemblies import obstacle, of_real_assemblies

        reason = "" if problem.parts is None else obstacle(problem.parts)
        problem = of_real_assemblies(in_real_coordinates(problem))
    points = {point.name: point.at for point in problem.points}
    if check is not None:
        check(problem.system, points)
    decomposition = problem.decompose(run=chosen_run(options))
    if options.progress is not None:
        options.progress.erase()
    found = expand_orbits(decomposition)
    return ReadComponents(found, case.title, Path(case.path).name, points, obstacle=reason)


def component_number(text: str) -> int:
    """A component's number on the command line."""
    digits = text.strip()
    if not (digits.isascii() and digits.isdigit() and len(digits) < 10 and int(digits) > 0):
        raise argparse.ArgumentTypeError(f"{text[:30]!r} is not a component's number, 1 or more")
    return int(digits)


def component_of(found: ReadComponents, number: int, option: str) -> WitnessSet:
    """The component with a number; undecided, if its trace cannot be tested that was read.

    Raises:
        UsageError: if there is none, or its points are not all points of a set on its slice.
    """
    from nag.errors import ComponentError
    from nag.questions import check_trace, component_numbered

    component = component_numbered(found.decomposition, number, option)
    if not found.export:
        return component
    try:
        return check_trace(found.decomposition, number - 1)
    except ComponentError as error:
        raise UsageError(f"{found.export}: {error}") from None


def with_tested_traces(found: ReadComponents) -> ReadComponents:
    """What was given with each component as `component_of` has it.

    Raises:
        UsageError: if the points of one are not all points of a set on its slice.
    """
    from nag.errors import ComponentError
    from nag.questions import check_traces

    if not found.export:
        return found
    try:
        return replace(found, decomposition=check_traces(found.decomposition))
    except ComponentError as error:
        raise UsageError(f"{found.export}: {error}") from None


def add_point(parser: argparse.ArgumentParser, otherwise: str = "") -> None:
    """The argument for the name of a point, where ``--at`` gives its coordinates."""
    parser.add_argument(
        "point",
        metavar="POINT",
        nargs="?",
        help=f"name of a point of the case; of a mechanism, 'reference'{otherwise}",
    )


def chosen_point(
    options: argparse.Namespace, system: PolynomialSystem, points: Points
) -> tuple[Number | complex, ...]:
    """The point that `add_point`'s argument names or ``--at`` spells; else the only named one.

    Raises:
        UsageError: if there is none, or both options are given.
    """
    if options.at is None and options.point is None:
        if len(points) == 1:
            return next(iter(points.values()))
        raise UsageError(ONE_POINT)
    if options.at is None:
        return named_point(options.case, options.point, points)
    if options.point is not None:
        raise UsageError(ONE_POINT)
    return asked_point(options.case, options.at, system, points)


def asked_point(
    file: str, text: str, system: PolynomialSystem, points: Points
) -> tuple[Number | complex, ...]:
    """The point that the text of ``--at`` names or spells.

    Raises:
        UsageError: if there is none.
    """
    from nag.algebra.tokens import is_name

    name = text.strip()
    if name in points or is_name(name):
        return named_point(file, name, points)
    return point_at(text, system)


def named_point(file: str, name: str, points: Points) -> tuple[Number, ...]:
    """The point of a case that has a name.

    Raises:
        UsageError: if there is none.
    """
    from nag.algebra.tokens import nearest, quote

    if not points:
        raise UsageError(f"{file}: has no named points; write coordinates, --at 'x = 1, y = 2'")
    if name not in points:
        raise UsageError(
            f"{file}: has no point {quote(name)}{nearest(name, points)}; it has "
            f"{', '.join(map(quote, points))}"
        )
    return points[name]


def real_point_at(text: str, system: PolynomialSystem) -> tuple[Number, ...]:
    """`point_at`, where all coordinates are to be real.

    Raises:
        UsageError: if one is not.
    """
    found = point_at(text, system)
    numbers = tuple(x for x in found if not isinstance(x, complex))
    if len(numbers) < len(found):
        raise UsageError("--at: give real numbers")
    return numbers


def point_at(text: str, system: PolynomialSystem) -> tuple[Number | complex, ...]:
    """The point that ``"x = 0, y = 1 + 2*I"`` spells, exact where it is real.

    Raises:
        UsageError: if a variable is unknown, missing or given twice, or a value is no
            number.
    """
    from nag.algebra.from_python import coordinates, spelled_coordinate
    from nag.algebra.tokens import nearest, quote, shorten_names

    variables = system.own_variables
    units = ("I", *system.variables[len(variables) :])
    values: dict[str, str] = {}
    # Where there are no variables, nothing is a point.
    for part in text.split(",") if variables or text.strip() else ():
        name, equals, value = part.partition("=")
        name = name.strip()
        if not equals:
            raise UsageError(f"--at: {quote(part.strip())}: write 'variable = number'")
        if name not in variables:
            raise UsageError(
                f"--at: {quote(name)} is not one of the variables{nearest(name, variables)}; "
                f"they are {shorten_names(variables)}"
            )
        if name in values:
            raise UsageError(f"--at: {name} is given twice")
        try:
            spelled_coordinate(value.strip(), name, units)
        except NagError as error:
            raise UsageError(f"--at: {error}") from None
        values[name] = value.strip()
    missing = [name for name in variables if name not in values]
    if missing:
        more = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
        raise UsageError(f"--at: no value for {missing[0]}{more}")
    return coordinates(values, system.variables, system.imaginary)


def numbered_row(number: int, component: WitnessSet, of: str = "") -> tuple[str, str]:
    """The line that says which component is meant; ``of``: which dimension it is told by."""
    kind = f"{number}: {of}dimension {component.dimension}, degree {component.degree}"
    return "component", f"{kind}, {component.status}"


def doubt_rows(found: Decomposition) -> list[tuple[str, str]]:
    """What makes the decomposition itself incomplete, as labelled lines."""
    if found.complete:
        return []
    return [("open", f"the decomposition is incomplete: {'; '.join(found.notes)}")]
