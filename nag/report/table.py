"""Results as text for a terminal."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable, Sequence

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.report.agreement import in_words, kinds
from nag.witness.witness import Decomposition, PathCounts, Status, WitnessSet

# Length of a line; longer texts are wrapped.
LINE = 100

# Wider multidegrees are left to the JSON export.
WIDEST_MULTIDEGREE = 32


def printable(text: str) -> str:
    """``text`` on one line, with everything that could steer a terminal escaped."""
    return "".join(
        c if c.isprintable() else c.encode("unicode_escape", "backslashreplace").decode()
        for c in text
    )


def align(rows: Sequence[Sequence[str]], left: Iterable[int] = ()) -> list[str]:
    """Rows of cells as lines with aligned columns, right-aligned except those in ``left``."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    left = set(left)
    return [
        "  ".join(
            cell.ljust(width) if i in left else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


def magnitude(value: float) -> str:
    """A small positive number to two digits: ``3.1e-16``; ``?`` if it is not known."""
    return f"{value:.1e}" if math.isfinite(value) else "?"


def multidegree_text(multidegree: np.ndarray | None) -> str:
    """A multidegree in the groups' order: ``(1, 2)`` for a curve, entries ``12: 1`` above.

    Above dimension 1 only entries with ascending groups are given, the others are equal to them.
    """
    if multidegree is None or multidegree.ndim == 0:
        return "-"
    if multidegree.ndim == 1:
        text = "(" + ", ".join(map(str, multidegree.tolist())) + ")"
    else:
        text = ", ".join(
            f"{'.'.join(str(i + 1) for i in index)}: {multidegree[tuple(index)]}"
            for index in np.argwhere(multidegree).tolist()
            if index == sorted(index)
        )
    return text if len(text) <= WIDEST_MULTIDEGREE else "see the export"


def system_line(system: PolynomialSystem) -> str:
    """Variables, equations and degrees in one line."""
    degrees: dict[int, int] = {}
    for degree in sorted(system.degrees):
        degrees[degree] = degrees.get(degree, 0) + 1
    listed = ", ".join(f"{n} of degree {d}" for d, n in degrees.items())
    names = ", ".join(system.variables)
    text = (
        f"{_number(system.n, 'variable')}{f' ({names})' if 0 < len(names) <= 60 else ''}, "
        f"{_number(len(system.polynomials), 'equation')}{f': {listed}' if listed else ''}"
    )
    return text if system.exact else f"{text}; not all coefficients are rational"


def _number(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"


def title_line(decomposition: Decomposition) -> str:
    """Like components counted together: "9 components of dimension 2, degree 4"."""
    text = in_words(kinds(decomposition.components))
    undecided = sum(c.orbit for c in decomposition.components if c.status is not Status.IRREDUCIBLE)
    return f"{text} ({undecided} undecided)" if undecided else text


def _like(component: WitnessSet) -> tuple[object, ...]:
    return (
        component.dimension,
        component.degree,
        multidegree_text(component.multidegree),
        component.multiplicity,
        str(component.status),
        component.precision,
    )


def component_table(decomposition: Decomposition) -> list[str]:
    """One row for components that are alike, with the worst residual and accuracy among them."""
    if not decomposition.components:
        return []
    alike: dict[tuple[object, ...], list[WitnessSet]] = {}
    for component in decomposition.components:
        alike.setdefault(_like(component), []).append(component)
    rows = [_row(group) for group in alike.values()]
    if not decomposition.system.groups:
        rows = [{k: v for k, v in row.items() if k != "multidegree"} for row in rows]
    headings = list(rows[0])
    left = [headings.index("status"), headings.index("precision")]
    return align([headings, *(list(row.values()) for row in rows)], left)


def _row(group: Sequence[WitnessSet]) -> dict[str, str]:
    first = group[0]
    return {
        "dimension": str(first.dimension),
        "degree": str(first.degree),
        "multidegree": multidegree_text(first.multidegree),
        "multiplicity": str(first.multiplicity) if first.multiplicity else "?",
        "count": str(sum(c.orbit for c in group)),
        "status": str(first.status),
        "residual": magnitude(float(np.max([c.residual for c in group]))),
        "accuracy": magnitude(float(np.max([c.accuracy for c in group]))),
        "precision": first.precision,
    }


def remarks(decomposition: Decomposition) -> list[str]:
    """Why an answer is incomplete, one line a reason."""
    lines = [
        f"undecided: dimension {c.dimension}, degree {c.degree}: {c.note or 'no reason given'}"
        for c in decomposition.components
        if c.status is not Status.IRREDUCIBLE
    ]
    return [printable(line) for line in dict.fromkeys([*lines, *decomposition.notes])]


def paths_line(decomposition: Decomposition) -> str:
    return paths_text(decomposition.paths)


def paths_text(paths: PathCounts) -> str:
    """What became of paths."""
    return f"{paths.tracked} tracked, {paths.at_infinity} to infinity, {paths.failed} failed"


def labelled(rows: Sequence[tuple[str, str]], width: int = 0) -> list[str]:
    """Lines ``label  text`` with the texts in one column, the labels at least ``width`` wide.

    Long texts go on below their beginning.
    """
    width = max([width, *(len(label) for label, _ in rows)])
    lines = []
    for label, text in rows:
        parts = textwrap.wrap(text, LINE - width - 2, break_on_hyphens=False) or [""]
        lines += [
            f"{name.ljust(width)}  {part}".rstrip()
            for name, part in zip([label, *[""] * len(parts)], parts, strict=False)
        ]
    return lines
