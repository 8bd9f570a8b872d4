"""Schemas and code say the same: what is written, what is read, and what is refused."""

from __future__ import annotations

import copy
import json
import pkgutil
from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from systems import system

import nag
from nag.cli import main
from nag.files.export import export_of
from nag.files.json_schema import find_problem, schema
from nag.files.json_values import ExportError
from nag.files.solutions_export import solutions_of
from nag.solving.start import ASKED_FOR, KINDS

FOLDER = Path(nag.__file__).parent / "files" / "schema"
CASES = Path(__file__).parents[1] / "cases"
FORMATS = sorted(file.stem.rpartition("-")[::2] for file in FOLDER.glob("*.json"))
SHEETS = "(y - x^2)*(y - x^2 - 1/10^12)"
SYSTEM = """
title = "t"
kind = "system"
variables = ["x", "y", "z"]
equations = ["(x^2 + y^2 - 1)*(z^2 - 1)"]
groups = [["x", "y"], ["z"]]
[[symmetry]]
map = { z = "-z" }
[[point]]
name = "top"
at = { x = 0, y = 1, z = 0 }
"""
ZEROS = system("x y", "(x - 1)^2*(x + 2)*(x^2 + 1)", "y^3 - x - 3", nonzero=("x + 2",))
PENDULUM = """
title = "a pendulum"
kind = "mechanism"
ground = "wall"
joint = [
  { name = "A", type = "revolute", bodies = ["wall", "bob"], point = [0, 0, 0], axis = [0, 0, 1] },
]
"""
FAMILY = """
title = "t"
kind = "system"
variables = ["x", "y"]
parameters = { a = 1 }
equations = ["y^2 - x^3 - a*x^2"]
"""


def places(value: Any, at: tuple = ()) -> Iterator[tuple]:
    """The ways to all keys and entries of a document."""
    items = value.items() if isinstance(value, dict) else enumerate(value)
    for key, item in items:
        yield *at, key
        if isinstance(item, dict | list):
            yield from places(item, (*at, key))


def changed(value: Any, place: tuple, change: Callable[[Any, Any], None]) -> Any:
    other = copy.deepcopy(value)
    inside = other
    for key in place[:-1]:
        inside = inside[key]
    change(inside, place[-1])
    return other


def named(
    node: dict, root: dict, inside: frozenset[int] = frozenset()
) -> Iterator[tuple[int, str]]:
    """The keys that a schema names, each with the schema that it stands in."""
    if id(node) in inside:
        return
    inside |= {id(node)}
    below = list(node.get("oneOf", ()))
    below += [node["items"]] if "items" in node else []
    below += [root["$defs"][node["$ref"].rpartition("/")[2]]] if "$ref" in node else []
    for key, each in node.get("properties", {}).items():
        yield id(node), key
        below.append(each)
    for each in below:
        yield from named(each, root, inside)


def described(value: Any, node: dict, root: dict) -> Iterator[tuple[int, str]]:
    """The keys of a document as `named` has them; one that no schema names with a schema 0.

    A document inside of it is left out.
    """
    if node is not root and isinstance(value, dict) and "format" in value:
        return
    nodes = [node, *node.get("oneOf", ())]
    for each in nodes:
        if "$ref" in each:
            nodes.append(root["$defs"][each["$ref"].rpartition("/")[2]])
    if isinstance(value, dict):
        for key, item in value.items():
            homes = [n for n in nodes if key in n.get("properties", {})]
            for home in homes:
                yield id(home), key
                yield from described(item, home["properties"][key], root)
            open_ = any(isinstance(n.get("additionalProperties"), dict) for n in nodes)
            if not homes and not open_:
                yield 0, key
    elif isinstance(value, list):
        for home in nodes:
            if "items" in home:
                for item in value:
                    yield from described(item, home["items"], root)


@pytest.fixture(scope="module")
def asked(written_and_asked: tuple[Any, set[type]]) -> set[type]:
    """Classes whose documents are in what the commands write."""
    return written_and_asked[1]


@pytest.fixture(scope="module")
def written(written_and_asked: tuple[Any, set[type]]) -> dict[tuple[str, int], list[Any]]:
    """What the commands write, by format and version."""
    return written_and_asked[0]


@pytest.fixture(scope="module")
def written_and_asked(tmp_path_factory: pytest.TempPathFactory) -> tuple[Any, set[type]]:
    asked: set[type] = set()

    def recorded(made: type, document: Callable[..., Any]) -> Callable[..., Any]:
        def tell(self: Any, *given: Any, **named: Any) -> Any:
            asked.add(made)
            return document(self, *given, **named)

        return tell

    with pytest.MonkeyPatch.context() as patch:
        for made in classes_with_documents():
            patch.setattr(made, "document", recorded(made, vars(made)["document"]))
        return write_everything(tmp_path_factory), asked


def write_everything(
    tmp_path_factory: pytest.TempPathFactory,
) -> dict[tuple[str, int], list[Any]]:
    """What the commands write, by format and version."""
    folder = tmp_path_factory.mktemp("written")
    found: dict[tuple[str, int], list[Any]] = {}

    def ask(*words: str, rest: Sequence[str] = ("--quiet", "--threads", "1")) -> str:
        target = folder / f"{len(list(folder.iterdir()))}.json"
        assert main([*words, *rest, "--json", str(target)]) in (0, 1)
        content = json.loads(target.read_text())
        found.setdefault((content["format"], content["version"]), []).append(content)
        return str(target)

    for name, text in (("whole", SYSTEM), ("family", FAMILY), ("pendulum", PENDULUM)):
        (folder / f"{name}.toml").write_text(text)
    whole, family = str(folder / "whole.toml"), str(folder / "family.toml")
    solved = str(folder / "zeros.json")
    nag.write_solutions(nag.solve(ZEROS), solved, "a title", "case.toml")
    found["nag-solutions", 1] = [json.loads(Path(solved).read_text())]
    linkage = str(CASES / "planar-four-bar.toml")
    export = ask("decompose", whole)
    ask("show", whole, rest=["--quiet"])
    ask("show", export, rest=["--quiet"])
    ask("show", solved, rest=["--quiet"])
    ask("eliminate", export, "--component", "1", "--onto", "x,y")
    ask("eliminate", export, "--component", "3")
    ask("member", whole, "top")
    ask("sample", export, "--count", "2")
    ask("intersect", export, "--components", "1", "3")
    ask("singular", export)
    ask("singular", family)
    ask("singular", family, "--free", "a")
    ask("local", whole)
    members = folder / "members.toml"
    members.write_text(FAMILY.replace('"y^2', '"x*y - 1", "y^2') + '[family]\nparameters = ["a"]\n')
    values = folder / "values.csv"
    values.write_text("a\n1\n2\n")
    ask("decompose", str(members), "--sweep", "a=1:3:2")
    points = str(folder / "points.npz")
    ask("family", str(members), "--values", str(values), "--points", points)
    ask("mobility", linkage, "--curves", "--check")
    idle = str(CASES / "robots" / "3-sps-s.toml")
    ask("mobility", str(CASES / "mobility" / "k46.toml"), "--local")
    ask("mobility", idle, "--budget", "0", "--of", "platform")
    ask("mobility", str(folder / "pendulum.toml"))
    ask("mobility", str(CASES / "spatial" / "bennett-rounded.toml"), "--tolerance", "1e-4")
    ask("decompose", str(CASES / "bennett.toml"), "--modes", "all")
    for name in ("3-uu-locked", "3-rps"):
        ask("modes", str(CASES / "robots" / f"{name}.toml"))
    found["nag-operation-modes", 1].append(
        {**found["nag-operation-modes", 1][0], "spurious": SPURIOUS}
    )
    ask("certify", export, "--paths", rest=["--quiet"])
    ask("certify", solved, "--paths", rest=["--quiet"])
    for case in (whole, linkage, str(CASES / "spatial" / "rssr.toml")):
        ask("model", case, rest=[])
    complex_case = folder / "complex.txt"
    complex_case.write_text("imaginary I\nx^2 + I*y\ny - 2\n")
    for command in ("decompose", "solve"):
        ask("certify", ask(command, str(complex_case)), rest=["--quiet"])
    ask("model", str(complex_case), rest=[])
    framework = str(CASES / "planar" / "three-prism.toml")
    for command in ("decompose", "solve"):
        ask("certify", ask(command, framework), rest=["--quiet"])
    ask("model", framework, rest=[])
    ask("check", str(CASES / "four-bar.toml"))
    for name in ("bennett", "planar/four-bar-folding"):
        ask("motion", str(CASES / f"{name}.toml"), "--samples", "12")
    ask("motion", str(CASES / "bennett.toml"), "--samples", "12", "--drive", "J0=30")
    five_bar = str(CASES / "planar" / "five-bar.toml")
    for drive in (["A=0:30:2"], ["A=0", "--drive", "E=20"]):
        ask("motion", five_bar, "--samples", "12", "--drive", *drive)
    ask("motion", five_bar, "--samples", "12", "--pose", "rod1=0,0,0,1,0,0,0")
    equations = "y^2 - x^2*(x - 1)"
    for answer in (nag.decompose(equations), nag.decompose(nag.read_case(CASES / "bennett.toml"))):
        curve = nag.find_real_curve(answer.components[0])
        found.setdefault(("nag-real-curve", 1), []).append(json.loads(json.dumps(curve.document())))
    found["nag-decomposition", 2].append(json.loads(json.dumps(nag.decompose(SHEETS).document())))
    return found


def classes_with_documents() -> list[type]:
    """Those of results; what benchmarks write is read by the benchmarks alone."""
    found = []
    for module in pkgutil.walk_packages(nag.__path__, "nag."):
        if not module.name.startswith(("nag.bench", "nag.cli", "nag.__main__")):
            loaded = vars(import_module(module.name)).values()
            found += [c for c in loaded if isinstance(c, type) and "document" in vars(c)]
    return list(dict.fromkeys(found))


def test_every_document_of_a_result_is_held_to_a_schema(asked: set[type]) -> None:
    classes = classes_with_documents()
    assert len(classes) > 20
    assert [c.__name__ for c in classes if c not in asked] == []


@pytest.mark.parametrize(("name", "version"), FORMATS)
def test_every_key_that_is_written_is_in_the_schema_and_every_key_there_is_written(
    name: str, version: str, written: dict
) -> None:
    published = schema(name, int(version))
    jsonschema.Draft202012Validator.check_schema(published)
    documents = written.get((name, int(version)), [])
    seen = set()
    for each in documents:
        assert find_problem(each, published) is None
        jsonschema.validate(each, published)
        seen |= set(described(each, published, published))
    assert sorted(key for home, key in seen if not home) == []
    if (name, version) != ("nag-decomposition", "1"):
        assert sorted(key for home, key in set(named(published, published)) - seen) == []


# No robot that ships has such components.
SPURIOUS = [{"dimension": 3, "degree": 1, "leg": "U-P-U"}]
READERS = {"nag-decomposition": export_of, "nag-solutions": solutions_of}


def read_documents() -> list[Any]:
    sets = nag.decompose(["(y - x^2)^2", "z^2 - 2"], symmetries=[{"z": "-z"}])
    zeros = nag.solve(["(x - 1)^2*(x + 2)", "y^2 - x - 3"])
    sheets = nag.decompose(SHEETS).document()
    # One of two that are alike.
    del sheets["components"][1:]
    return [json.loads(json.dumps(each)) for each in (sets.document(), sheets, zeros.document())]


DOCUMENTS = read_documents()


@pytest.mark.parametrize("k", range(len(DOCUMENTS)))
def test_what_the_schema_does_not_require_is_not_needed_and_what_it_requires_is_missed(
    k: int,
) -> None:
    given = DOCUMENTS[k]
    published, read = schema(given["format"], given["version"]), READERS[given["format"]]
    keys = [place for place in places(given) if isinstance(place[-1], str)]
    names = [tuple(key for key in place if isinstance(key, str)) for place in keys]
    for place in dict(zip(names, keys, strict=True)).values():
        other = changed(given, place, lambda inside, key: inside.pop(key))
        try:
            read(other)
            refused = ""
        except ExportError as error:
            refused = str(error)
        valid = jsonschema.Draft202012Validator(published).is_valid(other)
        head = place in (("format",), ("version",))
        assert valid or head or f"the key {place[-1]!r} is missing" in refused
        assert head or not refused or not valid or "must be" in refused


@pytest.mark.parametrize("k", range(len(DOCUMENTS)))
def test_what_does_not_fit_the_schema_is_refused_with_its_place(k: int) -> None:
    given, rng = DOCUMENTS[k], np.random.default_rng(k)
    published, read = schema(given["format"], given["version"]), READERS[given["format"]]
    validator = jsonschema.Draft202012Validator(published)
    by_name: dict[tuple, list[tuple]] = {}
    for place in places(given):
        name = (*(p for p in place if isinstance(p, str)), len(place))
        by_name.setdefault(name, []).append(place)
    refused = 0
    for found in by_name.values():
        place = found[rng.integers(len(found))]
        for value in (True, -1, "other", [[1, 2]]):
            other = changed(given, place, lambda inside, key, v=value: inside.__setitem__(key, v))
            valid = validator.is_valid(other)
            assert (find_problem(other, published) is None) == valid, (place, value)
            if valid or place[0] in ("format", "version"):
                continue
            with pytest.raises(ExportError, match=r"must be|is missing") as caught:
                read(other)
            assert str(place[0]) in str(caught.value)
            refused += 1
    assert refused > 100


def test_a_keyword_that_is_not_known_is_no_schema() -> None:
    with pytest.raises(KeyError, match="pattern"):
        find_problem("x", {"type": "string", "pattern": "a"})


def test_every_start_system_is_named_by_the_schema_of_solutions_the_help_and_the_commands():
    named_there = schema("nag-solutions")["properties"]["start"]["enum"]
    assert set(named_there) == {"none", "parameter", *KINDS}
    page = (CASES.parent / "docs" / "commands.md").read_text("utf-8")
    for kind in ASKED_FOR:
        assert f'``"{kind}"``' in nag.solve.__doc__
        assert f"| `--start {kind}` |" in page
