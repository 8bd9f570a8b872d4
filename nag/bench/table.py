"""What ``nag bench`` measured, as text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from nag.text.table import align

if TYPE_CHECKING:
    from nag.bench.decomposition import Decomposed, PeerDecomposed
    from nag.bench.measure import Measured
    from nag.bench.models import Formulated
    from nag.bench.peers import Peer
    from nag.bench.step_parts import StepCost


def table(
    rows: list[Measured], peers: dict[str, dict[str, Peer]], programs: list[str], rate: float
) -> list[str]:
    """The benchmarks as aligned lines; times in seconds, those of a step in microseconds."""
    head = ["system", "solutions", "known", "start", "paths", "steps/path", "solve", "2 threads"]
    head += ["process", "us/step", "bound"]
    head += [cell for p in programs for cell in (f"{p} found", f"{p} solve", f"{p} process")]
    head += [f"x {p}" for p in programs]
    lines = [head]
    for row in rows:
        cells = [
            row.case,
            str(row.solutions) + ("" if row.complete else " incomplete"),
            "-" if row.expected is None else str(row.expected),
            row.start,
            str(row.paths),
            f"{row.steps / max(row.paths, 1):.0f}",
            f"{row.seconds:.4f}",
            f"{row.two_threads:.4f}",
            f"{row.process:.2f}",
            f"{row.microseconds:.2f}",
            f"{row.bound:.2f}",
        ]
        found = peers.get(row.case, {})
        for p in programs:
            peer = found[p]
            seconds = "-" if peer.seconds is None else f"{peer.seconds:.3f}"
            cells += [str(peer.solutions or peer.remark), seconds, f"{peer.process:.2f}"]
        for p in programs:
            reference = found[p].seconds or found[p].process
            cells.append(f"{reference / row.seconds:.0f}" if found[p].solutions else "-")
        lines.append(cells)
    text = align(lines, {0, 3})
    text += [
        "",
        "solve: seconds, warm, one thread; process: a whole process; bound: microseconds that a",
        f"step's operations take at {rate / 1e9:.1f} Gflop/s, measured; x: how many times as long",
        "the other program solves (its whole process where it does not say).",
    ]
    wrong = [row.case for row in rows if not row.right]
    if wrong:
        text.append(f"WRONG: {', '.join(wrong)}")
    return text


def step_table(costs: list[StepCost], rate: float) -> list[str]:
    """The parts of steps as aligned lines, times in microseconds."""
    lines = [["system", "part", "operations", "bound", "takes", "x"]]
    for cost in costs:
        flops = sum(part.flops for part in cost.parts)
        rows = [("a step", flops, cost.microseconds)]
        rows += [(part.name, part.flops, part.microseconds) for part in cost.parts]
        rows.append(("between them", 0, cost.unexplained))
        for k, (name, count, takes) in enumerate(rows):
            bound = 1e6 * count / rate
            ratio = f"{takes / bound:.2f}" if count else "-"
            cells = [str(count) if count else "-", f"{bound:.3f}" if count else "-"]
            lines.append(["" if k else cost.case, name, *cells, f"{takes:.3f}", ratio])
    return [
        *align(lines, {0, 1}),
        "",
        f"bound: microseconds that the operations take at {rate / 1e9:.1f} Gflop/s, measured by a",
        "product of matrices; takes: of the processor, in doubles, of one path of eight that are",
        "tracked at once. values: of the equations, twice; linear systems: two corrections and the",
        "coefficients of the path's series; between them: series that are kept, paths that are",
        "judged one by one and wait for others.",
    ]


def decomposition_table(rows: list[Decomposed], peers: dict[str, PeerDecomposed]) -> list[str]:
    """Decompositions as aligned lines, times in seconds of the processor."""
    head = ["system", "variables", "components", "dimension", "paths", "failed", "answer"]
    head.append("seconds")
    lines = [[*head, *(["M2 seconds", "x", "M2 answer"] if peers else [])]]
    for row in rows:
        answer = "right" if row.right else "WRONG" if row.complete else "incomplete"
        cells = [row.case, row.variables, row.components, row.dimension, row.paths, row.failed]
        cells.append(answer)
        cells.append(f"{row.seconds:.4f}")
        if peers:
            peer = peers[row.case]
            if peer.seconds is None:
                cells += ["-", f"> {peer.process / row.seconds:.0f}", peer.remark]
            else:
                cells += [f"{peer.seconds:.3f}", f"{peer.seconds / row.seconds:.1f}"]
                cells.append("right" if peer.right else peer.remark)
        lines.append([str(cell) for cell in cells])
    left = {0, 6, 10} if peers else {0, 6}
    text = [*align(lines, left), "", "seconds: processor time, warm, one thread, best of five."]
    if peers:
        text.append(
            "x: how many times as long numericalIrreducibleDecomposition of M2 takes, once."
        )
    return text


def models_table(rows: list[Formulated]) -> list[str]:
    """Mechanisms in all formulations as aligned lines, times in seconds of the processor."""
    from nag.report.model import large_number

    head = ["mechanism", "formulation", "variables", "equations", "Bezout", "at most", "paths"]
    lines = [[*head, "seconds", "dimension x degree: count", ""]]
    previous = ""
    for row in rows:
        numbers = [row.variables, row.equations, row.bezout, row.estimate]
        cells = [row.case if row.case != previous else "", row.formulation]
        cells += [large_number(number) for number in numbers]
        cells.append("-" if row.paths is None else str(row.paths))
        cells.append("-" if row.seconds is None else f"{row.seconds:.3f}")
        cells.append(", ".join(f"{d} x {degree}: {count}" for d, degree, count in row.components))
        cells.append("taken" if row.taken else "")
        lines.append(cells)
        previous = row.case
    return [
        *align(lines, {0, 1, 8, 9}),
        "",
        "at most: paths that equation by equation are tracked, if no witness point is lost; -: not",
        "tracked, or not in time; seconds: processor time, warm, one thread, model included.",
    ]


def growth_table(rows: list[Decomposed]) -> list[str]:
    """Chains as aligned lines, and how time and paths grow."""
    from nag.bench.decomposition import growth_text

    lines = decomposition_table(rows, {})[:-1]
    for quantity in ("seconds", "paths"):
        lines.append(f"{quantity}: {growth_text(rows, quantity)}")
    return lines
