"""The command ``nag mobility``: how a mechanism moves at a configuration."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    UsageError,
    add_case,
    add_running,
    read_case_file,
    read_problem,
)
from nag.cli.running import Answer, answer_of, as_chosen, name_case
from nag.cli.witness_input import point_at

if TYPE_CHECKING:
    from nag.algebra.number import Number
    from nag.files.cases import Case
    from nag.mechanism.mobility_report import Alike, MobilityReport
    from nag.mechanism.model import Model

FORMAT = "nag-mobility"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag mobility`` has besides those of every command that runs a case."""
    add_case(parser)
    add_running(parser)
    parser.add_argument(
        "--at",
        metavar="VALUES",
        help="a configuration in the variables of `nag model`: 'c1 = 3/5, s1 = 4/5', all of them, "
        "where a rounded one stands for the configuration next to it "
        "(default: the reference configuration; of parts that are not assembled a general one); of "
        "a framework in the plane the points' x_P and y_P, the first bar from (0, 0) to (1, 0)",
    )
    parser.add_argument(
        "--local",
        action="store_true",
        help="do not decompose: counting, tangent and local dimension only",
    )
    parser.add_argument(
        "--curves",
        action="store_true",
        help="the genus of each curve through the configuration (0 is a rational motion), and in "
        "a loop of revolute joints its bonds",
    )
    parser.add_argument(
        "--check",
        action="store_true",
        help="do it all again in another formulation of the mechanism, and compare",
    )


def run(options: argparse.Namespace) -> Answer:
    """How a mechanism moves at a configuration."""
    case, made = _mechanism(options)
    variables = _variables(case, made)
    at = None if options.at is None else point_at(options.at, variables)
    if options.check and not _has_another(case, made, at):
        raise UsageError(
            "--check: there is no second formulation: that is for mechanisms with loops at their "
            "reference configuration, for tables in half-angles, linkages and frameworks; one in "
            "space needs a second triangle of bars, and no --at"
        )
    from nag.algebra.number import number_text
    from nag.files.answers_at_points import mobility_document
    from nag.mechanism.mobility_report import MobilityStatus

    report = _report(options, case, made.formulation if made else "auto", at)
    rows = report.rows()
    complete = report.status is not MobilityStatus.UNDECIDED and not report.open
    complete &= not any(curve.note for curve in report.curves)
    compared: dict[str, Any] | None = None
    if options.check:
        text, agree, compared = _compared(options, case, report, at)
        rows.append(("check", text))
        complete &= agree
    fields = {
        "format": FORMAT,
        "configuration": [number_text(x) for x in at or _reference(case, made)],
        **mobility_document(report),
        "check": compared,
    }
    return answer_of(options, name_case(case), (), rows, fields, complete)


def _mechanism(options: argparse.Namespace) -> tuple[Case, Model | None]:
    """The case and the model of an assembled mechanism; None if it has no loops.

    Raises:
        UsageError: if there is no mechanism, or no configuration of it is known or given.
    """
    case = read_case_file(options.case, options.set)
    if case.mechanism is None:
        if case.assembly is None:
            raise UsageError(f"{options.case}: is a polynomial system; `nag local` is for those")
        if options.formulation is not None:
            case, _ = read_problem(options)
        if options.at is None and case.assembly.reference is None:
            from nag.mechanism.real_assemblies import obstacle

            reason = obstacle(case.assembly)
            if reason:
                raise UsageError(f"{options.case}: its parts have no real assembly: {reason}")
            if options.local:
                raise UsageError(
                    f"{options.case}: its parts are not assembled: give --at, or leave out --local"
                )
        return (case if options.at is None else _with_real_coordinates(case)), None
    from nag.mechanism.loops import loop_structure

    if not loop_structure(case.mechanism).loops:
        if options.at is not None:
            raise UsageError(f"--at: {options.case} has no loop, so that it has no equations")
        return case, None
    return read_problem(options)


def _with_real_coordinates(case: Case) -> Case:
    """A framework that is given by lengths in coordinates in which a placement is real."""
    from nag.mechanism.framework_model import FrameworkModel, cartesian_model

    if not isinstance(case.assembly, FrameworkModel):
        return case
    return replace(case, assembly=cartesian_model(case.assembly.framework))


def _has_another(case: Case, made: Model | None, at: tuple[Number, ...] | None) -> bool:
    """Whether the configuration is known in another formulation as well."""
    from nag.mechanism.dh import DHModel
    from nag.mechanism.parts_coordinates import another_model

    if made is not None:
        return at is None
    parts = case.assembly
    if parts is None:
        return False
    return isinstance(parts, DHModel) or another_model(parts, at) is not None


def _variables(case: Case, made: Model | None) -> tuple[str, ...]:
    if made is not None:
        return made.system.variables
    return () if case.assembly is None else case.assembly.system.variables


def _reference(case: Case, made: Model | None) -> tuple[Number, ...]:
    if made is not None:
        return tuple(made.reference)
    return () if case.assembly is None else tuple(case.assembly.reference or ())


def _report(
    options: argparse.Namespace, case: Case, formulation: str, at: tuple[Number, ...] | None
) -> MobilityReport:
    from nag.mechanism.mobility_at import NoAssembly, mobility
    from nag.numerics.local_dimension import NoSolution

    subject = case.mechanism or case.assembly
    assert subject is not None
    try:
        return mobility(
            subject,
            at,
            formulation=formulation,
            detail="curves" if options.curves else "local" if options.local else "components",
            **as_chosen(options),
        )
    except NoAssembly as reason:
        raise UsageError(f"{options.case}: {reason}") from None
    except NoSolution as reason:
        raise UsageError(f"--at: {reason}; it is no configuration of the mechanism") from None


def _others(
    options: argparse.Namespace, case: Case, report: MobilityReport, at: tuple[Number, ...] | None
) -> Iterator[tuple[str, MobilityReport, Alike]]:
    """What other formulations say, each with its name and what of the components is the same."""
    from nag.mechanism.formulation_names import FORMULATIONS
    from nag.mechanism.model import ModelError
    from nag.mechanism.parts_coordinates import another_model

    if case.mechanism is None:
        assert case.assembly is not None
        another = another_model(case.assembly, at)
        if another is not None:
            other = replace(case, assembly=another.parts)
            found = _report(options, other, "auto", another.at)
            yield another.name, found, another.alike
            return
        from nag.files.dh_case import in_formulation

        other = in_formulation(case, "E")
        there = None
        if at is not None:
            there = tuple(other.assembly.of_half_angles(case.assembly, at))
        yield "formulation E", _report(options, other, "auto", there), "dimensions"
        return
    for formulation in FORMULATIONS:
        if report.formulation != f"formulation {formulation}":
            with suppress(ModelError):
                found = _report(options, case, formulation, None)
                yield f"formulation {formulation}", found, "dimensions"


def _compared(
    options: argparse.Namespace, case: Case, report: MobilityReport, at: tuple[Number, ...] | None
) -> tuple[str, bool, dict[str, Any] | None]:
    """What another formulation says, whether it agrees, and that as a JSON object."""
    for formulation, other, alike in _others(options, case, report, at):
        agree = other.same_motion(report, alike)
        text = (
            f"{formulation}, {other.equations} equations in {other.variables} "
            f"unknowns, {'agrees' if agree else 'DISAGREES'}: local dimension "
            f"{other.local_dimension}, tangent dimension {other.tangent_dimension}"
            f"{_alike_text(other, alike)}"
        )
        if other.open:
            text += f"; its components are not known: {other.open}"
        found = {
            "formulation": formulation.removeprefix("formulation "),
            "tangent_dimension": other.tangent_dimension,
            "local_dimension": other.local_dimension,
            "agrees": agree,
        }
        return text, agree and not other.open, found
    return "no other formulation covers this mechanism", True, None


def _alike_text(other: MobilityReport, alike: Alike) -> str:
    """What was compared of the components."""
    if other.components is None or alike == "dimensions":
        return ""
    what = {"counts": "dimension", "degrees": "dimension and degree"}[alike]
    return f"; components of each {what} were counted"
