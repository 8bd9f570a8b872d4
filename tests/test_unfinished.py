"""What is known before the work is done: a part of the answer, and marked incomplete."""

from __future__ import annotations

import argparse
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

import nag
from nag.cli import main
from nag.cli.running import chosen_run, take_unfinished, unfinished_file
from nag.tracking.run import UNFINISHED

APART = ["(x^2 + y^2 + z^2 - 4)*(x*y - z)", "(x - y)*(x^3 + y*z - 1)"]
ONE_BY_ONE = ["x*z - y^2", "y - x^2 + z*w - z*x^3*w^2", "x*(z - x*y)"]


def kinds(answer: nag.Decomposition) -> Counter:
    return Counter((c.dimension, c.degree, c.multiplicity) for c in answer.components)


@pytest.mark.parametrize("equations", [APART, ONE_BY_ONE])
def test_components_are_told_when_they_are_known(equations: list[str]) -> None:
    told: list[nag.Decomposition] = []
    system = nag.system(equations)
    answer = nag.decompose(system, found=told.append)
    assert told and answer == nag.decompose(system)
    for early in told:
        assert early.system == system and early.notes == (UNFINISHED,) and not early.complete
        for component in early:
            # A branch knows neither the others' components nor all that its own are multiple in.
            found = nag.member(answer, component.points[0])
            assert found.complete
            assert any(
                c.dimension > component.dimension
                or (
                    (c.dimension, c.degree) == (component.dimension, component.degree)
                    and c.multiplicity >= component.multiplicity
                )
                for c in found.on
            )
    if equations is ONE_BY_ONE:
        shapes = [Counter((c.dimension, c.degree) for c in d) for d in [*told, answer]]
        assert all(early <= shapes[-1] for early in shapes)


def test_solutions_are_told_before_missing_ones_are_looked_for() -> None:
    told: list[nag.SolveResult] = []
    system = nag.system(["x^2 + y^2 + z^2 - 9", "x*y*z - z^2 + 1", "x^2 + y*z^2 - 3"])
    result = nag.solve(system, found=told.append)
    (early,) = told
    assert len(early.solutions) == len(result.solutions) and result.complete
    assert not early.complete and early.notes == (UNFINISHED,)


def test_the_conjugate_of_a_complex_system_is_not_told_of() -> None:
    told: list[Any] = []
    equations = ["x^2 + y^2 + z^2 - 9*I", "x*y*z - z^2 + I", "x^2 + y*z^2 - 3"]
    system = nag.system(equations, variables="x y z")
    assert len(nag.solve(system, found=told.append).solutions) == len(told[0].solutions)


def test_what_is_told_stands_beside_the_export_until_that_is_there(tmp_path: Path) -> None:
    target = tmp_path / "a.json"
    options = argparse.Namespace(
        seed=0, threads=1, settings="default", progress=None, json=str(target), tell=print
    )
    system = nag.system(APART)
    nag.decompose(system, run=chosen_run(options, lambda found: found.document()))
    kept = nag.read(unfinished_file(str(target)))
    assert isinstance(kept, nag.Decomposition) and not kept.complete and len(kept)
    assert take_unfinished(str(target)) and nag.read(target) == kept
    assert not take_unfinished(str(target)) and not take_unfinished(None)


def test_nothing_unfinished_is_left_by_what_ends(tmp_path: Path) -> None:
    target = tmp_path / "a.json"
    Path(unfinished_file(str(target))).write_text("of an earlier run")
    assert main(["decompose", "cases/rhombus.toml", "--json", str(target), "--quiet"]) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["a.json"]
