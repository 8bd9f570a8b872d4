"""Projections of real curves to two or three variables."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from nag.pictures.plane_curves import (
    ISOLATED,
    MEETING,
    PLANE,
    SINGULAR,
    Axis,
    CurvesInStyle,
    Mark,
    draw_plane_curves,
)
from nag.pictures.space_curves import draw_space_curves
from nag.real.curve import RealCurve, RealEdge, Turn, VertexKind


def draw_real_curves(
    curves: Sequence[tuple[str, RealCurve]], onto: Sequence[int], title: str, path: str
) -> None:
    """Real curves of one system, each in a style of its own, with what is special on them.

    A variable of which infinity is an ordinary value, a half-angle, is drawn as its angle. What
    lies at infinity else is not drawn.

    Args:
        curves: each with its name.
        onto: indices of two variables, or of three.

    Raises:
        OSError: if the file cannot be written.
    """
    first = curves[0][1]
    turns = [next((t for t in first.turns if t.variable == i), None) for i in onto]
    axes = [
        Axis(name) if turn is None else Axis(_angle_name(name, turn), True)
        for name, turn in zip([first.variables[i] for i in onto], turns, strict=True)
    ]
    drawn = []
    for name, curve in curves:
        arcs: tuple[list[np.ndarray], list[np.ndarray]] = ([], [])
        for edge in curve.edges:
            arcs[_endless(curve, edge)].append(_on_plane(edge.chart[:, list(onto)], turns))
        marked = [(mark, _of_points(points, onto, turns)) for mark, points in _marks_of(curve)]
        drawn.append(CurvesInStyle(name, arcs[0], marked, arcs[1]))
    if len(axes) > len(PLANE):
        draw_space_curves(drawn, axes, title, path)
    else:
        draw_plane_curves(drawn, (axes[0], axes[1]), title, path)


def _endless(curve: RealCurve, edge: RealEdge) -> bool:
    ends = [curve.vertices[i] for i in (edge.start, edge.end) if i is not None]
    return any(vertex.kind is VertexKind.INFINITE for vertex in ends)


def _angle_name(variable: str, turn: Turn) -> str:
    if (turn.centre, turn.radius) == (0.0, 1.0):
        return f"2 atan {variable}"
    shifted = f"{variable} {'-' if turn.centre > 0 else '+'} {abs(turn.centre):.3g}"
    top = f"({shifted})" if turn.centre else variable
    return f"2 atan({top}/{turn.radius:.3g})"


def _on_plane(chart: np.ndarray, turns: Sequence[Turn | None]) -> np.ndarray:
    """Points with half-angles as whole ones in degrees."""
    return chart * [1.0 if turn is None else np.degrees(2.0) for turn in turns]


def _of_points(points: np.ndarray, onto: Sequence[int], turns: Sequence[Turn | None]) -> np.ndarray:
    chart = np.array(points, dtype=float)[:, list(onto)]
    for k, turn in enumerate(turns):
        if turn is not None:
            chart[:, k] = turn.angles(chart[:, k])
    return _on_plane(chart, turns)


def _marks_of(curve: RealCurve) -> Iterator[tuple[Mark, np.ndarray]]:
    for mark, kind in ((SINGULAR, VertexKind.SINGULAR), (ISOLATED, VertexKind.ISOLATED)):
        points = [v.point for v in curve.vertices if v.kind is kind]
        if points:
            yield mark, np.array(points)
    if curve.meetings is not None and len(curve.meetings):
        yield MEETING, curve.meetings
