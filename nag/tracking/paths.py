"""What becomes of paths."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from enum import IntEnum

import numpy as np


class PathStatus(IntEnum):
    """How a path ended."""

    REGULAR = 0
    SINGULAR = 1
    AT_INFINITY = 2
    FAILED = 3


class Reason(IntEnum):
    """Why a path failed."""

    NONE = 0
    STEP_SIZE = 1
    STEPS = 2
    START = 3
    ENDGAME = 4
    NOT_FINITE = 5

    @property
    def text(self) -> str:
        return (
            "",
            "the step size became too small",
            "too many steps",
            "Newton's method does not converge at the start point",
            "the endgame does not converge",
            "the numbers left the range of double precision",
        )[self]


@dataclass(frozen=True, eq=False)
class Paths:
    """Ends of ``P`` paths.

    Attributes:
        points: end points, unit norm in each group of coordinates, shape ``(P, N)``.
        status: `PathStatus`, int8.
        winding: winding number of the endgame (1 for regular ends, 0 for failed paths).
        accuracy: estimated relative error of the point; inf for failed paths.
        smallest: smallest singular value of the Jacobian at the point, patches included;
            polynomial rows are scaled by their largest coefficient, linear rows to unit norm.
        condition: Frobenius norm of the Jacobian over ``smallest``.
        steps: predictor steps, rejected ones included, of all attempts.
        precision: decimal digits of the arithmetic used: 16, 32 (residuals in double-double) or
            more (mpmath).
        reason: `Reason` of a failure, 0 otherwise.
    """

    points: np.ndarray
    status: np.ndarray
    winding: np.ndarray
    accuracy: np.ndarray
    smallest: np.ndarray
    condition: np.ndarray
    steps: np.ndarray
    precision: np.ndarray
    reason: np.ndarray

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        counts = Counter(self.status.tolist())
        text = ", ".join(f"{counts[s]} {s.name.lower()}" for s in PathStatus if counts[s])
        return f"Paths({len(self)}: {text})"

    def where(self, *status: PathStatus) -> np.ndarray:
        """Indices of the paths with one of these statuses."""
        return np.flatnonzero(np.isin(self.status, status))

    @property
    def failures(self) -> dict[str, int]:
        """Number of failed paths for each reason."""
        failed = self.reason[self.status == PathStatus.FAILED]
        return {Reason(r).text: int(k) for r, k in sorted(Counter(failed.tolist()).items())}
