"""``nag singular --free``: the parameters for which there are singular points."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from nag.cli.arguments import UsageError
from nag.cli.running import compilation_notice, run_row
from nag.cli.witness_input import is_export, write_document

FORMAT = "nag-singular-parameters"


def run(options: argparse.Namespace) -> tuple[list[str], bool]:
    """Solve for parameters as well; returns the lines to print and whether all is known.

    Raises:
        UsageError: for bad input, or an export that cannot be written.
    """
    from nag.files.case_table import CaseError
    from nag.files.cases import read_case
    from nag.files.freed_parameters import freed_system
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
        from nag.decomposition.singular_parameters import singular_parameters

        try:
            found = singular_parameters(
                system,
                len(names),
                seed=options.seed,
                threads=options.threads,
                settings=options.settings,
            )
        except ValueError as reason:
            raise UsageError(f"{options.case}: --free: {reason}") from None
    title = read_case(options.case).title
    if options.json is not None:
        document = {
            "format": FORMAT,
            "version": 1,
            "case": {"title": title, "file": Path(options.case).name},
            "seed": options.seed,
            "settings": options.settings,
            "complete": found.complete,
            "notes": list(found.notes),
            "parameters": names,
            "conditions": [[f.text(names) for f in each] for each in found.conditions],
        }
        write_document(document, options.json)
    rows = [("singular", text) for text in found.texts()] or [("singular", "for no parameters")]
    rows += [("open", note) for note in found.notes]
    rows.append(("paths", paths_text(found.paths)))
    rows.append(run_row(options))
    body = labelled([(label, printable(text)) for label, text in rows])
    return [printable(title), "", *body], found.complete
