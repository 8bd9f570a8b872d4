"""Systems as HomotopyContinuation.jl takes them: variables by ``@var``, equations in one list."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from nag.algebra.tokens import quote
from nag.files.case_table import MAX_ENTRIES
from nag.files.formats.source import GivenSystem, Passage, SourceFile, check_names

_COMMENT = re.compile(r"#=.*?(?:=#|\Z)|#[^\n]*", re.DOTALL)
_VARIABLES = re.compile(r"@(?:poly)?var(?=[\s(])")
# Statements begin behind a semicolon as well.
_RECOGNISED = re.compile(rf"(?<![^\s;]){_VARIABLES.pattern}")
# What a macro takes in parentheses has commas between.
_IN_PARENTHESES = re.compile(r"\(([^()]*)\)")
_ITEM = re.compile(r"\S+")
_RANGE = re.compile(r"(\w+)\[(?:([0-9]{1,6}):)?([0-9]{1,6})\]")
# A list, maybe given to a function, maybe named.
_LIST = re.compile(r"(?:\w+\s*=\s*)?((?:\w+\s*\(\s*)*)\[")
_DEFINED = re.compile(r"(\w+)\s*=\s*")
_CALL = re.compile(r"(?<!\w)(?!(?:sqrt|sin|cos)\b)[A-Za-z_]\w*[!.]?\s*\(")
_OF_SYSTEM = re.compile(r"(?<![\w.!])variables\s*=(?!=)\s*")
_PARAMETERS = re.compile(r"(?<![\w.!])parameters\s*=(?!=)\s*")
# Between a system's equations and its parameters: its variables, a list or the name of one.
_SECOND_LIST = re.compile(
    r"\s*,\s*(?:\[[^=\[\]]*(?:\[[0-9]+\][^=\[\]]*)*+\]|\w+)\s*,\s*(?!\s|\w+\s*=)"
)
_INDEXED_NAME = re.compile(r"[^\W\d]\w*(?:\[[0-9]+\])?")
# 2x and 2(x + 1), but not 2e5.
_FACTOR = re.compile(r"(?<![\w.])([0-9]+(?:\.[0-9]*)?)(?=[A-Za-z_(])(?!e[-+]?[0-9])")


def recognise(text: str) -> bool:
    """Whether a text declares variables as HomotopyContinuation.jl does."""
    return _RECOGNISED.search(_COMMENT.sub("", text)) is not None


def read(source: SourceFile) -> GivenSystem:
    """The system of the variables and the one list of equations in a text in Julia.

    What ``parameters = [...]`` lists has values where the file is read, not in it. What else is
    called or computed is left out.

    Raises:
        CaseError: if no variables are declared, or there is not one list of equations.
    """
    source = _split_semicolons(source.without(_COMMENT))
    source.refuse_towers()
    names: list[Passage] = []
    lists: list[tuple[bool, Passage]] = []
    definitions: dict[str, Passage] = {}
    for statement in source.statements(separator="\n"):
        declared = _VARIABLES.match(statement.text)
        found = _LIST.match(statement.text)
        defined = _DEFINED.match(statement.text)
        if declared:
            names += _read_names(source, statement.part(declared.end(), len(statement.text)))
        elif found:
            inside = _unwrap_list(source, statement.part(found.end() - 1, len(statement.text)))
            lists.append((found[1].startswith("System"), inside))
        elif defined and not _CALL.search(statement.text, defined.end()):
            definitions[defined[1]] = _write_out(statement.part(defined.end(), len(statement.text)))
    if not names:
        source.fail(0, "there are no variables; write @var x y")
    # Of lists of values and of equations, these are the ones that a system is made of.
    lists = [each for each in lists if each[0]] or lists
    if not lists:
        source.fail(len(source.text.rstrip()), "there is no list of equations; write [..., ...]")
    if len(lists) > 1:
        source.fail(lists[1][1].offset, "a second list of equations; leave one in the file")
    equations = tuple(_write_out(each) for each in source.statements(lists[0][1], ","))
    for text in (*equations, *definitions.values()):
        called = _CALL.search(text.text) or re.search(r"\bfor\b", text.text)
        if called is not None:
            function = called[0].rstrip("( \t")
            message = f"{quote(function)} is not worked out here; write out what it gives"
            source.fail(text.offset + called.start(), message)
    declared_names = check_names(source, names)
    unset = _parameters(source, declared_names, lists[0][1])
    used = _find_used_names(equations, definitions) | _named_variables(source)
    # Others are of no interest to it.
    declared_names = (
        tuple(n for n in declared_names if {n, n.partition("[")[0]} & used or n in unset)
        or declared_names
    )
    # They come last, as where they are unknowns they are those of a family.
    variables = (*(n for n in declared_names if n not in unset), *unset)
    return GivenSystem(
        variables,
        equations,
        {},
        definitions,
        imaginary=("im",),
        unset=tuple(unset),
    )


def _find_used_names(equations: Sequence[Passage], definitions: Mapping[str, Passage]) -> set[str]:
    """The names in equations, and in what these are made of."""
    used, front = set[str](), list(equations)
    while front:
        names = set(_INDEXED_NAME.findall(front.pop().text)) - used
        used |= names
        front += [definitions[name] for name in names if name in definitions]
    return used


def _named_variables(source: SourceFile) -> set[str]:
    """The names that ``variables = ...`` lists."""
    found = [
        _read_listed_names(source.text, given.end()) for given in _OF_SYSTEM.finditer(source.text)
    ]
    return set().union(*found)


def _parameters(source: SourceFile, variables: Sequence[str], equations: Passage) -> list[str]:
    """The variables that are parameters of a system, as its ``parameters = ...`` or third list say.

    They are named by themselves, as p of p[1:3], or by a list that has a name.
    """
    starts = [given.end() for given in _PARAMETERS.finditer(source.text)]
    behind = equations.offset + len(equations.text)
    third = _SECOND_LIST.match(source.text, source.text.find("]", behind) + 1)
    starts += [] if third is None else [third.end()]
    found: list[str] = []
    for start in starts:
        names = _read_listed_names(source.text, start)
        for name in [*names]:
            named = re.search(rf"^[ \t]*{name}\s*=(?!=)\s*(?=\[)", source.text, re.MULTILINE)
            names |= _read_listed_names(source.text, named.end()) if named else set()
        found += [v for v in variables if v not in found and {v, v.partition("[")[0]} & names]
    return found


def _read_listed_names(text: str, start: int) -> set[str]:
    """The names in what begins at ``start``, to a comma, a line's end or a bracket's."""
    end, depth = start, 0
    while end < len(text) and (depth or text[end] not in ",)\n"):
        depth += (text[end] in "([{") - (text[end] in ")]}")
        end += 1
    return {m[0] for m in _INDEXED_NAME.finditer(re.sub(r"\s", "", text[start:end]))}


def _split_semicolons(source: SourceFile) -> SourceFile:
    """The same with a line's end for each semicolon, or a comma within brackets."""
    text, depth = [], 0
    for c in source.text:
        depth += (c in "([{") - (c in ")]}")
        text.append(("," if depth > 0 else "\n") if c == ";" else c)
    return SourceFile(source.file, "".join(text))


def _read_names(source: SourceFile, listed: Passage) -> list[Passage]:
    """The names that ``x y[1:3]`` declares."""
    found = []
    enclosed = _IN_PARENTHESES.fullmatch(listed.text)
    if enclosed is not None:
        listed = Passage(enclosed[1].replace(",", " "), listed.offset + enclosed.start(1))
    for item in _ITEM.finditer(listed.text):
        name = listed.part(*item.span())
        bounds = _RANGE.fullmatch(name.text)
        if bounds is None:
            if name.text.endswith(","):
                source.fail(name.offset, "names have blanks between them; write @var x y")
            if "[" in name.text:
                message = f"{quote(name.text)} is not read; write indices as in x[1:3]"
                source.fail(name.offset, message)
            found.append(name)
            continue
        first, last = int(bounds[2] or bounds[3]), int(bounds[3])
        if last - first >= MAX_ENTRIES:
            source.fail(name.offset, f"more than {MAX_ENTRIES} variables; at most that many")
        found += [Passage(f"{bounds[1]}[{k}]", name.offset) for k in range(first, last + 1)]
    return found


def _unwrap_list(source: SourceFile, listed: Passage) -> Passage:
    """What is within the brackets with which a text begins."""
    depth = 0
    for i, c in enumerate(listed.text):
        depth += (c in "([{") - (c in ")]}")
        if depth == 0:
            return listed.part(1, i)
    source.fail(listed.offset, "'[' is never closed; write its ']'")


def _write_out(text: Passage) -> Passage:
    """The same with every product and quotient written as such."""
    plain = text.text.replace("//", " /")
    return Passage(_FACTOR.sub(r"\1*", plain), text.offset)
