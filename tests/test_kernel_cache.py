"""Kernels are compiled once, and again only if what they were made of or kept in has changed."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from nag.machine_code import kernel
from nag.machine_code.kernel import Kernel, compilations
from nag.machine_code.records import Reals


class Numbers(NamedTuple):
    n: int
    values: Reals


def add_up(s: Numbers) -> None:
    total = 0.0
    for k in range(s.n):
        total += s.values[k]
    s.values[0] = total


def _run() -> list[str]:
    """Names of what a fresh kernel, which must give the right answer, had to compile."""
    compiled: list[str] = []
    values = np.arange(5.0)
    with compilations(compiled.append):
        Kernel(add_up, "tracking")(Numbers(5, values))
    assert values[0] == 10.0
    return compiled


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("NAG_CACHE_DIR", str(tmp_path))
    return tmp_path


def test_a_kernel_is_compiled_once(cache: Path) -> None:
    assert _run() == ["add_up"]
    assert len(list(cache.iterdir())) == 1
    assert _run() == []


@pytest.mark.parametrize("length", [0, 10, 64, 500])
def test_a_file_that_was_cut_off_is_replaced(cache: Path, length: int) -> None:
    _run()
    (file,) = cache.iterdir()
    file.write_bytes(file.read_bytes()[:length])
    assert _run() == ["add_up"]
    assert _run() == []


def test_a_file_with_one_wrong_byte_is_replaced(cache: Path) -> None:
    _run()
    (file,) = cache.iterdir()
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)
    assert _run() == ["add_up"]
    assert _run() == []


def test_changed_sources_or_another_compiler_are_compiled_anew(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:

    from nag.machine_code import processor

    _run()
    with monkeypatch.context() as patch:
        patch.setattr(kernel, "_sources", lambda package: b"other sources")
        assert _run() == ["add_up"]
    with monkeypatch.context() as patch:
        patch.setattr(processor, "compiler", lambda: "another one")
        assert _run() == ["add_up"]
    assert _run() == ["add_up"]
    assert _run() == []


def test_object_code_of_another_processor_is_kept_beside(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from nag.machine_code import processor

    _run()
    triple, name, features = processor.processor()
    with monkeypatch.context() as patch:
        patch.setattr(processor, "processor", lambda: (triple, name, features + ",-avx"))
        assert _run() == ["add_up"]
    assert _run() == []


def test_without_a_place_to_keep_them_kernels_run_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "file"
    file.write_text("no folder")
    monkeypatch.setenv("NAG_CACHE_DIR", str(file))
    assert _run() == ["add_up"]


COUNT = """
import sys
import numpy as np
from nag.solving.start.mixed_cells import mixed_cells
conic, hyperbola = np.array([[2, 0], [0, 2], [0, 0]]), np.array([[1, 1], [0, 0]])
print(mixed_cells([conic, hyperbola], np.random.default_rng(0)).mixed_volume)
print(*sorted({"numba", "scipy", "nag.machine_code.functions"} & set(sys.modules)))
"""


def test_a_process_that_finds_its_kernels_loads_no_compiler(cache: Path) -> None:
    outputs = []
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "-c", COUNT],
            env=dict(os.environ),
            capture_output=True,
            text=True,
            timeout=120,
            check=True,
        )
        outputs.append(done.stdout.splitlines())
    assert outputs == [
        ["4", "nag.machine_code.functions"],
        ["4", ""],
    ]
