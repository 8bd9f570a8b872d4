"""Decompose cases for many seeds and count the answers that are wrong or incomplete.

    python tests/many_seeds.py --seeds 0:1000 [--case NAME ...] [--folder literature ...]
        [--formulation E|H] [--symmetric] [--threads N]

Prints one line a case; exit status 1 if any answer differs from what the case file knows, or is
incomplete.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from nag.cases import read_case
from nag.decomposition import decompose
from nag.mechanism.model import model
from nag.report.agreement import Verdict, compare, in_words, kinds
from nag.report.answer import symmetries_of

CASES = Path(__file__).resolve().parent.parent / "cases"


def run(
    path: Path,
    seeds: range,
    formulation: str | None,
    threads: int,
    settings: str,
    symmetric: bool = False,
) -> bool:
    """Decompose one case for all seeds, print the counts, and say whether all were right."""
    case, chosen = read_case(path), None
    if case.mechanism is not None:
        chosen = model(case.mechanism, formulation or "auto")
        system, formulation = chosen.system, chosen.formulation
    else:
        system, formulation = case.system, None
    symmetries = symmetries_of(case, chosen) if symmetric else ()
    wrong, incomplete, seconds = [], [], []
    for seed in seeds:
        begin = time.perf_counter()
        answer = decompose(
            system, seed=seed, threads=threads, settings=settings, symmetries=symmetries
        )
        seconds.append(time.perf_counter() - begin)
        agreement = compare(answer, case.truth, formulation)
        if agreement is None or agreement.verdict is Verdict.DIFFERS or agreement.unlisted:
            wrong.append(seed)
        if not answer.complete:
            incomplete.append(seed)
        if seed in (*wrong[-1:], *incomplete[-1:]):
            print(f"  seed {seed}: {in_words(kinds(answer.components))}", end="")
            print(f" {answer.paths} {'; '.join(answer.notes)}")
    seconds.sort()
    name = path.stem if formulation is None else f"{path.stem} ({formulation})"
    print(
        f"{name}: {len(seeds)} seeds, {len(wrong)} wrong, {len(incomplete)} incomplete, "
        f"median {seconds[len(seconds) // 2]:.3f} s",
        flush=True,
    )
    return not wrong and not incomplete


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", default="0:20", help="first:last+1")
    parser.add_argument("--case", action="append", help="stem of a case file; all by default")
    parser.add_argument("--folder", action="append", help="folder under cases/, in their place")
    parser.add_argument("--symmetric", action="store_true", help="use the systems' symmetries")
    parser.add_argument("--formulation", choices=["E", "H"])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--settings", default="default")
    options = parser.parse_args()
    first, last = map(int, options.seeds.split(":"))
    folders = [CASES / name for name in options.folder or ["."]]
    paths = [p.resolve() for folder in folders for p in sorted(folder.glob("*.toml"))]
    if options.case:
        paths = [p for p in paths if p.stem in options.case]
    results = [
        run(
            p,
            range(first, last),
            options.formulation,
            options.threads,
            options.settings,
            options.symmetric,
        )
        for p in paths
    ]
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
