"""The command ``nag singular``: singular points of components, and where components meet."""

from __future__ import annotations

import argparse

from nag.cli.arguments import UsageError, read_case_file
from nag.cli.running import CommandAnswer, answer_of, chosen_run, name_case
from nag.cli.witness_input import (
    add_component,
    add_input,
    component_of,
    doubt_rows,
    is_export,
    read_components,
    with_tested_traces,
)

FORMAT = "nag-singular"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag singular`` has besides those of every command that runs a case."""
    add_input(parser)
    add_component(parser, "only singular points of this component, in the order of the export")
    parser.add_argument(
        "--free",
        metavar="NAMES",
        help="parameters of the case, 'L1, L2, L3': for which values are there singular points?",
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """Singular points of components, or the parameters for which there are any."""
    if options.free is not None:
        return _for_parameters(options)
    from nag.decomposition.singular_points import singular_locus
    from nag.witness.shown import paths_text

    found = read_components(options)
    if options.component is not None:
        component_of(found, options.component, "--component")
    found = with_tested_traces(found)
    whole = found.decomposition
    variables = whole.system.variables
    locus = singular_locus(
        whole,
        only=None if options.component is None else [options.component - 1],
        run=chosen_run(options),
    )
    fields = {
        "format": FORMAT,
        "notes": list(locus.notes),
        "variables": list(variables),
        "components": [c.facts(i) for i, c in enumerate(whole.components, 1)],
        **locus.document(variables),
    }
    blocks = [locus.rows(len(whole.components)), *(one.rows(variables) for one in locus.sets)]
    tail = [("open", note) for note in locus.notes] + doubt_rows(found)
    tail.append(("paths", paths_text(locus.paths)))
    return answer_of(options, found.case, blocks, tail, fields, locus.complete and whole.complete)


def _for_parameters(options: argparse.Namespace) -> CommandAnswer:
    """For which parameters there are singular points: they are solved for as well."""
    from nag.decomposition.singular_members import singular_parameters
    from nag.files.cases import freed_system
    from nag.witness.shown import paths_text

    if is_export(options.case) or options.component is not None:
        raise UsageError("--free: needs a case file, and no --component")
    names = [name.strip() for name in options.free.split(",")]
    if len(set(names)) < len(names) or not all(names):
        raise UsageError("--free: write names of parameters, each once: 'L1, L2'")
    for name, _ in options.set:
        if name in names:
            raise UsageError(f"--set {name}: is an unknown by --free; give it no value")
    case = read_case_file(options.case, options.set)
    system = freed_system(case, names)
    if system.imaginary:
        raise UsageError(f"{options.case}: --free: is for cases with real coefficients")
    try:
        found = singular_parameters(system, len(names), run=chosen_run(options))
    except ValueError as reason:
        raise UsageError(f"{options.case}: --free: {reason}") from None
    rows = [*found.rows(), ("paths", paths_text(found.paths))]
    return answer_of(options, name_case(case), (), rows, found.document(), found.complete)
