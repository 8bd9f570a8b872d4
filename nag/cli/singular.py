"""The command ``nag singular``: singular points of components, and where components meet."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import UsageError, read_given_case
from nag.cli.running import (
    CommandAnswer,
    answer_document,
    answer_of,
    chosen_run,
    name_case,
    say_first,
)
from nag.cli.witness_input import (
    add_component,
    add_input,
    component_of,
    doubt_rows,
    read_components,
    with_tested_traces,
)

if TYPE_CHECKING:
    from nag.decomposition.singular_points import SingularLocus
    from nag.witness.witness import Decomposition

# Labels are as wide as the widest from the first line on.
WIDTH = len("answer")


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
    from nag.decomposition.singular_points import FORMAT, singular_locus
    from nag.witness.shown import paths_text

    found = read_components(options)
    if options.component is not None:
        component_of(found, options.component, "--component")
    found = with_tested_traces(found)
    whole = found.decomposition
    # Their singular points may take longer than the components did.
    early = [("of", _components_text(whole))]
    say_first(options, found.case, early, width=WIDTH)

    def fields_of(locus: SingularLocus) -> dict[str, Any]:
        return {
            "format": FORMAT,
            **locus.document([c.facts(i) for i, c in enumerate(whole.components, 1)]),
        }

    def document_of(locus: SingularLocus) -> dict[str, Any]:
        return answer_document(options, found.case, fields_of(locus), False)

    locus = singular_locus(
        whole,
        only=None if options.component is None else [options.component - 1],
        run=chosen_run(options, document_of),
    )
    fields = fields_of(locus)
    known = [*early, *locus.rows(len(whole.components))]
    blocks = [known, *(one.rows(whole.system.own_variables) for one in locus.sets)]
    tail = [("open", note) for note in locus.notes] + doubt_rows(found.decomposition)
    tail.append(("paths", paths_text(locus.paths)))
    complete = locus.complete and whole.complete
    return answer_of(options, found.case, blocks, tail, fields, complete, width=WIDTH)


def _components_text(whole: Decomposition) -> str:
    """What there is, before anything of its singular points is known."""
    from nag.witness.shown import kinds, kinds_text

    return f"{kinds_text(kinds(whole.components))}, whose singular points are looked for"


def _for_parameters(options: argparse.Namespace) -> CommandAnswer:
    """For which parameters there are singular points: they are solved for as well."""
    from nag.algebra.tokens import list_names
    from nag.decomposition.singular_members import singular_parameters
    from nag.errors import InputError, NagError
    from nag.questions import free_parameters
    from nag.witness.shown import paths_text

    if options.component is not None:
        raise UsageError("--free: is of equations, not of components; leave --component out")
    names = list_names(options.free)
    for name, _ in options.set:
        if name in names:
            raise UsageError(f"--set {name}: is an unknown by --free; give it no value")
    case = read_given_case(options, exports=True)
    try:
        system, count = free_parameters(case, names)
    except InputError:
        raise
    except NagError as error:
        raise UsageError(f"--{error}") from None
    try:
        found = singular_parameters(system, count, run=chosen_run(options))
    except ValueError as reason:
        raise UsageError(f"{options.case}: --free: {reason}") from None
    rows = [*found.rows(), ("paths", paths_text(found.paths))]
    return answer_of(options, name_case(case), (), rows, found.document(), found.complete)
