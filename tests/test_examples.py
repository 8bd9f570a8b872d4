"""Every public name explains itself, and the examples in the docstrings do what they say."""

from __future__ import annotations

import doctest
import inspect
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import nag
import nag.decomposition

ROOT = Path(__file__).parent.parent
PUBLIC = sorted(set(nag.__all__) - {"__version__"})
FUNCTIONS = [name for name in PUBLIC if inspect.isfunction(getattr(nag, name))]


@pytest.mark.parametrize("module", [nag, nag.decomposition], ids=lambda module: module.__name__)
def test_examples_of_the_packages_do_what_they_say(module: ModuleType) -> None:
    (test,) = [t for t in doctest.DocTestFinder().find(module) if t.name == module.__name__]
    written: list[str] = []
    doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test, out=written.append)
    assert test.examples
    assert not written, "".join(written)


def docstrings(name: str) -> Iterator[doctest.DocTest]:
    value: Any = getattr(nag, name)
    finder = doctest.DocTestFinder(recurse=True, exclude_empty=True)
    # The module is not the one that the name is looked up in.
    yield from finder.find(value, f"nag.{name}", module=False, globs={})


@pytest.mark.parametrize("name", PUBLIC)
def test_examples_do_what_they_say(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    written: list[str] = []
    for test in docstrings(name):
        runner.run(test, out=written.append)
    assert not written, "".join(written)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_public_function_has_an_example_and_says_what_it_raises(name: str) -> None:
    function = getattr(nag, name)
    text = inspect.getdoc(function) or ""
    examples = [e for test in docstrings(name) for e in test.examples]
    assert examples, "no example"
    assert "Raises:" in text or name in ("gruebler_kutzbach",)
