"""The compiled kernels leave behind what their sources do as plain Python."""

from __future__ import annotations

from collections import Counter
from typing import Annotated, Any, NamedTuple

import numpy as np
import pytest
from systems import system

from nag.machine_code import plain
from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import LANES, aligned_zeros, load, scratch, store
from nag.machine_code.processor import processor
from nag.machine_code.records import Reals, Table, Wholes
from nag.solving.solve import solve
from nag.tracking.settings import Settings


def copy(record: Any) -> Any:
    """A record, or that of a table, with arrays of its own; those of doubles are aligned."""
    record = record.record if isinstance(record, Table) else record
    fields = {}
    for name, value in zip(record._fields, record, strict=True):
        if isinstance(value, np.ndarray):
            fields[name] = value.copy()
            if value.dtype == np.float64:
                fields[name] = aligned_zeros(-(-value.size // LANES))[: value.size]
                fields[name][:] = value.reshape(-1)
    return record._replace(**fields)


def same_numbers(found: np.ndarray, expected: np.ndarray) -> bool:
    if "fma" in processor()[2] or processor()[0].startswith(("aarch64", "arm64")):
        return np.array_equal(found, expected, equal_nan=found.dtype != np.int64)
    return np.allclose(found, expected, rtol=1e-9, atol=1e-12, equal_nan=True)


@pytest.fixture
def compared(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often each kernel ran; both ways were compared when it did so first."""
    runs: Counter[str] = Counter()
    compiled = Kernel.__call__

    def call(self: Kernel, *records: Any) -> None:
        runs[self.name] += 1
        if runs[self.name] > 1:
            compiled(self, *records)
            return
        expected = [copy(r) for r in records]
        compiled(self, *records)
        plain.run(self.function, *expected, constants=self.constants)
        for record, other in zip(records, expected, strict=True):
            record = record.record if isinstance(record, Table) else record
            for name in record._fields:
                if isinstance(getattr(record, name), np.ndarray):
                    found = getattr(record, name).reshape(-1)
                    assert same_numbers(found, getattr(other, name).reshape(-1)), name

    monkeypatch.setattr(Kernel, "__call__", call)
    return runs


def test_paths_to_regular_ends_are_the_same(compared: Counter[str]) -> None:
    result = solve(system("x y", "x^2 + y^2 - 5", "x*y - 2"), start="total")
    assert len(result.solutions) == 4
    assert {"track_batch.doubles", "newton_batch.doubles.2_words"} <= set(compared)


def test_paths_whose_corrections_are_rounding_errors_are_the_same(compared: Counter[str]) -> None:
    settings = Settings(newton_end=1e-20)
    result = solve(system("x y", "x^2 + y^2 - 5", "x*y - 2"), start="total", settings=settings)
    assert len(result.solutions) == 4
    assert "track_batch.doubles" in compared


@pytest.mark.slow
def test_paths_to_singular_ends_are_the_same(compared: Counter[str]) -> None:
    # The conics touch at (1, 0).
    result = solve(
        system("x y", "x^2 + y^2 - 1", "2*x^2 + y^2 + 2*x*y - 4*x - 2*y + 2"), start="total"
    )
    assert sorted(s.multiplicity for s in result.solutions) == [1, 1, 2]
    assert "follow_batch.2_words" in compared


class Shaped(NamedTuple):
    point: Annotated[Reals, "2 variables"]
    matrix: Annotated[Reals, "variables variables"]
    accepted: Annotated[Reals, "variables+2"]
    paths: Annotated[Wholes, "1"]


def test_scratch_is_as_large_as_its_fields_say_and_apart() -> None:
    table = scratch(Shaped, variables=3)
    made = table.record
    for k, (field, count) in enumerate(zip(made, (6, 9, 5, 1), strict=True)):
        assert len(field) == LANES * count and not field.any()
        field[-1] = k + 1
    assert [field[-1] for field in made] == [1, 2, 3, 4] and made.matrix[0] == 0.0
    assert made.paths.dtype == np.int64
    assert table.words.tolist() == [field.ctypes.data for field in made]
    with pytest.raises(KeyError, match="variables"):
        scratch(Shaped)


class Vectors(NamedTuple):
    n: int
    reals: Reals
    wholes: Wholes


def vectors(reals: np.ndarray, n: int = 0) -> Vectors:
    return Vectors(n, reals, np.zeros(2, dtype=np.int64))


def doubles(v: Vectors) -> None:
    store(v.reals, v.n, load(v.reals, v.n) + load(v.reals, v.n))


def next_number(v: Vectors) -> None:
    v.wholes[v.n + 1] = v.wholes[v.n]


@pytest.mark.parametrize(
    ("function", "n", "place"),
    [
        (doubles, 1, "no vector 1 of 1"),
        (doubles, -1, "no vector -1 of 1"),
        (next_number, 1, "Vectors.wholes: there is no number 2 of 2"),
        (next_number, -1, "Vectors.wholes: there is no number -1 of 2"),
    ],
)
def test_places_outside_an_array_are_found(function, n: int, place: str) -> None:
    with pytest.raises(IndexError, match=place):
        plain.run(function, vectors(aligned_zeros(1), n))


def test_vectors_that_are_not_aligned_are_found() -> None:
    with pytest.raises(IndexError, match="aligned to 64 bytes"):
        plain.run(doubles, vectors(aligned_zeros(2)[1:9]))


def stores_a_fraction(v: Vectors) -> None:
    v.wholes[0] = v.reals[0]


def test_numbers_of_another_type_are_not_stored() -> None:
    with pytest.raises(TypeError, match=r"Vectors\.wholes: .* is no int64"):
        plain.run(stores_a_fraction, vectors(aligned_zeros(1)))


def test_mixed_cells_are_the_same(compared: Counter[str]) -> None:
    result = solve(system("x y", "x^2*y - 3*x + 1", "x*y^2 + 2*y - 5 + x"), start="polyhedral")
    assert len(result.solutions) == 4
    assert "follow_cells" in compared
