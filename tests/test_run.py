"""How something is worked out stands in one object, whose fields may be given one by one."""

import copy
import pickle
from collections.abc import Callable

import numpy as np
import pytest

import nag
from nag.decomposition import sample
from nag.text.progress import REMARK

EQUATIONS = ["(x^2 + y^2 - 1)*(x^2 + x*y + 3*y^2 - 2)"]


def test_a_run_and_its_fields_give_the_same_bytes() -> None:
    run = nag.Run(seed=5, threads=2, settings="careful")
    one, other = nag.decompose(EQUATIONS, run=run), nag.decompose(EQUATIONS, **run.short)
    assert one == other == nag.decompose(EQUATIONS, run=nag.Run(5, 1, "careful"))
    assert (one.seed, one.settings) == (5, "careful")
    assert nag.solve(["x^2 + y^2 - 1", "x - y"], run=run).seed == 5
    curve = one.components[0]
    found, again = (sample(curve.system, curve, 2, **how) for how in ({"run": run}, run.short))
    assert found == again and found != sample(curve.system, curve, 2, seed=6)


@pytest.mark.parametrize(
    "how",
    [{"seed": -1}, {"threads": 0}, {"settings": "quick"}, {"progress": 3}, {"seed": 1.5}],
)
def test_runs_that_make_no_sense_are_refused_where_they_are_made(how) -> None:
    with pytest.raises(nag.NagError, match=next(iter(how))):
        nag.Run(**how)
    with pytest.raises(nag.NagError, match=next(iter(how))):
        nag.decompose(EQUATIONS, **how)


def test_a_run_beside_one_of_its_fields_is_refused() -> None:
    with pytest.raises(nag.NagError, match="seed: is given beside run"):
        nag.decompose(EQUATIONS, run=nag.Run(), seed=1)


def test_results_compare_by_value_and_survive_pickles_and_copies() -> None:
    whole, solved = nag.decompose(EQUATIONS), nag.solve(["x^2 + y^2 - 1", "x - y"])
    curve = whole.components[0]
    results = (
        *(whole, curve, curve.slice, solved, solved.solutions[0]),
        *(curve.project(["x"]), curve.genus(), curve.real_points_near(np.array([2.0, 0.0]))),
        *(curve.intersect(whole.components[1]), sample(curve.system, curve, 2), nag.Run(seed=3)),
        nag.local_dimension(nag.system("x^3 = y^2"), (0, 0)),
    )
    for each in results:
        assert pickle.loads(pickle.dumps(each)) == each
        assert copy.deepcopy(each) == each
    assert solved != nag.solve(["x^2 + y^2 - 1", "x - 2*y"])
    assert solved.solutions[0] != solved.solutions[1]


def told_by(call: Callable[..., object], *given: object) -> list[str]:
    """The stages that a call tells of."""
    stages: list[str] = []
    call(*given, progress=lambda stage, *_: stages.append(stage))
    return stages


def test_solving_tells_of_paths_and_of_the_judging_of_their_ends() -> None:
    stages = told_by(nag.solve, ["x^2 + y^2 + z^2 - 5", "x*y*z - 1", "x^3 - y*z + 2"])
    names = list(dict.fromkeys(stage.split(REMARK)[0] for stage in stages))
    (tracked,) = (s for s in names if s.startswith("tracking "))
    paths = tracked.removeprefix("tracking ")
    assert names.index(f"judging the ends of {paths}") == names.index(tracked) + 1


def test_paths_are_told_of_with_the_doubtful_ones_and_what_became_of_them() -> None:
    told: list[tuple[str, int, int]] = []
    equations = ["x*y + y - 1", "y*z + x - 2", "x^2 + x*z - 3"]
    found = nag.solve(equations, start="total", progress=lambda *step: told.append(step))
    assert found.paths.tracked == 8 and 0 < found.paths.at_infinity < 8
    tracked = [step for step in told if step[0].startswith("tracking ")]
    assert [step[1:] for step in tracked] == [(0, 0), (8, 8)]
    assert tracked[1][0].endswith(f"{REMARK}{found.paths.at_infinity} doubtful")
    (judged,) = (stage for stage, *_ in told if stage.startswith("judging "))
    assert judged.endswith(f"{REMARK}{found.paths.at_infinity} to infinity")


def test_each_branch_of_a_system_that_falls_apart_is_told_of() -> None:
    stages = told_by(nag.decompose, "(x^2 + y^2*z - 3)*(y^3 + z*x - 1)")
    assert stages.count("decomposing, by branches") == 1
    # The next method is asked for each of the two branches.
    assert stages.count("decomposing, one equation") == 2


def test_solving_inside_a_decomposition_is_told_of() -> None:
    stages = told_by(nag.decompose, ["x^2 + y^2 + z^2 - 5", "x*y*z - 1", "x^3 - y*z + 2"])
    assert any(stage.startswith("tracking ") for stage in stages)
