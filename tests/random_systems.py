"""Solve and decompose random small systems and compare with exact counts.

    python tests/random_systems.py --count N --seed S [--first K] [--jobs J] [--limit SECONDS]
        [--number NUMBER ...] [--method solve|decompose] [--journal FILE] [--all] [--coordinates]

System number K of seed S depends on these two only. An answer is right, incomplete, slow (ended
at the limit of processor time) or wrong: called complete and not what `exact_counts` says. Where
that says nothing, complete answers of the two methods are compared with each other: they agree or
differ, or are unchecked. With `--coordinates`, each system is solved and decomposed in coordinates
that lie far from its own ones, of a kind and a distance drawn for it (`far_coordinates`); what is
known is counted in its own ones, and verdicts are summed up for each kind.

Prints the equations of systems with an answer that is wrong, an error or differs, one line for
other answers that are not right with `--all`, and a summary. With a journal, a run that was cut
off goes on where it stopped. Exit status 1 if an answer is wrong, an error or differs.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from exact_counts import zero_set
from random_small import far_coordinates, far_system, small_system

from nag.bench.timed_runs import TimedRun, timed_runs
from nag.bench.verdicts import (
    METHODS,
    Answer,
    ZeroSet,
    compute_answer,
    describe_run,
    known_text,
    summary,
    verdict,
)

BAD = ("wrong", "error", "differ")
# Systems between two notices of how far a run is.
NOTICE = 1000


@dataclass(frozen=True)
class Task:
    """A method for a system, or ``"count"``."""

    seed: int
    number: int
    method: str
    settings: str = "default"
    far: bool = False

    @property
    def coordinates(self) -> str:
        """Kind and decades of the coordinates that lie far; empty for the system's own ones."""
        return "{}:{}".format(*far_coordinates(self.seed, self.number)) if self.far else ""


@dataclass
class Tally:
    """What became of all systems so far, by method and kind of coordinates."""

    verdicts: dict[str, Counter[str]] = field(default_factory=dict)
    seconds: dict[str, list[float]] = field(default_factory=dict)
    numbers: dict[tuple[str, str], list[int]] = field(default_factory=dict)

    def add(self, task: Task, found: Mapping[str, tuple[str, float]]) -> None:
        number, coordinates = task.number, task.coordinates.partition(":")[0]
        for name, (kind, seconds) in found.items():
            method = f"{name}, {coordinates}" if coordinates else name
            self.verdicts.setdefault(method, Counter())[kind] += 1
            self.seconds.setdefault(method, []).append(seconds)
            if kind not in ("right", "agree"):
                self.numbers.setdefault((method, kind), []).append(number)

    def text(self) -> str:
        lines = []
        for method, counts in self.verdicts.items():
            lines.append(f"{method}: {counts.total()} systems, ")
            lines[-1] += summary(counts, self.seconds[method])
            for (of, kind), numbers in sorted(self.numbers.items()):
                if of == method:
                    lines.append(f"  {kind}: {' '.join(map(str, sorted(numbers)))}")
        return "\n".join(lines)


def work(task: Task) -> Answer | ZeroSet | None:
    """Count, solve or decompose."""
    if task.method == "count":
        return zero_set(small_system(task.seed, task.number).system)
    draw = far_system if task.far else small_system
    return compute_answer(task.method, draw(task.seed, task.number).system, settings=task.settings)


def judged(runs: Mapping[str, TimedRun]) -> dict[str, tuple[str, float]]:
    """Verdict and processor time of each method, from the runs for one system."""
    truth = runs["count"].value
    found = {m: verdict(run, truth) for m, run in runs.items() if m != "count"}
    open_ = [m for m, kind in found.items() if kind is None]
    if len(open_) == len(METHODS):
        points = [ZeroSet.of(runs[m].value.components).points for m in METHODS]
        found = dict.fromkeys(METHODS, "agree" if points[0] == points[1] else "differ")
    return {m: (found[m] or "unchecked", runs[m].seconds) for m in found}


def report(
    runs: Mapping[str, TimedRun], found: Mapping[str, tuple[str, float]], every: bool
) -> None:
    """Print one system, if something is to be said of it."""
    task, truth = runs["count"].task, runs["count"].value
    bad = any(kind in BAD for kind, _ in found.values())
    if not bad and not every:
        return
    small = (far_system if task.far else small_system)(task.seed, task.number)
    name = " ".join((small.kind, task.coordinates)).strip()
    for method, (kind, seconds) in found.items():
        if kind not in ("right", "agree"):
            text = describe_run(runs[method], truth)
            print(f"  {task.number} ({name}) {method}: {kind} ({seconds:.1f} s): {text}")
    if bad:
        print(f"    {', '.join(small.system.variables)}; known: {known_text(truth, 'decompose')}")
        print("".join(f'    "{text}",\n' for text in small.system.text()), end="", flush=True)


def recorded(journal: Path | None, seed: int, far: bool) -> dict[int, dict[str, tuple[str, float]]]:
    """What an earlier run found, by number; a line that was cut off is left out."""
    earlier = {}
    if journal is not None and journal.exists():
        for line in journal.read_text().splitlines():
            try:
                entry = json.loads(line)
                if entry["seed"] == seed and bool(entry.get("coordinates")) == far:
                    earlier[entry["number"]] = {m: tuple(v) for m, v in entry["found"].items()}
            except (ValueError, KeyError, TypeError):
                continue
    return earlier


def tasks(numbers: Sequence[int], methods: Sequence[str], of: argparse.Namespace) -> Iterator[Task]:
    for number in numbers:
        for method in ("count", *methods):
            yield Task(of.seed, number, method, of.settings, of.coordinates)


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0, help="number of the first system")
    parser.add_argument("--number", type=int, action="append", help="only these")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--limit", type=float, default=30.0, help="seconds for one answer")
    parser.add_argument("--method", choices=METHODS, help="both by default")
    parser.add_argument("--settings", default="default")
    parser.add_argument("--journal", type=Path, help="file that keeps what was found")
    parser.add_argument("--coordinates", action="store_true", help="far from the system's own")
    parser.add_argument("--all", action="store_true", help="also print what is open or slow")
    return parser.parse_args()


def main() -> int:
    options = arguments()
    methods = [options.method] if options.method else list(METHODS)
    numbers = options.number or range(options.first, options.first + options.count)
    far, tally = options.coordinates, Tally()
    earlier = recorded(options.journal, options.seed, far)
    for number in numbers:
        if number in earlier:
            tally.add(Task(options.seed, number, "count", far=far), earlier[number])
    left = [n for n in numbers if n not in earlier]
    collected: dict[int, dict[str, TimedRun]] = {}
    done = 0
    for run in timed_runs(
        work,
        tasks(left, methods, options),
        limit=options.limit,
        jobs=options.jobs,
        first=Task(0, 1, "decompose"),
    ):
        number = run.task.number
        runs = collected.setdefault(number, {})
        runs[run.task.method] = run
        if len(runs) <= len(methods):
            continue
        found = judged(collected.pop(number))
        report(runs, found, options.all)
        tally.add(run.task, found)
        if options.journal is not None:
            entry = {"seed": options.seed, "number": number, "found": found}
            if far:
                entry["coordinates"] = run.task.coordinates
            with options.journal.open("a") as file:
                file.write(json.dumps(entry) + "\n")
        done += 1
        if done % NOTICE == 0:
            print(f"{done} of {len(left)} systems", file=sys.stderr, flush=True)
    print(tally.text())
    bad = sum(counts[kind] for counts in tally.verdicts.values() for kind in BAD)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
