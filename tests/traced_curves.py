"""Real curves for tests of what is made of them: one loop, followed from a point on it."""

from __future__ import annotations

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.mechanism.problem import Problem
from nag.real.curve import (
    PictureVerdict,
    PieceKind,
    RealCurve,
    RealEdge,
    RealPiece,
    Turn,
)


def turns_of(system: PolynomialSystem) -> tuple[Turn, ...]:
    """The variables that are half-angles: those with a norm of their own that must not vanish."""
    found = []
    for norm in system.nonzero:
        if len(norm.support) == 1:
            (i,) = norm.support
            c, b, a = (
                float(norm.terms.get(tuple(k if j == i else 0 for j in range(system.n)), 0))
                for k in (0, 1, 2)
            )
            centre = -b / (2 * a)
            found.append(Turn(i, centre, float(np.sqrt(c / a - centre**2))))
    return tuple(found)


def trace_loop(problem: Problem, start: np.ndarray, step: float = 0.02, most: int = 20000):
    """The loop through a smooth real point, as a real curve of one piece."""
    system = problem.system
    evaluator = Evaluator.of(system.polynomials, system.n)
    turns = turns_of(system)

    def to_points(chart: np.ndarray) -> np.ndarray:
        points = np.array(chart)
        for t in turns:
            points[..., t.variable] = t.centre + t.radius * np.tan(chart[..., t.variable])
        return points

    def rows(chart: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        x = to_points(chart)
        slopes = np.ones(system.n)
        for t in turns:
            slopes[t.variable] = t.radius / np.cos(chart[t.variable]) ** 2
        values = evaluator.values(x[None])[0].real
        jacobian = evaluator.jacobian(x).real * slopes
        sizes = np.linalg.norm(jacobian, axis=1)
        return values / sizes, jacobian / sizes[:, None]

    at = np.array(start, dtype=float)
    for t in turns:
        at[t.variable] = t.angles(at[t.variable])
    tangent = np.linalg.svd(rows(at)[1])[2][-1]
    first, chart = at.copy(), [at]
    for i in range(most):
        at = at + step * tangent
        for _ in range(8):
            values, jacobian = rows(at)
            at = at - np.linalg.pinv(jacobian, rcond=1e-8) @ values
        new = np.linalg.svd(rows(at)[1])[2][-1]
        tangent = new if new @ tangent > 0 else -new
        gap = first - at
        for t in turns:
            gap[t.variable] -= np.round(gap[t.variable] / np.pi) * np.pi
        if i > 3 and np.linalg.norm(gap) < 1.5 * step and gap @ tangent > 0:
            chart += [at, at + gap]
            break
        chart.append(at)
    else:
        raise AssertionError("the loop does not close")
    whole = np.array(chart)
    edge = RealEdge(None, None, to_points(whole), whole)
    return RealCurve(
        system.variables,
        turns,
        (),
        (edge,),
        (RealPiece(PieceKind.CLOSED_LOOP, (0,), ()),),
        PictureVerdict.COMPLETE,
    )
