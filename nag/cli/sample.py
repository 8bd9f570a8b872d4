"""The command ``nag sample``: random points of a component."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

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

if TYPE_CHECKING:
    from nag.algebra.system import PolynomialSystem
    from nag.witness.sampling import Samples
    from nag.witness.witness import WitnessSet

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
    from nag.witness.sampling import FORMAT
    from nag.witness.shown import MOST_SAMPLES as SHOWN
    from nag.witness.shown import real_dimension_text

    found = read_components(options, real=options.real)
    component = component_of(found, options.component, "--component")
    system = found.decomposition.system
    samples, none, doubt = _draw(system, component, options, found.obstacle)
    count = len(samples.points)
    tail = [("points", f"{count}, the first {SHOWN} are shown")] * (count > SHOWN)
    accuracy = f"{magnitude(samples.residual)}, accuracy {magnitude(samples.accuracy)}"
    tail += [("residual", accuracy)] * (count > 0)
    tail += [("answer", none)] * bool(none) + [("open", doubt)] * bool(doubt)
    fields = {
        "format": FORMAT,
        **samples.document(component.facts(options.component)),
    }
    table = align(samples.rows(system.own_variables)) if count else ()
    head = [numbered_row(options.component, component, "complex " if options.real else "")]
    if samples.real_dimensions:
        head.append(("real", real_dimension_text(samples.real_dimensions)))
    blocks = head, table
    # A point of a component needs no other component to be known.
    complete = str(component.status) == "irreducible" and not doubt
    return answer_of(
        options, found.case, blocks, [*tail, *doubt_rows(found.decomposition)], fields, complete
    )


def _draw(
    system: PolynomialSystem, component: WitnessSet, options: argparse.Namespace, obstacle: str
) -> tuple[Samples, str, str]:
    """Points that are asked for, that there are none if that is proved, and what is not known.

    Args:
        obstacle: what proves that none is real; empty if nothing does.
    """
    from nag.witness.sampling import NoRealPointsError, SamplingError, sample

    how = chosen_run(options)
    try:
        if options.real:
            from nag.real.real_pieces import Reality
            from nag.real.real_samples import sample_real, say_none_real

            if obstacle:
                raise say_none_real(system, Reality.NONE, obstacle)
            samples = sample_real(component, options.count, run=how)
        else:
            samples = sample(system, component, options.count, run=how)
    except NoRealPointsError as none:
        return none.found, str(none), ""
    except SamplingError as error:
        return error.found, "", str(error)
    return samples, "", samples.doubt
