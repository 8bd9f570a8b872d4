"""Parts of a mechanism that may be given in place of it: a framework, a linkage, a table of joints.

Which of them something is can be told before what models them is loaded.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from nag.algebra.given import is_a
from nag.errors import NagError

if TYPE_CHECKING:
    from nag.mechanism.assembly import AssemblyModel

# What may be given in place of a mechanism, for messages.
PARTS = "parts (a nag.Linkage, a nag.Framework, a nag.DHLoop)"


class FormulationError(NagError):
    """A formulation is asked for of what has none."""


def check_formulation(formulation: str) -> None:
    """Make sure that no formulation is asked for of what has none.

    Raises:
        FormulationError: if one is.
    """
    if formulation != "auto":
        raise FormulationError(f"formulation {formulation}: is for mechanisms and tables")


def parts_in_formulation(parts: AssemblyModel, formulation: str) -> AssemblyModel:
    """The model of parts in a formulation, the one that it has if that is ``"auto"``.

    Raises:
        FormulationError: if these parts have coordinates only.
        nag.mechanism.dh.DHError: if a table has no such formulation.
    """
    if formulation in ("auto", parts.formulation):
        return parts
    if parts.formulation is None:
        check_formulation(formulation)
    from nag.mechanism.dh import table_model

    return table_model(parts.loop, formulation)  # type: ignore[attr-defined]


def model_parts(given: Any) -> Any:
    """What parts make: the model of their assemblies, or a mechanism; of a case what is asked.

    Anything else is given back as it is.

    Raises:
        nag.MechanismError: if the parts have no model.
    """
    if is_a(given, "nag.files.cases", "Case"):
        return given.problem_source
    if is_a(given, "nag.mechanism.framework", "Framework"):
        from nag.mechanism.framework_model import framework_model

        return framework_model(given)
    if is_a(given, "nag.mechanism.linkage", "Linkage"):
        from nag.mechanism.linkage import linkage_model

        return linkage_model(given)
    if is_a(given, "nag.mechanism.dh", "DHLoop"):
        from nag.mechanism.dh import assemble_table, dh_model

        return dh_model(given) if given.open else assemble_table(given)
    return given


def mechanism_in(given: Any) -> Any:
    """The mechanism that a case, a model or a problem is of; of parts their assemblies' model.

    Anything else is given back as it is.

    Raises:
        nag.MechanismError: if the parts have no model.
    """
    given = model_parts(given)
    if is_a(given, "nag.mechanism.problem", "Problem") and given.model is not None:
        given = given.model
    return given.mechanism if is_a(given, "nag.mechanism.model", "Model") else given
