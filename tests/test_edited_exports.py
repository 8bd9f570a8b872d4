"""Exports that were edited by hand: one line says what is wrong with them, or they are answered."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import nag
from nag.cli import main

Document = dict[str, Any]


def scale(key: str, factor: float) -> Callable[[Document], None]:
    """Multiply all numbers of the components' points, radii or slices."""

    def scaled(value: Any) -> Any:
        return [scaled(v) for v in value] if isinstance(value, list) else value * factor

    def edit(document: Document) -> None:
        for component in document["components"]:
            owner = component["slice"] if key in ("A", "b") else component
            owner[key] = scaled(owner[key])

    return edit


def first(key: str, value: Any) -> Callable[[Document], None]:
    """Another first number there."""

    def edit(document: Document) -> None:
        component = document["components"][0]
        row = (component["slice"] if key in ("A", "b") else component)[key]
        while isinstance(row[0], list):
            row = row[0]
        row[0] = value

    return edit


EDITS = {
    "points, huge": scale("points", 1e300),
    "one coordinate, huge": first("points", -1e308),
    "one coordinate, large": first("points", 1e200),
    "no number": first("points", None),
    "radii, huge": first("radii", 1e308),
    "radii, none": first("radii", None),
    "slices, huge": scale("b", 1e300),
    "slices, one huge": first("b", 1e308),
    "slices, subnormal": first("A", 5e-324),
}
COMMANDS = (
    ["certify"],
    ["member", "--at", "x = 3/5, y = 4/5"],
    ["sample", "--count", "2"],
    ["singular"],
    ["intersect", "--components", "1", "2"],
)


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("exports") / "export.json"
    sheets = "(y - x^2)*(y - x^2 - 1/10^12)"
    nag.write_decomposition(nag.decompose([sheets]), path)
    return path.read_text()


@pytest.mark.parametrize("edit", sorted(EDITS))
def test_no_command_warns_of_what_is_in_an_export(
    edit: str, written: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    document = json.loads(written)
    EDITS[edit](document)
    path = tmp_path / "export.json"
    path.write_text(json.dumps(document))
    for command, *options in COMMANDS:
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            status = main([command, str(path), *options, "--quiet"])
        assert len(capsys.readouterr().err.splitlines()) == (1 if status == 2 else 0)


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (first("digits", 10**400), "components[0].digits: must be numbers of at most 64 bits"),
        (
            lambda document: document["equations"][0]["polynomials"].__setitem__(0, "0*x"),
            "equations[0].polynomials[0]: must be a polynomial that is not zero",
        ),
    ],
)
def test_what_no_export_holds_is_refused_with_its_place(
    edit: Callable[[Document], None],
    message: str,
    written: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    document = json.loads(written)
    edit(document)
    path = tmp_path / "export.json"
    path.write_text(json.dumps(document))
    for command, *options in COMMANDS:
        assert main([command, str(path), *options]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert message in line


def test_a_point_whose_gradients_leave_the_range_of_doubles_is_not_proved(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "export.json"
    nag.write_decomposition(nag.decompose(["(x^2 + y^2 - 1)^2", "z*(x^2 + y^2 - 1)"]), path)
    document = json.loads(path.read_text())
    document["components"][0]["points"][0][0] = [0.0, 1e200]
    path.write_text(json.dumps(document))
    assert main(["certify", "--paths", str(path)]) == 1
    assert capsys.readouterr().err == ""
