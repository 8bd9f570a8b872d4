"""The linear trace test: the points of a union of components, and of nothing less, have a trace
that is linear in a parallel motion of the slice (Sommese, Verschelde & Wampler 2002).

In doubles, the two branches of a hyperbola that is near to two lines have linear traces each, and
so have those of a circle far away. So all points are found in as many digits as are needed to see
it: more where the system's coefficients have more.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.witness.cutting import Cut
from nag.witness.exact_points import FEWEST, ExactPoints, exact_points, together
from nag.witness.fibres import Fibre, Tracker, move
from nag.witness.points import Points
from nag.witness.slices import padded, unit_complex
from nag.witness.witness import PathCounts

# Digits to which a trace must be linear, beside the points' motion: so many, and one more for each
# digit of the system's coefficients beyond those of round numbers.
EVIDENCE, ROUND_NUMBERS = 18, 6
# Digits more than those in which points are seen to bend, to see whether others do.
BEYOND = 4
# Points get twice the digits so often, from those of double-double on.
DIGITS = (FEWEST, 60, 120, 240)
# Subsets of more classes than this are not searched; those are looked at more closely whose sums
# are so small beside their terms in doubles.
MOST_CLASSES, SMALL = 12, 1e-9


def digits_of_evidence(polynomials: Iterable[Polynomial]) -> int:
    """Digits to which a trace must be linear, for components of the zero set of ``polynomials``."""
    most = max((f.digits for f in polynomials), default=0)
    return EVIDENCE + max(0, most - ROUND_NUMBERS)


@dataclass(frozen=True, eq=False)
class Differences:
    """Second differences of one point's coordinates along the motion.

    Attributes:
        total: integers of the unit ``2 ** -bits``, real and then imaginary parts, shape ``(2 n,)``.
        radius: error of the coordinates.
        motion: how far the point moved.
        digits: with which the points were found.
    """

    total: np.ndarray
    bits: int
    radius: float
    motion: float
    digits: int


@dataclass(frozen=True, eq=False)
class Trace:
    """A parallel motion of a slice, one step to each side, and how points follow it.

    All are one slice with a further unknown u, which is 0, 1 or -1: ``L(x) + shift u = 0``.

    Attributes:
        shift: the step.
        gamma: random constant of the homotopy.
        evidence: digits to which sums must vanish to be linear.
        ends: for each point that was tracked, by index, itself and its two ends.
        known: second differences of points, by index.
        exact: the points in the fewest digits that are of use, by index.
    """

    shift: complex
    gamma: complex
    evidence: int
    ends: Mapping[int, Fibre]
    known: Mapping[int, Differences]
    exact: Mapping[int, ExactPoints]

    @classmethod
    def of(cls, points: Points, evidence: int, rng: np.random.Generator) -> Trace:
        """A motion as far as the points are large."""
        sizes = np.sort(np.linalg.norm(points.x, axis=1))
        k = len(sizes) // 2
        median = float(sizes[k] + sizes[~k]) / 2 if len(sizes) else 0.0
        shift = complex(unit_complex(rng)) * median if len(sizes) else 1.0
        return cls(shift or 1.0, complex(unit_complex(rng)), evidence, {}, {}, {})

    def carried(
        self, points: Points, indices: Iterable[int], tracker: Tracker
    ) -> tuple[Trace | None, PathCounts]:
        """The trace of these points as well; None if a path failed."""
        new = sorted(set(map(int, indices)) - set(self.ends))
        counts, ends = PathCounts(), dict(self.ends)
        if not new:
            return self, counts
        for fibre, own in points.fibres(new):
            starts = _numbered(fibre, (1.0, -1.0))
            target = self._slices(points.rows, starts.cut)
            source = padded(points.rows, target.shape[1])
            there = move(starts, source, target, self.gamma, tracker)
            counts += there.counts.judged_elsewhere
            if not there.regular.all():
                return None, counts
            middle = _numbered(fibre, (0.0,))
            for k, i in enumerate(own.tolist()):
                sides = there.fibre(starts.cut, fibre.dimension, [2 * k, 2 * k + 1])
                ends[i] = _joined([middle.only(np.arange(len(own)) == k), sides])
        return replace(self, ends=ends)._found(points, new, DIGITS[0]), counts

    def _slices(self, rows: np.ndarray, cut: Cut) -> np.ndarray:
        """All slices as one, for a cut with the further unknown."""
        target = padded(rows, 1 + cut.n + cut.aux)
        target[-1, -1] = self.shift
        return target

    def _found(self, points: Points, indices: Sequence[int], digits: int) -> Trace:
        """Second differences of some points, found in so many digits."""
        known, exact = dict(self.known), dict(self.exact)
        for _, own in points.fibres(indices):
            ends = _joined([self.ends[i] for i in own.tolist()])
            found = exact_points(ends, self._slices(points.rows, ends.cut), digits)
            x, sides = found.values[::3], (found.values[1::3], found.values[2::3])
            total = sides[0] + sides[1] - 2 * x
            radii = 2 * found.radii[::3] + found.radii[1::3] + found.radii[2::3]
            motions = [np.abs(ends.x[k::3] - ends.x[::3]).max(axis=1, initial=0.0) for k in (1, 2)]
            motion = np.maximum(*motions)
            for k, i in enumerate(own.tolist()):
                known[i] = Differences(
                    total[k], found.bits, float(radii[k]), float(motion[k]), digits
                )
                if digits == FEWEST:
                    exact[i] = found.only([3 * k])
        return replace(self, known=known, exact=exact)

    def sharper(self, points: Points) -> Points:
        """The points with the digits that were found, if all of them were carried."""
        if not len(points) or set(self.exact) != set(range(len(points))):
            return points
        return replace(points, known=together([self.exact[i] for i in range(len(points))]))

    def linear(self, points: Points, indices: Sequence[int]) -> tuple[bool | None, Trace]:
        """Whether the trace of points that were carried is linear; None if digits do not say.

        Also returns the trace with what more is known of the points.
        """
        trace = self
        for digits in DIGITS:
            poor = [i for i in indices if trace.known[i].digits < digits]
            if poor:
                trace = trace._found(points, poor, digits)
            answer = trace._decided(indices)
            if answer is not None:
                return answer, trace
        return None, trace

    def finer(self, indices: Sequence[int]) -> Trace:
        """The trace with evidence by which points are not linear that bend no less than these.

        Args:
            indices: points whose trace is not linear.
        """
        size, motion = self._bend(indices), max(self.known[i].motion for i in indices)
        digits = int(np.ceil(np.log10(motion / size))) + BEYOND
        return replace(self, evidence=max(self.evidence, digits))

    def _bend(self, indices: Sequence[int]) -> float:
        """The largest second difference of the sum of points."""
        known = [self.known[i] for i in indices]
        bits = max(d.bits for d in known)
        total = sum(d.total << (bits - d.bits) for d in known)
        return _float(max(map(abs, total), default=0), bits)

    def _decided(self, indices: Sequence[int]) -> bool | None:
        known, size = [self.known[i] for i in indices], self._bend(indices)
        bits = max(d.bits for d in known)
        error = sum(d.radius for d in known) + 2.0**-bits * len(known)
        if size > 4 * error:
            return False
        motion = max(d.motion for d in known)
        return True if error <= 10.0**-self.evidence * motion else None

    def smallest_unions(
        self, points: Points, classes: Sequence[np.ndarray]
    ) -> tuple[list[list[int]], Trace]:
        """Unions of classes whose trace is linear and that contain no smaller such union.

        ``classes`` are arrays of point indices, at most `MOST_CLASSES`. Returns lists of positions
        in ``classes``, disjoint, smallest first; classes in none of them are left out.
        """
        taken, found, trace = 0, [], self
        for chosen in self._nearly_linear(classes):
            members = [c for c in range(len(classes)) if chosen >> c & 1]
            if chosen & taken:
                continue
            union = np.concatenate([classes[c] for c in members])
            answer, trace = trace.linear(points, union)
            if answer:
                found.append(members)
                taken |= chosen
        return found, trace

    def _nearly_linear(self, classes: Sequence[np.ndarray]) -> list[int]:
        """Unions, as bits, whose trace is linear as far as doubles show, the smallest first."""
        totals = []
        for own in classes:
            bits = max(self.known[i].bits for i in own)
            total = sum(self.known[i].total << (bits - self.known[i].bits) for i in own)
            totals.append([_float(value, bits) for value in total])
        size = np.array(totals)
        chosen = np.arange(1, 2 ** len(classes))
        among = (chosen[:, None] >> np.arange(len(classes)) & 1).astype(float)
        error = sum(self.known[i].radius for own in classes for i in own)
        bound = SMALL * (among @ np.abs(size).max(axis=1)) + 4 * error
        small = chosen[np.abs(among @ size).max(axis=1) <= bound]
        return sorted(small.tolist(), key=lambda bits: (bits.bit_count(), bits))


def _numbered(fibre: Fibre, numbers: Sequence[float]) -> Fibre:
    """Each point of a fibre once for each number, with that as a further unknown."""
    several, m = np.repeat(fibre.points, len(numbers), axis=0), len(numbers)
    points = np.column_stack([several, np.tile(numbers, len(fibre))])
    fine = {m * i + j: z.with_last(u) for i, z in fibre.fine.items() for j, u in enumerate(numbers)}
    return Fibre(fibre.cut.numbered, fibre.dimension, points, fine)


def _joined(parts: Sequence[Fibre]) -> Fibre:
    """Points of several fibres of one cut in one."""
    fine, first = {}, 0
    for part in parts:
        fine |= {first + i: each for i, each in part.fine.items()}
        first += len(part)
    points = np.vstack([part.points for part in parts])
    return Fibre(parts[0].cut, parts[0].dimension, points, fine)


def _float(value: int, bits: int) -> float:
    """``value / 2 ** bits``, however long the integer is."""
    shift = max(value.bit_length() - 60, 0)
    return float(np.ldexp(float(value >> shift), shift - bits))
