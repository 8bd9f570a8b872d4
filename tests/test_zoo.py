"""The linkages under cases/planar, spherical, spatial and shaky decompose as is known of them."""

from __future__ import annotations

import pytest
from linkages import CASES
from solved import answer, shipped

import nag
from nag.mechanism.problem import problem_of
from nag.report.agreement import AgreementKind, compare

FOLDERS = ("planar", "spherical", "spatial", "shaky")
ZOO = sorted(
    f"{folder}/{path.stem}" for folder in FOLDERS for path in (CASES / folder).glob("*.toml")
)

# Those that take more than half a second; tests/many_seeds.py decomposes them.
SLOW = {
    "planar/cube-graph",
    "planar/dixon-2-k44",
    "planar/kinematotropic-square",
    "planar/roberts-cognates",
    "planar/wunderlich-12-bar",
    "spatial/general-7r",
    "spatial/kinematotropic-7r",
    "spatial/spherical-pair-6r",
    "spatial/universal-shaft",
    "spatial/wren-5",
    "spatial/wren-6",
}


@pytest.mark.parametrize("name", sorted(set(ZOO) - SLOW))
def test_a_linkage_decomposes_as_is_known(name: str) -> None:
    found = answer(name)
    agreement = compare(found, shipped(name).truth, problem_of(shipped(name)).formulation)
    assert found.complete
    assert agreement is not None
    assert agreement.verdict is AgreementKind.AGREES
    assert not agreement.unlisted


def test_every_linkage_of_the_zoo_names_its_sources() -> None:
    assert len(ZOO) >= 100
    assert set(ZOO) >= SLOW
    for name in ZOO:
        truth = shipped(name).truth
        assert truth, name
        assert all(t.source for t in truth), name


def test_motions_of_one_and_two_freedoms_meet_where_a_crank_folds_a_rhombus() -> None:
    report = nag.mobility(shipped("planar/kinematotropic-crank"))
    assert report.components == ((2, 4), (1, 4))
    assert (report.tangent_dimension, report.local_dimension) == (3, 2)
    assert "motions with 1 and 2 freedoms meet here" in report.sentence
