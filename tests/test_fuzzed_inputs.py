"""Damaged files of every format are read or refused in one line; `fuzzed_inputs` damages many."""

from __future__ import annotations

import contextlib
import time
from pathlib import Path

import pytest
from fuzzed_inputs import FORMATS, good_files, run

from nag.errors import NagError
from nag.files.cases import read_case
from nag.files.formats.reading import READERS


@pytest.mark.parametrize("format", FORMATS)
def test_damaged_files_end_with_an_answer_or_one_line(format: str) -> None:
    tally = run(format, 150, seed=1)
    assert tally.counts.keys() == {"read", "refused"}, tally.faults


@pytest.mark.parametrize("format", READERS)
def test_a_long_word_is_read_in_a_time_that_grows_as_it_does(format: str, tmp_path: Path) -> None:
    """A search that begins anew at each letter of it takes minutes."""
    file = tmp_path / "file"
    for text in good_files(format)[:3]:
        middle = text.find("\n", len(text) // 2) + 1
        file.write_text(text[:middle] + "x" * 100_000 + text[middle:])
        started = time.process_time()
        with contextlib.suppress(NagError):
            read_case(file, format=format)
        assert time.process_time() - started < 2
