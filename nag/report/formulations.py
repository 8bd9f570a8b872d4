"""The formulations and joints of a mechanism as text."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod
from typing import TYPE_CHECKING

from nag.mechanism.joint_types import JOINT_TYPES
from nag.text.table import align, printable

if TYPE_CHECKING:
    from nag.mechanism.assembly import AssemblyModel
    from nag.mechanism.dh import DHModel
    from nag.mechanism.dh_euler import DHEulerModel
    from nag.mechanism.formulations import Alternative
    from nag.mechanism.model import Model
    from nag.mechanism.parts_coordinates import PartsCoordinates


def joint_lines(model: Model) -> list[str]:
    """The types of the joints and the prime components of their constraints."""
    return _component_lines(list(dict.fromkeys(j.type for j in model.mechanism.joints)))


def _component_lines(kinds: Sequence[str]) -> list[str]:
    rows = [["joints", "freedoms", "constraints", "modes", "components", "dimension", "degree"]]
    for kind in kinds:
        known = JOINT_TYPES[kind]
        parts = ((known.coincidences, "C"), (known.orthogonalities, "SO"), (known.gaps, "O"))
        constraints = " + ".join(f"{count} {name}" for count, name in parts if count)
        numbers = (known.modes, known.components, known.dimension, known.degree)
        rows.append([kind, str(known.freedoms), constraints, *map(str, numbers)])
    lines = ["joints and the prime components of their SO constraints, in the Euler parameters of"]
    lines.append("both bodies")
    return [*lines, *(f"  {line}" for line in align(rows, (0, 2)))]


def alternative_lines(model: Model) -> list[str]:
    """Every formulation with its numbers, the one that is taken marked."""
    covered = [a for a in model.alternatives if a.form is not None]
    lines = _formulation_lines(covered, model.formulation, [unreduced_row(model)])
    lines += [
        f"  {a.formulation}: {printable(a.problem)}" for a in model.alternatives if a.form is None
    ]
    return lines


def table_lines(table: DHModel | DHEulerModel) -> list[str]:
    """Joints and formulations of a table by Denavit and Hartenberg."""
    from nag.mechanism.dh_euler import table_alternatives

    return _component_lines(["revolute"]) + _formulation_lines(
        table_alternatives(table.loop), table.formulation, []
    )


def parts_lines(parts: AssemblyModel) -> list[str]:
    """The coordinates of a linkage's or a framework's parts with their numbers."""
    from nag.mechanism.parts_coordinates import coordinates_of_parts

    each = coordinates_of_parts(parts)
    taken = next(c.formulation for c in each if c.taken)
    return _formulation_lines(each, taken, [], "coordinates")


def _formulation_lines(
    covered: Sequence[Alternative | PartsCoordinates],
    taken: str,
    others: Sequence[Sequence[str]],
    what: str = "formulation",
) -> list[str]:
    rows = [[what, "variables", "equations", "Bezout", "groups' bound", "paths", ""]]
    rows += [list(row) for row in others]
    rows += [[*alternative_row(a), "taken" if a.formulation == taken else ""] for a in covered]
    return [
        f"{what.removesuffix('s')}s; paths: at most so many, equation by equation",
        *(f"  {line}" for line in align(rows, (0, 6))),
        *(line for a in covered for line in _at_once_lines(a)),
    ]


def _at_once_lines(each: Alternative | PartsCoordinates) -> list[str]:
    """What is tracked before equations are intersected one by one, if anything is."""
    if each.at_once is None:
        return []
    return [
        f"  {each.formulation}: {large(each.at_once)} paths to a slice at once, in z = c + is and "
        "w = c - is, as many as it may",
        f"  have zeros; if not all end at zeros, equation by equation, at most {large(each.most)}",
    ]


def alternative_row(each: Alternative | PartsCoordinates) -> list[str]:
    """Formulation, variables, equations, Bezout's number, the groups' bound, paths."""
    system = each.system
    numbers = (system.n, len(system.polynomials), each.bezout, each.bound, each.paths)
    return [each.formulation, *map(large, numbers)]


def unreduced_row(model: Model) -> list[str]:
    """The same for every constraint of every joint in all bodies' coordinates."""
    system = model.unreduced
    degrees = sorted(f.degree for f in system.polynomials)[: system.n]
    numbers = (system.n, len(system.polynomials), prod(degrees))
    return ["unreduced", *map(large, numbers), "", "", ""]


def large(number: int) -> str:
    """A whole number, in powers of ten where it is long."""
    return str(number) if number < 10**7 else f"{float(number):.1e}"
