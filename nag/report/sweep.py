"""The answer to a sweep of a parameter as text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from nag.algebra.number import number_text
from nag.text.table import Row, align, sheet
from nag.witness.shown import kinds, kinds_text

if TYPE_CHECKING:
    from nag.decomposition.sweep import Swept


def sweep_lines(title: str, name: str, swept: Sequence[Swept], run: Row) -> list[str]:
    """One line a value, and what they rest on."""
    rows = [[name, "", "paths", "components"]]
    for each in swept:
        answer = kinds_text(kinds(each.decomposition.components))
        if not each.decomposition.complete:
            answer += " (INCOMPLETE)"
        how = "followed" if each.followed else "by itself"
        rows.append([number_text(each.value), how, str(each.paths), answer])
    followed = sum(each.followed for each in swept)
    reasons = dict.fromkeys(each.reason for each in swept if each.reason)
    tail = [
        (
            "followed",
            f"{followed} of {len(swept)} values, from the components for a general value; those "
            "that a single value may have besides are not looked for there",
        )
    ]
    tail += [("by itself", reason) for reason in reasons]
    return sheet(title, align(rows, left=(1, 3)), [*tail, run])
