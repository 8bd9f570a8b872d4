"""Every number that decides something has a name, and says above it what it decides."""

from __future__ import annotations

import ast
import re
import sys
from importlib import import_module
from pathlib import Path

import measure_thresholds
import pytest

from nag import thresholds

ROOT = Path(thresholds.__file__).parent
# What is measured, and drawn, for comparisons with other programs, and what is shown of a motion:
# no answer depends on it.
DECIDES_NOTHING = ("bench", "page")
PACKAGES = tuple(
    sorted(
        path.parent.name
        for path in ROOT.glob("*/__init__.py")
        if path.parent.name not in DECIDES_NOTHING
    )
)
# Sizes up to which a number is more than a share, and from which on it is more than a count.
SMALL, LARGE = 0.1, 10.0
# They keep quotients, and logarithms, finite: no value of a computation lies between them and 0, or
# infinity, but for what has lost its digits to the range of doubles.
GUARDS = (1e-300, 1e300)


def files() -> list[Path]:
    return [path for package in PACKAGES for path in sorted((ROOT / package).rglob("*.py"))]


def floats_without_a_reason(file: Path) -> set[str]:
    """Constants of a module that are floats, above which no comment stands.

    A comment holds for what follows it without an empty line.
    """
    module, source = ".".join(file.relative_to(ROOT).with_suffix("").parts), file.read_text()
    lines, found = source.splitlines(), set()
    for node in ast.parse(source).body:
        if not isinstance(node, ast.Assign | ast.AnnAssign):
            continue
        block = node.lineno - 2
        while block >= 0 and lines[block].strip() and not lines[block].startswith("#"):
            block -= 1
        if lines[block].startswith("#"):
            continue
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        for name in [n for target in targets for n in ast.walk(target)]:
            if not isinstance(name, ast.Name) or not name.id.isupper():
                continue
            value = getattr(import_module(f"nag.{module}"), name.id)
            several = value if isinstance(value, tuple) else (value,)
            if any(isinstance(v, float) for v in several):
                found.add(name.id)
    return found


def literals(node: ast.AST) -> set[float]:
    """Sizes of floats that stand in a statement or an expression, those of powers among them.

    Default values of arguments are left out: they are told to whoever calls the function.
    """
    match node:
        case ast.Constant(value=float(value)):
            return {abs(value)}
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            try:
                value = ast.literal_eval(left) ** ast.literal_eval(right)
            except ValueError:
                pass
            else:
                return {abs(value)} if isinstance(value, float) else set()
        case ast.FunctionDef(body=body):
            return set().union(*map(literals, body))
        case ast.Lambda(body=body):
            return literals(body)
    return set().union(*map(literals, ast.iter_child_nodes(node)))


def nameless(source: str) -> set[float]:
    """Floats in functions, and in calls, so small, or so large, that they decide something."""
    tree = ast.parse(source)
    places: list[ast.AST] = [n for n in ast.walk(tree) if isinstance(n, ast.FunctionDef)]
    # What has a name of its own as an argument need not have another one.
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Call):
            places += node.value.args
    found = set().union(*map(literals, places))
    return {v for v in found if v not in GUARDS and (0 < v < SMALL or v > LARGE)}


def test_thresholds_are_listed_as_their_modules_tell_of_them() -> None:
    known = list(thresholds.read_thresholds())
    comments = sum(
        len(re.findall(r"^\s*# Decides\b", f.read_text(), re.MULTILINE)) for f in files()
    )
    assert len({threshold.name for threshold in known}) == len(known) == comments
    assert all(threshold.reason.endswith(".") for threshold in known)
    lines = "\n".join(thresholds.threshold_lines())
    assert "tracking.track.PROOF = 100000 (measured)\n    Smallest singular value" in lines


@pytest.mark.parametrize("file", files(), ids=lambda f: f.relative_to(ROOT).as_posix())
def test_every_named_number_has_a_reason(file: Path) -> None:
    assert floats_without_a_reason(file) == set()


def test_no_number_that_decides_something_is_without_a_name() -> None:
    found = {path.relative_to(ROOT).as_posix(): nameless(path.read_text()) for path in files()}
    assert {name: numbers for name, numbers in found.items() if numbers} == {}


@pytest.mark.parametrize(
    ("body", "found"),
    [
        ("return x < 1e-8", {1e-8}),
        ("return x > -1e3 * y", {1e3}),
        ("return x < max(y, 10**-12)", {1e-12}),
        ("floor = 1e-10\n    return x < floor", {1e-10}),
        ("return lstsq(x, rcond=1e-12)", {1e-12}),
        ("return filter(lambda z: z < 1e-5, x)", {1e-5}),
        ("return x < EPS and x > 0.0 and 0.5 * x < 1 / max(y, 1e-300)", set()),
    ],
)
def test_numbers_without_a_name_are_seen(body: str, found: set[float]) -> None:
    assert nameless(f"def f(x, y=1e-12):\n    {body}\n") == found


@pytest.mark.parametrize(
    ("arguments", "measured"),
    [
        (["--case", "cases/benchmarks/cyclic-5.toml"], ("PROOF", "SLACK", "REAL", "SHARPEST")),
        (
            ["--decompose", "--case", "cases/literature/twisted-cubic.toml"],
            ("ON", "HIT", "GAP", "EVIDENCE"),
        ),
    ],
)
def test_the_script_measures_what_is_compared(
    arguments: list[str],
    measured: tuple[str, ...],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(ROOT.parent)
    monkeypatch.setattr(sys, "argv", ["measure_thresholds.py", *arguments, "--seeds", "0:1"])
    measure_thresholds.main()
    marked = [t.name.rsplit(".", 1)[1] for t in thresholds.read_thresholds() if t.measured]
    lines = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    assert set(measured) <= set(lines) & set(marked)
