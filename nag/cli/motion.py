"""The command ``nag motion``: how a mechanism of one freedom really moves."""

from __future__ import annotations

import argparse
import math
import os
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    UsageError,
    add_case,
    add_running,
    problem_of_case,
    read_case_file,
    whole,
)
from nag.cli.running import CommandAnswer, answer_of, chosen_run, name_case, write_document
from nag.errors import NagError

if TYPE_CHECKING:
    from nag.kinematics.motion import Motion
    from nag.mechanism.problem import Problem

FORMAT = "nag-motion"
MOST_SAMPLES = 100_000
MOST_CIRCUITS = 100_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag motion`` has besides those of every command that runs a case."""
    add_case(parser)
    add_running(parser)
    parser.add_argument(
        "--circuit",
        type=_circuit,
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
        metavar="JOINT=VALUE",
        help="all assemblies on the circuits in which a joint's angle, in degrees, or slide has "
        "this value; of all circuits, if none is asked for",
    )
    parser.add_argument(
        "--csv",
        metavar="FILE",
        help="write a table to FILE: a line for each sample of each circuit, with the joints' "
        "angles and slides and all bodies' places and unit quaternions",
    )
    parser.add_argument(
        "--html",
        metavar="FILE",
        help="write a page to FILE in which the mechanism moves; it needs no network",
    )


def _drive(text: str) -> tuple[str, Fraction]:
    name, equals, value = text.rpartition("=")
    try:
        number = Fraction(value.strip())
    except (ValueError, ZeroDivisionError):
        number = None
    if not equals or not name.strip() or number is None:
        raise argparse.ArgumentTypeError(
            f"{text[:40]!r} is not of the form JOINT=VALUE, a number like 30 or 45/2"
        )
    return name.strip(), number


def _circuit(text: str) -> str | int:
    if text in ("reference", "all"):
        return text
    try:
        return whole(text, 1, MOST_CIRCUITS)
    except argparse.ArgumentTypeError:
        raise argparse.ArgumentTypeError(
            f"{text[:30]!r} is none; write reference, all, or a circuit's number"
        ) from None


def run(options: argparse.Namespace) -> CommandAnswer:
    """How a mechanism of one freedom really moves."""
    case = read_case_file(options.case, options.set)
    if case.kind == "system":
        raise UsageError(f"{options.case}: is a polynomial system; only mechanisms have a motion")
    from nag.kinematics.motion import motion
    from nag.kinematics.shown import (
        assembly_rows,
        circuit_rows,
        circuit_text,
        crossing_text,
        drive_text,
        motion_rows,
    )

    problem = problem_of_case(case, options.formulation or "auto")
    asked = options.circuit or ("reference" if options.drive is None else "all")
    which = asked if isinstance(asked, str) else "all"
    try:
        found = motion(
            problem,
            circuit=which,
            samples=options.samples,
            drive=None if options.drive is None else _in_radians(problem, *options.drive),
            run=chosen_run(options),
        )
        if isinstance(asked, int):
            own = tuple(a for a in found.assemblies if a.circuit == asked)
            found = replace(found, circuits=(found.circuit(asked),), assemblies=own)
    except NagError as error:
        raise UsageError(f"{options.case}: {error}") from None
    if options.csv is not None:
        write_document(_table_text(found, options.angles), options.csv, "csv")
    tail = [("open", note) for note in found.notes]
    if options.html is not None and not found.circuits:
        tail.append(("page", f"{options.html} is not written: there is no motion to show"))
    elif options.html is not None:
        from nag.page.motion_page import motion_page

        try:
            page = motion_page(found, case.title, os.path.basename(case.path))
        except NagError as error:
            raise UsageError(f"{options.case}: {error}") from None
        write_document(page, options.html, "html")
    blocks: list[Any] = [motion_rows(found)]
    for each in found.circuits:
        head = [(f"circuit {each.number}", circuit_text(found, each))]
        head += [("crossing", crossing_text(found, each, c)) for c in each.crossings]
        blocks += [head, circuit_rows(found, each)]
    if found.drive is not None:
        blocks.append([("driven", drive_text(found))])
        blocks.append(assembly_rows(found) if found.assemblies else [])
    fields = {
        "format": FORMAT,
        "formulation": problem.formulation,
        "samples": options.samples,
        **found.document(),
    }
    return answer_of(options, name_case(case), blocks, tail, fields, found.complete)


def _in_radians(problem: Problem, name: str, value: Fraction) -> tuple[str, float]:
    """What is to be held, angles in radians."""
    from nag.kinematics.joint_values import joint_coordinates
    from nag.kinematics.scene import scene_of
    from nag.mechanism.problem import in_real_coordinates

    each = joint_coordinates(scene_of(in_real_coordinates(problem)))
    angle = any(c.name == name and c.kind == "angle" for c in each)
    return name, math.radians(value) if angle else float(value)


def _table_text(found: Motion, angles: str) -> str:
    """All circuits as lines of numbers that read back to the same doubles."""
    import csv
    import io

    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for i, circuit in enumerate(found.circuits):
        columns = found.table(circuit.number, angles=angles)
        if not i:
            writer.writerow(columns)
        rows = zip(*(column.tolist() for column in columns.values()), strict=True)
        writer.writerows(rows)
    return text.getvalue()
