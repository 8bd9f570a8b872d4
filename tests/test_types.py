"""What type checkers and editors see of the public functions and of what they return."""

from __future__ import annotations

import ast
import inspect
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from test_pickled_results import RESULTS

import nag
from nag.algebra import given

ROOT = Path(nag.__file__).parent.parent
STUB = ast.parse((ROOT / "nag" / "__init__.pyi").read_text("utf-8"))


def programs_of(page: Path) -> list[str]:
    """The programs that a page shows; a tutorial is one."""
    blocks = re.findall(r"```python\n(.*?)```", page.read_text("utf-8"), re.DOTALL)
    return ["\n".join(blocks)] if page.parent.name == "tutorials" else blocks


DTYPES = {
    "ComplexArray": np.complex128,
    "RealArray": np.float64,
    "IntegerArray": np.int64,
    "ByteArray": np.int8,
    "BooleanArray": np.bool_,
}
# A program that is shown need not say the types of its own functions.
UNTYPED = "# mypy: allow-untyped-defs, allow-untyped-calls\n"
PROGRAMS = {
    f"{page.stem}_{k}".replace("-", "_"): program
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
    for k, program in enumerate(programs_of(page))
}
USER = Path(__file__).with_name("typed_user.py")


def test_types_are_named_by_the_modules_that_define_them() -> None:
    for line in STUB.body:
        if isinstance(line, ast.ImportFrom) and line.module and line.module.startswith("nag."):
            for each in line.names:
                value = getattr(import_module(line.module), each.name)
                if isinstance(value, type):
                    assert value.__module__ == line.module, each.name


def test_the_options_of_a_run_are_its_fields() -> None:
    (options,) = [n for n in STUB.body if isinstance(n, ast.ClassDef) and n.name == "RunOptions"]
    named = {n.target.id for n in options.body if isinstance(n, ast.AnnAssign)}  # type: ignore[union-attr]
    assert named == {"run", *(each.name for each in fields(nag.Run))}


def parts_of(value: object) -> Iterator[object]:
    """The objects of ours that a result is made of."""
    if isinstance(value, tuple | list):
        for each in value:
            yield from parts_of(each)
    elif is_dataclass(value) and type(value).__module__.startswith("nag."):
        yield value
        for each in fields(value):
            yield from parts_of(getattr(value, each.name))


@pytest.mark.parametrize("name", sorted(RESULTS))
def test_arrays_of_results_hold_what_their_type_says(name: str) -> None:
    for part in parts_of(RESULTS[name]()):
        for each in fields(part):  # type: ignore[arg-type]
            value, kind = getattr(part, each.name), str(each.type).partition(" ")[0]
            if isinstance(value, np.ndarray) and kind in DTYPES:
                assert value.dtype == DTYPES[kind], (type(part).__name__, each.name, value.dtype)


@pytest.mark.skipif(find_spec("mypy") is None, reason="mypy is not installed")
def test_mypy_finds_no_any_where_a_type_is_known_and_no_error_in_what_pages_show(
    tmp_path: Path,
) -> None:
    shown = [tmp_path / f"{name}.py" for name in PROGRAMS]
    for file, program in zip(shown, PROGRAMS.values(), strict=True):
        file.write_text(f"{UNTYPED}{program}", encoding="utf-8")
    command = [sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent"]
    done = subprocess.run(
        [
            *command,
            "--ignore-missing-imports",
            "--cache-dir",
            str(tmp_path),
            str(USER),
            *map(str, shown),
        ],
        env=os.environ | {"MYPYPATH": str(ROOT)},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    lines = done.stdout.splitlines()
    assert [line for line in lines if ": error:" in line] == []
    revealed = [line for line in lines if "Revealed type" in line]
    assert len(revealed) > 100 and [line for line in revealed if "Any" in line] == []


def test_help_says_by_name_what_is_asked_about() -> None:
    aliases = {n.target.id for n in STUB.body if isinstance(n, ast.AnnAssign)}  # type: ignore[union-attr]
    for name in nag.__all__:
        value = getattr(nag, name)
        if inspect.isfunction(value) and value.__module__.startswith("nag."):
            for each in inspect.signature(value).parameters.values():
                assert each.annotation != "Any", (name, each.name)
    for name in ("Solvable", "Decomposed", "Moving", "Names", "Placements", "Values", "Writable"):
        assert name in aliases and hasattr(given, name)
    assert inspect.signature(nag.solve).parameters["system"].annotation == "Solvable"


def test_signatures_say_the_type_of_every_argument() -> None:
    for name in nag.__all__:
        value = getattr(nag, name)
        if inspect.isfunction(value):
            for each in inspect.signature(value).parameters.values():
                assert each.annotation is not inspect.Parameter.empty, (name, each.name)
                assert isinstance(value.__annotations__[each.name], str), (name, each.name)
