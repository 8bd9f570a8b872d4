"""What a work-precision diagram consists of: points, each of one setting, and curves of them.

Charts of speed against accuracy are kept as JSON, and read back.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.bench.reference import Found, Reference, join_found
from nag.bench.sharpening import SharpeningCost
from nag.bench.whole_paths import ARITHMETICS, WHOLE_TOLERANCES, WholePaths, tracked_in
from nag.files.json_values import (
    as_count,
    as_document,
    as_double,
    as_list,
    as_table,
    as_text,
    entry,
    wrong,
)
from nag.tracking.ends import end_run
from nag.tracking.settings import NAMED, Settings

ORDERS = (3, 4, 6, 8)
TOLERANCES = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
DIGITS = (16, 32, 64)
# Seconds for one answer of another program.
PATIENCE = 120.0
# Errors to which times are compared.
ACCURATE = 1e-12
Progress = Callable[[str], None]


@dataclass(frozen=True)
class MeasuredCase:
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
        share: of the solutions, or components, that are right, mean over seeds; in arithmetics of
            the components' witness points.
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
class ChartCurve:
    """Points that belong together.

    Attributes:
        kind: ``"settings"``, ``"order"``, ``"digits"``, ``"arithmetic"`` (see
            `nag.bench.whole_paths`) or ``"peer"``.
        remark: why there are no points; or in which form a program was given the equations.
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
    curves: tuple[ChartCurve, ...]
    certified: int
    certification: float
    path_proof: float
    proved_paths: int
    paths: int
    sharpened: dict[str, tuple[SharpeningCost, ...]]


def time_call(work: Callable[[], Any]) -> tuple[float, Any]:
    """Processor seconds of a call, and what it returns."""
    begin = time.process_time()
    result = work()
    return time.process_time() - begin, result


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


def own_curves(
    measured: Callable[[int, Settings | str], tuple[float, int, Found]],
    seeds: int,
    progress: Progress | None,
) -> list[ChartCurve]:
    """Those of `settings_of_curves`: seconds, evaluations and what was found are ``measured``."""
    # What is loaded, or compiled, on first use is no part of anyone's time.
    for kernel in end_run.KERNELS.values():
        kernel.prepare()
    measured(0, "default")
    curves = []
    for kind, label, several in settings_of_curves():
        if progress is not None:
            progress(label)
        points = [
            over_seeds(name, lambda seed, s=settings: measured(seed, s), seeds)
            for name, settings in several
        ]
        curves.append(ChartCurve(kind, label, tuple(points)))
    return curves


def in_arithmetics(
    system: PolynomialSystem,
    reference: Reference,
    seeds: int,
    progress: Progress | None,
) -> Iterator[ChartCurve]:
    """Paths tracked wholly in each arithmetic, at several tolerances."""
    each = [WholePaths.of(system, seed) for seed in range(seeds)]
    for arithmetic in ARITHMETICS:
        if progress is not None:
            progress(arithmetic)
        points = [
            over_seeds(
                f"{tolerance:.0e}",
                lambda seed, a=arithmetic, t=tolerance: tracked_in(each[seed], reference, a, t),
                seeds,
            )
            for tolerance in WHOLE_TOLERANCES
        ]
        yield ChartCurve("arithmetic", arithmetic, tuple(points))


def best_form(curves: Iterable[ChartCurve]) -> ChartCurve:
    """Of curves of another program, for the same equations written differently, the best.

    That which finds the most, then to `ACCURATE`, then the fastest.
    """

    def quality(curve: ChartCurve) -> tuple[float, bool, float]:
        if not curve.points:
            return -1.0, False, 0.0
        (point,) = curve.points
        return point.share, point.largest <= ACCURATE, -point.seconds

    return max(curves, key=quality)


def over_seeds(name: str, measured: Callable[[int], tuple[float, int, Found]], seeds: int) -> Point:
    """One point of a curve."""
    runs = [measured(seed) for seed in range(seeds)]
    seconds = float(np.median([r[0] for r in runs]))
    evaluations = int(np.median([r[1] for r in runs]))
    return Point(name, seconds, evaluations, **asdict(join_found([r[2] for r in runs])))


FORMAT = "nag-speed-accuracy"
VERSION = 2
ERRORS = ("seconds", "largest", "median")


def document(charts: Sequence[Chart]) -> dict[str, Any]:
    """Charts as a JSON object."""
    return {"format": FORMAT, "version": VERSION, "charts": [_plain(asdict(c)) for c in charts]}


def _plain(value: Any) -> Any:
    """Numbers to four digits, those that are not finite as None."""
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(v) for v in value]
    if isinstance(value, float):
        return float(f"{value:.4g}") if np.isfinite(value) else None
    return value


def read_charts(value: Any) -> list[Chart]:
    """The charts that a document holds.

    Raises:
        ExportError: if it holds none.
    """
    table = as_document(value, FORMAT, VERSION)
    charts = as_list(entry(table, "charts", "the file"), "charts")
    if not charts:
        raise wrong("charts", "a list that is not empty")
    return [_chart(chart, f"charts[{i}]") for i, chart in enumerate(charts)]


def _chart(value: Any, place: str) -> Chart:
    table = as_table(value, place)
    curves = as_list(entry(table, "curves", place), f"{place}.curves")
    read = tuple(_curve(c, f"{place}.curves[{i}]") for i, c in enumerate(curves))
    if not any(p.name == "default" for c in read for p in c.points):
        raise wrong(f"{place}.curves", 'a list of curves, one with a point named "default"')
    sharpened = as_table(entry(table, "sharpened", place), f"{place}.sharpened")
    steps = {
        name: tuple(
            SharpeningCost(**_fields(p, f"{place}.sharpened", ("steps",), ERRORS))
            for p in as_list(points, f"{place}.sharpened")
        )
        for name, points in sharpened.items()
    }
    counts = ("expected", "seeds", "certified", "proved_paths", "paths")
    numbers = _fields(table, place, counts, ("certification", "path_proof"))
    texts = _texts(table, place, ("case", "what"))
    return Chart(curves=read, sharpened=steps, **numbers, **texts)


def _curve(value: Any, place: str) -> ChartCurve:
    table = as_table(value, place)
    points = as_list(entry(table, "points", place), f"{place}.points")
    read = tuple(_point(p, f"{place}.points[{i}]") for i, p in enumerate(points))
    texts = _texts(table, place, ("kind", "label", "remark"))
    if texts["kind"] == "peer" and len(read) > 1:
        raise wrong(f"{place}.points", "one point at most, of another program")
    return ChartCurve(points=read, **texts)


def _point(value: Any, place: str) -> Point:
    numbers = _fields(value, place, ("evaluations", "false"), ("share", *ERRORS))
    if not numbers["seconds"] > 0:
        raise wrong(f"{place}.seconds", "more than 0")
    return Point(**_texts(as_table(value, place), place, ("name",)), **numbers)


def _texts(table: dict[str, Any], place: str, keys: Sequence[str]) -> dict[str, str]:
    return {k: as_text(entry(table, k, place), f"{place}.{k}") for k in keys}


def _fields(
    value: Any, place: str, counts: Sequence[str], doubles: Sequence[str]
) -> dict[str, Any]:
    table = as_table(value, place)
    found = {k: as_count(entry(table, k, place), f"{place}.{k}") for k in counts}
    return found | {k: as_double(entry(table, k, place), f"{place}.{k}") for k in doubles}
