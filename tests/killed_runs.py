"""Kill long runs at random moments, and see that each goes on to the answer of one that was not.

    python tests/killed_runs.py [--commands solve,sweep] [--count 10] [--seed 0]

Each command is run once without a ledger. Then it is run with ``--resume`` and all its processes
are killed at a random moment, again and again with the same ledger, until a run ends by itself
before its moment has come; then with an empty ledger. So it goes on until it was killed ``--count``
times, and a last run ends. What is written as JSON must be of the same bytes each time, what is
printed the same but for seconds, no file may be there in part after a kill, and no block of the
ledger may be damaged. Prints a line a kill and a line a command; exit status 1 if anything differs.
"""

from __future__ import annotations

import argparse
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from nag.bench.path_costs import katsura

ROOT = Path(__file__).resolve().parents[1]
BENCHMARKS = ROOT / "cases" / "benchmarks"
CURVE = """\
title = "A curve of degree 36 with a parameter"
kind = "system"
variables = ["x", "y", "z"]
equations = [
  "x^6 + y^5*z + c*z^4 - x*y*z + 1",
  "y^6 - 2*z^6 + x^5*y - c*x^2*z^2 + y - 3",
]

[parameters]
c = 1
"""
_SECONDS = re.compile(r"\d+(\.\d+)? s\b")


@dataclass
class Outcome:
    """What came of a command that was killed.

    Attributes:
        kills: how many times it was, ``done``: how many runs ended by themselves.
        faults: what was not as it should be.
    """

    kills: int = 0
    done: int = 0
    faults: list[str] = field(default_factory=list)


def _katsura(folder: Path, n: int) -> str:
    file = folder / f"katsura-{n}.txt"
    file.write_text("\n".join(katsura(n)) + "\n")
    return str(file)


def _solve(folder: Path) -> list[str]:
    """32,768 paths, and a certificate of their ends."""
    return ["solve", _katsura(folder, 15), "--certify", "--threads", "1"]


def _nine_point(folder: Path) -> list[str]:
    """Monodromy, then paths between members of a family."""
    return ["solve", str(BENCHMARKS / "nine-point.toml"), "--threads", "1"]


def _cyclic(folder: Path) -> list[str]:
    """Curves and points, with symmetries."""
    return ["decompose", str(BENCHMARKS / "cyclic-8.toml"), "--threads", "1"]


def _sweep(folder: Path) -> list[str]:
    """A curve, followed to many values of a parameter."""
    file = folder / "curve.toml"
    file.write_text(CURVE)
    return ["decompose", str(file), "--sweep", "c=1/3:2:101", "--threads", "1"]


def _certify(folder: Path) -> list[str]:
    """A certificate of 32,768 solutions that are read from a file."""
    export = folder / "export.json"
    solve = ["solve", _katsura(folder, 15), "--threads", "1", "--json", str(export)]
    subprocess.run(_words(solve), cwd=ROOT, check=True, capture_output=True)
    return ["certify", str(export)]


COMMANDS: dict[str, Callable[[Path], list[str]]] = {
    "solve": _solve,
    "nine-point": _nine_point,
    "cyclic": _cyclic,
    "sweep": _sweep,
    "certify": _certify,
}


def _words(command: Sequence[str]) -> list[str]:
    return [sys.executable, "-m", "nag", *command, "--quiet"]


def without_seconds(text: str) -> str:
    """What was printed, but for how long it took, and where lines were broken for that."""
    return " ".join(_SECONDS.sub("SECONDS", text).split())


def kill_often(name: str, count: int, seed: int, folder: Path) -> Outcome:
    """Run a command, kill it ``count`` times, and compare what it writes in the end."""
    outcome, chance = Outcome(), random.Random(f"{name} {seed}")
    command = COMMANDS[name](folder)
    plain, answer, ledger = (folder / n for n in ("plain.json", "answer.json", "ledger"))
    began = time.monotonic()
    first = subprocess.run(
        [*_words(command), "--json", str(plain)], cwd=ROOT, capture_output=True, text=True
    )
    took = time.monotonic() - began
    expected = plain.read_bytes()
    print(f"{name}: {took:.1f} s, {len(expected)} bytes, status {first.returncode}", flush=True)
    words = [*_words(command), "--json", str(answer), "--resume", str(ledger)]
    begun = False
    while begun or outcome.kills < count:
        moment = chance.uniform(0, took) if outcome.kills < count else None
        began = time.monotonic()
        with tempfile.TemporaryFile("w+") as said, tempfile.TemporaryFile("w+") as complained:
            process = subprocess.Popen(
                words, cwd=ROOT, stdout=said, stderr=complained, start_new_session=True
            )
            try:
                process.wait(moment)
                status = process.returncode
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                status = None
            spent = time.monotonic() - began
            said.seek(0)
            complained.seek(0)
            printed, errors = said.read(), complained.read()
        whole = answer.read_bytes() if answer.exists() else None
        blocks = len(list(ledger.glob("*.block")))
        if whole not in (None, expected):
            outcome.faults.append(f"after kill {outcome.kills}: {len(whole)} bytes of JSON differ")
        if "damaged" in errors or "Traceback" in errors:
            outcome.faults.append(f"after kill {outcome.kills}: {errors.strip()}")
        if status is None:
            outcome.kills, begun = outcome.kills + 1, True
            print(f"  killed after {spent:.1f} s with {blocks} blocks", flush=True)
            continue
        # What else the machine does may have made the first run slow.
        took = min(took, spent) if not begun else took
        outcome.done, begun = outcome.done + 1, False
        if whole is None or status != first.returncode:
            outcome.faults.append(f"status {status}, not {first.returncode}: {errors.strip()}")
        if without_seconds(printed) != without_seconds(first.stdout):
            outcome.faults.append(f"other words are printed after kill {outcome.kills}")
        print(f"  ended after {spent:.1f} s with {blocks} blocks", flush=True)
        shutil.rmtree(ledger, ignore_errors=True)
        answer.unlink(missing_ok=True)
    return outcome


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--commands", default=",".join(COMMANDS))
    parser.add_argument("--count", type=int, default=10, help="kills of each command")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    wrong = 0
    for name in options.commands.split(","):
        with tempfile.TemporaryDirectory() as folder:
            outcome = kill_often(name, options.count, options.seed, Path(folder))
        wrong += len(outcome.faults)
        print(
            f"{name}: {outcome.kills} kills, {outcome.done} runs ended, "
            f"{len(outcome.faults)} faults",
            flush=True,
        )
        for fault in outcome.faults:
            print(f"  {fault}", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
