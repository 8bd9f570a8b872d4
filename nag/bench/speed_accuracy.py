"""Speed against accuracy: a case in many settings, arithmetics and programs, beside a reference."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.bench.peer_points import peer_points, programs
from nag.bench.reference import Found, Reference, ReferenceError, compared, joined
from nag.bench.sharpening import Sharpened, sharpening
from nag.bench.whole_paths import ARITHMETICS, WHOLE_TOLERANCES, WholePaths, tracked_in
from nag.decomposition import decompose
from nag.solving.solve import solve
from nag.tracking.ends import end_run
from nag.tracking.evaluations import counted
from nag.tracking.settings import NAMED, Settings
from nag.witness.witness import Decomposition

ORDERS = (3, 4, 6, 8)
TOLERANCES = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
DIGITS = (16, 32, 64)
SEEDS, PATIENCE = 5, 120.0


@dataclass(frozen=True)
class Subject:
    """A case to be measured.

    Attributes:
        degrees: for a decomposition, dimension, degree and number of the components known.
    """

    name: str
    system: PolynomialSystem
    decomposed: bool
    degrees: tuple[tuple[int, int, int], ...] = ()


@dataclass(frozen=True)
class Point:
    """What one setting gave.

    Attributes:
        name: which one of its curve.
        seconds: processor time, median over seeds; evaluations: of the system, see
            `nag.tracking.evaluations`, median, 0 where they are not counted.
        share: of the solutions, or components, that are right, mean over seeds.
        false: points that are none, or are found twice, over all seeds.
        largest, median: relative errors of the solutions found.
    """

    name: str
    seconds: float
    evaluations: int
    share: float
    false: int
    largest: float
    median: float


@dataclass(frozen=True)
class Curve:
    """Points that belong together.

    Attributes:
        kind: ``"settings"``, ``"order"``, ``"digits"``, ``"arithmetic"`` (see
            `nag.bench.whole_paths`) or ``"peer"``.
    """

    kind: str
    label: str
    points: tuple[Point, ...]
    remark: str = ""


@dataclass(frozen=True)
class Chart:
    """All of one case.

    Attributes:
        what: ``"solutions"`` or ``"components"``; expected: their number.
        certification: processor seconds of proving all of them; certified: how many were.
        path_proof: processor seconds of proving that no path jumped, or that loops connect the
            points of components; proved_paths: for how many paths, or components, that was proved,
            out of ``paths``.
        sharpened: errors after each Newton step, by arithmetic.
    """

    case: str
    what: str
    expected: int
    seeds: int
    curves: tuple[Curve, ...]
    certified: int
    certification: float
    path_proof: float
    proved_paths: int
    paths: int
    sharpened: dict[str, tuple[Sharpened, ...]]


def settings_of_curves() -> Iterator[tuple[str, str, list[tuple[str, Settings | str]]]]:
    """Kind, label and settings of our own curves."""
    yield "settings", "settings", [(name, name) for name in NAMED]
    default = NAMED["default"]
    for order in ORDERS:
        several = [
            (f"{tolerance:.0e}", replace(default, order=order, tolerance=tolerance))
            for tolerance in TOLERANCES
        ]
        yield "order", f"order {order}, tolerances 1e-1 to 1e-5", several
    several = [(f"{digits} digits", replace(default, digits=digits)) for digits in DIGITS]
    yield "digits", "ends in at most 16, 32, 64 digits", several


def chart_of(
    subject: Subject,
    seeds: int = SEEDS,
    peers: bool = True,
    progress: Callable[[str], None] | None = None,
) -> Chart:
    """Measure a case.

    Args:
        progress: called with the name of each curve before it is measured.

    Raises:
        ReferenceError: if its solutions cannot be proved.
    """
    chart = (_components if subject.decomposed else _solutions)(subject, seeds, progress)
    if not peers or subject.decomposed:
        return chart
    reference = _reference(subject)
    others = []
    for program in programs():
        if progress is not None:
            progress(program)
        others.append(_peer(program, subject.system, reference))
    return replace(chart, curves=(*chart.curves, *others))


def _reference(subject: Subject) -> Reference:
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


def _solutions(subject: Subject, seeds: int, progress: Callable[[str], None] | None) -> Chart:
    from nag.solving.certificate import certify_solutions
    from nag.solving.certified_paths import prove_paths

    system, reference = subject.system, _reference(subject)

    def measured(seed: int, settings: Settings | str) -> tuple[float, int, Found]:
        with counted() as spent:
            seconds, found = _timed(lambda: solve(system, seed=seed, settings=settings))
        return seconds, spent.number, compared(reference, found.points)

    curves = _curves(measured, seeds, progress)
    curves += _in_arithmetics(system, reference, seeds, progress)
    found = solve(system)
    seconds, certificate = min(
        (_timed(lambda: certify_solutions(found)) for _ in range(3)), key=lambda pair: pair[0]
    )
    path_proof, paths = _timed(lambda: prove_paths(found))
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


def _timed(work: Callable[[], Any]) -> tuple[float, Any]:
    begin = time.process_time()
    result = work()
    return time.process_time() - begin, result


def _components(subject: Subject, seeds: int, progress: Callable[[str], None] | None) -> Chart:
    from nag.witness.certificate import certify_decomposition
    from nag.witness.certified_loops import prove_all

    wanted = sorted(subject.degrees)

    def measured(seed: int, settings: Settings | str) -> tuple[float, int, Found]:
        with counted() as spent:
            seconds, found = _timed(lambda: decompose(subject.system, seed=seed, settings=settings))
        return seconds, spent.number, _agreement(subject.system, found, wanted)

    curves = _curves(measured, seeds, progress)
    found = decompose(subject.system)
    seconds, certificate = _timed(lambda: certify_decomposition(found))
    path_proof, loops = _timed(lambda: prove_all(found))
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
        {},
    )


def _agreement(
    system: PolynomialSystem, found: Decomposition, wanted: Sequence[tuple[int, int, int]]
) -> Found:
    """Components of the right dimension and degree, and errors of the witness points."""
    left = {(d, g): count for d, g, count in wanted}
    right = false = 0
    errors: list[float] = []
    for c in found.components:
        key = c.dimension, c.degree
        if left.get(key, 0) < c.orbit or c.note:
            false += c.orbit
            continue
        left[key] -= c.orbit
        right += c.orbit
        try:
            reference = Reference.of(system, c.points, c.slice.rows)
        except ReferenceError:
            continue
        errors += reference.errors(c.points, np.arange(len(c.points))).tolist()
    largest = max(errors, default=float("nan"))
    middle = float(np.median(errors)) if errors else float("nan")
    return Found(right / max(1, sum(count for _, _, count in wanted)), false, largest, middle)


def _curves(
    measured: Callable[[int, Settings | str], tuple[float, int, Found]],
    seeds: int,
    progress: Callable[[str], None] | None,
) -> list[Curve]:
    # What is loaded, or compiled, on first use is no part of anyone's time.
    for kernel in end_run.KERNELS.values():
        kernel.prepare()
    measured(0, "default")
    curves = []
    for kind, label, several in settings_of_curves():
        if progress is not None:
            progress(label)
        points = [
            _over_seeds(name, lambda seed, s=settings: measured(seed, s), seeds)
            for name, settings in several
        ]
        curves.append(Curve(kind, label, tuple(points)))
    return curves


def _in_arithmetics(
    system: PolynomialSystem,
    reference: Reference,
    seeds: int,
    progress: Callable[[str], None] | None,
) -> Iterator[Curve]:
    """Paths tracked wholly in each arithmetic, at several tolerances."""
    each = [WholePaths.of(system, seed) for seed in range(seeds)]
    for arithmetic in ARITHMETICS:
        if progress is not None:
            progress(arithmetic)
        points = [
            _over_seeds(
                f"{tolerance:.0e}",
                lambda seed, a=arithmetic, t=tolerance: tracked_in(each[seed], reference, a, t),
                seeds,
            )
            for tolerance in WHOLE_TOLERANCES
        ]
        yield Curve("arithmetic", arithmetic, tuple(points))


def _over_seeds(
    name: str, measured: Callable[[int], tuple[float, int, Found]], seeds: int
) -> Point:
    runs = [measured(seed) for seed in range(seeds)]
    seconds = float(np.median([r[0] for r in runs]))
    evaluations = int(np.median([r[1] for r in runs]))
    return Point(name, seconds, evaluations, **asdict(joined([r[2] for r in runs])))


def _peer(program: str, system: PolynomialSystem, reference: Reference) -> Curve:
    answer = peer_points(program, system, PATIENCE)
    if answer.points is None:
        return Curve("peer", program, (), answer.remark)
    found = compared(reference, answer.points)
    return Curve("peer", program, (Point(program, answer.seconds, 0, **asdict(found)),))


def ratios(charts: Sequence[Chart], accuracy: float = 1e-12) -> list[list[str]]:
    """Rows of a table: our time with default settings beside the other programs'.

    Other programs are compared where they find all solutions to the accuracy, as we do.
    """
    lines = [["case", "found", "largest error", "seconds", "program", "found", "error", "ratio"]]
    for chart in charts:
        mine = next(p for c in chart.curves for p in c.points if p.name == "default")
        head = [chart.case, f"{mine.share:.0%}", f"{mine.largest:.1e}", f"{mine.seconds:.4f}"]
        others = [c for c in chart.curves if c.kind == "peer"]
        for curve in others or [Curve("peer", "-", ())]:
            if not curve.points:
                lines.append([*head, curve.label, "-", "-", curve.remark or "-"])
                continue
            (p,) = curve.points
            good = p.share == 1 and p.largest <= accuracy and mine.largest <= accuracy
            ratio = f"{p.seconds / mine.seconds:.1f}"
            told = ratio if good and mine.share == 1 else f"({ratio})"
            error = f"{p.largest:.1e}" if p.share else "-"
            lines.append([*head, p.name, f"{p.share:.0%}", error, told])
    return lines
