"""The packages' imports run one way."""

import ast
import re
from collections.abc import Iterable, Iterator
from functools import cache
from graphlib import TopologicalSorter
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import pytest

NAG = Path(__file__).parents[1] / "nag"
# Each package imports those before it and itself alone.
ORDER = (
    "text",
    "machine_code",
    "algebra",
    "numerics",
    "tracking",
    "solving",
    "witness",
    "interpolation",
    "decomposition",
    "real",
    "mechanism",
    "kinematics",
    "files",
    "symbolic",
    "check",
    "report",
    "page",
    "pictures",
    "bench",
    "cli",
)


class Imported(NamedTuple):
    """A module, or what may be one, and whether it is imported only when a function is called."""

    module: str
    later: bool
    only_for_types: bool


def statements(
    body: Iterable[ast.AST], later: bool = False, types: bool = False
) -> Iterator[tuple[ast.AST, bool, bool]]:
    """They, and those inside of them at any depth: if in functions, and if for types alone."""
    for statement in body:
        yield statement, later, types
        inner = later or isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef)
        for inside in ("body", "orelse", "finalbody", "handlers", "cases"):
            checked = inside == "body" and isinstance(statement, ast.If)
            only = types or (checked and ast.unparse(statement.test) == "TYPE_CHECKING")
            yield from statements(getattr(statement, inside, ()), inner, only)


@cache
def read(file: Path) -> tuple[Imported, ...]:
    """What a file imports."""
    imports = []
    for node, later, types in statements(ast.parse(file.read_text("utf-8")).body):
        if isinstance(node, ast.ImportFrom) and node.module:
            names = (node.module, *(f"{node.module}.{a.name}" for a in node.names))
            imports += [Imported(name, later, types) for name in names]
        elif isinstance(node, ast.Import):
            imports += [Imported(alias.name, later, types) for alias in node.names]
    return tuple(imports)


def test_every_package_has_its_place() -> None:
    packages = {p.name for p in NAG.iterdir() if (p / "__init__.py").exists()}
    assert packages == set(ORDER)


@pytest.mark.parametrize("package", ORDER)
def test_packages_import_only_what_is_before_them(package: str) -> None:
    later = {f"nag.{name}" for name in ORDER[ORDER.index(package) + 1 :]}
    backwards = [
        f"{file.relative_to(NAG)}: {given.module}"
        for file in (NAG / package).rglob("*.py")
        for given in read(file)
        if ".".join(given.module.split(".")[:2]) in later
        and not (file == NAG / "witness/witness.py" and (given.later or given.only_for_types))
    ]
    assert backwards == []


# What data can do stands in files that are loaded when it is asked for; and to see whether an
# equation that deflation leaves has a zero set, other points of it are deflated.
ASKED_FOR = {
    "nag.witness.witness": None,
    "nag.mechanism.graph": {
        "nag.mechanism.lines",
        "nag.mechanism.networkx_graph",
        "nag.mechanism.shown",
    },
    "nag.solving.solutions": {"nag.solving.shown"},
    "nag.real.curve": {"nag.real.shown"},
    "nag.kinematics.motion": {"nag.kinematics.shown"},
    "nag.kinematics.driven_motion": {"nag.kinematics.shown"},
    "nag.numerics.singular_point": {"nag.numerics.local_structure"},
    "nag.numerics.local_dimension": {"nag.numerics.dimension_bounds"},
    "nag.numerics.deflation": {"nag.numerics.curves"},
}


def test_imports_run_one_way_inside_packages_as_well() -> None:
    files = {
        ".".join(("nag", *f.relative_to(NAG).with_suffix("").parts)): f
        for f in NAG.rglob("*.py")
        if f.name != "__init__.py"
    }
    order = TopologicalSorter[str]()
    for module, file in files.items():
        asked = ASKED_FOR.get(module, set())
        for name, later, only_for_types in read(file):
            left_out = only_for_types or (later and (asked is None or name in asked))
            if name in files and not left_out:
                order.add(module, name)
    order.prepare()


# One file a subject, a command or a statement: these say so, and where to begin.
ALIKE = {"", "check", "cli", "report", "symbolic"}


def packages() -> list[str]:
    found = (p.parent.relative_to(NAG).as_posix() for p in NAG.rglob("__init__.py"))
    return sorted({"" if p == "." else p for p in found} - ALIKE)


@pytest.mark.parametrize("package", packages())
def test_every_package_says_where_each_of_its_files_comes_in_the_reading(package: str) -> None:
    text = ast.get_docstring(ast.parse((NAG / package / "__init__.py").read_text("utf-8")))
    named = set(re.findall(r"`([a-z_0-9]+)`", text))
    files = {p.stem for p in (NAG / package).glob("*.py")}
    folders = {p.parent.name for p in (NAG / package).glob("*/__init__.py")}
    assert (files | folders) - {"__init__"} <= named


@pytest.mark.parametrize("package", sorted({*packages(), "check", "cli", "report"} - {"text"}))
def test_every_list_of_files_says_whether_it_is_read_bottom_up(package: str) -> None:
    text = ast.get_docstring(ast.parse((NAG / package / "__init__.py").read_text("utf-8")))
    assert len(re.findall(r"\b(?:bottom-up|top-down)\b", text.lower())) == 1


@pytest.mark.parametrize("file", sorted(NAG.rglob("__init__.py")), ids=lambda f: f.parent.name)
def test_what_docstrings_of_packages_name_inside_of_modules_is_there(file: Path) -> None:
    package = ".".join(("nag", *file.relative_to(NAG).parent.parts))
    text = ast.get_docstring(ast.parse(file.read_text("utf-8")))
    for name in re.findall(r"(?<!`)`([a-z_]+(?:\.\w+)+)`(?!`)", text):
        whole = name if name.startswith("nag.") else f"{package}.{name}"
        home, _, last = whole.rpartition(".")
        assert find_spec(home), name
        assert hasattr(import_module(home), last) or find_spec(whole), name


def test_no_two_classes_share_a_name() -> None:
    places: dict[str, list[str]] = {}
    for file in sorted(NAG.rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.ClassDef):
                places.setdefault(node.name, []).append(file.relative_to(NAG).as_posix())
    assert {name: files for name, files in places.items() if len(files) > 1} == {}
