"""What is printed says what the objects say, and no more."""

from __future__ import annotations

import io
import math
import os
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.algebra.expression import parse_polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem, system_line
from nag.report.agreement import AgreementKind, agreement_text, compare
from nag.text.progress_line import INTERVAL, MINUTE, progress_line
from nag.text.table import align, label_lines, magnitude, printable
from nag.witness.frame import expand_orbits
from nag.witness.shown import component_table, multidegree_text, remarks, title_line
from nag.witness.witness import Decomposition, PathCounts, Slice, Status, WitnessSet


@dataclass(frozen=True)
class Known:
    """What a case says is known, as `nag.files.cases.Truth` has it."""

    dimension: int
    degree: int
    count: int = 1
    multiplicity: int = 1
    multidegree: tuple[int, ...] | None = None
    formulation: str | None = None
    source: str = "a book"


def component(dimension: int, degree: int, **changes: object) -> WitnessSet:
    n = 3
    plain = WitnessSet(
        slice=Slice(np.eye(dimension, n), np.zeros(dimension)),
        points=np.zeros((degree, n)),
        multiplicity=1,
        status=Status.IRREDUCIBLE,
        residual=2e-16,
        radii=np.full((degree, n), 3e-15 / 3**0.5),
        digits=np.full(degree, 32),
        corank=dimension,
    )
    return replace(plain, **changes)


def undecided(dimension: int, degree: int) -> WitnessSet:
    return component(dimension, degree, status=Status.UNDECIDED, multiplicity=0, note="not reduced")


def decomposition(*components: WitnessSet, groups: tuple = (), notes: tuple = ()) -> Decomposition:
    variables = ("x", "y", "z")
    system = PolynomialSystem(variables, [parse_polynomial("x*y - z^2", variables)], (), groups)
    complete = not notes and all(c.status is Status.IRREDUCIBLE for c in components)
    return Decomposition(
        system, components, PathCounts(4, 1, 2), 0, "default", (0,), complete, notes
    )


def test_like_components_are_counted_together() -> None:
    nine = decomposition(*[component(2, 4)] * 9)
    assert title_line(nine) == "9 components of dimension 2, degree 4"
    mixed = decomposition(component(2, 1), *[component(1, 2)] * 2, undecided(1, 2))
    assert title_line(mixed) == (
        "1 component of dimension 2, degree 1; 1 component of dimension 1, degree 2, "
        "multiplicity not known; 2 components of dimension 1, degree 2 (1 undecided)"
    )
    assert title_line(decomposition()) == "no component"


def test_an_orbit_counts_with_all_its_members() -> None:
    orbit = decomposition(component(1, 2, orbit=8))
    assert title_line(orbit) == "8 components of dimension 1, degree 2"
    assert component_table(orbit)[1].split()[4] == "8"


def test_rows_name_the_components_by_the_numbers_that_commands_take() -> None:
    swap = SignedPermutation((1, 0, 2), (1, 1, 1))
    pair = component(1, 2, orbit=2, images=(swap,))
    found = decomposition(component(2, 1), pair, component(1, 3), pair)
    rows = [line.split()[:3] for line in component_table(found)[1:]]
    assert rows == [["1", "2", "1"], ["2-3,", "5-6", "1"], ["4", "1", "3"]]
    kinds_in_order = [c.degree for c in expand_orbits(found).components]
    assert kinds_in_order == [1, 2, 2, 3, 2, 2]


def test_a_row_shows_the_worst_of_its_components() -> None:
    table = component_table(
        decomposition(
            component(1, 2, residual=1e-16, radii=[[4e-9, 0, 0], [0, 0, 0]], digits=[16, 32]),
            component(1, 2, residual=5e-13),
            component(1, 4, residual=math.nan),
        )
    )
    headings = (
        "number  dimension  degree  multiplicity  count  status       residual  accuracy  digits"
    )
    assert table[0] == headings
    assert [line.split() for line in table[1:]] == [
        ["1-2", "1", "2", "1", "2", "irreducible", "5.0e-13", "4.0e-09", "16"],
        ["3", "1", "4", "1", "1", "irreducible", "?", "3.0e-15", "32"],
    ]


def test_an_unknown_multiplicity_is_a_question_mark() -> None:
    assert component_table(decomposition(undecided(1, 2)))[1].split()[3:6] == [
        "?",
        "1",
        "undecided",
    ]


def test_multidegrees_stand_in_the_table_only_where_there_are_groups() -> None:
    curve = component(1, 3, multidegree=[1, 2])
    assert "multidegree" in component_table(decomposition(curve, groups=((0, 1), (2,))))[0]
    assert "(1, 2)" in component_table(decomposition(curve, groups=((0, 1), (2,))))[1]
    assert "multidegree" not in component_table(decomposition(curve))[0]


def test_multidegrees_name_each_choice_of_groups_once() -> None:
    assert multidegree_text(np.array(1)) == "-"
    assert multidegree_text(np.array([2, 0, 1])) == "(2, 0, 1)"
    assert multidegree_text(np.array([[0, 3], [3, 2]])) == "1.2: 3, 2.2: 2"
    assert multidegree_text(np.arange(100)) == "see the export"


def test_remarks_say_why_an_answer_is_incomplete() -> None:
    lines = remarks(
        decomposition(undecided(1, 2), undecided(1, 2), component(1, 2), notes=("2 paths failed",))
    )
    assert lines == ["undecided: dimension 1, degree 2: not reduced", "2 paths failed"]


def test_system_line_counts_variables_equations_and_degrees() -> None:
    assert system_line(decomposition().system) == (
        "3 variables (x, y, z), 1 equation: 1 of degree 2"
    )
    irrational = PolynomialSystem(("x",), [parse_polynomial("x - sqrt(2)", ["x"])])
    assert system_line(irrational).endswith("; not all coefficients are rational")


def test_numbers_that_are_not_known_exactly_are_named() -> None:
    system = PolynomialSystem(("x",), [parse_polynomial("x*cos(1) - sqrt(2)*sin(2)^2", ["x"])])
    assert "cos(1), sin(2) are not known exactly: what agrees in 60 digits" in system_line(system)
    assert PolynomialSystem(("x",), [parse_polynomial("x - cos(pi/5)", ["x"])]).inexact_text == ""


@given(st.text())
def test_printed_text_is_one_line_that_cannot_steer_a_terminal(text: str) -> None:
    assert printable(text).isprintable()


@given(
    st.lists(st.lists(st.text(st.characters(codec="ascii")), min_size=3, max_size=3), min_size=1)
)
def test_columns_are_aligned(rows: list[list[str]]) -> None:
    widths = [max(len(row[i]) for row in rows) for i in range(3)]
    for row, line in zip(rows, align(rows), strict=True):
        assert line == "  ".join(c.rjust(w) for c, w in zip(row, widths, strict=True)).rstrip()


def test_labels_share_a_column() -> None:
    assert label_lines([("a", "x"), ("long", "y")], 6) == ["a       x", "long    y"]
    words = ["word"] * 40
    lines = label_lines([("a", " ".join(words))])
    assert lines[0].startswith("a  word") and lines[1].startswith("   word")
    assert max(map(len, lines)) <= 100
    assert " ".join(lines).split() == ["a", *words]


def test_magnitudes_have_two_digits() -> None:
    assert magnitude(3.14e-16) == "3.1e-16"
    assert magnitude(math.inf) == "?"


TWO_LINES = decomposition(component(1, 1), component(1, 1))


@pytest.mark.parametrize(
    ("answer", "truth", "verdict", "text"),
    [
        (
            TWO_LINES,
            [Known(1, 1, count=2)],
            AgreementKind.AGREES,
            "agrees with what is known: 2 components of dimension 1, degree 1 (a book)",
        ),
        (
            TWO_LINES,
            [Known(1, 1), Known(1, 1, source="a paper")],
            AgreementKind.AGREES,
            "agrees with what is known: 2 components of dimension 1, degree 1 (a book; a paper)",
        ),
        (
            TWO_LINES,
            [Known(1, 1, count=3)],
            AgreementKind.DIFFERS,
            "differs from what is known: not found: 1 component of dimension 1, degree 1 (a book)",
        ),
        (
            TWO_LINES,
            [Known(1, 1)],
            AgreementKind.DIFFERS,
            "differs from what is known: found but not known: "
            "1 component of dimension 1, degree 1 (a book)",
        ),
        (
            decomposition(component(1, 2)),
            [Known(1, 1, count=2)],
            AgreementKind.DIFFERS,
            "differs from what is known: not found: 2 components of dimension 1, degree 1; "
            "found but not known: 1 component of dimension 1, degree 2 (a book)",
        ),
        (
            decomposition(component(1, 2, multiplicity=2)),
            [Known(1, 2)],
            AgreementKind.DIFFERS,
            "differs from what is known: not found: 1 component of dimension 1, degree 2; "
            "found but not known: 1 component of dimension 1, degree 2, multiplicity 2 (a book)",
        ),
        (
            decomposition(component(1, 2), undecided(1, 2)),
            [Known(1, 2), Known(1, 2, multiplicity=2)],
            AgreementKind.OPEN,
            "agrees with what is known as far as it is decided: "
            "1 component of dimension 1, degree 2; known but not decided here: "
            "1 component of dimension 1, degree 2, multiplicity 2 (a book)",
        ),
        (
            decomposition(component(1, 2), component(0, 1)),
            [Known(1, 2)],
            AgreementKind.AGREES,
            "agrees with what is known: 1 component of dimension 1, degree 2; "
            "nothing is known of: 1 component of dimension 0, degree 1 (a book)",
        ),
    ],
)
def test_an_answer_is_compared_with_what_is_known(answer, truth, verdict, text) -> None:
    agreement = compare(answer, truth)
    assert agreement.verdict is verdict
    assert agreement_text(agreement) == text


def test_known_things_of_another_formulation_say_nothing() -> None:
    truth = [Known(1, 1, count=2, formulation="H"), Known(1, 4, formulation="E")]
    assert compare(TWO_LINES, truth, "H").verdict is AgreementKind.AGREES
    assert compare(TWO_LINES, truth, "E").verdict is AgreementKind.DIFFERS
    assert compare(TWO_LINES, truth) is None
    assert compare(TWO_LINES, []) is None


def test_multidegrees_are_compared_where_they_are_known() -> None:
    groups = ((0, 1), (2,))
    answer = decomposition(
        component(1, 3, multidegree=[1, 2]), component(1, 3, multidegree=[2, 1]), groups=groups
    )
    either = Known(1, 3)
    assert (
        compare(answer, [either, Known(1, 3, multidegree=(1, 2))]).verdict is AgreementKind.AGREES
    )
    assert (
        compare(answer, [either, Known(1, 3, multidegree=(2, 1))]).verdict is AgreementKind.AGREES
    )
    assert (
        compare(answer, [either, Known(1, 3, multidegree=(3, 0))]).verdict is AgreementKind.DIFFERS
    )


@pytest.fixture(autouse=True)
def a_terminal_that_erases(monkeypatch) -> None:
    monkeypatch.setenv("TERM", "xterm")


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_progress_is_shown_on_a_terminal_and_erased_and_quiet_is_quiet() -> None:
    terminal, pipe, quiet = Terminal(), io.StringIO(), Terminal()
    with progress_line(terminal) as progress:
        progress("slicing", 1, 3)
    assert "slicing: 1 of 3" in terminal.getvalue()
    assert terminal.getvalue().endswith("\r\x1b[K")
    with progress_line(pipe) as progress:
        progress("slicing", 1, 3)
    with progress_line(quiet, quiet=True) as progress:
        assert progress is None
    assert pipe.getvalue() == quiet.getvalue() == ""


def test_a_terminal_that_takes_no_line_away_is_written_to_as_a_file_is(monkeypatch) -> None:
    now = [0.0]
    monkeypatch.setattr("nag.text.progress_line.time.monotonic", lambda: now[0])
    monkeypatch.setenv("TERM", "dumb")
    terminal = Terminal()
    with progress_line(terminal) as progress:
        now[0] = MINUTE
        progress("slicing", 1, 3)
    assert terminal.getvalue().startswith("nag: slicing: 1 of 3")
    assert "\x1b" not in terminal.getvalue() and terminal.getvalue().endswith("\n")


@pytest.mark.skipif(not hasattr(os, "openpty"), reason="there are no pseudo-terminals")
@pytest.mark.parametrize("columns, least, most", [(0, 70, 79), (40, 30, 39)])
def test_a_line_is_no_wider_than_its_terminal(columns, least, most) -> None:
    import fcntl
    import struct
    import termios

    leader, follower = os.openpty()
    fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 0, columns, 0, 0))
    with open(follower, "w") as stream, progress_line(stream) as progress:
        assert progress is not None
        progress("slicing " * 30, 1, 3)
        line = os.read(leader, 4096).decode().removeprefix("\r\x1b[K")
    os.close(leader)
    assert least <= len(line) <= most


@pytest.mark.parametrize("kind, wait", [(Terminal, INTERVAL), (io.StringIO, MINUTE)])
def test_progress_is_not_written_more_often_than_it_can_be_read(kind, wait, monkeypatch) -> None:
    now = [0.0]
    monkeypatch.setattr("nag.text.progress_line.time.monotonic", lambda: now[0])
    stream = kind()
    with progress_line(stream) as progress:
        for step, now[0] in ((1, wait), (2, 1.5 * wait), (3, 2.5 * wait)):
            progress("splitting", step, 0)
    written = stream.getvalue()
    assert "splitting: 1" in written and "splitting: 3" in written
    assert "splitting: 2" not in written


def test_a_line_says_how_a_stage_goes_and_that_is_no_other_stage(monkeypatch) -> None:
    now = [0.0]
    monkeypatch.setattr("nag.text.progress_line.time.monotonic", lambda: now[0])
    terminal = Terminal()
    with progress_line(terminal) as progress:
        for step, now[0], remark in ((0, 20.0, ""), (30, 80.0, "; 7 doubtful")):
            progress(f"paths{remark}", step, 120)
    last = terminal.getvalue().split("\r\x1b[K")[-2]
    assert last.startswith("[#####---------------] 25 % paths: 30 of 120, 7 doubtful (1 min 20 s")


def test_a_line_says_the_rate_and_the_time_left_of_its_stage(monkeypatch) -> None:
    now = [0.0]
    monkeypatch.setattr("nag.text.progress_line.time.monotonic", lambda: now[0])
    pipe = io.StringIO()
    with progress_line(pipe) as progress:
        for step, now[0] in ((0, 20.0), (30, 80.0)):
            progress("paths", step, 120)
    assert pipe.getvalue() == (
        "nag: paths: 30 of 120 (1 min 20 s so far, 0.5 a second, 3 min 00 s left of this)\n"
    )


def test_a_line_tells_no_time_left_of_few_steps(monkeypatch) -> None:
    now = [0.0]
    monkeypatch.setattr("nag.text.progress_line.time.monotonic", lambda: now[0])
    pipe = io.StringIO()
    with progress_line(pipe) as progress:
        for step, now[0] in ((0, 20.0), (5, 80.0)):
            progress("intersecting", step, 7)
    assert "5 of 7" in pipe.getvalue() and "left" not in pipe.getvalue()
