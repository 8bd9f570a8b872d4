"""Damaged files of every format are read or refused in one line; `fuzzed_inputs` damages many."""

from __future__ import annotations

import pytest
from fuzzed_inputs import FORMATS, run


@pytest.mark.parametrize("format", FORMATS)
def test_damaged_files_end_with_an_answer_or_one_line(format: str) -> None:
    tally = run(format, 150, seed=1)
    assert tally.counts.keys() == {"read", "refused"}, tally.faults
