"""What mechanisms, models and all assembly modes show at the prompt and in commands."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any

from nag.algebra.number import Number, number_text
from nag.algebra.system import system_line, values_text
from nag.mechanism.graph import Joint
from nag.text.table import (
    Row,
    align,
    count_text,
    html_table,
    lines_of,
    printable,
    sheet,
    shorten_text,
)
from nag.text.table import number_text as rounded_text

if TYPE_CHECKING:
    from nag.mechanism.assembly import AssemblyModel
    from nag.mechanism.configuration import Configuration
    from nag.mechanism.graph import Mechanism
    from nag.mechanism.mode_decomposition import ModesAnswer
    from nag.mechanism.model import Model

# Of mechanisms with more joints the first are shown.
MOST_LINES = 4
# Longer exact coordinates of configurations are rounded.
LONGEST = 8
_VECTORS = tuple(f.name for f in fields(Joint) if f.name not in ("name", "type", "bodies"))


def _vector(values: tuple[Number, ...] | None) -> str:
    return "" if values is None else f"({', '.join(map(number_text, values))})"


def _title(mechanism: Mechanism) -> str:
    names = ", ".join(mechanism.body_names)
    bodies = count_text(len(mechanism.body_names), "body", "bodies")
    listed = f" ({names})" if len(names) <= 60 else ""
    return f"Mechanism of {bodies}{listed}, ground {mechanism.ground}"


def mechanism_text(mechanism: Mechanism) -> str:
    """A mechanism in five lines: its bodies, and its first joints."""
    joints = mechanism.joints
    shown = len(joints) if len(joints) <= MOST_LINES else MOST_LINES - 1
    rows = []
    for joint in joints[:shown]:
        vectors = [f"{n} {_vector(getattr(joint, n))}" for n in _VECTORS if getattr(joint, n)]
        text = ", ".join([joint.type, " - ".join(joint.bodies), *vectors])
        rows.append([f"  {joint.name}", text])
    lines = [_title(mechanism), *align(rows, (0, 1))]
    if shown < len(joints):
        lines.append(f"  and {count_text(len(joints) - shown, 'more joint')}")
    return "\n".join(shorten_text(printable(line)) for line in lines)


def mechanism_html(mechanism: Mechanism) -> str:
    """A mechanism as a table, one row a joint."""
    used = [n for n in _VECTORS if any(getattr(j, n) is not None for j in mechanism.joints)]
    rows = [["joint", "type", "bodies", *used]]
    for joint in mechanism.joints:
        vectors = [_vector(getattr(joint, n)) for n in used]
        rows.append([joint.name, joint.type, " - ".join(joint.bodies), *vectors])
    return html_table(_title(mechanism), rows)


def _entry(value: Any) -> str:
    """A coordinate: a short exact number as it is, others to six digits."""
    if isinstance(value, int | Number):
        text = number_text(value)
        return text if len(text) <= LONGEST else rounded_text(float(value))
    return rounded_text(complex(value))


def _entries(values: Sequence[Any]) -> str:
    return f"({', '.join(map(_entry, values))})"


def configuration_text(found: Configuration) -> str:
    """A configuration in five lines: where its first bodies are."""
    names = list(found.euler)
    shown = len(names) if len(names) <= MOST_LINES else MOST_LINES - 1
    rows = [
        [f"  {name}", f"euler {_entries(found.euler[name])}, at {_entries(found.position[name])}"]
        for name in names[:shown]
    ]
    lines = [f"Configuration of {count_text(len(names), 'body', 'bodies')}", *align(rows, (0, 1))]
    if shown < len(names):
        left = count_text(len(names) - shown, "more body", "more bodies")
        lines.append(f"  and {left}")
    return "\n".join(shorten_text(printable(line)) for line in lines)


def configuration_html(found: Configuration) -> str:
    """A configuration as a table, one row a body."""
    rows = [["body", "euler", "position"]]
    for name, euler in found.euler.items():
        rows.append([name, _entries(euler), _entries(found.position[name])])
    return html_table(f"Configuration of {count_text(len(found.euler), 'body', 'bodies')}", rows)


def model_text(model: Model) -> str:
    """A model in five lines."""
    # Other assembly modes have no reference configuration.
    at = values_text(model.system.variables, model.reference) if model.reference else ""
    signs = count_text(model.sign_group, "sign change") if model.sign_group > 1 else "none"
    return lines_of(
        f"Model in formulation {model.formulation}: {model.reason}",
        [
            ("system", system_line(model.system)),
            ("reference", at),
            ("symmetries", signs),
            ("counted", f"mobility {model.gruebler_kutzbach} by Gruebler-Kutzbach"),
        ],
    )


def parts_text(model: AssemblyModel) -> str:
    """A model of parts in five lines."""
    known = model.reference
    at = [] if known is None else [("placement", values_text(model.system.variables, known))]
    symmetries = count_text(len(model.symmetries), "generator") if model.symmetries else "none"
    return lines_of(
        f"{type(model).__name__}: {model.reason}",
        [
            ("equations", model.formulation_text),
            ("system", system_line(model.system)),
            *at,
            ("symmetries", symmetries),
            ("counted", f"mobility {model.gruebler_kutzbach} by Gruebler-Kutzbach"),
        ],
    )


def modes_lines(answer: ModesAnswer, title: str, run: Row) -> list[str]:
    """The answer to ``nag decompose --modes all``, line by line."""
    from nag.witness.shown import kinds, kinds_text, paths_text, remarks
    from nag.witness.witness import PathCounts

    members = sum(len(c.modes.members) for c in answer.classes)
    first = answer.classes[0]
    total: Counter = Counter()
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
    paths = sum((c.decomposition.paths for c in answer.classes), PathCounts())
    tail = [("meeting", _meeting_text(answer, {k.dimension for k in total}))]
    for k, each in enumerate(answer.classes, 1):
        tail += [("open", f"class {k}: {line}") for line in remarks(each.decomposition)]
    tail += [("paths", paths_text(paths)), run]
    return sheet(title, head, align(answer.rows(), (2, 3)), tail)


def mode_rows(answer: ModesAnswer) -> list[list[str]]:
    """Headings, and one row for each class of modes."""
    from nag.witness.shown import kinds, kinds_text

    rows = [["class", "modes", "changed joints", "components in each mode"]]
    for k, each in enumerate(answer.classes, 1):
        changed = ", ".join(_mode_text(name, m, answer) for name, m in each.modes.representative)
        text = kinds_text(kinds(each.decomposition.components))
        rows.append([str(k), str(len(each.modes.members)), printable(changed or "none"), text])
    return rows


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
