"""Nearly mobile: how far a rigid mechanism's loops open when it is moved along as if it were not.

Rounded numbers make an overconstrained linkage rigid, exactly so, and uselessly. Here one joint is
driven, all others follow by least squares, and the largest gap over the whole motion is what play
the joints need; where it has more freedoms than one but for rounding, all but one are held. The
least change of the axes that closes the loops at several positions says next to which linkage it
is. Nothing of that says that the mechanism moves.

Every joint is a product of turns and slides, q in all, exponentials of their screws in the
reference configuration, q = 0. The gap of a loop is its product's quaternion and the place to which
it takes the mechanism's centre, the point nearest to all axes. Everything is in doubles, in units
of the mechanism's size; derivatives by q are the placed screws, those by the axes are by complex
steps, which lose no digits (Squire & Trapp, Using complex variables to estimate derivatives of real
functions, 1998).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from itertools import pairwise
from math import atan2, hypot, inf, isfinite, pi
from typing import Any

import numpy as np

from nag.algebra.given import check_type, value_text
from nag.errors import NagError
from nag.mechanism.axes import cross, difference
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.lines import has_place, median_of_places, middle_of, nearest_on_axis
from nag.mechanism.loops import Loop, loop_structure
from nag.mechanism.overconstrained import known_linkage
from nag.mechanism.quaternion import multiply
from nag.numerics.double_newton import Stop, count_above, find_zeros
from nag.numerics.double_ranks import is_regular
from nag.numerics.doubles import ARRIVED, ROUNDED
from nag.numerics.linear_algebra_threads import limit_scipy
from nag.numerics.zero_values import ON
from nag.text.table import join_words

# Arc of joint coordinates from one position to the next, radians or sizes of the mechanism; where
# the motion bends, steps are halved down to the shortest.
STEP = 0.1
SHORTEST_STEP = 0.1 / 2**6
# Cosine between neighbouring tangents below which a step is halved.
STRAIGHT = 0.998
# Steps shorter than this are round a bend where two motions nearly meet: which of them goes on is
# as uncertain as the numbers.
BEND = STEP / 4
# Steps after which motions that nearly meet have parted.
AWAY = 3
# Positions after which a motion is not followed further.
MOST_POSITIONS = 1000
# Decides: Gaps beyond which a motion is not followed, and the largest tolerance.
WIDEST_GAP = 0.03
# Slides beyond which it is not followed either.
LONGEST_SLIDE = 10.0
# Positions at which the axes are fitted: more than the equations that any of their linkages has.
FITTED = 12
# Conditions that hold up to so many changes were meant: they are of lengths and angles together.
MEANT = 30
# The second fit is at positions of the motion of the first.
FITS = 2
# What closing weighs against changing the axes, when both are least squares: little at first, as a
# fit that must close from the outset stays at the next best linkage.
WEIGHTS = (1e1, 1e3, 1e5)
# Decides: Gaps of a loop, over its size, that rounding leaves.
ROUNDING = 1e-11
# Step of derivatives by complex numbers.
COMPLEX_STEP = 1e-40
# Steps to a position, which end with one that is too short to matter.
MOST_STEPS = 8
# The fit goes on until nothing changes, within so many evaluations.
MOST_EVALUATIONS = 200
# Steps that close what is left, at least and at most; directions that change a gap by less than a
# small part are none.
FEWEST_CLOSING, MOST_CLOSING = 3, 12
SMALL = 1e-8
# Decides: Smallest singular value, beside the next, at which a rigid mechanism may be meant to
# move: that of a linkage that moves is of the order of its numbers' rounding, and drawings have
# four digits, or three.
HINT = 1e-3

Array = np.ndarray


@dataclass(frozen=True)
class LoopLinkage:
    """The overconstrained linkage that a loop becomes by a change of its axes.

    Attributes:
        joints: the loop's, in order.
        linkage: which one it is, with its article; None if that is none that is known.
        next_to: one that it is up to the size of the change, if that is another one: the family of
            what moves may be larger, and the least change ends in it.
    """

    joints: tuple[str, ...]
    linkage: str | None
    next_to: str | None

    def __str__(self) -> str:
        words = [] if self.linkage is None else [self.linkage]
        if self.next_to is not None:
            words.append(f"next to {self.next_to}")
        return ", ".join(words)


@dataclass(frozen=True)
class NearMotion:
    """How a mechanism that is rigid as it is given would move, if its loops were let open a little.

    Angles are in radians; lengths in the mechanism's unit.

    Attributes:
        tolerance: the largest gap and change, in radians and parts of ``size``, of what is called
            nearly mobile.
        size: of the mechanism: mean distance of its axes from their centre, or, where they all but
            meet there, that of the joints' points; 1 if these are there too.
        singular_values: the smallest and the next one of the loops' closure, in radians and sizes.
        driven: the joint that turns most to first order, or slides most where hardly any turns.
        held: joints that are held, where without that it would have more freedoms than one.
        driven_to: how far it goes either way, by radians or in length.
        slides: whether it slides.
        whole: whether that is the whole motion: it came back to where it began.
        gap: the largest over the motion, an angle and a length.
        change: the largest angle and the largest distance by which an axis must be changed for all
            loops to close at `FITTED` positions; None if there is no such change nearby.
        left_open: the largest gap over the whole motion after that.
        linkages: what is known of each loop after that.
        radius: of turns alone: how far from the point nearest to all axes the links must be for
            turns about that point to be within tolerance; None of others, where such turns are not
            sure to move, and where the size is such a distance.
    """

    tolerance: float
    size: float
    singular_values: tuple[float, float]
    driven: str
    held: tuple[str, ...]
    driven_to: tuple[float, float]
    slides: bool
    whole: bool
    gap: tuple[float, float]
    change: tuple[float, float] | None
    left_open: tuple[float, float] | None
    linkages: tuple[LoopLinkage, ...]
    radius: float | None = None

    @property
    def nearly_mobile(self) -> bool:
        """Whether the whole motion takes gaps, and a mobile linkage changes, within tolerance."""
        return not self.obstacle

    @property
    def sentence(self) -> str:
        """Whether it is nearly mobile, in a clause."""
        if self.obstacle:
            return f"nor nearly so within {self.tolerance:g}"
        return f"but nearly does: its loops open by at most {_amount(self.gap)}"

    @property
    def obstacle(self) -> str:
        """Why it is not nearly mobile, in words; empty where it is."""
        if not self.whole:
            return "not all of the motion was followed"
        if self.change is None or self.left_open is None:
            return "no small change of the axes was found that makes it mobile"
        if self._relative(self.left_open) > ROUNDING:
            return "the change that was found does not close all of the motion"
        wider = [
            f"the {name} is {self._relative(amount):.4g}"
            for name, amount in (("gap", self.gap), ("change", self.change))
            if self._relative(amount) > self.tolerance
        ]
        return join_words(wider)

    def _relative(self, amount: tuple[float, float]) -> float:
        """The larger of an angle and a length in sizes."""
        return max(amount[0], amount[1] / self.size)

    @property
    def first_order(self) -> float:
        """How far the driven motion goes to first order until the gap is the tolerance."""
        least = self.singular_values[0]
        return self.tolerance / least if least else inf

    def rows(self) -> list[tuple[str, str]]:
        """Labelled lines."""
        word = "nearly mobile" if self.nearly_mobile else "not nearly mobile"
        size = f"{self.tolerance:g} rad, and {self.tolerance * self.size:.2g} in length"
        text = f"{word} within {size} ({self.tolerance:g} of the size {self.size:.4g})"
        rows = [("tolerance", f"{text}: {self.obstacle}" if self.obstacle else text)]
        if self.radius is not None and self.obstacle:
            text = (
                f"with links at {self.radius:.2g} or more from the point nearest to all axes it "
                "would be nearly mobile, as turns about that point are; most joints are named "
                "nearer to it"
            )
            rows.append(("lengths", text))
        gap = f"the loops open by at most {_amount(self.gap)}"
        rows.append(("motion", f"{self._motion_text()}, {gap}"))
        if self.change is not None:
            text = f"axes changed by at most {_amount(self.change)} close at {FITTED} positions"
            if self.left_open is not None:
                text += f", and over the motion open by at most {_amount(self.left_open)}"
            rows.append(("change", text))
            if self.left_open is not None and self._relative(self.left_open) <= ROUNDING:
                rows += [("then", text) for text in self._linkage_texts()]
        least, following = self.singular_values
        far = f"{self.first_order:.2g}" if self.first_order < 2 * pi else "more than a whole turn"
        text = f"smallest singular value {least:.1e}, the next {following:.1e}"
        rows.append(("1st order", f"{text}: by these alone the gap would come after {far}"))
        return rows

    def _motion_text(self) -> str:
        low, high = self.driven_to
        unit = "" if self.slides else " rad"
        if self.whole and not self.slides and high - low >= 2 * pi - STEP:
            far = "through a whole turn"
        else:
            far = f"from {low:.3g} to {high:.3g}{unit}"
            far += ", all that it goes" if self.whole else ", where it is not followed further"
        others = ""
        if self.held:
            others = f" with {join_words(self.held)} held"
        return f"{self.driven} driven{others} {far}"

    def _linkage_texts(self) -> list[str]:
        named = [x for x in self.linkages if str(x)]
        several = len(self.linkages) > 1
        return [f"{', '.join(x.joints)}: {x}" if several else str(x) for x in named]

    def document(self) -> dict[str, Any]:
        """The same as a JSON object."""
        return {
            "nearly_mobile": self.nearly_mobile,
            "tolerance": self.tolerance,
            "size": self.size,
            "singular_values": list(self.singular_values),
            "first_order": self.first_order if isfinite(self.first_order) else None,
            "driven": self.driven,
            "held": list(self.held),
            "driven_to": list(self.driven_to),
            "whole": self.whole,
            "gap": list(self.gap),
            "change": None if self.change is None else list(self.change),
            "left_open": None if self.left_open is None else list(self.left_open),
            "radius": self.radius,
            "linkages": [
                {"joints": list(x.joints), "linkage": x.linkage, "next_to": x.next_to}
                for x in self.linkages
            ],
        }


def _amount(pair: tuple[float, float]) -> str:
    return f"{pair[0]:.1e} rad and {pair[1]:.1e} in length"


def check_tolerance(tolerance: Any) -> float:
    """A tolerance as a number.

    Raises:
        NagError: if it is none that makes sense.
    """
    check_type(tolerance, (int, float), "tolerance", "a number such as 1e-3")
    if not 0 < tolerance <= WIDEST_GAP:
        shown = value_text(tolerance)
        raise NagError(f"tolerance: {shown} is not positive and at most {WIDEST_GAP:g}")
    return float(tolerance)


def find_near_motion(
    mechanism: Mechanism, tolerance: float, idle: Mapping[tuple[str, ...], int] | None = None
) -> NearMotion | None:
    """The motion that a rigid mechanism would have, if its loops were let open.

    Nothing is drawn at random. None if the mechanism has no loops.

    Args:
        mechanism: what is rigid; of one that moves any of its motions may be found.
        tolerance: in radians, and as a part of the mechanism's size.
        idle: parts of its loops that move by themselves, each the names of its bodies, and with how
            many freedoms; these stand still. A rod between two spherical joints is one.

    Raises:
        NagError: if the tolerance is none.

    >>> import nag
    >>> rounded = [("0", "0", "0", "0", "0", "1"), ("1", "0", "0", "0", "-.861538", ".507692"),
    ...     (".792543", ".574496", ".974902", ".974902", ".205104", ".086592"),
    ...     (".833079", ".793409", "0", ".683552", "-.717730", "-.132743")]
    >>> loop = nag.Mechanism("B0", tuple(
    ...     nag.Joint(f"J{i}", "revolute", (f"B{(i - 1) % 4}", f"B{i}"), line[:3], line[3:])
    ...     for i, line in enumerate(rounded)))
    >>> found = find_near_motion(loop, 1e-5)
    >>> found.nearly_mobile, found.whole, [str(x) for x in found.linkages]
    (True, True, ['a Bennett linkage'])
    """
    tolerance = check_tolerance(tolerance)
    chains = Chains.of(mechanism)
    if chains is None:
        return None
    if idle:
        chains = _hold_idle(chains, idle)
    standing = len(chains.held)
    values, _ = chains.singular()
    chains, tangent = _hold_near_freedoms(chains, tolerance)
    leading = np.isin(np.arange(len(tangent)), chains.telling_coordinates)
    driven = _most_moved(np.abs(tangent) * leading, chains.turning)
    tangent = tangent if tangent[driven] > 0 else -tangent
    walk = _follow_both_ways(chains, tangent)
    near = _find_mobile(chains, walk, tangent, max(tolerance, WIDEST_GAP / 10))
    change, left_open, linkages = None, None, []
    if near is not None:
        fitted, walk = near.chains, near.beside
        change, left_open = chains.change_to(fitted), near.left_open
        linkages = [_linkage_of(fitted, loop, max(change)) for loop in chains.loops]
    widest = chains.widest_gap(walk)
    along = walk.positions[:, driven]
    size = chains.size
    slides = not chains.turning[driven]
    return NearMotion(
        tolerance=tolerance,
        size=size,
        singular_values=(float(values[-1]), float(values[-2] if len(values) > 1 else inf)),
        driven=chains.name_of(driven),
        held=tuple(dict.fromkeys(map(chains.name_of, chains.held[standing:]))),
        driven_to=tuple(float(x) * (size if slides else 1.0) for x in (along.min(), along.max())),
        slides=slides,
        whole=walk.whole,
        gap=(widest[0], widest[1] * size),
        change=None if change is None else (change[0], change[1] * size),
        left_open=None if left_open is None else (left_open[0], left_open[1] * size),
        linkages=tuple(linkages),
        radius=chains.radius_within(tolerance),
    )


def find_spoiled_motion(mechanism: Mechanism) -> str:
    """A hint at a motion that rounding spoiled; empty where the singular values give none."""
    chains = Chains.of(mechanism)
    if chains is None:
        return ""
    values, _ = chains.singular()
    for larger, value in pairwise(values):
        if ROUNDING * HINT < value < HINT * larger:
            return (
                "it may be that only rounding keeps it from moving, as a singular value is "
                f"{value / larger:.0e} of the next; ask with a tolerance, of 0.001 say, how far "
                "its loops would open"
            )
    return ""


@dataclass(frozen=True)
class Screw:
    """One turn or slide of a joint.

    Attributes:
        joint: the joint's number.
        turns: whether it turns.
        line: which of the joint's axes it goes with when that changes; -1 for none, as of a ball.
    """

    joint: int
    turns: bool
    line: int


@dataclass(frozen=True)
class Chains:
    """The loops of a mechanism as products of turns and slides, in units of its size.

    Attributes:
        joints: those of the loops.
        loops: a basis.
        size: of the mechanism, in its own unit.
        screws: the turns and slides of all joints.
        axis: the unit direction of each, shape (n, 3).
        point: a point of each, from the centre, shape (n, 3).
        products: for each loop, numbers of its turns and slides and their signs, in order.
        on_sphere: whether the axes all but meet in a point, and the size is how far from it the
            joints are named.
        held: numbers of screws that stay where they are.
        aside: numbers of screws of joints of what moves by itself, which are where the others
            lead them, but for that.
    """

    joints: tuple[Joint, ...]
    loops: tuple[Loop, ...]
    size: float
    screws: tuple[Screw, ...]
    axis: Array
    point: Array
    products: tuple[tuple[tuple[int, int], ...], ...]
    on_sphere: bool
    held: tuple[int, ...] = ()
    aside: tuple[int, ...] = ()

    @classmethod
    def of(cls, mechanism: Mechanism) -> Chains | None:
        """The loops of a mechanism; None if there are none."""
        structure = loop_structure(mechanism)
        if not structure.loops:
            return None
        screws: list[Screw] = []
        axes: list[Array] = []
        points: list[Array] = []
        named: list[float] = []
        numbers: dict[str, range] = {}
        middle = middle_of(structure.joints, median_of_places(structure.joints), WIDEST_GAP)
        for i, joint in enumerate(structure.joints):
            begin = len(screws)
            near, there = (
                np.array([float(x) for x in difference(p, middle)])
                for p in (nearest_on_axis(joint, middle), joint.point)
            )
            if joint.of_type.keeps_line:
                named.append(float(np.linalg.norm(there)))
            for turns, line, direction in _motions(joint):
                screws.append(Screw(i, turns, line))
                axes.append(direction / np.linalg.norm(direction))
                points.append(near)
            numbers[joint.name] = range(begin, len(screws))
        axis, point = np.array(axes), np.array(points)
        turning = np.array([s.turns for s in screws])
        feet = point - np.sum(point * axis, axis=1, keepdims=True) * axis
        for k, screw in enumerate(screws):
            # Where a joint has one axis, any of its points is as good.
            if len(_lines(structure.joints[screw.joint])) == 1:
                point[k] = feet[k]
        placed = np.array([has_place(structure.joints[s.joint]) for s in screws])
        size = _mean_size(feet[turning & placed])
        # Lines that all but meet in a point are drawn on a sphere about it; the lower median leaves
        # out what is named far along its axis.
        named.sort()
        radius = named[(len(named) - 1) // 2] if named else 0.0
        on_sphere = size <= WIDEST_GAP * radius
        if on_sphere:
            size = radius
        if size <= ROUNDING * (1 + max(abs(float(x)) for x in middle)):
            size = 1.0
        return cls(
            structure.joints,
            structure.loops,
            size,
            tuple(screws),
            axis,
            point / size,
            tuple(_product(loop, numbers) for loop in structure.loops),
            on_sphere,
        )

    @cached_property
    def turning(self) -> Array:
        """Which coordinates are angles."""
        return np.array([s.turns for s in self.screws])

    @cached_property
    def telling_coordinates(self) -> Array:
        """Numbers of the screws that tell where all are."""
        others = [k for k in range(len(self.screws)) if k not in self.aside]
        return np.array(others or range(len(self.screws)))

    def radius_within(self, tolerance: float) -> float | None:
        """How far from their centre turns are nearly turns about it, see `NearMotion.radius`.

        Axes moved there open no loop by more than twice the sum of their distances. Turns about one
        point move where their axes are directions of full rank for each loop, and are more.
        """
        if self.on_sphere or not self.turning.all():
            return None
        rows = np.zeros((3 * len(self.products), len(self.axis)))
        for i, product in enumerate(self.products):
            for k, sign in product:
                rows[3 * i : 3 * i + 3, k] += sign * self.axis[k]
        if len(rows) >= rows.shape[1] or not is_regular(rows.T):
            return None
        feet = np.linalg.norm(np.cross(self.point, self.axis), axis=1)
        return float(2 * feet.sum() * self.size / tolerance)

    def closing(self, q: Array, axis: Array | None = None, point: Array | None = None) -> Array:
        """How far each loop is from closed: twice its quaternion's vector, and where its centre is.

        Args:
            q: shape (..., n), real or complex.
            axis, point: instead of the chains' own, shape (..., n, 3).

        Returns:
            shape (..., 6 loops).
        """
        axis = self.axis if axis is None else axis
        point = self.point if point is None else point
        found = []
        for product in self.products:
            turn, place = _displacement(q, axis, point, self.turning, product)
            # A quaternion and its negative are one rotation.
            sign = np.where(turn[0].real < 0, -2.0, 2.0)
            found += [x * sign for x in turn[1:]] + list(place)
        return np.stack(np.broadcast_arrays(*found), axis=-1)

    def gap(self, q: Array) -> tuple[float, float]:
        """The largest gap of a loop, an angle and a distance in sizes."""
        gaps = []
        for product in self.products:
            turn, place = self._place_factors(q, product)[-1]
            gaps.append((2 * atan2(hypot(*turn[1:]), abs(turn[0])), hypot(*place)))
        return max(g[0] for g in gaps), max(g[1] for g in gaps)

    def widest_gap(self, walk: Walk) -> tuple[float, float]:
        """The largest angle and the largest distance of all gaps on a walk."""
        gaps = [self.gap(q) for q in walk.positions]
        return max(g[0] for g in gaps), max(g[1] for g in gaps)

    def linearised(self, q: Array) -> tuple[Array, Array]:
        """`closing` at q, and its derivative there, shape (6 loops, n).

        A turn or slide moves what comes after it about, or along, where it is placed itself.
        """
        values, slopes = [], np.zeros((6 * len(self.products), len(self.screws)))
        for i, product in enumerate(self.products):
            *placed, (turn, place) = self._place_factors(q, product)
            sign = -2.0 if turn[0] < 0 else 2.0
            values += [x * sign for x in turn[1:]] + place
            for (k, direction), (before, at) in zip(product, placed, strict=True):
                axis, point, turns = self._numbers[k]
                along = _rotate(before, axis)
                column = [0.0, 0.0, 0.0, *along]
                if turns:
                    arm = [x + y for x, y in zip(at, _rotate(before, point), strict=True)]
                    arm = [x - y for x, y in zip(place, arm, strict=True)]
                    about = cross(along, turn[1:])
                    column[:3] = [
                        sign / 2 * (turn[0] * x + y) for x, y in zip(along, about, strict=True)
                    ]
                    column[3:] = cross(along, arm)
                slopes[6 * i : 6 * i + 6, k] += np.array(column) * direction
        return np.array(values), slopes

    @cached_property
    def _numbers(self) -> list[tuple[list[float], list[float], bool]]:
        """Axis, point and whether it turns, of each turn and slide."""
        lines = zip(self.axis.tolist(), self.point.tolist(), self.turning.tolist(), strict=True)
        return list(lines)

    def _place_factors(
        self, q: Array, product: Sequence[tuple[int, int]]
    ) -> list[tuple[Sequence[float], list[float]]]:
        """Where each factor of a product finds what it moves, and at last where that is."""
        amounts, turn, place = q.tolist(), (1.0, 0.0, 0.0, 0.0), [0.0, 0.0, 0.0]
        found = [(turn, place)]
        for k, sign in product:
            axis, point, turns = self._numbers[k]
            own = amounts[k] * sign
            turn, place = _displace(turn, place, own, axis, point, turns, math)
            found.append((turn, place))
        return found

    def singular(self, q: Array | None = None) -> tuple[Array, Array]:
        """Singular values of the closure, one for each coordinate that is not held, and vectors.

        Args:
            q: where; the reference by default.
        """
        q = np.zeros(len(self.screws)) if q is None else q
        free = [k for k in range(len(q)) if k not in self.held]
        _, values, own = np.linalg.svd(self.linearised(q)[1][:, free])
        rows = np.zeros((len(free), len(q)))
        rows[:, free] = own
        return np.append(values, np.zeros(len(rows) - len(values))), rows

    def name_of(self, screw: int) -> str:
        """The joint that a turn or slide is of."""
        return self.joints[self.screws[screw].joint].name

    def across(self, tangent: Array) -> Array:
        """An orthonormal basis of what moves across a direction, as columns."""
        rows = np.vstack([tangent, np.eye(len(tangent))[list(self.held)]])
        return np.linalg.svd(rows)[2][len(rows) :].T

    @cached_property
    def changes(self) -> tuple[tuple[int, int], ...]:
        """What of the drawing can change: a joint's place, (joint, -1), or one of its axes."""
        found: list[tuple[int, int]] = []
        for i, joint in enumerate(self.joints):
            if joint.of_type.turns_about_point or joint.of_type.keeps_line:
                found.append((i, -1))
            found += [(i, line) for line in _lines(joint)]
        return tuple(found)

    def changed_lines(self, change: Array) -> tuple[Array, Array]:
        """Axes and points after a change, shapes (..., n, 3).

        Args:
            change: a translation of each place that can change, and a rotation by twice the arc
                tangent of half its length of each axis, in the order of `changes`; shape
                (..., 3 changes).
        """
        shape = change.shape[:-1]
        axis = np.broadcast_to(self.axis, (*shape, *self.axis.shape)).astype(change.dtype)
        point = np.broadcast_to(self.point, (*shape, *self.point.shape)).astype(change.dtype)
        for k, (joint, line) in enumerate(self.changes):
            own = change[..., 3 * k : 3 * k + 3]
            for i, screw in enumerate(self.screws):
                if screw.joint == joint and line < 0:
                    point[..., i, :] += own
                elif screw.joint == joint and screw.line == line:
                    axis[..., i, :] = _rotate_by_half(own / 2, axis[..., i, :])
        return axis, point

    def with_change(self, change: Array) -> Chains:
        """The same with changed axes and points."""
        axis, point = self.changed_lines(change)
        return replace(self, axis=axis, point=point)

    def change_to(self, other: Chains) -> tuple[float, float]:
        """The largest angle between axes, and the largest distance between points, in sizes."""
        crossed = np.linalg.norm(np.cross(self.axis, other.axis), axis=1)
        angles = np.arctan2(crossed, np.sum(self.axis * other.axis, axis=1))
        places = np.linalg.norm(self.point - other.point, axis=1)
        return float(np.max(angles)), float(np.max(places))


def _lines(joint: Joint) -> tuple[int, ...]:
    """Numbers of the axes that are given of a joint."""
    return tuple(i for i, a in enumerate((joint.axis, joint.second_axis)) if a is not None)


def _motions(joint: Joint) -> list[tuple[bool, int, Array]]:
    """Whether it turns, with which axis it changes, and its direction: for each screw of a joint.

    The factors of `nag.mechanism.joint_factors`; a ball is three turns.
    """
    given = [np.array([float(x) for x in a]) for a in (joint.axis, joint.second_axis) if a]
    found: list[tuple[bool, int, Array]] = []
    kinds = joint.of_type.factors
    for i, kind in enumerate(kinds):
        number = kinds[:i].count(kind)
        if kind == "ball":
            found += [(True, -1, direction) for direction in np.eye(3)]
        elif kind == "plane":
            across = np.linalg.svd(given[0][None])[2][1:]
            found += [(True, 0, given[0]), *((False, 0, direction) for direction in across)]
        else:
            found.append((kind == "turn", number, given[number]))
    return found


def _product(loop: Loop, numbers: dict[str, range]) -> tuple[tuple[int, int], ...]:
    """Numbers of the turns and slides of a loop, and their signs, one after the other."""
    found: list[tuple[int, int]] = []
    for joint, body in zip(loop.joints, loop.bodies, strict=True):
        own = numbers[joint.name]
        forward = joint.bodies[0] == body
        found += [(k, 1) for k in own] if forward else [(k, -1) for k in reversed(own)]
    return tuple(found)


def _mean_size(vectors: Array) -> float:
    """The root of the mean of squared lengths; 0 of none."""
    return float(np.sqrt(np.mean(np.sum(vectors**2, axis=1)))) if len(vectors) else 0.0


def _displacement(
    q: Array, axis: Array, point: Array, turning: Array, product: Sequence[tuple[int, int]]
) -> tuple[Sequence[Any], list[Any]]:
    """A product of turns and slides: its quaternion, and where it takes the centre."""
    turn: Sequence[Any] = [np.ones(1)[0], 0.0, 0.0, 0.0]
    place: list[Any] = [0.0, 0.0, 0.0]
    for k, sign in product:
        u, p = ([rows[..., k, i] for i in range(3)] for rows in (axis, point))
        turn, place = _displace(turn, place, q[..., k] * sign, u, p, turning[k], np)
    return turn, place


def _displace(
    turn: Sequence[Any],
    place: Sequence[Any],
    amount: Any,
    axis: Sequence[Any],
    point: Sequence[Any],
    turns: bool,
    functions: Any,
) -> tuple[Sequence[Any], list[Any]]:
    """A displacement, as its quaternion and where it takes the centre, after one more factor.

    Args:
        functions: the module whose sine and cosine are of the kind of the numbers.
    """
    if not turns:
        moved = _rotate(turn, [amount * x for x in axis])
        return turn, [x + y for x, y in zip(place, moved, strict=True)]
    half = functions.sin(amount / 2)
    own = [functions.cos(amount / 2), *(half * x for x in axis)]
    # The centre goes from 0 to p - R p.
    step = [x - y for x, y in zip(point, _rotate(own, point), strict=True)]
    place = [x + y for x, y in zip(place, _rotate(turn, step), strict=True)]
    return multiply(turn, own), place


def _rotate(turn: Sequence[Any], vector: Sequence[Any]) -> list[Any]:
    """R(turn) v of a unit quaternion."""
    twice = [2 * x for x in cross(turn[1:], vector)]
    again = cross(turn[1:], twice)
    return [v + turn[0] * t + a for v, t, a in zip(vector, twice, again, strict=True)]


def _rotate_by_half(half: Array, vector: Array) -> Array:
    """Cayley's rotation, by twice the arc tangent of the length of ``half``; any numbers."""
    crossed = np.cross(half, vector)
    squared = np.sum(half * half, axis=-1, keepdims=True)
    return vector + 2 / (1 + squared) * (crossed + np.cross(half, crossed))


class End(StrEnum):
    """Why a motion is not followed further."""

    CLOSED = "it is back where it began"
    WIDE = "the gap is wide"
    FAR = "a slide is long"
    LONG = "it is long"


@dataclass(frozen=True)
class Walk:
    """Positions along a motion of chains that close as far as they can.

    Attributes:
        positions: shape (k, n), the reference among them.
        tangents: the direction in which each was reached, shape (k, n).
        ends: why it ends, for each of its ends.
    """

    positions: Array
    tangents: Array
    ends: tuple[End, ...]

    @property
    def whole(self) -> bool:
        """Whether it goes around, or as far as slides are followed."""
        return End.CLOSED in self.ends or self.ends == (End.FAR, End.FAR)

    @property
    def to_bends(self) -> Walk:
        """The part around the reference up to where a step was short, on both sides."""
        steps = np.linalg.norm(np.diff(self.positions, axis=0), axis=1)
        reference = int(np.flatnonzero(~self.positions.any(axis=1))[0])
        short = np.flatnonzero(steps < BEND)
        before, after = short[short < reference], short[short >= reference]
        first = int(before[-1]) + 1 if len(before) else 0
        last = int(after[0]) if len(after) else len(steps)
        own = slice(first, last + 1)
        return Walk(self.positions[own], self.tangents[own], self.ends)

    def close_on(self, chains: Chains) -> Walk:
        """The positions of other chains next to these."""
        found = _close_all_across(chains, self.positions, self.tangents)
        return Walk(found, self.tangents, self.ends)


def follow_motion(chains: Chains, tangent: Array) -> Walk:
    """Follow the motion that opens loops the least, from the reference on.

    Each next position is the one of least squares in the plane across the direction ahead, that of
    the last two steps extrapolated; where it turns away from that, a nearer one is looked for.
    """
    q = np.zeros(len(chains.screws))
    positions, tangents = [q], [tangent]
    bend, before, step = np.zeros(len(q)), STEP, STEP
    left = False
    end = End.LONG
    while len(positions) < MOST_POSITIONS:
        # From the middle of one step to the middle of the next.
        towards = tangents[-1] + bend * (before + step) / 2
        towards = towards / np.linalg.norm(towards)
        ahead = close_across(chains, q + step * towards, towards)
        secant = (ahead - q) / np.linalg.norm(ahead - q)
        if secant @ towards < STRAIGHT and step > SHORTEST_STEP:
            step /= 2
            continue
        bend = (secant - tangents[-1]) * 2 / (before + step)
        q, before, step = ahead, step, min(2 * step, STEP)
        positions.append(q)
        tangents.append(secant)
        if max(chains.gap(q)) > WIDEST_GAP:
            end = End.WIDE
            break
        if np.abs(q[~chains.turning]).max(initial=0) > LONGEST_SLIDE:
            end = End.FAR
            break
        away = np.where(chains.turning, (q + pi) % (2 * pi) - pi, q)[chains.telling_coordinates]
        distance = np.linalg.norm(away)
        left |= bool(distance > 3 * STEP)
        if (
            left
            and distance < 0.75 * STEP
            and (secant * tangent)[chains.telling_coordinates].sum() > 0
        ):
            end = End.CLOSED
            break
    return Walk(np.array(positions), np.array(tangents), (end,))


def _follow_both_ways(chains: Chains, tangent: Array) -> Walk:
    """The motion from the reference on, and where it does not come back, the other way too."""
    walk = follow_motion(chains, tangent)
    return walk if walk.whole else _join_walks(follow_motion(chains, -tangent), walk)


def _join_walks(back: Walk, forth: Walk) -> Walk:
    """One walk of two from the reference in opposite directions."""
    return Walk(
        np.vstack([back.positions[:0:-1], forth.positions]),
        np.vstack([back.tangents[:0:-1], forth.tangents]),
        back.ends + forth.ends,
    )


def close_across(chains: Chains, q: Array, tangent: Array) -> Array:
    """The position of least squares in the plane through ``q`` across ``tangent``.

    By Gauss and Newton's steps, as gaps are small.
    """
    return _close_all_across(chains, q[None], tangent[None])[0]


def _close_all_across(chains: Chains, q: Array, tangents: Array) -> Array:
    """The same for several positions, shape (k, n), each with its own direction."""
    across = np.array([chains.across(tangent) for tangent in tangents])

    def linearise_gaps(x: Array, which: Array) -> tuple[Array, Array]:
        along = across[which]
        there = q[which] + (along @ x[:, :, None])[:, :, 0]
        gaps, rows = zip(*map(chains.linearised, there), strict=True)
        return np.array(gaps), np.array(rows) @ along

    stop = Stop(arrived=ROUNDING, longest=np.inf)
    start = np.zeros((len(q), across.shape[2]))
    ends = find_zeros(linearise_gaps, start, MOST_STEPS, count_above(ARRIVED), stop)
    return q + (across @ ends.x[:, :, None])[:, :, 0]


@dataclass(frozen=True)
class _Mobile:
    """Chains that close at several positions, and how they move.

    Attributes:
        chains: with changed axes.
        moves: whether they close all along a whole motion.
        left_open: their largest gap over the motion.
        beside: the positions of the given chains next to it; those that were fitted where it does
            not move.
    """

    chains: Chains
    moves: bool
    left_open: tuple[float, float]
    beside: Walk


def _find_mobile(chains: Chains, walk: Walk, tangent: Array, widest: float) -> _Mobile | None:
    """The least change with which chains move, or else close at the positions of a walk.

    A walk may have gone astray where motions nearly meet, so that first only what lies before is
    fitted.
    """
    found: list[_Mobile] = []
    straight = walk.to_bends
    for guess in [straight, walk] if len(straight.positions) < len(walk.positions) else [walk]:
        found += _fit_repeatedly(chains, walk, guess, tangent, widest)
        moving = [each for each in found if each.moves]
        if moving:
            return min(moving, key=lambda each: max(chains.change_to(each.chains)))
    return found[-1] if found else None


def _fit_repeatedly(
    chains: Chains, walk: Walk, guess: Walk, tangent: Array, widest: float
) -> list[_Mobile]:
    """Fits at positions of a guess, then of the motions that were found, each if it is a fit."""
    found: list[_Mobile] = []
    beside = walk
    for _ in range(FITS):
        fitted = _fit(chains, guess, widest)
        if fitted is None:
            break
        closed = _follow_both_ways(fitted, tangent)
        left_open = fitted.widest_gap(closed)
        moves = closed.whole and max(left_open) <= ROUNDING
        if moves:
            # Beside a linkage that moves, its motion is the better guide.
            guess = beside = closed.close_on(chains)
        found.append(_Mobile(fitted, moves, left_open, beside))
        if not moves:
            break
    return found


def _fit(chains: Chains, walk: Walk, widest: float) -> Chains | None:
    """The least change of places and axes with which the loops close at a few positions.

    First both closing and not changing are least squares, then what is left of the gaps is closed
    by Gauss and Newton's steps, each followed by one to the least change, which is why they are not
    those of `nag.numerics.double_newton`. None if that leaves gaps, or there are not as many
    positions with gaps of at most ``widest``.
    """
    from scipy.linalg import svd
    from scipy.optimize import least_squares

    limit_scipy()

    others = [i for i, q in enumerate(walk.positions) if q.any() and max(chains.gap(q)) <= widest]
    if len(others) < FITTED:
        return None
    chosen = np.array(others)[np.linspace(0, len(others) - 1, FITTED).round().astype(int)]
    positions = walk.positions[chosen]
    across = np.array([chains.across(t) for t in walk.tangents[chosen]])
    n, m = len(chains.screws), 3 * len(chains.changes)
    own = across.shape[-1]

    def parts(x: Array) -> tuple[Array, Array]:
        z = x[m:].reshape(FITTED, own)
        return x[:m], positions + np.einsum("kij,kj->ki", across, z)

    def opening(x: Array) -> Array:
        change, q = parts(x)
        return chains.closing(q, *chains.changed_lines(change)).ravel()

    def derivative(x: Array) -> Array:
        change, q = parts(x)
        axis, point = chains.changed_lines(change + 1j * COMPLEX_STEP * np.eye(m))
        by_change = chains.closing(q, axis[:, None], point[:, None]).imag / COMPLEX_STEP
        steps = q[:, None] + 1j * COMPLEX_STEP * np.eye(n)
        by_joints = chains.closing(steps, *chains.changed_lines(change)).imag / COMPLEX_STEP
        rows = by_change.shape[-1]
        found = np.zeros((FITTED, rows, m + FITTED * own))
        found[:, :, :m] = np.moveaxis(by_change, 0, -1)
        for k in range(FITTED):
            at = m + k * own
            found[k, :, at : at + own] = by_joints[k].T @ across[k]
        return found.reshape(FITTED * rows, -1)

    unchanged = np.eye(m, m + FITTED * own)
    x = np.zeros(m + FITTED * own)
    for weight in WEIGHTS:
        x = least_squares(
            lambda x, w=weight: np.concatenate([w * opening(x), x[:m]]),
            x,
            lambda x, w=weight: np.vstack([w * derivative(x), unchanged]),
            ftol=ROUNDED,
            xtol=ROUNDED,
            gtol=ROUNDED,
            max_nfev=MOST_EVALUATIONS,
        ).x
    for step in range(MOST_CLOSING):
        left = opening(x)
        # Where conditions that all but depend on each other bend, a few steps do not close it.
        if step >= FEWEST_CLOSING and np.abs(left).max() < ROUNDING:
            break
        # The faster way, by division, fails at times where many values vanish.
        u, s, v = svd(derivative(x), lapack_driver="gesvd")
        rank = int((s > SMALL * s[0]).sum())
        x = x - v[:rank].T @ ((u[:, :rank].T @ left) / s[:rank])
        # Of all that closes it as well, to first order, the least change.
        free = v[rank:].T
        x = x - free @ np.linalg.lstsq(free[:m], x[:m], rcond=SMALL)[0]
    closed = np.abs(opening(x)).max() < ROUNDING
    return chains.with_change(x[:m]) if closed else None


def _hold_near_freedoms(chains: Chains, tolerance: float) -> tuple[Chains, Array]:
    """The chains with all near freedoms held but one, and the direction in which that moves.

    Where motions nearly meet there are more directions than freedoms, but not a few steps away.
    """
    values, directions = chains.singular()
    count = _near_freedoms(values, tolerance)
    held, tangent = _hold_but_one(chains, directions[-count:])
    if count > 1:
        away = close_across(held, AWAY * STEP * tangent, tangent)
        there = _near_freedoms(chains.singular(away)[0], tolerance)
        if there < count:
            held, tangent = _hold_but_one(chains, directions[-there:])
    return held, tangent


def _near_freedoms(values: Array, tolerance: float) -> int:
    """With how many freedoms loops move to first order but for rounding, one at least.

    As many singular values are far smaller than the next, and below the tolerance.
    """
    own = np.maximum(values, ROUNDING)
    parting = np.where(own[1:] < tolerance, own[:-1] / own[1:], 0)
    return len(values) - 1 - int(np.argmax(parting)) if parting.any() else 1


def _hold_but_one(chains: Chains, directions: Array) -> tuple[Chains, Array]:
    """The chains with so many screws held that of several directions one is left, and that one.

    Those that move most are held, as others determine them the worst, slides first, so that what is
    left turns if it can.

    Args:
        directions: orthonormal, shape (k, n).
    """
    held = list(chains.held)
    while len(directions) > 1:
        held.append(_most_moved(np.linalg.norm(directions, axis=0), ~chains.turning))
        column = directions[:, held[-1]]
        directions = np.linalg.svd(column[None])[2][1:] @ directions
    return replace(chains, held=tuple(held)), directions[0]


def _hold_idle(chains: Chains, idle: Mapping[tuple[str, ...], int]) -> Chains:
    """The chains with what moves by itself held.

    The axes of a joint about a point may be any: one is the line about which the part turns, next
    to the part, so that the others lead it in every direction. Furthest from the part is the one
    about which it begins to swing, as two axes fall in line where it comes to lie along that.
    """
    names = {name for bodies in idle for name in bodies}
    _, rows = chains.singular()
    count = sum(idle.values())
    directions, held, axis = rows[-count:], list(chains.held), chains.axis.copy()
    motion = rows[-count - 1] if count < len(rows) else np.zeros(len(chains.screws))
    joints = np.array([s.joint for s in chains.screws])
    while len(directions):
        screw = _most_moved(np.linalg.norm(directions, axis=0), chains.turning)
        joint = chains.joints[joints[screw]]
        own = np.flatnonzero(joints == joints[screw])
        if joint.of_type.turns_about_point and not set(own) & set(held):
            turned = _axes_of(directions[:, own], motion[own])
            turned = turned if joint.bodies[0] in names else turned[::-1]
            directions = directions.copy()
            axis[own], directions[:, own] = turned @ axis[own], directions[:, own] @ turned.T
            screw = own[0] if joint.bodies[0] in names else own[-1]
        held.append(int(screw))
        directions = np.linalg.svd(directions[:, screw][None])[2][1:] @ directions
    aside = [k for k, joint in enumerate(joints) if set(chains.joints[joint].bodies) & names]
    return replace(chains, axis=axis, held=tuple(held), aside=tuple(aside))


def _axes_of(idle: Array, motion: Array) -> Array:
    """Orthonormal axes: of the idle turn, then across it, and last that of a motion across it.

    Args:
        idle: turns about three orthonormal axes, shape (k, 3), the largest of which counts.
        motion: such a turn.
    """
    own = np.linalg.svd(idle)[2][0]
    swing = motion - (motion @ own) * own
    if np.linalg.norm(swing) <= SMALL:
        swing = np.linalg.svd(own[None])[2][1]
    swing = swing / np.linalg.norm(swing)
    return np.array([own, np.cross(swing, own), swing])


def _most_moved(amounts: Array, preferred: Array) -> int:
    """The coordinate that moves most to first order.

    Args:
        amounts: of each, not negative.
        preferred: which are looked at first, unless they hardly move.
    """
    own = np.where(preferred, amounts, 0)
    if own.max() <= WIDEST_GAP * amounts.max():
        own = amounts
    # Of equal ones the first, however they are rounded.
    return int(np.flatnonzero(own >= 0.999 * own.max())[0])


def _linkage_of(chains: Chains, loop: Loop, change: float) -> LoopLinkage:
    """What a loop is, exactly and up to a change."""
    names = tuple(j.name for j in loop.joints)
    if not all(j.of_type.turns_only for j in loop.joints):
        return LoopLinkage(names, None, None)
    places = {chains.joints[s.joint].name: i for i, s in enumerate(chains.screws)}
    own = [places[name] for name in names]
    axis, point = chains.axis[own], chains.point[own]
    linkage = known_linkage(axis, point)
    next_to = known_linkage(axis, point, max(ON, MEANT * change))
    return LoopLinkage(names, linkage, None if next_to == linkage else next_to)
