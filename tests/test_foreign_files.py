"""Files of PHCpack's and Bertini's kind: solved, and their answers are those known."""

from __future__ import annotations

from pathlib import Path

import pytest
from foreign_files import FOREIGN, ForeignFile

import nag
from nag.files.cases import read_case

ALL = {
    f"{format}: {name}": (format, file)
    for format, files in FOREIGN.items()
    for name, file in files.items()
}


@pytest.mark.parametrize("name", ALL)
def test_a_file_is_solved_as_is_known(name: str, tmp_path: Path) -> None:
    format, file = ALL[name]
    path = tmp_path / "input"
    path.write_text(file.text)
    case = read_case(path)
    assert case == read_case(path, format=format)
    if file.components:
        found = nag.decompose(case)
        assert found.complete
        kinds = [(c.dimension, c.degree) for c in found.components]
        assert sorted(kinds, reverse=True) == sorted(file.components, reverse=True)
        return
    result = nag.solve(case)
    assert result.complete
    if file.count is not None:
        assert sum(s.multiplicity for s in result.solutions) == file.count
        return
    check_points(result, file)


def check_points(result: nag.SolveResult, file: ForeignFile) -> None:
    """Each solution is one of those listed, and each of these is one."""
    left = dict(file.solutions)
    assert len(result.solutions) == len(left) == len(file.solutions)
    for solution in result.solutions:
        # The imaginary unit is the last variable where a system has it.
        found = solution.point[: result.system.n - result.system.imaginary]
        near = [p for p in left if max(abs(found - p)) < 1e-9]
        assert len(near) == 1
        assert left.pop(near[0]) == solution.multiplicity
