"""The packages' imports run one way, and files and functions are of a size to be read."""

import ast
import re
from collections.abc import Iterable, Iterator
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

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
    "mechanism",
    "files",
    "symbolic",
    "check",
    "report",
    "interface",
    "bench",
    "cli",
)


@cache
def statements(file: Path) -> tuple[ast.AST, ...]:
    """The imports and the functions of a file, anywhere in it."""
    wanted = ast.Import | ast.ImportFrom | ast.FunctionDef | ast.AsyncFunctionDef
    nodes = ast.walk(ast.parse(file.read_text("utf-8")))
    return tuple(node for node in nodes if isinstance(node, wanted))


def imported(file: Path) -> Iterator[str]:
    """Modules of ours that a file imports, anywhere in it."""
    for node in statements(file):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def test_every_package_has_its_place() -> None:
    packages = {p.name for p in NAG.iterdir() if (p / "__init__.py").exists()}
    assert packages == set(ORDER)


@pytest.mark.parametrize("package", ORDER)
def test_packages_import_only_what_is_before_them(package: str) -> None:
    later = {f"nag.{name}" for name in ORDER[ORDER.index(package) + 1 :]}
    backwards = [
        f"{file.relative_to(NAG)}: {module}"
        for file in (NAG / package).rglob("*.py")
        for module in imported(file)
        if ".".join(module.split(".")[:2]) in later
    ]
    assert backwards == []


# What data can do stands in files that are loaded when it is asked for; and to see whether an
# equation that deflation leaves has a zero set, other points of it are deflated.
ASKED_FOR = {
    "nag.witness.witness": None,
    "nag.mechanism.graph": {"nag.mechanism.networkx_graph", "nag.mechanism.shown"},
    "nag.solving.solutions": {"nag.solving.shown"},
    "nag.numerics.singular_point": {"nag.numerics.local_structure"},
    "nag.numerics.local_dimension": {"nag.numerics.dimension_bounds"},
    "nag.numerics.deflation": {"nag.numerics.curves"},
}


def at_run_time(nodes: Iterable[ast.AST]) -> Iterator[tuple[ast.AST, bool]]:
    """What is executed, and whether only when a function is called; no imports for types."""
    for node in nodes:
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            continue
        yield node, False
        function = isinstance(node, ast.FunctionDef)
        inner = at_run_time(ast.iter_child_nodes(node))
        yield from ((below, later or function) for below, later in inner)


def test_imports_run_one_way_inside_packages_as_well() -> None:
    files = {
        ".".join(("nag", *f.relative_to(NAG).with_suffix("").parts)): f
        for f in NAG.rglob("*.py")
        if f.name != "__init__.py"
    }
    order = TopologicalSorter[str]()
    for module, file in files.items():
        for node, later in at_run_time(ast.parse(file.read_text("utf-8")).body):
            if isinstance(node, ast.ImportFrom) and node.module:
                names = {node.module} | {f"{node.module}.{a.name}" for a in node.names}
                asked = ASKED_FOR.get(module, set()) if later else set()
                left = set() if asked is None else (names & files.keys()) - asked
                order.add(module, *left)
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


# Lines of a file, lines of a function with its docstring, arguments of a function without self.
MOST_LINES, MOST_FUNCTION_LINES, MOST_ARGUMENTS = 400, 60, 7


def sizes() -> list[tuple[str, int, int]]:
    """Each file and function: what is measured, its size, the most it may be."""
    found = []
    for file in sorted(NAG.rglob("*.py")):
        where, text = file.relative_to(NAG).as_posix(), file.read_text("utf-8")
        found.append((f"{where}: lines", len(text.splitlines()), MOST_LINES))
        for node in statements(file):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                lines = node.end_lineno - node.lineno + 1
                given = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
                arguments = sum(a.arg not in ("self", "cls") for a in given)
                found.append((f"{where}: lines of {node.name}", lines, MOST_FUNCTION_LINES))
                found.append((f"{where}: arguments of {node.name}", arguments, MOST_ARGUMENTS))
    return found


def test_files_and_functions_are_of_a_size_to_be_read() -> None:
    assert [f"{what}: {size}" for what, size, most in sizes() if size > most] == []
