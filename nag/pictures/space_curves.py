"""Curves in space, seen from a little above, each with its shadow on the floor."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from nag.pictures.picture_file import COLOURS, DASHES, STYLE, save
from nag.pictures.plane_curves import Axis, CurvesInStyle, find_window

# Degrees: from where it is seen.
ELEVATION, AZIMUTH = 22, -57


def draw_space_curves(
    curves: Sequence[CurvesInStyle], axes: Sequence[Axis], title: str, path: str
) -> None:
    """Curves, each in a colour and a line style of its own, with a legend.

    Args:
        curves: of points in space.
        axes: the three coordinates; angles are drawn as they run, over more than a turn.

    Raises:
        OSError: if the file cannot be written.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    window = find_window(curves, axes)
    with rc_context(STYLE | {"font.size": 8}):
        figure = Figure(figsize=(5.2, 5.2), layout="constrained")
        space = figure.add_subplot(projection="3d")
        for i, own in enumerate(curves):
            style = {"color": COLOURS[i % len(COLOURS)], "linestyle": DASHES[i % len(DASHES)]}
            for arc in (*own.arcs, *own.endless):
                shown = _inside(arc, window)
                space.plot(*shown.T, linewidth=1.4, label=own.label, **style)
                floor = np.where(np.isnan(shown[:, 2]), np.nan, window[0, 2])
                space.plot(*shown[:, :2].T, floor, linewidth=0.7, color="#c8c8c8", zorder=0)
            for (name, mark), points in own.marked:
                space.plot(*_inside(points, window).T, linestyle="", color="black",
                           label=name, **mark)  # fmt: skip
        _set_axes(space, axes, window)
        space.set_title(title, fontsize=9)
        handles = dict(zip(*reversed(space.get_legend_handles_labels()), strict=True))
        figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=3,
                      frameon=False)  # fmt: skip
        save(figure, path)


def _set_axes(space: Any, axes: Sequence[Axis], window: np.ndarray) -> None:
    for name, axis, ends in zip("xyz", axes, window.T, strict=True):
        getattr(space, f"set_{name}label")(f"{axis.label} [\u00b0]" if axis.angle else axis.label)
        getattr(space, f"set_{name}lim")(*ends)
    space.view_init(ELEVATION, AZIMUTH)
    space.set_box_aspect((1, 1, 1))
    # Shadows are told from curves by the floor alone where the walls are white.
    for wall in (space.xaxis, space.yaxis, space.zaxis):
        wall.set_pane_color((1, 1, 1, 0))


def _inside(points: np.ndarray, window: np.ndarray) -> np.ndarray:
    """The points, those outside of the window as gaps."""
    within = ((points >= window[0]) & (points <= window[1])).all(axis=1)
    return np.where(within[:, None], points, np.nan)
