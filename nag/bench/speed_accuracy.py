"""Speed against accuracy: a case in many settings, arithmetics and programs, beside a reference."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, replace

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.bench.component_curves import components_chart
from nag.bench.peer_points import forms, peer_points, programs
from nag.bench.reference import Found, Reference, ReferenceError, compare_points
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
from nag.solving.solve import solve
from nag.tracking.evaluations import count_evaluations
from nag.tracking.settings import Settings

SEEDS = 5


def chart_of(
    subject: MeasuredCase,
    seeds: int = SEEDS,
    peers: bool = True,
    progress: Progress | None = None,
) -> Chart:
    """Measure a case.

    Args:
        progress: called with the name of each curve before it is measured.

    Raises:
        ReferenceError: if its solutions cannot be proved.
    """
    if subject.decomposed:
        return components_chart(subject, seeds, peers, progress)
    chart = _solutions(subject, seeds, progress)
    if not peers:
        return chart
    reference = _reference(subject)
    others = []
    for program in programs():
        if progress is not None:
            progress(program)
        others.append(_peer(program, subject.system, reference))
    return replace(chart, curves=(*chart.curves, *others))


def _reference(subject: MeasuredCase) -> Reference:
    found = solve(subject.system, settings="careful")
    if not found.complete or any(s.multiplicity > 1 for s in found.solutions):
        raise ReferenceError("not all solutions are simple and known")
    if not found.solutions:
        raise ReferenceError("there are no isolated solutions")
    expected = sum(count for _, _, count in subject.degrees)
    if expected and len(found.solutions) != expected:
        raise ReferenceError(f"{len(found.solutions)} solutions were found, {expected} are known")
    none = np.zeros((0, 1 + subject.system.n), dtype=complex)
    return Reference.of(subject.system, found.points, none)


def _solutions(subject: MeasuredCase, seeds: int, progress: Progress | None) -> Chart:
    from nag.solving.certificate import certify_solutions
    from nag.solving.certified_paths import prove_paths

    system, reference = subject.system, _reference(subject)

    def measured(seed: int, settings: Settings | str) -> tuple[float, int, Found]:
        with count_evaluations() as spent:
            seconds, found = time_call(lambda: solve(system, seed=seed, settings=settings))
        return seconds, spent.number, compare_points(reference, found.points)

    curves = own_curves(measured, seeds, progress)
    curves += in_arithmetics(system, reference, seeds, progress)
    found = solve(system)
    seconds, certificate = min(
        (time_call(lambda: certify_solutions(found)) for _ in range(3)), key=lambda pair: pair[0]
    )
    path_proof, paths = time_call(lambda: prove_paths(found))
    sharpened = {k: tuple(v) for k, v in sharpening(system, reference).items()}
    return Chart(
        subject.name,
        "solutions",
        len(reference.high),
        seeds,
        tuple(curves),
        certificate.simple,
        seconds,
        path_proof,
        len(paths.reached) - paths.lost,
        len(paths.reached),
        sharpened,
    )


def _peer(program: str, system: PolynomialSystem, reference: Reference) -> ChartCurve:
    curves = []
    for remark, form in forms(system).items():
        answer = peer_points(program, form, PATIENCE)
        if answer.points is None:
            curves.append(ChartCurve("peer", program, (), answer.remark))
            continue
        found = compare_points(reference, answer.points)
        point = Point(program, answer.seconds, 0, **asdict(found))
        curves.append(ChartCurve("peer", program, (point,), remark))
    return best_form(curves)


def ratios(charts: Sequence[Chart], accuracy: float = 1e-12) -> list[list[str]]:
    """Rows of a table: our time with default settings beside the other programs'.

    Other programs are compared where they find all solutions to the accuracy, as we do. A star says
    that a program did best in the other one of `nag.bench.peer_points.forms`.
    """
    lines = [["case", "found", "largest error", "seconds", "program", "found", "error", "ratio"]]
    for chart in charts:
        mine = next(p for c in chart.curves for p in c.points if p.name == "default")
        head = [chart.case, f"{mine.share:.0%}", f"{mine.largest:.1e}", f"{mine.seconds:.4f}"]
        others = [c for c in chart.curves if c.kind == "peer"]
        for curve in others or [ChartCurve("peer", "-", ())]:
            if not curve.points:
                lines.append([*head, curve.label, "-", "-", curve.remark or "-"])
                continue
            (p,) = curve.points
            good = p.share == 1 and p.largest <= accuracy and mine.largest <= accuracy
            ratio = f"{p.seconds / mine.seconds:.1f}"
            told = ratio if good and mine.share == 1 else f"({ratio})"
            error = f"{p.largest:.1e}" if p.share else "-"
            name = f"{p.name} *" if curve.remark else p.name
            lines.append([*head, name, f"{p.share:.0%}", error, told])
    return lines
