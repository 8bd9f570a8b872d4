"""Cases of kind ``linkage``: planar links by their lengths or shapes."""

from __future__ import annotations

from fractions import Fraction

from nag.files.case_table import CaseTable, ReadNumber, wanted_text
from nag.mechanism.linkage import Link, Linkage, LinkageError, LinkageModel, Place, linkage_model

_LINK_KEYS = ("name", "pins", "length", "shape")


def read_linkage(top: CaseTable, number: ReadNumber) -> tuple[Linkage, LinkageModel]:
    """A linkage and its model."""
    ground = top.text("ground")
    for table in top.tables("link"):
        table.require({"name": wanted_text("name"), "pins": "a list of names of pins"})
    tables = [(t.text("name"), t) for t in top.tables("link")]
    try:
        links = [_read_link(name, table.called(name), number) for name, table in tables]
        linkage = Linkage(ground, tuple(links))
        return linkage, linkage_model(linkage)
    except LinkageError as error:
        # The last table of a name, as a repeated name is the fault of the later one.
        for name, table in reversed(tables):
            if name == error.link:
                table.called(name).fail(error.key, error.message)
        top.fail(error.key, error.message)


def _read_link(name: str, table: CaseTable, number: ReadNumber) -> Link:
    table.allow(_LINK_KEYS)
    pins = table.texts("pins", "names of pins")
    if ("length" in table.values) == ("shape" in table.values):
        found = "given beside 'shape'" if "length" in table.values else "missing"
        table.fail("length", f"is {found}; write a length for two pins, or a shape for more")
    if "shape" in table.values:
        return Link(name, tuple(pins), _read_shape(table, len(pins), number))
    if len(pins) != 2:
        table.fail("length", f"is for two pins, here are {len(pins)}; write their places: shape")
    with table.at("length"):
        length = number(table.values["length"])
    if length < 0:
        table.fail("length", "is negative; write a positive one")
    return Link(name, tuple(pins), ((Fraction(0), Fraction(0)), (length, Fraction(0))))


def _read_shape(table: CaseTable, count: int, number: ReadNumber) -> tuple[Place, ...]:
    shape = []
    for i, place in enumerate(table.items("shape", "places [x, y], one for each pin", count), 1):
        if not isinstance(place, list) or len(place) != 2:
            table.fail(f"shape {i}", "is no place; write [x, y] in the link's own frame")
        with table.at(f"shape {i}"):
            shape.append((number(place[0]), number(place[1])))
    return tuple(shape)
