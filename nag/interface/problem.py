"""What a problem may be given as, and what it comes down to: a system and its symmetries."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from nag.algebra.from_python import system as system_of_equations
from nag.algebra.given import check_listed, is_a
from nag.algebra.symmetry import SignedPermutation, SymmetryError
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError


@dataclass(frozen=True)
class Problem:
    """An exact system, signed permutations of its variables that keep it, and the parts it is of.

    `parts` is the model of a case whose parts are not assembled; `family` is the one that a case
    says its system belongs to, a `nag.algebra.symmetric_family.FamilyMember`.
    """

    system: PolynomialSystem
    symmetries: tuple[SignedPermutation, ...] = ()
    parts: Any = None
    family: Any = None


def problem_of(given: Any, variables: Any = None) -> Problem:
    """The problem that a mechanism, a model, a case, a system or equations describe.

    Raises:
        nag.mechanism.model.ModelError: if a mechanism has no loop.
        ValueError: if ``given`` is none of these, or an equation is no polynomial.
    """
    if isinstance(given, PolynomialSystem):
        problem = Problem(given)
    elif is_a(given, "nag.mechanism.graph", "Mechanism"):
        from nag.mechanism.model import model

        problem = _of_model(model(given))
    elif is_a(given, "nag.mechanism.model", "Model"):
        problem = _of_model(given)
    elif is_a(given, "nag.files.cases", "Case"):
        problem = (
            problem_of(given.mechanism)
            if given.system is None
            else Problem(given.system, given.symmetries, given.assembly, given.family)
        )
    elif is_a(given, "networkx", "Graph"):
        raise NagError(
            "system: a networkx graph is given; make it a mechanism first: "
            "nag.Mechanism.from_graph(graph, ground=...)"
        )
    elif given is None or isinstance(given, Mapping | bool | int | float):
        raise NagError(
            f"system: something of type {type(given).__name__} is given; give equations in a list, "
            "or a nag.PolynomialSystem, nag.Mechanism, nag.Case, or a model"
        )
    else:
        return Problem(system_of_equations(given, variables))
    if variables is not None:
        raise NagError("variables: are for equations; what is given has its own, leave them out")
    return problem


def _of_model(model: Any) -> Problem:
    return Problem(model.system, model.symmetries)


def symmetries_in(given: Iterable[Any] | None, problem: Problem) -> tuple[SignedPermutation, ...]:
    """Symmetries given as signed permutations, as maps of names, or as signs of the variables.

    Raises:
        SymmetryError: if one is none.
    """
    if given is None:
        return problem.symmetries
    check_listed(given, "symmetries", "a list of them: [{'x': '-x'}, ...]")
    found = []
    for i, item in enumerate(given):
        try:
            if isinstance(item, SignedPermutation):
                found.append(item)
            elif isinstance(item, Mapping):
                texts = {str(name): str(image) for name, image in item.items()}
                found.append(SignedPermutation.of_map(texts, problem.system.variables))
            elif isinstance(item, Iterable) and not isinstance(item, str):
                found.append(SignedPermutation.of_signs(tuple(int(sign) for sign in item)))
            else:
                raise SymmetryError("give a dict like {'x': '-x'}, or a sign for each variable")
        except (TypeError, ValueError) as error:
            raise SymmetryError(f"symmetries[{i}]: {error}") from None
    return tuple(found)
