"""What a case asks: the system that is decomposed or solved, its symmetries and its points."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from nag.algebra.number import Number
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.files.export import Origin

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.mechanism.model import Model
    from nag.witness.witness import Decomposition


def system_of(case: Case, model: Model | None) -> PolynomialSystem:
    """The system that is decomposed."""
    system = case.system if model is None else model.system
    if system is None:
        raise ValueError("a case without a system and without a mechanism")
    return system


def decomposed(case: Case, model: Model | None, **options: Any) -> Decomposition:
    """The components of what a case asks; options as of `nag.decomposition.decompose`."""
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


def origin(case: Case, model: Model | None) -> Origin:
    """What an export says of where the system came from."""
    from pathlib import Path

    return Origin(
        title=case.title,
        file=Path(case.path).name,
        kind="system" if model is None else "mechanism",
        formulation=model.formulation if model else None,
        reason=model.reason if model else None,
    )
