"""Every number that decides something stands in one table, with its value."""

from __future__ import annotations

import ast
import re
import sys
from importlib import import_module
from pathlib import Path

import measure_thresholds
import pytest

from nag import thresholds

PACKAGES = ("numerics", "tracking", "solving", "witness", "decomposition", "interpolation")
ROOT = Path(thresholds.__file__).parent
ROW = re.compile(r"^([a-z_.]+\.[A-Z_0-9]+)(?: \*)? +(\S+) +\S", re.MULTILINE)
STEERING = re.compile(r"([a-z_.]+\.[a-z_.]+):\s+((?:[A-Z_0-9]+[,;.]\s*)+)")


def rows() -> dict[str, str]:
    return dict(ROW.findall(thresholds.__doc__))


def steering() -> set[str]:
    rest = thresholds.__doc__.split("Other values of these")[1]
    return {
        f"{module}.{name}"
        for module, names in STEERING.findall(rest)
        for name in re.findall(r"[A-Z_0-9]+", names)
    }


def named_floats() -> set[str]:
    found = set()
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            module = ".".join(path.relative_to(ROOT).with_suffix("").parts)
            for node in ast.parse(path.read_text()).body:
                if not isinstance(node, ast.Assign):
                    continue
                (target,) = node.targets
                names = target.elts if isinstance(target, ast.Tuple) else [target]
                for name in names:
                    value = getattr(import_module(f"nag.{module}"), name.id)
                    several = value if isinstance(value, tuple) else (value,)
                    if any(isinstance(v, float) for v in several):
                        found.add(f"{module}.{name.id}")
    return found


@pytest.mark.parametrize(("name", "value"), rows().items())
def test_the_table_holds_the_values_of_the_code(name: str, value: str) -> None:
    module, constant = name.rsplit(".", 1)
    assert getattr(import_module(f"nag.{module}"), constant) == float(value)


def test_every_named_number_is_in_the_table_or_decides_nothing() -> None:
    decides, steers, named = set(rows()), steering(), named_floats()
    assert not decides & steers
    assert named <= decides | steers
    assert steers <= named


@pytest.mark.parametrize(
    ("arguments", "measured"),
    [
        (["--case", "cases/benchmarks/cyclic-5.toml"], ("PROOF", "SAFETY", "REAL")),
        (["--decompose", "--case", "cases/rhombus-chain-2.toml"], ("ON", "HIT", "GAP")),
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
    marked = re.findall(r"^\S+\.([A-Z_]+) \*", thresholds.__doc__, re.MULTILINE)
    lines = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    assert set(measured) <= set(lines) & set(marked)
