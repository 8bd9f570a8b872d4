"""The components of all assembly modes as text."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from nag.text.table import Row, align, printable, sheet
from nag.witness.shown import kinds, kinds_text, paths_text, remarks
from nag.witness.witness import PathCounts

if TYPE_CHECKING:
    from nag.mechanism.mode_decomposition import ModesAnswer


def modes_lines(answer: ModesAnswer, title: str, run: Row) -> list[str]:
    """The answer to ``nag decompose --modes all``, line by line."""
    members = sum(len(c.modes.members) for c in answer.classes)
    first = answer.classes[0]
    total = Counter()
    for each in answer.classes:
        for kind, count in kinds(each.decomposition.components).items():
            total[kind] += count * len(each.modes.members)
    head = [
        ("modes", _modes_text(answer, members)),
        ("model", f"formulation {first.model.formulation}: {first.model.reason}"),
        ("answer", f"in all modes together {kinds_text(total)}"),
    ]
    if not answer.complete:
        head.append(("", "INCOMPLETE, see below"))
    rows = [["class", "modes", "changed joints", "components in each mode"]]
    for k, each in enumerate(answer.classes, 1):
        changed = ", ".join(_mode_text(name, m, answer) for name, m in each.modes.representative)
        text = kinds_text(kinds(each.decomposition.components))
        rows.append([str(k), str(len(each.modes.members)), printable(changed or "none"), text])
    paths = sum((c.decomposition.paths for c in answer.classes), PathCounts())
    tail = [("meeting", _meeting_text(answer, {k.dimension for k in total}))]
    for k, each in enumerate(answer.classes, 1):
        tail += [("open", f"class {k}: {line}") for line in remarks(each.decomposition)]
    return sheet(title, head, align(rows, (2, 3)), [*tail, ("paths", paths_text(paths)), run])


def _modes_text(answer: ModesAnswer, members: int) -> str:
    joints = [j for j in answer.structure.joints if j.of_type.modes > 1]
    text = f"{members} combinations of the assembly modes of {len(joints)} joints"
    if len(answer.classes) == members:
        return f"{text}, each decomposed"
    return (
        f"{text}, in {len(answer.classes)} classes; half-turns of bodies carry the modes of a "
        "class into each other, as linear maps of Euler parameters, checked exactly on the "
        "equations; one of each class is decomposed"
    )


def _mode_text(name: str, mode: int, answer: ModesAnswer) -> str:
    joint = next(j for j in answer.structure.joints if j.name == name)
    return name if joint.of_type.modes == 2 else f"{name}:{mode}"


def _meeting_text(answer: ModesAnswer, dimensions: set[int]) -> str:
    text = "components of different modes do not meet: the equations of a joint's modes together "
    text += "leave no orientation, by exact linear algebra"
    if not answer.apart:
        text = "whether components of different modes meet is not known"
    if len(dimensions) < 2:
        return text
    if not answer.meetings:
        return f"{text}; components of different dimensions do not meet, in any mode"
    pairs = [f"dimensions {a} and {b} in class {k + 1}" for k, a, b in answer.meetings]
    return f"{text}; components of different dimensions meet: {', '.join(pairs)}"
