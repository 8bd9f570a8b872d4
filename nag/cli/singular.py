"""The command ``nag singular``: singular points of components, and where components meet."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import UsageError, add_running
from nag.cli.running import as_chosen, compilation_notice, run_row
from nag.cli.witness_input import (
    Given,
    add_input,
    component_number,
    component_of,
    doubts,
    given,
    head,
    is_export,
    like,
    with_tested_traces,
    write_document,
)

if TYPE_CHECKING:
    from nag.decomposition.singular_points import SingularLocus

FORMAT = "nag-singular"
PARAMETERS_FORMAT = "nag-singular-parameters"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag singular`` has besides those of every command that runs a case."""
    add_input(parser)
    add_running(parser)
    parser.add_argument(
        "--component",
        type=component_number,
        metavar="N",
        help="only singular points of this component, in the order of the export",
    )
    parser.add_argument(
        "--free",
        metavar="NAMES",
        help="parameters of the case, 'L1, L2, L3': for which values are there singular points?",
    )


def run(options: argparse.Namespace) -> tuple[list[str], bool]:
    """Find singular points and write the export; returns the lines to print and whether all is
    known.

    Raises:
        UsageError: for bad input, or an export that cannot be written.
    """
    if options.free is not None:
        return _for_parameters(options)
    with compilation_notice(sys.stderr, options.quiet):
        from nag.decomposition.singular_points import singular_locus

        found = given(options)
        if options.component is not None:
            component_of(found, options.component, "--component")
        found = with_tested_traces(found)
        locus = singular_locus(
            found.decomposition,
            only=None if options.component is None else [options.component - 1],
            **as_chosen(options),
        )
    complete = locus.complete and found.decomposition.complete
    if options.json is not None:
        write_document(_document(found, locus, options, complete), options.json)
    return _lines(found, locus, options), complete


def _document(
    found: Given, locus: SingularLocus, options: argparse.Namespace, complete: bool
) -> dict[str, Any]:
    from nag.files.answers_at_points import singular_document

    components = found.decomposition.components
    return head(found, FORMAT, options) | {
        "complete": complete,
        "notes": list(locus.notes),
        "variables": list(found.decomposition.system.variables),
        "components": [{"number": i + 1, **like(c)} for i, c in enumerate(components)],
        **singular_document(locus, found.decomposition.system.variables),
    }


def _lines(found: Given, locus: SingularLocus, options: argparse.Namespace) -> list[str]:
    from nag.report.singular import answer_rows, set_lines
    from nag.text.table import labelled, printable
    from nag.witness.shown import paths_text

    decomposition = found.decomposition
    top = answer_rows(locus, decomposition)
    tail = [("open", note) for note in locus.notes] + doubts(found)
    tail.append(("paths", paths_text(locus.paths)))
    tail.append(run_row(options))
    width = max(len(label) for label, _ in top + tail)
    lines = [printable(found.title), "", *labelled(top, width), ""]
    for one in locus.sets:
        rows = set_lines(one, decomposition.system.variables)
        lines += [*labelled([(a, printable(b)) for a, b in rows], width), ""]
    return [*lines, *labelled([(a, printable(b)) for a, b in tail], width)]


def _for_parameters(options: argparse.Namespace) -> tuple[list[str], bool]:
    """For which parameters there are singular points: they are solved for as well; as `run`."""
    from nag.files.case_table import CaseError
    from nag.files.cases import read_case
    from nag.files.problem import freed_system
    from nag.report.singular import parameter_rows
    from nag.text.table import labelled, printable
    from nag.witness.shown import paths_text

    if is_export(options.case) or options.component is not None:
        raise UsageError("--free: needs a case file, and no --component")
    names = [name.strip() for name in options.free.split(",")]
    if len(set(names)) < len(names) or not all(names):
        raise UsageError("--free: write names of parameters, each once: 'L1, L2'")
    for name, _ in options.set:
        if name in names:
            raise UsageError(f"--set {name}: is an unknown by --free; give it no value")
    try:
        system = freed_system(options.case, names, dict(options.set))
    except CaseError as error:
        raise UsageError(str(error)) from None
    except OSError as error:
        raise UsageError(f"{options.case}: {error.strerror or error}") from None
    with compilation_notice(sys.stderr, options.quiet):
        from nag.decomposition.singular_members import singular_parameters

        try:
            found = singular_parameters(system, len(names), **as_chosen(options))
        except ValueError as reason:
            raise UsageError(f"{options.case}: --free: {reason}") from None
    title = read_case(options.case).title
    if options.json is not None:
        document = {
            "format": PARAMETERS_FORMAT,
            "version": 1,
            "case": {"title": title, "file": Path(options.case).name},
            "seed": options.seed,
            "settings": options.settings,
            "complete": found.complete,
            "proved": found.proved,
            "notes": list(found.notes),
            "parameters": names,
            "conditions": [[f.text(names) for f in each] for each in found.conditions],
            "sets": [
                {"dimension": each.dimension, "degree": each.degree, "proof": each.proof}
                for each in found.sets
            ],
        }
        write_document(document, options.json)
    rows = parameter_rows(found)
    rows.append(("paths", paths_text(found.paths)))
    rows.append(run_row(options))
    body = labelled([(label, printable(text)) for label, text in rows])
    return [printable(title), "", *body], found.complete
