"""Figures as files, small ones, the same for the same data."""

from __future__ import annotations

from io import BytesIO
from typing import Any

# Dots an inch, and colours, of a PNG.
DENSITY, COLOURS = 90, 64
# Text stays text in SVG, and its marks have the same names each time.
STYLE = {"svg.fonttype": "none", "svg.hashsalt": "nag", "hatch.linewidth": 0.6}


def save(figure: Any, path: str) -> None:
    """Write a figure; the ending of ``path`` names the kind of file.

    Raises:
        OSError: if it cannot be written.
    """
    if not path.endswith(".png"):
        extra = {"metadata": {"Date": None}} if path.endswith(".svg") else {}
        figure.savefig(path, **extra)
        return
    from PIL import Image

    buffer = BytesIO()
    figure.savefig(buffer, format="png", dpi=DENSITY)
    buffer.seek(0)
    image = Image.open(buffer).convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
    image.save(path, optimize=True)
