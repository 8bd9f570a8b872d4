"""The command ``nag show``: what a file holds, and what can be asked of it."""

from __future__ import annotations

import argparse
import os
from collections import Counter
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    add_json,
    add_quiet,
    add_reading,
    is_json,
    read_given_case,
    refuse_reading,
)
from nag.cli.running import CommandAnswer, document_head, name_case

if TYPE_CHECKING:
    from nag.decomposition.singular_members import SingularParameters
    from nag.decomposition.singular_points import SingularLocus
    from nag.files.cases import Case, Truth
    from nag.text.table import Row
    from nag.witness.sampling import Samples
    from nag.witness.witness import Decomposition

# What each command answers, by the kind of what it is asked of: all that this can be asked.
OF_COMPONENTS = (
    ("member", "which components does a point lie on? (--at POINT)"),
    ("sample", "which random points does a component have? (--component K; --real)"),
    ("singular", "where is it singular, and where do components meet?"),
    ("intersect", "where do two components meet? (--components I J)"),
    ("eliminate", "which exact equations does a component have? (--component K)"),
)
LOCAL = ("local", "which dimension have the solutions at a point? (--at POINT)")
QUESTIONS = {
    "system": (
        ("solve", "which isolated solutions are there?"),
        ("decompose", "which curves, surfaces and points make up the solution set?"),
        LOCAL,
        ("family", "which solutions for many values of parameters? (--values TABLE)"),
        ("plot", "draw its real curves (--onto X,Y --out FILE), or what lies on what (--tree)"),
        ("model", "what are the equations?"),
    ),
    "mechanism": (
        ("mobility", "does it move, and with how many freedoms?"),
        ("decompose", "which motions are there in all?"),
        ("motion", "how does it really move? (one freedom; --html FILE shows it)"),
        ("solve", "which positions are there that stand alone? (of what is rigid)"),
        ("report", "write what is found to one page (--html FILE)"),
        ("plot", "draw bodies and joints: --graph --out FILE.svg"),
        ("model", "which equations, and in which formulations?"),
        LOCAL,
    ),
    "components": (
        *OF_COMPONENTS,
        ("plot", "draw its real curves (--onto X,Y --out FILE), or what lies on what (--tree)"),
        ("certify", "are its points proved?"),
    ),
    "solutions": (("certify", "are its solutions proved?"),),
}
LEGS = ("modes", "which operation modes has the platform of a parallel robot?")
PAPERS = ("check", "are the statements of the papers about it true?")
# Of a linkage with a pin that joins nothing.
PATH = ("eliminate", "what is the equation of the curve that {pin} draws? (--onto x_{pin},y_{pin})")
# Of an open chain, as an arm is, the last body stands for the hand.
HAND = (
    ("motion", "which postures reach a pose? (inverse kinematics; --pose {hand}=X,Y,Z)"),
    ("mobility", "does it move with its hand held? (--hold {hand})"),
)
Questions = tuple[tuple[str, str], ...]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag show``."""
    parser.add_argument(
        "case",
        metavar="FILE",
        help="case file, system in another program's format, or what a command wrote with --json",
    )
    add_reading(parser)
    add_json(parser)
    add_quiet(parser)


def run(options: argparse.Namespace) -> CommandAnswer:
    """What a file holds."""
    from nag.text.table import sheet

    case, kind, title, blocks, asked = _describe(options)
    document = document_head("nag-contents", case) | {
        "kind": kind,
        "title": title,
        "said": [_said(part) for block in blocks for part in block],
        "questions": [
            {"about": about, "command": command, "question": text}
            for about, questions in asked.items()
            for command, text in questions
        ],
    }
    if not asked:
        return CommandAnswer(sheet(title, *blocks), document=lambda: document)
    width = max(len(f"nag {name}") for questions in asked.values() for name, _ in questions)
    name = os.path.relpath(options.case) if os.path.isabs(options.case) else options.case
    for heading, questions in asked.items():
        blocks += [
            [f"{heading}: nag COMMAND {name}"],
            [(f"nag {command}", text) for command, text in questions],
        ]
    return CommandAnswer(sheet(title, *blocks, width=width), document=lambda: document)


def _said(part: str | Row) -> dict[str, str]:
    """A line as an object of JSON, with an empty label if it has none."""
    label, text = ("", part) if isinstance(part, str) else part
    return {"label": label, "text": text}


def _describe(
    options: argparse.Namespace,
) -> tuple[tuple[str, str] | None, str, str, list[list[str] | list[Row]], dict[str, Questions]]:
    """Case, kind, title, what is said below it, and what can be asked, by headings.

    The case is that which a file is or is of, if any; the kind is that of a case, or the format of
    what a command wrote.
    """
    path = options.case
    if not is_json(path):
        case = read_given_case(options)
        return name_case(case), case.kind, *_describe_case(case)
    refuse_reading(options)
    of, kind = _origin(path)
    return of, kind, *_describe_export(path)


def _describe_export(
    path: str,
) -> tuple[str, list[list[str] | list[Row]], dict[str, Questions]]:
    """Title, what is said below it, and what can be asked, by headings, of what was written."""
    from nag.questions import read
    from nag.solving.solutions import SolveResult
    from nag.witness.witness import Decomposition

    found = read(path)
    title = os.path.basename(path)
    if isinstance(found, Decomposition):
        blocks = [_origin_rows(path), *_describe_components(found)]
        return title, blocks, {"ask": QUESTIONS["components"]}
    if isinstance(found, dict):
        return title, [_describe_answer(found)], {}
    if not isinstance(found, SolveResult):
        return title, [_origin_rows(path), *_describe_points(found)], {}
    from nag.report.solutions import solution_table

    blocks = [str(found).splitlines(), solution_table(found)]
    return title, blocks, {"ask": QUESTIONS["solutions"]}


def _describe_answer(document: dict[str, Any]) -> list[Row]:
    """What another command wrote: of what, whether it is whole, and how much of what there is."""
    from nag.files.json_schema import schema

    case = document.get("case")
    published = schema(document["format"], document["version"])
    about = published.get("description", "").partition(". Numbers")[0].partition(". Readers")[0]
    if about.startswith("Readers"):
        about = published["title"]
    rows: list[Row] = [("holds", f"{document['format']}: {about.rstrip('.')}")]
    if case:
        rows.append(("of", f"{case['title']} ({case['file']})"))
    if "all_proved" in document:
        rows.append(("proved", "all points" if document["all_proved"] else "NOT all points"))
        complete = document["complete"]
        rows.append(("complete", "proved" if complete else "not proved"))
    elif "complete" in document:
        rows.append(("answer", "complete" if document["complete"] else "INCOMPLETE"))
    if isinstance(document.get("arrays"), str):
        rows.append(("solutions", f"in the arrays of {document['arrays']}"))
    if document.get("meaning"):
        rows.append(("meaning", document["meaning"]))
    rows += [
        (name, str(len(value)))
        for name, value in document.items()
        if isinstance(value, list) and value and isinstance(value[0], dict)
    ]
    notes = [*document.get("notes", ()), *filter(None, [document.get("open")])]
    return [*rows, *(("open", note) for note in notes)]


def _origin(path: str) -> tuple[tuple[str, str] | None, str]:
    """The case that an export is of, if that is known, and the export's format."""
    from nag.files.json_values import read_file

    document = read_file(path, dict)
    case = document.get("case")
    of = (case["title"], case["file"]) if case else None
    return of, document.get("format", "")


def _origin_rows(path: str) -> list[Row]:
    """Of which case, model and component an export is, where that is known."""
    from nag.files.json_values import read_file

    document = read_file(path, dict)
    case, component = document.get("case"), document.get("component")
    rows = [("of", f"{case['title']} ({case['file']})")] if case else []
    if document.get("formulation") and document.get("reason"):
        rows.append(("model", f"formulation {document['formulation']}: {document['reason']}"))
    if component:
        size = f"dimension {component['dimension']}, degree {component['degree']}"
        rows.append(("component", f"{component['number']}: {size}, {component['status']}"))
    return rows


def _describe_points(
    found: Samples | SingularLocus | SingularParameters,
) -> list[list[str] | list[Row]]:
    """Samples with their table, singular points each with what it is, and conditions for them."""
    from nag.text.table import align
    from nag.witness.sampling import Samples

    lines = str(found).splitlines()
    if isinstance(found, Samples):
        return [lines, align(found.rows(found.variables)) if len(found) else []]
    if not hasattr(found, "examined"):
        return [lines]
    return [lines, *(one.rows(found.variables) for one in found.sets)]


def _describe_components(found: Decomposition) -> list[list[str] | list[Row]]:
    from nag.witness.shown import component_table, remarks

    notes = [("open", line) for line in remarks(found)]
    return [str(found).splitlines(), component_table(found), notes]


def _describe_case(
    case: Case,
) -> tuple[str, list[list[str] | list[Row]], dict[str, Questions]]:
    from nag.algebra.system import system_line, values_text

    rows: list[Row] = [("kind", case.kind)]
    if case.mechanism is not None:
        rows += [("", line) for line in str(case.mechanism).splitlines()]
    elif case.system is not None:
        rows.append(("system", system_line(case.system)))
    if case.parameters:
        rows.append(("set", f"{values_text(case.parameters, case.parameters.values())}: --set"))
    if case.unset:
        rows.append(("unset", f"parameters without a value, {', '.join(case.unset)}: --set"))
    if case.points:
        rows.append(("points", ", ".join(point.name for point in case.points)))
    rows += [("known", _known_text(t)) for t in case.truth]
    rows += case.note_rows
    return case.title, [rows], _asked_of_case(case)


def _known_text(known: Truth) -> str:
    """What a case says is known, in the coordinates of which formulation, and from where."""
    from nag.witness.shown import ComponentKind

    kind = ComponentKind(known.dimension, known.degree, known.multiplicity).text(known.count)
    where = f"in formulation {known.formulation}: " if known.formulation else ""
    source = known.source.strip()
    return f"{where}{kind}{f' ({source})' if source else ''}"


def _asked_of_case(case: Case) -> dict[str, Questions]:
    """All that can be asked of a case, by headings."""
    from nag.mechanism.loops import has_loops

    mechanism = case.mechanism
    if mechanism is not None and not has_loops(mechanism):
        hand = mechanism.body_names[-1]
        held = os.path.splitext(case.path)[1] != ".toml"
        questions = tuple((name, text.format(hand=hand)) for name, text in HAND[: 1 + held])
        return {"ask": (QUESTIONS["mechanism"][0], *questions)}
    moving = mechanism is not None or case.assembly is not None
    questions = QUESTIONS["mechanism" if moving else "system"]
    if mechanism is not None and _is_robot(case):
        questions = (*questions, LEGS)
    if _is_of_papers(case):
        questions = (*questions, PAPERS)
    pin = _drawing_pin(case)
    if pin:
        questions = (*questions, (PATH[0], PATH[1].format(pin=pin)))
    return {"ask": questions, "ask of its components, which are found first": OF_COMPONENTS}


def _drawing_pin(case: Case) -> str:
    """A pin of a moving link that joins nothing, as a coupler point; empty if there is none."""
    from nag.mechanism.linkage import LinkageModel

    if not isinstance(case.assembly, LinkageModel):
        return ""
    joined = Counter(pin for link in case.assembly.in_loops for pin in link.pins)
    moving = case.assembly.in_loops[1:]
    return next((p for link in moving for p in link.pins if joined[p] == 1), "")


def _is_of_papers(case: Case) -> bool:
    """Whether the founding papers speak of it."""
    from nag.check.subjects import recognised
    from nag.decomposition.decompose import decompose

    return recognised(case, decompose) is not None


def _is_robot(case: Case) -> bool:
    """Whether the mechanism has a body of several legs."""
    from nag.errors import NagError
    from nag.mechanism.legs import parallel_robot

    try:
        parallel_robot(case.mechanism)  # type: ignore[arg-type]
    except NagError:
        return False
    return True
