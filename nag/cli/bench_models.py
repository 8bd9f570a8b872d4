"""``nag bench models``: every mechanism in every formulation, in one table."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from nag.cli.arguments import UsageError, read_case_file
from nag.cli.running import CommandAnswer

FOLDER = Path("cases")
# A formulation is given up after so many seconds.
PATIENCE = 60


def files(names: list[str] | None, folder: str) -> list[Path]:
    """The case files to run: those that are named, or all in the folder and below.

    Raises:
        UsageError: if there is no such file.
    """
    if not names:
        there = Path(folder)
        if not there.is_dir():
            raise UsageError(f"--folder: {folder}: is no folder; name the one that has the cases")
        return sorted(there.rglob("*.toml"))
    paths = []
    for name in names:
        path = Path(name) if name.endswith(".toml") else Path(folder) / f"{name}.toml"
        if not path.is_file():
            raise UsageError(f"--case: {name}: no such case; give the path of a case file")
        paths.append(path)
    return paths


def run(options: argparse.Namespace) -> CommandAnswer:
    """Formulations side by side; complete if every answer that came is."""
    from nag.bench.models import measure_models
    from nag.bench.table import models_table
    from nag.mechanism.model import ModelError

    rows = []
    for path in files(options.case, str(FOLDER) if options.folder is None else options.folder):
        case = read_case_file(path)
        if case.mechanism is None and case.assembly is None:
            if options.case:
                raise UsageError(f"{path}: is a polynomial system; name a mechanism")
            continue
        if not options.quiet:
            print(f"{path.stem} ...", file=sys.stderr, flush=True)
        try:
            rows += measure_models(path.stem, case.mechanism or case.assembly, options.patience)
        except ModelError as error:
            raise UsageError(f"{path}: {error}") from None
    document = {"format": "nag-bench-models", "rows": [r.document() for r in rows]}
    complete = all(r.complete for r in rows if r.paths is not None)
    return CommandAnswer(models_table(rows), complete, lambda: json.dumps(document) + "\n")
