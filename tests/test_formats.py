"""Systems in the files of other programs: read, written, and the same after both."""

from __future__ import annotations

import re
import shutil
import subprocess
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import nag
from nag.algebra.imaginary_unit import adjoin_unit
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import IMAGINARY_UNITS
from nag.cli import main
from nag.files.cases import CaseError, read_case
from nag.files.formats import READ, ROBOTS, WRITTEN, words
from nag.files.formats.reading import READERS, read_system_text, recognise_format
from nag.files.formats.writing import WRITERS, write_system
from nag.mechanism.problem import problem_of

BERTINI = """\
% a curve and a line
CONFIG
  TrackTolBeforeEG: 1e-8;  % left out
END;
INPUT
variable_group x, y;
variable_group z;
function f, g;
constant a, b;
a = 1/2;
b = 2*a;
s = x^2 + y^2;   % a subfunction
f = s - b;
g = (x - y)*z
    - a;
END;
1 2 3
"""
PHC = """\
2
 3.5*x**2 + y^2 - 1;
 x*y - 1.5E-01 ;

THE SOLUTIONS :
"""
MACAULAY2 = """\
-- a ring and an ideal
R = QQ[x_1..x_3, a, MonomialOrder => Lex];
f = x_1^2 + x_2  -- named
I = ideal(f, x_1*x_2 -
   a/3,
   x_3)
dim I
"""
SINGULAR = """\
LIB "primdec.lib";
ring r = 0, (x(1..2), y), dp;  // names with an index
poly f = x(1)^2 - 3;
ideal i = f, x(1)*x(2) - y;
primdecGTZ(i);
"""
JULIA = """\
using HomotopyContinuation
@var x y[1:2]  # a name and two with an index
@var r
f = 2x^2 - 3//4*y[1];
F = System([f, im*x*y[2] + 2(x -
    1)]; variables = [x, y[1], y[2]], parameters = [r])
p = [1, 2]
S = solve(F; target_parameters = p)
"""
PLAIN = """\
# two circles
x^2 + y^2 = 1,
(x - 1)^2 + y^2 = 1/4;   # with an end
"""


def read_text(text: str, format: str = "auto") -> PolynomialSystem:
    format = recognise_format(text) if format == "auto" else format
    return read_system_text("file", text, format)[0]


@pytest.mark.parametrize(
    ("text", "format", "variables", "equations"),
    [
        (
            BERTINI,
            "bertini",
            ("x", "y", "z"),
            ["x^2 + y^2 - 1", "x*z - y*z - 1/2"],
        ),
        (PHC, "phc", ("x", "y"), ["7/2*x^2 + y^2 - 1", "x*y - 3/20"]),
        (
            MACAULAY2,
            "m2",
            ("x_1", "x_2", "x_3", "a"),
            ["x_1^2 + x_2", "x_1*x_2 - 1/3*a", "x_3"],
        ),
        (SINGULAR, "singular", ("x[1]", "x[2]", "y"), ["x[1]^2 - 3", "x[1]*x[2] - y"]),
        (
            JULIA,
            "hc",
            ("x", "y[1]", "y[2]", "r", "I"),
            ["2*x^2 - 3/4*y[1]", "x*y[2]*I + 2*x - 2", "I^2 + 1"],
        ),
        (PLAIN, "text", ("x", "y"), ["x^2 + y^2 - 1", "x^2 + y^2 - 2*x + 3/4"]),
    ],
)
def test_files_are_told_by_their_content_and_read_exactly(
    text: str, format: str, variables: tuple[str, ...], equations: list[str]
) -> None:
    assert recognise_format(text) == format
    system = read_text(text)
    assert system.variables == variables
    assert system.text() == equations


def test_bertinis_last_line_may_stand_without_its_first() -> None:
    assert "INPUT\n" in BERTINI and "END;" in BERTINI
    alone = BERTINI[BERTINI.index("INPUT\n") + len("INPUT\n") :]
    whole = read_system_text("file", BERTINI, "bertini")
    assert read_system_text("file", alone, "bertini") == whole


def test_what_is_divided_by_may_be_a_name_of_a_constant() -> None:
    text = "variable_group x;\nfunction f;\nh = Pi/2;\nk = 4;\nf = x*h/h/k - k^-1;\nEND;\n"
    assert read_system_text("file", text, "bertini")[0] == nag.system("x/4 - 1/4")
    with pytest.raises(CaseError, match="line 3, column 17: the divisor contains a variable"):
        read_system_text("file", "variable_group x;\nfunction f;\nh = x - 1; f = 1/h;", "bertini")


def test_groups_and_parameters_of_bertini_are_kept() -> None:
    system, parameters, _ = read_system_text("file", BERTINI, "bertini")
    assert system.groups == ((0, 1), (2,))
    assert parameters == {"a": Fraction(1, 2), "b": 1}
    assert read_system_text("file", BERTINI, "bertini", {"a": "3"})[1] == {"a": 3, "b": 6}


def test_homogeneous_groups_are_met_by_a_patch() -> None:
    text = "hom_variable_group x, y, z;\nfunction f, g;\nf = x^2 - y*z; g = x - y;\n"
    system = read_text(text)
    assert [f.degree for f in system.polynomials] == [2, 1, 1]
    # A conic and a line meet in two points of the plane.
    assert len(nag.solve(system).solutions) == 2


@pytest.mark.parametrize(
    ("ring", "names"),
    [
        ("R = QQ[a..d]", ("a", "b", "c", "d")),
        ("R = QQ[x_(1,1)..x_(2,2)]", ("x_{1,1}", "x_{1,2}", "x_{2,1}", "x_{2,2}")),
        ("R = CC_53[x, y_0..y_1]", ("x", "y_0", "y_1")),
    ],
)
def test_ranges_of_macaulay2_are_written_out(ring: str, names: tuple[str, ...]) -> None:
    first = names[0].replace("_{", "_(").replace("}", ")")
    assert read_text(f"{ring}\nI = ideal({first}^2 - 1)").variables == names


def test_products_without_a_sign_are_read_where_singular_prints_them() -> None:
    system = read_text("ring r=0,(x,y),dp;\nideal i=3x2y-1,xy+y10;")
    assert system.text() == ["3*x^2*y - 1", "y^10 + x*y"]


@pytest.mark.parametrize("name", ["x[0]", "x[1,2]", "φ", "x_{12}", "x'", "x₁", "größe", "θ_1''"])
def test_names_are_written_as_people_write_them(name: str) -> None:
    system = nag.system([f"{name}^2 - 2*{name} + y"], variables=[name, "y"])
    assert system.variables == (name, "y")
    assert system.text() == [f"{name}^2 - 2*{name} + y"]
    assert nag.system([f"y = 2*{name}"]).n == 2


def test_a_superscript_is_no_part_of_a_name() -> None:
    with pytest.raises(nag.EquationError, match="column 2: '²' has no meaning here"):
        nag.system(["x² - 1"], variables=["x"])


@pytest.mark.parametrize(
    ("text", "place", "reason"),
    [
        ("x^2 + y\nx*(y - 1\n", "line 2, column 3", "'(' is never closed"),
        ("x^2 + I*y\n", "line 1, column 7", "looks like the imaginary unit"),
        ("@var x\n[x - 1]\n[x]", "line 3, column 2", "a second list of equations"),
        ("@var x[1:2,1:2]\n[1]", "line 1, column 6", "is not read; write indices as in x[1:3]"),
        ("x + NaN*y\n", "line 1, column 5", "'NaN' looks like a value that is no finite number"),
        ("2\nx + nan;\nx;\n", "line 2, column 5", "no finite number; write a number"),
        ("@var x y\nF = [x, y\n", "line 2, column 5", "'[' is never closed"),
        ("@var x y\nF = [x, z]", "line 2, column 9", "unknown name 'z'"),
        ("@var x y\nsolve(F)", "line 2, column 9", "there is no list of equations"),
        ("x^2 + i*y\n", "line 1, column 7", "begin with a line 'imaginary i'"),
        ("2\nx^2 - 1;\n", "line 2, column 9", "1 of 2 polynomials end with ';'"),
        ("1 2\nx^2 - 1;\n", "line 1, column 3", "2 unknowns are said, and 1 occur"),
        ("2\nx^2 - 1;\nx/y;\n", "line 3, column 2", "the divisor contains a variable"),
        ("variable_group x;\nfunction f;\nf = x + t;\n", "line 3, column 9", "unknown name 't'"),
        ("variable_group x;\nfunction f, g;\nf = x;\n", "line 2, column 13", "never defined"),
        (
            "variable_group x;\npathvariable t;\n",
            "line 2, column 1",
            "a homotopy of the user's own is not read",
        ),
        ("R = ZZ/101[x]\nI = ideal(x)\n", "line 1, column 5", "a ring over a finite field"),
        ("R = QQ[x]\n", "line 1, column 10", "there is no ideal"),
        ("R = QQ[x]\nI = ideal(x)\nJ = ideal(x^2)\n", "line 3, column 1", "a second ideal"),
        ("R = QQ[x, x]\nI = ideal(x)\n", "line 1, column 11", "is there twice"),
        (
            "R = QQ[x, y]\nI = ideal(x) + ideal(y)\n",
            "line 2, column 5",
            "sums of ideals are not read; write one ideal(..., ...)",
        ),
        ('R = QQ[x]\nI = ideal "x2-1"\n', "line 2, column 5", "polynomials in quotes are not read"),
        ("ring r = 32003, (x), dp;\nideal i = x;\n", "line 1, column 10", "a ring over '32003'"),
        (
            "ring r = 0, (x), dp;\nideal i = x;\ni = i + 1;\n",
            "line 3, column 5",
            "'i + 1' is not worked out",
        ),
        ("ring r = 0, (x(1..999999)), dp;\n", "line 1, column 14", "more than 500"),
    ],
)
def test_a_mistake_is_told_by_line_and_column(text: str, place: str, reason: str) -> None:
    with pytest.raises(CaseError) as raised:
        read_text(text)
    message = str(raised.value)
    assert message.startswith(f"file: {place}: ")
    assert reason in message
    assert "\n" not in message


@pytest.mark.parametrize("name", ["π", "Pi"])
def test_pi_is_the_constant_in_plain_text_unless_it_is_listed(name: str) -> None:
    text = f"{name}*x^2 + y^2 = 5\nx*y = 2\n"
    assert read_text(text) == nag.system(["pi*x^2 + y^2 = 5", "x*y = 2"])
    assert read_text(f"variables x, y, {name}\n{text}").variables == ("x", "y", name)


@pytest.mark.parametrize("head", ["variables x, i\nimaginary i", "imaginary i\nvariables x, i"])
def test_a_variable_of_plain_text_is_not_the_unit_as_well(head: str) -> None:
    with pytest.raises(CaseError, match=r"column \d+: imaginary: 'i' is taken; write a letter"):
        read_text(f"{head}\nx^2 - i\n")


@pytest.mark.parametrize("unit", IMAGINARY_UNITS)
def test_plain_text_asks_about_every_name_of_the_unit(unit: str) -> None:
    with pytest.raises(CaseError, match=f"line 2, column 7: '{unit}' looks like .*'imaginary"):
        read_text(f"x - y\nx^2 + {unit}\n")
    assert read_text(f"variables x {unit}\nx^2 + {unit}\n").variables == ("x", unit)
    assert read_text(f"imaginary {unit}\nx^2 + {unit}\n").imaginary


def test_a_format_that_is_asked_for_is_taken(tmp_path: Path) -> None:
    path = tmp_path / "one"
    path.write_text("2\nx - 1;\nx - 1;\n")
    assert read_case(path).system.text() == ["x - 1", "x - 1"]
    # One polynomial a line: the number 2, and twice x - 1.
    assert read_case(path, format="text").system.text() == ["2", "x - 1", "x - 1"]
    with pytest.raises(CaseError, match="'matlab' is unknown; write one of toml"):
        read_case(path, format="matlab")


NAMES = ("x", "y_1", "z[2]", "θ", "w_{1,2}")


@st.composite
def systems(draw: st.DrawFn) -> PolynomialSystem:
    n = draw(st.integers(1, 4))
    fractions = st.fractions(max_denominator=30).filter(lambda q: abs(q) < 10**6 and q != 0)
    exponents = st.tuples(*[st.integers(0, 3)] * n)
    terms = st.dictionaries(exponents, fractions, min_size=1, max_size=6)
    polynomials = draw(st.lists(terms, min_size=1, max_size=4))
    return PolynomialSystem(NAMES[:n], tuple(Polynomial(n, t) for t in polynomials))


@settings(max_examples=40, deadline=None)
@given(systems(), st.sampled_from(sorted(READERS)))
def test_what_is_written_is_read_back(system: PolynomialSystem, format: str) -> None:
    text = write_system(system, format, "a system")
    assert recognise_format(text) == format
    read = read_text(text)
    # Names may have been changed; their order has not.
    assert read.n == system.n
    assert read.polynomials == system.polynomials


@st.composite
def complex_systems(draw: st.DrawFn) -> PolynomialSystem:
    """Systems over the Gaussian rationals in which the unit occurs, and what must not vanish."""
    real = draw(systems())
    n = real.n + 1
    unit = Polynomial.variable(n, n - 1)

    def drawn() -> Polynomial:
        f, g = (draw(st.sampled_from(real.polynomials)) for _ in range(2))
        return f.with_variables(n, range(n - 1)) + unit * g.with_variables(n, range(n - 1))

    polynomials = [drawn() for _ in real.polynomials]
    nonzero = [drawn() for _ in range(draw(st.integers(0, 1)))]
    return adjoin_unit((*real.variables, "I"), polynomials, nonzero)


@settings(max_examples=60, deadline=None)
@given(complex_systems(), st.sampled_from(sorted(READERS)))
def test_what_is_written_of_complex_systems_is_read_back(
    system: PolynomialSystem, format: str
) -> None:
    text = write_system(system, format, "a system")
    assert recognise_format(text) == format
    read = read_text(text)
    assert read.imaginary
    assert read.n == system.n
    assert read.polynomials == system.polynomials
    assert read.nonzero == system.nonzero


@settings(max_examples=20, deadline=None)
@given(complex_systems())
def test_sympy_takes_what_is_written_of_complex_systems(system: PolynomialSystem) -> None:
    lines: dict[str, object] = {}
    exec(write_system(system, "sympy"), lines)
    again = nag.system(lines["equations"], system.variables[:-1])
    assert again.imaginary
    assert again.polynomials == system.polynomials


CASES = sorted(str(path) for path in Path("cases").rglob("*.toml"))


@pytest.mark.parametrize("path", CASES)
def test_every_case_is_the_same_system_by_each_format(path: str) -> None:
    system = problem_of(read_case(path)).system
    for format in READERS if system.polynomials else ():
        if not system.exact and format in ("m2", "singular"):
            continue
        text = write_system(system, format, "a title")
        assert recognise_format(text) == format
        again = read_text(text)
        if system.exact or format in ("text", "hc"):
            assert again.polynomials == system.polynomials
            assert again.nonzero == system.nonzero
        else:
            assert "rounded to 20 digits" in text
            terms = [f.terms.keys() for f in system.polynomials]
            assert [f.terms.keys() for f in again.polynomials] == terms


@pytest.mark.parametrize("format", READERS)
def test_what_must_not_vanish_is_told_and_found_again(format: str) -> None:
    system = problem_of(read_case("cases/spatial/puma-held.toml")).system
    text = write_system(system, format)
    # With what vanishes there are 24.
    assert len(nag.solve(read_text(text)).solutions) == 8


def test_what_must_not_vanish_is_named_by_its_place() -> None:
    with pytest.raises(CaseError, match="line 2, column 23: unknown name 'z'"):
        read_text("x^2 - 1\n# must not vanish: x +z\n")


def test_irrational_numbers_are_written_where_they_can_be() -> None:
    system = nag.system(["sqrt(2)*x^2 - pi*y"])
    assert "1.4142135623730950488*x^2" in write_system(system, "bertini")
    assert r"\sqrt{2} x^{2} - \pi y &= 0" in write_system(system, "latex")
    with pytest.raises(nag.NagError, match="not all coefficients are rational"):
        write_system(system, "m2")


def test_sympy_takes_what_is_written() -> None:
    system = nag.system(["sqrt(2)*x^2 - 1/3*y + pi", "x*y - 4"])
    lines: dict[str, object] = {}
    exec(write_system(system, "sympy"), lines)
    again = nag.system(lines["equations"])
    assert again.variables == system.variables
    assert again.text() == system.text()


def test_the_lists_of_formats_are_those_of_the_functions() -> None:
    assert ("toml", *READERS, *ROBOTS) == READ
    assert tuple(WRITERS) == WRITTEN


@pytest.mark.parametrize("format", [f for f in READ if f != "toml" and f not in ROBOTS])
def test_a_case_is_the_same_by_each_format(
    format: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["model", "cases/slider-crank.toml", "--format", format]) == 0
    path = tmp_path / "case"
    path.write_text(capsys.readouterr().out)
    case = read_case("cases/slider-crank.toml")
    assert read_case(path).system.polynomials == case.system.polynomials
    assert main(["decompose", str(path), "--quiet"]) == 0
    assert "irreducible" in capsys.readouterr().out


PEERS = {
    "m2": ("M2", ["M2", "--silent", "--stop", "-q", "{}"], "\nprint toString degree I\nexit 0\n"),
    "singular": (
        "Singular",
        ["Singular", "-q", "--no-rc", "{}"],
        "\nmult(std(nagideal));\nquit;\n",
    ),
}


@pytest.mark.parametrize("format", sorted(PEERS))
def test_the_program_reads_what_is_written(format: str, tmp_path: Path) -> None:
    program, command, question = PEERS[format]
    if shutil.which(program) is None:
        pytest.skip(f"{program} is not installed")
    system = nag.system(["x[1]^2 + θ'^2 - 1", "x[1]^3 - 2*θ'/3"])
    path = tmp_path / "system"
    path.write_text(write_system(system, format, "a circle and a cubic") + question)
    done = subprocess.run(
        [part.format(path) for part in command], capture_output=True, text=True, timeout=60
    )
    assert done.stdout.split()[-1] == "6", done.stdout + done.stderr


@pytest.mark.parametrize("format", sorted(PEERS))
def test_the_program_takes_i_for_the_unit(format: str, tmp_path: Path) -> None:
    program, command, question = PEERS[format]
    if shutil.which(program) is None:
        pytest.skip(f"{program} is not installed")
    # Four points; eight, were the unit a variable whose square is -1. A zero polynomial besides.
    system = nag.system(
        ["(1 + 2*I)*x[1]^2 - R", "R^2 - I*x[1]", "(2 - I) - (2 - I)*1 + 0*R"],
        ["x[1]", "R"],
        imaginary="I",
    )
    path = tmp_path / "system"
    path.write_text(write_system(system, format, "two parabolas") + question)
    done = subprocess.run(
        [part.format(path) for part in command], capture_output=True, text=True, timeout=60
    )
    assert done.stdout.split()[-1] == "4", done.stdout + done.stderr
    # A constant is an element of the ring.
    empty = nag.system(["I + 2", "3"], "x", imaginary="I")
    path.write_text(write_system(empty, format, "nothing") + question)
    done = subprocess.run(
        [part.format(path) for part in command], capture_output=True, text=True, timeout=60
    )
    assert done.stdout.split()[-1] in ("0", "-1"), done.stdout + done.stderr


def test_phcpack_reads_complex_coefficients(tmp_path: Path) -> None:
    if shutil.which("phc") is None:
        pytest.skip("phc is not installed")
    equations = ["(1 + 2*I)*x^2 - y", "y^2 - I*x - (1/3 + 3/5*I)"]
    system = nag.system(equations, "x y", imaginary="I")
    path, out = tmp_path / "system", tmp_path / "out"
    path.write_text(write_system(system, "phc", "two parabolas"))
    subprocess.run(["phc", "-b", str(path), str(out)], check=True, timeout=60)
    text = out.read_text().rpartition("THE SOLUTIONS :")[2]
    values = {
        name: [
            complex(float(a), float(b)) for a, b in re.findall(rf"\n {name} : *(\S+) *(\S+)", text)
        ]
        for name in "xy"
    }
    assert len(values["x"]) == 4
    for x, y in zip(values["x"], values["y"], strict=True):
        assert abs((1 + 2j) * x**2 - y) < 1e-12
        assert abs(y**2 - 1j * x - 1 / 3 - 0.6j) < 1e-12


@pytest.mark.parametrize(
    "text",
    [
        "K = QQ[i]/(i^2+1);\nR = K[x,y]\nI = ideal((2*i+1)*x^2+y, i*x*y-(1/2)*i)",
        "kk = toField(QQ[a] / ideal(1 + a^2))\nR = kk[x, y]\nI = ideal(x^2+2*a*x^2+y, a*x*y-a/2)",
        "R = (QQ[i]/(i^2+1))[x,y]; {(2*i+1)*x^2+y, i*x*y-(1/2)*i}",
        "R = CC[x,y]; {(2*ii+1)*x^2+y, ii*x*y-(1/2)*ii}",
        "ring r = (0,i),(x,y),dp; minpoly=i2+1; ideal j = (2i+1)*x2+y, (i)*xy+(-1/2i);",
        "ring r = (0, w), (x, y), dp;\nminpoly = (w^2+1);\nideal j = (1+2w)*x2+y, wxy-1/2*w;",
    ],
)
def test_fields_with_the_unit_are_read_as_other_programs_write_them(text: str) -> None:
    system = nag.system(["(1 + 2*I)*x^2 + y", "I*x*y - I/2"], "x y", imaginary="I")
    assert read_text(text) == system


@pytest.mark.parametrize(
    ("text", "place", "reason"),
    [
        ("ring r = (0, a), (x), dp;\nideal j = a*x;", "line 1, column 10", "without parameters"),
        (
            "ring r = (0, a), (x), dp; minpoly = a^2 - 2;\nideal j = a*x;",
            "line 1, column 27",
            "with a root that with the imaginary unit is read",
        ),
        ("K = QQ[x]/(x^2+2)\nR = K[y]\nI = ideal(x + y)", "line 1, column 10", "a quotient ring"),
        ("R = QQ[x, y]/(x^2+1)\nI = ideal(x + y)", "line 1, column 13", "a quotient ring"),
    ],
)
def test_other_fields_are_refused(text: str, place: str, reason: str) -> None:
    with pytest.raises(CaseError) as error:
        read_text(text)
    assert place in str(error.value)
    assert reason in str(error.value)


def test_phcpack_reads_what_is_written(tmp_path: Path) -> None:
    if shutil.which("phc") is None:
        pytest.skip("phc is not installed")
    system = nag.system(["x_1^2 + y'^2 - 1", "x_1^3 - 2*y'/3"], variables=["y'", "x_1"])
    path, out = tmp_path / "system", tmp_path / "out"
    path.write_text(write_system(system, "phc", "a circle and a cubic"))
    subprocess.run(["phc", "-b", str(path), str(out)], check=True, timeout=60)
    assert "THE SOLUTIONS :\n6 2" in out.read_text()


# Words of the programs, names that they have for numbers, and some that a change could meet.
AWKWARD = """
I i ii iv Iv vI ice i1 E e e1 end exp Pi ring ringv poly list matrix vector ideal gens number
string int std link def proc map module resolution qring intvec intmat bigint if for while throw
break return step wedge value time exit quit pause R K Degree ring_1 gens_2 x x_1 y y[1]
nagring1 theta θ constant function random pow tan variable_group END INPUT CONFIG where in isa let
begin eval System F F1 True None lambda class equations Symbol S Base x[0] x' function_1
""".split()  # noqa: SIM905


def _awkward_system() -> PolynomialSystem:
    """A system with two solutions, 1 or -1 for each of the names."""
    first, *rest = AWKWARD
    equations = [f"{first}^2 - 1", *(f"{name} - {first}" for name in rest)]
    return nag.system(equations, AWKWARD, imaginary="w")


@pytest.mark.parametrize("format", READERS)
def test_names_that_a_program_does_not_take_are_changed_one_to_one(format: str) -> None:
    system = _awkward_system()
    text = write_system(system, format)
    read = read_text(text)
    assert read.polynomials == system.polynomials
    for new, old in zip(read.variables, AWKWARD, strict=True):
        assert new == old or f"{new} is {old}" in text
    if format == "bertini":
        assert not {*read.variables} & words.BERTINI
        assert "x[0]" in read.variables


@pytest.mark.parametrize("format", ["bertini", "phc", "m2", "singular", "sympy"])
def test_letters_of_other_alphabets_are_written_as_a_reader_would_read_them(format: str) -> None:
    names = {"x₁": "x1", "x₂": "x2", "Δ": "Delta", "δ": "delta", "ä": "a"}
    system = nag.system([f"{name}^2 - 1" for name in names], [*names])
    text = write_system(system, format)
    assert f"names: {', '.join(f'{new} is {old}' for old, new in names.items())}" in text
    taken = nag.system(["x1 + x₁ - 1", "x1 - 2*x₁"], ["x1", "x₁"])
    assert re.search(r"names: x1v is x₁$", write_system(taken, format), re.MULTILINE)


def test_python_takes_what_is_written_of_names_that_it_does_not_take() -> None:
    lines: dict[str, object] = {}
    system = nag.system("x₁^2 - Δ", "x₁ Δ")
    exec(write_system(system, "sympy"), lines)
    assert nag.system(lines["equations"], "x₁ Δ") == system


def test_python_takes_names_that_are_its_words() -> None:
    system = _awkward_system()
    lines: dict[str, object] = {}
    text = write_system(system, "sympy")
    exec(text, lines)
    equations = lines["equations"]
    assert isinstance(equations, list) and len(equations) == len(system.polynomials)
    # The symbols themselves have the names that were given.
    assert {str(s) for s in set().union(*(f.free_symbols for f in equations))} == {*AWKWARD}
    assert "lambdav is lambda" in text


def test_julia_gets_no_name_that_is_a_word_of_its_own() -> None:
    text = write_system(_awkward_system(), "hc")
    (declared,) = re.findall(r"^@var (.*)$", text, re.MULTILINE)
    names = declared.split()
    assert len({*names}) == len(AWKWARD) and not {*names} & words.JULIA
    (made,) = re.findall(r"^(\w+) = System", text, re.MULTILINE)
    assert made not in names
    for new, old in zip(names, AWKWARD, strict=True):
        assert new == old or f"{new} is {old}" in text


def test_julia_divides_whole_numbers_alone_into_fractions() -> None:
    numbers = {
        "sqrt(2)/2": "sqrt(2)/2",
        "5/7": "5//7",
        "cos(pi/5)": "(-1//4-sqrt(5)/4)",
        "3*pi/7": "(-3//7)*pi",
        "cos(2/3)": "cos(2//3)",
    }
    for number, written in numbers.items():
        assert written in write_system(nag.system([f"x - {number}"]), "hc")


@pytest.mark.parametrize(
    ("format", "command", "question"),
    [
        ("m2", ("M2", "--script"), "print degree I\n"),
        ("singular", ("Singular", "-q", "--no-rc"), "vdim(std(nagideal));\nquit;\n"),
    ],
)
def test_a_program_takes_names_that_are_its_words(
    format: str, command: tuple[str, ...], question: str, tmp_path: Path
) -> None:
    if shutil.which(command[0]) is None:
        pytest.skip(f"{command[0]} is not installed")
    path = tmp_path / "system"
    path.write_text(write_system(_awkward_system(), format) + question)
    done = subprocess.run(
        [*command, str(path)], capture_output=True, text=True, timeout=60, check=False
    )
    assert done.stdout.split()[-1:] == ["2"], done.stdout + done.stderr


def test_phcpack_takes_no_name_that_begins_with_its_unit_or_an_exponent(tmp_path: Path) -> None:
    names = ["i", "I", "ii", "iv", "Iv", "ice", "e", "E1", "vi"]
    equations = [f"{names[0]}^2 - 1", *(f"{n} - {names[0]}" for n in names[1:])]
    text = write_system(nag.system(equations, names, imaginary="w"), "phc")
    first = text.partition(";")[0]
    written = re.findall(r"[A-Za-z]\w*", first)[: 2 * len(names) : 2]
    assert len({*written}) == len(names)
    assert not [name for name in written if name[0] in "iIeE"]
    assert " is ii," in text
    if shutil.which("phc") is None:
        pytest.skip("phc is not installed")
    path, out = tmp_path / "system", tmp_path / "out"
    path.write_text(text)
    subprocess.run(["phc", "-b", str(path), str(out)], check=True, timeout=60)
    assert f"THE SOLUTIONS :\n2 {len(names)}" in out.read_text()


def test_a_field_of_macaulay2_may_have_a_name(tmp_path: Path) -> None:
    file = tmp_path / "named.m2"
    file.write_text("k = QQ;\nR = k[a..c];\nI = ideal(a*b - c, a + b);\n")
    assert read_case(file).system == nag.system(["a*b - c", "a + b"], variables="a b c")


@pytest.mark.parametrize("name", ["minors(2, M)", "intersect(ideal(a), ideal(b))"])
def test_operations_of_macaulay2_are_refused_by_their_names(tmp_path: Path, name: str) -> None:
    file = tmp_path / "made.m2"
    file.write_text(f"R = QQ[a, b];\nM = matrix{{{{a, b}}, {{b, a}}}};\nI = {name};\n")
    with pytest.raises(nag.InputError) as error:
        read_case(file)
    said = f"line 3, column 5: {name.partition('(')[0]} is not worked out here; write"
    assert said in str(error.value)


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ("I = ideal(x^2)\nJ = ideal(y)\nK = intersect(I, J)", "4, column 5", "intersect is not"),
        ("f = x^3 + y\nI = ideal(f, diff(x, f))", "3, column 14", "diff is not worked out"),
        ("f = x^3 + y\ng = diff(x, f)\nI = ideal(f, g)", "3, column 5", "diff is not"),
        ("f = x^3 + y\nI = ideal jacobian ideal f", "3, column 11", "jacobian is not"),
        ("F = {x^3, y}\nI = ideal jacobian matrix {F}", "3, column 11", "jacobian is not"),
        ("M = matrix{{x,y},{y,x}}\nI = ideal(det M, x-1)", "3, column 11", "det is not"),
        ("M = matrix{{x,y}}\nI = minors(1, M)", "3, column 5", "minors is not"),
        ("I = ideal(sub(x^2, x=>y), y)", "2, column 11", "sub is not worked out here"),
        ("I = ideal apply(3, i -> x^i)", "2, column 11", "apply is not worked out here"),
        ("L = apply(3, i -> x^i)\nI = ideal L", "2, column 5", "apply is not worked out here"),
        ("I = ideal for i from 1 to 2 list x^i", "2, column 11", "for is not worked out here"),
        ("I = ideal(x, y)^2", "2, column 16", "what is made of ideals is not worked out here"),
        ("I = (ideal(x, y)) : ideal(x)", "2, column 19", "what is made of ideals is not"),
        ("S = QQ[z]\nI = ideal(x)", "2, column 5", "a second ring; leave one in the file"),
    ],
)
def test_what_macaulay2_would_work_out_is_named_with_its_place(
    text: str, place: str, message: str, tmp_path: Path
) -> None:
    file = tmp_path / "made.m2"
    file.write_text(f"R = QQ[x,y]\n{text}\n")
    with pytest.raises(nag.CaseError, match=re.escape(f"line {place}: {message}")):
        nag.read(file)


@pytest.mark.parametrize(
    ("ring", "place", "message"),
    [
        ("kk = ZZ/101\nR = kk[x,y]", "2, column 5", "a ring over a finite field"),
        ("R = QQ[a][x,y]", "1, column 5", "coefficients with unknowns; write one ring"),
        ("R = frac(QQ[a])[x,y]", "1, column 10", "coefficients with unknowns; write one ring"),
    ],
)
def test_rings_of_macaulay2_over_others_are_refused(
    ring: str, place: str, message: str, tmp_path: Path
) -> None:
    file = tmp_path / "made.m2"
    file.write_text(f"{ring}\nI = ideal(x, y)\n")
    with pytest.raises(nag.CaseError, match=re.escape(f"line {place}: {message}")):
        nag.read(file)


@pytest.mark.parametrize(
    "text",
    [
        "I = ideal matrix {{x^2 - 1, y}, {x*y, y - 1}}",
        "M = matrix {{x^2 - 1, y}, {x*y, y - 1}}\nI = ideal flatten entries M",
        "h = hilbertPolynomial R\nf = x^2 - 1\nI = ideal(f, y, x*y, y - 1)\nJ = saturate(I, x)",
        "F = {x^2 - 1, y, x*y, y - 1}\nsols = solveSystem F",
    ],
)
def test_lists_and_matrices_of_macaulay2_are_read(text: str, tmp_path: Path) -> None:
    file = tmp_path / "made.m2"
    file.write_text(f"R = QQ[x,y]\n{text}\n")
    assert nag.read(file).system == nag.system(["x^2 - 1", "y", "x*y", "y - 1"], "x y")


@pytest.mark.parametrize(
    ("kind", "text"),
    [
        ("m2", "R = QQ[x];\n" + "-*" * 200_000),
        ("m2", "R = QQ[x];\nI = ideal(" + "{" * 50_000 + "x" + "}" * 50_000 + ");"),
        ("m2", "R = QQ[x];\nI = ideal(" + "x" * 300_000 + ");"),
        ("m2", "R = QQ[x];\n" + "GF " * 100_000),
        ("m2", "R = QQ[x];\nI = " + "ideal " * 80_000),
        ("m2", "R = QQ[x];\nf0 = y\n" + "".join(f"f{i + 1} = f{i}\n" for i in range(5_000))),
        ("bertini", "variable_group x\n" + "\n" * 300_000),
        ("sing", "ring r = 0, (x), dp;\n" + "/*" * 200_000),
        ("jl", "@var x\nF = [" + "#=" * 200_000),
        ("jl", "@var x\nF = [" + "9" * 300_000 + "x]"),
        ("jl", "@var x\n" + "f(" * 100_000 + "[x"),
        ("sing", "ring r = 0, (x, y(1..2)), dp;\nideal i = " + "x" * 300_000 + ";"),
    ],
)
def test_long_pieces_are_refused_in_linear_time(tmp_path: Path, kind: str, text: str) -> None:
    file = tmp_path / f"long.{kind}"
    file.write_text(text)
    with pytest.raises(nag.InputError):
        read_case(file)


@pytest.mark.parametrize(
    ("kind", "text", "said"),
    [
        ("m2", "R = QQ[x,y]/(x^2-1)\nI = ideal(y-x)", "line 1, column 12: a quotient ring"),
        ("m2", "R = QQ[x,y]\nI = ideal(x^2^3, y)", "line 2, column 12: a power of a power"),
        ("m2", "R = QQ[x,y]\nI = ideal(x**2, y)", "line 2, column 12: '**' is a tensor product"),
        ("sing", "ring r=0,(x,y),dp;\nideal i=x^2^3,y;", "line 2, column 10: a power of a power"),
    ],
)
def test_what_other_programs_read_in_another_way_is_refused(
    tmp_path: Path, kind: str, text: str, said: str
) -> None:
    file = tmp_path / f"other.{kind}"
    file.write_text(text)
    with pytest.raises(nag.InputError) as error:
        read_case(file)
    assert said in str(error.value)


@pytest.mark.parametrize(
    ("short", "written"),
    [
        ("3x2y", "3*x^2*y"),
        ("xy^2", "x^2*y^2"),
        ("3x^2", "9*x^2"),
        ("3z4y^4*x4", "81*x^4*y^4*z^16"),
        ("3x-1", "3*x - 1"),
        ("2x*3y", "6*x*y"),
        ("x1-1", "x - 1"),
    ],
)
def test_short_monomials_are_what_singular_takes_them_for(
    tmp_path: Path, short: str, written: str
) -> None:
    file = tmp_path / "short.sing"
    file.write_text(f"ring r = 0, (x, y, z), dp;\nideal i = {short}, z;")
    assert read_case(file).system.text()[0] == written


def test_names_that_are_defined_come_before_short_monomials(tmp_path: Path) -> None:
    file = tmp_path / "named.sing"
    file.write_text("ring r = 0, (x, y), dp;\npoly x1 = x2;\nideal i = x1 - 1, y;")
    assert read_case(file).system.text() == ["x^2 - 1", "y"]


@pytest.mark.parametrize(
    "text",
    [
        "ideal I;\nI[1] = x2-y;\nI[2] = xy-1;",
        "ideal I = x2-y;\nI[3] = xy-1;",
        "poly p(1) = x2-y; poly p(2) = xy-1;\nideal i = p(1), p(2);",
        "poly p(1..2);\np(1) = x2-y;\np(2) = xy-1;\nideal i = p(1..2);",
        "ideal i = x2-y, xy-1;\nideal j = std(i);\nvdim(j);",
        "ideal i = x2-y;\ni = i, xy-1;\ni = groebner(i);\ni;",
        "ideal i(1) = x2-y;\nideal i(2) = xy-1;\nideal j = i(1) + i(2);",
        "short = 0;\nideal i = x2-y, xy-1;\npoly f = i[1];\nideal j = f, i[2];",
        "ideal i = slimgb(ideal(x2-y, xy-1));",
    ],
)
def test_what_is_plainly_an_ideal_in_singular_is_read(tmp_path: Path, text: str) -> None:
    file = tmp_path / "ideal.sing"
    file.write_text(f"ring r = 0, (x, y), dp;\n{text}\n")
    assert read_case(file).system.text() == ["x^2 - y", "x*y - 1"]


@pytest.mark.parametrize(
    "printed",
    [
        "I[1]=x2-y\nI[2]=xy-1",
        "_[1]=x2-y\n_[2]=xy-1\n// shown",
        "ideal I;\nI[1]=x^2-y\nI[2]=x*y-1",
        "I[1]=x2\n-y\nI[2]=xy-\n1",
        "I[1]=x2-y\nI[2]=xy-1;",
    ],
)
def test_an_ideal_that_singular_printed_is_read_with_its_ring_and_asked_for_it_without(
    tmp_path: Path, printed: str
) -> None:
    file = tmp_path / "printed"
    file.write_text(f"ring r = 0, (x, y), dp;\n{printed.removesuffix(';')}\n")
    assert read_case(file).system.text() == ["x^2 - y", "x*y - 1"]
    # Without a ring x2 may be x^2, and an unknown that does not occur is not known of.
    file.write_text(printed.removeprefix("ideal I;\n") + "\n")
    with pytest.raises(CaseError, match=r"there is no ring|without its ring; write the ring"):
        read_case(file)


@pytest.mark.parametrize(
    "text",
    [
        "x[1]=2\nx[2]=3",
        "x[1]=x[2]^2\nx[2]=3",
        "x[1]=y^2\ny=3",
        "x[2]=y^2\nx[1]=y",
        "variables x[1], y\nx[1]=y^2",
    ],
)
def test_unknowns_with_indices_in_plain_text_are_no_entries_of_ideals(
    tmp_path: Path, text: str
) -> None:
    file = tmp_path / "plain"
    file.write_text(text)
    assert "x[1]" in read_case(file).system.variables


@pytest.mark.parametrize(
    ("text", "place", "said"),
    [
        ("ideal i = x;\nideal j = radical(i);", "line 3, column 11", "'radical' is not worked out"),
        ("ideal i = x;\nideal j = y;\nideal k = i*j;", "line 4, column 11", "'i*j' is not worked"),
        ("ideal i = x;\nideal j = y;", "line 3, column 1", "a second ideal"),
        ("ideal i = x;\nideal i = y;", "line 3, column 1", "a second ideal 'i'"),
        ("ideal i = x;\nideal j = i, i + y;", "line 3, column 14", "'i + y' is not worked out"),
        ("I[1] = x;", "line 2, column 1", "'I' is no ideal; write ideal I; before"),
        ("ideal I;\nI[0] = x;", "line 3, column 1", "entries are counted from 1"),
        ("poly p(1) = x, y;", "line 2, column 13", "'p[1]' is 2 polynomials; write one"),
        ("ideal i = ;", "line 2, column 10", "'i' is nothing; write what it is"),
        ("ideal i = " + "std(" * 9 + "x" + ")" * 9 + ";", "line 2", "lists in lists"),
        ("ideal i = minor(m, 2);", "line 2, column 11", "'minor' is not worked out here"),
        ("ideal i;\nfor (int k=1; k<3; k++) { i[k] = x; }", "line 3, column 1", "'for' is not run"),
        ("list l = minAss(x);", "line 2, column 1", "'list l = minAss(x)' is not read"),
    ],
)
def test_what_singular_would_work_out_is_refused_by_name_and_place(
    tmp_path: Path, text: str, place: str, said: str
) -> None:
    file = tmp_path / "ideal.sing"
    file.write_text(f"ring r = 0, (x, y), dp;\n{text}\n")
    with pytest.raises(CaseError, match=re.escape(said)) as error:
        read_case(file)
    assert place in str(error.value)


def test_i_is_the_unit_of_singulars_complex_rings(tmp_path: Path) -> None:
    file = tmp_path / "complex.sing"
    file.write_text("ring r = (complex,30), (x,y), dp;\nideal j = x2 + i, y - i*x;")
    assert read_case(file).system.imaginary


@pytest.mark.parametrize(
    "text",
    [
        "ideal i = x2-y, xy-1;\nint d = vdim(std(i));\nlist L = minAssGTZ(i);\nL;",
        "ideal i = x2-y, xy-1;\nmatrix M[2][2] = x,y,1,x;\ndef S = absPrimdecGTZ(i);\nsetring S;",
        "int n = 1;\nideal i = x2-y, xy-n;",
    ],
)
def test_values_of_singular_that_no_polynomial_is_made_of_are_left_alone(
    text: str, tmp_path: Path
) -> None:
    file = tmp_path / "ideal.sing"
    file.write_text(f"ring r = 0, (x, y), dp;\n{text}")
    assert nag.read(file).system == nag.system(["x^2 - y", "x*y - 1"], "x y")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (";\nlist L = x, y;\nideal i = L[1], y;", "line 2, column 1: 'list L = x, y' is not read"),
        (";\ndef i = ideal(x, y);", "line 2, column 1: 'def i = ideal(x, y)' is not read"),
        ("\nideal i = x, y;", "line 1, column 23: ';' is missing here; write it"),
        (";\nideal i = x\nideal j = y;", "line 2, column 12: ';' is missing here; write it"),
    ],
)
def test_what_singular_would_make_of_other_values_is_refused_with_its_place(
    text: str, said: str, tmp_path: Path
) -> None:
    file = tmp_path / "ideal.sing"
    file.write_text(f"ring r = 0, (x, y), dp{text}")
    with pytest.raises(CaseError, match=re.escape(said)):
        nag.read(file)


def test_an_ideal_without_a_ring_is_asked_for_its_ring(tmp_path: Path) -> None:
    file = tmp_path / "ideal.m2"
    file.write_text("K = ideal(a^2 - b, b^2 - a*b^2)\n")
    with pytest.raises(CaseError, match=r"there is no ring; write R = QQ\[x, y\]"):
        read_case(file)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("variable_group x, y\nfunction f, g;\nf = x - 1; g = y;", "line 1, column 20"),
        ("variable_group x, y;\nfunction f, g;\nf = x - 1\n\n  g = y;", "line 3, column 10"),
        ("variable_group x, y;\nfunction f, g\nf = x - 1; g = y;", "line 2, column 14"),
    ],
)
def test_a_semicolon_that_is_missing_in_bertini_is_missed_where_it_was(
    text: str, place: str
) -> None:
    with pytest.raises(CaseError, match=f"{place}: ';' is missing here; write it"):
        read_system_text("file", text, "bertini")


@pytest.mark.parametrize(
    "text",
    [
        "CONFIG MPType: 2; END; INPUT variable_group x; hom_variable_group y, z; {} END; f = 1",
        "config\nTrackType: 0;\nend;\ninput\nVariable_Group x;\nhom_variable_group y, z;\n{}\nEND",
    ],
)
def test_sections_of_bertini_need_no_lines_and_groups_keep_their_order(text: str) -> None:
    whole = text.replace("{}", "function f, g; f = x^2 - 1; g = y - x*z;")
    assert recognise_format(whole) == "bertini"
    system = read_system_text("file", whole, "bertini")[0]
    assert system.variables == ("x", "y", "z") and system.groups == ((0,), (1, 2))
    turned = whole.replace("variable_group x;", "").replace("y, z;", "y, z; variable_group x;")
    turned = turned.replace("Variable_Group x;", "")
    turned = turned.replace("INPUT  hom", "INPUT hom")
    assert read_system_text("file", turned, "bertini")[0].variables == ("y", "z", "x")


def test_polynomials_of_phcpack_beyond_their_number_are_refused() -> None:
    text = "2\nx^2 - 1;\ny - x;\n"
    with pytest.raises(CaseError, match="line 4, column 1: more polynomials than the 2"):
        read_system_text("file", f"{text}x - y;\n", "phc")
    solutions = (
        "TITLE : a; b\n\nTHE SOLUTIONS :\n1 2\nsolution 1 :\n x : 1.0E+00 0.0\n== err : 0 ==\n"
    )
    whole = read_system_text("file", text, "phc")
    assert read_system_text("file", text + solutions, "phc") == whole


WITH_PARAMETERS = {
    "hc": """
@var x y p[1:2] q
F = System([x^2 + p[1]*y - p[2], y^2 - q*x]; variables = [x, y], parameters = [p; q])
solve(F, target_parameters = [1, 3, 2])
""",
    "bertini": """
variable_group x, y;
parameter p[1], q;
parameter p[2];
constant c;
c = p[2]/2;
function f, g;
f = x^2 + p[1]*y - 2*c; g = y^2 - q*x;
""",
}


@pytest.mark.parametrize(
    "system",
    [
        "System([x^2 - p*y, y - 1]; parameters = [p])",
        "System([x^2 - p*y, y - 1], [x, y], [p])",
        "System([x^2 - p*y, y - 1], v, w)",
        "System([x^2 - p*y, y - 1], [x, y], parameters = w)",
    ],
)
def test_parameters_of_julia_are_those_of_its_system(system: str, tmp_path: Path) -> None:
    file = tmp_path / "system.jl"
    file.write_text(f"@var x y z p\nv = [x, y]; w = [p]\nF = {system}\nsolve(F)\n")
    case = nag.read(file)
    assert isinstance(case, nag.Case) and case.unset == ("p",)
    assert nag.read(file, set={"p": 2}).system == nag.system(["x^2 - 2*y", "y - 1"], "x y")


@pytest.mark.parametrize(
    ("equations", "variables"),
    [
        ("System([x^2 - π])", ["x"]),
        ("System([x^2 - π], variables = [x, z])", ["x", "z"]),
        ("[y^2 - π]", ["y"]),
    ],
)
def test_unknowns_of_julia_are_those_of_the_equations_or_of_the_system(
    equations: str, variables: list[str]
) -> None:
    system = read_text(f"@var x y z\nF = {equations}\n", "hc")
    assert system == nag.system([f"{variables[0]}^2 - pi"], variables)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("F = [x^2 - sum(y)]", "line 2, column 12: 'sum' is not worked out here; write out"),
        ("g = f(x)\nF = [x^2 - 1, y + f(1)]", "line 3, column 19: 'f' is not worked out here"),
        ("F = [x^i - y for i in 1:2]", "line 2, column 14: 'for' is not worked out here"),
        ("@var z, w\nF = [x]", "line 2, column 6: names have blanks between them"),
    ],
)
def test_what_julia_would_work_out_is_named_with_its_place(text: str, said: str) -> None:
    with pytest.raises(CaseError, match=re.escape(said)):
        read_system_text("file", f"@var x y\n{text}\n", "hc")


@pytest.mark.parametrize(
    "text",
    [
        "using HomotopyContinuation; @var x y; f = x^2+y^2-5; g=x*y-2\nsolve([f,g])\n",
        "using HomotopyContinuation\n@var(x, y)\nsolve([x^2+y^2-5, x*y-2])\n",
        "x = 1; @polyvar x y # both\nsolve([x^2+y^2-5; x*y-2])\n",
    ],
)
def test_julia_is_told_by_its_variables_wherever_a_statement_begins(text: str) -> None:
    assert recognise_format(text) == "hc"
    assert read_text(text) == nag.system(["x^2 + y^2 - 5", "x*y - 2"])


@pytest.mark.parametrize("format", WITH_PARAMETERS)
def test_parameters_without_a_value_are_asked_for_before_anything_else(
    format: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, table = tmp_path / "system.txt", tmp_path / "values.csv"
    file.write_text(WITH_PARAMETERS[format])
    case = nag.read(file)
    assert isinstance(case, nag.Case) and {*case.unset} == {"p[1]", "p[2]", "q"}
    for ask in (nag.solve, nag.decompose, nag.problem, lambda c: nag.write(c, tmp_path / "a.toml")):
        with pytest.raises(nag.CaseError, match=r"parameters .* have no values; solve for many"):
            ask(case)
    given = {"p[1]": 1, "p[2]": 3}
    with pytest.raises(nag.CaseError, match=r"parameter q has no value; .* set it, as q=1"):
        nag.solve(file, set=given)
    same = nag.solve(["x^2 + y - 3", "y^2 - 2*x"])
    assert nag.solve(file, set={**given, "q": 2}).points == pytest.approx(same.points)
    table.write_text("q,p[1],p[2]\n2,1,3\n")
    assert nag.solve_family(file, values=table).counts.tolist() == [4]
    assert main(["family", str(file), "--values", str(table), "--quiet"]) == 0
    table.write_text("q,p[1]\n2,1\n")
    with pytest.raises(nag.CaseError, match=r"parameter p\[2\] has no value"):
        nag.solve_family(file, values=table)
    assert main(["solve", str(file), "--set", "q=1", "--set", "p[1]=1"]) == 2
    assert "or set it, as p[2]=1 (--set)" in capsys.readouterr().err
    assert main(["show", str(file)]) == 0
    assert "parameters without a value" in capsys.readouterr().out


def test_an_unknown_that_has_a_value_is_a_parameter(tmp_path: Path) -> None:
    file = tmp_path / "system.jl"
    file.write_text(
        "@var x y p q\nF = System([x^2 + p*y - 1, x - q*y], variables=[x, y], parameters=[p, q])"
    )
    case = nag.read_case(file, {"p": "1/2", "q": 2})
    assert case.system.variables == ("x", "y") and dict(case.parameters) == {
        "p": Fraction(1, 2),
        "q": 2,
    }
    same = nag.solve(["x^2 + y/2 - 1", "x - 2*y"])
    assert nag.solve(case).points == pytest.approx(same.points)
    for values, said in (
        ({"r": 1}, "'r': is no parameter and no unknown; it has x, y, p, q"),
        (dict.fromkeys("xypq", 1), "every unknown has a value; leave one without"),
    ):
        with pytest.raises(nag.CaseError, match=said):
            nag.read_case(file, values)


@pytest.mark.skipif(shutil.which("Singular") is None, reason="Singular is not installed")
@pytest.mark.parametrize(
    ("ring", "equations", "variables"),
    [
        ("0, (x, y, z), dp", ["(x + y + z + 1)^6 - 3*x*y", "x^2*y - 1", "x*y*z - 7/3"], "x, y, z"),
        ("0, (x1, x2), dp", ["x1^2*x2 - 1", "(x1 + x2 + 3)^5 - 2", "x1 - x2"], "x1, x2"),
    ],
)
def test_what_singular_prints_is_the_ideal_that_it_was_given(
    tmp_path: Path, ring: str, equations: list[str], variables: str
) -> None:
    script = f"ring r = {ring};\nideal I = {', '.join(equations)};\nI;\nquit;\n"
    words = ["Singular", "-q", "--no-rc"]
    printed = subprocess.run(words, input=script, capture_output=True, text=True, timeout=60).stdout
    file = tmp_path / "printed"
    file.write_text(f"ring r = {ring};\n{printed}")
    assert read_case(file).system.polynomials == nag.system(equations, variables).polynomials
    file.write_text(printed)
    with pytest.raises(CaseError, match="write the ring before it"):
        read_case(file)


def test_numbers_of_a_ring_are_numbers(tmp_path: Path) -> None:
    file = tmp_path / "ideal.m2"
    file.write_text("R = QQ[x]\nI = ideal(x^2 - 2_R, 0_R)\n")
    assert read_case(file).system.polynomials == nag.system(["x^2 - 2", "0"], "x").polynomials


@pytest.mark.skipif(shutil.which("Singular") is None, reason="Singular is not installed")
def test_singular_takes_variables_whatever_they_are_called(tmp_path: Path) -> None:
    of_kernel = {"QQ", "ZZ", "Current", "Standard", "Top", "basering", "pyobject"}
    names = sorted(of_kernel | words.SINGULAR | {"nagring", "nagideal", "RR", "x_1", "lambda"})
    file = tmp_path / "named.sing"
    nag.write(nag.system([f"{name}^2 - 3*{name}" for name in names], names), file)
    script = f"{file.read_text()}print(size(nagideal));\nquit;\n"
    command = ["Singular", "-q", "--no-rc"]
    printed = subprocess.run(
        command, input=script, capture_output=True, text=True, timeout=60
    ).stdout
    assert printed.split() == [str(len(names))]


@pytest.mark.parametrize("name", ["I", "K"])
def test_what_a_program_of_macaulay2_makes_of_an_ideal_is_left_alone(
    name: str, tmp_path: Path
) -> None:
    file = tmp_path / "ideal.m2"
    given = f"R = QQ[x,y,z]\n{name} = ideal(x*y, x*z)\n"
    for line in (f"J = {name}", f"d = dim {name}", f"P = decompose {name}; {name}"):
        file.write_text(given + line)
        assert nag.read(file).system == nag.system(["x*y", "x*z"], "x y z")
    file.write_text(f"{given}J = {name} + ideal(x - z^2)")
    with pytest.raises(nag.InputError, match="line 3, column 5: sums of ideals are not read"):
        nag.read(file)
