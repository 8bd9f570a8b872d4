"""The paths to the solutions of a system, proved: which start leads to which solution.

The homotopy is the one that `nag.solving.solve` tracks, in a random affine chart; its target is the
exact system, in scaled variables.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.errors import ComponentError
from nag.numerics.coincidence import NEAR
from nag.numerics.read_only import equal_values
from nag.solving.solutions import SolveResult
from nag.solving.square_problem import SquareProblem
from nag.solving.start import KINDS
from nag.solving.start.choice import choose
from nag.solving.start.target import StartSystem, Target
from nag.tracking.certified_paths import (
    ENDGAME,
    CertifiedPaths,
    ProvedZeros,
    are_distinct,
    certified_paths,
    prove_zeros_near,
)
from nag.tracking.moving_discs import MovingSystem
from nag.tracking.run import Stream

# More paths would take long.
MOST_PATHS = 4096
# Where solutions are missing, the other paths are followed down to these t, one after the other.
FURTHER = (1e-12, 1e-24, 0.0)


class PathsError(ComponentError):
    """Why paths cannot be proved, in one line."""


@dataclass(frozen=True, eq=False)
class ProvedPaths:
    """What is proved of the paths from the zeros of a start system.

    Attributes:
        start: name of the start system.
        distinct: whether its zeros are proved, and proved to be distinct: no two paths meet then.
        reached: t down to which a tube about each path holds no other zero, shape ``(P,)``.
        ends: for each path that got to t = 0 the solution that it ends in, -1 for none of them and
            for other paths.
        steps: number of tubes.
        others: the ends that are none of the solutions, and not at infinity, shape ``(k, n)``.
    """

    start: str
    distinct: bool
    reached: np.ndarray
    ends: np.ndarray
    steps: int
    others: np.ndarray

    __eq__ = equal_values

    def rows(self, solutions: int, seconds: float) -> list[tuple[str, str]]:
        """What is proved of the paths to so many solutions, as labelled texts."""
        total, ends, largest = len(self.reached), len(self.solutions), self.reached.max(initial=0)
        text = (
            f"{total - self.lost} of {total} proved from t = 1 on; {self.arrived} end in simple "
            f"zeros, among them {ends} of the {solutions} solutions"
        )
        if self.followed:
            text += f"; {self.followed} go on to t = {self.reached[self.left].max():.0e}"
        rows = [("paths", text)]
        if self.lost:
            rows.append(("doubt", f"{self.lost} paths were lost, the first at t = {largest:.2g}"))
        if not self.distinct:
            rows.append(("doubt", "the start points were not proved to be distinct"))
        rows.append(("", f"{self.steps} tubes, {seconds:.2f} s"))
        return rows

    def document(self) -> dict[str, Any]:
        """What is proved, as a JSON object."""
        return {
            "start": self.start,
            "distinct": self.distinct,
            "reached": self.reached.tolist(),
            "ends": [int(k) if k >= 0 else None for k in self.ends],
            "tubes": self.steps,
        }

    @property
    def arrived(self) -> int:
        """Number of paths that are proved to end in simple zeros."""
        return int((self.reached == 0).sum())

    @property
    def followed(self) -> int:
        """Number of others that are proved down to the endgame."""
        return int(self.left.sum())

    @property
    def left(self) -> np.ndarray:
        """Which paths these are, shape ``(P,)``."""
        return (self.reached > 0) & (self.reached <= ENDGAME)

    @property
    def lost(self) -> int:
        """Number of paths that are not proved so far."""
        return len(self.reached) - self.arrived - self.followed

    @property
    def solutions(self) -> np.ndarray:
        """Indices of the solutions that are proved to be ends of paths."""
        return np.unique(self.ends[self.ends >= 0])


@np.errstate(over="ignore", invalid="ignore")
def prove_paths(result: SolveResult, threads: int = 1) -> ProvedPaths:
    """Prove the paths from a start system to the solutions of a result.

    Raises:
        PathsError: if there are none, or too many.
    """
    problem, start = _start(result.system, result.start, result.seed, threads)
    homotopy = start.homotopy
    rng = np.random.default_rng([result.seed, Stream.CERTIFIED_PATHS])
    patches = np.zeros((len(homotopy.groups), homotopy.N), dtype=complex)
    for g, indices in enumerate(homotopy.groups):
        normal = rng.standard_normal((2, len(indices)))
        patches[g, list(indices)] = normal[0] + 1j * normal[1]
    try:
        system = MovingSystem.of(homotopy, patches)
    except OverflowError as error:
        raise PathsError(str(error)) from None
    starts = prove_zeros_near(system, _put_in_charts(start.points, patches), 1.0)
    ends = _put_in_charts(_coordinates(problem.target, start, result), patches)
    known = prove_zeros_near(system, ends, 0.0, NEAR)
    simple = sum(s.multiplicity == 1 for s in result.solutions)
    paths, steps = certified_paths(system, starts), 0
    for endgame in FURTHER:
        ends, steps = _identify_ends(paths, known), steps + paths.steps
        if len(np.unique(ends[ends >= 0])) >= simple or not (paths.reached > 0).any():
            break
        # Solutions far out, or near infinity, are nobody's until t is very small.
        paths = certified_paths(system, paths.ends, paths.reached, endgame)
    arrived = (paths.reached == 0) & (ends < 0)
    with np.errstate(all="ignore"):
        others = problem.target.original(start.affine(paths.ends.centres[arrived]))
    others = others[np.isfinite(others).all(axis=1)]
    return ProvedPaths(start.name, are_distinct(starts), paths.reached, ends, steps, others)


def _identify_ends(paths: CertifiedPaths, known: ProvedZeros) -> np.ndarray:
    """For each path that arrived which of the known zeros it ends in, -1 for none."""
    ends = np.full(len(paths.reached), -1)
    for p in np.flatnonzero(paths.reached == 0).tolist():
        same = np.flatnonzero(paths.ends.select_rows(np.array([p])).same(known))
        if len(same) == 1:
            ends[p] = same[0]
    return ends


def _start(
    system: PolynomialSystem, kind: str, seed: int, threads: int
) -> tuple[SquareProblem, StartSystem]:
    """The start system of a run, or the one with the least work where it had another."""
    rng = np.random.default_rng(seed)
    equations = [f for f in system.polynomials if f]
    if not system.n or any(f.degree == 0 for f in equations):
        raise PathsError("the system has no paths")
    if len(equations) < system.n:
        raise PathsError("fewer equations than variables: there are no isolated solutions")
    problem = SquareProblem.of(system, equations, rng)
    usual = kind if kind in KINDS and kind != "monodromy" else "auto"
    start, _ = choose(problem.target, usual, system.groups, rng, threads)
    if len(start.points) > MOST_PATHS:
        raise PathsError(f"{len(start.points)} paths; at most {MOST_PATHS} are proved")
    return problem, start


def _coordinates(target: Target, start: StartSystem, result: SolveResult) -> np.ndarray:
    """The solutions in the homotopy's coordinates."""
    points = target.scaled_points(result.points)
    shift = len(start.groups)
    return np.hstack([np.ones((len(points), shift)), points]).astype(complex)


def _put_in_charts(points: np.ndarray, patches: np.ndarray) -> np.ndarray:
    """The same projective points, scaled in each group so that its form is one."""
    points = np.array(points, dtype=complex)
    for form in patches:
        places = np.flatnonzero(form)
        points[:, places] /= (points[:, places] @ form[places])[:, None]
    return points
