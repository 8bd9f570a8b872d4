"""The command ``nag motion``: how a mechanism of one freedom really moves."""

from __future__ import annotations

import argparse
import math
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    UsageError,
    add_case,
    add_running,
    error_in_file,
    parse_circuit,
    problem_of_case,
    read_given_case,
    whole,
)
from nag.cli.running import (
    STANDARD_OUTPUT,
    CommandAnswer,
    answer_document,
    answer_of,
    chosen_run,
    name_case,
    write_document,
)
from nag.errors import NagError
from nag.kinematics import CLOSE_A_LOOP, HOLD_FARTHER, MOST_VALUES

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.kinematics.driven_motion import DrivenMotion
    from nag.kinematics.motion import Motion
    from nag.mechanism.problem import Problem

MOST_SAMPLES = 100_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag motion`` has besides those of every command that runs a case."""
    add_case(parser)
    add_running(parser)
    parser.add_argument(
        "--circuit",
        type=parse_circuit,
        metavar="WHICH",
        help="'reference' for the motions through the reference configuration, 'all' for those of "
        "all components of dimension one, or the number that one of these has (default: "
        "reference; all where no configuration is given)",
    )
    parser.add_argument(
        "--samples",
        type=lambda text: whole(text, 12, MOST_SAMPLES),
        default=360,
        metavar="N",
        help="into how many even steps each circuit is divided (default: 360)",
    )
    parser.add_argument(
        "--angles",
        choices=("degrees", "radians"),
        default="degrees",
        help="what angles are written in, in --csv (default: degrees); --json has radians",
    )
    parser.add_argument(
        "--drive",
        type=_drive,
        action="append",
        metavar="JOINT=VALUE",
        help="hold a joint's angle, in degrees, or slide at a value: of one freedom, all "
        "assemblies on the circuits with it (all circuits, if none is asked for); of more, the "
        "circuits of what is left, or its assemblies; may be repeated; of one joint, "
        "JOINT=FIRST:LAST:COUNT drives it through so many values",
    )
    parser.add_argument(
        "--pose",
        type=_pose,
        action="append",
        metavar="BODY[@JOINT]=X,Y,Z[,Q0,Q1,Q2,Q3]",
        help="hold a body: BODY=X,Y,Z so far from where it is drawn (or --at puts it), as --csv "
        "writes it; BODY@JOINT=X,Y,Z with the point of that joint at this place. With a quaternion "
        "or turned as it is drawn: all assemblies of an arm with its hand there; may be repeated",
    )
    parser.add_argument(
        "--csv",
        metavar="FILE",
        help="write a table to FILE: a line for each sample of each circuit, with the joints' "
        "angles and slides and all bodies' places and unit quaternions; of a joint J with several "
        "J.angle, J.slide (cylindrical), J.first, J.second (universal), J.angle, J.x, J.y (planar)",
    )
    parser.add_argument(
        "--html",
        metavar="FILE",
        help="write a page to FILE in which the mechanism moves; it needs no network",
    )


@dataclass(frozen=True)
class _Drive:
    """A joint, and the values that it is held at, one after another."""

    name: str
    values: tuple[Fraction, ...]


def _drive(text: str) -> _Drive:
    name, equals, value = text.rpartition("=")
    parts = value.split(":")
    try:
        numbers = [Fraction(part.strip()) for part in parts[:2]]
        _ = [float(x) for x in numbers]
    except (ValueError, ZeroDivisionError, OverflowError):
        numbers = []
    if not equals or not name.strip() or not numbers or len(parts) not in (1, 3):
        raise argparse.ArgumentTypeError(
            f"{text[:40]!r} is not of the form JOINT=VALUE, a number like 30 or 45/2, or "
            "JOINT=FIRST:LAST:COUNT"
        )
    if len(parts) == 1:
        return _Drive(name.strip(), (numbers[0],))
    count = whole(parts[2], 2, MOST_VALUES)
    first, last = numbers
    values = tuple(first + (last - first) * i / (count - 1) for i in range(count))
    return _Drive(name.strip(), values)


def _pose(text: str) -> tuple[str, tuple[float, ...]]:
    name, equals, numbers = text.rpartition("=")
    try:
        values = tuple(float(Fraction(x.strip())) for x in numbers.split(","))
    except (ValueError, ZeroDivisionError, OverflowError):
        values = ()
    if not equals or not name.strip() or len(values) not in (3, 7):
        raise argparse.ArgumentTypeError(
            f"{text[:60]!r} is not of the form BODY=X,Y,Z or BODY=X,Y,Z,Q0,Q1,Q2,Q3"
        )
    return name.strip(), values


def run(options: argparse.Namespace) -> CommandAnswer:
    """How a mechanism of one freedom really moves."""
    case = read_given_case(options)
    if case.kind == "system":
        raise UsageError(f"{options.case}: is a polynomial system; only mechanisms have a motion")

    from nag.kinematics.driven import split_place, tie_placed_bodies

    for option, names in (
        ("--drive", [each.name for each in options.drive or ()]),
        ("--pose", [split_place(body)[0] for body, _ in options.pose or ()]),
    ):
        for i, name in enumerate(names):
            if name in names[:i]:
                raise UsageError(f"{option}: {name[:40]!r} is given twice; give it once")
    given = tie_placed_bodies(case, (split_place(body)[0] for body, _ in options.pose or ()))
    advice = HOLD_FARTHER if options.pose else f"{CLOSE_A_LOOP} (--pose BODY=X,Y,Z)"
    problem = problem_of_case(given, options.formulation or "auto", advice)
    drives = _with_radians(problem, options.drive or ())
    ranges = [each for each in drives if len(each[1]) > 1]
    if len(ranges) > 1:
        raise UsageError(f"{options.case}: --drive: one joint is driven through values, not more")
    held: dict[str, Any] = {
        "drive": {name: values[0] for name, values in drives if len(values) == 1},
        "pose": dict(options.pose or ()),
        "samples": options.samples,
    }
    from nag.kinematics.motion import StillError

    try:
        if ranges:
            return _run_through(options, case, problem, ranges[0], held)
        return _run_once(options, case, problem, held)
    except StillError as error:
        link = next(iter(options.hold), None)
        postures = f"; for its postures: --pose {link}=0,0,0 in place of --hold" if link else ""
        raise error_in_file(options.case, StillError(f"{error}{postures}")) from None
    except NagError as error:
        raise error_in_file(options.case, error) from None


def _run_once(
    options: argparse.Namespace, case: Case, problem: Problem, held: dict[str, Any]
) -> CommandAnswer:
    """The motions as they are, or with joints or bodies held."""
    from nag.kinematics.joint_values import joint_coordinates
    from nag.kinematics.motion import motion
    from nag.kinematics.shown import assembly_rows, drive_text, motion_rows

    def document_of(early: Motion) -> dict[str, Any]:
        return answer_document(options, name_case(case), _fields(options, problem, early), False)

    asked = options.circuit or ("reference" if not held["drive"] else "all")
    found = motion(problem, circuit=asked, **held, run=chosen_run(options, document_of))
    tail = [*case.note_rows, *(("open", note) for note in found.notes)]
    if options.csv is not None:
        tail.append(_write_table(options, found.whole_table(angles=options.angles)))
    if options.html is not None and found.circuits:
        from nag.page.motion_page import motion_page

        page = motion_page(found, case.title, os.path.basename(case.path))
        write_document(page, options.html, "html")
        tail.append(("page", options.html))
    elif options.html is not None:
        tail.append(_no_page(options.html, "nothing moves"))
    tail += _document_rows(options)
    blocks: list[Any] = [motion_rows(found), *_circuit_blocks(found)]
    if found.drive is not None or found.held or found.poses:
        driven = [("driven", drive_text(found))]
        if problem.reference is not None:
            driven.append(("angles", "count from the position in which it is drawn"))
        driven += _hand_rows(found)
        blocks.append(driven)
        blocks.append(assembly_rows(found) if found.assemblies else [])
    elif found.assemblies and joint_coordinates(found.scene):
        blocks += [_hand_rows(found), assembly_rows(found)]
    fields = _fields(options, problem, found)
    answer = answer_of(options, name_case(case), blocks, tail, fields, found.complete)
    return _with_page(answer, options, bool(found.circuits))


def _run_through(
    options: argparse.Namespace,
    case: Case,
    problem: Problem,
    drive: tuple[str, list[float]],
    held: dict[str, Any],
) -> CommandAnswer:
    """What is left of a motion with a joint at one value after another."""
    from nag.kinematics.driven_motion import driven_motion
    from nag.kinematics.shown import (
        continuation_rows,
        driven_assembly_rows,
        driven_rows,
        more_assemblies_text,
        motion_rows,
        throughout_rows,
    )

    if options.circuit is not None:
        raise UsageError("--circuit: leave it out where a joint is driven through values")

    def document_of(early: DrivenMotion) -> dict[str, Any]:
        return answer_document(options, name_case(case), _fields(options, problem, early), False)

    found = driven_motion(problem, *drive, **held, run=chosen_run(options, document_of))
    tail = case.note_rows
    tail += [("open", f"value {i + 1}: {note}") for i, m in enumerate(found) for note in m.notes]
    if options.csv is not None:
        tail.append(_write_table(options, found.table(angles=options.angles)))
    moving = any(each.moves for each in found.continuations)
    if options.html is not None and moving:
        from nag.page.motion_page import driven_page

        page = driven_page(found, case.title, os.path.basename(case.path))
        write_document(page, options.html, "html")
        tail.append(("page", options.html))
    elif options.html is not None:
        tail.append(_no_page(options.html, "at each value nothing moves"))
    tail += _document_rows(options)
    head = [
        row for row in motion_rows(found[0]) if row[0] in ("model", "mobility", "idle", "hanging")
    ]
    rows = [*continuation_rows(found), *throughout_rows(found)]
    assemblies = driven_assembly_rows(found)
    if assemblies:
        more = more_assemblies_text(found)
        rows += [("assemblies", f"{more}; --csv and --json have all")] if more else []
        rows += next((_hand_rows(each) for each in found if each.assemblies), [])
    blocks: list[Any] = [head, driven_rows(found), rows, assemblies]
    fields = _fields(options, problem, found)
    answer = answer_of(options, name_case(case), blocks, tail, fields, found.complete)
    return _with_page(answer, options, moving)


def _fields(
    options: argparse.Namespace, problem: Problem, found: Motion | DrivenMotion
) -> dict[str, Any]:
    """What the document says of motions below its head."""
    from nag.files.answer_export import fields_of

    how = {"formulation": problem.formulation, "samples": options.samples}
    return fields_of(found) | how


def _hand_rows(found: Motion) -> list[tuple[str, str]]:
    """What the columns of a table of assemblies are that tell where a body is."""
    from nag.kinematics.shown import hand_text

    text = hand_text(found) if found.assemblies else ""
    return [("places", text)] if text else []


def _write_table(options: argparse.Namespace, columns: Mapping[str, Any]) -> tuple[str, str]:
    """Write the file of ``--csv``, and name it; it has no row where there is nothing to list."""
    write_document(_table_text(columns), options.csv, "csv")
    empty = "" if len(columns["arc"]) else ", without rows: there is no assembly"
    return "table", f"{options.csv}{empty}"


def _document_rows(options: argparse.Namespace) -> list[tuple[str, str]]:
    """The file of ``--json``."""
    return [] if options.json in (None, STANDARD_OUTPUT) else [("json", options.json)]


def _no_page(path: str, why: str) -> tuple[str, str]:
    """What is said where a page is asked for and nothing can move in it."""
    return "page", f"{path} is not written: {why}, and pages show motions"


def _with_page(answer: CommandAnswer, options: argparse.Namespace, written: bool) -> CommandAnswer:
    """The answer, which is not all that was asked for where a page is missing."""
    missing = options.html is not None and not written
    return answer._replace(complete=answer.complete and not missing)


def _circuit_blocks(found: Motion) -> Iterator[Any]:
    """The circuits, each with its crossings and its table."""
    from nag.kinematics.shown import circuit_rows, circuit_text, crossing_text

    for each in found.circuits:
        head = [(f"circuit {each.number}", circuit_text(found, each))]
        head += [("crossing", crossing_text(found, each, c)) for c in each.crossings]
        yield head
        yield circuit_rows(found, each)


def _with_radians(problem: Problem, drives: Sequence[_Drive]) -> list[tuple[str, list[float]]]:
    """What is to be held, angles in radians."""
    from nag.kinematics.joint_values import joint_coordinates
    from nag.kinematics.scene import scene_of
    from nag.mechanism.problem import in_real_coordinates

    if not drives:
        return []
    coordinates = joint_coordinates(scene_of(in_real_coordinates(problem)))
    angles = {c.name for c in coordinates if c.kind == "angle"}
    return [
        (each.name, [math.radians(v) if each.name in angles else float(v) for v in each.values])
        for each in drives
    ]


def _table_text(columns: Mapping[str, Any]) -> str:
    """Columns as lines of numbers that read back to the same doubles."""
    import csv
    import io

    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*(column.tolist() for column in columns.values()), strict=True))
    return text.getvalue()
