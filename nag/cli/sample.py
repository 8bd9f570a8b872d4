"""The command ``nag sample``: random points of a component."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from nag.cli.arguments import add_running, whole
from nag.cli.running import as_chosen, compilation_notice, run_row
from nag.cli.witness_input import (
    Given,
    add_input,
    component_number,
    component_of,
    doubts,
    given,
    head,
    like,
    write_document,
)

if TYPE_CHECKING:
    from nag.witness.sampling import Samples
    from nag.witness.witness import WitnessSet

FORMAT = "nag-samples"
MOST_SAMPLES = 1_000_000
# Longer lists and wider points are left to the export.
MOST_ROWS, MOST_COLUMNS = 20, 4


def _count(text: str) -> int:
    return whole(text, 1, MOST_SAMPLES)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag sample`` has besides those of every command that runs a case."""
    add_input(parser)
    add_running(parser)
    parser.add_argument(
        "--component",
        type=component_number,
        default=1,
        metavar="K",
        help="number of the component, in the order of the export (default: 1)",
    )
    parser.add_argument(
        "--count", type=_count, default=10, metavar="N", help="number of points (default: 10)"
    )


def run(options: argparse.Namespace) -> tuple[list[str], bool]:
    """Sample a component and write the export; returns the lines to print and whether it is whole.

    Raises:
        UsageError: for bad input, or an export that cannot be written.
    """
    with compilation_notice(sys.stderr, options.quiet):
        from nag.witness.sampling import SamplingError, sample

        found = given(options)
        component = component_of(found, options.component, "--component")
        system = found.decomposition.system
        try:
            samples = sample(system, component, options.count, **as_chosen(options))
            doubt = ""
        except SamplingError as error:
            samples, doubt = error.found, str(error)
    # A point of a component needs no other component to be known.
    complete = str(component.status) == "irreducible" and not doubt
    if options.json is not None:
        from nag.files.json_values import pairs

        document = head(found, FORMAT, options) | {
            "complete": complete,
            "variables": list(system.variables),
            "component": {"number": options.component, **like(component)},
            "residual": samples.residual,
            "accuracy": samples.accuracy,
            "points": pairs(samples.points),
        }
        write_document(document, options.json)
    return _lines(options, found, component, samples, doubt), complete


def _lines(
    options: argparse.Namespace,
    found: Given,
    component: WitnessSet,
    samples: Samples,
    doubt: str,
) -> list[str]:
    from nag.text.table import align, magnitude, sheet

    variables = found.decomposition.system.variables
    dots = ["..."] if len(variables) > MOST_COLUMNS else []
    rows = [["point", *variables[:MOST_COLUMNS], *dots]]
    for i, point in enumerate(samples.points[:MOST_ROWS]):
        cells = [f"{z.real:.6f}{z.imag:+.6f}i" for z in point[:MOST_COLUMNS]]
        rows.append([str(i + 1), *cells, *dots])
    kind = f"{options.component}: dimension {component.dimension}, degree {component.degree}"
    top = [("component", f"{kind}, {component.status}")]
    tail = [
        ("residual", f"{magnitude(samples.residual)}, accuracy {magnitude(samples.accuracy)}"),
        *([("open", doubt)] if doubt else []),
        *doubts(found),
        run_row(options),
    ]
    if len(samples.points) > MOST_ROWS:
        tail.insert(0, ("points", f"{len(samples.points)}, the first {MOST_ROWS} are shown"))
    return sheet(found.title, top, align(rows), tail)
