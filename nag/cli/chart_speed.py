"""``nag chart speed-accuracy``: cases in many settings, arithmetics and programs."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from nag.cli.arguments import UsageError, problem_of_case, read_case_file, whole
from nag.cli.chart_files import check_targets, write_picture
from nag.cli.running import CommandAnswer

if TYPE_CHECKING:
    from nag.bench.work_precision import Chart, MeasuredCase

FOLDERS = (Path("cases"), Path("cases/benchmarks"), Path("cases/hard"))
# A system of the atlas: eight pairs of solutions at distances of 1e-8.
CLUSTER = "cluster"
NAMES = (
    "katsura-6",
    "katsura-8",
    "cyclic-6",
    "noon-5",
    "inverse-6r",
    "stewart-gough",
    "chemequ",
    "bennett",
    "rhombus",
    "bricard-cube",
    CLUSTER,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag chart speed-accuracy``."""
    parser.add_argument(
        "case",
        nargs="*",
        metavar="CASE",
        help=f"case file, or its name without .toml (default: {', '.join(NAMES)}; the last one is "
        "made here)",
    )
    parser.add_argument(
        "--seeds", type=lambda t: whole(t, 1, 1000), default=5, help="seeds (default: 5)"
    )
    parser.add_argument(
        "--no-peers", action="store_true", help="leave out M2, phc and bertini2, if installed"
    )
    parser.add_argument("--data", metavar="FILE", help="draw what is in FILE, without a run")
    parser.add_argument(
        "--json", metavar="FILE", help="write the data to FILE, or - for standard output alone"
    )
    parser.add_argument(
        "--picture",
        metavar="FILE",
        action="append",
        help="draw all cases to FILE.svg or .png, and each one to FILE-CASE beside it (repeatable)",
    )
    parser.add_argument("--quiet", action="store_true", help="no progress on standard error")


def run(options: argparse.Namespace) -> CommandAnswer:
    """Measured or read; complete if default settings found everything.

    Raises:
        UsageError: if a case cannot be read or measured, or a file cannot be read or written.
    """
    check_targets(options)
    charts = _read(options.data) if options.data is not None else _run(options)

    from nag.bench.peer_points import SCALED
    from nag.bench.speed_accuracy import ratios
    from nag.bench.speed_accuracy_picture import draw_all, draw_case
    from nag.bench.work_precision import document
    from nag.text.table import align

    for path in options.picture or ():
        write_picture(path, lambda target: draw_all(charts, target))
        stem, dot, kind = path.rpartition(".")
        for chart in charts:
            name = f"{stem}-{chart.case}{dot}{kind}"
            write_picture(name, lambda target, chart=chart: draw_case(chart, target))
    lines = align(ratios(charts), {0, 4})
    lines += ["", "ratio: the other program's processor time over ours; in brackets where one of"]
    lines.append(f"the two did not find all solutions to 1e-12; * {SCALED}")
    right = all(p.share == 1 for chart in charts for p in _default(chart))
    return CommandAnswer(lines, right, lambda: json.dumps(document(charts)) + "\n")


def _default(chart: Chart) -> list:
    return [
        p for c in chart.curves if c.kind == "settings" for p in c.points if p.name == "default"
    ]


def _read(path: str) -> list[Chart]:
    from nag.bench.work_precision import read_charts
    from nag.files.json_values import read_file

    return read_file(path, read_charts)


def _run(options: argparse.Namespace) -> list[Chart]:
    from nag.bench.reference import ReferenceError
    from nag.bench.speed_accuracy import chart_of

    subjects = [_subject(name) for name in options.case or NAMES]
    charts = []
    for subject in subjects:

        def progress(curve: str, name: str = subject.name) -> None:
            if not options.quiet:
                print(f"{name}: {curve} ...", file=sys.stderr, flush=True)

        try:
            charts.append(chart_of(subject, options.seeds, not options.no_peers, progress))
        except ReferenceError as error:
            raise UsageError(f"{subject.name}: {error}") from None
    return charts


def _subject(name: str) -> MeasuredCase:
    from nag.bench.work_precision import MeasuredCase

    if name == CLUSTER:
        import numpy as np

        from nag.bench.atlas.points import cluster

        problem = cluster((3, 2, 8), np.random.default_rng(0))
        return MeasuredCase(name, problem.system, False, ((0, 1, 16),))

    path = Path(name)
    if not name.endswith(".toml"):
        found = [folder / f"{name}.toml" for folder in FOLDERS]
        path = next((p for p in found if p.is_file()), found[0])
    case = read_case_file(path)
    problem = problem_of_case(case)
    known = case.known_in(problem.formulation)
    degrees = tuple((t.dimension, t.degree, t.count) for t in known)
    return MeasuredCase(path.stem, problem.system, any(d for d, _, _ in degrees), degrees)
