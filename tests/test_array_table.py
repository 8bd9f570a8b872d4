"""Tables of arrays: rows chosen, replaced and put one after another, all columns alike."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from nag.numerics.array_table import ArrayTable, map_rows
from nag.solving.isolated_zero import IsolatedZero, IsolatedZeros


@dataclass(frozen=True, eq=False)
class Inner(ArrayTable):
    sizes: np.ndarray


@dataclass(frozen=True, eq=False)
class Outer(ArrayTable):
    points: np.ndarray
    inner: Inner
    some: Mapping[int, str]


def table(first: int, count: int, **some: str) -> Outer:
    numbers = np.arange(first, first + count)
    named = {int(key[1:]): value for key, value in some.items()}
    return Outer(np.stack([numbers, -numbers], axis=1), Inner(10 * numbers), named)


def rows(of: Outer) -> list[tuple[int, int, str]]:
    numbers, sizes = of.points[:, 0].tolist(), of.inner.sizes.tolist()
    return [(a, b, of.some.get(k, "")) for k, (a, b) in enumerate(zip(numbers, sizes, strict=True))]


def test_rows_are_chosen_in_order_with_repeats_and_by_masks() -> None:
    given = table(0, 4, i1="one", i3="three")
    assert rows(given.select_rows(np.array([3, 1, 3]))) == [
        (3, 30, "three"),
        (1, 10, "one"),
        (3, 30, "three"),
    ]
    assert rows(given.select_rows(given.points[:, 0] > 2)) == [(3, 30, "three")]
    assert len(given.select_rows(np.zeros(0, dtype=int))) == 0


def test_rows_that_replace_others_bring_what_they_have_and_leave_the_given_table() -> None:
    given = table(0, 4, i1="one", i3="three")
    found = given.replace_rows(np.array([3, 0]), table(7, 2, i1="new"))
    assert rows(found) == [(8, 80, "new"), (1, 10, "one"), (2, 20, ""), (7, 70, "")]
    assert rows(given)[3] == (3, 30, "three")


def test_rows_of_tables_follow_each_other() -> None:
    whole = Outer.concatenate([table(0, 2, i1="one"), table(5, 1), table(8, 2, i0="eight")])
    assert rows(whole) == [(0, 0, ""), (1, 10, "one"), (5, 50, ""), (8, 80, "eight"), (9, 90, "")]


def test_collected_rows_are_those_put_one_after_another() -> None:
    parts = [plain(range(3), 1), plain(range(2), None), plain(range(4), 0)]
    assert_same(Plain.collect(iter(parts), 9), Plain.concatenate(parts))


@dataclass(frozen=True, eq=False)
class Plain(ArrayTable):
    points: np.ndarray
    some: Mapping[int, str]


def plain(values: range, named: int | None) -> Plain:
    points = np.array([[v, -v] for v in values], dtype=complex)
    return Plain(points, {} if named is None else {named: f"of {len(values)}"})


def assert_same(one: Plain, other: Plain) -> None:
    assert np.array_equal(one.points, other.points) and one.some == other.some


def test_values_of_rows_are_the_same_whatever_is_worked_out_at_once(monkeypatch) -> None:
    points = np.random.default_rng(1).normal(size=(10, 3))
    whole = np.abs(points).max(axis=1) + points[:, 0]
    for rows in (3, 5, 10, 4096):
        monkeypatch.setattr("nag.numerics.array_table.ROWS", rows)
        found = map_rows(lambda some, one: np.abs(some).max(axis=1) + one, points, points[:, 0])
        assert np.array_equal(found, whole)
    assert map_rows(lambda some: some[:, 0], points[:0]).shape == (0,)


def test_records_that_hold_arrays_are_compared_by_value() -> None:
    zeros = [IsolatedZero(np.array([k, 1j]), 1, 0.0, 1e-16, 2.0, 16) for k in range(3)]
    table = IsolatedZeros.of(zeros, 2)
    assert table == IsolatedZeros.of(zeros, 2) == zeros and table != zeros[:2]
    assert table != [*zeros[:2], zeros[0]]
