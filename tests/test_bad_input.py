"""Every mistake in a case file is answered with one line: file, table, key, fault and mend."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import pytest

from nag.cli import main
from nag.files.cases import CaseError, read_case

SYSTEM = """\
title = "t"
kind = "system"
variables = ["x", "y"]
equations = ["x^2 + y^2 - 1"]
"""
MECHANISM = """\
title = "t"
kind = "mechanism"
ground = "A"
"""
FRAMEWORK = """\
title = "t"
kind = "framework"
bars = [["A", "B"], ["B", "C"], ["C", "A"]]
[points]
A = [0, 0]
B = [1, 0]
C = [0, 1]
"""
POINT = '[[point]]\nname = "p"\nat = { x = 1, y = 0 }\n'
REFERENCE = '[truth.reference]\ndimension = 1\ntangent_dimension = 1\nsource = "s"\n'
TRUTH = '[[truth.component]]\ndimension = 1\ndegree = 2\nsource = "s"\n'
BODY = '[[body]]\nname = "B"\n'


def equation(text: str) -> str:
    return SYSTEM.replace("x^2 + y^2 - 1", text)


def parameters(text: str) -> str:
    return SYSTEM + "[parameters]\n" + text


def joint(**changes: str | None) -> str:
    """A revolute joint J between A and B, with some values in TOML changed or (None) left out."""
    values = {
        "name": '"J"',
        "type": '"revolute"',
        "bodies": '["A", "B"]',
        "point": "[0, 0, 0]",
        "axis": "[0, 0, 1]",
    } | changes
    lines = [f"{key} = {value}\n" for key, value in values.items() if value is not None]
    return "[[joint]]\n" + "".join(lines)


def mechanism(*joints: str, more: str = "") -> str:
    return MECHANISM + "".join(joints or [joint()]) + more


BROKEN: dict[str, tuple[str | bytes, str, str]] = {
    # name: (content, place, part of the message)
    "empty": ("", "title and kind", "are missing; write a text"),
    "only a kind": (
        'kind = "system"',
        "title, variables and equations",
        "a list of equations (`nag init system` prints a whole case)",
    ),
    "only a linkage's title": (
        'title = "t"\nkind = "linkage"',
        "ground and link",
        "are missing; write a text in quotes: ground = ",
    ),
    "neither points nor bars": (
        'title = "t"\nkind = "framework"',
        "points and bars",
        "are missing",
    ),
    "joint without a type and bodies": (
        mechanism(joint(type=None, bodies=None)),
        "[[joint]] 1: type and bodies",
        "are missing",
    ),
    "joint without a point and an axis": (
        mechanism(joint(point=None, axis=None)),
        "[[joint]] 1 'J': point and axis",
        "are missing; write a list of 3 numbers",
    ),
    "missing title": (SYSTEM.replace('title = "t"\n', ""), "title", "is missing; write a text"),
    "missing kind": (SYSTEM.replace('kind = "system"\n', ""), "kind", "is missing"),
    "missing variables": (
        SYSTEM.replace('variables = ["x", "y"]\n', ""),
        "variables",
        "is missing; write a list of names",
    ),
    "missing equations": (
        SYSTEM.replace("equations", "#"),
        "equations",
        "is missing; write a list of equations",
    ),
    "title of another type": (SYSTEM.replace('"t"', "3"), "title", "is a whole number; write"),
    "title in two lines": (SYSTEM.replace('"t"', '"a\\nb"'), "title", "line break"),
    "blank title": (SYSTEM.replace('"t"', '"  "'), "title", "is empty; write"),
    "unknown kind": (SYSTEM.replace("system", "sistem"), "kind", "'sistem' is no kind of case"),
    "kind is a list": (SYSTEM.replace('"system"', '["system"]'), "kind", "is a list; write"),
    "unknown key": (SYSTEM + "equation = 3\n", "equation", "(did you mean 'equations'?)"),
    "key of the other kind": (SYSTEM + 'ground = "A"\n', "ground", "kind 'mechanism'; leave it"),
    "equations as text": (
        SYSTEM.replace('["x^2 + y^2 - 1"]', '"x"'),
        "equations",
        "is a text; write a list",
    ),
    "no equations": (SYSTEM.replace('["x^2 + y^2 - 1"]', "[]"), "equations", "is empty; write"),
    "equation as number": (
        SYSTEM.replace('"x^2 + y^2 - 1"', "3"),
        "equations 1",
        "is a whole number; write equations in quotes",
    ),
    "no variables": (SYSTEM.replace('"x", "y"', ""), "variables", "is empty; write"),
    "variable twice": (SYSTEM.replace('"y"', '"x"'), "variables 2", "'x' is there twice"),
    "variable named pi": (SYSTEM.replace('"y"', '"pi"'), "variables 2", "'pi' cannot name"),
    "variable with a space": (SYSTEM.replace('"y"', '"x y"'), "variables 2", "'x y' cannot name"),
    "variable and parameter": (parameters("x = 1"), "variables 1", "'x' is a parameter as well"),
    "code": (equation("__import__('os')"), "equations 1", "column 12"),
    "unknown variable": (equation("x + z"), "equations 1", "column 5: unknown name 'z'"),
    "implicit product": (equation("2x"), "equations 1", "write '*' between them"),
    "two equals signs": (equation("x = y = 1"), "equations 1", "all but one '='"),
    "empty equation": (equation(""), "equations 1", "the expression is empty"),
    "unbalanced": (equation("(x + y"), "equations 1", "'(' is never closed"),
    "deep": (equation("(" * 5000 + "x" + ")" * 5000), "equations 1", "nested more than 50 deep"),
    "division by zero": (equation("x/(1 - 1)"), "equations 1", "division by zero"),
    "division by a variable": (equation("1/x"), "equations 1", "the divisor contains a variable"),
    "square root of the unit": (equation("sqrt(I)*x"), "equations 1", "sqrt of a complex number"),
    "large exponent": (equation("x^10^9"), "equations 1", "exponent 1000000000 is too large"),
    "powers of powers": (equation("(((x+y)^50)^50)"), "equations 1", "exponent 50 is too large"),
    "dense power": (
        equation("(x + y + 1)^300"),
        "equations 1",
        "operations to multiply everything out",
    ),
    "dense product": (
        equation("*".join(["(x+y+1)"] * 900)),
        "equations 1",
        "operations to multiply everything out",
    ),
    "long decimal": (equation("1e400000*x"), "equations 1", "has too many digits"),
    "small power": (equation("10^-10^9*x"), "equations 1", "exponent -1000000000 is too large"),
    "beyond double": (equation("1e400*x"), "equations 1", "of the order 1e400"),
    "many terms": (equation("+".join(["x"] * 100000)), "equations 1", "characters long"),
    "long name": (equation("a" * 50000), "equations 1", "unknown name 'aaa"),
    "nested lists": (SYSTEM + "a = " + "[" * 3000, "", "nested too deep; write them flat"),
    "dotted key": ("a" + ".a" * 100000 + " = 1", "line 1", "more than 50 dots"),
    "UTF-16": (("\ufeff" + SYSTEM).encode("utf-16-le"), "line 1", "is not UTF-8; save it as UTF-8"),
    "Latin-1": (SYSTEM.replace('"t"', '"\u00e9"').encode("latin-1"), "line 1", "byte 0xe9"),
    "no TOML": (SYSTEM + "a ==\n", "", "is not valid TOML: Invalid value (at line 5, column 4)"),
    "key twice": (SYSTEM + 'title = "u"\n', "", "is not valid TOML: Cannot overwrite a value"),
    "binary": (bytes(range(128)), "", "is not valid TOML"),
    "long line": (SYSTEM + "#" + "a" * 10_000_000, "", "is longer than 500000 bytes"),
    "long file": (SYSTEM * 10_000, "", "is longer than 500000 bytes"),
    "nan": (parameters("a = nan"), "[parameters]: a", "NaN is no number; write a finite number"),
    "inf": (parameters("a = -inf"), "[parameters]: a", "-Infinity is no number; write a finite"),
    "far apart": (
        FRAMEWORK.replace("B = [1, 0]", 'B = [1, "1e290"]'),
        "points",
        "not all are between 1e-50 and 1e50",
    ),
    "long type": (
        MECHANISM + joint(type='"' + "r" * 2000 + '"'),
        "",
        "joint type '" + "r" * 37 + "...'",
    ),
    "long exponent": (parameters("a = 1e-" + "9" * 20), "", "exponent has too many digits"),
    "long integer": (parameters("a = " + "9" * 9000), "", "number of more than 4300 digits"),
    "long hexadecimal": (parameters("a = 0x" + "f" * 9000), "[parameters]: a", "digits arises"),
    "truth value": (parameters("a = true"), "[parameters]: a", "is a truth value; write a number"),
    "date": (parameters("a = 2020-01-01"), "[parameters]: a", "is a date or time; write"),
    "cycle": (
        parameters('a = "b"\nb = "c"\nc = "a"'),
        "[parameters]: a",
        "refers to itself: a -> b -> c -> a; break the circle",
    ),
    "itself": (parameters('a = "a + 1"'), "[parameters]: a", "refers to itself: a -> a"),
    "unknown parameter": (
        parameters('length = 1\na = "lenght"'),
        "[parameters]: a",
        "unknown name 'lenght' (did you mean 'length'?)",
    ),
    "variable in a parameter": (parameters('a = "x"'), "[parameters]: a", "unknown name 'x'"),
    "function as parameter": (parameters("sin = 1"), "[parameters]: 'sin'", "cannot name"),
    "parameters as number": (SYSTEM + "parameters = 3\n", "parameters", "write a table"),
    "squares of squares": (
        parameters("p0 = 3\n" + "".join(f'p{i + 1} = "p{i}*p{i}"\n' for i in range(200))),
        "[parameters]: p10",
        "of the order 1e489 arises; scale the numbers",
    ),
    "irrational sums of products": (
        parameters(
            'p0 = "pi"\n' + "".join(f'p{i + 1} = "p{i}*p{i} + sqrt(2)"\n' for i in range(200))
        ),
        "[parameters]: p6",
        "irrational number of more than",
    ),
    "sums of roots beyond doubles": (
        parameters(
            'p0 = "sqrt(3)"\n' + "".join(f'p{i + 1} = "p{i}*p{i} + sqrt(2)"\n' for i in range(200))
        ),
        "[parameters]: p10",
        "between 1e-300 and 1e300",
    ),
    "point without a coordinate": (
        SYSTEM + POINT.replace(", y = 0", ""),
        "[[point]] 1 'p': at: y",
        "is missing; give a number",
    ),
    "point with another coordinate": (
        SYSTEM + POINT.replace("y = 0", "y = 0, z = 1"),
        "[[point]] 1 'p': at: z",
        "unknown key",
    ),
    "point as list": (
        SYSTEM + POINT.replace("{ x = 1, y = 0 }", "[1, 0]"),
        "[[point]] 1 'p': at",
        "is a list; write { variable = number, ... }",
    ),
    "point without a name": (SYSTEM + POINT.replace("name", "#"), "[[point]] 1: name", "missing"),
    "points of one name": (SYSTEM + POINT + POINT, "[[point]] 2 'p': name", "another point"),
    "point of expressions": (
        SYSTEM + POINT.replace("y = 0", 'y = "1/0"'),
        "[[point]] 1 'p': at: y",
        "division by zero",
    ),
    "group missing": (SYSTEM + 'groups = [["x"]]\n', "groups", "'y' is in no group"),
    "group unknown": (SYSTEM + 'groups = [["x", "z"]]\n', "groups 1", "unknown variable 'z'"),
    "group of text": (SYSTEM + 'groups = ["x"]\n', "groups 1", "is no list of names"),
    "group twice": (SYSTEM + 'groups = [["x"], ["y", "x"]]\n', "groups 2", "in a group already"),
    "truth without a degree": (
        SYSTEM + TRUTH.replace("degree", "#"),
        "[[truth.component]] 1: degree",
        "is missing; write a whole number from 1 up",
    ),
    "truth without a source": (
        SYSTEM + TRUTH.replace("source", "#"),
        "[[truth.component]] 1: source",
        "is missing",
    ),
    "truth of negative dimension": (
        SYSTEM + TRUTH.replace("dimension = 1", "dimension = -1"),
        "[[truth.component]] 1: dimension",
        "is -1; write a whole number from 0 up",
    ),
    "truth of broken degree": (
        SYSTEM + TRUTH.replace("degree = 2", "degree = 2.5"),
        "[[truth.component]] 1: degree",
        "is a decimal number",
    ),
    "truth with a formulation": (
        SYSTEM + TRUTH + 'formulation = "E"\n',
        "[[truth.component]] 1: formulation",
        "a system has no formulation",
    ),
    "truth of unknown formulation": (
        mechanism(more=TRUTH + 'formulation = "D"\n'),
        "[[truth.component]] 1: formulation",
        "'D' is unknown; write 'E' or 'H'",
    ),
    "truth of texts": (
        SYSTEM + TRUTH + 'multidegree = ["1"]\n',
        "[[truth.component]] 1: multidegree",
        "write whole numbers",
    ),
    "truth of a reference that there is not": (
        SYSTEM + REFERENCE,
        "[truth]: reference",
        "there is no reference configuration; give components instead",
    ),
    "truth of a reference without a source": (
        mechanism(more=REFERENCE.replace("source", "#")),
        "[truth][reference]: source",
        "is missing",
    ),
    "truth of a tangent space that is too small": (
        mechanism(more=REFERENCE.replace("tangent_dimension = 1", "tangent_dimension = 0")),
        "[truth][reference]: tangent_dimension",
        "is 0; it is as much as the dimension, or more",
    ),
    "truth as number": (SYSTEM + "truth = 3\n", "truth", "is a whole number; write a table"),
    "no joint": (MECHANISM, "joint", "is missing; write a table [[joint]]"),
    "joint as number": (MECHANISM + "joint = 3\n", "joint", "is a whole number; write"),
    "joint as list of numbers": (MECHANISM + "joint = [3]\n", "joint", "holds a whole number"),
    "many joints": (mechanism(*[joint()] * 3000), "joint", "has 3000 entries; at most 500"),
    "no ground": (
        mechanism().replace('ground = "A"\n', ""),
        "ground",
        "is missing; write a text in quotes",
    ),
    "unknown ground": (mechanism().replace('"A"\n[[', '"Z"\n[['), "ground", "'Z'"),
    "joint without a name": (mechanism(joint(name=None)), "[[joint]] 1: name", "is missing"),
    "joint without an axis": (mechanism(joint(axis=None)), "[[joint]] 1 'J': axis", "is missing"),
    "joint with an unknown key": (
        mechanism(joint(axs="[0, 0, 1]", axis=None)),
        "[[joint]] 1 'J': axs",
        "(did you mean 'axis'?)",
    ),
    "unknown joint type": (
        mechanism(joint(type='"hinges"')),
        "[[joint]] 1 'J': type",
        "'hinges' is unknown; use one of",
    ),
    "axis of length zero": (
        mechanism(joint(axis='[0, "1 - 1", "sqrt(2) - sqrt(2)"]')),
        "[[joint]] 1 'J': axis",
        "length zero",
    ),
    "axis in the plane": (
        mechanism(joint(axis="[0, 1]")),
        "[[joint]] 1 'J': axis",
        "has 2 entries; write a list of 3 numbers",
    ),
    "axis of nan": (mechanism(joint(axis="[0, 1, nan]")), "[[joint]] 1 'J': axis 3", "finite"),
    "axis with a fault": (
        mechanism(joint(axis='[0, 1, "1/0"]')),
        "[[joint]] 1 'J': axis 3",
        "column 2: division by zero",
    ),
    "point as number": (mechanism(joint(point="3")), "[[joint]] 1 'J': point", "write a list of 3"),
    "point with an unknown name": (
        mechanism(joint(point='["l", 0, 0]')),
        "[[joint]] 1 'J': point 1",
        "unknown name 'l'; parameters here: none",
    ),
    "three bodies": (
        mechanism(joint(bodies='["A", "B", "C"]')),
        "[[joint]] 1 'J': bodies",
        "has 3 entries; write a list of 2",
    ),
    "body as number": (
        mechanism(joint(bodies='["A", 1]')),
        "[[joint]] 1 'J': bodies 2",
        "is a whole number",
    ),
    "body of no name": (
        mechanism(joint(bodies='["A", "\\n"]')),
        "[[joint]] 1 'J': bodies",
        "is no name; write a text in one line",
    ),
    "a body with itself": (
        mechanism(joint(bodies='["A", "A"]')),
        "[[joint]] 1 'J': bodies",
        "'A' with itself",
    ),
    "disconnected": (
        mechanism(joint(), joint(name='"K"', bodies='["C", "D"]')),
        "[[joint]] 2 'K': bodies",
        "no joint connects C, D with the ground",
    ),
    "joints of one name": (
        mechanism(joint(), joint(bodies='["B", "A"]')),
        "[[joint]] 2 'J': name",
        "two joints are named 'J'",
    ),
    "body without a joint": (
        mechanism(more=BODY.replace("B", "Q")),
        "[[body]] 1 'Q': name",
        "body 'Q' has no joint",
    ),
    "body twice": (mechanism(more=BODY + BODY), "[[body]] 2 'B': name", "given twice"),
    "orientation of three": (
        mechanism(more=BODY + "orientation = [1, 0, 0]\n"),
        "[[body]] 1 'B': orientation",
        "has 3 entries; write a list of 4 numbers",
    ),
    "orientation not of norm one": (
        mechanism(more=BODY + "orientation = [1, 1, 0, 0]\n"),
        "[[body]] 1 'B': orientation",
        "must be exactly 1",
    ),
}


def write(folder: Path, content: str | bytes) -> Path:
    path = folder / "case.toml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize("name", BROKEN)
def test_the_line_says_where_what_and_what_would_be_right(name, tmp_path):
    content, place, message = BROKEN[name]
    path = write(tmp_path, content)
    with pytest.raises(CaseError) as caught:
        read_case(path)
    line = str(caught.value)
    assert line.startswith(f"{path}: {place}: " if place else f"{path}: ")
    assert message in line
    assert line.isprintable()
    assert len(line) < len(str(path)) + 300


@pytest.mark.parametrize("name", BROKEN)
def test_the_command_line_answers_with_that_line_and_status_2(name, tmp_path, capsys):
    path = write(tmp_path, BROKEN[name][0])
    assert main(["model", str(path)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert len(err.splitlines()) == 1
    assert str(path) in err


@pytest.mark.parametrize(
    "name",
    [
        "long line",
        "long file",
        "deep",
        "large exponent",
        "powers of powers",
        "dense power",
        "long decimal",
        "small power",
        "nested lists",
        "dotted key",
        "many terms",
        "squares of squares",
        "irrational sums of products",
    ],
)
def test_refusing_takes_no_memory(name, tmp_path):
    path = write(tmp_path, BROKEN[name][0])
    tracemalloc.start()
    try:
        with pytest.raises(CaseError):
            read_case(path)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 30_000_000


def test_files_that_cannot_be_opened(tmp_path):
    with pytest.raises(CaseError, match=r"no-such-case\.toml: cannot be read"):
        read_case(tmp_path / "no-such-case.toml")
    with pytest.raises(CaseError, match=r"cannot be read \(Is a directory\)"):
        read_case(tmp_path)
    with pytest.raises(CaseError, match="null byte"):
        read_case("a\0b")


def test_the_parts_of_these_cases_are_sound_without_their_fault(tmp_path):
    assert read_case(write(tmp_path, parameters("a = 1\n") + POINT + TRUTH)).points
    body = BODY + "orientation = [0, 1, 0, 0]\n"
    assert read_case(write(tmp_path, mechanism(more=body + TRUTH))).mechanism
