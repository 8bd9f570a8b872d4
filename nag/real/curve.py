"""The real part of a curve: its vertices, edges and connected pieces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.numerics.read_only import RealArray, Several, equal_values, fixed_array
from nag.text.table import data_frame, named_apart, one_line

if TYPE_CHECKING:
    import networkx
    import pandas

# Of documents.
FORMAT, VERSION = "nag-real-curve", 1


class VertexKind(StrEnum):
    """What a vertex is.

    At a singular one the rank of the equations drops on the curve: branches of it meet, it has a
    cusp, or it meets another component. An isolated one is no end of an edge. At an infinite one
    the curve leaves the affine space, in a direction that no turn of a joint reaches.
    """

    SINGULAR = "singular"
    ISOLATED = "isolated"
    INFINITE = "infinite"


class PieceKind(StrEnum):
    """What a connected piece is."""

    CLOSED_LOOP = "closed loop"
    ARC_NETWORK = "arc network"
    OPEN_ARC = "open arc"
    POINT = "isolated point"


class PictureVerdict(StrEnum):
    """Whether the picture is complete."""

    COMPLETE = "complete"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Turn:
    """A variable ``y`` of which infinity is an ordinary value: that of a half-angle.

    The joint has turned by twice ``u = atan2(y - centre, radius)``, but for a constant.

    Attributes:
        variable: its index.
        centre, radius: the zeros of the factor's norm are ``centre +- radius i``.
    """

    variable: int
    centre: float
    radius: float

    def angles(self, y: np.ndarray) -> np.ndarray:
        """The half-angles ``u`` of values, within a quarter turn of zero."""
        return np.arctan2(y - self.centre, self.radius)


@dataclass(frozen=True, eq=False)
class RealVertex:
    """A point of the curve at which something is special.

    Attributes:
        kind: what it is.
        point: shape ``(n,)``; of an infinite one a direction of length one.
    """

    kind: VertexKind
    point: RealArray

    __eq__ = equal_values

    def __post_init__(self) -> None:
        object.__setattr__(self, "kind", VertexKind(self.kind))
        object.__setattr__(self, "point", fixed_array(self.point, float))


@dataclass(frozen=True, eq=False)
class RealEdge:
    """A smooth arc of the curve, from vertex to vertex, or a loop without a vertex.

    Attributes:
        start, end: indices of the vertices; both are None of a loop without one.
        points: in their order along the arc, shape ``(k, n)``, finite vertices included; of a loop
            the last is the first. Values of turns are large near infinity, through which the arc
            may go, and known relative to their own size there.
        chart: the same with the half-angles ``u`` in radians in the place of turns, continuous
            along the arc, shape ``(k, n)``, see `Turn`. A joint that turns fully on a loop has a
            last value that is off the first one by a multiple of pi.
    """

    start: int | None
    end: int | None
    points: RealArray
    chart: RealArray

    __eq__ = equal_values

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", fixed_array(self.points, float))
        object.__setattr__(self, "chart", fixed_array(self.chart, float))

    @property
    def closed(self) -> bool:
        """Whether it is a loop without a vertex."""
        return self.start is None

    def __len__(self) -> int:
        return len(self.points)


@dataclass(frozen=True)
class RealPiece:
    """A connected piece.

    Attributes:
        kind: a loop without vertices; arcs that meet at vertices; an arc from infinity to infinity;
            or a point.
        edges, vertices: indices of those that it consists of.
    """

    kind: PieceKind
    edges: tuple[int, ...]
    vertices: tuple[int, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "kind", PieceKind(self.kind))


@dataclass(frozen=True, eq=False)
class RealCurve(Several[RealPiece]):
    """All real points of a one-dimensional component, as a graph.

    Attributes:
        variables: names, in the order of coordinates.
        turns: variables of which infinity is an ordinary value.
        vertices, edges, pieces: what it consists of; all are empty where it has no real points.
        verdict: complete where all checks passed.
        reason: what is not decided; empty otherwise.
        critical_values: of the projection, real, by which fibres the pieces were told.
        residual: largest relative residual of the equations at the points of edges.
        meetings: points, shape ``(k, n)``, at which the curve passes smoothly and the equations are
            singular: it meets other components there, real ones or not. None where they are not
            known: of curves that are not reduced, on which an equation's factor vanishes, or of
            which only differences of points told the critical values.
    """

    variables: tuple[str, ...]
    turns: tuple[Turn, ...]
    vertices: tuple[RealVertex, ...]
    edges: tuple[RealEdge, ...]
    pieces: tuple[RealPiece, ...]
    verdict: PictureVerdict
    reason: str = ""
    critical_values: tuple[float, ...] = ()
    residual: float = field(default=0.0, compare=False)
    meetings: np.ndarray | None = None

    __eq__ = equal_values

    def __post_init__(self) -> None:
        object.__setattr__(self, "verdict", PictureVerdict(self.verdict))
        if self.meetings is not None:
            object.__setattr__(self, "meetings", fixed_array(self.meetings, float))

    @property
    def entries(self) -> tuple[RealPiece, ...]:
        """The connected pieces."""
        return self.pieces

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each point of an arc: the arc's number, from 0, and its coordinates.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        numbers = [np.full(len(edge.points), k) for k, edge in enumerate(self.edges)]
        points = [edge.points for edge in self.edges]
        whole = np.vstack([*points, np.zeros((0, len(self.variables)))])
        own = dict(zip(self.variables, whole.T, strict=True))
        (name,) = set(named_apart(own, {"edge": 0})) - set(own)
        return data_frame({name: np.concatenate([*numbers, np.zeros(0, dtype=int)])} | own)

    @property
    def complete(self) -> bool:
        """Whether the picture is complete."""
        return self.verdict is PictureVerdict.COMPLETE

    @cached_property
    def graph(self) -> networkx.MultiGraph:
        """Vertices by their indices, and edges with theirs as key.

        Nodes have the attributes ``kind`` and ``point``, edges ``points``. A loop without a vertex
        stands at a node ``("loop", edge)`` of its own, of kind ``"loop"``.
        """
        import networkx

        graph = networkx.MultiGraph()
        for i, vertex in enumerate(self.vertices):
            graph.add_node(i, kind=str(vertex.kind), point=vertex.point)
        for k, edge in enumerate(self.edges):
            start, end = (("loop", k) if v is None else v for v in (edge.start, edge.end))
            if edge.closed:
                graph.add_node(start, kind="loop", point=edge.points[0])
            graph.add_edge(start, end, key=k, points=edge.points)
        return graph

    def counted(self) -> dict[PieceKind, int]:
        """How many pieces there are of each kind."""
        return {
            kind: count for kind in PieceKind if (count := sum(p.kind is kind for p in self.pieces))
        }

    def rows(self) -> list[list[str]]:
        """Headings, and one row for each piece."""
        from nag.real.shown import piece_rows

        return piece_rows(self)

    def document(self) -> dict[str, Any]:
        """The curve as a JSON object of the format `FORMAT`."""
        return {
            "format": FORMAT,
            "version": VERSION,
            "variables": list(self.variables),
            "turns": [
                {"variable": self.variables[t.variable], "centre": t.centre, "radius": t.radius}
                for t in self.turns
            ],
            "verdict": str(self.verdict),
            "reason": self.reason,
            "critical_values": list(self.critical_values),
            "residual": self.residual,
            "meetings": None if self.meetings is None else self.meetings.tolist(),
            "vertices": [{"kind": str(v.kind), "point": v.point.tolist()} for v in self.vertices],
            "edges": [
                {
                    "start": e.start,
                    "end": e.end,
                    "points": e.points.tolist(),
                    "chart": e.chart.tolist(),
                }
                for e in self.edges
            ],
            "pieces": [
                {"kind": str(p.kind), "edges": list(p.edges), "vertices": list(p.vertices)}
                for p in self.pieces
            ],
        }

    __repr__ = one_line

    def __str__(self) -> str:
        from nag.real.shown import curve_text

        return curve_text(self)

    def _repr_html_(self) -> str:
        from nag.real.shown import curve_html

        return curve_html(self)


def chart_of(points: np.ndarray, turns: Sequence[Turn]) -> np.ndarray:
    """Points along an arc with continuous half-angles in the place of turns, shape ``(k, n)``."""
    chart = np.array(points, dtype=float)
    for turn in turns:
        column = turn.angles(chart[:, turn.variable])
        chart[:, turn.variable] = np.unwrap(column, period=np.pi)
    return chart
