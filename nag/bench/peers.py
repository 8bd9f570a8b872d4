"""The same systems in other programs: Macaulay2's native engine and PHCpack's blackbox solver."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from nag.algebra.system import PolynomialSystem

PROGRAMS = {"M2": "Macaulay2, solveSystem", "phc": "PHCpack, phc -b"}


@dataclass(frozen=True)
class Peer:
    """What another program took.

    Attributes:
        program: ``"M2"`` or ``"phc"``.
        seconds: for solving alone, as the program itself says it, or None.
        process: for the whole process.
        solutions: how many solutions it reports, or None.
        remark: what went wrong; empty if nothing did.
    """

    program: str
    seconds: float | None
    process: float
    solutions: int | None
    remark: str = ""

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return asdict(self)


def installed_programs() -> list[str]:
    """The programs that are there."""
    return [name for name in PROGRAMS if shutil.which(name)]


def plain_texts(system: PolynomialSystem) -> tuple[list[str], list[str]]:
    """Variables renamed so that every program reads them, and the equations in them."""
    names = [f"x{chr(97 + i // 26)}{chr(97 + i % 26)}" for i in range(system.n)]
    return names, [f.text(names) for f in system.polynomials]


def run_peer(program: str, system: PolynomialSystem, limit: float) -> Peer:
    """Solve ``system`` with ``program`` on one thread, for at most ``limit`` seconds."""
    return {"M2": _macaulay2, "phc": _phcpack}[program](system, limit)


def call(
    command: list[str], folder: str, limit: float, given: str | None = None
) -> tuple[float, str | None]:
    """Seconds that a command took and what it printed, None if it ran into the limit.

    Args:
        given: what it reads from its standard input.
    """
    begin = time.perf_counter()
    try:
        done = subprocess.run(
            command,
            cwd=folder,
            capture_output=True,
            text=True,
            timeout=limit,
            check=False,
            input=given,
        )
    except subprocess.TimeoutExpired:
        return time.perf_counter() - begin, None
    return time.perf_counter() - begin, done.stdout


def in_macaulay2(system: PolynomialSystem, rest: str, limit: float) -> tuple[float, str | None]:
    """Seconds of a Macaulay2 process, and what it printed; None if it took too long.

    Args:
        rest: what is done with the equations ``F`` over the ring ``R``.
    """
    names, equations = plain_texts(system)
    script = (
        'needsPackage "NumericalAlgebraicGeometry";\n'
        f"R = CC_53[{', '.join(names)}];\n"
        f"F = {{{', '.join(equations)}}};\n"
        f"{rest}"
        "exit 0\n"
    )
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "system.m2").write_text(script, "utf-8")
        return call(["M2", "--script", "system.m2"], folder, limit)


def in_phcpack(
    system: PolynomialSystem, options: Sequence[str], limit: float, given: str | None = None
) -> tuple[float, tuple[str, str] | None]:
    """Seconds of a PHCpack process, and what it wrote: behind the system, and as its answer.

    None if it took too long.
    """
    _, texts = plain_texts(system)
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / name for name in ("system", "answer")]
        equations = "".join(f"{t};\n" for t in texts)
        files[0].write_text(f"{len(texts)} {system.n}\n{equations}", "utf-8")
        process, output = call(["phc", *options, "system", "answer"], folder, limit, given)
        if output is None:
            return process, None
        own, answer = (f.read_text("utf-8", "replace") if f.exists() else "" for f in files)
        return process, (own, answer)


def in_bertini(system: PolynomialSystem, work: str, limit: float) -> str | None:
    """What Bertini 2, a package of Python, prints of its work with ``system``; None if too long."""
    names, texts = plain_texts(system)
    functions = [f"f{i}" for i in range(len(texts))]
    equations = " ".join(f"{f} = {t};" for f, t in zip(functions, texts, strict=True))
    source = f"variable_group {', '.join(names)}; function {', '.join(functions)}; {equations}"
    script = f"import time, bertini\nsystem = bertini.parse.system({source!r})\n{work}"
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "work.py").write_text(script, "utf-8")
        return call([sys.executable, "work.py"], folder, limit)[1]


def _macaulay2(system: PolynomialSystem, limit: float) -> Peer:
    rest = (
        "t = elapsedTiming (S = solveSystem F);\n"
        'print("result " | toString(t#0) | " " | toString(#S));\n'
    )
    process, output = in_macaulay2(system, rest, limit)
    if output is None:
        return Peer("M2", None, process, None, f"no answer in {limit:.0f} s")
    found = re.search(r"result (\S+) (\d+)", output)
    if not found:
        return Peer("M2", None, process, None, "no answer")
    return Peer("M2", float(found[1]), process, int(found[2]))


def _phcpack(system: PolynomialSystem, limit: float) -> Peer:
    process, written = in_phcpack(system, ("-b", "-0"), limit)
    if written is None:
        return Peer("phc", None, process, None, f"no answer in {limit:.0f} s")
    found = re.findall(r"THE SOLUTIONS *:?\s*\n\s*(\d+) +\d+", "".join(written))
    solutions = int(found[-1]) if found else None
    return Peer("phc", None, process, solutions, "" if found else "no answer")
