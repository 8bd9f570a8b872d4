"""Benchmarks of decompositions: their times, beside Macaulay2's, and how they grow."""

from __future__ import annotations

import json
import re
import shutil
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.bench.chains import Chain
from nag.bench.measure import LONG, RUNS
from nag.bench.peers import in_macaulay2
from nag.decomposition.decompose import decompose
from nag.errors import NagError
from nag.files.cases import Truth
from nag.mechanism.problem import problem_of
from nag.report.agreement import AgreementKind, compare


@dataclass(frozen=True)
class Decomposed:
    """One system decomposed.

    Attributes:
        case: name of the system.
        variables: of the system.
        components: number of components found; dimension: the largest of theirs.
        paths: paths tracked; failed: how many of them failed.
        seconds: of processor time, warm, one thread, best of a few.
        complete: as in the decomposition; right: complete, and as it is known to be.
    """

    case: str
    variables: int
    components: int
    dimension: int
    paths: int
    failed: int
    seconds: float
    complete: bool
    right: bool

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return asdict(self)


@dataclass(frozen=True)
class PeerDecomposed:
    """What Macaulay2's ``numericalIrreducibleDecomposition`` took.

    Attributes:
        seconds: of processor time for the call alone, or None; process: of the whole process.
        right: whether its components are the known ones, None without an answer.
        remark: what it found that is not right, or why there is no answer.
    """

    seconds: float | None
    process: float
    right: bool | None
    remark: str = ""

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return asdict(self)


def measure_decomposition(
    name: str,
    system: PolynomialSystem,
    truth: Sequence[Truth],
    symmetries: Sequence[SignedPermutation] = (),
    formulation: str | None = None,
    seed: int = 0,
) -> Decomposed:
    """Decompose ``system`` warm, on one thread, and compare with what is known."""
    best, runs = float("inf"), 0
    # The first run compiles what is not compiled yet, and counts only if it is a long one.
    while runs <= RUNS:
        begin = time.process_time()
        answer = decompose(system, seed=seed, symmetries=symmetries)
        seconds = time.process_time() - begin
        best = min(best, seconds) if runs else best
        runs += 1
        if runs > 1 and seconds > LONG:
            break
    agreement = compare(answer, truth, formulation)
    agrees = agreement is None or (
        agreement.verdict is AgreementKind.AGREES and not agreement.unlisted
    )
    return Decomposed(
        case=name,
        variables=system.n,
        components=sum(c.orbit for c in answer.components),
        dimension=answer.dimension,
        paths=answer.paths.tracked,
        failed=answer.paths.failed,
        seconds=best,
        complete=answer.complete,
        right=agrees and answer.complete,
    )


def macaulay2_installed() -> bool:
    return shutil.which("M2") is not None


def macaulay2(system: PolynomialSystem, truth: Sequence[Truth], limit: float) -> PeerDecomposed:
    """Decompose ``system`` with Macaulay2 on one thread, for at most ``limit`` seconds."""
    rest = (
        "t = cpuTime();\n"
        "S = numericalIrreducibleDecomposition ideal F;\n"
        'print("result " | toString(cpuTime() - t));\n'
        'for d in keys S do for w in S#d do print("component " | toString d | " " '
        "| toString(degree w));\n"
    )
    process, output = in_macaulay2(system, rest, limit)
    if output is None:
        return PeerDecomposed(None, process, None, f"no answer in {limit:.0f} s")
    result = re.search(r"result (\S+)", output)
    if not result:
        return PeerDecomposed(None, process, None, "no answer")
    found = Counter((int(d), int(g)) for d, g in re.findall(r"component (\d+) (\d+)", output))
    known: Counter[tuple[int, int]] = Counter()
    for item in truth:
        known[item.dimension, item.degree] += item.count
    right = not known or found == known
    listed = ", ".join(f"{n} x ({d}, {g})" for (d, g), n in sorted(found.items()))
    remark = "" if right else f"found {listed or 'nothing'} (dimension, degree)"
    return PeerDecomposed(float(result[1]), process, right, remark)


def growth(chain: Chain, longest: int, seed: int = 0) -> list[Decomposed]:
    """Chains of 1 to ``longest`` cells, decomposed."""
    rows = []
    for n in range(1, longest + 1):
        problem = problem_of(chain.make(n))
        row = measure_decomposition(
            f"chain of {n}",
            problem.system,
            chain.truth(n),
            problem.symmetries,
            problem.formulation,
            seed,
        )
        rows.append(row)
    return rows


def cell_factor(rows: Sequence[Decomposed], quantity: str) -> float:
    """What one cell more multiplies ``quantity`` by, by least squares of its logarithm.

    Chains of which the quantity is zero are left out.

    Raises:
        ValueError: if fewer than two are left.
    """
    import numpy as np

    known = [(n, getattr(row, quantity)) for n, row in enumerate(rows, 1)]
    known = [(n, value) for n, value in known if value > 0]
    if len(known) < 2:
        raise NagError("a factor needs two chains at least")
    cells, values = np.array(known, dtype=float).T
    return float(np.exp(np.polyfit(cells, np.log(values), 1)[0]))


def growth_exponent(rows: Sequence[Decomposed], quantity: str) -> float:
    """Slope of ``quantity`` against the number of components, both logarithmic, by least squares.

    Raises:
        ValueError: if there are fewer than two rows.
    """
    import numpy as np

    if len(rows) < 2:
        raise NagError("a slope needs two chains at least")
    x = np.log([row.components for row in rows])
    y = np.log([getattr(row, quantity) for row in rows])
    return float(np.polyfit(x, y, 1)[0])


def growth_chart(rows: Sequence[Decomposed], path: str) -> None:
    """Seconds and paths against the number of cells, as an image; needs matplotlib."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 3.2), layout="constrained")
    cells = range(1, len(rows) + 1)
    for axes, quantity, label in zip(
        figure.subplots(1, 2), ("seconds", "paths"), ("seconds", "paths tracked"), strict=True
    ):
        axes.semilogy(cells, [getattr(row, quantity) or None for row in rows], "o-", color="C0")
        axes.set_title(f"{label}: {growth_text(rows, quantity)}", fontsize=10)
        axes.set_xlabel("cells")
        axes.set_ylabel(label)
        axes.set_xticks(cells)
        axes.grid(True, alpha=0.3)
    figure.savefig(path, dpi=150)


def growth_text(rows: Sequence[Decomposed], quantity: str) -> str:
    """How a quantity grows with the cells, and with the components where there are more of them."""
    try:
        text = f"times {cell_factor(rows, quantity):.2f} for each cell"
    except NagError:
        return "none for most chains"
    if all(getattr(row, quantity) for row in rows) and len({row.components for row in rows}) > 1:
        text += f", components^{growth_exponent(rows, quantity):.2f}"
    return text


def as_json(rows: Sequence[Decomposed], peers: dict[str, PeerDecomposed]) -> str:
    """The whole table as JSON text."""
    documents = [
        row.document() | ({"M2": peers[row.case].document()} if row.case in peers else {})
        for row in rows
    ]
    return (
        json.dumps({"format": "nag-bench-decompose", "version": 1, "systems": documents}, indent=2)
        + "\n"
    )
