"""The way from a command to its table, as `nag.cli` lists it, is the one that is gone."""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import pytest

import nag
from nag.cli import main

NAG = Path(nag.__file__).parent
OPTIMISED = 0x01  # of the code of functions; the body of a class has it not


def listed() -> list[str]:
    text = ast.get_docstring(ast.parse((NAG / "cli" / "__init__.py").read_text("utf-8")))
    return [f"{name}.py" for name in re.findall(r"`([a-z_]+/[a-z_]+)`", text)]


def callers_of_files(arguments: list[str]) -> dict[str, set[str]]:
    """The files that a run enters, in this order, each with those that call its functions."""
    found: dict[str, set[str]] = {}
    files: dict[str, str | None] = {}

    def own(code: CodeType) -> str | None:
        name = code.co_filename
        if name not in files:
            ours = Path(name).is_relative_to(NAG)
            files[name] = Path(name).relative_to(NAG).as_posix() if ours else None
        return files[name]

    def note(frame: FrameType, event: str, _: Any) -> None:
        file = own(frame.f_code) if event == "call" else None
        if file is None or not frame.f_code.co_flags & OPTIMISED:
            return
        caller, above = None, frame.f_back
        while above is not None and caller is None:
            caller, above = own(above.f_code), above.f_back
        if caller == file or caller in found.get(file, ()):
            return
        while above is not None:
            if above.f_code.co_filename.startswith("<frozen importlib"):
                return
            above = above.f_back
        found.setdefault(file, set()).update({caller} - {None})

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        main(arguments)
    except SystemExit as end:
        assert not end.code
    finally:
        sys.setprofile(before)
    return found


def test_the_way_of_a_decomposition_is_one_that_a_reader_can_follow(
    capsys: pytest.CaptureFixture[str],
) -> None:
    case = NAG.parent / "cases" / "bennett.toml"
    callers = callers_of_files(["decompose", str(case), "--quiet"])
    way = listed()
    assert len(way) <= 25
    assert [file for file in callers if file in way] == way
    # Nobody need pass through a file that is not listed: each is called by one before it.
    assert all(callers[file] & set(way[:k]) for k, file in enumerate(way) if k)
    assert "mobility  it moves with 1 freedom" in capsys.readouterr().out
