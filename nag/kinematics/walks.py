"""How the arcs of a real curve follow each other in a motion.

A motion runs along a loop, or along arcs from vertex to vertex. Through a vertex it goes straight
on: of the ends of arcs that meet there, two belong together whose tangents are opposite. What a
cusp, where they are not, leaves over is paired as it lies nearest to that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.real.curve import RealCurve, VertexKind
from nag.real.spherical_chart import SphericalChart

# An end of an edge: its index, and whether it is the last point.
End = tuple[int, bool]


@dataclass(frozen=True, eq=False)
class CurveWalk:
    """One motion along a real curve.

    Attributes:
        piece: index of the connected piece that it runs on.
        closed: whether it returns to where it began.
        chart: points along it, shape ``(k, size)``, in the coordinates of `coordinates`, continuous
            all along it. Of a closed walk the last point is the first, up to signs of groups.
        vertices: the vertices on its way, each with the index of the point there; of a closed walk
            none at the last point.
        coordinates: those of the chart.
    """

    piece: int
    closed: bool
    chart: np.ndarray
    vertices: tuple[tuple[int, int], ...]
    coordinates: SphericalChart

    def begin_at(self, index: int) -> CurveWalk:
        """A closed walk, begun at another point."""
        if index == 0 or not self.closed:
            return self
        last = len(self.chart) - 1
        whole = np.concatenate([self.chart[index:], self.chart[1 : index + 1]])
        turned = {(v, (i - index) % last) for v, i in self.vertices}
        vertices = tuple(sorted(turned, key=lambda p: p[1]))
        return replace(self, chart=self.coordinates.make_continuous(whole), vertices=vertices)

    def insert(self, segments: np.ndarray, points: np.ndarray) -> CurveWalk:
        """The same with more points, each after that of an index; indices rise."""
        chart = np.insert(self.chart, segments + 1, points, axis=0)
        vertices = tuple((v, i + int((segments < i).sum())) for v, i in self.vertices)
        return replace(self, chart=chart, vertices=vertices)


def walks_of(curve: RealCurve, coordinates: SphericalChart) -> tuple[CurveWalk, ...]:
    """All motions along a real curve, each edge in one of them; isolated points are none."""
    charts = [coordinates.make_continuous(coordinates.chart(edge.points)) for edge in curve.edges]
    partner = _pair_ends(curve, charts, coordinates)
    walks = []
    for number, piece in enumerate(curve.pieces):
        left = set(piece.edges)
        while left:
            start = min(left)
            way = _follow(curve, partner, start)
            left -= {edge for edge, _ in way}
            walks.append(_join(curve, number, way, partner, charts, coordinates))
    return tuple(walks)


def _pair_ends(
    curve: RealCurve, charts: Sequence[np.ndarray], coordinates: SphericalChart
) -> dict[End, End]:
    """For each end of an edge at a finite vertex the one in which a motion goes on."""
    ends: dict[int, list[End]] = {}
    for k, edge in enumerate(curve.edges):
        for vertex, last in ((edge.start, False), (edge.end, True)):
            if vertex is not None and curve.vertices[vertex].kind is not VertexKind.INFINITE:
                ends.setdefault(vertex, []).append((k, last))
    partner: dict[End, End] = {}
    for own in ends.values():
        # A vertex is at the end of several edges, with the signs of each.
        starts = [_begin_at_end(charts, end) for end in own]
        aligned = [
            coordinates.make_continuous(np.vstack([starts[0][:1], start]))[1:] for start in starts
        ]
        directions = [_direction(start) for start in aligned]
        pairs = sorted(
            (float(directions[i] @ directions[j]), i, j)
            for i in range(len(own))
            for j in range(i + 1, len(own))
        )
        for _, i, j in pairs:
            if own[i] not in partner and own[j] not in partner:
                partner[own[i]], partner[own[j]] = own[j], own[i]
    return partner


def _begin_at_end(charts: Sequence[np.ndarray], end: End) -> np.ndarray:
    """The first points of an edge from one of its ends, three at most."""
    edge, last = end
    return (charts[edge][::-1] if last else charts[edge])[:3]


def _direction(chart: np.ndarray) -> np.ndarray:
    """The unit vector into an edge from its first point, by a circle through three points."""
    if len(chart) < 3:
        vector = chart[-1] - chart[0]
    else:
        first, second = chart[1] - chart[0], chart[2] - chart[0]
        s, t = np.linalg.norm(first), np.linalg.norm(second)
        # The slope at the start of the parabola through three points.
        vector = first * (t / (s * (t - s))) - second * (s / (t * (t - s))) if t > s else first
    return vector / np.linalg.norm(vector)


def _follow(curve: RealCurve, partner: dict[End, End], start: int) -> list[tuple[int, bool]]:
    """Edges one after the other, each with whether it is run forwards."""
    way = [(start, True)]
    if curve.edges[start].closed:
        return way
    for forwards in (True, False):
        while True:
            edge, ahead = way[-1] if forwards else way[0]
            # The end at which the way so far stops.
            following = partner.get((edge, ahead if forwards else not ahead))
            if following is None:
                break
            edge, last = following
            if any(edge == other for other, _ in way):
                return way
            if forwards:
                way.append((edge, not last))
            else:
                way.insert(0, (edge, last))
    return way


def _join(
    curve: RealCurve,
    piece: int,
    way: list[tuple[int, bool]],
    partner: dict[End, End],
    charts: Sequence[np.ndarray],
    coordinates: SphericalChart,
) -> CurveWalk:
    """The chart along edges, made continuous from one to the next."""
    parts: list[np.ndarray] = []
    vertices: list[tuple[int, int]] = []
    length = 0
    for edge_number, forwards in way:
        edge = curve.edges[edge_number]
        chart = charts[edge_number] if forwards else charts[edge_number][::-1]
        ends = (edge.start, edge.end) if forwards else (edge.end, edge.start)
        if parts:
            chart = chart[1:]
        elif _is_finite(curve, ends[0]):
            vertices.append((ends[0], 0))
        parts.append(chart)
        length += len(chart)
        if _is_finite(curve, ends[1]):
            vertices.append((ends[1], length - 1))
    first, last = way[0], way[-1]
    closed = curve.edges[first[0]].closed or (
        partner.get((last[0], last[1])) == (first[0], not first[1])
    )
    if closed and vertices:
        # What ends where it began is there once.
        vertices = [(v, i) for v, i in vertices if i < length - 1]
    whole = coordinates.make_continuous(np.concatenate(parts))
    return CurveWalk(piece, closed, whole, tuple(vertices), coordinates)


def _is_finite(curve: RealCurve, vertex: int | None) -> bool:
    return vertex is not None and curve.vertices[vertex].kind is not VertexKind.INFINITE
