"""Figures as files, small ones, the same for the same data."""

from __future__ import annotations

from io import BytesIO
from typing import Any

# Colours, from dark to light in equal steps, marks and dashes, so that greyscale will do.
COLOURS = ("#10102e", "#7d0a22", "#2a5fb0", "#1e9684", "#e0931c", "#b4cc55")
MARKS = ("o", "s", "^", "D", "v", "P")
DASHES = (
    "-",
    (0, (6, 1.5)),
    (0, (3, 1.2)),
    (0, (6, 1.5, 1, 1.5)),
    (0, (3, 1.2, 1, 1.2)),
    (0, (1, 1)),
)
# Dots an inch, and how many colours, of a PNG.
DENSITY, MOST_COLOURS = 90, 64
# Text stays text in SVG, and its marks have the same names each time.
STYLE = {"svg.fonttype": "none", "svg.hashsalt": "nag", "hatch.linewidth": 0.6}


def save(figure: Any, path: str) -> None:
    """Write a figure; the ending of ``path`` names the kind of file.

    Raises:
        OSError: if it cannot be written.
    """
    if not path.endswith(".png"):
        time = "Date" if path.endswith(".svg") else "CreationDate"
        figure.savefig(path, metadata={time: None})
        return
    from PIL import Image

    buffer = BytesIO()
    figure.savefig(buffer, format="png", dpi=DENSITY)
    buffer.seek(0)
    image = Image.open(buffer).convert("RGB").quantize(MOST_COLOURS, dither=Image.Dither.NONE)
    image.save(path, optimize=True)
