"""Numerical evaluation agrees with the exact polynomials."""

from __future__ import annotations

import tracemalloc
import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from systems import system

import nag
from nag.algebra import evaluation
from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.bench.path_costs import katsura
from nag.numerics.linear_algebra_threads import one_thread

N = 3
EXPONENTS = st.tuples(*[st.integers(0, 3)] * N)
POLYNOMIALS = st.lists(
    st.dictionaries(EXPONENTS, st.integers(-4, 4), max_size=5).map(lambda t: Polynomial(N, t)),
    max_size=4,
)
POINTS = st.tuples(*[st.complex_numbers(max_magnitude=3, allow_nan=False)] * N)


def scale(f: Polynomial) -> float:
    return max((abs(float(c)) for c in f.terms.values()), default=1.0)


@given(POLYNOMIALS, POINTS)
def test_values_and_jacobian_are_those_of_the_scaled_polynomials(
    polynomials: list[Polynomial], point: tuple[complex, ...]
) -> None:
    evaluator = Evaluator.of(polynomials, N)
    values = evaluator.values(np.array([point]))[0]
    jacobian = evaluator.jacobian(np.array(point))
    assert jacobian.shape == (len(polynomials), N)
    for row, f in enumerate(polynomials):
        bound = 1e-12 * (1 + evaluator.sizes(np.array([point]))[0, row])
        assert abs(values[row] - f(point) / scale(f)) < bound
        for i in range(N):
            assert abs(jacobian[row, i] - f.derivative(i)(point) / scale(f)) < 10 * bound


def test_a_single_term_has_a_small_residual_near_its_zero() -> None:
    x = Polynomial.variable(1, 0)
    evaluator = Evaluator.of([x**2], 1)
    assert evaluator.residuals(np.array([[1e-9]]))[0, 0] < 1e-17
    assert evaluator.residuals(np.array([[1e3]]))[0, 0] > 0.5


def test_what_leaves_the_range_of_doubles_is_not_finite_and_nobody_is_warned() -> None:
    x, y = Polynomial.variables(2)
    evaluator = Evaluator.of([x**3 * y - 1], 2)
    far = np.array([[1e200 + 1e200j, 1.0]])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not np.isfinite(evaluator.values(far)).any()
        assert not np.isfinite(evaluator.jacobian(far[0])).all()


def test_no_points_have_no_values() -> None:
    x, y = Polynomial.variables(2)
    evaluator = Evaluator.of([x**2 * y - 1, x], 2)
    assert evaluator.values(np.zeros((0, 2))).shape == (0, 2)
    assert evaluator.residuals(np.zeros((0, 2))).shape == (0, 2)


def test_last_coefficients_are_those_of_values_at_power_series() -> None:
    rng = np.random.default_rng(2)
    polynomials = system("x y", "3*x^4*y - 2*x*y^2 + 5*y - 7", "x^3 - 1", "y + 2").polynomials
    evaluator = Evaluator.of(polynomials, 2)
    series = rng.normal(size=(4, 2, 5)) + 1j * rng.normal(size=(4, 2, 5))
    # Values on as many points of a circle as there are coefficients.
    u = np.exp(2j * np.pi * np.arange(32) / 32)
    at = (series @ u ** np.arange(5)[:, None]).transpose(0, 2, 1)
    values = evaluator.values(at.reshape(-1, 2)).reshape(4, 32, 3)
    for k in range(1, 6):
        expected = (values * u[:, None] ** (1 - k)).mean(axis=1)
        assert np.abs(evaluator.last_coefficients(series[..., :k]) - expected).max() < 1e-12
    alone = Evaluator.of(system("x y", "4").polynomials, 2)
    assert np.abs(alone.last_coefficients(series)).max() == 0


def test_balanced_jacobians_of_many_points_are_those_of_each() -> None:
    x, y = Polynomial.variables(2)
    evaluator = Evaluator.of([x**3 * y - 2, x - 3 * y**2], 2)
    rng = np.random.default_rng(0)
    near = rng.normal(size=(3, 2)) * np.array([[1], [10], [1e5]]) + 1j
    for points in (near, np.vstack([near, [[1e60, 1j]]]), near[:0]):
        found = evaluator.balanced_jacobians(points)
        assert found.shape == (len(points), 2, 2)
        for each, point in zip(found, points, strict=True):
            assert np.allclose(each, evaluator.balanced_jacobian(point), rtol=1e-14)


def test_many_points_take_no_more_memory_than_few_and_give_the_same_values(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # 170 monomials at 4,096 points are 11 MB.
    equations = nag.system(katsura(16))
    evaluator = Evaluator.of(equations.polynomials, equations.n)
    rng = np.random.default_rng(0)
    points = rng.standard_normal((4096, equations.n)) + 1j * rng.standard_normal((4096, 17))
    with one_thread():
        tracemalloc.start()
        try:
            residuals = evaluator.residuals(points)
            _, peak = tracemalloc.get_traced_memory()
        finally:
            tracemalloc.stop()
        assert peak < 7e6
        monkeypatch.setattr(evaluation, "TOGETHER", 1 << 30)
        assert np.array_equal(evaluator.residuals(points), residuals)
