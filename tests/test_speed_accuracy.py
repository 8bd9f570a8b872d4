"""Charts measure errors against proved references, and are drawn again from their data."""

from __future__ import annotations

import json
from pathlib import Path

import flint
import numpy as np
import pytest

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench import peer_points, sharpening
from nag.bench.chart_data import document, read_charts
from nag.bench.reference import Reference, ReferenceError, compared, compared_in_balls
from nag.bench.speed_accuracy import Subject, chart_of, ratios
from nag.bench.whole_paths import WHOLE_TOLERANCES, WholePaths, tracked_in
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
    found = compared(reference, ROOTS + 1e-9)
    assert (found.share, found.false) == (1.0, 0)
    # Zeros of a size above one: the shift is relative to the largest coordinate.
    size = np.abs(ROOTS).max(axis=1).min()
    assert found.largest == pytest.approx(1e-9 / size, rel=1e-5)


def test_points_that_are_missing_or_false_or_repeated_are_counted() -> None:
    reference = Reference.of(SYSTEM, ROOTS, NONE)
    points = np.vstack([ROOTS[:2], ROOTS[:1], [[7, 7]]])
    found = compared(reference, points)
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


@pytest.fixture(scope="module", params=["katsura-6", "chemequ"])
def solved(request: pytest.FixtureRequest) -> tuple[str, WholePaths, Reference]:
    folder = "benchmarks" if request.param == "katsura-6" else "hard"
    system = read_case(Path("cases") / folder / f"{request.param}.toml").system
    found = solve(system)
    reference = Reference.of(system, found.points, np.zeros((0, 1 + system.n), complex))
    return request.param, WholePaths.of(system, 0), reference


@pytest.mark.parametrize(
    ("arithmetic", "most"),
    [
        ("double", 1e-11),
        ("double, residuals in double-double", 1e-15),
        ("double-double", 1e-29),
        ("quad-double", 1e-60),
        ("balls of 50 digits", 1e-48),
        ("balls of 100 digits", 1e-98),
    ],
)
def test_paths_in_an_arithmetic_end_as_near_to_the_zeros_as_it_can(
    solved: tuple[str, WholePaths, Reference], arithmetic: str, most: float
) -> None:
    name, paths, reference = solved
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
        found = compared_in_balls(reference, [*points, points[0], [flint.acb(7)] * 2])
        assert (found.share, found.false) == (1.0, 2)
        size = np.abs(ROOTS).max(axis=1).min()
        assert found.largest == pytest.approx(off / size, rel=1e-5)


def test_a_chart_reads_back_and_is_compared(once: None) -> None:
    chart = chart_of(Subject("roots", SYSTEM, False, ((0, 1, 4),)), seeds=1, peers=False)
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
        chart_of(Subject("roots", SYSTEM, False, ((0, 1, 5),)), seeds=1, peers=False)


def test_without_isolated_solutions_there_is_no_reference() -> None:
    none = PolynomialSystem(("x", "y"), (x * y - 1, x * y - 2))
    with pytest.raises(ReferenceError, match="no isolated solutions"):
        chart_of(Subject("none", none, False, ()), seeds=1, peers=False)


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
        peer_points, "call",
        lambda *_: (1.0, "seconds .25\nvalue .5p53e1 -.125p53e-2\nvalue 1 0\n"),
    )  # fmt: skip
    found = peer_points.peer_points("M2", SYSTEM, 1.0)
    assert found.seconds == 0.25
    assert found.points.tolist() == [[5 - 0.00125j, 1]]


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
