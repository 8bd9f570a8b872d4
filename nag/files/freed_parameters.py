"""A polynomial system of a case with some of its parameters as unknowns."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from nag.algebra.bounded import Budget
from nag.algebra.expression import parse_polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import names_in, nearest, quote
from nag.files.case_table import CaseError, Table, read_toml
from nag.files.cases import read_case
from nag.files.parameters import with_values


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
