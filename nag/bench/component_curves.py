"""Speed against accuracy of decompositions: components found, and errors of their witness points.

An error is the distance of a witness point from the exact one on its own slice. Arithmetics are
those of the paths to the witness points on one slice, which has rational coefficients here.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench.peer_components import decomposing_programs, peer_components
from nag.bench.peer_points import forms
from nag.bench.reference import Found, Reference, ReferenceError, join_found
from nag.bench.sharpening import sharpening
from nag.bench.work_precision import (
    PATIENCE,
    Chart,
    ChartCurve,
    MeasuredCase,
    Point,
    Progress,
    best_form,
    in_arithmetics,
    own_curves,
    time_call,
)
from nag.decomposition.decompose import decompose
from nag.numerics.certified_points import independent_equations
from nag.solving.solve import solve
from nag.tracking.evaluations import count_evaluations
from nag.tracking.settings import Settings

# Coefficients of a slice are integers up to this.
SLICE = 99
Wanted = Sequence[tuple[int, int, int]]


@dataclass(frozen=True, eq=False)
class Listed:
    """A component that is said to be there, so many times: points on a slice, rows on (1, x)."""

    points: np.ndarray
    rows: np.ndarray
    count: int = 1
    doubtful: bool = False


def components_chart(
    subject: MeasuredCase, seeds: int, peers: bool, progress: Progress | None
) -> Chart:
    """Measure the decomposition of a case.

    Raises:
        ReferenceError: if the witness points on a slice cannot be proved.
    """
    from nag.witness.certificate import certify_decomposition
    from nag.witness.certified_loops import prove_all

    system, wanted = subject.system, sorted(subject.degrees)

    def measured(seed: int, settings: Settings | str) -> tuple[float, int, Found]:
        with count_evaluations() as spent:
            seconds, found = time_call(lambda: decompose(system, seed=seed, settings=settings))
        listed = (Listed(c.points, c.slice.rows, c.orbit, bool(c.note)) for c in found.components)
        return seconds, spent.number, agreement(system, listed, wanted)

    curves = own_curves(measured, seeds, progress)
    section, square, reference = witness_section(subject, np.random.default_rng(0))
    curves += in_arithmetics(section, reference, seeds, progress)
    for program in decomposing_programs() if peers else ():
        if progress is not None:
            progress(program)
        curves.append(_peer(program, system, wanted, seeds))
    found = decompose(system)
    seconds, certificate = time_call(lambda: certify_decomposition(found))
    path_proof, loops = time_call(lambda: prove_all(found))
    return Chart(
        subject.name,
        "components",
        sum(count for _, _, count in wanted),
        seeds,
        tuple(curves),
        sum(c.all_proved for c in certificate.components),
        seconds,
        path_proof,
        sum(m.connected for m in loops),
        len(loops),
        {k: tuple(v) for k, v in sharpening(square, reference).items()},
    )


def agreement(system: PolynomialSystem, found: Iterable[Listed], wanted: Wanted) -> Found:
    """Components of the right dimension and degree, and errors of the witness points."""
    left = {(d, g): count for d, g, count in wanted}
    right = false = 0
    errors: list[float] = []
    for c in found:
        key = len(c.rows), len(c.points)
        if left.get(key, 0) < c.count or c.doubtful:
            false += c.count
            continue
        try:
            reference = Reference.of(system, c.points, c.rows)
        except ReferenceError:
            false += c.count
            continue
        left[key] -= c.count
        right += c.count
        errors += reference.errors(c.points, np.arange(len(c.points))).tolist()
    largest = max(errors, default=float("nan"))
    middle = float(np.median(errors)) if errors else float("nan")
    return Found(right / max(1, sum(count for _, _, count in wanted)), false, largest, middle)


def witness_section(
    subject: MeasuredCase, rng: np.random.Generator
) -> tuple[PolynomialSystem, PolynomialSystem, Reference]:
    """The system with a rational slice that cuts its largest components in points.

    Returns:
        The system, as many of its equations as determine the points, and these, proved.

    Raises:
        ReferenceError: if they are not as many as the degrees of the components say.
    """
    system = subject.system
    dimension = max(d for d, _, _ in subject.degrees)
    cuts = [_linear(system.n, rng) for _ in range(dimension)]
    section = replace(system, polynomials=(*system.polynomials, *cuts))
    found = solve(section, settings="careful")
    expected = sum(g * count for d, g, count in subject.degrees if d == dimension)
    if not found.complete or [s.multiplicity for s in found.solutions] != [1] * expected:
        raise ReferenceError(f"a slice does not meet the components in {expected} simple points")
    none = np.zeros((0, 1 + system.n), dtype=complex)
    reference = Reference.of(section, found.points, none)
    chosen = independent_equations(section.polynomials, none, found.points[0])
    square = replace(section, polynomials=tuple(section.polynomials[i] for i in chosen))
    return section, square, reference


def _linear(n: int, rng: np.random.Generator) -> Polynomial:
    *weights, constant = rng.integers(1, SLICE, n + 1) * rng.choice([-1, 1], n + 1)
    x = Polynomial.variables(n)
    return sum((int(w) * v for w, v in zip(weights, x, strict=True)), x[0] * 0 + int(constant))


def _peer(program: str, system: PolynomialSystem, wanted: Wanted, seeds: int) -> ChartCurve:
    """What a program finds over seeds; where it gives no answer to the first, nothing is."""
    curves = (
        _in_form(program, form, system, wanted, seeds, remark)
        for remark, form in forms(system).items()
    )
    return best_form(curves)


def _in_form(
    program: str,
    form: PolynomialSystem,
    system: PolynomialSystem,
    wanted: Wanted,
    seeds: int,
    remark: str,
) -> ChartCurve:
    seconds, found = [], []
    for seed in range(seeds):
        answer = peer_components(program, form, PATIENCE, seed)
        if answer.components is None and not seed:
            return ChartCurve("peer", program, (), answer.remark)
        listed = [Listed(c.points, c.rows) for c in answer.components or ()]
        seconds.append(answer.seconds)
        found.append(agreement(system, listed, wanted))
    point = Point(program, float(np.median(seconds)), 0, **asdict(join_found(found)))
    return ChartCurve("peer", program, (point,), remark)
