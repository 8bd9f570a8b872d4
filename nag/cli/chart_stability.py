"""``nag chart stability``: the atlas, its picture, and what changed since the one that is kept."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from nag.cli.arguments import SETTINGS, UsageError, whole
from nag.cli.chart_files import check_targets, write_picture
from nag.cli.running import CommandAnswer

if TYPE_CHECKING:
    from nag.bench.atlas.stability import Atlas, FamilyRow

KEPT = Path(__file__).parents[1] / "bench" / "charts" / "stability.json"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag chart stability``."""
    parser.add_argument(
        "--family", action="append", metavar="NAME", help="run this family only (repeatable)"
    )
    parser.add_argument(
        "--seeds", type=lambda t: whole(t, 1, 1000), default=20, help="seeds (default: 20)"
    )
    parser.add_argument(
        "--limit",
        type=lambda t: whole(t, 1, 3600),
        default=10,
        metavar="SECONDS",
        help="processor time after which an answer counts as undecided (default: 10; four times as "
        "long for the family solved-hard, six times for nine-point, twelve times for sparse-large "
        "and solved-large; the last three have four seeds)",
    )
    parser.add_argument(
        "--jobs", type=lambda t: whole(t, 1, 64), default=2, help="processes (default: 2)"
    )
    parser.add_argument("--settings", choices=SETTINGS, default="default")
    parser.add_argument("--data", metavar="FILE", help="draw the atlas in FILE, without a run")
    parser.add_argument(
        "--json",
        metavar="FILE",
        help="write the counts to FILE, or - for standard output alone",
    )
    parser.add_argument(
        "--picture", metavar="FILE", action="append", help="draw to FILE.svg or .png (repeatable)"
    )
    parser.add_argument(
        "--against", metavar="FILE", default=str(KEPT), help="an earlier atlas (default: the kept)"
    )
    parser.add_argument(
        "--rest", metavar="FILE", help="take the families that are not run from the atlas in FILE"
    )
    parser.add_argument("--quiet", action="store_true", help="no progress on standard error")


def run(options: argparse.Namespace) -> CommandAnswer:
    """The atlas, run or read; complete if no answer was wrong.

    Raises:
        UsageError: if there is no such family, or a file cannot be read or written.
    """
    check_targets(options)
    before = _read(options.against) if Path(options.against).exists() else None
    if before is None and options.against != str(KEPT):
        raise UsageError(f"--against: {options.against}: there is no such file")
    rest = _read(options.rest) if options.rest is not None else None
    atlas = _read(options.data) if options.data is not None else _run(options)

    from nag.bench.atlas.picture import draw
    from nag.bench.atlas.stability import changes, complete_atlas, document, table
    from nag.text.json_text import lay_out
    from nag.text.table import align, printable

    if rest is not None:
        try:
            atlas = complete_atlas(atlas, rest)
        except ValueError as error:
            raise UsageError(f"--rest: {options.rest}: {error}") from None
    for path in options.picture or ():
        write_picture(path, lambda target: draw(atlas, target))
    lines = align(table(atlas), {0})
    for row in atlas.rows:
        told = [(c.value, r) for c in row.cells for r in c.remarks if r.startswith("wrong")]
        lines += [printable(f"{row.name} {value}: {remark}") for value, remark in told]
    if before is not None and options.data is None:
        told = list(changes(atlas, before))
        lines += ["", *(told or ["nothing changed against the atlas that is kept"])]
    return CommandAnswer(lines, atlas.wrong == 0, lambda: lay_out(document(atlas)) + "\n")


def _read(path: str) -> Atlas:
    from nag.bench.atlas.stability import read_atlas
    from nag.files.json_values import read_file

    return read_file(path, read_atlas)


def _run(options: argparse.Namespace) -> Atlas:
    from nag.bench.atlas.families import FAMILIES
    from nag.bench.atlas.moved import CASES, GROUPS
    from nag.bench.atlas.stability import run_atlas

    names = {f.name for f in FAMILIES}
    for name in options.family or ():
        if name not in names:
            raise UsageError(f"--family: {name}: there are {', '.join(sorted(names))}")
    families = [f for f in FAMILIES if not options.family or f.name in options.family]
    moved = [f.name for f in families if f.name in GROUPS]
    if moved and not CASES.is_dir():
        text = f"the family {moved[0]!r} needs the folder {CASES}; run it where that is"
        raise UsageError(text)

    def progress(row: FamilyRow) -> None:
        if not options.quiet:
            wrong = sum(c.wrong for c in row.cells)
            print(f"{row.name}: {wrong} wrong", file=sys.stderr, flush=True)

    return run_atlas(
        families, options.seeds, options.limit, options.jobs, options.settings, progress
    )
