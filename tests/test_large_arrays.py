"""Arrays in files are arrays like all others."""

import mmap
import os
import pickle
import tracemalloc

import numpy as np
import pytest

import nag
from nag.numerics import large_arrays
from nag.numerics.array_table import copy_rows, join_columns, map_rows, take_rows
from nag.numerics.coincidence import conjugates_present
from nag.numerics.large_arrays import empty_array, full_array, leave_to_file
from nag.solving.certificate import certify_solutions

IN_FILES = pytest.mark.skipif(
    not hasattr(os, "posix_fallocate"), reason="the system promises no room in files"
)


@pytest.fixture
def all_in_files(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every array that is not empty lives in a file."""
    monkeypatch.setattr(large_arrays, "LARGE", 1)


def _owner(array: np.ndarray) -> object:
    owner: object = array
    while isinstance(owner, np.ndarray | memoryview):
        owner = owner.base if isinstance(owner, np.ndarray) else owner.obj
    return owner


@IN_FILES
def test_only_large_arrays_are_in_files() -> None:
    assert _owner(empty_array((10, 3), complex)) is None
    large = empty_array((large_arrays.LARGE // 16, 1), complex)
    assert isinstance(_owner(large), mmap.mmap)


@IN_FILES
@pytest.mark.usefixtures("all_in_files")
def test_what_is_left_to_the_file_is_read_again() -> None:
    rows = np.random.default_rng(1).standard_normal((5000, 3))
    array = empty_array(rows.shape, float)
    assert isinstance(_owner(array), mmap.mmap)
    array[:] = rows
    leave_to_file(array, rows)
    assert np.array_equal(array, rows)
    assert np.array_equal(pickle.loads(pickle.dumps(array)), rows)
    assert (full_array((7, 2), np.inf) == np.inf).all()


@pytest.mark.usefixtures("all_in_files")
def test_rows_are_those_of_arrays_in_memory() -> None:
    rng = np.random.default_rng(2)
    rows = rng.standard_normal((10_001, 3)) + 1j * rng.standard_normal((10_001, 3))
    chosen = rng.permutation(10_001)[:9000]
    assert np.array_equal(map_rows(np.abs, rows), np.abs(rows))
    assert np.array_equal(take_rows(rows, chosen), rows[chosen])
    assert np.array_equal(copy_rows(rows), rows)
    assert np.array_equal(join_columns([rows, rows[:5]]), np.concatenate([rows, rows[:5]]))


@pytest.mark.usefixtures("all_in_files")
def test_without_room_on_the_disk_arrays_are_in_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "posix_fallocate", full, raising=False)
    assert _owner(empty_array((100, 3), complex)) is None


def test_solutions_in_files_are_those_in_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    equations = ["x^3 + x*y - 2", "y^3 - x*y + 1", "z^2 - x - y"]
    expected = nag.solve(equations, seed=3)
    proved = certify_solutions(expected)
    monkeypatch.setattr(large_arrays, "LARGE", 1)
    found = nag.solve(equations, seed=3)
    assert found == expected
    again = certify_solutions(found)
    assert again == proved
    assert again.all_proved


def test_conjugates_of_many_points_are_compared_some_at_a_time() -> None:
    rng = np.random.default_rng(4)
    half = rng.standard_normal((10_000, 17)) + 1j * rng.standard_normal((10_000, 17))
    points = np.concatenate([half, half.conj()[rng.permutation(len(half))]])
    ones = np.ones(len(points), dtype=np.int64)
    given = points, np.full(len(points), 1e-15), ones, np.zeros(len(points), dtype=bool)
    tracemalloc.start()
    try:
        assert conjugates_present(*given)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 5e6
    assert not conjugates_present(*(column[1:] for column in given))
