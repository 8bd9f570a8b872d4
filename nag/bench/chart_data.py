"""Charts of speed against accuracy as JSON, and read back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from nag.bench.sharpening import Sharpened
from nag.bench.work_precision import Chart, Curve, Point
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
            Sharpened(**_fields(p, f"{place}.sharpened", ("steps",), ERRORS))
            for p in as_list(points, f"{place}.sharpened")
        )
        for name, points in sharpened.items()
    }
    counts = ("expected", "seeds", "certified", "proved_paths", "paths")
    numbers = _fields(table, place, counts, ("certification", "path_proof"))
    texts = _texts(table, place, ("case", "what"))
    return Chart(curves=read, sharpened=steps, **numbers, **texts)


def _curve(value: Any, place: str) -> Curve:
    table = as_table(value, place)
    points = as_list(entry(table, "points", place), f"{place}.points")
    read = tuple(_point(p, f"{place}.points[{i}]") for i, p in enumerate(points))
    texts = _texts(table, place, ("kind", "label", "remark"))
    if texts["kind"] == "peer" and len(read) > 1:
        raise wrong(f"{place}.points", "one point at most, of another program")
    return Curve(points=read, **texts)


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
