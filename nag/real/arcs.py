"""Arcs between special fibres, and what they make up when those that meet smoothly are joined."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from nag.numerics.double_ranks import SINGULAR
from nag.real.arc_tracing import CHORD, Intervals, TracingError, are_one_step, trace_arcs
from nag.real.closure import AT_INFINITY, ProjectiveClosure
from nag.real.curve import (
    PieceKind,
    RealEdge,
    RealPiece,
    RealVertex,
    Turn,
    VertexKind,
    chart_of,
)
from nag.real.even_points import even_points
from nag.real.fibre_table import FibresOverValues
from nag.real.real_fibres import SpecialFibre, real_fibre

# Angles from the ends of an interval at which arcs are told to which vertices they go, tried in
# turn; and how much nearer the vertex must be than all others.
NEAR_END = (0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6)
# Decides: Distance from the vertex that an arc goes to, beside that from the next one; else it is
# looked nearer to the end.
NEARER = 0.3
# Decides: The same of an arc's end from a point that is known in digits; else arcs were mixed up.
SAME = 1e-2
# Decides: Least singular value at a vertex that is singular: these are known to rounding. From
# `SINGULAR` on it is regular; what falls between is undecided.
ROUNDED_AWAY = 1e-11
# Part of a distance by which another is as large.
AS_FAR = 1e-6


@dataclass(frozen=True, eq=False)
class Arc:
    """A traced arc.

    Attributes:
        ends: the vertices, each the number of a special fibre and of a point in it.
        points: normalised real points, the vertices' not included, shape ``(k, size)``.
    """

    ends: tuple[tuple[int, int], tuple[int, int]]
    points: np.ndarray


def intervals_between(
    specials: Sequence[SpecialFibre], radius: float
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Ends of the intervals between special values in their order, the last of which is infinity.

    Each is a pair of homogeneous points whose combinations with positive numbers are inside.
    """
    finite = [special.pencil for special in specials[:-1]]
    inner = list(pairwise(finite))
    far = np.array([radius, 0.0])
    return [(-far, finite[0]), *inner, (finite[-1], far)]


def find_arcs(
    table: FibresOverValues,
    closure: ProjectiveClosure,
    specials: Sequence[SpecialFibre],
    radius: float,
    crossed: np.ndarray | None,
) -> list[Arc]:
    """All arcs between special fibres, of which the last is that over infinity.

    Args:
        crossed: of `trace_arcs`.

    Raises:
        TracingError: if arcs are lost or mixed up.
        UnclearDigitsError: if more digits are needed.
    """
    starts, first, last, ends, numbers, goals = [], [], [], [], [], []
    pairs = intervals_between(specials, radius)
    for k, (left, right) in enumerate(pairs):
        one = Intervals(left[None], right[None])
        points, real = real_fibre(table, closure, one.at(np.array([np.pi / 2]))[0])
        if (len(points) - int(real.sum())) % 2:
            raise TracingError("the number of points that are not real is odd")
        if not real.any():
            continue
        middles = _real_points(closure, points[real])
        stops = [
            _end_of_interval(table, closure, one, special, sense)
            for special, sense in ((specials[k - 1], 0), (specials[k], 1))
        ]
        if any(int(stop.real.sum()) != len(middles) for stop in stops):
            raise TracingError("numbers of real points change between special values")
        for stop in stops:
            for x in middles:
                starts.append(x)
                first.append(left)
                last.append(right)
                ends.append(stop.angle)
                numbers.append(k)
            goals.append(stop)
    if not starts:
        return []
    intervals = Intervals(np.array(first), np.array(last))
    begin = np.full(len(starts), np.pi / 2)
    traced = trace_arcs(closure, intervals, np.array(starts), begin, np.array(ends), crossed)
    arcs: list[Arc] = []
    place = 0
    for left_stop, right_stop in zip(goals[::2], goals[1::2], strict=True):
        count = int(left_stop.real.sum())
        halves = []
        for stop in (left_stop, right_stop):
            own = [points for _, points in traced[place : place + count]]
            place += count
            halves.append((own, stop.vertices_of(closure, np.array([p[-1] for p in own]))))
        k = numbers[place - 1]
        for i in range(count):
            points = np.vstack([halves[0][0][i][:0:-1], halves[1][0][i]])
            at = (k - 1) % len(specials), k
            arcs.append(Arc(((at[0], halves[0][1][i]), (at[1], halves[1][1][i])), points))
    return arcs


@dataclass(frozen=True, eq=False)
class _Stop:
    """The fibre near the end of an interval.

    Attributes:
        angle: at which it is.
        points: all points, shape ``(d, size)``.
        real: which are real.
        vertices: to which points of the special fibre they go.
    """

    angle: float
    points: np.ndarray
    real: np.ndarray
    vertices: np.ndarray

    def vertices_of(self, closure: ProjectiveClosure, ends: np.ndarray) -> list[int]:
        """To which vertices traced arcs go, by their last points."""
        own = np.flatnonzero(self.real)
        distances = closure.distances(ends, self.points[own])
        nearest = distances.argmin(axis=1)
        ordered = np.sort(distances, axis=1)
        others = ordered[:, 1] if len(own) > 1 else np.ones(len(ends))
        unclear = ordered[:, 0] > SAME * np.minimum(others, 1.0)
        if unclear.any() or len(set(nearest.tolist())) != len(ends):
            raise TracingError("arcs were mixed up on the way")
        return [int(v) for v in self.vertices[own[nearest]]]


def _end_of_interval(
    table: FibresOverValues,
    closure: ProjectiveClosure,
    interval: Intervals,
    special: SpecialFibre,
    sense: int,
) -> _Stop:
    places = [
        (v, closure.normalise(special.points[v : v + 1].real)[0])
        for v in np.flatnonzero(special.real).tolist()
    ]
    smooth = [(v, place) for v, place in places if closure.corank_gap(place) >= SINGULAR]
    for near in NEAR_END:
        angle = np.pi - near if sense else near
        points, real = real_fibre(table, closure, interval.at(np.array([angle]))[0])
        distances = closure.distances(points, special.points)
        order = np.argsort(distances, axis=1)
        nearest = order[:, 0]
        by_row = np.take_along_axis(distances, order, axis=1)
        clear = len(special.points) == 1 or (by_row[:, 0] < NEARER * by_row[:, 1]).all()
        # What is farther from its vertex than a step of tracing may lie beyond it in another chart.
        clear &= bool((by_row[real, 0] < CHORD).all())
        for v, place in smooth if clear else ():
            own = _real_points(closure, points[real & (nearest == v)])
            clear &= bool(are_one_step(closure, own, place).all())
        counts = np.bincount(nearest, minlength=len(special.points))
        if clear and (counts == special.sheets).all() and special.real[nearest[real]].all():
            return _Stop(angle, points, real, nearest)
    raise TracingError("it is not clear at which vertices arcs end")


def _real_points(closure: ProjectiveClosure, points: np.ndarray) -> np.ndarray:
    """Real homogeneous points, from such whose groups have any complex factors."""
    # Affine points over finite values are real, and so are those that are divided by their length.
    return closure.normalise(points.real)


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Vertices, edges and pieces, and why they may not be right; empty otherwise."""

    vertices: tuple[RealVertex, ...]
    edges: tuple[RealEdge, ...]
    pieces: tuple[RealPiece, ...]
    doubt: str


def join_arcs(
    closure: ProjectiveClosure,
    specials: Sequence[SpecialFibre],
    arcs: Sequence[Arc],
    turns: Sequence[Turn],
) -> Skeleton:
    """What arcs make up when those that meet at regular points are one."""
    incident: dict[tuple[int, int], list[tuple[int, int]]] = {
        (k, v): []
        for k, special in enumerate(specials)
        for v in np.flatnonzero(special.real).tolist()
    }
    for a, arc in enumerate(arcs):
        for side, at in enumerate(arc.ends):
            incident[at].append((a, side))
    places = {at: np.real(specials[at[0]].points[at[1]]) for at in incident}
    doubt = ""
    kinds: dict[tuple[int, int], VertexKind] = {}
    for at, ends in incident.items():
        if len(ends) % 2:
            doubt = doubt or "an odd number of arcs meets at a vertex"
        infinite = closure.is_infinite(places[at])
        sheets = int(specials[at[0]].sheets[at[1]])
        if infinite:
            if ends:
                kinds[at] = VertexKind.INFINITE
            continue
        if not ends:
            if sheets > 1:
                kinds[at] = VertexKind.ISOLATED
            elif at in incident:
                doubt = doubt or "a real point lies on no arc"
            continue
        gap = closure.corank_gap(places[at])
        if ROUNDED_AWAY < gap < SINGULAR:
            doubt = doubt or "it is not clear whether the curve is singular at a vertex"
        if gap < SINGULAR or len(ends) != 2:
            kinds[at] = VertexKind.SINGULAR
    index = {at: i for i, at in enumerate(kinds)}
    vertices = tuple(
        RealVertex(kind, _place(closure, places[at], kind)) for at, kind in kinds.items()
    )
    chains = _chains(arcs, incident, set(kinds))
    edges = tuple(_edge(closure, arcs, chain, places, index, turns, kinds) for chain in chains)
    return Skeleton(vertices, edges, _pieces(vertices, edges), doubt)


def _place(closure: ProjectiveClosure, point: np.ndarray, kind: VertexKind) -> np.ndarray:
    if kind is not VertexKind.INFINITE:
        return closure.affine(point[None])[0]
    far = point[len(closure.groups) :].copy()
    for g, group in enumerate(closure.groups):
        # What stays finite is small beside what does not.
        if abs(point[g]) > AT_INFINITY:
            far[list(group)] = 0.0
    size = np.linalg.norm(far)
    return far / size if size else far


Chain = list[tuple[int, int]]


def _chains(
    arcs: Sequence[Arc],
    incident: dict[tuple[int, int], list[tuple[int, int]]],
    stops: set[tuple[int, int]],
) -> list[Chain]:
    """Arcs in a row, each with the side at which it begins, from stop to stop or round."""
    left = set(range(len(arcs)))
    chains: list[Chain] = []

    def follow(a: int, side: int) -> Chain:
        chain = []
        while True:
            chain.append((a, side))
            left.discard(a)
            at = arcs[a].ends[1 - side]
            if at in stops:
                return chain
            others = [e for e in incident[at] if e != (a, 1 - side)]
            if not others or others[0][0] not in left:
                return chain
            a, side = others[0]

    for at in incident:
        if at in stops:
            for a, side in incident[at]:
                if a in left:
                    chains.append(follow(a, side))
    while left:
        chains.append(follow(min(left), 0))
    return chains


def _edge(
    closure: ProjectiveClosure,
    arcs: Sequence[Arc],
    chain: Chain,
    places: dict[tuple[int, int], np.ndarray],
    index: dict[tuple[int, int], int],
    turns: Sequence[Turn],
    kinds: dict[tuple[int, int], VertexKind],
) -> RealEdge:
    begin = arcs[chain[0][0]].ends[chain[0][1]]
    end = arcs[chain[-1][0]].ends[1 - chain[-1][1]]
    rows: list[np.ndarray] = [places[begin][None]]
    for a, side in chain:
        arc = arcs[a]
        rows += [arc.points[:: 1 if side == 0 else -1], places[arc.ends[1 - side]][None]]
    points = np.vstack(rows)
    # Infinite ones are not on the arc.
    points = points[kinds.get(begin) is VertexKind.INFINITE :]
    points = points[:-1] if kinds.get(end) is VertexKind.INFINITE else points
    if begin not in index:
        points = _begun_afar(closure, points)
    for i in range(1, len(points)):
        points[i] = closure.align_signs(points[i : i + 1], points[i - 1])[0]
    affine = closure.refined(closure.affine(even_points(closure, points, turns)))
    if begin not in index:
        affine[-1] = affine[0]
    for v, at in ((begin, 0), (end, -1)):
        if v in index and kinds[v] is not VertexKind.INFINITE:
            affine[at] = closure.affine(places[v][None])[0]
    return RealEdge(index.get(begin), index.get(end), affine, chart_of(affine, turns))


def _begun_afar(closure: ProjectiveClosure, points: np.ndarray) -> np.ndarray:
    """A loop that begins as far from infinity as it may, at the first of points as far."""
    count = len(closure.groups)
    far = np.abs(points[:-1, :count]).min(axis=1)
    # Points on circles are all as far, and rounding is not to choose among them.
    first = int((far > (1 - AS_FAR) * far.max()).argmax())
    return np.vstack([points[first:-1], points[: first + 1]])


def connect(pairs: Sequence[tuple[int, int]]) -> dict[int, int]:
    """For each number one of those that pairs connect it with, the same for all of them."""
    parent: dict[int, int] = {}

    def root(v: int) -> int:
        while parent.setdefault(v, v) != v:
            v = parent[v]
        return v

    for v, w in pairs:
        parent[root(v)] = root(w)
    return {v: root(v) for v in list(parent)}


def _pieces(vertices: Sequence[RealVertex], edges: Sequence[RealEdge]) -> tuple[RealPiece, ...]:
    """Connected pieces; at infinity nothing is connected."""

    def finite(edge: RealEdge) -> list[int]:
        ends = [v for v in (edge.start, edge.end) if v is not None]
        return [v for v in ends if vertices[v].kind is not VertexKind.INFINITE]

    roots = connect([(own[0], own[-1]) for edge in edges if (own := finite(edge))])
    groups: dict[int, list[int]] = {}
    pieces: list[RealPiece] = []
    for k, edge in enumerate(edges):
        own = finite(edge)
        if own:
            groups.setdefault(roots[own[0]], []).append(k)
        else:
            ends = tuple(sorted({v for v in (edge.start, edge.end) if v is not None}))
            kind = PieceKind.CLOSED_LOOP if edge.closed else PieceKind.OPEN_ARC
            pieces.append(RealPiece(kind, (k,), ends))
    for own in groups.values():
        ends = {v for k in own for v in (edges[k].start, edges[k].end) if v is not None}
        pieces.append(RealPiece(PieceKind.ARC_NETWORK, tuple(own), tuple(sorted(ends))))
    for v, vertex in enumerate(vertices):
        if vertex.kind is VertexKind.ISOLATED:
            pieces.append(RealPiece(PieceKind.POINT, (), (v,)))
    return tuple(pieces)
