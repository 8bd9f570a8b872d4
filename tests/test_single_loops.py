"""Single loops of the zoo have the same components in half-angles and in Euler parameters."""

from __future__ import annotations

import pytest
from linkages import exact, kinds
from solved import answer, modelled

from nag.decomposition.decompose import decompose
from nag.mechanism.coordinates import carry_to_euler
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.model import model
from nag.mechanism.problem import problem_of

# Those that Euler parameters decompose within two seconds, of the general loops the smaller one.
# Tables are in tests/test_table_formulations.py.
LOOPS = [
    "bennett",
    "spatial/assembled-4r",
    "spatial/delassus-rprp",
    "spatial/rccc",
    "spatial/rssr",
]


@pytest.mark.parametrize("name", LOOPS)
def test_half_angles_and_euler_parameters_agree(name: str) -> None:
    joint = modelled(name, "H")
    assert joint is not None
    _, carried = carry_to_euler(problem_of(joint), answer(name, "H"))
    assert kinds(carried) == kinds(answer(name, "E"))


def test_a_component_is_carried_over_by_a_point_that_is_not_far_away() -> None:
    """With seed 0 the first witness point has a slide of 209, too large to be sharpened there."""
    joints = (
        Joint("U", "universal", ("B0", "B1"), exact(0, -1, -1), exact(1, 2, 2), exact(1, 0, 0)),
        Joint("C", "cylindrical", ("B1", "B2"), exact(0, -2, 1), exact(1, 1, 0)),
        Joint("S", "spherical", ("B2", "B0"), exact(3, 3, 3)),
    )
    joint = model(Mechanism("B0", joints), "H")
    for seed in range(3):
        _, carried = carry_to_euler(problem_of(joint), decompose(joint.system, seed=seed))
        assert kinds(carried) == {(1, 32, 1): 1}


def test_a_folding_sarrus_linkage_moves_in_one_and_in_two_ways_at_once() -> None:
    joint, whole = (
        modelled("spatial/sarrus-kinematotropic"),
        answer("spatial/sarrus-kinematotropic"),
    )
    assert joint is not None
    surface, curve = whole.components
    assert whole.complete and (surface.dimension, curve.dimension) == (2, 1)
    # Base hinges turn twice as often as the curve has points over them, knees four times.
    degrees = {"A2": 4, "A3": 2, "B3": 2, "B2": 4, "A1": 2, "B1": 2}
    expected = [degrees[name.removeprefix("x_")] for name in joint.system.variables]
    assert curve.multidegree.tolist() == expected
    # On the surface the knees keep their angles, half a turn off the reference.
    kept = [i for i, name in enumerate(joint.system.variables) if name in ("x_A2", "x_B2")]
    moved = surface.sample(0, 3)[:, kept]
    assert abs(moved - moved[0]).max() < 1e-12
