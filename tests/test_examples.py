"""Every public name explains itself, and the examples in the docstrings do what they say."""

from __future__ import annotations

import doctest
import inspect
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import nag
import nag.decomposition

ROOT = Path(__file__).parent.parent
PUBLIC = [f"nag.{name}" for name in sorted(set(nag.__all__) - {"__version__"})]
PUBLIC += [f"nag.decomposition.{name}" for name in nag.decomposition.__all__]


def named(name: str) -> Any:
    """The public thing of a name."""
    package, _, last = name.rpartition(".")
    return getattr(import_module(package), last)


FUNCTIONS = [name for name in PUBLIC if inspect.isfunction(named(name))]


@pytest.mark.parametrize("module", [nag, nag.decomposition], ids=lambda module: module.__name__)
def test_examples_of_the_packages_do_what_they_say(module: ModuleType) -> None:
    (test,) = [t for t in doctest.DocTestFinder().find(module) if t.name == module.__name__]
    written: list[str] = []
    doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test, out=written.append)
    assert test.examples
    assert not written, "".join(written)


def docstrings(name: str) -> Iterator[doctest.DocTest]:
    value = named(name)
    finder = doctest.DocTestFinder(recurse=True, exclude_empty=True)
    # The module is not the one that the name is looked up in.
    yield from finder.find(value, name, module=False, globs={})


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
    text = inspect.getdoc(named(name)) or ""
    examples = [e for test in docstrings(name) for e in test.examples]
    assert examples, "no example"
    assert "Raises:" in text


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if "decomposition." in name])
def test_every_argument_is_explained(name: str) -> None:
    text = inspect.getdoc(named(name)) or ""
    explained = re.search(r"^Args:\n(.*?)\n\n", text, re.MULTILINE | re.DOTALL)
    assert explained
    heads = re.findall(r"^    (\w+(?:, \w+)*): ", explained[1], re.MULTILINE)
    given = [each for head in heads for each in head.split(", ")]
    assert sorted(given) == sorted(inspect.signature(named(name)).parameters)
