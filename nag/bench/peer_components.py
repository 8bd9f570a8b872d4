"""Components that other programs find: witness points, each on the program's own slice.

Macaulay2's ``numericalIrreducibleDecomposition`` and PHCpack's ``phc -B``; Bertini 2 is asked too,
and says that it cannot yet. Programs know nothing of polynomials that must not vanish: components
inside their zero sets are left out.
"""

from __future__ import annotations

import importlib.util
import re
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.bench.peer_points import bertini_source, children_seconds, coordinates, pairs, said
from nag.bench.peers import call, installed, plain_texts
from nag.bench.reference import NEAR


@dataclass(frozen=True, eq=False)
class PeerComponent:
    """A component of a program's: points, shape ``(k, n)``, on a slice, rows on ``(1, x)``."""

    points: np.ndarray
    rows: np.ndarray


@dataclass(frozen=True, eq=False)
class PeerComponents:
    """What a program found.

    Attributes:
        seconds: processor time, as the program itself says it, or of its whole process.
        components: None without an answer; remark: why there is none.
    """

    seconds: float
    components: tuple[PeerComponent, ...] | None
    remark: str = ""


Answer = tuple[float | None, list[PeerComponent]] | str


def decomposing_programs() -> list[str]:
    """The programs that are there."""
    return [*installed(), *(["bertini2"] if importlib.util.find_spec("bertini") else [])]


def peer_components(
    program: str, system: PolynomialSystem, limit: float, seed: int
) -> PeerComponents:
    """Decompose ``system`` with a program, for at most ``limit`` seconds."""
    run = {"M2": _macaulay2, "phc": _phcpack, "bertini2": _bertini}[program]
    with tempfile.TemporaryDirectory() as folder:
        before = children_seconds()
        output = run(system, Path(folder), limit, seed)
        seconds = children_seconds() - before
    if isinstance(output, str):
        return PeerComponents(seconds, None, output)
    told, found = output
    return PeerComponents(
        seconds if told is None else told, tuple(c for c in found if not _excluded(system, c))
    )


def _excluded(system: PolynomialSystem, component: PeerComponent) -> bool:
    if not system.nonzero:
        return False
    values = Evaluator.of(system.nonzero, system.n).residuals(component.points)
    return bool((values < NEAR).all(axis=0).any())


def _macaulay2(system: PolynomialSystem, folder: Path, limit: float, seed: int) -> Answer:
    names, texts = plain_texts(system)
    script = (
        'needsPackage "NumericalAlgebraicGeometry";\n'
        f"setRandomSeed {seed};\n"
        f"R = CC_53[{', '.join(names)}];\n"
        f"F = {{{', '.join(texts)}}};\n"
        "t = cpuTime();\n"
        "S = numericalIrreducibleDecomposition ideal F;\n"
        'print("seconds " | toString(cpuTime() - t));\n'
        "full = x -> toExternalString(1.0 * x);\n"
        'tell = z -> print("value " | full realPart z | " " | full imaginaryPart z);\n'
        "for d in keys S do for w in S#d do (\n"
        '  print("component " | toString d);\n'
        "  for l in slice w do for m in prepend(1_R, gens R) do tell coefficient(m, l);\n"
        "  for p in points w do for z in coordinates p do tell z);\n"
        "exit 0\n"
    )
    (folder / "system.m2").write_text(script, "utf-8")
    _, output = call(["M2", "--script", "system.m2"], str(folder), limit)
    if output is None:
        return f"no answer in {limit:.0f} s"
    if said(output) is None:
        return "no answer"
    head, *blocks = re.split(r"^component (\d+)$", re.sub("p53", "", output), flags=re.MULTILINE)
    n = system.n
    found = []
    for dimension, block in zip(map(int, blocks[::2]), blocks[1::2], strict=True):
        numbers = np.array(pairs(block), dtype=complex)
        split = dimension * (1 + n)
        rows, points = numbers[:split].reshape(-1, 1 + n), numbers[split:].reshape(-1, n)
        found.append(PeerComponent(points, rows))
    return said(head), found


def _phcpack(system: PolynomialSystem, folder: Path, limit: float, seed: int) -> Answer:
    names, texts = plain_texts(system)
    head = f"{len(texts)} {system.n}\n"
    (folder / "system").write_text(head + "".join(f"{t};\n" for t in texts), "utf-8")
    # It asks for the largest dimension, and may say that equations are left over.
    asked = f"{system.n - 1}\n" + "y\n" * 4
    command = ["phc", "-B", f"-0{1 + seed}", "system", "answer"]
    _, output = call(command, str(folder), limit, asked)
    if output is None:
        return f"no answer in {limit:.0f} s"
    answer = folder / "answer"
    text = answer.read_text("utf-8", "replace") if answer.exists() else ""
    if "degrees of factors" not in text:
        return "no answer"
    return None, list(_factors(text, names))


def _factors(text: str, names: Sequence[str]) -> Iterator[PeerComponent]:
    """The factors that ``phc -B`` lists, each with its equations, slices last, and its points."""
    parts = re.split(r"^Writing the factors of dimension (\d+)", text, flags=re.MULTILINE)
    for dimension, part in zip(map(int, parts[1::2]), parts[2::2], strict=True):
        for block in re.split(r"^FACTOR \d+ :", part, flags=re.MULTILINE)[1:]:
            equations, _, solutions = block.partition("THE SOLUTIONS")
            slices = equations.split(";")[:-1][-dimension:] if dimension else []
            points = []
            for one in re.split(r"^solution \d+ :", solutions, flags=re.MULTILINE)[1:]:
                values = dict(coordinates(one.partition("== err")[0]))
                points.append([values[name] for name in names])
            rows = [_row(each, names) for each in slices]
            n = len(names)
            yield PeerComponent(
                np.array(points, dtype=complex).reshape(-1, n),
                np.array(rows, dtype=complex).reshape(-1, 1 + n),
            )


NUMBER = r"[-+]?\d\.\d+E[-+]\d+"
TERM = re.compile(
    rf"([-+]?)\s*(?:\(\s*({NUMBER}) ([-+]) ({NUMBER})\*i\)|({NUMBER}|[-+]?\d+))?(?:\*?([a-z]\w*))?"
)


def _row(text: str, names: Sequence[str]) -> list[complex]:
    """A linear polynomial that ``phc`` wrote, on ``(1, x)``; variables of its own are zero."""
    row = [0j] * (1 + len(names))
    for line in text.split("\n"):
        found = TERM.fullmatch(line.strip())
        if found is None or not line.strip():
            continue
        sign, real, between, imaginary, plain, name = found.groups()
        value = complex(float(plain)) if plain else 1 + 0j
        if real is not None:
            value = complex(float(real), float(between + imaginary))
        value = -value if sign == "-" else value
        if name is None:
            row[0] += value
        elif name in names:
            row[1 + names.index(name)] += value
    return row


def _bertini(system: PolynomialSystem, folder: Path, limit: float, seed: int) -> Answer:
    script = (
        "import bertini\n"
        f"system = bertini.parse.system({bertini_source(system)!r})\n"
        "try:\n"
        "    bertini.nag_algorithm.NIDCauchyAdaptivePrecision(system).solve()\n"
        "except RuntimeError as error:\n"
        "    print('refused', error)\n"
    )
    (folder / "decompose.py").write_text(script, "utf-8")
    _, output = call([sys.executable, "decompose.py"], str(folder), limit)
    if output is None:
        return f"no answer in {limit:.0f} s"
    refused = re.search(r"^refused (.+)$", output, re.MULTILINE)
    return f"no answer: {refused[1]}" if refused else "no answer that can be read"
