"""What becomes of paths."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from enum import IntEnum
from fractions import Fraction

import numpy as np

from nag.numerics.array_table import ArrayTable
from nag.tracking.homotopy import Homotopy

# Errors of ends in more digits that may be as much larger.
SAFETY = 16
# The order of a coordinate that vanishes all along a branch.
NEVER = 1 << 40


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
            "its end asks for more digits",
            "the numbers left the range of double precision",
        )[self]


@dataclass(frozen=True, eq=False)
class Ball:
    """An end in more digits than doubles have.

    Attributes:
        centre: coordinates, real and imaginary parts as sums of doubles, shape ``(N, 2, words)``.
        radii: errors of the coordinates, shape ``(N,)``.
    """

    centre: np.ndarray
    radii: np.ndarray

    def fractions(self) -> list[tuple[Fraction, Fraction]]:
        """The coordinates' real and imaginary parts, exactly."""
        return [
            (sum(map(Fraction, re.tolist())), sum(map(Fraction, im.tolist())))
            for re, im in self.centre
        ]

    def permute(self, sources: np.ndarray, signs: np.ndarray) -> Ball:
        """The same with coordinate ``sources[i]`` in place ``i``, times ``signs[i]``."""
        return Ball(self.centre[sources] * signs[:, None, None], self.radii[sources])


@dataclass(frozen=True, eq=False)
class PathBranch:
    """What a path is near its end: a power series in ``t ** (1 / winding)``, by its first terms.

    Attributes:
        orders: of the coordinates, in units of ``1 / winding``; `NEVER` for those that vanish.
        logs: logarithms of their leading coefficients over that of the first coordinate of least
            order in each group, shape ``(N,)``.
        bends: derivatives of these logarithms' power series at t = 0, shape ``(N,)``.
    """

    winding: int
    orders: tuple[int, ...]
    logs: np.ndarray
    bends: np.ndarray

    def permute(
        self, sources: np.ndarray, signs: np.ndarray, groups: Sequence[Sequence[int]]
    ) -> PathBranch:
        """The same with coordinate ``sources[i]`` in place ``i``, times ``signs[i]``."""
        orders = tuple(self.orders[k] for k in sources)
        logs, bends = self.logs[sources] + np.where(signs < 0, 1j * np.pi, 0), self.bends[sources]
        return PathBranch(
            self.winding,
            orders,
            relative(logs, orders, groups),
            relative(bends, orders, groups),
        )


def relative(
    values: np.ndarray, orders: Sequence[int], groups: Sequence[Sequence[int]]
) -> np.ndarray:
    """Values less that of the first coordinate of least order in each group, 0 where there is none.

    Shape ``(N,)``.
    """
    result = np.zeros(len(values), dtype=np.complex128)
    for indices in groups:
        first = min(indices, key=lambda j: (orders[j], j))
        for j in indices:
            if orders[j] < NEVER:
                result[j] = values[j] - values[first]
    return result


@dataclass(frozen=True, eq=False)
class Paths(ArrayTable):
    """Ends of ``P`` paths.

    Attributes:
        points: end points, unit norm in each group of coordinates, shape ``(P, N)``.
        status: `PathStatus`, int8.
        winding: winding number of the end (1 for regular ends, 0 for failed paths).
        accuracy: estimated relative error of the point; for failed paths of where they seem to
            lead, inf if nothing is known of that.
        condition: Frobenius norm of the Jacobian over its smallest singular value.
        steps: predictor steps, rejected ones included, of all arithmetics.
        precision: decimal digits of the arithmetic used: 16, 32, 64 or 120.
        reason: `Reason` of a failure, 0 otherwise.
        simple: whether the end is a regular zero, be it at infinity.
        balls: regular ends that were found in more digits, by index.
        branches: the branches to other ends, by index.
    """

    points: np.ndarray
    status: np.ndarray
    winding: np.ndarray
    accuracy: np.ndarray
    condition: np.ndarray
    steps: np.ndarray
    precision: np.ndarray
    reason: np.ndarray
    simple: np.ndarray
    balls: Mapping[int, Ball] = field(default_factory=dict)
    branches: Mapping[int, PathBranch] = field(default_factory=dict)

    def arrays(self) -> dict[str, np.ndarray]:
        """All of it as arrays, by name."""
        plain = ("balls", "branches")
        found = {f.name: getattr(self, f.name) for f in fields(self) if f.name not in plain}
        for path, ball in self.balls.items():
            found[f"ball {path} centre"], found[f"ball {path} radii"] = ball.centre, ball.radii
        for path, branch in self.branches.items():
            found[f"branch {path} orders"] = np.array([branch.winding, *branch.orders])
            found[f"branch {path} logs"] = branch.logs
            found[f"branch {path} bends"] = branch.bends
        return found

    @classmethod
    def from_arrays(cls, arrays: Mapping[str, np.ndarray]) -> Paths:
        """What `arrays` was made of; other names are passed over."""
        balls: dict[int, Ball] = {}
        branches: dict[int, PathBranch] = {}
        for name, radii in arrays.items():
            kind, _, rest = name.partition(" ")
            if kind == "ball" and rest.endswith(" radii"):
                path = int(rest.split()[0])
                balls[path] = Ball(arrays[f"ball {path} centre"], radii)
            elif kind == "branch" and rest.endswith(" orders"):
                path = int(rest.split()[0])
                winding, *orders = radii.tolist()
                logs, bends = (arrays[f"branch {path} {part}"] for part in ("logs", "bends"))
                branches[path] = PathBranch(winding, tuple(orders), logs, bends)
        plain = {f.name: arrays[f.name] for f in fields(cls) if f.name in arrays}
        return cls(**plain, balls=balls, branches=branches)

    def same(self, homotopy: Homotopy, i: int, j: int) -> bool:
        """Whether two ends coincide in all digits that they are known to.

        A limit in which coordinates vanish is no end in which they certainly do not.
        """
        for one, other in ((i, j), (j, i)):
            if one in self.balls and other in self.branches:
                ball, none = self.balls[one], self.points[other] == 0
                sizes = np.hypot(*ball.centre[none, :, 0].T)
                return not (sizes > SAFETY * ball.radii[none]).any()
        if i not in self.balls or j not in self.balls:
            return True
        first, second = self.balls[i].fractions(), self.balls[j].fractions()
        for group in homotopy.groups:
            # Points of a projective space: coordinates over those of the largest one.
            largest = max(group, key=lambda k: abs(self.points[i, k]))
            for k in group:
                error = sum(
                    2 * float(ball.radii[k] + ball.radii[largest])
                    for ball in (self.balls[i], self.balls[j])
                )
                a, b = _ratio(first[k], first[largest]), _ratio(second[k], second[largest])
                if max(abs(float(a[0] - b[0])), abs(float(a[1] - b[1]))) > SAFETY * error:
                    return False
        return True

    def track_again(self, indices: np.ndarray, ends: Paths) -> Paths:
        """The same, some of which were tracked to other ends; steps add up."""
        found = self.replace_rows(indices, ends)
        found.steps[indices] += self.steps[indices]
        return found

    def mark_failed(self, indices: np.ndarray) -> Paths:
        """The same, some of which have failed: their ends ask for more digits."""
        status, reason, winding = self.status.copy(), self.reason.copy(), self.winding.copy()
        status[indices], reason[indices], winding[indices] = PathStatus.FAILED, Reason.ENDGAME, 0
        simple = self.simple & (status != int(PathStatus.FAILED))
        return replace(self, status=status, reason=reason, winding=winding, simple=simple)

    def mark_infinite(self, indices: np.ndarray, homotopy: Homotopy) -> Paths:
        """The same, some of which are known to lead to infinity, though not where."""
        status, reason, points = self.status.copy(), self.reason.copy(), self.points.copy()
        status[indices], reason[indices] = PathStatus.AT_INFINITY, Reason.NONE
        infinite = np.array(homotopy.infinity)
        least = infinite[np.abs(points[np.ix_(indices, infinite)]).argmin(axis=1)]
        points[indices, least] = 0.0
        points[indices] = homotopy.normalized(points[indices])
        return replace(self, points=points, status=status, reason=reason)

    def conjugate(self) -> Paths:
        """The complex conjugates of regular ends, to which no path was tracked."""
        sign = np.array([1.0, -1.0])[:, None]
        balls = {k: Ball(ball.centre * sign, ball.radii) for k, ball in self.balls.items()}
        steps = np.zeros_like(self.steps)
        return replace(self, points=self.points.conj(), steps=steps, balls=balls)

    def permute(
        self, sources: np.ndarray, signs: np.ndarray, groups: Sequence[Sequence[int]]
    ) -> Paths:
        """The same with coordinate ``sources[p, i]`` of path ``p`` in place ``i``, with a sign."""
        balls, branches = self.balls.items(), self.branches.items()
        return replace(
            self,
            points=np.take_along_axis(self.points, sources, axis=1) * signs,
            balls={p: ball.permute(sources[p], signs[p]) for p, ball in balls},
            branches={p: b.permute(sources[p], signs[p], groups) for p, b in branches},
        )

    def __repr__(self) -> str:
        counts = Counter(self.status.tolist())
        text = ", ".join(f"{counts[s]} {s.name.lower()}" for s in PathStatus if counts[s])
        return f"Paths({len(self)}: {text})"

    def where(self, *status: PathStatus) -> np.ndarray:
        """Indices of the paths with one of these statuses."""
        chosen = np.zeros(len(self.status), dtype=bool)
        for one in status:
            chosen |= self.status == int(one)
        return np.flatnonzero(chosen)

    @property
    def failures(self) -> dict[str, int]:
        """Number of failed paths for each reason."""
        failed = self.reason[self.status == PathStatus.FAILED]
        return {Reason(r).text: int(k) for r, k in sorted(Counter(failed.tolist()).items())}


def _ratio(a: tuple[Fraction, Fraction], b: tuple[Fraction, Fraction]) -> tuple[Fraction, Fraction]:
    size = b[0] ** 2 + b[1] ** 2
    return (a[0] * b[0] + a[1] * b[1]) / size, (a[1] * b[0] - a[0] * b[1]) / size
