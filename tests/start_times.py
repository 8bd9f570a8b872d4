"""Processor times of the classical systems from every start, beside other programs'.

    python tests/start_times.py TABLE.json [--name NAME ...] [--ask auto|starts|phc|M2 ...]
        [--limit SECONDS] [--least SECONDS] [--again]

Asked in turn, and kept in TABLE.json, where a run that was cut off goes on: the start that is
chosen, every other start, PHCpack's blackbox solver and Macaulay2. Prints the table as Markdown,
one line a system. A start is ended where it has taken half as long again as the one that was
chosen, and two seconds; another program where it has taken twice as long, and five seconds. Exit
status 1 if an answer is wrong or incomplete, if another start takes less than the time of the
chosen one divided by 1.3, or if another program that finds as many zeros takes less.
"""

from __future__ import annotations

import argparse
import json
import resource
import sys
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from classical_systems import classic_names, make_classic

from nag.bench.peer_points import peer_points
from nag.bench.timed_runs import TimedRun, timed_runs
from nag.solving.solutions import SolveResult
from nag.solving.solve import solve

STARTS = ("total", "multihomogeneous", "polyhedral", "monodromy")
PEERS = ("phc", "M2")
ASKS = ("auto", "starts", *PEERS)
# What takes less than so many seconds is repeated until it has taken them, at most so often.
SHORT, MOST_RUNS = 0.4, 20
# What is asked is ended after so many seconds and so many times those of the chosen start: another
# program takes seconds to begin.
ENDED = {"starts": (2.0, 1.5), "peers": (5.0, 2.0)}
# No start may take so many bytes.
MEMORY = 8 << 30
# Where times lie within so many seconds of each other, none of them is longer.
LEAST = 0.02
# The longest that the chosen start may take, in times of the best one.
WORST = 1.3


@dataclass(frozen=True)
class Task:
    """A system by its name, and a start or another program."""

    name: str
    by: str


@dataclass(frozen=True)
class Entry:
    """What became of it.

    Attributes:
        found: the number of distinct isolated zeros, None without an answer.
        seconds: processor time, or the limit where that was reached.
        paths: how many were tracked; method: as `SolveResult.method`.
    """

    found: int | None
    seconds: float
    complete: bool = False
    paths: int = 0
    method: str = ""
    remark: str = ""


def solve_task(task: Task) -> Entry:
    """Solve once, or again and again what takes little: clocks of processes have a grain."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.RLIM_INFINITY))
    result, seconds = timed(task)
    if seconds < SHORT:
        again = [timed(task)[1]]
        while sum(again) < SHORT and len(again) < MOST_RUNS:
            again.append(timed(task)[1])
        seconds = sum(again) / len(again)
    found = len(result.solutions)
    tracked = result.paths.tracked
    return Entry(found, seconds, result.complete, tracked, result.method, "; ".join(result.notes))


def timed(task: Task) -> tuple[SolveResult, float]:
    """The answer and the processor time that it took, of a system that nothing is known of yet."""
    system = make_classic(task.name).system
    begin = time.process_time()
    result = solve(system, start=task.by, threads=1)
    return result, time.process_time() - begin


def entry_of(run: TimedRun) -> Entry:
    """What is kept of a run."""
    if run.value is None:
        return Entry(None, run.seconds, remark=run.error)
    return run.value


def ask_peer(task: Task, limit: float) -> Entry:
    """What another program says."""
    answer = peer_points(task.by, make_classic(task.name).system, limit)
    found = None if answer.points is None else len(answer.points)
    return Entry(found, answer.seconds, remark=answer.remark)


class Table:
    """Entries by system and by what was asked, kept in a file."""

    def __init__(self, path: Path) -> None:
        self.path = path
        kept: dict[str, Any] = json.loads(path.read_text("utf-8")) if path.exists() else {}
        self.rows = {n: {k: Entry(**e) for k, e in row.items()} for n, row in kept.items()}

    def keep(self, task: Task, entry: Entry) -> None:
        self.rows.setdefault(task.name, {})[task.by] = entry
        document = {n: {k: asdict(e) for k, e in row.items()} for n, row in self.rows.items()}
        self.path.write_text(json.dumps(document, indent=1) + "\n", "utf-8")
        print(f"  {task.name}, {task.by}: {entry}", file=sys.stderr, flush=True)

    def row(self, name: str) -> dict[str, Entry]:
        return self.rows.get(name, {})


def ask(table: Table, names: Sequence[str], what: str, limit: float, again: bool) -> None:
    """Fill a part of the table."""

    def missing(by: str) -> list[Task]:
        return [Task(n, by) for n in names if again or by not in table.row(n)]

    def seconds(task: Task) -> float:
        chosen = table.row(task.name).get("auto")
        first, times = ENDED["peers" if what in PEERS else "starts"]
        return limit if chosen is None else min(limit, first + times * chosen.seconds)

    if what in PEERS:
        for task in missing(what):
            table.keep(task, ask_peer(task, seconds(task)))
        return

    starts = ("auto",) if what == "auto" else STARTS
    allowed = (lambda _: limit) if what == "auto" else seconds
    tasks = [task for start in starts for task in missing(start)]
    first = Task("katsura 6", "auto")
    for run in timed_runs(solve_task, tasks, limit=allowed, first=first):
        table.keep(run.task, entry_of(run))


def is_usable(entry: Entry, expected: int | None) -> bool:
    """Whether an answer of ours is complete, and right as far as that is known."""
    return entry.complete and expected in (None, entry.found)


def ratio(row: dict[str, Entry], expected: int | None) -> float:
    """The time of the chosen start, in times of the best one."""
    others = [e.seconds for k, e in row.items() if k in STARTS and is_usable(e, expected)]
    chosen = row["auto"].seconds
    return 1.0 if chosen < LEAST else chosen / max(min([chosen, *others]), LEAST)


def cell(entry: Entry | None, expected: int | None, of_peer: bool = False) -> str:
    """Seconds, what was found where that is not what is expected, or that it took too long."""
    if entry is None:
        return ""
    if entry.found is None:
        return "-" if "Error" in entry.remark else f"> {entry.seconds:.1f}"
    right = entry.found == expected if of_peer else is_usable(entry, expected)
    return f"{entry.seconds:.3g}" + ("" if right else f" ({entry.found})")


def best_start(row: dict[str, Entry], expected: int | None) -> str:
    """The start that takes the least time, and that."""
    usable = [(row[k].seconds, k) for k in STARTS if k in row and is_usable(row[k], expected)]
    return "{1} {0:.3g}".format(*min(usable)) if usable else "-"


def is_beaten(row: dict[str, Entry], expected: int | None) -> bool:
    """Whether another program gives as many zeros as there are, and takes less time."""
    right = [row[k].seconds for k in PEERS if k in row and row[k].found == expected is not None]
    return min(right, default=LEAST) < row["auto"].seconds - LEAST


def line(name: str, row: dict[str, Entry]) -> str:
    """A line of the table."""
    expected, auto = make_classic(name).count, row["auto"]
    found = "-" if auto.found is None else f"{auto.found}{'' if auto.complete else ' incomplete'}"
    known = "?" if expected is None else str(expected)
    cells = [name, known, found, str(auto.paths), cell(auto, expected)]
    cells += [best_start(row, expected), f"{ratio(row, expected):.2f}"]
    cells += [cell(row.get(peer), expected, of_peer=True) for peer in PEERS]
    return f"| {' | '.join(cells)} |"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="where entries are kept, as JSON")
    parser.add_argument("--name", action="append", help="a system, like 'katsura 8'; default: all")
    parser.add_argument("--ask", action="append", choices=ASKS, help="default: all")
    parser.add_argument("--limit", type=float, default=60.0, help="seconds for one answer")
    parser.add_argument("--least", type=float, default=0.0, help="print what takes as long")
    parser.add_argument("--again", action="store_true", help="also what is in the table")
    options = parser.parse_args()
    table, names = Table(options.table), options.name or classic_names()
    for what in options.ask or ASKS:
        ask(table, names, what, options.limit, options.again)
    head = ["system", "zeros", "found", "paths", "auto", "best start", "auto/best", *PEERS]
    print(f"| {' | '.join(head)} |\n|{'---|' * len(head)}")
    good = True
    for name in names:
        row, expected = table.row(name), make_classic(name).count
        if "auto" in row:
            if row["auto"].seconds >= options.least:
                print(line(name, row))
            good &= is_usable(row["auto"], expected) and ratio(row, expected) <= WORST
            good &= not is_beaten(row, expected)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
