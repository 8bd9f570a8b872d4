"""The command ``nag bench scale``: what a path costs, and a plan for very many."""

from __future__ import annotations

import argparse
import sys
from dataclasses import asdict

from nag.cli.running import CommandAnswer

# Sizes of the systems that are measured: 2,048 to 16,384 paths.
SIZES = (11, 12, 13, 14)
# Parts of a second.
MILLI, MICRO = 1e-3, 1e-6
# Numbers of paths of the plan.
MANY = (10**6, 10**9)


def run(options: argparse.Namespace) -> CommandAnswer:
    """What paths cost on this machine, and what a million and a billion would."""
    from nag.bench.path_costs import CostModel, measure_path_costs
    from nag.text.table import align

    costs = []
    for cost in measure_path_costs(SIZES, workers=True):
        costs.append(cost)
        if not options.quiet:
            print(f"{cost.paths} paths ...", file=sys.stderr, flush=True)
    heads = ["unknowns", "paths", "ms a path", "us a step", "proof", "found again", "MB", "ledger"]
    rows = [
        [
            str(c.unknowns),
            str(c.paths),
            f"{c.seconds / c.paths / MILLI:.3g}",
            f"{c.seconds / c.steps / MICRO:.3g}",
            f"{c.proof / c.paths / MILLI:.3g} ms",
            f"{c.found / c.seconds:.1%}",
            f"{c.memory / 2**20:.0f}",
            f"{c.ledger / 2**20:.1f} MB",
        ]
        for c in costs
    ]
    model = CostModel.fit(costs)
    lines = [
        *align([heads, *rows]),
        "",
        f"a path and its proof take {model.seconds:.2g} s times unknowns^{model.power:.2f}",
        f"two worker processes are {costs[-1].workers:.2f} times as fast as one",
    ]
    plans = []
    for paths in MANY:
        unknowns = 1 + (paths - 1).bit_length()
        seconds, memory, disk = model.plan(paths, unknowns)
        lines.append(
            f"{paths:.0e} paths in {unknowns} unknowns: {seconds / 3600:.3g} hours of a processor, "
            f"{memory / 2**30:.2g} GB of arrays, in memory or in files, {disk / 2**30:.2g} GB of "
            "ledger"
        )
        plans.append({"paths": paths, "seconds": seconds, "memory": memory, "ledger": disk})
    document = {
        "format": "nag-bench-scale",
        "costs": [asdict(cost) for cost in costs],
        "plans": plans,
    }
    return CommandAnswer(lines, True, lambda: document)
