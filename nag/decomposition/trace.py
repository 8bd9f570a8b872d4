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

from nag.algebra.polynomial import ROUND_NUMBERS, Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.zero_sums import smallest_zero_sums
from nag.numerics.doubles import CLEAR
from nag.tracking.run import Run, Stream
from nag.witness.change_of_coordinates import carry_component, coordinates_of
from nag.witness.component_equations import component_fibres
from nag.witness.exact_points import FEWEST, ExactPoints, exact_points, join_points
from nag.witness.fibres import Fibre, join_fibres, move
from nag.witness.points import Points
from nag.witness.slices import pad_rows, unit_complex
from nag.witness.witness import Decomposition, PathCounts, WitnessSet

# Decides, measured: Digits to which a trace must be linear beside the points' motion: such as were
# had 9 more, others 15 less.
EVIDENCE = 18
# Digits more than those in which points are seen to bend, to see whether others do.
BEYOND = 4
# Points get twice the digits so often, from those of double-double on.
DIGITS = (FEWEST, 60, 120, 240)
# Estimated errors of sums may be too small by this factor.
ERRORS = 4
# Size of the random integers that coordinates are combined with.
WEIGHTS = 1_000


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
        weights: random integers that combine real and imaginary parts of coordinates.
    """

    shift: complex
    gamma: complex
    evidence: int
    ends: Mapping[int, Fibre]
    known: Mapping[int, Differences]
    exact: Mapping[int, ExactPoints]
    weights: np.ndarray

    @classmethod
    def of(cls, points: Points, evidence: int, rng: np.random.Generator) -> Trace:
        """A motion as far as the points are large."""
        sizes = np.sort(np.linalg.norm(points.x, axis=1))
        k = len(sizes) // 2
        median = float(sizes[k] + sizes[~k]) / 2 if len(sizes) else 0.0
        shift = complex(unit_complex(rng)) * median if len(sizes) else 1.0
        gamma = complex(unit_complex(rng))
        weights = rng.integers(-WEIGHTS, WEIGHTS + 1, (2 * points.n, 2 * points.n))
        return cls(shift or 1.0, gamma, evidence, {}, {}, {}, weights)

    def carry(
        self, points: Points, indices: Iterable[int], run: Run
    ) -> tuple[Trace | None, PathCounts]:
        """The trace of these points as well; None if a path failed."""
        new = sorted(set(map(int, indices)) - set(self.ends))
        counts, ends = PathCounts(), dict(self.ends)
        if not new:
            return self, counts
        for fibre, own in points.fibres(new):
            target = self._slices(fibre)
            starts = _number_points(fibre, (1.0, -1.0), pad_rows(points.rows, target.shape[1]))
            (there,) = move([starts], target, self.gamma, run, sizes=points.sizes)
            counts += there.counts.judged_elsewhere
            if not there.regular.all():
                return None, counts
            middle = _number_points(fibre, (0.0,), target)
            for k, i in enumerate(own.tolist()):
                sides = there.fibre([2 * k, 2 * k + 1])
                ends[i] = join_fibres([middle.only([k]), sides])
        return replace(self, ends=ends)._found(points, new, DIGITS[0]), counts

    def _slices(self, fibre: Fibre) -> np.ndarray:
        """The slices of a fibre as one, with the further unknown."""
        target = pad_rows(fibre.rows, 2 + fibre.cut.n + fibre.cut.aux)
        target[-1, -1] = self.shift
        return target

    def _found(self, points: Points, indices: Sequence[int], digits: int) -> Trace:
        """Second differences of some points, found in so many digits."""
        known, exact = dict(self.known), dict(self.exact)
        for _, own in points.fibres(indices):
            ends = join_fibres([self.ends[i] for i in own.tolist()])
            found = exact_points(ends, digits)
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
        return replace(points, known=join_points([self.exact[i] for i in range(len(points))]))

    def linear(self, points: Points, indices: Sequence[int]) -> tuple[bool | None, Trace]:
        """Whether the trace of points that were carried is linear; None if digits do not say.

        Also returns the trace with what more is known of the points.
        """
        trace = self
        for digits in DIGITS:
            poor = trace._least_known(indices, digits)
            if poor:
                trace = trace._found(points, poor, digits)
            answer = trace._decide_in_digits(indices)
            if answer is not None:
                return answer, trace
        return None, trace

    def count_unclear(self, indices: Sequence[int]) -> int:
        """How many zeros have to be found in more digits than those of double-double."""
        return 3 * len(self._least_known(indices, DIGITS[1]))

    def _least_known(self, indices: Sequence[int], digits: int) -> list[int]:
        """Points of fewer digits whose errors keep a sum from being seen to be linear.

        The errors of the others add up to half of what they may be.
        """
        known = [(self.known[i].radius, i) for i in indices]
        most = 0.5 * 10.0**-self.evidence * max(self.known[i].motion for i in indices)
        total, poor = 0.0, []
        for radius, i in sorted(known):
            total += radius
            if not total <= most and self.known[i].digits < digits:
                poor.append(i)
        return poor

    def finer(self, indices: Sequence[int]) -> Trace:
        """The trace with evidence by which points are not linear that bend no less than these.

        Args:
            indices: points whose trace is not linear.
        """
        size, motion = self._bend(indices), max(self.known[i].motion for i in indices)
        digits = int(np.ceil(np.log10(motion / size))) + BEYOND
        return replace(self, evidence=max(self.evidence, digits))

    def is_surely_bent(self, indices: Sequence[int]) -> bool:
        """Whether doubles show that the trace of points is not linear."""
        return self._bend(indices) > CLEAR * max(self.known[i].motion for i in indices)

    def _bend(self, indices: Sequence[int]) -> float:
        """The largest second difference of the sum of points."""
        known = [self.known[i] for i in indices]
        bits = max(d.bits for d in known)
        total = sum(d.total << (bits - d.bits) for d in known)
        return _float(max(map(abs, total), default=0), bits)

    def _decide_in_digits(self, indices: Sequence[int]) -> bool | None:
        known, size = [self.known[i] for i in indices], self._bend(indices)
        bits = max(d.bits for d in known)
        error = sum(d.radius for d in known) + 2.0**-bits * len(known)
        if size > ERRORS * error:
            return False
        motion = max(d.motion for d in known)
        return True if error <= 10.0**-self.evidence * motion else None

    def smallest_unions(
        self, points: Points, classes: Sequence[np.ndarray]
    ) -> tuple[list[list[int]] | None, Trace]:
        """Unions of classes whose trace is linear and that contain no smaller such union.

        Args:
            classes: disjoint arrays of indices of points that were carried; of more than some 40
                it takes long.

        Returns:
            Lists of positions in ``classes``, disjoint, those of the first class first; classes in
            none of them are left out. None if digits do not tell. And the trace with what more is
            known of the points.
        """
        trace, everything = self, np.concatenate(classes).tolist()
        for digits in DIGITS:
            poor = [i for i in everything if trace.known[i].digits < digits]
            if poor:
                trace = trace._found(points, poor, digits)
            unions = trace._unions_within_errors(classes)
            if unions is None:
                continue
            answers = []
            for members in unions:
                chosen = np.concatenate([classes[c] for c in members]).tolist()
                answer, trace = trace.linear(points, chosen)
                answers.append(answer)
            if all(answers):
                return unions, trace
        return None, trace

    def _unions_within_errors(self, classes: Sequence[np.ndarray]) -> list[list[int]] | None:
        """Smallest unions whose second differences sum to zero, up to the errors of all points."""
        own = [[self.known[int(i)] for i in each] for each in classes]
        bits = max(d.bits for each in own for d in each)
        totals = np.array([sum(d.total << (bits - d.bits) for d in each) for each in own])
        error = ERRORS * sum(d.radius + 2.0**-d.bits for each in own for d in each)
        if not np.isfinite(error):
            return None
        return smallest_zero_sums(totals, _integer(error, bits), self.weights)


@np.errstate(over="ignore", invalid="ignore")
def has_linear_trace(
    system: PolynomialSystem, component: WitnessSet, rng: np.random.Generator, run: Run
) -> bool | None:
    """Whether the trace of a component's points is linear, as it is of all its points on a slice.

    The points are cut by equations found anew from the system.

    Returns:
        None where a path fails, or digits do not say.

    Raises:
        ValueError: if the points are not regular zeros of the system or of a deflation of it.
    """
    natural = coordinates_of(system)
    there = carry_component(component, natural, natural.system(system))
    bare = replace(there, fibres=())
    fibres = component_fibres(bare.system, bare)
    points = Points.of(fibres)
    trace = Trace.of(points, digits_of_evidence(system.polynomials), rng)
    carried, _ = trace.carry(points, range(len(points)), run)
    return None if carried is None else carried.linear(points, range(len(points)))[0]


def linear_traces(decomposition: Decomposition, seed: int = 0) -> list[bool | None]:
    """Whether the traces of all components are linear, as `linear_trace` says."""
    system = decomposition.system
    return [linear_trace(system, c, k, seed) for k, c in enumerate(decomposition.components)]


def linear_trace(
    system: PolynomialSystem, component: WitnessSet, index: int, seed: int = 0
) -> bool | None:
    """Whether the trace of a system's component of some index is linear.

    None also where no equations cut it. Points have no traces: nothing is said of them either.
    """
    if not component.dimension or not component.degree:
        return None
    rng = np.random.default_rng([seed, Stream.TRACE, index])
    try:
        return has_linear_trace(system, component, rng, Run())
    except (ValueError, OverflowError):
        return None


def _number_points(fibre: Fibre, numbers: Sequence[float], rows: np.ndarray) -> Fibre:
    """Each point of a fibre once for each number, with that as a further unknown of ``rows``."""
    several, m = np.repeat(fibre.points, len(numbers), axis=0), len(numbers)
    points = np.column_stack([several, np.tile(numbers, len(fibre))])
    fine = {m * i + j: z.with_last(u) for i, z in fibre.fine.items() for j, u in enumerate(numbers)}
    return Fibre(fibre.cut.numbered, rows, points, fine)


def _float(value: int, bits: int) -> float:
    """``value / 2 ** bits``, however long the integer is."""
    shift = max(value.bit_length() - 60, 0)
    return float(np.ldexp(float(value >> shift), shift - bits))


def _integer(value: float, bits: int) -> int:
    """``value * 2 ** bits``, rounded up."""
    mantissa, exponent = np.frexp(value)
    digits, shift = int(np.ldexp(mantissa, 53)), int(exponent) - 53 + bits
    return digits << shift if shift >= 0 else -(-digits >> -shift)
