"""The components of a decomposition, by their dimensions."""

from __future__ import annotations

from collections import Counter

from nag.pictures.picture_file import STYLE, save
from nag.text.table import count_text
from nag.witness.shown import kinds
from nag.witness.witness import Decomposition

# Inches of a row; boxes in it, and beyond these one that counts the rest.
ROW, MOST_BOXES = 1.1, 6


def draw_component_tree(answer: Decomposition, title: str, path: str) -> None:
    """All components, those of a dimension in one row, the largest at the top.

    Components that are alike are one box, with how many they are.

    Raises:
        OSError: if the file cannot be written.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    rows: dict[int, list[str]] = {}
    plain: Counter[tuple[int, int, int]] = Counter()
    for kind, count in kinds(answer.components).items():
        plain[kind.dimension, kind.degree, kind.multiplicity or 0] += count
    for (dimension, degree, multiplicity), count in sorted(plain.items()):
        text = f"{count} of degree {degree}" if count > 1 else f"degree {degree}"
        if multiplicity != 1:
            text += f"\nmultiplicity {multiplicity or 'not known'}"
        rows.setdefault(dimension, []).append(text)
    levels = sorted(rows, reverse=True)
    with rc_context(STYLE | {"font.size": 8}):
        figure = Figure(figsize=(5.2, 1 + ROW * (1 + len(levels))), layout="constrained")
        plane = figure.subplots()
        top = (0.5, len(levels))
        box = {"boxstyle": "round,pad=0.5", "fc": "#eef1f4", "ec": "#44505c"}
        for k, dimension in enumerate(levels):
            texts = rows[dimension]
            if len(texts) > MOST_BOXES:
                texts = [*texts[: MOST_BOXES - 1], f"and {len(texts) - MOST_BOXES + 1} kinds more"]
            y = len(levels) - 1 - k
            plane.text(0, y, f"dimension {dimension}", ha="right", va="center")
            for i, text in enumerate(texts):
                x = (i + 0.5) / len(texts)
                plane.plot([top[0], x], [top[1], y], color="#b8c0c8", linewidth=0.9, zorder=0)
                plane.text(x, y, text, ha="center", va="center", bbox=box)
        counts = (answer.system.n, "variable"), (len(answer.system.polynomials), "equation")
        name = ", ".join(count_text(*each) for each in counts)
        plane.text(*top, name, ha="center", va="center", weight="bold", bbox=box)
        plane.set_xlim(-0.3, 1.05)
        plane.set_ylim(-0.5, len(levels) + 0.5)
        plane.set_axis_off()
        plane.set_title(title, fontsize=9)
        save(figure, path)
