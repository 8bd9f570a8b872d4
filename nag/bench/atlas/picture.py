"""The atlas as a picture: a row a family, a cell a value of its knob with shares of answers."""

from __future__ import annotations

from typing import Any

from nag.bench.atlas.stability import Atlas, Cell
from nag.pictures.picture_file import STYLE, save

# Lightness falls from right to wrong, so that the picture can be read without colours.
COLOURS = {"right": "#dcebd5", "undecided": "#f0b05a", "slow": "#f0b05a", "wrong": "#7f0000"}
HATCHES = {"right": "", "undecided": "", "slow": "////", "wrong": ""}
NAMES = {
    "right": "right",
    "undecided": "undecided, and says so",
    "slow": "no answer in the time",
    "wrong": "wrong",
}
# Widths in inches.
TEXT, CELL, HEIGHT = 4.5, 0.98, 0.31
LONGEST = 13


def draw(atlas: Atlas, path: str) -> None:
    """Write the picture; the ending of ``path`` names its kind.

    Raises:
        OSError: if it cannot be written.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    columns = max(len(row.cells) for row in atlas.rows)
    height = HEIGHT * (len(atlas.rows) + 3.6)
    width = TEXT + CELL * columns + 0.1
    with rc_context(STYLE):
        figure = Figure(figsize=(width, height))
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set_xlim(0, width)
        axes.set_ylim(height, 0)
        axes.axis("off")
        title = f"Answers over {atlas.seeds} seeds, settings {atlas.settings}"
        axes.text(0.1, 0.28, title, fontsize=10, weight="bold", va="center")
        for i, row in enumerate(atlas.rows):
            y = HEIGHT * (i + 2)
            axes.text(0.1, y + HEIGHT / 2, row.text, fontsize=7.5, va="center")
            axes.text(
                TEXT - 0.08, y + HEIGHT / 2, row.knob, fontsize=6.5, va="center", ha="right",
                color="#444444",
            )  # fmt: skip
            for j, cell in enumerate(row.cells):
                _cell(axes, cell, TEXT + CELL * j, y)
        _legend(axes, HEIGHT * (len(atlas.rows) + 2.6))
        save(figure, path)


def _cell(axes: Any, cell: Cell, x: float, y: float) -> None:
    from matplotlib.patches import Rectangle

    room, left = CELL - 0.05, x
    for kind in COLOURS:
        share = getattr(cell, kind) / max(cell.answers, 1)
        if share:
            axes.add_patch(_patch(kind, left, y, share * room))
            left += share * room
    frame = {"fill": False, "edgecolor": "#666666", "linewidth": 0.5}
    axes.add_patch(Rectangle((x, y + 0.02), room, HEIGHT - 0.04, **frame))
    label = str(cell.value).rpartition("/")[2]
    long = len(label) > LONGEST
    dark = cell.wrong > cell.answers / 2
    axes.text(
        x + room / 2, y + HEIGHT / 2, _broken(label) if long else label, ha="center", va="center",
        fontsize=6 if long else 7, linespacing=1.1, color="white" if dark else "black",
    )  # fmt: skip


def _broken(label: str) -> str:
    """A long name on two lines, broken at the hyphen that is nearest to its middle."""
    hyphens = [i for i, c in enumerate(label) if c == "-"]
    if not hyphens:
        return label
    middle = min(hyphens, key=lambda i: abs(i - len(label) / 2))
    return f"{label[: middle + 1]}\n{label[middle + 1 :]}"


def _patch(kind: str, x: float, y: float, width: float) -> Any:
    from matplotlib.patches import Rectangle

    return Rectangle(
        (x, y + 0.02), width, HEIGHT - 0.04,
        facecolor=COLOURS[kind], hatch=HATCHES[kind], edgecolor="#555555", linewidth=0,
    )  # fmt: skip


def _legend(axes: Any, y: float) -> None:
    x = 0.1
    for kind, name in NAMES.items():
        axes.add_patch(_patch(kind, x, y, 0.28))
        axes.text(x + 0.36, y + HEIGHT / 2, name, fontsize=7.5, va="center")
        x += 0.75 + 0.075 * len(name)
