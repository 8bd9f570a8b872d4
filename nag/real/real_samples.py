"""Random real points of a component."""

from __future__ import annotations

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.given import check_type, check_whole
from nag.algebra.imaginary_unit import append_unit
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.real.find_curve import find_real_curve
from nag.real.real_equations import find_real_equations
from nag.real.real_pieces import Reality, RealPieces, find_real_points, join_pieces
from nag.tracking.run import DEFAULT_RUN, Run, takes_run
from nag.witness.frame import EPS
from nag.witness.real_points import real_points_near
from nag.witness.sampling import NoRealPointsError, Samples, SamplingError
from nag.witness.witness import WitnessSet

# Random points, in sizes of the component's real points, that real ones are looked for beside; and
# how many are tried for each that is wanted.
SPREAD, TRIES = 1.0, 4


def _why_none(system: PolynomialSystem, reality: Reality, reason: str) -> NagError:
    kind = NoRealPointsError if reality is Reality.NONE else SamplingError
    nothing = _samples(system, np.zeros((0, len(system.own_variables))))
    return kind(f"real points: {reality}{reason and ': '}{reason}", nothing)


@takes_run
def sample_real(component: WitnessSet, count: int, *, run: Run = DEFAULT_RUN) -> Samples:
    """Random real points of a component.

    Those of a finite set and of a curve are drawn from all of them, of a curve each arc as often as
    it is long; those of a larger set are real points near random ones, which favours what is seen
    from there.

    Args:
        component: one of the components of a `nag.Decomposition`.
        count: how many.
        run: a `nag.Run`; its seed, threads, settings and progress may be given one by one.

    Returns:
        The points, of which the imaginary parts are zero, but of the imaginary unit where
        coefficients are complex.

    Raises:
        NoRealPointsError: if there are none.
        SamplingError: if none, or not as many, were found; it has those that were.
    """
    check_type(component, WitnessSet, "component", "one of the components of a nag.Decomposition")
    check_whole(count, "count")
    rng = run.random(14)
    system = component._known_system()
    system.check_real_coordinates()
    if component.dimension and system.imaginary:
        return _of_complex_equations(component, count, rng, run)
    doubt = ""
    if component.dimension == 1:
        points, doubt = _of_curve(component, count, rng, run)
    else:
        found = find_real_points(component, run=run)
        if found.reality is not Reality.FOUND:
            raise _why_none(system, found.reality, found.reason)
        points = np.asarray(found.points)
        if component.dimension == 0:
            points = points[rng.integers(len(points), size=count)]
            doubt = _doubt_of(found)
        else:
            points = _near(component, points, count, rng, run)
    return _samples(system, points, doubt)


def _doubt_of(drawn_from: RealPieces) -> str:
    """Why real points may be missing among those that samples are drawn from."""
    return "" if drawn_from.each_piece else _say_points_may_miss(drawn_from.reason)


def _say_points_may_miss(reason: str) -> str:
    return f"real points may be missing: {reason}"


def _samples(system: PolynomialSystem, points: np.ndarray, doubt: str = "") -> Samples:
    points = append_unit(points) if system.imaginary else points + 0j
    residual = float(Evaluator.of(system.polynomials, system.n).residuals(points).max(initial=0.0))
    return Samples(points, residual, max(residual, EPS), doubt)


def _of_complex_equations(
    component: WitnessSet, count: int, rng: np.random.Generator, run: Run
) -> Samples:
    """Points of the sets of the most real dimensions that lie on a component, all alike often."""
    system = component._known_system()
    equations = find_real_equations(component, run)
    found = [(each, find_real_points(each, run=run)) for each in equations.inside]
    largest = max((max(f.dimensions) for _, f in found if len(f)), default=-1)
    if largest <= 0:
        whole = join_pieces(component, equations, [f for _, f in found], run)
        if whole.reality is not Reality.FOUND:
            raise _why_none(system, whole.reality, whole.reason)
        drawn = whole.points[rng.integers(len(whole.points), size=count)]
        return _samples(system, drawn, _doubt_of(whole))
    chosen = [each for each, f in found if len(f) and max(f.dimensions) == largest]
    shares = rng.multinomial(count, np.full(len(chosen), 1 / len(chosen)))
    parts = [
        _sample_part(system, each, int(share), run)
        for each, share in zip(chosen, shares, strict=True)
        if share
    ]
    doubts = [_say_points_may_miss(equations.doubt)] if equations.doubt else []
    doubts += [part.doubt for part in parts if part.doubt]
    points = rng.permutation(np.vstack([part.points.real for part in parts]))
    return _samples(system, points, "; ".join(dict.fromkeys(doubts)))


def _sample_part(system: PolynomialSystem, part: WitnessSet, count: int, run: Run) -> Samples:
    """Points of a component of real parts; those of an error are points of the complex equations.

    Raises:
        SamplingError: as `sample_real` does.
    """
    try:
        return sample_real(part, count, run=run)
    except SamplingError as error:
        some = _samples(system, error.found.points.real)
        raise SamplingError(str(error), some) from None


def _of_curve(
    component: WitnessSet, count: int, rng: np.random.Generator, run: Run
) -> tuple[np.ndarray, str]:
    """Points of the arcs, isolated ones where there is none, and why others may be missing."""
    curve = find_real_curve(component, run=run)
    doubt = "" if curve.complete else _say_points_may_miss(curve.reason)
    if curve.edges:
        steps = [np.linalg.norm(np.diff(e.chart, axis=0), axis=1) for e in curve.edges]
        # An arc's points but for the first; they are on the curve to rounding.
        points = np.vstack([e.points[1:] for e in curve.edges])
        lengths = np.concatenate(steps)
        return points[rng.choice(len(points), size=count, p=lengths / lengths.sum())], doubt
    isolated = [v.point for v in curve.vertices]
    if not isolated:
        none = Reality.NONE if curve.complete else Reality.NONE_FOUND
        raise _why_none(component._known_system(), none, curve.reason)
    return np.array(isolated)[rng.integers(len(isolated), size=count)], doubt


def _near(
    component: WitnessSet,
    known: np.ndarray,
    count: int,
    rng: np.random.Generator,
    run: Run,
) -> np.ndarray:
    system = component._known_system()
    size = SPREAD * (1 + float(np.abs(known).max()))
    found: list[np.ndarray] = []
    for _ in range(TRIES * count):
        if len(found) == count:
            break
        near = known[rng.integers(len(known))] + size * rng.standard_normal(system.n)
        points = real_points_near(system, component, near, starts=1, run=run)
        if len(points):
            found.append(np.asarray(points.points)[0])
    if len(found) < count:
        some = _samples(system, np.array(found).reshape(-1, system.n))
        raise SamplingError(f"{len(found)} of {count} random real points were found", some)
    return np.array(found).reshape(count, system.n)
