"""What lengths alone force on real assemblies: bounds of distances, and points in line.

No two places are further apart than a way of sides between them is long (triangle inequalities).
A side that is longer than a way round it forbids real assemblies; one that is as long has the way's
places between its ends, each at a known share of it. Lines that share two places are one, and the
distances along them are known in their turn, until nothing is added. All is exact. In such
assemblies the equations are singular; places in line are linear equations, and with these they need
not be.

Reference:
    Dress & Havel, Shortest-path problems and molecular conformation, Discrete Appl. Math. 19, 1988.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, pairwise, product

from nag.algebra.number import Number, is_zero, square_root
from nag.mechanism.assembly import Side
from nag.text.table import join_words

# Relative rounding of sums of lengths in doubles, with much room: within it they are compared
# exactly.
CLEARLY = 1e-10


@dataclass(frozen=True)
class Way:
    """A length, and the names of the sides that it is the sum of."""

    length: Number
    rounded: float
    names: tuple[str, ...]

    def __add__(self, other: Way) -> Way:
        return Way(
            self.length + other.length,
            self.rounded + other.rounded,
            tuple(dict.fromkeys((*self.names, *other.names))),
        )

    def compared_with(self, other: Way) -> int:
        """-1, 0 or 1 as it is shorter, as long, or longer; exact."""
        gap = self.rounded - other.rounded
        if abs(gap) > CLEARLY * (self.rounded + other.rounded):
            return 1 if gap > 0 else -1
        difference = self.length - other.length
        return 0 if is_zero(difference) else 1 if difference > 0 else -1


# Places in line, with their distances from one of them, in one direction.
Line = dict[str, Number]


@dataclass(frozen=True)
class ForcedLines:
    """What sides force on real assemblies.

    Attributes:
        obstacle: why there is no real assembly; empty where nothing forbids one.
        lines: sets of three places and more that are in line in every real one and are not all
            on one link, each with its coordinate along the line, in lengths.
        stretched: the same in words: which side is as long as which way.
    """

    obstacle: str
    lines: tuple[Line, ...] = ()
    stretched: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """Which places are in line, and by which sides."""
        each = []
        for line in self.lines:
            places = sorted(line, key=lambda p: float(line[p]))
            # Where all but one fall together nothing is in line.
            if sum(not is_zero(line[q] - line[p]) for p, q in pairwise(places)) > 1:
                each.append(join_words(places))
        return ": ".join(
            filter(None, [f"{'; '.join(each)} are in line", "; ".join(self.stretched)])
        )


def find_forced_lines(sides: Sequence[Side]) -> ForcedLines:
    """Which places sides put in line, and whether they forbid real assemblies.

    >>> from fractions import Fraction
    >>> sides = [Side(ends, Fraction(l * l), "".join(ends)) for ends, l in
    ...     [(("A", "B"), 1), (("B", "C"), 2), (("C", "A"), 3)]]
    >>> find_forced_lines(sides).stretched
    ('CA is as long as AB and BC together',)
    """
    zero = Fraction(0)
    lines: list[Line] = [{s.ends[0]: zero, s.ends[1]: square_root(s.squared)} for s in sides]
    names = {frozenset(s.ends): (s.name,) for s in sides}
    links: defaultdict[frozenset[str], frozenset[str]] = defaultdict(frozenset)
    for side in sides:
        links[frozenset(side.ends)] |= {side.name}
    order = [s.name for s in sides]
    lengths = {s.name: square_root(s.squared) for s in sides}
    own_ways = {name: Way(x, float(x), (name,)) for name, x in lengths.items()}
    stretched: list[str] = []
    while True:
        known = _known_distances(lines, names)
        ways = _shortest_ways(known)
        for pair, way in known.items():
            shortest = ways[pair]
            if shortest.compared_with(way) < 0:
                text = join_words(list(shortest.names))
                together = " together" if len(shortest.names) > 1 else ""
                own = join_words(list(way.names))
                are = "are" if len(way.names) > 1 else "is"
                return ForcedLines(f"{own} {are} longer than {text}{together}")
        longer = []
        for line in lines:
            own = _with_places_between(line, ways)
            if len(own) > len(line) == 2:
                way = _way_round(line, own, ways, own_ways)
                if way is not None:
                    first, last = line
                    whole = join_words(sorted(way.names, key=order.index))
                    stretched.append(
                        f"{known[first, last].names[0]} is as long as {whole} together"
                    )
            longer.append(own)
        joined, misfit = _join_lines(longer)
        if misfit:
            return ForcedLines(_misfit_text(misfit, names, order))
        if sorted(map(sorted, joined)) == sorted(map(sorted, lines)):
            # Places of one link that are in line are forced by nothing but its shape.
            of_pairs = [[links[frozenset(p)] for p in combinations(line, 2)] for line in joined]
            kept = tuple(
                line
                for line, each in zip(joined, of_pairs, strict=True)
                if len(line) > 2 and not frozenset.intersection(*each)
            )
            return ForcedLines("", kept, tuple(dict.fromkeys(stretched)))
        lines = joined


def _known_distances(
    lines: Iterable[Line], names: dict[frozenset[str], tuple[str, ...]]
) -> dict[tuple[str, str], Way]:
    """The distances along lines, in both orders of the places."""
    known: dict[tuple[str, str], Way] = {}
    for line in lines:
        own = [names[frozenset(p)] for p in combinations(line, 2) if frozenset(p) in names]
        along = tuple(dict.fromkeys(name for each in own for name in each))
        for first, second in combinations(line, 2):
            gap = line[second] - line[first]
            length = -gap if gap < 0 else gap
            called = names.get(frozenset((first, second)), along)
            way = Way(length, float(length), called)
            known[first, second] = known[second, first] = way
    return known


def _shortest_ways(known: dict[tuple[str, str], Way]) -> dict[tuple[str, str], Way]:
    """The shortest ways between all places that are connected (Floyd & Warshall)."""
    places = list(dict.fromkeys(p for pair in known for p in pair))
    ways = dict(known)
    for middle in places:
        for first, last in product(places, places):
            if first == last or (first, middle) not in ways or (middle, last) not in ways:
                continue
            now = ways.get((first, last))
            parts = ways[first, middle], ways[middle, last]
            if now is not None:
                least = parts[0].rounded + parts[1].rounded
                if least > now.rounded * (1 + CLEARLY):
                    continue
            way = parts[0] + parts[1]
            if now is None or way.compared_with(now) < 0:
                ways[first, last] = way
    return ways


def _way_round(
    line: Line,
    longer: Line,
    ways: dict[tuple[str, str], Way],
    own_ways: dict[str, Way],
) -> Way | None:
    """The sides of one way as long as a side, by places between its ends; None if none is known.

    Distances that are differences of sides are parts of no way.
    """
    first, last = line
    between = sorted((p for p in longer if p not in line), key=lambda p: float(longer[p]))
    for places in ([first, *between, last], *([first, p, last] for p in between)):
        names = {n: None for step in pairwise(places) for n in ways[step].names}
        way = Way(Fraction(0), 0.0, ())
        for name in names:
            way += own_ways[name]
        if len(names) > 1 and way.compared_with(ways[first, last]) == 0:
            return way
    return None


def _with_places_between(line: Line, ways: dict[tuple[str, str], Way]) -> Line:
    """A line, and places that are no further from two of its own than these are apart."""
    first = min(line, key=lambda p: float(line[p]))
    last = max(line, key=lambda p: float(line[p]))
    whole = ways[first, last]
    found = dict(line)
    for (start, place), way in ways.items():
        if start != first or place in found or (place, last) not in ways:
            continue
        if (way + ways[place, last]).compared_with(whole) == 0:
            found[place] = line[first] + way.length
    return found


def _misfit_text(
    misfit: Sequence[str], names: Mapping[frozenset[str], tuple[str, ...]], order: Sequence[str]
) -> str:
    """Which sides are stretched along one line and put a place of it at two.

    Args:
        misfit: the place, and those that are in line with it.
    """
    pairs = (frozenset(pair) for pair in combinations(misfit, 2))
    sides = sorted({n for pair in pairs if pair in names for n in names[pair]}, key=order.index)
    return (
        f"{join_words(sides)} are stretched along one line and put {misfit[0]} at two places of it"
    )


def _join_lines(lines: Sequence[Line]) -> tuple[list[Line], list[str]]:
    """Lines that share two places as one.

    Where these do not fit, a place that would be at two of one line, and the others on it; else
    none.
    """
    left, joined = [dict(line) for line in lines], []
    while left:
        line = left.pop()
        k = 0
        while k < len(left):
            carried = _carry_onto(line, left[k])
            if carried is None:
                k += 1
                continue
            del left[k]
            for place, at in carried.items():
                if not is_zero(line.setdefault(place, at) - at):
                    return [], [place, *(p for p in {**line, **carried} if p != place)]
            # What was passed by may share two places with what it is now.
            k = 0
        joined.append(line)
    return joined, []


def _carry_onto(line: Line, other: Line) -> Line | None:
    """The other line's places in the coordinate of this one; None if they share no two."""
    shared = [p for p in other if p in line]
    for first, second in combinations(shared, 2):
        gap = other[second] - other[first]
        if is_zero(gap):
            continue
        turn = 1 if (line[second] - line[first] > 0) == (gap > 0) else -1
        return {p: line[first] + turn * (at - other[first]) for p, at in other.items()}
    return None
