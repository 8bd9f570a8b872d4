"""What mechanisms and models show at the prompt and in notebooks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any

from nag.algebra.number import Number, number_text
from nag.algebra.system import system_line, values_text
from nag.mechanism.graph import Joint
from nag.text.table import align, count_text, html_table, lines_of, printable, shorten_text
from nag.text.table import number_text as rounded_text

if TYPE_CHECKING:
    from nag.mechanism.configuration import Configuration
    from nag.mechanism.graph import Mechanism
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
