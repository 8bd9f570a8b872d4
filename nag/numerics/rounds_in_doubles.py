"""The smooth set that rounds of deflation leave, in doubles: Newton's step, tangents, steps along.

Of one round these are rows of the Jacobian. Where the first of two rounds leaves terms of second
order, its derivatives are entries of the Schur complement of the block that it solves for; their
derivatives are differences of the Jacobian along the set where that block's equations vanish.

References:
    Hauenstein & Wampler, Isosingular sets and deflation, 2013.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.numerics.descent import Round
from nag.numerics.digits import DIGITS
from nag.numerics.exact_system import ExactSystem
from nag.numerics.power_series import SeriesRing, Terms, derivatives, exponents_of_degree

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
            return self._placed(direction, -np.linalg.solve(jacobian[:, self.columns], right))
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
        """What Newton's method takes from a point, in the variables that are not left."""
        if not len(self.solved):
            jacobian, values = self.evaluator.jacobian(x), self.evaluator.values(x[None])[0]
            return self._placed(0.0, np.linalg.solve(jacobian[:, self.columns], values))
        frame = self._frame(x)
        here = self._chosen(frame, frame.slopes) - self._second(x, frame, frame.step)
        return frame.step + frame.tangents[:, self.solved] @ np.linalg.solve(
            self._bending(x, frame), here
        )

    def _placed(self, free: np.ndarray | float, columns: np.ndarray) -> np.ndarray:
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

    def _chosen(self, frame: _Frame, slopes: np.ndarray) -> np.ndarray:
        """The entries of the equations' slopes that the second round is about."""
        rows, places = self.entries
        return (frame.freed @ slopes)[rows, places]

    def _second(self, x: np.ndarray, frame: _Frame, along: np.ndarray) -> np.ndarray:
        """The derivatives of these entries along a tangent."""
        h = APART / (float(np.abs(along).max()) or 1.0)
        ahead, behind = (self.evaluator.jacobian(x + s * along) for s in (h, -h))
        return self._chosen(frame, (ahead - behind) / (2 * h) @ frame.tangents)

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
