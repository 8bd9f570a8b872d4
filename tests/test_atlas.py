"""The atlas counts answers by what is known exactly, and tells what changed."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from exact_counts import zero_set

import nag
from nag.algebra.evaluation import Evaluator
from nag.algebra.family import Family as PolynomialFamily
from nag.bench.atlas.asked import SINGULAR, ask_method
from nag.bench.atlas.changes import KINDS, sparsely_changed
from nag.bench.atlas.curves import tangent_slice
from nag.bench.atlas.families import FAMILIES, KnobFamily
from nag.bench.atlas.linkages import bennett_violated, bricard_violated, slider_crank
from nag.bench.atlas.moved import GROUPS, case_system
from nag.bench.atlas.nine_points import NinePoints
from nag.bench.atlas.stability import (
    Atlas,
    Cell,
    FamilyRow,
    changes,
    document,
    family_named,
    read_atlas,
    run_atlas,
)
from nag.bench.verdicts import agrees
from nag.cli import main
from nag.files.cases import read_case
from nag.numerics.discs import DiscPolynomials, Discs
from nag.numerics.krawczyk import find_overlaps, prove_boxes
from nag.numerics.local_dimension import local_dimension
from nag.solving.parameter_line import parameter_line
from nag.solving.solve import solve
from nag.solving.start.family_monodromy import first_solution
from nag.tracking.paths import PathStatus
from nag.tracking.settings import Settings, find_settings
from nag.tracking.track import track
from nag.witness.moving import witness_at
from nag.witness.witness import WitnessSet

CASES = Path(__file__).parents[1] / "cases"


def test_families_have_names_of_their_own() -> None:
    names = [f.name for f in FAMILIES]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda f: f.name)
def test_each_value_is_a_system_of_the_method_and_the_same_for_a_seed(family: KnobFamily) -> None:
    made = [family.make(value, np.random.default_rng(5)) for value in family.values]
    assert all(family.method in problem.methods for problem in made)
    again = family.make(family.values[-1], np.random.default_rng(5))
    assert again.system == made[-1].system


@pytest.mark.parametrize("name", ["tangent", "hyperbola", "cubic", "circles", "touching", "unity"])
def test_what_is_known_of_a_family_is_exact(name: str) -> None:
    family = family_named(name)
    for value in family.values[:4]:
        problem = family.make(value, np.random.default_rng(3))
        exact = zero_set(problem.system) if problem.system.n < 3 else None
        assert exact is None or exact.agrees(problem.truth)


@pytest.mark.parametrize("digits", [0, 2, 10, 30])
def test_what_violates_bennetts_condition_leaves_one_simple_point(digits: int) -> None:
    problem = bennett_violated(digits, np.random.default_rng(0))
    exact = zero_set(replace(problem.system, nonzero=()))
    assert exact is not None and exact.agrees(problem.truth)
    assert bool(digits) == ((0, 1, 1) in problem.truth)


@pytest.mark.parametrize("digits", [0, 8, 30])
def test_slider_cranks_have_nodes_exactly_where_the_lengths_add_up(digits: int) -> None:
    problem = slider_crank(digits, np.random.default_rng(2))
    upright = tuple(Fraction(c) for c in (0, 1, 0, -1, 0, -1))
    vanish = [f(upright) == 0 for f in problem.system.polynomials]
    assert all(vanish) == (digits == 0) == bool(problem.facts)
    if digits == 0:
        found = local_dimension(problem.system, upright)
        assert SINGULAR.format(found.dimension, found.tangent_dimension, 2) in problem.facts


def test_every_case_whose_components_are_known_is_in_the_atlas() -> None:
    paths = [path for path in CASES.rglob("*.toml") if read_case(path).truth]
    cases = [str(path.relative_to(CASES).with_suffix("")) for path in paths]
    run = [name for names in GROUPS.values() for name in names]
    assert sorted(run) == sorted(cases)


@pytest.mark.parametrize("kind", KINDS)
def test_sparse_changes_keep_the_zero_set(kind: str) -> None:
    points = nag.system(["x^2 + y^2 - 2", "x*y^2 - 3*x + 1"])
    whole = nag.system(["(x - 2*y)*(x^2 + y^2 - 2)^2", "(x - 2*y)*(y - 1)*(x + 3)"])
    for seed in range(6):
        for before in (points, whole):
            after = sparsely_changed(before, np.random.default_rng(seed), kind)
            assert zero_set(after) == zero_set(before)


def test_points_that_are_elsewhere_than_they_say_are_no_right_answer(monkeypatch) -> None:
    problem = tangent_slice(8, np.random.default_rng(0))
    right = ask_method("slice", problem, 0, "default")
    assert right.complete and agrees(right, problem.zero_set)

    def off(*arguments: Any, **options: Any) -> WitnessSet:
        found = witness_at(*arguments, **options)
        return replace(found, points=found.points + 1e-12)

    monkeypatch.setattr("nag.bench.atlas.asked.witness_at", off)
    assert not agrees(ask_method("slice", problem, 0, "default"), problem.zero_set)


def test_the_violated_cube_has_six_proved_configurations() -> None:
    system = bricard_violated(4, np.random.default_rng(0)).system
    found = solve(replace(system, nonzero=()))
    slices = np.zeros((0, 1 + system.n), dtype=complex)
    boxes = prove_boxes(system.polynomials, slices, found.points, np.full(len(found.points), 1e-6))
    assert boxes.proved.all()
    assert find_overlaps(boxes) == ([], [])
    values = DiscPolynomials.of(system.nonzero, slices)(Discs(boxes.centres, boxes.inner))
    assert int((np.abs(values.mid) > 2 * values.rad).all(axis=1).sum()) == 6


@pytest.mark.parametrize("digits", [6, 8, 12])
def test_configurations_beside_what_is_excluded_are_found(digits: int) -> None:
    system = bricard_violated(digits, np.random.default_rng(0)).system
    answer = nag.decompose(system)
    assert answer.complete
    assert [(c.dimension, c.multiplicity) for c in answer.components] == [(0, 1)] * 6


@pytest.mark.parametrize("power", [10, 12, 16])
def test_configurations_too_near_to_what_is_excluded_are_not_left_out_in_silence(
    power: int,
) -> None:
    system = bricard_violated(power, np.random.default_rng(0)).system
    answer = solve(system, settings=Settings(digits=32))
    assert not answer.complete and len(answer.solutions) < 6


@pytest.mark.parametrize("power", [6, 8])
def test_a_parallelogram_with_bars_of_very_different_lengths_has_two_curves(power: int) -> None:
    system = family_named("lengths").make(power, np.random.default_rng(0)).system
    answer = nag.decompose(system)
    assert answer.complete
    assert sorted(c.degree for c in answer.components) == [2, 4]


def _atlas(right: int, undecided: int, wrong: int) -> Atlas:
    cell = Cell(2, right=right, undecided=undecided, wrong=wrong, seconds=0.5, remarks=("x",))
    return Atlas(
        "default", right + undecided + wrong, 10.0, (FamilyRow("a", "b", "c", "solve", (cell,)),)
    )


def test_an_atlas_reads_back_equal() -> None:
    atlas = _atlas(1, 2, 3)
    assert read_atlas(json.loads(json.dumps(document(atlas)))) == atlas


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (("rows", 0, "cells", 0, "right"), "many"),
        (("rows", 0, "cells", 0, "value"), 2.5),
        (("rows", 0, "cells"), []),
        (("rows", 0), 1),
        (("limit",), "long"),
    ],
)
def test_a_damaged_atlas_is_refused_in_one_line(place, value, tmp_path: Path, capsys) -> None:
    content = json.loads(json.dumps(document(_atlas(1, 2, 3))))
    part = content
    for key in place[:-1]:
        part = part[key]
    part[place[-1]] = value
    target = tmp_path / "atlas.json"
    target.write_text(json.dumps(content))
    assert main(["chart", "stability", "--data", str(target)]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_step_back_is_told_and_the_same_share_is_not() -> None:
    before = _atlas(20, 0, 0)
    assert list(changes(_atlas(2, 0, 0), before)) == []
    assert list(changes(_atlas(1, 0, 1), before)) == [
        "a 2: WORSE, 1 of 2 wrong, were 0 of 20",
        "a 2: WORSE, 1 of 2 right, were 20 of 20",
    ]
    assert [line.split(",")[0] for line in changes(before, _atlas(1, 1, 0))] == ["a 2: better"]


def test_families_that_are_not_run_are_taken_from_another_atlas(tmp_path: Path, capsys) -> None:
    kept = Path(__file__).parents[1] / "nag" / "bench" / "charts" / "stability.json"
    before, target = read_atlas(json.loads(kept.read_text())), tmp_path / "atlas.json"
    now = replace(before, rows=(replace(before.rows[2], text="run again"), *before.rows[4:6]))
    (tmp_path / "now.json").write_text(json.dumps(document(now)))
    command = ["chart", "stability", "--data", str(tmp_path / "now.json"), "--json", str(target)]
    assert main([*command, "--rest", str(kept)]) == 0
    found = read_atlas(json.loads(target.read_text()))
    assert [row.name for row in found.rows] == [row.name for row in before.rows]
    texts = {row.name: row.text for row in found.rows}
    assert texts == {row.name: row.text for row in before.rows} | {now.rows[0].name: "run again"}
    (tmp_path / "now.json").write_text(json.dumps(document(replace(now, seeds=3))))
    assert main([*command, "--rest", str(kept)]) == 2
    assert "seeds" in capsys.readouterr().err


def test_answers_are_counted_over_seeds() -> None:
    atlas = run_atlas([replace(family_named("unity"), values=(2, 10))], seeds=2, limit=20.0)
    assert [(c.value, c.right, c.answers) for c in atlas.rows[0].cells] == [(2, 2, 2), (10, 2, 2)]


def test_the_kept_atlas_is_drawn_without_a_run(tmp_path: Path, capsys) -> None:
    pytest.importorskip("matplotlib")
    kept = Path(__file__).parents[1] / "nag" / "bench" / "charts" / "stability.json"
    target = tmp_path / "atlas.svg"
    main(["chart", "stability", "--data", str(kept), "--picture", str(target)])
    assert "right" in capsys.readouterr().out
    assert target.read_text().startswith("<?xml")


@pytest.mark.parametrize(
    "arguments",
    [
        ["--family", "nothing"],
        ["--rest", "/nowhere/atlas.json"],
        ["--data", "/nowhere/atlas.json"],
        ["--picture", "atlas.txt"],
        ["--seeds", "0"],
        ["--against", "/nowhere/atlas.json"],
    ],
)
def test_bad_arguments_are_one_line(arguments: list[str], capsys) -> None:
    assert main(["chart", "stability", *arguments]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def _zero(
    family: PolynomialFamily, first: np.ndarray, start: np.ndarray, values: np.ndarray
) -> np.ndarray:
    """Where a zero for the first parameters leads to."""
    line = parameter_line(family, first, values)
    paths = track(line.homotopy, line.starts(start[None]), find_settings("fast"), endgame=False)
    assert paths.status[0] == PathStatus.REGULAR
    return line.affine(paths.points)


def _changed(made: NinePoints, zeros: np.ndarray) -> SimpleNamespace:
    """Zeros of the case's family in the unknowns of the changed one."""
    count = len(made.order)
    halves = [
        zeros[:, [h * count + i for i in made.order]] / np.array(made.factors, float)
        for h in (0, 1)
    ]
    return SimpleNamespace(points=made.family.outer(np.hstack(halves)))


@pytest.mark.parametrize("seed", range(6))
def test_a_zero_for_moved_nine_points_is_carried_to_one_for_those_of_the_case(seed: int) -> None:
    rng = np.random.default_rng(seed)
    made = NinePoints.random(read_case(CASES / "benchmarks" / "nine-point.toml").family, rng)
    plain = made.case.symmetric
    first, start = first_solution(plain.family, rng)
    moved = _zero(plain.family, first, start, plain.inner_values(made.targets[0]))
    # The changed family has the same zero.
    changed = _changed(made, moved)
    evaluator = Evaluator.of(made.family.original.at(made.targets[0]).polynomials, 24)
    assert evaluator.residuals(changed.points).max() < 1e-9
    image = made.motion.zeros_before(moved, made.displacements)
    assert made.carried(changed, _changed(made, image)) == 1
    other = made.motion.zeros_before(_renamed(moved), made.displacements)
    assert made.carried(changed, _changed(made, other)) == 0


def _renamed(zero: np.ndarray) -> np.ndarray:
    """The zero with the names of the two cranks changed."""
    x, a, y, b, *turns = range(12)
    order = np.array([y, b, x, a, *turns])
    return zero[:, np.concatenate([order, 12 + order])]


# Those at 16 and 30 digits are proved in `test_certificates`.
CLOSE = [(name, 8, digits) for name in ("cluster-2", "far-cluster") for digits in (12, 20)]
# Ends of three paths at once.
CLOSE += [("triple", 20, 12)]


@pytest.mark.parametrize(("name", "count", "digits"), CLOSE)
def test_zeros_far_closer_than_doubles_are_told_apart(name: str, count: int, digits: int) -> None:
    result = solve(family_named(name).make(digits, np.random.default_rng([3, 20])).system, seed=3)
    assert result.complete
    assert [s.multiplicity for s in result.solutions] == [1] * count


def test_something_is_known_of_every_case_in_the_formulation_that_is_moved() -> None:
    names = [name for group in GROUPS.values() for name in group]
    assert [name for name in names if not case_system(name)[1]] == []
