"""Whether equations vanish along a smooth set of zeros of some of them, seen far from the point.

Beside a zero, what vanishes along a curve to a high order cannot be told from what vanishes on it:
it takes as many digits as the order is high. Far away no power of the distance is small, and
equations that are not zero along the curve are not small there either. So the curve is followed
away from the point, in small steps, and one look at its end decides, whatever the order is.

As far as doubles do, the set is followed in these. Of one round the equations are rows of the
Jacobian. Where the first of two rounds leaves terms of second order, its derivatives are entries of
the Schur complement of the block that it solves for; their derivatives are differences of the
Jacobian along the set where that block's equations vanish.

References:
    Sommese & Wampler, The numerical solution of systems of polynomials, 2005, on membership;
    Hauenstein & Wampler, Isosingular sets and deflation, 2013.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log10

import flint
import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.numerics.descent import Block, Point, Round, descend
from nag.numerics.digits import BITS, DIGITS, doubles, log_norm
from nag.numerics.exact_system import ExactSystem
from nag.numerics.newton import move_point
from nag.numerics.power_series import SeriesRing, Terms, derivatives, exponents_of_degree
from nag.numerics.sharpening import ARRIVED, LARGEST_INVERSE, predict_along, sharpen

# Differences are taken over so much, the scaled variables being of size one.
APART = 2.0**-17


@dataclass(frozen=True, eq=False)
class _Frame:
    """The regular block at a point.

    Attributes:
        step: Newton's, of the block's equations for its variables; shape ``(n,)``.
        tangents: how all variables change with each that the block leaves, shape ``(n, m)``.
        freed: what takes from each equation what the block's equations make of it, shape
            ``(R, R)``.
        slopes: of all equations along the tangents, shape ``(R, m)``.
    """

    step: np.ndarray
    tangents: np.ndarray
    freed: np.ndarray
    slopes: np.ndarray


@dataclass(frozen=True, eq=False)
class RoundsInDoubles:
    """The set of one round, or of two if the first leaves terms of second order.

    Where the first round solves nothing, the second is the first one of polynomials.

    Attributes:
        evaluator: of the equations that occur.
        rows, columns: of the first block.
        free: the variables that it leaves.
        entries: rows and places among the free variables whose slopes vanish, shape ``(2, k)``.
        solved, left: places among the free variables that these determine, and the others.
    """

    evaluator: Evaluator
    rows: np.ndarray
    columns: np.ndarray
    free: np.ndarray
    entries: np.ndarray
    solved: np.ndarray
    left: np.ndarray

    @classmethod
    def of(cls, system: ExactSystem, rounds: Sequence[Round]) -> RoundsInDoubles | None:
        """None where the rounds are of other kinds."""
        rows, (first, *more) = system.at(DIGITS), rounds
        while more and not first.columns:
            # Nothing was solved for: what remains are the equations, their derivatives polynomials.
            ring = SeriesRing(system.n, system.largest_degree)
            series = [{ring.key(e): c for e, c in row} for row in rows]
            rows, (first, *more) = derivatives(series, ring, first.order - 1), more
        if len(more) > 1 or (more and first.order != 2):
            return None
        free = [i for i in range(system.n) if i not in first.columns]
        others = [i for i in range(len(rows)) if i not in first.rows]
        places = [e.index(1) for e in exponents_of_degree(len(free), 1)]
        # The derivatives stand row by row.
        derived = [divmod(i, len(places)) for i in (more[0].rows if more else ())]
        kept = [*first.rows, *dict.fromkeys(others[k] for k, _ in derived)]
        entries = [[kept.index(others[k]) for k, _ in derived], [places[k] for _, k in derived]]
        solved = list(more[0].columns) if more else []
        left = [k for k in range(len(free)) if k not in solved]
        return cls(
            _evaluator([rows[i] for i in kept], system.n),
            np.arange(len(first.rows)),
            *(np.array(a, dtype=np.int64) for a in (first.columns, free, entries, solved, left)),
        )

    def tangent(self, x: np.ndarray, direction: np.ndarray) -> np.ndarray:
        """How all variables change with those that the rounds leave along a direction."""
        if not len(self.solved):
            jacobian = self.evaluator.jacobian(x)
            right = jacobian[:, self.free] @ direction
            return self._place_variables(
                direction, -np.linalg.solve(jacobian[:, self.columns], right)
            )
        frame = self._frame(x)
        along = frame.tangents[:, self.left] @ direction
        bent = np.linalg.solve(self._bending(x, frame), self._second(x, frame, along))
        return along - frame.tangents[:, self.solved] @ bent

    def ahead(self, x: np.ndarray, direction: np.ndarray, h: float) -> np.ndarray:
        """A step along the set by the classical method of Runge and Kutta."""
        a = self.tangent(x, direction)
        b = self.tangent(x + h / 2 * a, direction)
        c = self.tangent(x + h / 2 * b, direction)
        d = self.tangent(x + h * c, direction)
        return x + h / 6 * (a + 2 * b + 2 * c + d)

    def newton(self, x: np.ndarray) -> np.ndarray:
        """What Newton's method takes from a point, in the variables that are not left.

        Of two rounds the second is about derivatives of what the first leaves, block by block.
        """
        if not len(self.solved):
            jacobian, values = self.evaluator.jacobian(x), self.evaluator.values(x[None])[0]
            return self._place_variables(0.0, np.linalg.solve(jacobian[:, self.columns], values))
        frame = self._frame(x)
        here = self._select_entries(frame, frame.slopes) - self._second(x, frame, frame.step)
        return frame.step + frame.tangents[:, self.solved] @ np.linalg.solve(
            self._bending(x, frame), here
        )

    def _place_variables(self, free: np.ndarray | float, columns: np.ndarray) -> np.ndarray:
        """A vector of all variables, from the free ones and those of the first block."""
        result = np.empty(self.evaluator.n, dtype=complex)
        result[self.free], result[self.columns] = free, columns
        return result

    def _frame(self, x: np.ndarray) -> _Frame:
        jacobian = self.evaluator.jacobian(x)
        block = jacobian[np.ix_(self.rows, self.columns)]
        values = self.evaluator.values(x[None])[0]
        right = np.hstack([values[self.rows, None], jacobian[np.ix_(self.rows, self.free)]])
        found = np.linalg.solve(block, right)
        step = np.zeros(len(x), dtype=complex)
        step[self.columns] = found[:, 0]
        tangents = np.zeros((len(x), len(self.free)), dtype=complex)
        tangents[self.free, np.arange(len(self.free))] = 1.0
        tangents[self.columns] = -found[:, 1:]
        freed = np.eye(len(jacobian), dtype=complex)
        freed[:, self.rows] -= np.linalg.solve(block.T, jacobian[:, self.columns].T).T
        return _Frame(step, tangents, freed, jacobian @ tangents)

    def _select_entries(self, frame: _Frame, slopes: np.ndarray) -> np.ndarray:
        """The entries of the equations' slopes that the second round is about."""
        rows, places = self.entries
        return (frame.freed @ slopes)[rows, places]

    def _second(self, x: np.ndarray, frame: _Frame, along: np.ndarray) -> np.ndarray:
        """The derivatives of these entries along a tangent."""
        h = APART / (float(np.abs(along).max()) or 1.0)
        ahead, behind = (self.evaluator.jacobian(x + s * along) for s in (h, -h))
        return self._select_entries(frame, (ahead - behind) / (2 * h) @ frame.tangents)

    def _bending(self, x: np.ndarray, frame: _Frame) -> np.ndarray:
        """The derivatives of these entries by the variables that they determine."""
        return np.stack([self._second(x, frame, frame.tangents[:, k]) for k in self.solved], axis=1)


def _evaluator(rows: Sequence[Terms], n: int) -> Evaluator:
    exponents = list(dict.fromkeys(e for row in rows for e, _ in row)) or [(0,) * n]
    place = {e: i for i, e in enumerate(exponents)}
    coefficients = np.zeros((len(rows), len(exponents)), dtype=complex)
    for line, row in zip(coefficients, rows, strict=True):
        for e, c in row:
            line[place[e]] += complex(c)
    return Evaluator(n, np.array(exponents, dtype=np.int64), coefficients)


# Decides: Scaled distance from a singular point at which it is seen whether equations vanish along
# a set: no power of it is small.
FAR = 5.0
# Decides: The same in variables that the set determines.
AT_MOST = 100.0
# Steps to there, at most.
STEPS, STEPS_IN_DIGITS = 600, 200
# Directions that are tried: some lead into a branch point.
DIRECTIONS = 3
# What Newton's steps may change after a step, as shares of it, so that it leads to no other sheet:
# the first one after steps by a high order and by a low one; the second one beside the first,
# or, where both are rounding, beside the step. Where it is larger, doubles do no longer.
SMALL, SMALL_ROUGHLY, CONTRACTION, ROUNDING = 0.001, 0.05, 0.05, 1e-6
# The first step, and the least one.
FIRST, LEAST = 1e-2, 1e-30
# Inverses (decimal logarithm) up to which doubles do.
GOOD = 10.0


def far_value(
    system: ExactSystem, point: Point, rounds: Sequence[Round], inverse: float, digits: int
) -> float | None:
    """Decimal logarithm of the equations' values far along the smooth set that rounds leave.

    None if the set could not be followed.

    Args:
        inverse: of the blocks that were solved for, decimal logarithm.
        digits: to which their zeros are known.
    """
    left = len(point) - sum(len(r.columns) for r in rounds)
    known = RoundsInDoubles.of(system, rounds) if inverse < GOOD else None
    for attempt in range(DIRECTIONS):
        turn = np.exp(1j * (0.3 + np.arange(left) + 2.0 * attempt))
        start = _Place(list(point), 0.0, FIRST)
        if known is not None:
            start = _in_doubles(known, turn, start)
        end = _in_digits(system, rounds, turn, start)
        if end is None:
            continue
        size = system.largest_degree * max(0.0, log_norm(end))
        more = digits + int(size)
        found = sharpen(system, end, rounds, more)
        if found is not None:
            return system.log_residual(found[0], more)
    return None


@dataclass(frozen=True, eq=False)
class _Place:
    """Where a set has been followed to: how far in the free variables, and the next step."""

    point: Point
    gone: float
    step: float

    @property
    def far(self) -> bool:
        return self.gone >= FAR or log_norm(self.point) >= log10(AT_MOST)


def _in_doubles(known: RoundsInDoubles, direction: np.ndarray, start: _Place) -> _Place:
    """As far along the set as doubles do."""
    x, gone, h = doubles(start.point), start.gone, start.step
    for _ in range(STEPS):
        if gone >= FAR or np.abs(x).max() >= AT_MOST:
            break
        try:
            # Powers of a point that went astray overflow; the step is taken again, shorter.
            with np.errstate(all="ignore"):
                ahead = known.ahead(x, direction, h)
                first = known.newton(ahead)
                second = known.newton(ahead - first)
        except np.linalg.LinAlgError:
            break
        moved, one, two = (float(np.abs(v).max()) for v in (ahead - x, first, second))
        if one <= SMALL * moved and two <= max(CONTRACTION * one, ROUNDING * moved):
            x, gone = ahead - first - second, gone + h
            h *= 2.0 if one < SMALL / 16 * moved else 1.0
        elif two > CONTRACTION * one and one <= SMALL * moved:
            break
        else:
            h /= 2
            if h < LEAST:
                break
    return _Place([flint.acb(complex(c)) for c in x], gone, h)


def _in_digits(
    system: ExactSystem, rounds: Sequence[Round], direction: np.ndarray, start: _Place
) -> Point | None:
    """The point far along the set, in all digits where doubles did not come there."""
    place, turns = start, [flint.acb(complex(c)) for c in direction]
    if start.gone and not start.far:
        known = sharpen(system, start.point, rounds)
        if known is None:
            return None
        place = _Place(known[0], start.gone, start.step)
    for _ in range(STEPS_IN_DIGITS):
        if place.far:
            return place.point
        place = _step(system, rounds, turns, place)
        if place.step < LEAST:
            return None
    return None


def _step(
    system: ExactSystem, rounds: Sequence[Round], turns: Sequence[flint.acb], place: _Place
) -> _Place:
    """A step along the set, or the same place with a smaller step."""
    x, h = place.point, place.step
    one_round = len(rounds) == 1
    along = [c * h for c in turns]
    ahead = (_ahead if one_round else predict_along)(system, x, rounds, along)
    step = None if ahead is None else _newton(system, rounds, ahead)
    if ahead is not None and step is not None:
        moved = log_norm(a - b for a, b in zip(ahead, x, strict=True))
        one, small = log_norm(step), log10(SMALL if one_round else SMALL_ROUGHLY)
        nearer = move_point(ahead, step, BITS)
        second = _newton(system, rounds, nearer) if one < moved + small else None
        # A second step that is not much smaller may belong to another sheet.
        if second is not None and log_norm(second) <= max(one + log10(CONTRACTION), ARRIVED):
            longer = 2.0 if one < moved + small - (1.2 if one_round else 0.6) else 1.0
            return _Place(move_point(nearer, second, BITS), place.gone + h, h * longer)
    # What the last step left of its error must be small beside the next, smaller one.
    left = _newton(system, rounds, x)
    return _Place(x if left is None else move_point(x, left, BITS), place.gone, h / 2)


def _newton(system: ExactSystem, rounds: Sequence[Round], x: Point) -> Point | None:
    """Newton's step in the variables that the rounds determine; None where they are singular."""
    if len(rounds) > 1:
        found = descend(system, DIGITS, x, rounds, 1)
        return found.displacement if found and found.inverse < LARGEST_INVERSE else None
    return Block.of(system, rounds[0], x).newton_change(BITS)


def _ahead(
    system: ExactSystem, x: Point, rounds: Sequence[Round], along: Sequence[flint.acb]
) -> Point | None:
    """A step along the set of one round, like that in doubles."""

    def tangent(change: Point, share: float) -> Point | None:
        there = move_point(x, change, BITS, share)
        return Block.of(system, rounds[0], there).tangent_change(along, BITS)

    a = tangent([flint.acb(0)] * len(x), 0.0)
    b = a and tangent(a, 0.5)
    c = b and tangent(b, 0.5)
    d = c and tangent(c, 1.0)
    if a is None or b is None or c is None or d is None:
        return None
    for change, share in ((a, 1 / 6), (b, 1 / 3), (c, 1 / 3), (d, 1 / 6)):
        x = move_point(x, change, BITS, share)
    return x
