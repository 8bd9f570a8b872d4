"""The command ``nag plot``: pictures of real curves, motions and mechanisms."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    UsageError,
    add_formulation,
    add_parameters,
    add_robot,
    add_tracking,
    problem_of_case,
    read_given_case,
)
from nag.cli.chart_files import KINDS, check_picture, write_picture
from nag.cli.running import CommandAnswer, chosen_run, name_case, run_row
from nag.cli.witness_input import (
    add_component,
    component_of,
    doubt_rows,
    is_export,
    read_components,
)
from nag.errors import NagError

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.kinematics.motion import Motion
    from nag.kinematics.scene import Scene
    from nag.mechanism.problem import Problem

AXES = ("x", "y", "z")
DRAWN = ("--onto", "--joints", "--point", "--graph", "--mechanism", "--tree")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag plot``."""
    parser.add_argument(
        "case", metavar="EXPORT_OR_CASE", help="export of `nag decompose --json`, or case file"
    )
    add_formulation(parser)
    add_parameters(parser)
    add_robot(parser)
    add_tracking(parser)
    parser.add_argument(
        "--onto",
        type=_pair_or_triple,
        metavar="X,Y[,Z]",
        help="two variables of the equations, or three: draw the real points of the components of "
        "dimension one; with --point two of the coordinates x, y and z",
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
        choices=("reference", "all"),
        default="reference",
        help="as of nag motion (default: reference; all where no configuration is given)",
    )
    parser.add_argument("--graph", action="store_true", help="draw the graph of bodies and joints")
    parser.add_argument(
        "--mechanism",
        action="store_true",
        help="draw the mechanism at its reference configuration, or where there is none on its way",
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
    asked = [bool(options.joints), options.point is not None, options.graph, options.mechanism]
    given = [*asked, options.tree, options.onto is not None and options.point is None]
    if sum(given) > 1:
        raise UsageError(f"give one of {', '.join(DRAWN)}; --point takes --onto")
    if not any(given):
        raise UsageError(f"say what to draw, one of {', '.join(DRAWN)}")
    check_picture("out", options.out, options.case)
    if options.tree:
        return _of_all_components(options)
    return _of_mechanism(options) if any(asked) else _of_components(options)


def _of_all_components(options: argparse.Namespace) -> CommandAnswer:
    from nag.pictures.component_tree import draw_component_tree

    if options.component:
        raise UsageError("--component is for --onto")
    found = read_components(options, lambda variables, points: None)
    answer = found.decomposition
    return _drawn(
        options,
        found.case,
        [("components", str(len(answer.components)))],
        list(doubt_rows(found)),
        lambda path: draw_component_tree(answer, found.title, path),
    )


def _of_components(options: argparse.Namespace) -> CommandAnswer:
    from nag.algebra.tokens import nearest, quote
    from nag.errors import ComponentError
    from nag.real.find_curve import find_real_curve
    from nag.real.shown import answer_text

    def check(variables: Any, points: Any) -> None:
        for name in options.onto:
            if name not in variables:
                raise UsageError(
                    f"--onto: {quote(name)} is not one of the variables{nearest(name, variables)}"
                )

    found = read_components(options, check)
    variables = found.decomposition.system.variables
    numbers = [options.component] if options.component else _curves(found.decomposition.components)
    if not numbers:
        raise UsageError(f"{options.case}: has no component of dimension 1 to draw")
    curves, rows, notes = [], [], list(doubt_rows(found))
    for number in numbers:
        component = component_of(found, number, "--component")
        if component.dimension != 1:
            raise UsageError(
                f"--component: {number}: has dimension {component.dimension}; curves are drawn"
            )
        if options.progress is not None:
            options.progress("real curves", len(curves), len(numbers))
        try:
            curve = find_real_curve(component, run=chosen_run(options))
        except ComponentError as error:
            notes.append(("open", f"component {number}: {error}"))
            continue
        degree = f"dimension 1, degree {component.degree}"
        rows.append((f"component {number}", f"{degree}; {answer_text(curve)}"))
        if curve.reason:
            notes.append(("open", f"component {number}: {curve.reason}"))
        if curve.vertices or curve.edges:
            curves.append((f"component {number}", curve))
    if not curves:
        why = "; ".join(text for _, text in notes) or "no component of dimension 1 has real points"
        raise (ComponentError if notes else UsageError)(f"{options.case}: {why}")
    left_out = [k for k, c in enumerate(found.decomposition.components, 1) if c.dimension != 1]
    if left_out and not options.component:
        rows.append(("left out", f"{len(left_out)} of other dimensions than 1"))
    onto = [variables.index(name) for name in options.onto]
    from nag.pictures.curve_picture import draw_real_curves

    return _drawn(
        options,
        found.case,
        rows,
        notes,
        lambda path: draw_real_curves(curves, onto, found.title, path),
    )


def _curves(components: Any) -> list[int]:
    return [k for k, component in enumerate(components, 1) if component.dimension == 1]


def _of_mechanism(options: argparse.Namespace) -> CommandAnswer:
    from nag.kinematics.scene import scene_of
    from nag.mechanism.problem import in_real_coordinates

    option = next(name for name in DRAWN if name != "--onto" and getattr(options, name.lstrip("-")))
    if options.component:
        raise UsageError("--component is for --onto")
    if is_export(options.case):
        raise UsageError(f"{options.case}: is an export; {option} is for cases of mechanisms")
    case = read_given_case(options)
    if case.kind == "system":
        raise UsageError(f"{options.case}: is a polynomial system; {option} is for mechanisms")
    problem = in_real_coordinates(problem_of_case(case, options.formulation or "auto"))
    scene = scene_of(problem)
    named = name_case(case)
    if options.graph:
        from nag.pictures.joint_graph import draw_joint_graph

        rows = [("bodies", str(len(scene.bodies))), ("joints", str(len(scene.joints)))]
        return _drawn(
            options, named, rows, [], lambda path: draw_joint_graph(scene, case.title, path)
        )
    if options.mechanism:
        return _of_configuration(options, problem, scene, case)
    from nag.kinematics.shown import circuit_text
    from nag.pictures.motion_picture import (
        draw_joint_values,
        draw_point_paths,
        joint_indices,
        point_of,
    )

    onto = _axes(options, scene.planar)
    try:
        if options.joints:
            joint_indices(scene, options.joints)
        else:
            point_of(scene, options.point)
    except NagError as error:
        raise UsageError(f"{option}: {error}") from None
    found = _motion(options, problem)
    notes = [("open", note) for note in found.notes]
    if not found.circuits:
        from nag.errors import ComponentError

        raise ComponentError(f"{options.case}: no motion to draw: {'; '.join(found.notes)}")

    def draw(path: str) -> None:
        if options.joints:
            draw_joint_values(found, options.joints, case.title, path)
        else:
            draw_point_paths(found, options.point, onto, case.title, path)

    rows = [(f"circuit {c.number}", circuit_text(found, c)) for c in found.circuits]
    return _drawn(options, named, rows, notes, draw)


def _of_configuration(
    options: argparse.Namespace, problem: Problem, scene: Scene, case: Case
) -> CommandAnswer:
    import numpy as np

    from nag.errors import ComponentError
    from nag.pictures.mechanism_picture import draw_mechanism

    if scene.from_reference and problem.reference is not None:
        poses = scene.lift(np.array([[float(x) for x in problem.reference]]))
        where, notes = "the reference configuration", []
    else:
        found = _motion(options, problem)
        notes = [("open", note) for note in found.notes]
        if not found.circuits:
            raise ComponentError(f"{options.case}: nothing to draw: {'; '.join(found.notes)}")
        # Circuits may begin where links are in line.
        at = len(found.circuits[0]) // 8
        poses, where = found.circuits[0].poses.at(slice(at, at + 1)), "an eighth along circuit 1"
    return _drawn(
        options,
        name_case(case),
        [("drawn", where)],
        notes,
        lambda path: draw_mechanism(scene, poses, case.title, path),
    )


def _motion(options: argparse.Namespace, problem: Problem) -> Motion:
    from nag.kinematics.motion import motion

    try:
        return motion(problem, circuit=options.circuit, run=chosen_run(options))
    except NagError as error:
        raise UsageError(f"{options.case}: {error}") from None


def _axes(options: argparse.Namespace, normal: Any) -> tuple[int, int]:
    """Which coordinates of a point are drawn: those that the plane of motion is seen best in."""
    if options.point is None or options.onto is None:
        left = 2 if normal is None else int(abs(normal).argmax())
        return tuple(i for i in range(3) if i != left)  # type: ignore[return-value]
    for name in options.onto:
        if name not in AXES or len(options.onto) > 2:
            raise UsageError(f"--onto: {name!r} is none; with --point give two of x, y and z")
    return AXES.index(options.onto[0]), AXES.index(options.onto[1])


def _drawn(
    options: argparse.Namespace,
    case: tuple[str, str],
    rows: list[tuple[str, str]],
    notes: list[tuple[str, str]],
    draw: Callable[[str], None],
) -> CommandAnswer:
    from nag.text.table import sheet

    write_picture(options.out, draw, "out")
    tail = [*notes, ("picture", options.out), run_row(options)]
    return CommandAnswer(sheet(case[0], [*rows, *tail]), not notes)
