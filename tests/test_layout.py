"""The packages' imports run one way."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

NAG = Path(__file__).parents[1] / "nag"
# Each package imports those before it and itself alone.
ORDER = (
    "machine_code",
    "algebra",
    "numerics",
    "tracking",
    "solving",
    "witness",
    "decomposition",
    "mechanism",
    "files",
    "report",
    "bench",
    "cli",
)


def imported(file: Path) -> Iterator[str]:
    """Modules of ours that a file imports, anywhere in it."""
    for node in ast.walk(ast.parse(file.read_text("utf-8"))):
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
