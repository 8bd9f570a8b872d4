"""The answers to ``nag decompose`` and ``nag model`` as text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from nag.algebra.number import Number, decimal_text
from nag.algebra.system import system_line, values_text
from nag.decomposition.decompose import METHODS, ONE_EQUATION
from nag.decomposition.one_equation import is_one_equation
from nag.decomposition.reduction import Reduction
from nag.decomposition.through import Through
from nag.mechanism import PLATFORM_ALONE
from nag.report.agreement import agreement_text, compare
from nag.report.assemblies import assembly_rows
from nag.report.model import body_rows, eliminated_lines, formulation_lines, model_rows
from nag.text.table import Row, count_text, printable, sheet
from nag.witness.frame import expand_orbits
from nag.witness.shown import (
    component_table,
    degree_text,
    kinds,
    kinds_text,
    paths_text,
    remarks,
    title_line,
)
from nag.witness.witness import Decomposition, Status

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.mechanism.problem import Problem

NO_REGULAR_POSE = (
    "not known from poses, as a leg or its equations are singular at the reference configuration; "
    "`nag mobility` asks the joints there"
)
# Irrational equations that are longer than some lines are told in decimals.
LONGEST_EQUATION, EQUATION_DIGITS = 1000, 15


def _method_rows(decomposition: Decomposition) -> list[tuple[str, str]]:
    texts = {method.__name__: text for method, text in METHODS.items()}
    if decomposition.method not in texts:
        return []
    text = texts[decomposition.method]
    if decomposition.algebraic:
        text += "; by algebra alone, without paths"
    return [("method", text)]


def _mobility_rows(
    decomposition: Decomposition, problem: Problem, points: Sequence[Through]
) -> list[tuple[str, str]]:
    """How it moves at each named point; of equations, which dimension their zeros have there."""
    moves = problem.model is not None
    counted = f", {_counted_text(problem)}" if moves else ""
    everything = expand_orbits(decomposition).components
    rows = []
    for point in points:
        components = [everything[i] for i in point.components]
        if not point.solution:
            text = f"{point.name} is no solution of the equations"
        elif point.doubt:
            text = f"not known at {point.name}{counted}"
        else:
            on = kinds_text(kinds(components))
            largest = max(c.dimension for c in components) + problem.free
            if moves:
                reduced = all(c.multiplicity == 1 for c in components)
                text = _moves_text(problem, largest, point, reduced)
                text = f"in complex coordinates {text}" if point.unreal else text
                text += f"{_counted_beside(problem, largest)}; on {on}"
            else:
                text = f"{largest} at {point.name}: on {on}"
            if point.unreal:
                text += _unreal_text(point.unreal, largest, moves)
            if any(c.status is not Status.IRREDUCIBLE for c in components):
                text += ", not all of them decided"
        rows.append(("mobility" if moves else "dimension", text))
    return rows


def _counted_text(problem: Problem) -> str:
    """What counting freedoms says of it."""
    assert problem.model is not None
    return f"counting predicts {problem.model.gruebler_kutzbach}"


def _counted_beside(problem: Problem, mobility: int) -> str:
    """The same beside how many freedoms there are."""
    assert problem.model is not None
    surprise = mobility != max(problem.model.gruebler_kutzbach, 0)
    return f", {'though ' if surprise else ''}{_counted_text(problem)}"


def _moves_text(problem: Problem, mobility: int, point: Through, reduced: bool) -> str:
    """With how many freedoms it moves, and whose those are that the equations leave out.

    Args:
        reduced: whether the components through the point are, so that an isolated one is rigid.
    """
    if not mobility:
        return f"it does not move at {point.name}"
    rods = _idle_rods(problem)
    if rods and mobility == problem.free:
        how = "is rigid" if reduced else "does not move"
        idle = f"{count_text(rods, 'rod')} that turn{'s' * (rods == 1)} idly"
        return f"it {how} at {point.name} but for {idle}, with {count_text(mobility, 'freedom')}"
    text = f"it moves with {count_text(mobility, 'freedom')} at {point.name}"
    return text + "".join(f", {count} of them by {who}" for count, who in problem.freedoms_left_out)


def _idle_rods(problem: Problem) -> int:
    """How many rods turn idly, where the equations leave out nothing but that; else 0."""
    from nag.mechanism.model import Model
    from nag.mechanism.rods import RodModel

    made = problem.model
    if not isinstance(made, Model) or not isinstance(made.form, RodModel):
        return 0
    rods = len(made.form.rods) + len(made.form.zero_rods)
    return rods if problem.free == made.form.spins else 0


def _degree_rows(decomposition: Decomposition, problem: Problem) -> list[Row]:
    """To what the degrees of motions belong."""
    if problem.model is None or not any(c.dimension for c in decomposition.components):
        return []
    return [("degree", degree_text(problem.model.formulation_text))]


def _unreal_text(unreal: int, dimension: int, moves: bool) -> str:
    """What real motions, or points, there are beside a point at which others end."""
    what = "motion leaves it" if moves else "points are near by"
    if unreal == dimension:
        return f"; by terms of second order no real {what}"
    return f"; by terms of second order real ones have dimension {dimension - unreal} at most"


def _pose_rows(problem: Problem) -> list[tuple[str, str]]:
    """What components of a platform's poses do not tell of the joints."""
    if problem.formulation != PLATFORM_ALONE:
        return []
    text = (
        "components are those of the platform's poses, closed: of the joints there may be several "
        "above one, and others, also larger ones, where the platform stands still or a leg is "
        "singular"
    )
    rows = [] if problem.reference is not None else [("mobility", NO_REGULAR_POSE)]
    return [*rows, ("not seen", text)]


def _orbit_rows(decomposition: Decomposition) -> list[tuple[str, str]]:
    sizes = [component.orbit for component in decomposition.components]
    if max(sizes, default=1) == 1:
        return []
    text = f"symmetries leave {len(sizes)} of {sum(sizes)} components to work out, in orbits of "
    return [("orbits", text + ", ".join(map(str, sorted(sizes))))]


def answer_lines(
    decomposition: Decomposition,
    case: Case,
    problem: Problem,
    points: Sequence[Through],
    run: Row,
) -> list[str]:
    """The whole answer, line by line: what was asked, and then what it rests on."""
    answer: list[Row] = [("answer", title_line(decomposition))]
    if not decomposition.complete:
        answer.append(("", "INCOMPLETE, see below"))
    through = _mobility_rows(decomposition, problem, points)
    moves = through + assembly_rows(problem, decomposition) + _pose_rows(problem)
    # Of a mechanism it is asked how it moves, of equations which solutions they have.
    head = answer + through if problem.model is None else moves + answer
    tail: list[Row] = [("open", line) for line in remarks(decomposition)]
    tail += _degree_rows(decomposition, problem)
    tail += [*case.note_rows, *model_rows(problem)]
    tail.append(("system", system_line(decomposition.system)))
    tail += _method_rows(decomposition) + _orbit_rows(decomposition)
    tail += [
        ("paths", paths_text(decomposition.paths)),
        run,
    ]
    agreement = compare(decomposition, case.truth, problem.formulation)
    if agreement is not None:
        tail.append(("known", agreement_text(agreement)))
    return sheet(case.title, head, component_table(decomposition), tail)


def _decimals(value: Number) -> str:
    return decimal_text(value, EQUATION_DIGITS)


def model_lines(case: Case, problem: Problem) -> list[str]:
    """The polynomial system of a case, line by line."""
    system = problem.system
    head = [("system", system_line(system))]
    if is_one_equation(Reduction.of(system, scaled=True)):
        head.append(("exact", ONE_EQUATION))
    head = model_rows(problem) + body_rows(problem) + head
    texts = system.text()
    lines = ["equations"]
    if not system.exact and max(map(len, texts), default=0) > LONGEST_EQUATION:
        texts = [f.text(system.variables, _decimals) for f in system.polynomials]
        lines = [f"equations, to {EQUATION_DIGITS} digits (exact by --format text, or --json)"]
    lines += [f"  {text} = 0" for text in texts] or ["  none"]
    if system.nonzero:
        lines += ["not zero", *(f"  {f.text(system.variables)}" for f in system.nonzero)]
    if system.groups:
        groups = ("(" + ", ".join(system.variables[i] for i in g) + ")" for g in system.groups)
        lines += ["groups", "  " + ", ".join(groups)]
    lines += eliminated_lines(problem)
    for name, point in problem.named:
        lines += [printable(name), f"  {values_text(system.variables, point)}"]
    return sheet(case.title, head, lines + formulation_lines(problem))
