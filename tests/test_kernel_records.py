"""The records that kernels are given: filled by name, and as large as their fields say."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from math import prod
from pathlib import Path
from typing import get_type_hints

import numpy as np
import pytest

import nag
from nag.algebra.polynomial import Polynomial
from nag.machine_code.kernel import Kernel
from nag.machine_code.records import Table
from nag.solving.start import mixed_cells
from nag.tracking import newton_kernel, straight_run
from nag.tracking.compiled import compile_rows
from nag.tracking.ends import end_run, newton_steps, records
from nag.tracking.homotopy import Homotopy, straight_line
from nag.tracking.kernel_arrays import equations

KERNELS: tuple[Kernel, ...] = (
    straight_run.track_lanes,
    newton_kernel.newton_lanes,
    end_run.KERNELS[2],
    newton_steps.KERNELS[2],
    mixed_cells._kernel,
)
RECORDS = frozenset(record.__name__ for kernel in KERNELS for record in kernel._records)


def positional(source: str) -> set[str]:
    """Records of kernels that are made from a list of values."""
    calls = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Call)]
    return {c.func.id for c in calls if isinstance(c.func, ast.Name) and c.args} & RECORDS


def test_kernel_records_are_filled_by_name() -> None:
    assert positional("Batch(starts, 1)") == {"Batch"}
    found = {path: positional(path.read_text()) for path in Path(nag.__file__).parent.rglob("*.py")}
    assert {path.name: names for path, names in found.items() if names} == {}


def number(dimension: str, dimensions: Mapping[str, int]) -> int:
    parts = dimension.split("+")
    return sum(int(part) if part.isdigit() else dimensions[part] for part in parts)


def homotopies() -> list[Homotopy]:
    x, y, z = Polynomial.variables(3)
    cubics = [x * x * y - 2 * y * z + 3, y * y * y + x * z * z - 1, x * y - z * z + x - 2]
    powers = [x * x * x - 1, y * y * y - 1, z * z - 1]
    two, other = compile_rows(cubics[:2]), compile_rows(powers[:2])
    lines = np.array([[0.5, 0.1, 0.7j, -1.0]])
    grouped = compile_rows([x * y - z, y * z + x], groups=[[0], [1, 2]])
    return [
        straight_line(compile_rows(powers), compile_rows(cubics), 0.6 + 0.8j),
        straight_line(other, two, 1j, lines, 2 * lines),
        Homotopy(grouped, np.ones((1, 5))),
        Homotopy(compile_rows([], n=2), np.ones((2, 3))),
    ]


@pytest.mark.parametrize("homotopy", homotopies())
@pytest.mark.parametrize("words", [1, 2, 4])
def test_the_arrays_of_a_homotopy_are_as_large_as_their_fields_say(
    homotopy: Homotopy, words: int
) -> None:
    order, paths = 3, 7
    tables: list[Table] = [equations(homotopy, words), records.equations(homotopy, words, order)]
    if words == 1:
        tables.append(equations(homotopy, weights=np.ones((paths, len(homotopy.factors)))))
    for made in tables:
        record, tape = made.record, homotopy.rows.tape
        sizes = {name: value for name, value in record._asdict().items() if isinstance(value, int)}
        sizes |= {"words": words, "orders": order, "terms": order + 1, "paths": paths}
        sizes |= {"entries": sizes["rows"] * sizes["N"], "inverses": records.MOST_INVERSES}
        sizes |= {"value_terms": len(tape.value_slot), "jacobian_terms": len(tape.jacobian_slot)}
        sizes |= {"jacobian_blocks": len(tape.jacobian_place), "members": 1}
        for name, hint in get_type_hints(type(record), include_extras=True).items():
            if hint is not int:
                shape = hint.__metadata__[0].split()
                size = prod(number(dimension, sizes) for dimension in shape)
                optional = name in record._field_defaults and not getattr(record, name).size
                assert optional or getattr(record, name).size == size, name
