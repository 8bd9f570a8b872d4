"""The coordinates that parts may have, with what each would cost, as ``nag model`` prints them."""

from __future__ import annotations

from pathlib import Path

import pytest

from nag.cli.command_line import main
from nag.files.cases import read_case

CASES = Path(__file__).parent.parent / "cases"
FOLDERS = ("planar", "spatial", "shaky")
PARTS = [
    path
    for folder in FOLDERS
    for path in sorted((CASES / folder).glob("*.toml"))
    if any(f'kind = "{kind}"' in path.read_text("utf-8") for kind in ("linkage", "framework"))
]


@pytest.mark.parametrize("path", PARTS, ids=lambda p: p.stem)
def test_the_coordinates_that_are_taken_have_the_fewest_paths(path):
    each = read_case(path).assembly.alternatives
    assert each[0].paths == min(c.paths for c in each)


def test_the_coordinates_of_a_framework_are_printed_with_their_numbers(capsys):
    assert main(["model", str(CASES / "planar" / "k33.toml")]) == 0
    lines = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    start = lines.index("coordinates; paths: at most so many, equation by equation")
    # Four equations of degree 3 in z; the others bilinear, or quadratic, in twice as many.
    assert lines[start + 2] == "z 4 4 81 81 120 taken"
    assert lines[start + 3] == "(z, w) 8 8 256 70 510"
    assert lines[start + 4] == "(x, y) 8 8 256 256 510"


def test_the_joints_of_a_table_are_printed_with_their_prime_components(capsys):
    assert main(["model", str(CASES / "spatial" / "goldberg-5r.toml")]) == 0
    lines = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    assert "revolute 1 1 C + 2 SO 2 2 4 8" in lines
