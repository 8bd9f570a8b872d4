"""Components that other programs find: witness points, each on the program's own slice.

Macaulay2's ``numericalIrreducibleDecomposition`` and PHCpack's ``phc -B``; Bertini 2 is asked too,
and says that it cannot yet. Programs know nothing of polynomials that must not vanish: components
inside their zero sets are left out.
"""

from __future__ import annotations

import importlib.util
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.bench.peer_points import (
    children_seconds,
    pairs,
    said,
    solutions,
    told_by_macaulay2,
)
from nag.bench.peers import in_bertini, in_phcpack, installed_programs, plain_texts
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


TimedComponents = tuple[float | None, list[PeerComponent]] | str


def decomposing_programs() -> list[str]:
    """The programs that are there."""
    return [*installed_programs(), *(["bertini2"] if importlib.util.find_spec("bertini") else [])]


def peer_components(
    program: str, system: PolynomialSystem, limit: float, seed: int
) -> PeerComponents:
    """Decompose ``system`` with a program, for at most ``limit`` seconds."""
    run = {"M2": _macaulay2, "phc": _phcpack, "bertini2": _bertini}[program]
    before = children_seconds()
    output = run(system, limit, seed)
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


def _macaulay2(system: PolynomialSystem, limit: float, seed: int) -> TimedComponents:
    work = f"setRandomSeed {seed};\nS = numericalIrreducibleDecomposition ideal F;\n"
    listed = (
        "for d in keys S do for w in S#d do (\n"
        '  print("component " | toString d);\n'
        "  for l in slice w do for m in prepend(1_R, gens R) do tell coefficient(m, l);\n"
        "  for p in points w do for z in coordinates p do tell z);\n"
    )
    output = told_by_macaulay2(system, work, listed, limit)
    if output is None:
        return f"no answer in {limit:.0f} s"
    if said(output) is None:
        return "no answer"
    head, *blocks = re.split(r"^component (\d+)$", output, flags=re.MULTILINE)
    n = system.n
    found = []
    for dimension, block in zip(map(int, blocks[::2]), blocks[1::2], strict=True):
        numbers = np.array(pairs(block), dtype=complex)
        split = dimension * (1 + n)
        rows, points = numbers[:split].reshape(-1, 1 + n), numbers[split:].reshape(-1, n)
        found.append(PeerComponent(points, rows))
    return said(head), found


def _phcpack(system: PolynomialSystem, limit: float, seed: int) -> TimedComponents:
    # It asks for the largest dimension, and may say that equations are left over.
    asked = f"{system.n - 1}\n" + "y\n" * 4
    _, written = in_phcpack(system, ("-B", f"-0{1 + seed}"), limit, asked)
    if written is None:
        return f"no answer in {limit:.0f} s"
    text = written[1]
    if "degrees of factors" not in text:
        return "no answer"
    return None, list(_factors(text, plain_texts(system)[0]))


def _factors(text: str, names: Sequence[str]) -> Iterator[PeerComponent]:
    """The factors that ``phc -B`` lists, each with its equations, slices last, and its points."""
    parts = re.split(r"^Writing the factors of dimension (\d+)", text, flags=re.MULTILINE)
    for dimension, part in zip(map(int, parts[1::2]), parts[2::2], strict=True):
        for block in re.split(r"^FACTOR \d+ :", part, flags=re.MULTILINE)[1:]:
            equations, _, listed = block.partition("THE SOLUTIONS")
            slices = equations.split(";")[:-1][-dimension:] if dimension else []
            points = [[values[name] for name in names] for values in solutions(listed)]
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


def _bertini(system: PolynomialSystem, limit: float, _seed: int) -> TimedComponents:
    work = (
        "try:\n"
        "    bertini.nag_algorithm.NIDCauchyAdaptivePrecision(system).solve()\n"
        "except RuntimeError as error:\n"
        "    print('refused', error)\n"
    )
    output = in_bertini(system, work, limit)
    if output is None:
        return f"no answer in {limit:.0f} s"
    refused = re.search(r"^refused (.+)$", output, re.MULTILINE)
    return f"no answer: {refused[1]}" if refused else "no answer that can be read"
