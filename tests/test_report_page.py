"""A report is one file that holds all that was found, and reads back."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from linkages import CASES

import nag
from nag.cli import main


def report_of(case: str, folder: Path) -> str:
    page = folder / "page.html"
    assert main(["report", str(CASES / f"{case}.toml"), "--html", str(page), "--quiet"]) == 0
    return page.read_text("utf-8")


@pytest.fixture(scope="module")
def bennett(tmp_path_factory: pytest.TempPathFactory) -> str:
    return report_of("bennett", tmp_path_factory.mktemp("report"))


def test_a_report_holds_the_answer_as_data(bennett: str, tmp_path: Path) -> None:
    (data,) = re.findall(
        r'<script type="application/json" id="answer">(.*?)</script>', bennett, re.S
    )
    export = tmp_path / "bennett.json"
    export.write_text(data)
    beside = tmp_path / "beside.json"
    words = ["report", str(CASES / "bennett.toml"), "--html", str(tmp_path / "page.html")]
    assert main([*words, "--json", str(beside), "--quiet"]) == 0
    assert beside.read_text() == data
    found = nag.read(export)
    assert [(c.dimension, c.degree) for c in found] == [(1, 2)] and found.complete
    assert json.loads(data)["case"]["file"] == "bennett.toml"


def test_a_report_says_how_it_moves_and_what_it_was_compared_with(bennett: str) -> None:
    for text in (
        "It moves with 1 freedom, though counting predicts -2.",
        "The model, and why this one",
        "agrees with what is known: 1 component of dimension 1, degree 2",
        "<td>irreducible</td>",
        "4762*x_J1*x_J2",
    ):
        assert text in bennett


def test_the_mechanism_moves_inside_a_report_without_a_network(bennett: str) -> None:
    (inside,) = re.findall(r"srcdoc='([^']*)'", bennett)
    page = inside.replace("&#39;", "'").replace("&amp;", "&")
    assert page.startswith("<!DOCTYPE html>") and page.rstrip().endswith("</html>")
    assert not re.search(r"""(?:src|href)=["']?https?:""", bennett)
    assert len(bennett.encode()) < 1_000_000


def test_the_same_seed_writes_the_same_report(bennett: str, tmp_path: Path) -> None:
    assert report_of("bennett", tmp_path) == bennett


def test_where_there_is_no_motion_the_report_says_why(tmp_path: Path) -> None:
    page = report_of("shaky/four-bar-flat", tmp_path)
    assert "No picture" in page and "<iframe" not in page


def test_what_is_no_mechanism_has_no_report(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "page.html"
    assert main(["report", str(CASES / "literature/arcs.toml"), "--html", str(target)]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1 and "reports are of mechanisms" in told and not target.exists()
