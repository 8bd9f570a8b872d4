"""Charts measure errors against proved references, and are drawn again from their data."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path

import flint
import numpy as np
import pytest

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench import peer_components, peer_points, peers, sharpening
from nag.bench.component_curves import Listed, agreement, witness_section
from nag.bench.peer_points import forms
from nag.bench.reference import Reference, ReferenceError, compare_in_balls, compare_points
from nag.bench.speed_accuracy import chart_of, ratios
from nag.bench.speed_accuracy_picture import COLOURS, MARKS, PEERS
from nag.bench.whole_paths import WHOLE_TOLERANCES, WholePaths, tracked_in
from nag.bench.work_precision import (
    ChartCurve,
    MeasuredCase,
    Point,
    best_form,
    document,
    read_charts,
)
from nag.cli import main
from nag.files.cases import read_case
from nag.solving.solve import solve

x, y = Polynomial.variables(2)
SYSTEM = PolynomialSystem(("x", "y"), (x**2 - 2, y**2 - x - 5))
NONE = np.zeros((0, 3), dtype=complex)
ROOTS = np.array([[a, b * (a + 5) ** 0.5] for a in (2**0.5, -(2**0.5)) for b in (1, -1)], complex)
KEPT = Path(__file__).parents[1] / "nag" / "bench" / "charts" / "speed-accuracy.json"


def test_errors_are_those_beside_the_exact_zeros() -> None:
    reference = Reference.of(SYSTEM, ROOTS, NONE)
    found = compare_points(reference, ROOTS + 1e-9)
    assert (found.share, found.false) == (1.0, 0)
    # Zeros of a size above one: the shift is relative to the largest coordinate.
    size = np.abs(ROOTS).max(axis=1).min()
    assert found.largest == pytest.approx(1e-9 / size, rel=1e-5)


def test_points_that_are_missing_or_false_or_repeated_are_counted() -> None:
    reference = Reference.of(SYSTEM, ROOTS, NONE)
    points = np.vstack([ROOTS[:2], ROOTS[:1], [[7, 7]]])
    found = compare_points(reference, points)
    assert (found.share, found.false) == (0.5, 2)


@pytest.mark.parametrize("points", [[[1.0, 1.0]] * 2, [[1.0, 1.0]]])
def test_there_is_no_reference_of_repeated_or_multiple_zeros(points: list) -> None:
    simple = PolynomialSystem(("x", "y"), (x - 1, y**2 - x))
    double = PolynomialSystem(("x", "y"), (x - 1, y**2 - 2 * y + x))
    with pytest.raises(ReferenceError):
        Reference.of(simple if len(points) > 1 else double, np.array(points, complex), NONE)


@pytest.fixture
def once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is run again for the sake of its time."""
    monkeypatch.setattr(sharpening, "RUNS", 0.0)


def test_balls_reach_their_digits_and_doubles_theirs(once: None) -> None:
    curves = sharpening.sharpening(SYSTEM, Reference.of(SYSTEM, ROOTS, NONE))
    assert curves["double"][-1].largest < 1e-15
    assert curves["double-double"][-1].largest < 1e-30
    assert curves["quad-double"][-1].largest < 1e-61
    assert curves["balls of 50 digits"][-1].largest < 1e-48
    assert curves["balls of 100 digits"][-1].largest < 1e-98


@cache
def solved(name: str) -> tuple[WholePaths, Reference]:
    folder = "benchmarks" if name == "katsura-6" else "hard"
    system = read_case(Path("cases") / folder / f"{name}.toml").system
    found = solve(system)
    reference = Reference.of(system, found.points, np.zeros((0, 1 + system.n), complex))
    return WholePaths.of(system, 0), reference


MOST = {
    "double": 1e-11,
    "double, residuals in double-double": 1e-15,
    "double-double": 1e-29,
    "quad-double": 1e-60,
    "balls of 50 digits": 1e-48,
    "balls of 100 digits": 1e-98,
}


@pytest.mark.parametrize(
    ("name", "arithmetic"),
    [
        *(("katsura-6", arithmetic) for arithmetic in MOST),
        # Its paths take two seconds in quad-double, with the same source as in double-double.
        *(("chemequ", arithmetic) for arithmetic in MOST if arithmetic != "quad-double"),
    ],
)
def test_paths_in_an_arithmetic_end_as_near_to_the_zeros_as_it_can(
    name: str, arithmetic: str
) -> None:
    paths, reference = solved(name)
    most = MOST[arithmetic]
    seconds, evaluations, ends = tracked_in(paths, reference, arithmetic, 1e-3)
    assert (ends.share, ends.false) == (1.0, 0)
    # Coordinates of chemequ are of sizes 1e-5 to 1e2, and its zeros badly conditioned.
    assert ends.median <= ends.largest < (most if name == "katsura-6" else 1e3 * most)
    assert seconds > 0 and evaluations > 0


def test_errors_in_balls_are_those_in_doubles_and_go_on_beyond_them() -> None:
    reference = Reference.of(SYSTEM, ROOTS, NONE)
    for off in (1e-9, 1e-40):
        with flint.ctx.workdps(120):
            points = [[z + off for z in box.centre] for box in reference.boxes]
        found = compare_in_balls(reference, [*points, points[0], [flint.acb(7)] * 2])
        assert (found.share, found.false) == (1.0, 2)
        size = np.abs(ROOTS).max(axis=1).min()
        assert found.largest == pytest.approx(off / size, rel=1e-5)


def test_a_chart_reads_back_and_is_compared(once: None) -> None:
    chart = chart_of(MeasuredCase("roots", SYSTEM, False, ((0, 1, 4),)), seeds=1, peers=False)
    assert (chart.expected, chart.certified) == (4, 4)
    assert chart.proved_paths == chart.paths
    again = read_charts(json.loads(json.dumps(document([chart]))))
    assert document(again) == document([chart])
    assert ratios(again)[1][:2] == ["roots", "100%"]


@pytest.mark.parametrize("key", ["seconds", "largest", "name", "evaluations"])
def test_damaged_data_are_refused_in_one_line(key: str, tmp_path: Path, capsys) -> None:
    content = json.loads(KEPT.read_text())
    content["charts"][0]["curves"][0]["points"][0][key] = [0]
    target = tmp_path / "charts.json"
    target.write_text(json.dumps(content))
    assert main(["chart", "speed-accuracy", "--data", str(target)]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_number_of_solutions_that_is_not_known_to_be_so_is_no_reference() -> None:
    with pytest.raises(ReferenceError):
        chart_of(MeasuredCase("roots", SYSTEM, False, ((0, 1, 5),)), seeds=1, peers=False)


def test_without_isolated_solutions_there_is_no_reference() -> None:
    none = PolynomialSystem(("x", "y"), (x * y - 1, x * y - 2))
    with pytest.raises(ReferenceError, match="no isolated solutions"):
        chart_of(MeasuredCase("none", none, False, ()), seeds=1, peers=False)


def test_paths_that_end_on_a_curve_are_not_sharpened_in_balls() -> None:
    u, v, w = Polynomial.variables(3)
    # A line, and the point (2, 0, 0).
    beside = PolynomialSystem(("u", "v", "w"), (u * v, u * w, (v - 1) * (u - 2)))
    points = np.array([[2.0, 0.0, 0.0]], complex)
    reference = Reference.of(beside, points, np.zeros((0, 4), dtype=complex))
    for arithmetic in ("balls of 50 digits", "balls of 100 digits"):
        for tolerance in WHOLE_TOLERANCES:
            paths = WholePaths.of(beside, 0)
            _, _, found = tracked_in(paths, reference, arithmetic, tolerance)
            assert found.share == 1 and found.largest < 1e-40


def test_answers_of_other_programs_are_read_to_all_digits(monkeypatch) -> None:
    monkeypatch.setattr(
        peers, "call",
        lambda *_: (1.0, "seconds .25\nvalue .5p53e1 -.125p53e-2\nvalue 1 0\n"),
    )  # fmt: skip
    found = peer_points.peer_points("M2", SYSTEM, 1.0)
    assert found.seconds == 0.25
    assert found.points.tolist() == [[5 - 0.00125j, 1]]


CIRCLE = PolynomialSystem(("x", "y"), (x**2 + y**2 - 1,))
# The circle meets x - y = 0, which a program doubles, at (r, r) and (-r, -r) for r^2 = 1/2.
R = 0.7071067811865476
M2_SAYS = f"""seconds .5
component 1
value 0p53 0p53
value .2p53e1 0p53
value -.2p53e1 0p53
value {R}p53 0p53
value {R}p53 0p53
value -{R}p53 0p53
value -{R}p53 0p53
"""
PHC_SAYS = f"""
Writing the factors of dimension 1 ...

FACTOR 1 :
 3

+1*xaa^2
+1*xab^2
+( 9.00000000000000E-01 + 1.00000000000000E-01*i)*zz1
-1;

+1*zz1;

+( 2.00000000000000E+00 + 0.00000000000000E+00*i)*xaa
-2.00000000000000E+00*xab
+(-3.00000000000000E-01 - 4.00000000000000E-01*i)*zz1;

THE SOLUTIONS :
2 3
===
solution 1 :
the solution for t :
 xaa :  {R:.15E}  0.0E+00
 xab :  {R:.15E}  0.0E+00
 zz1 :  0.0E+00  0.0E+00
== err :  1.0E-16 = rco :  1.0E-01 = res :  1.0E-16 ==
solution 2 :
the solution for t :
 xaa : -{R:.15E}  0.0E+00
 xab : -{R:.15E}  0.0E+00
 zz1 :  0.0E+00  0.0E+00
== err :  1.0E-16 = rco :  1.0E-01 = res :  1.0E-16 ==

dim |  CPU user time | degrees of factors
"""


def _program_says(monkeypatch, text: str) -> None:
    def call(command, folder, limit, given=None):
        (Path(folder) / "answer").write_text(text)
        return 1.0, text

    monkeypatch.setattr(peers, "call", call)


@pytest.mark.parametrize(("program", "text"), [("M2", M2_SAYS), ("phc", PHC_SAYS)])
def test_components_of_other_programs_are_measured_on_their_own_slices(
    program: str, text: str, monkeypatch
) -> None:
    _program_says(monkeypatch, text)
    (found,) = peer_components.peer_components(program, CIRCLE, 1.0, 0).components
    assert found.rows.tolist() == [[0, 2, -2]]
    listed = Listed(found.points, found.rows)
    right = agreement(CIRCLE, [listed], [(1, 2, 1)])
    assert (right.share, right.false) == (1.0, 0)
    assert right.largest < 2e-16
    off = Listed(found.points + 1e-9, found.rows)
    assert agreement(CIRCLE, [off], [(1, 2, 1)]).largest == pytest.approx(1e-9, rel=1e-6)
    assert agreement(CIRCLE, [listed, listed], [(1, 2, 1)]).false == 1
    # A program is not told which polynomials must not vanish.
    inside = replace(CIRCLE, nonzero=(x - y,))
    assert peer_components.peer_components(program, inside, 1.0, 0).components == ()


def test_a_program_that_gives_no_components_says_so(monkeypatch) -> None:
    _program_says(monkeypatch, "refused not yet implemented")
    found = peer_components.peer_components("bertini2", CIRCLE, 1.0, 0)
    assert found.components is None
    assert found.remark == "no answer: not yet implemented"


def test_a_slice_meets_the_components_in_as_many_points_as_their_degrees() -> None:
    whole = PolynomialSystem(("x", "y"), ((x**2 + y**2 - 1) * (x - 3 * y), 0 * x))
    rng = np.random.default_rng(0)
    degrees = ((1, 2, 1), (1, 1, 1))
    section, square, reference = witness_section(MeasuredCase("both", whole, True, degrees), rng)
    assert len(square.polynomials) == 2 < len(section.polynomials)
    assert len(reference.high) == 3
    with pytest.raises(ReferenceError, match="in 4 simple points"):
        witness_section(MeasuredCase("both", whole, True, ((1, 2, 2),)), rng)


def test_the_best_form_finds_most_then_to_the_accuracy_then_soonest() -> None:
    def curve(name: str, share: float, largest: float, seconds: float) -> ChartCurve:
        return ChartCurve("peer", name, (Point(name, seconds, 0, share, 0, largest, largest),))

    none = ChartCurve("peer", "none", (), "no answer")
    some, rough = curve("some", 0.9, 1e-16, 1.0), curve("rough", 1.0, 1e-9, 1.0)
    slow, fast = curve("slow", 1.0, 1e-15, 3.0), curve("fast", 1.0, 1e-13, 2.0)
    for k, best in enumerate(order := (none, some, rough, slow, fast)):
        assert best_form(order[: k + 1]) is best


def test_divided_equations_have_the_same_zeros_and_largest_coefficient_one() -> None:
    large = PolynomialSystem(("x", "y"), (10**11 * x**2 - 3 * y, x + 7 * y))
    as_given, divided = forms(large).values()
    assert as_given is large
    assert [max(abs(c) for c in f.terms.values()) for f in divided.polynomials] == [1, 1]
    assert forms(PolynomialSystem(("x", "y"), (x - y, x * y - 1))).keys() == {""}


def _lightness(colour: str) -> float:
    """L* of CIELAB, from 0 to 100."""
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    y = float(np.dot(linear, [0.2126, 0.7152, 0.0722]))
    return 116 * y ** (1 / 3) - 16 if y > 0.008856 else 903.3 * y


def test_curves_differ_in_lightness_and_in_marks() -> None:
    steps = np.diff([_lightness(c) for c in COLOURS])
    assert steps.min() > 10
    marks = [*MARKS, *(mark for _, mark in PEERS.values())]
    assert len(set(marks)) == len(marks)


def test_kept_charts_are_drawn_without_a_run(tmp_path: Path, capsys) -> None:
    pytest.importorskip("matplotlib")
    charts = json.loads(KEPT.read_text())
    charts["charts"] = charts["charts"][:1]
    data, target = tmp_path / "data.json", tmp_path / "all.png"
    data.write_text(json.dumps(charts))
    arguments = ["chart", "speed-accuracy", "--data", str(data), "--picture", str(target)]
    assert main(arguments) == 0
    name = charts["charts"][0]["case"]
    assert target.is_file()
    assert (tmp_path / f"all-{name}.png").is_file()
    assert name in capsys.readouterr().out


@pytest.mark.parametrize(
    "arguments",
    [["nothing-of-that-name"], ["--data", "/nowhere.json"], ["--picture", "chart"]],
)
def test_bad_arguments_are_one_line(arguments: list[str], capsys) -> None:
    assert main(["chart", "speed-accuracy", *arguments]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
