"""All that is found of a mechanism, in one page: how it moves, all components, what is open."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

from nag.decomposition.through import note_doubts, through_points
from nag.errors import NagError
from nag.files.cases import Case
from nag.files.export import Origin
from nag.kinematics.motion import motion
from nag.mechanism.mobility_at import mobility
from nag.mechanism.mobility_report import MobilityReport
from nag.mechanism.problem import Problem
from nag.numerics.read_only import equal_values
from nag.page.motion_page import motion_page
from nag.page.report_page import Section, report_page
from nag.report.agreement import agreement_text, compare
from nag.report.answer import model_lines
from nag.report.model import model_rows
from nag.text.json_text import lay_out
from nag.text.table import html_table, lines_of, one_line
from nag.tracking.run import Run
from nag.witness.shown import component_rows, remarks, title_line
from nag.witness.witness import Decomposition


@dataclass(frozen=True, eq=False)
class MechanismReport:
    """What was found of a mechanism, and the page that says it.

    Attributes:
        title: of the case.
        decomposition: the components.
        mobility: how it moves at its reference, or in general; None where that is not seen.
        unmoved: why it does not move in the page; empty if it does.
        complete: whether nothing was left open.
        page: HTML that needs no network.
    """

    title: str
    decomposition: Decomposition
    mobility: MobilityReport | None
    unmoved: str
    complete: bool
    page: str

    __eq__ = equal_values

    @property
    def lead(self) -> str:
        """The answer in a sentence."""
        return title_line(self.decomposition) if self.mobility is None else self.mobility.sentence

    def rows(self) -> list[tuple[str, str]]:
        """What was found, as labelled texts."""
        return [
            ("mobility", self.lead),
            ("answer", title_line(self.decomposition)),
            ("motion", self.unmoved or "moves in the page"),
        ]

    __repr__ = one_line

    def __str__(self) -> str:
        return lines_of(f"MechanismReport of {self.title}", self.rows())


def report_of(case: Case, problem: Problem, run: Run) -> MechanismReport:
    """Find the components and the motion of a mechanism, and make the page.

    Args:
        case: what it is called, and what is known of it.
        problem: its model.
        run: whose ``found`` is told of the components.
    """
    decomposition = problem.decompose(run=run)
    points = through_points(decomposition, problem.named, run.threads)
    decomposition = note_doubts(decomposition, points)
    run = run.without_found
    try:
        moves: MobilityReport | None = mobility(problem, run=run)
    except NagError:
        moves = None
    file = os.path.basename(case.path)
    try:
        moving, unmoved = motion_page(motion(problem, run=run), case.title, file), ""
    except NagError as error:
        moving, unmoved = "", str(error)
    complete = decomposition.complete and (moves is None or not moves.open)
    lead = title_line(decomposition) if moves is None else moves.sentence
    page = report_page(
        case.title,
        f"{lead[:1].upper()}{lead[1:]}.",
        complete,
        moving,
        _sections(case, problem, decomposition, moves, unmoved),
        lay_out(decomposition.document(**Origin.of(case, problem).head)) + "\n",
        file.removesuffix(".toml"),
        f"seed {decomposition.seed}, settings {decomposition.settings}",
    )
    return MechanismReport(case.title, decomposition, moves, unmoved, complete, page)


def _sections(
    case: Case,
    problem: Problem,
    decomposition: Decomposition,
    moves: MobilityReport | None,
    unmoved: str,
) -> Sequence[Section]:
    """What is said below the picture."""
    found = []
    if moves is not None:
        found.append(Section("How it moves", moves.rows()))
    if unmoved:
        found.append(Section("No picture", [("because", unmoved)]))
    found.append(Section("The model, and why this one", [*case.note_rows, *model_rows(problem)]))
    table = html_table(title_line(decomposition), component_rows(decomposition))
    found.append(Section("All components", table))
    notes = [("open", line) for line in remarks(decomposition)]
    agreement = compare(decomposition, case.truth, problem.formulation)
    if agreement is not None:
        notes.append(("known", agreement_text(agreement)))
    if notes:
        found.append(Section("What it was compared with, and what is open", notes))
    found.append(Section("Equations", model_lines(case, problem)[2:]))
    return found
