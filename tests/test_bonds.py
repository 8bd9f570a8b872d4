"""Bonds of loops of revolute joints, against the theory's diagrams and counts."""

from __future__ import annotations

import json

import jsonschema
import pytest
from linkages import CASES, case
from solved import answer, modelled, shipped

import nag
from nag.cli import main
from nag.files.json_schema import schema
from nag.mechanism.bonds import Bond, BondError, Bonds, _check_orders, bonds


def of_case(name: str) -> Bonds:
    made = modelled(name) or shipped(name).assembly
    (curve,) = [c for c in answer(name).components if c.dimension == 1]
    return bonds(made, curve)


# Hegedus, Schicho & Schroecker 2013: opposite joints of Bennett's linkage; Goldberg's joint between
# the two halves is connected twice. Line-symmetric loops: opposite joints, twice.
DIAGRAMS = {
    "bennett": "J0-J2, J1-J3",
    "spatial/goldberg-5r": "J1-J4, J2-J4, J3-J5",
    "spatial/goldberg-5r-difference": "J1-J4, J2-J4, J3-J5",
    "spatial/myard-5r": "J1-J3-J4 of orders 2, 1, 1, J2-J5",
    "spatial/bricard-line-symmetric": "J1-J4 (2), J2-J5 (2), J3-J6 (2)",
    "spatial/bricard-plane-symmetric": "J1-J4 (4), J2-J6 (2), J3-J5 (2)",
    "spatial/sarrus": "J1-J2-J3-J4-J5-J6 of orders 1, 2, 1, 1, 2, 1 (2), J1-J3 (2), J4-J6 (2)",
    "spatial/sarrus-kinematotropic": "A1-A2-A3-B3-B2-B1 of orders 1, 2, 1, 1, 2, 1 (2)",
    "bricard-cube": "J0-J2-J4 (2), J1-J3-J5 (2)",
}


@pytest.mark.parametrize("name", sorted(DIAGRAMS))
def test_the_bond_diagram_of_a_mobile_loop(name: str) -> None:
    assert str(of_case(name)) == DIAGRAMS[name]


def test_bonds_whose_orders_do_not_add_up_are_refused() -> None:
    pair = Bond(("a", "b"), (1, 2), 1)
    _check_orders([pair], {"a": 1, "b": 2})
    with pytest.raises(BondError, match="at joints b do not add up"):
        _check_orders([pair], {"a": 1, "b": 3})


def test_goldberg_s_linkage_moves_all_its_joints() -> None:
    for name in ("spatial/goldberg-5r", "spatial/goldberg-5r-difference"):
        assert {joint for bond in of_case(name).bonds for joint in bond.joints} == {
            "J1", "J2", "J3", "J4", "J5"
        }  # fmt: skip


def test_other_models_have_no_bonds() -> None:
    made = nag.model(case("planar-four-bar"), "E")
    with pytest.raises(ValueError, match="formulation H"):
        bonds(made, nag.decompose(made).components[0])


def test_the_command_says_genus_and_bonds(tmp_path, capsys) -> None:
    file = tmp_path / "curves.json"
    arguments = [
        "mobility",
        str(CASES / "bennett.toml"),
        "--curves",
        "--quiet",
        "--json",
        str(file),
    ]
    assert main(arguments) == 0
    assert "genus 0 (a rational motion), bonds J0-J2, J1-J3" in capsys.readouterr().out
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-mobility"))
    (curve,) = document["curves"]
    assert (curve["genus"], [bond["joints"] for bond in curve["bonds"]]) == (
        0,
        [["J0", "J2"], ["J1", "J3"]],
    )
