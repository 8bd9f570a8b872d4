"""Bar-and-joint frameworks: points in the plane or in space, and bars that fix distances.

A realisation is a placement of the points in which every bar has its length; two are the same if a
proper motion carries one to the other. Motions are taken away by pinning one bar in the plane and
in space a triangle of bars, or two bars that meet in their plane, in a frame in which their places
are rational whenever the squared lengths are.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from typing import TYPE_CHECKING, Any

from nag.algebra.from_python import exact_number, exact_vector
from nag.algebra.given import check_listed, value_text
from nag.algebra.number import Number, brief_number_text, is_zero, square_root
from nag.algebra.tokens import is_part_name, part_name_text
from nag.errors import MechanismError
from nag.mechanism.graph import connected_to
from nag.text.table import count_text, lines_of, one_line

if TYPE_CHECKING:
    import networkx

Place = tuple[Number, ...]
Bar = tuple[str, str]

# Squared lengths that are worked with.
LEAST, MOST = Fraction(1, 10**100), Fraction(10**100)


class FrameworkError(MechanismError):
    """A framework that makes no sense.

    Attributes:
        key: the field that is wrong (``points``, ``bars``, ``lengths``), or None.
    """

    def __init__(self, message: str, key: str | None = None) -> None:
        super().__init__(message)
        self.key = key


@dataclass(frozen=True)
class Framework:
    """Points and bars.

    Attributes:
        dimension: 2 or 3.
        points: names.
        bars: pairs of names.
        squared_lengths: one for each bar.
        placement: a place for each point, in which the bars have these lengths, or None.

    Raises:
        FrameworkError: if bars and points do not fit, or the framework is not connected.
    """

    dimension: int
    points: tuple[str, ...]
    bars: tuple[Bar, ...]
    squared_lengths: tuple[Number, ...]
    placement: tuple[Place, ...] | None = None

    @classmethod
    def of(
        cls,
        points: Mapping[str, Sequence[Any]] | Iterable[str],
        bars: Iterable[Sequence[str]],
        lengths: Iterable[Any] | None = None,
        *,
        dimension: int = 2,
    ) -> Framework:
        """The framework of points and bars, by places or by lengths.

        Args:
            points: places by name; where lengths are given, names alone.
            bars: pairs of names.
            lengths: one for each bar.
            dimension: 2 for the plane, 3 for space.

        Raises:
            FrameworkError: if the framework makes no sense.
            nag.EquationError: if something is no number.

        >>> import nag
        >>> bars = ["AB", "BC", "CA"]
        >>> len(nag.solve(nag.Framework.of("ABC", bars, [3, 4, 5])))
        2
        """
        check_listed(bars, "bars", "a list of pairs of names")
        pairs = [_bar_of(bar, i) for i, bar in enumerate(bars)]
        if getattr(points, "ndim", 0) == 2:
            raise FrameworkError(
                "a table is given; give a dict of places by name, {'A': (0, 0)}: of a frame of "
                "pandas whose rows are points frame.T.to_dict('list')",
                "points",
            )
        if hasattr(points, "keys"):
            # A series of pandas is no mapping.
            named: Any = points
            points = dict(named)
        if isinstance(points, Mapping):
            if lengths is not None:
                raise FrameworkError("the points have places, which fix them", "lengths")
            placed = {str(n): exact_vector(p, f"points[{n!r}]") for n, p in points.items()}
            for name, place in placed.items():
                if len(place) != dimension:
                    other = f", or dimension={len(place)}" if len(place) in (2, 3) else ""
                    raise FrameworkError(
                        f"{name!r} has {len(place)} coordinates; give {dimension}{other}", "points"
                    )
            return placed_framework(dimension, placed, pairs)
        lengths = () if lengths is None else lengths
        check_listed([*points] if isinstance(points, str) else points, "points", "a list of names")
        check_listed(lengths, "lengths", "a list, one for each bar")
        given = [exact_number(x, f"lengths[{i}]") for i, x in enumerate(lengths)]
        if len(given) != len(pairs):
            raise FrameworkError(f"{len(given)} are given for {len(pairs)} bars", "lengths")
        for (first, second), length in zip(pairs, given, strict=True):
            if not length > 0:
                raise FrameworkError(
                    f"that of {first}-{second}, {brief_number_text(length)}, is not positive; "
                    "a bar has a positive length",
                    "lengths",
                )
        names = tuple(str(name) for name in points)
        return cls(dimension, names, tuple(pairs), tuple(x * x for x in given))

    def __post_init__(self) -> None:
        for field in ("points", "bars"):
            object.__setattr__(self, field, tuple(getattr(self, field)))
        squared = (Fraction(x) if isinstance(x, int) else x for x in self.squared_lengths)
        object.__setattr__(self, "squared_lengths", tuple(squared))
        if not self.points:
            raise FrameworkError("none are given; a framework has points", "points")
        for name in self.points:
            if not is_part_name(name):
                raise FrameworkError(part_name_text(name, "point"), "points")
        if len(set(self.points)) != len(self.points):
            name = next(p for i, p in enumerate(self.points) if p in self.points[:i])
            raise FrameworkError(f"two points are named {name!r}; name each point once", "points")
        for squared in self.squared_lengths:
            # Products of some of them are formed.
            if not LEAST < squared < MOST and not is_zero(squared):
                raise FrameworkError(
                    "not all are between 1e-50 and 1e50; scale them",
                    "lengths" if self.placement is None else "points",
                )
        seen: set[frozenset[str]] = set()
        for first, second in self.bars:
            for name in (first, second):
                if name not in self.points:
                    raise FrameworkError(f"a bar ends in {name!r}, which is no point", "bars")
            if first == second:
                raise FrameworkError(f"a bar joins {first!r} with itself", "bars")
            if frozenset((first, second)) in seen:
                raise FrameworkError(
                    f"{first!r} and {second!r} are joined by two bars; leave one out", "bars"
                )
            seen.add(frozenset((first, second)))
        for (first, second), squared in zip(self.bars, self.squared_lengths, strict=True):
            if is_zero(squared):
                raise FrameworkError(
                    f"the bar from {first!r} to {second!r} has length zero; make its ends one "
                    "point",
                    "bars",
                )
        stray = sorted(set(self.points) - connected_to(self.points[0], self.bars))
        if stray:
            raise FrameworkError(
                f"no bars connect {', '.join(stray)} with {self.points[0]!r}; parts that are not "
                "connected move freely, take them one by one",
                "bars",
            )

    __repr__ = one_line

    def __str__(self) -> str:
        space = "the plane" if self.dimension == 2 else "space"
        given = "by lengths" if self.placement is None else "by places"
        size = f"{count_text(len(self.points), 'point')} and {count_text(len(self.bars), 'bar')}"
        lengths = (
            f"{first}-{second} {_length_text(squared)}"
            for (first, second), squared in zip(self.bars, self.squared_lengths, strict=True)
        )
        return lines_of(f"Framework of {size} in {space}, {given}", [("bars", ", ".join(lengths))])

    @property
    def motions(self) -> int:
        """Dimension of the group of motions."""
        return self.dimension * (self.dimension + 1) // 2

    @property
    def freedoms(self) -> int:
        """Freedoms by counting: coordinates of the points minus motions minus bars."""
        return self.dimension * len(self.points) - self.motions - len(self.bars)

    def squared_length(self, first: str, second: str) -> Number | None:
        """The squared length of the bar between two points, or None."""
        for bar, squared in zip(self.bars, self.squared_lengths, strict=True):
            if set(bar) == {first, second}:
                return squared
        return None

    def points_not_on(self, held: Sequence[str]) -> list[str]:
        """The points that are not held, in order."""
        return [p for p in self.points if p not in held]

    def infinitesimal_motions(self) -> int | None:
        """Velocities of the placement that keep all lengths, modulo motions; None without one.

        Of points on a line in space one motion, the turn about it, moves none of them.
        """
        if self.placement is None:
            return None
        from nag.algebra.exact_ranks import rank

        free = self.dimension * len(self.points) - self._motions_of(self.placement)
        return free - rank(self._rigidity_matrix(self.placement))

    def self_stresses(self) -> int | None:
        """Dependencies of the bars at the placement; None without one."""
        if self.placement is None:
            return None
        from nag.algebra.exact_ranks import rank

        return len(self.bars) - rank(self._rigidity_matrix(self.placement))

    def _motions_of(self, places: Sequence[Place]) -> int:
        """Dimension of the motions' velocities at points: fewer where they span no hyperplane."""
        from nag.algebra.exact_ranks import rank

        rows = [[x - y for x, y in zip(p, places[0], strict=True)] for p in places]
        beside = self.dimension - rank(rows)
        return self.motions - beside * (beside - 1) // 2

    def generic_motions(self) -> int:
        """The same for a general placement: 0 if the graph is rigid for almost all lengths.

        Decided modulo a prime at random places: too large with a probability below 1e-15.
        """
        import random

        from nag.algebra.exact_ranks import LARGE

        draw = random.Random(0)
        places = [
            [draw.randrange(LARGE.modulus) for _ in range(self.dimension)] for _ in self.points
        ]
        rank = LARGE.rank(self._rigidity_matrix(places))
        return self.dimension * len(self.points) - self.motions - rank

    def _rigidity_matrix(self, places: Sequence[Sequence[Any]]) -> list[list[Any]]:
        """One row for each bar: its vector at one end, its negative at the other."""
        d, index = self.dimension, {name: i for i, name in enumerate(self.points)}
        rows = []
        for first, second in self.bars:
            i, j = index[first], index[second]
            row: list[Any] = [0 * places[0][0]] * (d * len(self.points))
            for k in range(d):
                row[d * i + k] = places[i][k] - places[j][k]
                row[d * j + k] = places[j][k] - places[i][k]
            rows.append(row)
        return rows

    def triangles(self) -> Iterable[tuple[str, str, str]]:
        """Triples of points with all bars between them."""
        joined = {frozenset(bar) for bar in self.bars}
        for triple in combinations(self.points, 3):
            if all(frozenset(pair) in joined for pair in combinations(triple, 2)):
                yield triple

    def bars_that_meet(self) -> Iterable[tuple[str, str, str]]:
        """Triples but no triangles, their first point joined to both others; most bars first."""
        count = Counter(point for bar in self.bars for point in bar)
        most = sorted(self.points, key=lambda p: -count[p])
        joined = {frozenset(bar) for bar in self.bars}
        for first in most:
            ends = [p for p in most if frozenset((first, p)) in joined]
            for second, third in combinations(ends, 2):
                if frozenset((second, third)) not in joined:
                    yield first, second, third


def _length_text(squared: Number) -> str:
    """A length, exactly where it has a short text."""
    length = square_root(squared)
    return brief_number_text(length)


def placed_framework(dimension: int, placement: dict[str, Place], bars: Sequence[Bar]) -> Framework:
    """The framework whose bars have the lengths that a placement gives them."""
    squared = []
    for first, second in bars:
        for name in (first, second):
            if name not in placement:
                raise FrameworkError(f"a bar ends in {name!r}, which is no point", "bars")
        gap = [x - y for x, y in zip(placement[first], placement[second], strict=True)]
        squared.append(sum((x * x for x in gap), Fraction(0)))
    return Framework(
        dimension, tuple(placement), tuple(bars), tuple(squared), tuple(placement.values())
    )


def _bar_of(bar: Any, index: int) -> Bar:
    """The two points that a bar joins.

    Raises:
        FrameworkError: if they are not two.
    """
    ends = tuple(map(str, bar)) if isinstance(bar, Iterable) else ()
    if len(ends) != 2:
        raise FrameworkError(
            f'bars[{index}]: {value_text(bar)} is given; give a pair of points, ("A", "B"), '
            "and lengths apart"
        )
    return ends


def framework_of_graph(graph: networkx.Graph, dimension: int = 2) -> Framework:
    """A networkx graph as a framework: its edges are the bars.

    Lengths are those of the edges' attribute ``length``, or of the placement that the nodes'
    attribute ``pos`` gives. Numbers may be exact or decimals, which are taken as they are written.

    Args:
        dimension: 2 for the plane, 3 for space.

    Raises:
        FrameworkError: if neither attribute is everywhere, or the framework makes no sense.

    >>> import nag, networkx
    >>> square = networkx.cycle_graph(["A", "B", "C", "D"])
    >>> networkx.set_edge_attributes(square, 1, "length")
    >>> nag.mobility(nag.framework_of_graph(square)).local_dimension
    1
    """
    if not hasattr(graph, "edges") or not hasattr(graph, "nodes"):
        raise FrameworkError(f"graph: {value_text(graph)} is given; give a networkx graph")
    names = [str(node) for node in graph.nodes]
    bars = [(str(a), str(b)) for a, b in graph.edges]
    lengths = [data.get("length") for _, _, data in graph.edges(data=True)]
    if bars and all(x is not None for x in lengths):
        squared = [exact_number(x, "length") ** 2 for x in lengths]
        return Framework(dimension, tuple(names), tuple(bars), tuple(squared))
    places = {str(node): data.get("pos") for node, data in graph.nodes(data=True)}
    if any(place is None or len(place) != dimension for place in places.values()):
        raise FrameworkError(
            f"give every edge a 'length', or every node a 'pos' of {dimension} coordinates"
        )
    exact = {name: exact_vector(place, "pos") for name, place in places.items()}
    return placed_framework(dimension, exact, bars)
