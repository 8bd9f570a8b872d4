"""Runs of the atlas: how many answers were right, undecided and wrong, over seeds."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from statistics import median
from typing import Any

import numpy as np

from nag.bench.atlas.asked import ask_method
from nag.bench.atlas.families import FAMILIES, KnobFamily
from nag.bench.timed_runs import timed_runs
from nag.bench.verdicts import Answer, describe_run, verdict
from nag.errors import NagError
from nag.files.json_values import (
    as_count,
    as_document,
    as_double,
    as_integer,
    as_list,
    as_table,
    as_text,
    as_texts,
    entry,
    wrong,
)

FORMAT = "nag-stability"
VERSION = 1
SEEDS, LIMIT = 20, 10.0
COUNTS = ("right", "undecided", "slow", "wrong")


@dataclass(frozen=True)
class AnswerTask:
    """One answer: of a family's system for a value of its knob, and a seed."""

    family: str
    value: Any
    seed: int
    settings: str = "default"


@dataclass(frozen=True)
class Cell:
    """The answers for one value of a family's knob.

    Attributes:
        right, undecided, wrong: numbers of answers; slow: those that did not end within the limit
            of processor time, which are undecided too; an error counts as wrong.
        seconds: median processor time.
        remarks: what was found and what is known, of one answer that was wrong and of one that was
            undecided.
    """

    value: Any
    right: int = 0
    undecided: int = 0
    slow: int = 0
    wrong: int = 0
    seconds: float = 0.0
    remarks: tuple[str, ...] = ()

    @property
    def answers(self) -> int:
        return self.right + self.undecided + self.slow + self.wrong


@dataclass(frozen=True)
class FamilyRow:
    """The answers of one family."""

    name: str
    text: str
    knob: str
    method: str
    cells: tuple[Cell, ...]


@dataclass(frozen=True)
class Atlas:
    """The answers of all families that were run."""

    settings: str
    seeds: int
    limit: float
    rows: tuple[FamilyRow, ...]

    @property
    def wrong(self) -> int:
        return sum(c.wrong for row in self.rows for c in row.cells)

    def cell(self, family: str, value: Any) -> Cell | None:
        """The answers for a family and value, or None."""
        for row in self.rows:
            for cell in row.cells if row.name == family else ():
                if cell.value == value:
                    return cell
        return None


def family_named(name: str) -> KnobFamily:
    """The family of that name."""
    return next(f for f in FAMILIES if f.name == name)


def answer(task: AnswerTask) -> Answer:
    """The answer to one task."""
    family = family_named(task.family)
    problem = family.make(task.value, np.random.default_rng([task.seed, 20]))
    return ask_method(family.method, problem, task.seed, task.settings)


def run_atlas(
    families: Sequence[KnobFamily],
    seeds: int = SEEDS,
    limit: float = LIMIT,
    jobs: int = 1,
    settings: str = "default",
    progress: Callable[[FamilyRow], None] | None = None,
) -> Atlas:
    """Answers for all values of families, each family's when it is done.

    Args:
        seeds: how many, from 0, for families that have no most of their own.
        limit: seconds of processor time for one answer, times the patience of its family.
        jobs: processes.
        progress: called with each family's answers.
    """
    most = {f.name: seeds if f.seeds is None else min(seeds, f.seeds) for f in families}
    tasks = [
        AnswerTask(f.name, v, s, settings)
        for f in families
        for v in f.values
        for s in range(most[f.name])
    ]
    left = {f.name: len(f.values) * most[f.name] for f in families}
    found: dict[str, list[Any]] = {f.name: [] for f in families}
    named = {f.name: f for f in families}
    rows: dict[str, FamilyRow] = {}
    warm = AnswerTask("unity", 2, 0)

    def limit_of(task: AnswerTask) -> float:
        return limit * named[task.family].patience

    for run in timed_runs(answer, tasks, limit=limit_of, jobs=jobs, first=warm):
        name = run.task.family
        found[name].append(run)
        left[name] -= 1
        if not left[name]:
            rows[name] = _row(named[name], found.pop(name))
            if progress is not None:
                progress(rows[name])
    return Atlas(settings, seeds, limit, tuple(rows[f.name] for f in families))


def complete_atlas(atlas: Atlas, rest: Atlas) -> Atlas:
    """The atlas with those of its families that were not run from another one.

    Raises:
        ValueError: if they were made with other settings, seeds or limits.
    """
    for name in ("settings", "seeds", "limit"):
        ours, theirs = getattr(atlas, name), getattr(rest, name)
        if ours != theirs:
            raise NagError(f"{name} there are {theirs}, not {ours}")
    rows = {row.name: row for row in (*rest.rows, *atlas.rows)}
    return replace(atlas, rows=tuple(rows[f.name] for f in FAMILIES if f.name in rows))


def _row(family: KnobFamily, runs: Sequence[Any]) -> FamilyRow:
    cells = [
        _cell(family, value, [r for r in runs if r.task.value == value]) for value in family.values
    ]
    return FamilyRow(family.name, family.text, family.knob, family.method, tuple(cells))


def _cell(family: KnobFamily, value: Any, runs: Sequence[Any]) -> Cell:
    counts = dict.fromkeys(COUNTS, 0)
    remarks: dict[str, str] = {}
    for run in sorted(runs, key=lambda r: r.task.seed):
        problem = family.make(value, np.random.default_rng([run.task.seed, 20]))
        kind = verdict(run, problem.zero_set)
        kind = {"incomplete": "undecided", "error": "wrong"}.get(kind, kind)
        counts[kind] += 1
        if kind in ("undecided", "wrong") and kind not in remarks:
            told = describe_run(run, problem.zero_set)
            remarks[kind] = f"{kind}, seed {run.task.seed}: {told}"
    seconds = round(median(r.seconds for r in runs), 3)
    return Cell(value, **counts, seconds=seconds, remarks=tuple(remarks.values()))


def document(atlas: Atlas) -> dict[str, Any]:
    """The atlas as a JSON object."""
    rows = [asdict(row) for row in atlas.rows]
    head = {"format": FORMAT, "version": VERSION, "settings": atlas.settings}
    return head | {"seeds": atlas.seeds, "limit": atlas.limit, "rows": rows}


def read_atlas(value: Any) -> Atlas:
    """The atlas that a document holds.

    Raises:
        ExportError: if it holds none.
    """
    table = as_document(value, FORMAT, VERSION)
    settings = as_text(entry(table, "settings", "the file"), "settings")
    seeds = as_count(entry(table, "seeds", "the file"), "seeds", 1)
    limit = as_double(entry(table, "limit", "the file"), "limit")
    rows = as_list(entry(table, "rows", "the file"), "rows")
    return Atlas(
        settings, seeds, limit, tuple(_read_row(r, f"rows[{i}]") for i, r in enumerate(rows))
    )


def _read_row(value: Any, place: str) -> FamilyRow:
    table = as_table(value, place)
    texts = [as_text(entry(table, k, place), f"{place}.{k}") for k in ("name", "text", "knob")]
    method = as_text(entry(table, "method", place), f"{place}.method")
    cells = as_list(entry(table, "cells", place), f"{place}.cells")
    if not cells:
        raise wrong(f"{place}.cells", "a list that is not empty")
    read = (_read_cell(c, f"{place}.cells[{i}]") for i, c in enumerate(cells))
    return FamilyRow(*texts, method, tuple(read))


def _read_cell(value: Any, place: str) -> Cell:
    table = as_table(value, place)
    knob = entry(table, "value", place)
    if not isinstance(knob, str):
        knob = as_integer(knob, f"{place}.value")
    counts = [as_count(entry(table, k, place), f"{place}.{k}") for k in COUNTS]
    if not sum(counts):
        raise wrong(place, "the counts of at least one answer")
    seconds = as_double(entry(table, "seconds", place), f"{place}.seconds")
    remarks = as_texts(entry(table, "remarks", place), f"{place}.remarks")
    return Cell(knob, *counts, seconds, tuple(remarks))


def changes(now: Atlas, before: Atlas) -> Iterator[str]:
    """What became better or worse, one line for each value of a knob.

    Shares are compared, as the numbers of seeds may differ; a change is told where it cannot be
    the same shares of fewer seeds.
    """
    for row in now.rows:
        for cell in row.cells:
            old = before.cell(row.name, cell.value)
            if old is None:
                yield f"{row.name} {cell.value}: new"
                continue
            for kind in ("wrong", "right"):
                a, b = getattr(cell, kind) / cell.answers, getattr(old, kind) / old.answers
                if abs(a - b) * min(cell.answers, old.answers) >= 1:
                    better = (a > b) == (kind == "right")
                    yield (
                        f"{row.name} {cell.value}: {'better' if better else 'WORSE'}, "
                        f"{getattr(cell, kind)} of {cell.answers} {kind}, "
                        f"were {getattr(old, kind)} of {old.answers}"
                    )


def table(atlas: Atlas) -> list[list[str]]:
    """Families as rows of cells: counts, and where answers begin to be undecided."""
    lines = [["family", "answers", "right", "undecided", "slow", "wrong", "undecided from"]]
    for row in atlas.rows:
        sums = [sum(getattr(c, k) for c in row.cells) for k in COUNTS]
        first = next((str(c.value) for c in row.cells if c.undecided + c.slow), "-")
        lines.append([row.name, str(sum(sums)), *map(str, sums), first])
    return lines
