"""The parameters of a case: names for numbers, which may refer to each other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from graphlib import CycleError, TopologicalSorter
from types import MappingProxyType

from nag.algebra.bounded import Budget
from nag.algebra.expression import parse_number
from nag.algebra.number import Number
from nag.algebra.tokens import is_name, names_in, nearest, quote
from nag.files.case_table import Table, kind_of, shown


def read_parameters(table: Table, budget: Budget) -> Mapping[str, Number]:
    """Values of the parameters, which may refer to each other in any order but not in circles."""
    uses = {}
    for name, value in table.values.items():
        if not is_name(name):
            table.fail(
                shown(name), "cannot name a parameter; use letters, digits and _, not a function"
            )
        if not isinstance(value, str | int | Decimal | Fraction) or isinstance(value, bool):
            table.fail(name, f'is {kind_of(value)}; write a number or an expression like "5/6"')
        names = names_in(value) if isinstance(value, str) else frozenset()
        for unknown in sorted(names - table.values.keys()):
            table.fail(
                name,
                f"unknown name {quote(unknown)}{nearest(unknown, table.values)}; write numbers, "
                "other parameters, sqrt, sin, cos or pi",
            )
        uses[name] = sorted(names)
    try:
        order = list(TopologicalSorter(uses).static_order())
    except CycleError as error:
        circle = [str(name) for name in reversed(error.args[1])]
        table.fail(circle[0], f"refers to itself: {' -> '.join(circle[:10])}; break the circle")
    values: dict[str, Number] = {}
    for name in order:
        with table.at(name):
            values[name] = parse_number(table.values[name], values, budget)
    return MappingProxyType({name: values[name] for name in table.values})


def with_values(table: Table, values: Mapping[str, str | Number]) -> Table:
    """The table of parameters with other values for some of them."""
    for name in values:
        if name not in table.values:
            known = (
                f"the parameters are {', '.join(table.values)}" if table.values else "it has none"
            )
            table.fail(
                shown(name), f"is no parameter of the case{nearest(name, table.values)}; {known}"
            )
    return replace(table, values={**table.values, **values})
