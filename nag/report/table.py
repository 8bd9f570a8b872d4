"""The lines and tables that the commands' answers are made of."""

from __future__ import annotations

from nag.algebra.shown import system_line
from nag.text.table import LINE, align, labelled, magnitude, printable
from nag.witness.shown import (
    component_rows,
    multidegree_text,
    paths_line,
    paths_text,
    remarks,
    title_line,
)
from nag.witness.witness import Decomposition

__all__ = [
    "LINE",
    "align",
    "component_table",
    "labelled",
    "magnitude",
    "multidegree_text",
    "paths_line",
    "paths_text",
    "printable",
    "remarks",
    "system_line",
    "title_line",
]


def component_table(decomposition: Decomposition) -> list[str]:
    """One row for components that are alike, with the worst residual and accuracy among them."""
    rows = component_rows(decomposition)
    if not rows:
        return []
    return align(rows, [rows[0].index("status")])
