"""Shipped cases that several tests decompose: each is read and decomposed once."""

from __future__ import annotations

from functools import cache

from linkages import CASES

from nag.files.cases import Case, read_case
from nag.files.problem import decomposed
from nag.mechanism.model import Model, model
from nag.witness.witness import Decomposition


@cache
def shipped(name: str) -> Case:
    return read_case(CASES / f"{name}.toml")


@cache
def modelled(name: str, formulation: str = "auto") -> Model | None:
    """The case's model, the one with the fewest paths by default; None where it has no choice."""
    mechanism = shipped(name).mechanism
    return None if mechanism is None else model(mechanism, formulation)


@cache
def answer(name: str, formulation: str = "auto") -> Decomposition:
    return decomposed(shipped(name), modelled(name, formulation))
