"""The command ``nag report``: all that is found of a mechanism, in one page."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import UsageError, add_case, add_running, read_problem
from nag.cli.running import CommandAnswer, chosen_run, run_row, write_document
from nag.errors import NagError

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.mechanism.mobility_report import MobilityReport
    from nag.mechanism.problem import Problem
    from nag.page.report_page import Section
    from nag.witness.witness import Decomposition

BYTES_IN_A_MEGABYTE = 1_000_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag report`` has besides those of every command that runs a case."""
    add_case(parser)
    add_running(parser)
    parser.add_argument(
        "--html",
        metavar="FILE",
        required=True,
        help="write the page to FILE; it needs no network",
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """All that is found of a mechanism, in one page."""
    case, problem = read_problem(options)
    if problem.model is None:
        raise UsageError(f"{options.case}: is a polynomial system; reports are of mechanisms")
    from nag.decomposition.through import note_doubts, through_points
    from nag.files.export import Origin
    from nag.page.report_page import report_page
    from nag.text.json_text import lay_out
    from nag.text.table import sheet
    from nag.witness.shown import title_line

    head = Origin.of(case, problem).head

    def document_of(early: Decomposition) -> dict[str, Any] | None:
        return early.document(**head) if early.system == problem.system else None

    decomposition = problem.decompose(run=chosen_run(options, document_of))
    points = through_points(decomposition, problem.named, options.threads)
    decomposition = note_doubts(decomposition, points)
    mobility = _mobility(options, problem)
    moving, why_not = _motion(options, case, problem)
    answer = title_line(decomposition)
    lead = answer if mobility is None else mobility.sentence
    complete = decomposition.complete and (mobility is None or not mobility.open)
    page = report_page(
        case.title,
        f"{lead[:1].upper()}{lead[1:]}.",
        complete,
        moving,
        _sections(case, problem, decomposition, mobility, why_not),
        lay_out(decomposition.document(**head)) + "\n",
        os.path.basename(case.path).removesuffix(".toml"),
        f"seed {options.seed}, settings {options.settings}",
    )
    write_document(page, options.html, "html")
    rows = [
        ("mobility", lead),
        ("answer", answer),
        ("motion", why_not or "moves in the page"),
        ("page", f"{options.html}, {len(page.encode()) / BYTES_IN_A_MEGABYTE:.2f} MB"),
    ]
    return CommandAnswer(
        sheet(case.title, rows, [run_row(options)]),
        complete,
        lambda: decomposition.document(**head),
    )


def _mobility(options: argparse.Namespace, problem: Problem) -> MobilityReport | None:
    """How it moves at its reference, or in general; None where that is not seen."""
    from nag.mechanism.mobility_at import mobility

    try:
        return mobility(problem, run=chosen_run(options))
    except NagError:
        return None


def _motion(options: argparse.Namespace, case: Case, problem: Problem) -> tuple[str, str]:
    """The page in which it moves, or why there is none."""
    from nag.kinematics.motion import motion
    from nag.page.motion_page import motion_page

    try:
        found = motion(problem, run=chosen_run(options))
        return motion_page(found, case.title, os.path.basename(case.path)), ""
    except NagError as error:
        return "", str(error)


def _sections(
    case: Case,
    problem: Problem,
    decomposition: Decomposition,
    mobility: MobilityReport | None,
    why_not: str,
) -> list[Section]:
    """What is said below the picture."""
    from nag.page.report_page import Section
    from nag.report.agreement import agreement_text, compare
    from nag.report.answer import model_lines
    from nag.report.model import model_rows
    from nag.text.table import html_table
    from nag.witness.shown import component_rows, remarks, title_line

    found = []
    if mobility is not None:
        found.append(Section("How it moves", mobility.rows()))
    if why_not:
        found.append(Section("No picture", [("because", why_not)]))
    found.append(Section("The model, and why this one", [*case.note_rows, *model_rows(problem)]))
    found.append(
        Section(
            "All components", html_table(title_line(decomposition), component_rows(decomposition))
        )
    )
    notes = [("open", line) for line in remarks(decomposition)]
    agreement = compare(decomposition, case.truth, problem.formulation)
    if agreement is not None:
        notes.append(("known", agreement_text(agreement)))
    if notes:
        found.append(Section("What it was compared with, and what is open", notes))
    found.append(Section("Equations", model_lines(case, problem)[2:]))
    return found
