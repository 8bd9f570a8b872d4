"""Overconstrained linkages: what lines of revolute joints in one loop satisfy, and their names.

Loops of four to six revolute joints that move though counting says that they are rigid, told by the
lengths a, twists alpha and offsets d of their links (Denavit & Hartenberg), each up to the
directions of the axes; conditions from Chen & You, *Motion Structures* (2012), chapter 2. They are
those of the lines alone: a loop that satisfies them may still be assembled where it does not move.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import pi

import numpy as np

from nag.mechanism.axes import cross
from nag.numerics.zero_values import ON

Array = np.ndarray


@dataclass(frozen=True)
class Links:
    """Denavit and Hartenberg's numbers of a loop, read from some joint on, in some direction.

    Attributes:
        axis, point: the lines.
        length, twist: of the link from each line to the next; lengths are not negative, twists are
            angles modulo half turns.
        offset: along each line, from the link before to the next one; None if neighbours are
            parallel, so that there is none.
        close: up to what lengths and sines are the same.
    """

    axis: Array
    point: Array
    length: Array
    twist: Array
    offset: Array | None
    close: float

    @property
    def n(self) -> int:
        """Number of links."""
        return len(self.length)

    @property
    def without_offsets(self) -> bool:
        """Whether all offsets are zero."""
        return self.offset is not None and bool(np.abs(self.offset).max() < self.close)

    def same(self, a: float, b: float) -> bool:
        """Whether two lengths are the same."""
        return abs(a - b) < self.close

    def same_angle(self, a: float, b: float) -> bool:
        """Whether two twists are the same up to half turns."""
        return bool(abs(np.sin(a - b)) < self.close)

    def readings(self) -> Iterator[Links]:
        """The same from every joint on, in both directions."""
        backwards = links_of(self.axis[::-1], self.point[::-1], self.close)
        for each in (self, backwards):
            for start in range(self.n):
                turn = (np.arange(self.n) + start) % self.n
                yield Links(
                    each.axis[turn],
                    each.point[turn],
                    each.length[turn],
                    each.twist[turn],
                    None if each.offset is None else each.offset[turn],
                    self.close,
                )


def known_linkage(axis: Array, point: Array, close: float = ON) -> str | None:
    """The name of the overconstrained linkage whose axes these lines are, in their order.

    Args:
        axis: directions, shape (n, 3).
        point: a point of each, shape (n, 3).
        close: up to what lengths and sines are the same.

    Returns:
        the name with its article, or None if it is none of those that are known here.

    >>> corners = np.array([[0.0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]])
    >>> known_linkage(np.array([[0.0, 0, 1]] * 4), corners)
    'a planar linkage'
    """
    axis = axis / np.linalg.norm(axis, axis=1, keepdims=True)
    n = len(axis)
    if _parallel(axis, close):
        return "a planar linkage"
    if _concurrent(axis, point, close):
        return "a spherical linkage"
    readings = list(links_of(axis, point, close).readings())
    if n == 4 and _is_bennett(readings[0]):
        return "a Bennett linkage"
    if n == 5:
        for name, holds in (("Myard", _is_myard), ("Goldberg", _is_goldberg)):
            if any(map(holds, readings)):
                return f"a {name} 5R linkage"
    return _name_of_six(readings) if n == 6 else None


def _name_of_six(readings: Sequence[Links]) -> str | None:
    if any(_parallel(r.axis[:3], r.close) and _parallel(r.axis[3:], r.close) for r in readings):
        return "a Sarrus linkage"
    if any(map(_is_double_goldberg, readings)):
        return "a Goldberg 6R linkage"
    kinds = [
        name
        for name, holds in (
            ("line-symmetric", _is_line_symmetric),
            ("plane-symmetric", _is_plane_symmetric),
            ("trihedral", _is_trihedral),
        )
        if any(map(holds, readings))
    ]
    if not kinds:
        return None
    octahedral = readings[0].length.max() < readings[0].close
    return f"a {' and '.join(kinds)} Bricard {'octahedron' if octahedral else 'linkage'}"


def _parallel(axis: Array, close: float) -> bool:
    return bool(np.abs(np.cross(axis, axis[0])).max() < close)


def _concurrent(axis: Array, point: Array, close: float) -> bool:
    """Whether all lines pass through one point."""
    across = np.eye(3) - axis[:, :, None] * axis[:, None, :]
    right = np.einsum("kij,kj->i", across, point)
    centre = np.linalg.lstsq(across.sum(axis=0), right, rcond=None)[0]
    return bool(np.abs(np.einsum("kij,kj->ki", across, point - centre)).max() < close)


def _cross(u: Array, v: Array) -> Array:
    """The vector product of two vectors, for which numpy's own takes ten times as long."""
    return np.array(cross(u.tolist(), v.tolist()))


def links_of(axis: Array, point: Array, close: float = ON) -> Links:
    """Lengths, twists and offsets of the links between lines; normals go from line to line.

    Args:
        axis: unit directions, shape (n, 3).
        point: a point of each, shape (n, 3).
        close: up to what lengths and sines are the same; neighbours are parallel up to that.
    """
    n = len(axis)
    length, twist = np.zeros(n), np.zeros(n)
    feet: list[tuple[Array, Array] | None] = []
    for i in range(n):
        u, v = axis[i], axis[(i + 1) % n]
        gap = point[(i + 1) % n] - point[i]
        normal = _cross(u, v)
        sine = float(np.linalg.norm(normal))
        if sine < close:
            length[i] = float(np.linalg.norm(gap - (gap @ u) * u))
            feet.append(None)
            continue
        along = float(gap @ normal) / sine
        # The twist counts about the normal that goes from line to line.
        twist[i] = np.copysign(np.arctan2(sine, u @ v), along)
        length[i] = abs(along)
        s, t = (float(_cross(gap, w) @ normal) / sine**2 for w in (v, u))
        feet.append((point[i] + s * u, point[(i + 1) % n] + t * v))
    offset = np.zeros(n)
    for i in range(n):
        before, after = feet[i - 1], feet[i]
        if before is None or after is None:
            return Links(axis, point, length, twist, None, close)
        offset[i] = float((after[0] - before[1]) @ axis[i])
    return Links(axis, point, length, twist, offset, close)


def _is_bennett(links: Links) -> bool:
    """Whether links are a Bennett linkage's, from whichever joint on they are read."""
    a, sines = links.length, np.abs(np.sin(links.twist))
    return (
        links.without_offsets
        and all(links.same(a[i], a[i + 2]) and links.same(sines[i], sines[i + 2]) for i in (0, 1))
        and links.same(a[0] * sines[1], a[1] * sines[0])
    )


def _bennett_lines(links: Links, lines: Sequence[int]) -> list[tuple[Array, Array]]:
    """The fourth line of a Bennett linkage, after three neighbouring ones: directions and points.

    The linkage is symmetric to a line: half a turn about it takes the first to the third, and so
    the fourth is where it takes the second.
    """
    first, second, third = lines
    u, v = links.axis[first], links.axis[third]
    feet = links_of(links.axis[[first, third]], links.point[[first, third]], links.close)
    if feet.offset is None:
        return []
    gap = links.point[third] - links.point[first]
    normal = _cross(u, v)
    s, t = (float(_cross(gap, w) @ normal) / float(normal @ normal) for w in (v, u))
    middle = (links.point[first] + s * u + links.point[third] + t * v) / 2
    found = []
    for along in (u + v, u - v):
        half_turn = 2 * np.outer(along, along) / (along @ along) - np.eye(3)
        axis = half_turn @ links.axis[second]
        point = middle + half_turn @ (links.point[second] - middle)
        four = (
            np.vstack([links.axis[list(lines)], axis]),
            np.vstack([links.point[list(lines)], point]),
        )
        if _is_bennett(links_of(*four, links.close)):
            found.append((axis, point))
    return found


def _is_goldberg(links: Links) -> bool:
    """Two Bennett linkages with a common link, which is left out with one of its joints.

    Lines 0, 1, 2 and lines 2, 3, 4 have one and the same fourth line.
    """
    return any(
        _same_line(first, second, links.close)
        for first in _bennett_lines(links, (0, 1, 2))
        for second in _bennett_lines(links, (2, 3, 4))
    )


def _is_double_goldberg(links: Links) -> bool:
    """A Goldberg 5R linkage and a Bennett linkage with a common link, left out likewise."""
    for axis, point in _bennett_lines(links, (0, 1, 2)):
        rest = [2, 3, 4, 5]
        axes, points = np.vstack([links.axis[rest], axis]), np.vstack([links.point[rest], point])
        if any(map(_is_goldberg, links_of(axes, points, links.close).readings())):
            return True
    return False


def _same_line(first: tuple[Array, Array], second: tuple[Array, Array], close: float) -> bool:
    (u, p), (v, q) = first, second
    apart = [*_cross(u, v), *_cross(q - p, u)]
    return max(map(abs, apart)) < close


def _is_myard(links: Links) -> bool:
    """Two Bennett linkages of right angles, images of each other in a plane, and side by side."""
    a, twist = links.length, links.twist
    return (
        links.without_offsets
        and all(links.same_angle(twist[i], pi / 2) for i in (1, 3))
        and links.same(a[0], a[4])
        and links.same(a[1], a[3])
        and links.same(a[2], 0)
        and links.same_angle(twist[0], -twist[4])
        and any(links.same_angle(twist[2], sign * 2 * twist[0]) for sign in (1, -1))
        and links.same(a[0], a[1] * abs(np.sin(twist[0])))
    )


def _is_line_symmetric(links: Links) -> bool:
    a, twist, d = links.length, links.twist, links.offset
    return (
        d is not None
        and all(links.same(a[i], a[i + 3]) for i in range(3))
        and all(links.same_angle(twist[i], twist[i + 3]) for i in range(3))
        and all(links.same(abs(d[i]), abs(d[i + 3])) for i in range(3))
    )


def _is_plane_symmetric(links: Links) -> bool:
    """Lines 0 and 3 in the plane or across it, the others images of each other."""
    a, twist, d = links.length, links.twist, links.offset
    return (
        d is not None
        and all(links.same(a[i], a[5 - i]) for i in range(3))
        and all(links.same_angle(twist[i], -twist[5 - i]) for i in range(3))
        and links.same(d[0], 0)
        and links.same(d[3], 0)
        and all(links.same(abs(d[i]), abs(d[6 - i])) for i in (1, 2))
    )


def _is_trihedral(links: Links) -> bool:
    squares = links.length**2
    return (
        links.without_offsets
        and all(links.same_angle(x, pi / 2) for x in links.twist)
        and links.same(squares[::2].sum(), squares[1::2].sum())
    )
