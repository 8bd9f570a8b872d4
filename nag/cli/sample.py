"""The command ``nag sample``: random points of a component."""

from __future__ import annotations

import argparse

from nag.cli.arguments import whole
from nag.cli.running import CommandAnswer, answer_of, chosen_run
from nag.cli.witness_input import (
    add_component,
    add_input,
    component_of,
    doubt_rows,
    numbered_row,
    read_components,
)

FORMAT = "nag-samples"
MOST_SAMPLES = 1_000_000


def _count(text: str) -> int:
    return whole(text, 1, MOST_SAMPLES)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag sample`` has besides those of every command that runs a case."""
    add_input(parser)
    add_component(
        parser, "number of the component, in the order of the export (default: 1)", default=1
    )
    parser.add_argument(
        "--count", type=_count, default=10, metavar="N", help="number of points (default: 10)"
    )
    parser.add_argument("--real", action="store_true", help="real points only")


def run(options: argparse.Namespace) -> CommandAnswer:
    """Points of a component."""
    from nag.text.table import align, magnitude
    from nag.witness.sampling import SamplingError, sample
    from nag.witness.shown import MOST_SAMPLES as SHOWN

    found = read_components(options)
    component = component_of(found, options.component, "--component")
    system = found.decomposition.system
    try:
        if options.real:
            from nag.real.real_samples import sample_real

            samples = sample_real(component, options.count, run=chosen_run(options))
        else:
            samples = sample(system, component, options.count, run=chosen_run(options))
        doubt = samples.doubt
    except SamplingError as error:
        samples, doubt = error.found, str(error)
    more = len(samples.points) - SHOWN
    tail = [("points", f"{len(samples.points)}, the first {SHOWN} are shown")] * (more > 0)
    accuracy = f"{magnitude(samples.residual)}, accuracy {magnitude(samples.accuracy)}"
    tail += [("residual", accuracy), *([("open", doubt)] if doubt else []), *doubt_rows(found)]
    fields = {
        "format": FORMAT,
        "variables": list(system.variables),
        "component": component.facts(options.component),
        **samples.document(),
    }
    blocks = [numbered_row(options.component, component)], align(samples.rows(system.own_variables))
    # A point of a component needs no other component to be known.
    complete = str(component.status) == "irreducible" and not doubt
    return answer_of(options, found.case, blocks, tail, fields, complete)
