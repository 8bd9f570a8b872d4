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
from nag.witness.close_points import Fine
from nag.witness.exact_points import FEWEST, ExactPoints, exact_points, fixed
from nag.witness.fibres import Fibre, Tracker
from nag.witness.points import Points, moved_points
from nag.witness.slices import unit_complex
from nag.witness.witness import PathCounts

# Digits to which a trace must be linear, beside the points' motion: so many, and one more for each
# digit of the system's coefficients beyond those of round numbers.
EVIDENCE, ROUND_NUMBERS = 18, 6
# Points get twice the digits so often, from those of double-double on.
DIGITS = (FEWEST, 60, 120, 240)
# Bits behind the point of an offset of a slice, beyond those of the points.
SMALLEST = 60
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
class End:
    """Where a point came to: with added unknowns, and in more digits where others are close."""

    z: np.ndarray
    fine: Fine | None


@dataclass(frozen=True, eq=False)
class Trace:
    """A parallel motion of a slice, one step to each side, and how points follow it.

    Attributes:
        sides: the two slices.
        gammas: random constants of the homotopies to them.
        evidence: digits to which sums must vanish to be linear.
        ends: for each point that was tracked, by index, its two ends.
        known: second differences of points, by index.
    """

    sides: tuple[np.ndarray, np.ndarray]
    gammas: tuple[complex, complex]
    evidence: int
    ends: Mapping[int, tuple[End, End]]
    known: Mapping[int, Differences]

    @classmethod
    def of(cls, points: Points, evidence: int, rng: np.random.Generator) -> Trace:
        """A motion as far as the points are large."""
        sizes = np.linalg.norm(points.x, axis=1)
        shift = complex(unit_complex(rng)) * float(np.median(sizes)) if len(sizes) else 1.0
        sides = []
        for sign in (1, -1):
            target = points.rows.copy()
            target[-1, 0] += sign * (shift or 1.0)
            sides.append(target)
        gammas = complex(unit_complex(rng)), complex(unit_complex(rng))
        return cls((sides[0], sides[1]), gammas, evidence, {}, {})

    def carried(
        self, points: Points, indices: Iterable[int], tracker: Tracker
    ) -> tuple[Trace | None, PathCounts]:
        """The trace of these points as well; None if a path failed."""
        new = sorted(set(map(int, indices)) - set(self.ends))
        counts = PathCounts()
        if not new:
            return self, counts
        both = []
        for target, gamma in zip(self.sides, self.gammas, strict=True):
            there, origins, spent = moved_points(points, new, target, gamma, tracker)
            counts += spent
            if len(origins) < len(new):
                return None, counts
            ends = zip(origins.tolist(), there.z, strict=True)
            both.append({i: End(z, there.fine.get(k)) for k, (i, z) in enumerate(ends)})
        ends = {**self.ends, **{i: (both[0][i], both[1][i]) for i in new}}
        return replace(self, ends=ends)._found(points, new, DIGITS[0]), counts

    def _found(self, points: Points, indices: Sequence[int], digits: int) -> Trace:
        """Second differences of some points, found in so many digits."""
        known = dict(self.known)
        fibres, order = points.fibres(indices)
        first = 0
        for fibre in fibres:
            own, first = order[first : first + len(fibre)], first + len(fibre)
            if digits == FEWEST:
                middle = points.exact.only(own)
            else:
                middle = exact_points(fibre, points.rows, digits)
            sides = [
                exact_points(self._side(fibre, own, k), target, digits)
                for k, target in enumerate(self.sides)
            ]
            total = self._differences(points.rows, middle, sides)
            radii = sides[0].radii + sides[1].radii + 2 * middle.radii
            n = points.n
            for k, i in enumerate(own):
                moved = [
                    np.abs(self.ends[i][j].z[:n] - fibre.x[k]).max(initial=0.0) for j in (0, 1)
                ]
                known[int(i)] = Differences(
                    total[k], middle.bits, float(radii[k]), float(max(moved)), digits
                )
        return replace(self, known=known)

    def _side(self, fibre: Fibre, own: Sequence[int], k: int) -> Fibre:
        """The points of a fibre, of these indices, on one of the two slices."""
        ends = [self.ends[int(i)][k] for i in own]
        fine = {j: end.fine for j, end in enumerate(ends) if end.fine is not None}
        return replace(fibre, points=np.array([end.z for end in ends]), fine=fine)

    def _differences(
        self, rows: np.ndarray, middle: ExactPoints, sides: Sequence[ExactPoints]
    ) -> np.ndarray:
        """``(x1 - x) s2 - (x2 - x) s1`` for the exact steps s of the slices, over their size.

        Rounded offsets of slices are not quite symmetric; a linear trace does not mind.
        """
        n, bits = middle.values.shape[1] // 2, middle.bits
        x = [side.values - middle.values for side in sides]
        offsets = np.array([[rows[-1, 0], *(target[-1, 0] for target in self.sides)]])
        c = fixed(offsets, bits + SMALLEST)[0]
        (a1, a2), (b1, b2) = ([c[k + 1] - c[k], c[k + 2] - c[k]] for k in (0, 3))
        real = x[0][:, :n] * a2 - x[0][:, n:] * b2 - x[1][:, :n] * a1 + x[1][:, n:] * b1
        imag = x[0][:, :n] * b2 + x[0][:, n:] * a2 - x[1][:, :n] * b1 - x[1][:, n:] * a1
        size = max(map(abs, (a1, b1)))
        return np.concatenate([real, imag], axis=1) // size

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

    def _decided(self, indices: Sequence[int]) -> bool | None:
        known = [self.known[i] for i in indices]
        bits = max(d.bits for d in known)
        total = sum(d.total << (bits - d.bits) for d in known)
        size = _float(max(map(abs, total), default=0), bits)
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


def _float(value: int, bits: int) -> float:
    """``value / 2 ** bits``, however long the integer is."""
    shift = max(value.bit_length() - 60, 0)
    return float(np.ldexp(float(value >> shift), shift - bits))
