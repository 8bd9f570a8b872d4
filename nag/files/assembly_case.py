"""Cases that give the parts of a mechanism, not how they are assembled."""

from __future__ import annotations

from nag.files.case_table import ReadNumber, Table
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.graph import Mechanism

# The keys of each kind of case.
KEYS = {
    "dh": ("title", "kind", "parameters", "joint", "truth"),
    "framework": (
        "title",
        "kind",
        "parameters",
        "dimension",
        "points",
        "bars",
        "lengths",
        "squared_lengths",
        "point",
        "truth",
    ),
    "linkage": ("title", "kind", "parameters", "ground", "link", "point", "truth"),
}


def read_assembly(kind: str, top: Table, number: ReadNumber) -> AssemblyModel | Mechanism:
    """The model of all assemblies, or a mechanism where the case fixes how it is assembled."""
    if kind == "dh":
        from nag.files.dh_case import read_dh

        return read_dh(top, number)
    if kind == "framework":
        from nag.files.framework_case import read_framework

        return read_framework(top, number)
    from nag.files.linkage_case import read_linkage

    return read_linkage(top, number)
