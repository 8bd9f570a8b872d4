"""Other equations of the same problem, to compare what both say: formulations, or coordinates."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

from nag.algebra.number import Number
from nag.mechanism import FORMULATIONS
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.framework import Framework
from nag.mechanism.framework_model import (
    FrameworkModel,
    cartesian_model,
    framework_model,
    in_isotropic_coordinates,
    pin_differently,
)
from nag.mechanism.linkage import LinkageModel, pin_model
from nag.mechanism.mobility_report import Alike
from nag.mechanism.model import ModelError
from nag.mechanism.problem import Problem, problem_of
from nag.mechanism.real_assemblies import lines_of_real, of_real_assemblies


@dataclass(frozen=True)
class OtherEquations:
    """A problem in other equations.

    Attributes:
        name: of its formulation or its coordinates.
        problem: in them.
        at: the configuration in its variables; None if none was given.
        alike: what of the components is the same in both.
    """

    name: str
    problem: Problem
    at: tuple[Number, ...] | None
    alike: Alike


def other_equations(
    problem: Problem, at: Sequence[Number] | None = None
) -> Iterator[OtherEquations]:
    """Other equations of the same mechanism or parts.

    Args:
        at: a configuration in the variables of the problem; where it cannot be carried over, there
            are none.
    """
    made = problem.mechanism
    if made is not None:
        for name in FORMULATIONS if at is None else ():
            if name != made.formulation:
                with suppress(ModelError):
                    other = problem_of(made.mechanism, formulation=name)
                    yield OtherEquations(f"formulation {name}", other, None, "dimensions")
    elif problem.formulation == "H":
        other = problem_of(problem, formulation="E")
        there = None if at is None else tuple(other.model.of_half_angles(problem.model, at))  # type: ignore[union-attr]
        yield OtherEquations("formulation E", other, there, "dimensions")
    elif problem.parts is not None:
        stretched = lines_of_real(problem) is not None and at is None
        others = _other_coordinates(problem.parts, at)
        yield from _apart_where_stretched(problem, others) if stretched else others


def _apart_where_stretched(
    problem: Problem, others: Iterable[OtherEquations]
) -> Iterator[OtherEquations]:
    """Those whose equations of real assemblies are others, of parts that lengths put in line.

    In real coordinates what was given in others may be the same. A framework is pinned by others of
    its points then.
    """
    own = of_real_assemblies(problem).system
    yield from (o for o in others if of_real_assemblies(o.problem).system != own)
    if isinstance(problem.parts, FrameworkModel):
        given = problem.parts.framework
        for shift in range(1, len(given.bars)):
            other = problem_of(framework_model(_in_another_order(given, shift)))
            pinned = of_real_assemblies(other).parts
            assert isinstance(pinned, FrameworkModel)
            if set(pinned.pinned) != set(of_real_assemblies(problem).parts.pinned):  # type: ignore[union-attr]
                name = f"{'-'.join(pinned.pinned)} pinned"
                yield OtherEquations(name, other, None, "counts")


def _in_another_order(framework: Framework, shift: int) -> Framework:
    """The same framework, another of whose bars, and of its points, comes first."""
    bars, lengths = framework.bars, framework.squared_lengths
    first = bars[shift]
    order = sorted(framework.points, key=lambda p: p not in first)
    return replace(
        framework,
        points=tuple(order),
        bars=(*bars[shift:], *bars[:shift]),
        squared_lengths=(*lengths[shift:], *lengths[:shift]),
    )


def _other_coordinates(
    parts: AssemblyModel, at: Sequence[Number] | None
) -> Iterator[OtherEquations]:
    """Other coordinates of a linkage or a framework.

    A linkage that was given by its links' turns is taken by the places of its pins. A framework in
    the plane is taken in x and y without isotropic coordinates, or with them where it had none; in
    space other points are pinned.
    """
    if isinstance(parts, LinkageModel):
        pins = pin_model(parts)
        there = None if at is None else pins.places_at(at)
        yield OtherEquations("pins", problem_of(pins), there, "degrees")
    if not isinstance(parts, FrameworkModel):
        return
    here = None if at is None else tuple(at)
    if parts.system.isotropic:
        plain = replace(cartesian_model(parts.framework), smaller=None)
        yield OtherEquations("coordinates (x, y)", problem_of(plain), here, "counts")
    elif parts.smaller is not None:
        plain = problem_of(replace(parts, smaller=None))
        yield OtherEquations("coordinates (x, y)", plain, here, "degrees")
    elif parts.coordinates == "xy" and (other := in_isotropic_coordinates(parts)) is not None:
        yield OtherEquations("isotropic coordinates", problem_of(other), here, "degrees")
    elif at is None and (pinned := pin_differently(parts)) is not None:
        name = f"{'-'.join(pinned.pinned)} pinned"
        # Of two bars that meet each realisation is pinned in two ways, and components may part so.
        twice = parts.points_of_each + pinned.points_of_each > 2
        yield OtherEquations(name, problem_of(pinned), None, "dimensions" if twice else "counts")
