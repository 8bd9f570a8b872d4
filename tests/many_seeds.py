"""Decompose cases for many seeds and count the answers that are wrong or incomplete.

    python tests/many_seeds.py --seeds 0:1000 [--case NAME ...] [--folder literature ...]
        [--below SECONDS] [--journal FILE] [--formulation E|H] [--symmetric] [--threads N]
        [--changed] [--coordinates KIND:DECADES]

Prints one line a case and the totals. With `--changed`, every seed decomposes the case in other
coordinates, with other equations (see `nag.bench.atlas.changes`); multidegrees are those of
the old ones. With `--coordinates`, in coordinates that lie far from the case's own ones
(see `nag.bench.atlas.changes.FAR_COORDINATES`), with the same equations.
With a journal, a run that was cut off goes on where it stopped. Exit status 1 if any answer
differs from what the case file knows, or is incomplete.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.changes import FAR_COORDINATES, change_system, in_far_coordinates
from nag.decomposition.decompose import decompose
from nag.files.cases import Truth, read_case
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.problem import problem_of
from nag.report.agreement import AgreementKind, compare
from nag.witness.shown import kinds, kinds_text
from nag.witness.witness import Status

CASES = Path(__file__).resolve().parent.parent / "cases"
# Seconds between two notices of how far a case is.
NOTICE = 60


@dataclass(frozen=True)
class Subject:
    """A case in one formulation, ready to be decomposed.

    Attributes:
        parts: the model of parts that are not assembled, if it is one.
    """

    name: str
    system: PolynomialSystem
    truth: tuple[Truth, ...]
    formulation: str | None
    symmetries: tuple[SignedPermutation, ...]
    parts: AssemblyModel | None = None


@dataclass(frozen=True)
class Result:
    """What became of one seed.

    Attributes:
        wrong: it differs from what is known, or an error was raised.
        incomplete: it does not claim to be the whole answer.
        undecided: number of components that are not confirmed.
        seconds: processor time.
        text: what was found, unless all is well.
    """

    case: str
    seed: int
    wrong: bool
    incomplete: bool
    undecided: int
    seconds: float
    text: str = ""


def subject(path: Path, formulation: str | None, symmetric: bool) -> Subject:
    """The case of a file; the cheapest formulation of a mechanism unless one is named."""
    case = read_case(path)
    asked = formulation or "auto" if case.mechanism is not None else "auto"
    problem, name = problem_of(case, formulation=asked), path.stem
    if case.mechanism is not None:
        name += f" ({problem.formulation})"
    symmetries = problem.symmetries if symmetric else ()
    truth = tuple(case.truth)
    return Subject(name, problem.system, truth, problem.formulation, symmetries, case.assembly)


def moved(of: Subject, seed: int, far: str | None) -> Subject:
    """The same zero set in coordinates in which nothing is known of its multidegrees.

    Args:
        far: kind and decades of coordinates; None for any change.
    """
    rng = np.random.default_rng(seed)
    if far is None:
        system = change_system(of.system, rng)
    else:
        kind, decades = far.split(":")
        system = replace(in_far_coordinates(of.system, kind, int(decades), rng), groups=())
    truth = tuple(replace(t, multidegree=None) for t in of.truth)
    return replace(of, system=system, truth=truth, parts=None)


def decomposed(of: Subject, seed: int, threads: int, settings: str) -> Result:
    """Decompose once and compare."""
    options = {"seed": seed, "threads": threads, "settings": settings}
    options["symmetries"] = of.symmetries
    begin = time.process_time()
    try:
        if of.parts is not None:
            answer = problem_of(of.parts).decompose(**options)
        else:
            answer = decompose(of.system, **options)
    except Exception as error:  # A run of hours is not to end with one seed.
        spent = time.process_time() - begin
        return Result(of.name, seed, True, True, 0, spent, f"{type(error).__name__}: {error}")
    spent = time.process_time() - begin
    agreement = compare(answer, of.truth, of.formulation)
    wrong = (
        agreement is None or agreement.verdict is AgreementKind.DIFFERS or bool(agreement.unlisted)
    )
    undecided = sum(c.status is Status.UNDECIDED for c in answer.components)
    text = ""
    if wrong or not answer.complete:
        reasons = [*answer.notes, *(c.note for c in answer.components if c.note)]
        text = f"{kinds_text(kinds(answer.components))} {answer.paths} {'; '.join(reasons)}"
    return Result(of.name, seed, wrong, not answer.complete, undecided, spent, text)


def recorded(journal: Path | None) -> dict[tuple[str, int], Result]:
    """The results of an earlier run; a line that was cut off is left out."""
    known: dict[tuple[str, int], Result] = {}
    if journal is not None and journal.exists():
        for line in journal.read_text().splitlines():
            try:
                result = Result(**json.loads(line))
            except (ValueError, TypeError):
                continue
            known[result.case, result.seed] = result
    return known


def run(
    of: Subject,
    seeds: Sequence[int],
    known: dict[tuple[str, int], Result],
    options: argparse.Namespace,
) -> Iterator[Result]:
    """The results of all seeds, the new ones written to the journal as they come."""
    noticed, slow = time.monotonic(), True
    for k, seed in enumerate(seeds):
        result = known.get((of.name, seed))
        if result is None:
            other = options.changed or options.coordinates
            one = moved(of, seed, options.coordinates) if other else of
            result = decomposed(one, seed, options.threads, options.settings)
            if options.journal is not None:
                with options.journal.open("a") as file:
                    file.write(json.dumps(asdict(result)) + "\n")
        if result.wrong or result.incomplete:
            print(f"  seed {seed}: {result.text}", flush=True)
        yield result
        # The first seed may have to wait for compilation.
        slow = slow and options.below is not None and result.seconds > options.below
        if slow and k == 1:
            return
        if time.monotonic() - noticed > NOTICE:
            noticed = time.monotonic()
            print(f"{of.name}: {k + 1} of {len(seeds)} seeds", file=sys.stderr, flush=True)


def summary(name: str, results: Sequence[Result]) -> str:
    """Counts and the median time of some results, in one line."""
    seconds = sorted(r.seconds for r in results)
    return (
        f"{name}: {len(results)} seeds, {sum(r.wrong for r in results)} wrong, "
        f"{sum(r.incomplete for r in results)} incomplete, "
        f"{sum(r.undecided > 0 for r in results)} with undecided components, "
        f"median {seconds[len(seconds) // 2]:.3f} s, longest {seconds[-1]:.3f} s"
    )


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", default="0:20", help="first:last+1")
    parser.add_argument("--case", action="append", help="stem of a case file; all by default")
    parser.add_argument("--folder", action="append", help="folder under cases/, in their place")
    parser.add_argument("--below", type=float, help="pass over cases that take more seconds a seed")
    parser.add_argument("--journal", type=Path, help="file that keeps the results of every seed")
    parser.add_argument("--symmetric", action="store_true", help="use the systems' symmetries")
    parser.add_argument("--changed", action="store_true", help="change coordinates and equations")
    parser.add_argument("--coordinates", help=f"{'|'.join(FAR_COORDINATES)}:DECADES")
    parser.add_argument("--formulation", choices=["E", "H"])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--settings", default="default")
    return parser.parse_args()


def main() -> int:
    options = arguments()
    first, last = map(int, options.seeds.split(":"))
    seeds = range(first, last)
    folders = [CASES / name for name in options.folder or ["."]]
    paths = [p.resolve() for folder in folders for p in sorted(folder.glob("*.toml"))]
    if options.case:
        paths = [p for p in paths if p.stem in options.case]
    known, everything, passed_over = recorded(options.journal), [], []
    for path in paths:
        of = subject(path, options.formulation, options.symmetric)
        if all(t.formulation not in (None, of.formulation) for t in of.truth):
            passed_over.append(f"{of.name} (its components are not known)")
            continue
        results = list(run(of, seeds, known, options))
        if len(results) < len(seeds):
            passed_over.append(f"{of.name} ({results[-1].seconds:.1f} s)")
            continue
        everything += results
        print(summary(of.name, results), flush=True)
    if passed_over:
        print(f"passed over: {', '.join(passed_over)}")
    if everything:
        print(summary(f"total of {len(paths) - len(passed_over)} cases", everything))
    return 1 if any(r.wrong or r.incomplete for r in everything) else 0


if __name__ == "__main__":
    sys.exit(main())
