"""Estimates of paths are coefficients of products, whatever way they are counted."""

from collections import Counter
from itertools import product
from math import factorial, prod

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.files.cases import read_case
from nag.mechanism import formulations, half_angles, path_estimates
from nag.mechanism.axes import space_of
from nag.mechanism.euler import estimated_euler_paths, euler_model
from nag.mechanism.formulations import alternatives, smallest_alternative
from nag.mechanism.model import model, with_loops
from nag.mechanism.path_estimates import (
    estimated_paths,
    intersection_number,
    intersection_numbers,
)


@st.composite
def equations_in_spaces(draw):
    """Degrees of equations in a few projective spaces, and the spaces' dimensions."""
    dimensions = draw(st.lists(st.integers(1, 2), min_size=1, max_size=4))
    row = st.tuples(*[st.integers(0, 2)] * len(dimensions))
    return draw(st.lists(row, max_size=sum(dimensions) + 1)), dimensions


def point_coefficient(degrees, dimensions):
    """What expanding the product of sum(d_i h_i) gives at the spaces' point class."""
    rows = degrees[: sum(dimensions)]
    rows = [*rows, *[(1,) * len(dimensions)] * (sum(dimensions) - len(rows))]
    total = 0
    for chosen in product(range(len(dimensions)), repeat=len(rows)):
        if Counter(chosen) == Counter(dict(enumerate(dimensions))):
            total += prod(row[i] for row, i in zip(rows, chosen, strict=True))
    return total


@given(equations_in_spaces())
def test_each_number_is_the_coefficient_of_the_point_class(system):
    degrees, dimensions = system
    numbers = intersection_numbers(degrees, dimensions)
    assert len(numbers) == 1 + min(len(degrees), sum(dimensions))
    for k, number in enumerate(numbers):
        assert number == point_coefficient(degrees[:k], dimensions)


@given(equations_in_spaces(), st.randoms(use_true_random=False))
def test_the_order_of_equations_and_of_spaces_does_not_matter(system, random):
    degrees, dimensions = system
    order = random.sample(range(len(dimensions)), len(dimensions))
    degrees = degrees[: sum(dimensions)]
    moved = [tuple(row[i] for i in order) for row in random.sample(degrees, len(degrees))]
    assert intersection_number(moved, [dimensions[i] for i in order]) == intersection_number(
        degrees, dimensions
    )


@given(equations_in_spaces())
def test_few_states_give_a_bound(system):
    degrees, dimensions = system
    exact = intersection_numbers(degrees, dimensions)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(path_estimates, "MOST_STATES", 1)
        bounds = intersection_numbers(degrees, dimensions)
    assert all(x <= y for x, y in zip(exact, bounds, strict=True))


def test_many_lines_with_a_pair_of_equations_each_are_counted_at_once():
    n = 40
    rows = [tuple(2 * (j in (i, i + 1)) for j in range(n + 1)) for i in range(n)]
    # One of the lines has its place by the linear equation, each equation fixes one more.
    assert intersection_number(rows, [1] * (n + 1)) == (n + 1) * 2**n


def test_linear_equations_choose_among_spaces_in_every_order():
    assert intersection_numbers([], [1] * 30) == (factorial(30),)


def looped(name):
    structure = with_loops(read_case(f"cases/{name}.toml").mechanism)
    return structure, space_of(structure.joints)


@pytest.mark.parametrize(
    "name", ["bennett", "robots/3-prs", "robots/3-rps", "robots/hexapod", "spatial/rccc"]
)
def test_euler_parameters_have_as_many_paths_as_the_graph_says(name):
    structure, _ = looped(name)
    assert estimated_euler_paths(structure) == estimated_paths(euler_model(structure).system)


@pytest.mark.parametrize(
    "name",
    [
        "bennett",
        "planar/elliptic-trammel",
        "robots/3-prs",
        "robots/3-rps",
        "robots/3-rrr-planar",
        "robots/3-rrr-spherical",
        "robots/tripteron",
        "spatial/bennett-chain-3",
        "spatial/four-sliders",
        "spatial/rssr",
    ],
)
def test_what_is_chosen_from_the_graph_has_the_fewest_paths_of_all(name):
    structure, space = looped(name)
    chosen, first = smallest_alternative(structure, space), alternatives(structure, space)[0]
    assert (chosen.formulation, chosen.paths) == (first.formulation, first.paths)


def test_only_what_is_chosen_is_made(monkeypatch):
    made = []
    for name in ("euler_model", "half_angle_model"):
        real = getattr(formulations, name)
        monkeypatch.setattr(
            formulations, name, lambda *a, real=real, n=name: made.append(n) or real(*a)
        )
    assert smallest_alternative(*looped("robots/hexapod")).formulation == "E"
    assert made == ["euler_model"]
    assert smallest_alternative(*looped("robots/tripteron")).formulation == "H"
    assert made == ["euler_model"]


def test_a_model_says_that_choosing_it_was_cut_short(monkeypatch):
    mechanism = read_case("cases/spatial/bennett-chain-3.toml").mechanism
    assert "choosing stopped" not in model(mechanism).reason
    monkeypatch.setattr(half_angles, "MOST_LOOPS", 1)
    assert model(mechanism).reason.endswith("; choosing stopped after 1 basis of 3 loops")
