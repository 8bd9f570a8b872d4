"""Input files of Bertini 1: sections CONFIG and INPUT of declarations and definitions.

The grammar is that of chapter 3 of Bates, Hauenstein, Sommese and Wampler, Numerically Solving
Polynomial Systems with Bertini (2013). What CONFIG says is for Bertini's tracker and is left out.
"""

from __future__ import annotations

import re

from nag.algebra.tokens import quote
from nag.files.formats.source import GivenSystem, Passage, SourceFile, check_names

_COMMENT = re.compile(r"%[^\n]*")
# A line of its own, or the first word of one.
_SECTION = re.compile(
    r"(?:^|(?<=;))[ \t]*(?:(CONFIG|INPUT)(?:[ \t]*;|[ \t]*$|[ \t]+(?=[A-Za-z_]))"
    r"|(END)[ \t]*(?:;|$))",
    re.MULTILINE | re.IGNORECASE,
)
_RECOGNISED = re.compile(
    r"^[ \t]*(?:CONFIG|INPUT)(?:[ \t]*;?[ \t]*$|[ \t]+(?:(?:hom_)?variable|\w+[ \t]*:))"
    r"|^[ \t]*(?:hom_)?variable_group\b",
    re.MULTILINE | re.IGNORECASE,
)
_WORD = re.compile(r"\s*([A-Za-z_]+)\b(?!\s*=)")
_ASSIGNED = re.compile(r"\s*([^\W\d][\w\[\],]*)\s*=(?!=)")
IMAGINARY = ("I", "i")
_DECLARED = (
    "variable_group",
    "hom_variable_group",
    "variable",
    "function",
    "constant",
    "parameter",
)
_REFUSED = {
    "pathvariable": "a homotopy of the user's own is not read; write the system at its end",
    "random": "random numbers are not read; write the constant's value",
    "random_real": "random numbers are not read; write the constant's value",
    "definedsubfunction": "subfunctions with arguments are not read; write them out",
}


# Where a statement is not ended before the next line begins another one.
_UNENDED = re.compile(
    r"(?<=\S)[ \t]*\n\s*+(?:(?:"
    + "|".join((*_DECLARED, *_REFUSED))
    + r")\b|[^\W\d][\w\[\],]*[ \t]*=(?!=))",
    re.IGNORECASE,
)


def recognise(text: str) -> bool:
    """Whether a text has what only an input file of Bertini has."""
    return _RECOGNISED.search(_COMMENT.sub("", text)) is not None


def read(source: SourceFile) -> GivenSystem:
    """The system of an input file of Bertini.

    A ``hom_variable_group`` gets an affine patch, a linear form of the group that is 1.

    Raises:
        CaseError: if something is declared twice, never or of a kind that is not read.
    """
    source = source.without(_COMMENT)
    declared: dict[str, list[list[Passage]]] = {kind: [] for kind in _DECLARED}
    assigned: dict[str, Passage] = {}
    for statement in source.statements(_input_section(source)):
        unended = _UNENDED.search(statement.text)
        if unended is not None:
            source.fail(statement.offset + unended.start(), "';' is missing here; write it")
        kind = (_WORD.match(statement.text) or [""])[0].strip().lower()
        if kind in _REFUSED:
            source.fail(statement.offset, f"{quote(kind)}: {_REFUSED[kind]}")
        if kind == "parameter":
            _read_parameter(source, statement, declared, assigned)
            continue
        if kind in _DECLARED:
            listed = statement.part(len(kind), len(statement.text))
            declared[kind].append(source.statements(listed, ","))
            continue
        _assign(source, statement, assigned)
    return _collect_system(source, declared, assigned)


def _input_section(source: SourceFile) -> Passage:
    marks = list(_SECTION.finditer(source.text))
    names = [(m[1] or m[2]).upper() for m in marks]
    begins = [m.end() for m, name in zip(marks, names, strict=True) if name == "INPUT"]
    if not begins:
        config = [m for m, name in zip(marks, names, strict=True) if name == "CONFIG"]
        if config:
            source.fail(config[0].start(), "CONFIG without INPUT; write the line INPUT after it")
        begins = [0]
    end = next((m.start() for m in marks if m[2] and m.start() >= begins[0]), None)
    return Passage(source.text[begins[0] : end], begins[0])


def _read_parameter(
    source: SourceFile,
    statement: Passage,
    declared: dict[str, list[list[Passage]]],
    assigned: dict[str, Passage],
) -> None:
    """``parameter a = 3`` (a number), and ``parameter a`` with its value elsewhere, or nowhere."""
    listed = statement.part(len("parameter"), len(statement.text))
    for item in source.statements(listed, ","):
        name = item
        if "=" in item.text:
            name = _assign(source, item, assigned)
        declared["parameter"].append([name])


def _assign(source: SourceFile, statement: Passage, assigned: dict[str, Passage]) -> Passage:
    match = _ASSIGNED.match(statement.text)
    if match is None:
        known = "variable_group, function, constant, or a name, '=' and an expression"
        source.fail(statement.offset, f"{quote(statement.text)} is not understood; write {known}")
    name = statement.part(match.start(1), match.end(1))
    if name.text in assigned:
        source.fail(name.offset, f"{quote(name.text)} is defined twice; define it once")
    assigned[name.text] = statement.part(match.end(), len(statement.text))
    return name


def _collect_system(
    source: SourceFile, declared: dict[str, list[list[Passage]]], assigned: dict[str, Passage]
) -> GivenSystem:
    projective = declared["hom_variable_group"]
    groups = [*declared["variable_group"], *declared["variable"], *projective]
    groups = sorted((g for g in groups if g), key=lambda group: group[0].offset)
    variables = check_names(source, (n for group in groups for n in group))
    functions = [name for names in declared["function"] for name in names]
    if not variables:
        source.fail(0, "no variable_group is declared; write one with the variables")
    if not functions:
        source.fail(0, "no function is declared; write 'function f, g;' and what they are")
    constants = [name for names in declared["constant"] for name in names]
    parameters = [name for names in declared["parameter"] for name in names]
    unset = [name for name in parameters if name.text not in assigned]
    # Those that have no value are unknown.
    variables = check_names(source, (*(n for group in groups for n in group), *unset))
    constants += [name for name in parameters if name not in unset]
    for name in (*functions, *constants):
        if name.text not in assigned:
            value = "1" if name in constants else f"{variables[0]} - 1"
            message = "is declared and never defined; define it, as in"
            source.fail(name.offset, f"{quote(name.text)} {message} {name.text} = {value};")
    for name, text in assigned.items():
        if name in variables:
            source.fail(text.offset, f"{quote(name)} is a variable; it has no definition")
    named = {name.text for name in constants}
    called = {name.text for name in functions}
    check_names(source, functions)
    return GivenSystem(
        variables,
        tuple(assigned[name.text] for name in functions),
        {name: text for name, text in assigned.items() if name in named},
        {name: text for name, text in assigned.items() if name not in named | called},
        tuple(tuple(n.text for n in group) for group in groups),
        tuple(tuple(n.text for n in group) for group in projective),
        IMAGINARY,
        unset=tuple(name.text for name in unset),
    )
