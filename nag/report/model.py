"""A model of a mechanism as text: its variables, joints and formulations, what its ranks say."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod
from typing import TYPE_CHECKING

from nag.errors import MechanismError
from nag.mechanism import PLATFORM_ALONE
from nag.mechanism.joint_types import JOINT_TYPES
from nag.mechanism.legs import parallel_robot
from nag.mechanism.path_estimates import MOST_DECOMPOSED
from nag.text.table import Row, align, count_text, printable

if TYPE_CHECKING:
    from nag.mechanism.assembly import AssemblyModel
    from nag.mechanism.axes import Space
    from nag.mechanism.framework import Framework
    from nag.mechanism.model import Model
    from nag.mechanism.path_estimates import Alternative
    from nag.mechanism.problem import Problem

Rows = list[Row]


def model_row(problem: Problem) -> Rows:
    """What was made of what was given; nothing for equations by themselves."""
    made = problem.model
    if made is None:
        return []
    named = "" if problem.mechanism is None else f"formulation {made.formulation}: "
    return [("model", f"{named}{made.reason}")]


def model_rows(problem: Problem) -> Rows:
    """The same, and what signs, ranks and counting say of it."""
    rows, made = model_row(problem), problem.model
    if made is None:
        return rows
    if problem.mechanism is not None and problem.mechanism.sign_group > 1:
        text = f"{problem.mechanism.sign_group} sign changes of Euler parameters keep the "
        text += "equations; components that they exchange are counted one by one"
        rows.append(("signs", text))
    if problem.mechanism is not None:
        rows.append(counted_row(made.gruebler_kutzbach, problem.space))
    rows += [("besides", text) for text in made.zero_links]
    if made.rank is not None:
        rows += rank_rows(made.rank, problem.system.n, problem.reference is not None)
    return rows if problem.parts is None else rows + _counting_rows(problem.parts)


def _counting_rows(parts: AssemblyModel) -> Rows:
    from nag.mechanism.framework_model import FrameworkModel
    from nag.mechanism.linkage import LinkageModel

    if isinstance(parts, FrameworkModel):
        return _framework_rows(parts.framework)
    if isinstance(parts, LinkageModel):
        return [counted_row(parts.gruebler_kutzbach, parts.space)]
    return []


def counted_row(count: int, space: Space | None) -> Row:
    """What counting freedoms predicts, and by which formula."""
    return "counted", f"{count} by Gruebler-Kutzbach ({space})"


def _framework_rows(framework: Framework) -> Rows:
    generic, count = framework.generic_motions(), framework.freedoms
    text = "rigid" if generic == 0 else f"mobile with {count_text(generic, 'freedom')}"
    if generic > count:
        dependent = generic - count
        text += f", {count_text(dependent, 'bar')} more than are independent"
    rows = [("graph", f"counting gives {count}; for almost all lengths {text}")]
    here = framework.infinitesimal_motions()
    if here is not None:
        stresses = framework.self_stresses()
        rows.append(
            (
                "placement",
                (
                    "infinitesimally rigid"
                    if here == 0
                    else f"infinitesimally mobile with {count_text(here, 'freedom')}"
                )
                + f", self-stresses {stresses}",
            )
        )
    return rows


def formulation_lines(problem: Problem) -> list[str]:
    """Joints, and every formulation or all coordinates of a problem, the one taken marked."""
    made = problem.model
    if made is None:
        return []
    covered = [a for a in made.alternatives if a.form is not None]
    others = [a for a in made.alternatives if a.form is None]
    taken = made.formulation or covered[0].formulation
    what = "coordinates" if made.formulation is None else "formulation"
    rows = [[what, "variables", "equations", "Bezout", "groups' bound", "paths", ""]]
    rows += [] if problem.mechanism is None else [unreduced_row(problem.mechanism)]
    rows += [[*alternative_row(a), "taken" if a.formulation == taken else ""] for a in covered]
    return [
        *_component_lines(made.joint_types),
        f"{what.removesuffix('s')}s; paths: at most so many, equation by equation",
        *(f"  {line}" for line in align(rows, (0, 6))),
        *(line for a in covered for line in _at_once_lines(a)),
        *(f"  {a.formulation}: {printable(a.problem)}" for a in others),
        *([] if taken == PLATFORM_ALONE else _platform_lines(problem)),
    ]


def _platform_lines(problem: Problem) -> list[str]:
    """What may be asked of a robot's platform alone, and when it is."""
    if problem.mechanism is None:
        return []
    try:
        robot = parallel_robot(problem.mechanism.mechanism)
    except MechanismError:
        return []
    if not all(leg.is_serial for leg in robot.legs):
        return []
    return [
        f"  {PLATFORM_ALONE}: the poses of {printable(robot.platform)} alone, by its "
        f"{count_text(len(robot.legs), 'leg')}; nag modes tells its operation modes",
        f"     nag decompose takes it where the others have more than {MOST_DECOMPOSED} paths, and "
        "it has fewer; elsewhere it is on request",
    ]


def _component_lines(kinds: Sequence[str]) -> list[str]:
    """The types of the joints and the prime components of their constraints."""
    if not kinds:
        return []
    rows = [["joints", "freedoms", "constraints", "modes", "components", "dimension", "degree"]]
    for kind in kinds:
        known = JOINT_TYPES[kind]
        parts = ((known.coincidences, "C"), (known.orthogonalities, "SO"), (known.gaps, "O"))
        constraints = " + ".join(f"{count} {name}" for count, name in parts if count)
        found = known.components
        numbers = (found.modes, found.count, found.dimension, found.degree)
        rows.append([kind, str(known.freedoms), constraints, *map(str, numbers)])
    lines = ["joints and the prime components of their SO constraints, in the Euler parameters of"]
    lines.append("both bodies")
    return [*lines, *(f"  {line}" for line in align(rows, (0, 2)))]


def _at_once_lines(each: Alternative) -> list[str]:
    """What is tracked before equations are intersected one by one, if anything is."""
    if each.at_once is None:
        return []
    return [
        f"  {each.formulation}: {large_number(each.at_once)} paths to a slice at once, in "
        "z = c + is and w = c - is, as many as it may",
        "  have zeros; if not all end at zeros, equation by equation, at most "
        f"{large_number(each.most)}",
    ]


def alternative_row(each: Alternative) -> list[str]:
    """Formulation, variables, equations, Bezout's number, the groups' bound, paths."""
    system = each.system
    numbers = (system.n, len(system.polynomials), each.bezout, each.bound, each.paths)
    return [each.formulation, *map(large_number, numbers)]


def unreduced_row(model: Model) -> list[str]:
    """The same for every constraint of every joint in all bodies' coordinates."""
    system = model.unreduced
    degrees = sorted(f.degree for f in system.polynomials)[: system.n]
    numbers = (system.n, len(system.polynomials), prod(degrees))
    return ["unreduced", *map(large_number, numbers), "", "", ""]


def large_number(number: int) -> str:
    """A whole number, in powers of ten where it is long."""
    return str(number) if number < 10**7 else f"{float(number):.1e}"


def body_rows(problem: Problem) -> Rows:
    """Which variables belong to which body and joint, eliminated ones included.

    Nothing for models in half-angles and others, and for what is no mechanism.
    """
    from nag.mechanism.euler import EulerModel, slide_directions
    from nag.mechanism.planar import PlanarModel

    model = problem.mechanism
    if model is None or not isinstance(model.form, EulerModel | PlanarModel):
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


def eliminated_lines(problem: Problem) -> list[str]:
    """The variables that are polynomials in those of the system."""
    from nag.mechanism.euler import EulerModel
    from nag.mechanism.planar import PlanarModel

    model = problem.mechanism
    if model is None or not isinstance(model.form, EulerModel | PlanarModel):
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
    text = (
        f"{text} in {count_text(variables, 'unknown')}, by exact linear algebra: every "
        f"component has dimension {free} or more{', so it moves' if assembled else ''}"
    )
    return [("rank", text)]
