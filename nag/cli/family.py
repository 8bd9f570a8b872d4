"""The command ``nag family``: the isolated solutions of many members of a case's family."""

from __future__ import annotations

import argparse
import os
from collections import Counter
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    UsageError,
    add_reading,
    add_running,
    add_start,
    error_in_file,
    read_given_case,
)
from nag.cli.running import (
    CommandAnswer,
    answer_document,
    answer_of,
    chosen_run,
    name_case,
    write_arrays,
)

if TYPE_CHECKING:
    from nag.algebra.family import Family
    from nag.files.cases import Case
    from nag.solving.family_members import FamilySolutions


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag family``."""
    parser.add_argument(
        "case", metavar="CASE", help="case file (TOML) with a [family], or any system"
    )
    add_reading(parser)
    parser.add_argument(
        "--values",
        required=True,
        metavar="FILE",
        help="values of the parameters: a table (CSV) whose first line names them, a member a "
        "line; of a case without [family] it may name unknowns, which become parameters; or a "
        "NumPy array (.npy), shape (members, parameters)",
    )
    parser.add_argument(
        "--points", metavar="FILE", help="write all solutions to FILE as NumPy arrays (.npz)"
    )
    # The solutions of many members are no table.
    parser.set_defaults(points_endings=(".npz",))
    add_start(
        parser,
        "start system for the family at random parameters (default: auto, parameter where "
        "the number of solutions is known)",
    )
    add_running(parser)


def _family_by_columns(options: argparse.Namespace, case: Case) -> Family:
    """The family of a case that names none: in the parameters, or unknowns, of the values' table.

    Raises:
        UsageError: if there is no such table, or it names something else.
    """
    from nag.errors import NagError
    from nag.files.cases import as_unknowns, freed_system
    from nag.files.member_values import check_names, read_member_names
    from nag.solving.family_members import family_of

    system = case.system
    names = read_member_names(options.values)
    if system is not None and not system.nonzero and set(names) <= {*case.parameters, *case.unset}:
        system = freed_system(case, names)
    known = () if system is None or system.nonzero else system.own_variables
    if known and not os.fspath(options.values).endswith(".npy"):
        check_names(options.values, names, list(dict.fromkeys([*known, *case.parameters])))
    if system is None or not names or not set(names) <= set(known):
        raise UsageError(
            f"{options.case}: has no [family]; name the parameters that differ there, as in "
            '[family] parameters = ["a"], or have the first line of --values name parameters, or '
            "unknowns that are to be parameters"
        )
    # Those that the table has no values of are refused.
    as_unknowns(case, names).refuse_unset()
    unknowns = [name for name in known if name not in names]
    texts = system.text()[: len(system.polynomials) - system.imaginary]
    unit = system.variables[-1] if system.imaginary else None
    try:
        return family_of(texts, names, unknowns, unit)
    except NagError as error:
        raise error_in_file(options.case, error) from None


def run(options: argparse.Namespace) -> CommandAnswer:
    """All isolated solutions of many members."""
    case = read_given_case(options, exports=True)
    from nag.errors import StartError
    from nag.files.answer_export import fields_of
    from nag.files.member_values import read_member_values
    from nag.solving.family_members import check_values, solve_members
    from nag.solving.parameter import solve_generic
    from nag.text.table import count_text
    from nag.tracking.run import ENDED_EARLY

    member = case.family
    family = _family_by_columns(options, case) if member is None else member.symmetric.original
    own = [0] * len(family.parameters) if member is None else member.values
    given = [complex(v) for v in own]
    if options.progress is not None:
        options.progress(f"reading {os.path.basename(options.values)}", 0, 0)
    values = read_member_values(options.values, family.parameters, given)
    values = check_values(family, values)
    start, count = options.start, None if member is None else member.solutions
    if start == "auto" and count is not None:
        start = "parameter"

    def document_of(early: FamilySolutions) -> dict[str, Any]:
        rest = f"{len(values) - len(early)} of {len(values)} members were not reached"
        fields = fields_of(early) | {"notes": [ENDED_EARLY, rest]}
        return answer_document(options, name_case(case), fields, False)

    how = chosen_run(options, document_of)
    try:
        solved = solve_generic(family, start=start, count=count, run=how.without_found)
    except StartError as error:
        raise error_in_file(options.case, error) from None
    found = solve_members(solved, values, run=how)
    if options.points is not None:
        write_arrays(_arrays(found, family.parameters), options.points, "points")
    real = found.real_counts.tolist()
    general = len(solved.points)
    rows = [
        ("members", str(len(found))),
        ("solutions", f"{general} for general parameters" + _missing(solved.complete)),
        ("complete", f"{int(found.complete.sum())} of {len(found)} members"),
        ("real", _tally(real)),
    ]
    fewer = found.complete & (found.counts < general)
    if fewer.any():
        have = "has" if fewer.sum() == 1 else "have"
        text = f"{count_text(int(fewer.sum()), 'member')} {have} fewer than {general} solutions"
        rows.append(("fewer", text))
    alone = int(found.one_by_one.sum())
    if alone:
        was = "was solved by itself, as not all paths to it end"
        if alone > 1:
            was = "were solved one by one, as not all paths to them end"
        rows.append(("one by one", f"{count_text(alone, 'member')} {was} at simple solutions"))
    infinite = found.positive_dimensional
    if infinite.any():
        have = "has" if infinite.sum() == 1 else "have"
        text = f"{found.name_members(infinite)} {have} a solution set of positive dimension besides"
        rows.append(("infinite", text))
    if not found.complete.all():
        rows.append(("open", found.name_members(~found.complete)))
    if options.points is None and options.json is None:
        rows.append(("written", "nowhere: --points FILE writes all solutions"))
    rows += [("note", note) for note in solved.notes]
    complete = bool(found.complete.all())
    fields = fields_of(found)
    if options.points is not None:
        fields["arrays"] = os.path.basename(options.points)
    return answer_of(options, name_case(case), [rows], [], fields, complete)


def _missing(complete: bool) -> str:
    return "" if complete else "; that these are all is not known"


def _tally(real: list[int]) -> str:
    from nag.text.table import count_text

    counts = sorted(Counter(real).items())
    return ", ".join(f"{n} for {count_text(members, 'member')}" for n, members in counts)


def _arrays(found: FamilySolutions, parameters: tuple[str, ...]) -> dict[str, Any]:
    """The arrays of ``--points``, by name."""
    import numpy as np

    from nag.solving.family_members import ARRAYS

    return {
        "variables": np.array(found.variables),
        "parameters": np.array(parameters),
        **{name: getattr(found, name) for name in ("values", *ARRAYS)},
    }
