"""Random real points of a component."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.given import check_type, check_whole
from nag.algebra.imaginary_unit import append_unit
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.numerics.digits import DIGITS, working_digits
from nag.numerics.doubles import EPS, ROUGH
from nag.numerics.located_zero import exact_zero
from nag.real.curve import RealCurve, VertexKind
from nag.real.find_curve import find_real_curve
from nag.real.real_equations import find_real_equations
from nag.real.real_pieces import (
    Reality,
    RealPieces,
    find_real_points,
    join_pieces,
    meet_conjugate,
    real_dimension_at,
)
from nag.real.real_through import is_other_than_its_conjugate
from nag.real.spherical_chart import SphericalChart
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.real_points import real_points_near
from nag.witness.sampling import NoRealPointsError, Samples, SamplingError
from nag.witness.witness import WitnessSet

# Random points, in sizes of the component's real points, that real ones are looked for beside; and
# how many are tried for each that is wanted.
SPREAD, TRIES = 1.0, 4
# Decides: Newton's step times what the Jacobian may change over its singular value, below which a
# point is a regular one: a half is enough by Kantorovich's theorem.
TURN = 0.25


def say_none_real(system: PolynomialSystem, reality: Reality, reason: str) -> NagError:
    """The error of a component of which no real point is drawn.

    Args:
        reality: whether there is none, or none was found.
        reason: why.
    """
    kind = NoRealPointsError if reality is Reality.NONE else SamplingError
    none = np.zeros((0, system.n))
    nothing = Samples(none, 0.0, EPS, variables=system.own_variables, real=True, unit=system.unit)
    return kind(f"real points: {reality}{reason and ': '}{reason}", nothing)


@takes_run
def sample_real(component: WitnessSet, count: int, *, run: Run = DEFAULT_RUN) -> Samples:
    """Random real points of a component.

    Those of a finite set and of a curve are drawn from all of them, of a curve each arc as often as
    it is long; those of a larger set are real points near random ones, which favours what is seen
    from there. Turns of a joint count by their half-angle, or the arc of their unit quaternion. Of
    a curve that goes to infinity the lengths of other variables are those on a sphere about the
    middle of it, the radius of which is the median distance of its points.

    Args:
        component: one of the components of a `nag.Decomposition`.
        count: how many.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The points, of which the imaginary parts are zero, but of the imaginary unit where
        coefficients are complex. Their accuracy is that of a regular zero near by; singular ones
        are sharpened by deflation.

    Raises:
        NoRealPointsError: if there are none.
        SamplingError: if none, or not as many, were found; it has those that were.
    """
    check_type(component, WitnessSet, "component", "one of the components of a nag.Decomposition")
    check_whole(count, "count")
    rng = run.random(Stream.REAL_SAMPLES)
    system = component._known_system()
    system.check_real_coordinates()
    if component.dimension and system.imaginary:
        return _of_complex_equations(component, count, rng, run)
    if component.dimension == 1:
        return _of_curve(component, count, rng, run)
    if component.dimension and is_other_than_its_conjugate(system, component, run):
        met = meet_conjugate(component, run)
        if met is not None:
            return _of_parts(component, met, find_real_points, "", count, rng, run)
    found = find_real_points(component, run=run)
    if found.reality is not Reality.FOUND:
        raise say_none_real(system, found.reality, found.reason)
    if component.dimension == 0:
        return _draw_from(component, found, count, rng)
    return _near(component, np.asarray(found.points), count, rng, run)


def _draw_from(
    component: WitnessSet, found: RealPieces, count: int, rng: np.random.Generator
) -> Samples:
    """Some of finitely many real points."""
    drawn = rng.integers(len(found.points), size=count)
    dimensions = [found.dimensions[k] for k in drawn]
    return _samples(component, found.points[drawn], dimensions, _doubt_of(found))


def _doubt_of(drawn_from: RealPieces) -> str:
    """Why real points may be missing among those that samples are drawn from."""
    return "" if drawn_from.each_piece else _say_points_may_miss(drawn_from.reason)


def _say_points_may_miss(reason: str) -> str:
    return f"real points may be missing: {reason}"


def _samples(
    component: WitnessSet, points: np.ndarray, dimensions: Sequence[int], doubt: str = ""
) -> Samples:
    """Points with how well they are known; singular ones in their stead where these are found.

    Args:
        dimensions: of the real part round them, -1 where that is not known.
    """
    system = component._known_system()
    z = append_unit(points) if system.imaginary else points + 0j
    evaluator = Evaluator.of(system.polynomials, system.n)
    known, errors = z.copy(), np.zeros(len(z))
    found: dict[bytes, tuple[np.ndarray, float]] = {}
    for k, x in enumerate(z):
        if x.tobytes() not in found:
            error = _error_of_regular(evaluator, x, component.dimension)
            found[x.tobytes()] = (x, error) if error < np.inf else _singular_point(component, x)
        known[k], errors[k] = found[x.tobytes()]
    residual = float(evaluator.residuals(known).max(initial=0.0))
    error = float(errors.max(initial=EPS))
    dimensions = tuple(map(int, dimensions))
    own, unit = system.own_variables, system.unit
    return Samples(known, residual, error, doubt, own, True, dimensions, unit)


@np.errstate(all="ignore")
def _error_of_regular(evaluator: Evaluator, x: np.ndarray, dimension: int) -> float:
    """How far a zero is from a point, over one and its size; infinite where it may be singular.

    Newton's step with the corank of the component, and rounding; by Kantorovich's theorem there is
    a zero so near where the Jacobian changes little on the way.
    """
    rank = len(x) - dimension
    if rank == 0:
        return EPS
    size = np.maximum(np.abs(x), 1.0)
    weights = size.max(initial=1.0) ** -(evaluator.degrees - 1.0)
    sizes, second = evaluator.term_sizes(size[None], len(x))
    s = np.linalg.svd(evaluator.balanced_jacobian(x), compute_uv=False)
    if len(s) < rank or not s[rank - 1] > 0:
        return np.inf
    left = (np.abs(evaluator.values(x[None])[0]) + EPS * sizes[0]) * weights
    step = float(np.linalg.norm(left) / s[rank - 1])
    turn = step * float(np.linalg.norm(second[0] * weights) / s[rank - 1])
    return step / (1 + float(np.linalg.norm(x))) if turn < TURN else np.inf


def _singular_point(component: WitnessSet, x: np.ndarray) -> tuple[np.ndarray, float]:
    """The singular zero that a point stands for, and its error relative to one and its size.

    Where it is not found it is the point itself, with an error as at a zero of the multiplicity of
    the largest degree.
    """
    system = component._known_system()
    evaluator = Evaluator.of(system.polynomials, system.n)
    residual = float(evaluator.residuals(x[None]).max(initial=0.0))
    rng = np.random.default_rng(0)
    with working_digits(DIGITS):
        # The error of a double zero is the square root of what is left of the equations.
        near, factors = exact_zero(system.polynomials, x, max(ROUGH, residual**0.5), rng)
        if near is not None:
            balls = [f * c for f, c in zip(factors, near.balls, strict=True)]
            radii = np.array([float(c.rad()) for c in balls])
            y = np.array([complex(c.mid()) for c in balls])
            own = len(system.own_variables)
            y[:own] = y[:own].real
            # Rounded to doubles.
            error = np.linalg.norm(radii) / (1 + np.linalg.norm(y)) + EPS
            return y, float(error)
    return x, max(residual, EPS) ** (1 / int(evaluator.degrees.max()))


def _of_complex_equations(
    component: WitnessSet, count: int, rng: np.random.Generator, run: Run
) -> Samples:
    """Points of the real and imaginary parts' sets that lie on a component."""
    equations = find_real_equations(component, run)

    def find_all(component: WitnessSet, *, run: Run) -> RealPieces:
        found = [find_real_points(each, run=run) for each in equations.inside]
        return join_pieces(component, equations, found, run)

    return _of_parts(component, equations.inside, find_all, equations.doubt, count, rng, run)


def _of_parts(
    component: WitnessSet,
    parts: Sequence[WitnessSet],
    find_all: Callable[..., RealPieces],
    doubt: str,
    count: int,
    rng: np.random.Generator,
    run: Run,
) -> Samples:
    """Points of the sets of the most real dimensions that lie on a component, all alike often.

    Args:
        parts: sets on which all its real points lie, but for finitely many.
        find_all: its real points, where none of the parts has more than finitely many.
        doubt: why parts may be missing; empty if none is.
    """
    found = [(each, find_real_points(each, run=run)) for each in parts]
    largest = max((max(f.dimensions) for _, f in found if len(f)), default=-1)
    if largest <= 0:
        whole = find_all(component, run=run)
        if whole.reality is not Reality.FOUND:
            raise say_none_real(component._known_system(), whole.reality, whole.reason)
        return _draw_from(component, whole, count, rng)
    chosen = [each for each, f in found if len(f) and max(f.dimensions) == largest]
    shares = rng.multinomial(count, np.full(len(chosen), 1 / len(chosen)))
    drawn = [
        _sample_part(component, each, int(share), run)
        for each, share in zip(chosen, shares, strict=True)
        if share
    ]
    doubts = [_say_points_may_miss(doubt)] if doubt else []
    doubts += [part.doubt for part in drawn if part.doubt]
    order = rng.permutation(count)
    points = np.vstack([part.points.real for part in drawn])[order]
    dimensions = np.concatenate([part.real_dimensions for part in drawn])[order]
    return _samples(component, points, dimensions.tolist(), "; ".join(dict.fromkeys(doubts)))


def _sample_part(component: WitnessSet, part: WitnessSet, count: int, run: Run) -> Samples:
    """Points of a component of real parts; those of an error are points of the complex equations.

    Raises:
        SamplingError: as `sample_real` does.
    """
    try:
        return sample_real(part, count, run=run)
    except SamplingError as error:
        some = _samples(component, error.found.points.real, error.found.real_dimensions)
        raise SamplingError(str(error), some) from None


def _of_curve(component: WitnessSet, count: int, rng: np.random.Generator, run: Run) -> Samples:
    """Points of the arcs, isolated ones where there is none, and why others may be missing."""
    curve = find_real_curve(component, run=run)
    doubt = "" if curve.complete else _say_points_may_miss(curve.reason)
    if curve.edges:
        # An arc's points but for the first; they are on the curve to rounding.
        points = np.vstack([e.points[1:] for e in curve.edges])
        lengths = _lengths_of_steps(curve, SphericalChart.of(component._known_system()))
        drawn = points[rng.choice(len(points), size=count, p=lengths / lengths.sum())]
        return _samples(component, drawn, [1] * count, doubt)
    isolated = [v.point for v in curve.vertices]
    if not isolated:
        none = Reality.NONE if curve.complete else Reality.NONE_FOUND
        raise say_none_real(component._known_system(), none, curve.reason)
    drawn = np.array(isolated)[rng.integers(len(isolated), size=count)]
    return _samples(component, drawn, [0] * count, doubt)


def _lengths_of_steps(curve: RealCurve, coordinates: SphericalChart) -> np.ndarray:
    """Distances between neighbours on all arcs, one after another."""
    charts = [coordinates.make_continuous(coordinates.chart(e.points)) for e in curve.edges]
    if any(v.kind is VertexKind.INFINITE for v in curve.vertices):
        grouped = {i for columns in coordinates.columns for i in columns}
        others = [i for i in range(coordinates.size) if i not in grouped]
        every = np.vstack(charts)[:, others]
        middle = np.median(every, axis=0)
        radius = np.median(np.linalg.norm(every - middle, axis=1))
        # It is zero where only turns change: these go where a norm vanishes, by a finite length.
        for k, chart in enumerate(charts if radius > 0 else ()):
            y = (chart[:, others] - middle) / radius
            unit = np.hstack([np.ones((len(y), 1)), y])
            unit /= np.linalg.norm(unit, axis=1, keepdims=True)
            charts[k] = np.hstack([np.delete(chart, others, axis=1), radius * unit])
    return np.concatenate([np.linalg.norm(np.diff(c, axis=0), axis=1) for c in charts])


def _near(
    component: WitnessSet,
    known: np.ndarray,
    count: int,
    rng: np.random.Generator,
    run: Run,
) -> Samples:
    """Real points of a larger set near random ones, beside some that are known."""
    system = component._known_system()
    coordinates = SphericalChart.of(system)
    charts = coordinates.chart(known)
    sizes = SPREAD * np.full(coordinates.size, 1 + float(np.abs(charts[:, : system.n]).max()))
    for columns in coordinates.columns:
        sizes[columns] = SPREAD
    found: list[np.ndarray] = []
    for _ in range(TRIES * count):
        if len(found) == count:
            break
        near = charts[rng.integers(len(charts))] + sizes * rng.standard_normal(coordinates.size)
        near = coordinates.points(near[None])[0]
        points = real_points_near(system, component, near, starts=1, run=run)
        if len(points):
            found.append(np.asarray(points.points)[0])
    dimensions = [real_dimension_at(system, component, x) for x in found]
    some = _samples(component, np.array(found).reshape(-1, system.n), dimensions)
    if len(found) < count:
        raise SamplingError(f"{len(found)} of {count} random real points were found", some)
    return some
