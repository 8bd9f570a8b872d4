"""Curves in a plane, of which each coordinate is a number or an angle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from nag.pictures.picture_file import COLOURS, DASHES, STYLE, save

# In degrees.
TURN = 360.0
# Half of what is shown: a little more than a turn, so that what is at its ends is seen.
SHOWN = 188.0
PLANE = ("across", "up")
TICKS = (-180, -90, 0, 90, 180)
# Of arcs to infinity: how far they are shown, in sizes of what is bounded; and room at the sides.
REACH, MARGIN = 3, 0.06
# What is marked: its name, and how.
Mark = tuple[str, dict[str, Any]]
SINGULAR = ("singular point", {"marker": "x", "markersize": 7, "markeredgewidth": 1.4})
ISOLATED = ("isolated point", {"marker": "o", "markersize": 4})
MEETING = (
    "meets another component",
    {"marker": "s", "markersize": 7, "markerfacecolor": "none"},
)


@dataclass(frozen=True)
class Axis:
    """A coordinate of what is drawn.

    Attributes:
        label: its name.
        angle: whether it is one, in degrees, of which whole turns do not count.
    """

    label: str
    angle: bool = False


@dataclass(frozen=True, eq=False)
class CurvesInStyle:
    """What is drawn in one style.

    Attributes:
        label: its name.
        arcs: points in their order, shape ``(k, d)`` each, d the number of axes; angles do not
            jump on the way.
        marked: points by what is marked at them, shape ``(k, d)`` each.
        endless: arcs that go to infinity at an end, of the same shapes.
    """

    label: str
    arcs: Sequence[np.ndarray]
    marked: Sequence[tuple[Mark, np.ndarray]] = ()
    endless: Sequence[np.ndarray] = ()


def draw_plane_curves(
    curves: Sequence[CurvesInStyle], axes: tuple[Axis, Axis], title: str, path: str
) -> None:
    """Curves, each in a colour and a line style of its own, with a legend.

    Of angles the picture shows a turn and a little more.

    Raises:
        OSError: if the file cannot be written.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    with rc_context(STYLE | {"font.size": 8}):
        figure = Figure(figsize=(5.2, 5.2), layout="constrained")
        plane = figure.subplots()
        for i, own in enumerate(curves):
            style = {"color": COLOURS[i % len(COLOURS)], "linestyle": DASHES[i % len(DASHES)]}
            for arc in (*own.arcs, *own.endless):
                for copy in _copies(arc, axes):
                    plane.plot(*copy.T, linewidth=1.3, label=own.label, **style)
            for (name, mark), points in own.marked:
                for point in points:
                    for copy in _copies(point[None], axes):
                        plane.plot(*copy.T, linestyle="", color="black", label=name, **mark)
        window = find_window(curves, axes)
        for axis, label, ticks, limits, ends in (
            (axes[0], plane.set_xlabel, plane.set_xticks, plane.set_xlim, window[:, 0]),
            (axes[1], plane.set_ylabel, plane.set_yticks, plane.set_ylim, window[:, 1]),
        ):
            label(f"{axis.label} [\u00b0]" if axis.angle else axis.label)
            if axis.angle:
                ticks(TICKS)
                limits(-SHOWN, SHOWN)
            else:
                limits(*ends)
        if axes[0].angle == axes[1].angle:
            plane.set_aspect("equal")
        plane.grid(True, alpha=0.3, linewidth=0.5)
        plane.set_title(title, fontsize=9)
        handles = dict(zip(*reversed(plane.get_legend_handles_labels()), strict=True))
        figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=3,
                      frameon=False)  # fmt: skip
        save(figure, path)


def find_window(curves: Sequence[CurvesInStyle], axes: Sequence[Axis]) -> np.ndarray:
    """What is shown: its least and largest coordinates, shape ``(2, d)``.

    All that is bounded, and of arcs to infinity what is within a few sizes of it; in a plane a
    square, where no coordinate is an angle.
    """
    plain = [not axis.angle for axis in axes]
    whole = [arc for own in curves for arc in own.arcs]
    whole += [points for own in curves for _, points in own.marked]
    endless = [arc for own in curves for arc in own.endless]
    bounded = np.vstack(whole) if whole else np.zeros((1, len(axes)))
    centre = (bounded.min(axis=0) + bounded.max(axis=0)) / 2
    size = np.linalg.norm((bounded - centre)[:, plain], axis=1).max()
    away = [np.linalg.norm((arc - centre)[:, plain], axis=1) for arc in endless]
    reach = REACH * (max([size, *(own.min() for own in away)]) or 1.0)
    shown = [arc[own <= reach] for arc, own in zip(endless, away, strict=True)]
    points = np.vstack([*shown, bounded] if whole else shown or [bounded])
    ends = np.stack([points.min(axis=0), points.max(axis=0)])
    spans = np.ptp(ends, axis=0)
    if all(plain) and len(axes) == len(PLANE):
        spans = np.full(len(axes), spans.max())
    middle, half = ends.mean(axis=0), (0.5 + MARGIN) * np.where(spans > 0, spans, 1.0)
    return np.stack([middle - half, middle + half])


def _copies(points: np.ndarray, axes: tuple[Axis, Axis]) -> list[np.ndarray]:
    """The points shifted by whole turns, wherever some of them come into the picture."""
    shifts = []
    for axis, column in zip(axes, points.T, strict=True):
        if not axis.angle:
            shifts.append([0.0])
            continue
        first = np.ceil((-SHOWN - column.max()) / TURN)
        last = np.floor((SHOWN - column.min()) / TURN)
        shifts.append([TURN * k for k in np.arange(first, last + 1)])
    return [points + np.array(shift) for shift in product(*shifts)]
