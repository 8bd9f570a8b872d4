"""A mechanism that is given as an argument, or what stands in its place."""

from __future__ import annotations

from typing import Any

from nag.algebra.given import is_a, shown
from nag.errors import MechanismError
from nag.mechanism.graph import Mechanism


def check_mechanism(given: Any, others: str = "") -> None:
    """Make sure that a mechanism is given.

    Args:
        others: what may be given as well, for the message.

    Raises:
        MechanismError: if something else is; the message says how to make a mechanism of it.
    """
    if isinstance(given, Mechanism):
        return
    if is_a(given, "networkx", "Graph"):
        what = "a networkx graph is given; make it a mechanism first: "
        what += "nag.Mechanism.from_graph(graph, ground=...)"
    elif is_a(given, "nag.files.cases", "Case"):
        what = (
            f"a nag.Case is given; give its mechanism, case.mechanism{others and ', or '}{others}"
        )
    else:
        what = f"{shown(given)} is given; give a nag.Mechanism{others and ', or '}{others}"
    raise MechanismError(f"mechanism: {what}")
