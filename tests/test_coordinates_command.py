"""``nag decompose --coordinates`` and ``--modes``: what they print, write and refuse."""

import json
import re

import jsonschema
import pytest
from linkages import CASES

from nag.cli import main
from nag.files.export import read_decomposition
from nag.files.json_schema import schema

BENNETT = str(CASES / "bennett.toml")


def test_coordinates_are_those_that_were_asked_for(tmp_path, capsys):
    """Bennett's curve: of degree 2 in half-angles, two of degree 8 in Euler parameters."""
    found = {}
    for coordinates in ("joint", "euler"):
        file = tmp_path / f"{coordinates}.json"
        options = ["--coordinates", coordinates, "--json", str(file), "--quiet"]
        assert main(["decompose", BENNETT, *options]) == 0
        text = capsys.readouterr().out
        assert re.search(r"^known +agrees with what is known", text, re.MULTILINE)
        components = read_decomposition(str(file)).components
        found[coordinates] = [(c.dimension, c.degree, c.orbit) for c in components]
    assert found == {"joint": [(1, 2, 1)], "euler": [(1, 8, 2)]}


def test_all_modes_are_counted_and_exported(tmp_path, capsys):
    file = tmp_path / "modes.json"
    assert main(["decompose", BENNETT, "--modes", "all", "--json", str(file), "--quiet"]) == 0
    text = capsys.readouterr().out
    assert "16 combinations of the assembly modes of 4 joints, in 2 classes" in text
    assert "in all modes together 16 components of dimension 1, degree 8" in text
    content = json.loads(file.read_text("utf-8"))
    jsonschema.validate(content, schema("nag-modes"))
    jsonschema.Draft202012Validator.check_schema(schema("nag-modes"))
    assert [len(c["modes"]) for c in content["classes"]] == [8, 8]
    degrees = [c["degree"] for c in content["classes"][0]["decomposition"]["components"]]
    assert (degrees, content["classes"][1]["decomposition"]["components"]) == ([8], [])


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["four-bar.toml", "--modes", "all"], "--modes is for assembled mechanisms"),
        (["four-bar.toml", "--coordinates", "euler"], "--coordinates is for assembled mechanisms"),
        (
            ["spatial/sarrus.toml", "--modes", "all"],
            'is of kind "dh", whose parts are not assembled',
        ),
        (["bennett.toml", "--modes", "all", "--expand"], "--expand: is not for --modes all"),
        (
            ["bennett.toml", "--modes", "all", "--method", "sampling"],
            "--method sampling: is not for --modes all",
        ),
        (
            ["bennett.toml", "--formulation", "E", "--coordinates", "joint"],
            "use --formulation H",
        ),
    ],
)
def test_what_does_not_fit_together_is_refused_with_one_line(arguments, text, capsys):
    case, *options = arguments
    assert main(["decompose", str(CASES / case), *options]) == 2
    error = capsys.readouterr().err
    assert text in error
    assert error.count("\n") == 1


def test_the_model_lists_every_formulation_with_its_numbers(capsys):
    assert main(["model", BENNETT]) == 0
    text = capsys.readouterr().out
    rows = {
        line.split()[0]: line.split()[1:] for line in text.splitlines() if line.startswith("  ")
    }
    assert rows["unreduced"][:2] == ["21", "23"]
    assert rows["H"] == ["2", "1", "2", "2", "2", "taken"]
    assert rows["E"][:2] == ["8", "10"]
    assert "S: no body has two spherical joints and no other joint" in text
    assert re.search(r"rank +the 4 closure equations have rank 1 in 2 unknowns", text)
    assert rows["revolute"] == ["1", "1", "C", "+", "2", "SO", "2", "2", "4", "8"]
