"""Charts of speed against accuracy: one of each case, and one of all beside other programs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from nag.bench.whole_paths import ARITHMETICS, DIGITS
from nag.bench.work_precision import ACCURATE, Chart, ChartCurve, Point
from nag.pictures.picture_file import COLOURS, DASHES, MARKS, STYLE, save

PEERS = {
    "M2": ("#6a6a6a", "<"),
    "M2, refined": ("#8c8c8c", "p"),
    "phc": ("#adadad", ">"),
    "bertini2": ("#4a4a4a", "*"),
}
OTHER_PEER = ("#8c8c8c", "h")
# Ours, beside other programs.
OURS = "#a50f15"
# Errors below these are drawn there: of points that are doubles, and in more digits.
FLOOR, DEEPEST = 1e-17, 1e-110
# Where legends begin, below the axes.
LEGENDS = 0.175
WORK = "evaluations of the system"
# Names of arithmetics, where what is drawn needs to be said of them.
ENDS_ONLY = "{} (paths: ends only)"


def draw_case(chart: Chart, path: str) -> None:
    """Error and share against time and against work, and arithmetics, of one case.

    Raises:
        OSError: if the file cannot be written.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    ours = [c for c in chart.curves if c.kind != "arithmetic" and c.points]
    whole = [c for c in chart.curves if c.kind == "arithmetic"]
    columns = 3 if whole or chart.sharpened else 2
    with rc_context(STYLE | {"font.size": 8}):
        figure = Figure(figsize=(4.2 * columns, 6.6))
        grid = figure.subplots(2, columns)
        left = 0.17 / columns
        figure.subplots_adjust(left, 0.26, 0.985, 0.92, 0.26, 0.4)
        noun = _number(chart.expected, chart.what)
        seeds = "one seed" if chart.seeds == 1 else f"{chart.seeds} seeds"
        title = f"{chart.case}: {noun}, {seeds}, one thread"
        figure.suptitle(title, fontsize=10, weight="bold", y=0.975)
        handles: dict[str, Any] = {}
        for k, curve in enumerate(ours):
            style = _style(curve, k)
            handles[_label(curve)] = _error(grid[0, 0], curve, style, "seconds")
            _share(grid[0, 1], curve, style, "seconds")
            if curve.kind != "peer" and curve.points[0].evaluations:
                _error(grid[1, 0], curve, style, "evaluations")
                _share(grid[1, 1], curve, style, "evaluations")
        handles |= _certification(grid[0, 0], chart)
        silent = [c.label for c in chart.curves if c.kind == "peer" and not c.points]
        handles |= {f"{label}: no answer": Line2D([], [], linestyle="") for label in silent}
        for row, across, of in ((0, "processor time [s]", "time"), (1, WORK, "work")):
            error, share = grid[row, :2]
            if not error.lines:
                error.axis("off")
                share.axis("off")
                continue
            _axes(error, across, "relative error", f"error against {of}: largest (filled), median")
            _axes(share, across, f"share of {chart.what} [%]", f"found right, against {of}")
            share.set_yscale("linear")
            share.set_ylim(-4, 106)
            # At least so many decades, so that rounding does not look like much.
            low, high = error.get_ylim()
            error.set_ylim(min(low, FLOOR), max(high, 1e-11))
        place = {"frameon": False, "fontsize": 7}
        figure.legend(
            handles.values(), handles.keys(), loc="upper left",
            bbox_to_anchor=(left - 0.01, LEGENDS), ncols=2, **place,
        )  # fmt: skip
        if columns == 3:
            arithmetic = _arithmetics(grid[0, 2], whole) | _sharpening(grid[1, 2], chart)
            figure.legend(
                arithmetic.values(), arithmetic.keys(), loc="upper left",
                bbox_to_anchor=(0.71, LEGENDS), **place,
            )  # fmt: skip
        save(figure, path)


def _number(count: int, what: str) -> str:
    return f"{count} {what.removesuffix('s') if count == 1 else what}"


def _label(curve: ChartCurve) -> str:
    if curve.kind == "settings":
        return "settings " + ", ".join(p.name for p in curve.points)
    return curve.label


def _style(curve: ChartCurve, k: int) -> dict[str, Any]:
    if curve.kind == "peer":
        colour, mark = PEERS.get(curve.label, OTHER_PEER)
        return {"color": colour, "marker": mark, "markersize": 7, "linestyle": ""}
    return _numbered(k) | {"markersize": 4.5}


def _numbered(k: int) -> dict[str, Any]:
    return {"color": COLOURS[k], "marker": MARKS[k], "linestyle": DASHES[k]}


def _error(
    axes: Any, curve: ChartCurve, style: dict[str, Any], across: str, floor: float = FLOOR
) -> Any:
    points = [p for p in curve.points if p.share > 0]
    x = [getattr(p, across) for p in points]
    largest = np.maximum([p.largest for p in points], floor)
    median = np.maximum([p.median for p in points], floor)
    (line,) = axes.plot(x, largest, linewidth=0.9, **style)
    hollow = style | {"markerfacecolor": "none", "linestyle": ""}
    axes.plot(x, median, linewidth=0.9, **hollow)
    return line


def _share(axes: Any, curve: ChartCurve, style: dict[str, Any], across: str) -> None:
    x = [getattr(p, across) for p in curve.points]
    axes.plot(x, [100 * p.share for p in curve.points], linewidth=0.9, **style)


def _axes(axes: Any, across: str, up: str, title: str) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(across)
    axes.set_ylabel(up)
    axes.set_title(title, fontsize=8)
    axes.grid(True, alpha=0.3, linewidth=0.5)
    low, high = axes.get_xlim()
    if high > 10 * low:
        axes.tick_params(axis="x", which="minor", labelbottom=False)
    else:
        # Within a decade the powers of ten would leave the axis without numbers.
        from matplotlib.ticker import LogLocator

        axes.xaxis.set_minor_locator(LogLocator(subs=(2.0, 3.0, 5.0)))
        axes.xaxis.set_minor_formatter(lambda x, _: f"{x:,.0f}" if x >= 1000 else f"{x:.3g}")
        axes.tick_params(axis="x", which="minor", labelsize=6.5, labelrotation=30)


def _certification(axes: Any, chart: Chart) -> dict[str, Any]:
    """The times of proving all solutions, and all paths, as lines across, by their names."""
    noun = "paths" if chart.what == "solutions" else "loops"
    proofs = (
        (
            f"proof of {chart.certified} of {_number(chart.expected, chart.what)}",
            chart.certification,
            (0, (1, 1.5)),
        ),
        (f"proof of {noun}, {chart.proved_paths} of {chart.paths}", chart.path_proof, (0, (5, 2))),
    )
    return {
        name: axes.axvline(seconds, color="#444444", linewidth=1.0, linestyle=dashes, zorder=1)
        for name, seconds, dashes in proofs
        if seconds > 0
    }


def _named(arithmetic: str) -> str:
    return ENDS_ONLY.format(arithmetic) if arithmetic in DIGITS else arithmetic


def _of_arithmetic(name: str) -> dict[str, Any]:
    return _numbered(ARITHMETICS.index(name)) | {"markersize": 4}


def _arithmetics(axes: Any, curves: Sequence[ChartCurve]) -> dict[str, Any]:
    """Errors of paths that were tracked wholly in one arithmetic, at several tolerances."""
    if not curves:
        axes.axis("off")
        return {}
    handles = {
        _named(curve.label): _error(axes, curve, _of_arithmetic(curve.label), "seconds", DEEPEST)
        for curve in curves
    }
    _axes(axes, "processor time of tracking [s]", "relative error",
          "whole paths in one arithmetic, tolerances 1e-1 to 1e-5")  # fmt: skip
    return handles


def _sharpening(axes: Any, chart: Chart) -> dict[str, Any]:
    if not chart.sharpened:
        axes.axis("off")
        return {}
    handles = {}
    for name, points in chart.sharpened.items():
        x = [1e6 * p.seconds for p in points]
        y = [max(p.largest, DEEPEST) for p in points]
        (handles[_named(name)],) = axes.plot(x, y, linewidth=0.9, **_of_arithmetic(name))
    _axes(axes, "processor time for one solution [µs]", "largest relative error",
          "Newton's method step by step, from errors of 1e-4")  # fmt: skip
    return handles


def draw_all(charts: Sequence[Chart], path: str) -> None:
    """Times of all cases beside other programs; filled where all is found to 1e-12.

    Raises:
        OSError: if the file cannot be written.
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    with rc_context(STYLE | {"font.size": 8}):
        # The legend has a line for each mark, however few cases there are.
        figure = Figure(figsize=(7.6, max(2.8, 1.25 + 0.3 * len(charts))))
        axes = figure.subplots()
        figure.subplots_adjust(0.16, 0.62 / figure.get_figheight(), 0.74,
                               1 - 0.3 / figure.get_figheight())  # fmt: skip
        shown: dict[str, Any] = {}
        for i, chart in enumerate(charts):
            for name, style, point in _programs(chart):
                full = point.share == 1 and point.largest <= ACCURATE
                face = style["color"] if full else "none"
                axes.plot(point.seconds, i, linestyle="", markerfacecolor=face, **style)
                shown.setdefault(name, Line2D([], [], linestyle="", **style))
            for name, seconds, mark in (
                ("nag certify", chart.certification, "|"),
                ("nag certify --paths", chart.path_proof, "x"),
            ):
                if seconds > 0:
                    style = {"color": "#444444", "marker": mark, "markersize": 7}
                    axes.plot(seconds, i, linestyle="", **style)
                    shown.setdefault(name, Line2D([], [], linestyle="", **style))
        axes.set_xscale("log")
        axes.set_yticks(range(len(charts)), [chart.case for chart in charts])
        axes.set_ylim(len(charts) - 0.5, -0.5)
        axes.set_xlabel("processor time [s]")
        axes.grid(True, axis="x", alpha=0.3, linewidth=0.5)
        axes.set_title("filled: all found, every one to 1e-12", fontsize=8)
        axes.legend(
            shown.values(), shown.keys(), loc="upper left", bbox_to_anchor=(1.02, 1.0),
            frameon=False, fontsize=8,
        )  # fmt: skip
        save(figure, path)


def _programs(chart: Chart) -> list[tuple[str, dict[str, Any], Point]]:
    found = []
    marks = dict(zip(("fast", "default", "careful"), ("^", "o", "s"), strict=True))
    for curve in chart.curves:
        for point in curve.points:
            if curve.kind == "settings":
                style = {"color": OURS, "marker": marks[point.name], "markersize": 6}
                found.append((f"nag, {point.name}", style, point))
            elif curve.kind == "peer":
                colour, mark = PEERS.get(curve.label, OTHER_PEER)
                found.append(
                    (curve.label, {"color": colour, "marker": mark, "markersize": 6}, point)
                )
    return found
