"""What paths cost is fitted by laws that it follows."""

import pytest

import nag
from nag.bench.path_costs import CostModel, PathCost, katsura


@pytest.mark.parametrize("n", [3, 5])
def test_a_katsura_system_has_two_to_the_n_solutions(n: int) -> None:
    assert len(nag.solve(katsura(n))) == 2**n


def test_costs_that_follow_a_power_are_fitted_by_it() -> None:
    costs = [
        PathCost(n, 2**n, 50 * 2**n, 2e-6 * n**3 * 2**n, 1e-6 * n**3 * 2**n, 0.1, 10**6 + m, m)
        for n in (11, 12, 13)
        for m in (24 * n * 2**n,)
    ]
    model = CostModel.fit(costs)
    assert (model.seconds, model.power) == pytest.approx((3e-6, 3.0))
    assert model.plan(10**6, 21) == pytest.approx((3.0 * 21**3, 24e6 * 21, 24e6 * 21))


def test_one_size_says_nothing_of_growth() -> None:
    with pytest.raises(ValueError, match="one size"):
        CostModel.fit([PathCost(3, 4, 9, 1.0, 1.0, 1.0, 1, 1)])
