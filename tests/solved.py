"""Cases and systems that several tests decompose: each is read and decomposed once."""

from __future__ import annotations

from functools import cache

from linkages import CASES

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose
from nag.files.cases import Case, read_case
from nag.mechanism.model import Model, model
from nag.mechanism.problem import problem_of
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
def components_of(
    system: PolynomialSystem, symmetries: tuple[SignedPermutation, ...] = (), seed: int = 0
) -> Decomposition:
    return decompose(system, symmetries=symmetries, seed=seed)


@cache
def answer(name: str, formulation: str = "auto") -> Decomposition:
    problem = problem_of(shipped(name), formulation=formulation)
    if problem.parts is not None:
        return problem.decompose()
    return components_of(problem.system, problem.symmetries)
