"""Kernels are compiled once, and again only if what they were made of or kept in has changed."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
import pytest

from nag.machine_code import kernel
from nag.machine_code.kernel import Kernel, compilations
from nag.machine_code.records import Reals
from nag.tracking.numbers.complex_numbers import ARITHMETICS


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
        Kernel(add_up)(Numbers(5, values))
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


def test_by_another_compiler_kernels_are_compiled_anew(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:

    from nag.machine_code import processor

    _run()
    with monkeypatch.context() as patch:
        patch.setattr(kernel, "_compiler_files", lambda: b"other sources")
        assert _run() == ["add_up"]
    with monkeypatch.context() as patch:
        patch.setattr(processor, "compiler", lambda: "another one")
        assert _run() == ["add_up"]
    assert _run() == ["add_up"]
    assert _run() == []


def _sum_of(text: str, name: str = "made") -> Any:
    """A function of a module with this source, which lies in no file of the package."""
    module = ModuleType(name)
    exec(compile(text, name, "exec"), vars(module))
    return vars(module)["total"]


SOURCE = """
from nag.tracking.numbers import error_free
SCALE = 2.0

def part(x):
    return SCALE * x

def total(s):
    s.values[0] = part(s.values[1])
"""
ANOTHER = [("SCALE = 2.0", "SCALE = 3.0"), ("SCALE * x", "x + SCALE"), ("values[1]", "values[2]")]
ALIKE = [
    ("    return", '    """What part is."""\n    return'),
    ("    s.values", '    """The total."""\n    # A comment.\n    s.values'),
    ("def part", "def not_reached(x):\n    return x\n\n\ndef part"),
    ("SCALE = 2.0", "SCALE = 4.0 / 2"),
]


def _origin_of(text: str) -> bytes:
    origin = kernel._Origin()
    origin.add("total", _sum_of(text))
    return origin.digest.digest()


@pytest.mark.parametrize(("old", "new"), ANOTHER)
def test_what_a_kernel_reaches_makes_it_another(old: str, new: str) -> None:
    assert _origin_of(SOURCE.replace(old, new)) != _origin_of(SOURCE)


@pytest.mark.parametrize(("old", "new"), ALIKE)
def test_docstrings_comments_and_what_it_does_not_reach_leave_it_as_it_is(
    old: str, new: str
) -> None:
    assert SOURCE.replace(old, new) != SOURCE
    assert _origin_of(SOURCE.replace(old, new)) == _origin_of(SOURCE)


def test_a_kernel_is_another_in_another_arithmetic() -> None:
    origins = []
    for arithmetic in ARITHMETICS.values():
        origin = kernel._Origin()
        origin.add_constant(arithmetic)
        origins.append(origin.digest.digest())
    assert len(set(origins)) == len(ARITHMETICS)


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
