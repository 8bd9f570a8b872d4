"""The linkages under cases/planar, spherical, spatial and shaky decompose as is known of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from nag.files.cases import read_case
from nag.files.problem import decomposed
from nag.mechanism.model import model
from nag.report.agreement import Verdict, compare

CASES = Path(__file__).parent.parent / "cases"
FOLDERS = ("planar", "spherical", "spatial", "shaky")
ZOO = sorted(p for folder in FOLDERS for p in (CASES / folder).glob("*.toml"))

# Those that take more than half a second; tests/many_seeds.py decomposes them.
SLOW = {
    "cube-graph",
    "dixon-2-k44",
    "general-7r",
    "roberts-cognates",
    "spherical-pair-6r",
    "universal-shaft",
    "wunderlich-12-bar",
}


@pytest.mark.parametrize(
    "path", [p for p in ZOO if p.stem not in SLOW], ids=lambda p: f"{p.parent.name}/{p.stem}"
)
def test_a_linkage_decomposes_as_is_known(path):
    case = read_case(path)
    made = model(case.mechanism) if case.mechanism else None
    answer = decomposed(case, made)
    agreement = compare(answer, case.truth, made.formulation if made else None)
    assert answer.complete
    assert agreement is not None
    assert agreement.verdict is Verdict.AGREES
    assert not agreement.unlisted


def test_every_linkage_of_the_zoo_names_its_sources():
    assert len(ZOO) >= 50
    assert {p.stem for p in ZOO} >= SLOW
    for path in ZOO:
        truth = read_case(path).truth
        assert truth, path
        assert all(t.source for t in truth), path
