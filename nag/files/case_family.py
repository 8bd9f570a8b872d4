"""The family of a case file: which parameters may have any values, and symmetries of solutions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from nag.algebra.family import Family
from nag.algebra.number import ComplexNumber, Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.rational_map import MapError, MapGroup, RationalMap
from nag.algebra.symmetric_family import FamilyMember, SymmetricFamily
from nag.algebra.tokens import is_name, nearest, quote
from nag.files.case_table import CaseTable, key_text, kind_of

Parse = Callable[[str, Sequence[str]], Polynomial]


def family_parameters(
    table: CaseTable, parameters: Mapping[str, Number | ComplexNumber]
) -> list[str]:
    """Names of the parameters that may have any values."""
    table.allow(("parameters", "plane", "solutions", "map"))
    names = table.texts("parameters", "names of parameters")
    for i, name in enumerate(names):
        if name not in parameters:
            table.fail(
                "parameters",
                f"unknown parameter {quote(name)}{nearest(name, parameters)}; "
                "write names from [parameters]",
            )
        if name in names[:i]:
            table.fail("parameters", f"{name!r} is there twice; name each parameter once")
    return names


def read_family(
    table: CaseTable, family: Family, values: Sequence[Number | ComplexNumber], parse: Parse
) -> FamilyMember:
    """The family with what its table says of it; ``parse`` reads polynomials in given names."""
    for key in ("plane", "map") if family.imaginary else ():
        if key in table.values:
            table.fail(key, "is not for a family with complex coefficients; leave it out")
    names = [*family.variables, *family.parameters]
    plane = table.table("plane")
    pairs = _pairs(plane, names)
    if plane.values:
        unknowns = [w for w, (i, _) in zip(plane.values, pairs, strict=True) if i < family.n]
        others = [w for w, (i, _) in zip(plane.values, pairs, strict=True) if i >= family.n]
    else:
        unknowns, others = list(family.variables), list(family.parameters)
    maps = [_map(t, unknowns, others, parse) for t in table.tables("map", "family.")]
    solutions = table.count("solutions", 1) if "solutions" in table.values else None
    try:
        group = MapGroup.generated(maps) if maps else MapGroup((), ((),))
    except MapError as error:
        table.fail("map", f"{error}; correct them or leave them out")
    try:
        symmetric = SymmetricFamily(family, group, tuple(pairs))
        _ = symmetric.family
    except MapError as error:
        table.fail("plane", str(error))
    return FamilyMember(symmetric, tuple(values), solutions)


def _pairs(plane: CaseTable, names: list[str]) -> list[tuple[int, int]]:
    pairs = []
    for name in plane.values:
        if not is_name(name):
            plane.fail(key_text(name), "cannot name a vector; use letters, digits and _")
        both = plane.texts(name, "names of its two coordinates", 2)
        for coordinate in both:
            if coordinate not in names:
                plane.fail(
                    name,
                    f"unknown coordinate {quote(coordinate)}{nearest(coordinate, names)}; write "
                    "variables, or parameters of the family",
                )
        pairs.append((names.index(both[0]), names.index(both[1])))
    return pairs


def _map(table: CaseTable, unknowns: list[str], others: list[str], parse: Parse) -> RationalMap:
    table.allow(("image",))
    wanted = '{ unknown = "polynomial" or ["numerator", "denominator"], ... }'
    images = table.get("image", dict, wanted)
    names = [*unknowns, *others]
    numerators = [Polynomial.variable(len(names), i) for i in range(len(unknowns))]
    denominators = [Polynomial.constant(len(names), 1)] * len(unknowns)
    for name, image in images.items():
        if name not in unknowns:
            table.fail(
                "image",
                f"unknown name {quote(name)}{nearest(name, unknowns)}; write unknowns, vectors "
                "where the family has a plane",
            )
        texts: Any = [image, "1"] if isinstance(image, str) else image
        if (
            not isinstance(texts, list)
            or len(texts) != 2
            or not all(isinstance(t, str) for t in texts)
        ):
            table.fail("image", f"{quote(name)} is {kind_of(image)}; write {wanted}")
        with table.at(f"image {name}"):
            top, bottom = (parse(t, names) for t in texts)
        if not bottom:
            table.fail("image", f"the denominator of {quote(name)} is zero; write another one")
        i = unknowns.index(name)
        numerators[i], denominators[i] = top, bottom
    return RationalMap(tuple(numerators), tuple(denominators))
