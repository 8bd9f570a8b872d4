"""What a case asks: the system that is decomposed or solved, its symmetries and its points.

A polynomial system may be asked for with some of its parameters as unknowns.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from nag.algebra.bounded import Budget
from nag.algebra.expression import parse_polynomial
from nag.algebra.number import Number
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import names_in, nearest, quote
from nag.errors import NagError
from nag.files.case_table import CaseError, Table, read_toml, with_values
from nag.files.cases import read_case
from nag.files.export import Origin

if TYPE_CHECKING:
    from nag.files.cases import Case, Truth
    from nag.mechanism.model import Model
    from nag.witness.witness import Decomposition


def system_of(case: Case, model: Model | None) -> PolynomialSystem:
    """The system that is decomposed."""
    system = case.system if model is None else model.system
    if system is None:
        raise NagError("a case without a system and without a mechanism")
    return system


def decomposed(case: Case, model: Model | None, **options: Any) -> Decomposition:
    """The components of what a case asks; options as of `nag.decompose`."""
    options["symmetries"] = symmetries_of(case, model)
    if case.assembly is not None:
        from nag.mechanism.parts_decomposition import decompose_parts

        return decompose_parts(case.assembly, **options)
    from nag.decomposition.components import decompose

    return decompose(system_of(case, model), **options)


def symmetries_of(case: Case, model: Model | None) -> tuple[SignedPermutation, ...]:
    """Symmetries of the system: sign changes of Euler parameters, or what the case declares."""
    return case.symmetries if model is None else model.symmetries


def points_of(case: Case, model: Model | None) -> list[tuple[str, tuple[Number, ...]]]:
    """Named points of the system: of a mechanism, its reference configuration."""
    if model is not None:
        return [("the reference configuration", tuple(model.reference))]
    return [(point.name, tuple(point.at)) for point in case.points]


def formulation_of(case: Case, model: Model | None) -> str | None:
    """In which formulation of a mechanism the system is; None if it has none.

    Tables by Denavit and Hartenberg have formulations; frameworks and linkages have coordinates.
    """
    if model is not None:
        return model.formulation
    return case.assembly.formulation if case.is_table else None  # type: ignore[union-attr]


def truth_of(case: Case, model: Model | None) -> tuple[Truth, ...]:
    """What is known of the system in the formulation in which it is."""
    formulation = formulation_of(case, model)
    return tuple(t for t in case.truth if t.formulation in (None, formulation))


def origin(case: Case, model: Model | None) -> Origin:
    """What an export says of where the system came from."""
    made = case.assembly if model is None else model
    return Origin(
        title=case.title,
        file=Path(case.path).name,
        kind="system" if made is None else "mechanism",
        formulation=formulation_of(case, model),
        reason=None if made is None else made.reason,
    )


def freed_system(
    path: str | os.PathLike[str], names: Sequence[str], values: Mapping[str, str] | None = None
) -> PolynomialSystem:
    """The equations of a case; the parameters ``names`` are its last variables.

    Args:
        values: other values of the other parameters, as in a case.

    Raises:
        CaseError: if the case is no polynomial system, has no such parameters, or has others that
            depend on them.
    """
    case = read_case(path, values)
    if case.system is None:
        raise CaseError(f"{path}: is a mechanism; parameters are freed in polynomial systems")
    for name in names:
        if name not in case.parameters:
            raise CaseError(
                f"{path}: {quote(name)} is no parameter{nearest(name, case.parameters)}; it has "
                f"{', '.join(case.parameters) or 'none'}"
            )
    top = Table(str(path), "", read_toml(Path(path)))
    for other, text in with_values(top.table("parameters"), values or {}).values.items():
        used = sorted(names_in(text) & set(names)) if isinstance(text, str) else []
        if used and other not in names:
            raise CaseError(f"{path}: parameters: {other}: depends on {used[0]}; free it as well")
    variables = (*case.system.variables, *names)
    known = {name: value for name, value in case.parameters.items() if name not in names}
    budget = Budget()
    equations = []
    for i, text in enumerate(top.texts("equations", "equations"), 1):
        with top.at(f"equations {i}"):
            equations.append(parse_polynomial(text, variables, known, budget))
    return PolynomialSystem(variables, tuple(equations))
