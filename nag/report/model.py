"""A model of a mechanism as text: its variables, joints and formulations, what its ranks say."""

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

Rows = list[tuple[str, str]]


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


def body_rows(model: Model) -> Rows:
    """Which variables belong to which body and joint, eliminated ones included.

    Nothing for models in half-angles and others.
    """
    from nag.mechanism.euler import EulerModel, slide_directions
    from nag.mechanism.planar import PlanarModel

    if not isinstance(model.form, EulerModel | PlanarModel):
        return []
    names, bodies = model.form.elimination.original_variables, model.structure.moving
    each, kind = (
        (2, "cosine and sine") if isinstance(model.form, PlanarModel) else (4, "Euler parameters")
    )
    parts = []
    for i, body in enumerate(bodies):
        own = names[each * i : each * i + each]
        parts.append(f"{', '.join(own) if each == 2 else f'{own[0]} to {own[-1]}'} of {body}")
    rows = [("bodies", f"{kind} {', '.join(parts)}")]
    slides = iter(names[each * len(bodies) :])
    along = [(next(slides), j.name) for j in model.structure.joints for _ in slide_directions(j)]
    if along:
        rows.append(("", "distances " + ", ".join(f"{x} of {joint}" for x, joint in along)))
    return rows


def eliminated_lines(model: Model) -> list[str]:
    """The variables that are polynomials in those of the system."""
    from nag.mechanism.euler import EulerModel
    from nag.mechanism.planar import PlanarModel

    if not isinstance(model.form, EulerModel | PlanarModel):
        return []
    elimination = model.form.elimination
    variables = elimination.system.variables
    texts = [
        f"{name} = {image.text(variables)}"
        for i, (name, image) in enumerate(
            zip(elimination.original_variables, elimination.images, strict=True)
        )
        if i not in elimination.kept
    ]
    return ["eliminated", "  " + ", ".join(texts)] if texts else []


def rank_rows(rank: tuple[int, int], variables: int, assembled: bool) -> Rows:
    """What the rank of closure equations says, if some of them depend on the others.

    Args:
        rank: number of closure equations, and how many of them are independent.
        assembled: whether there is a configuration.
    """
    equations, independent = rank
    if independent == equations:
        return []
    text = f"the {equations} closure equations have rank {independent}"
    free = variables - independent
    if free <= 0:
        return [("rank", f"{text}, by exact linear algebra")]
    unknowns = f"{variables} unknown" + ("s" if variables > 1 else "")
    text = (
        f"{text} in {unknowns}, by exact linear algebra: every component has dimension {free} or "
        f"more{', so it moves' if assembled else ''}"
    )
    return [("rank", text)]
