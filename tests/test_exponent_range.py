"""Paths whose coordinates, or whose equations' terms, leave the range of doubles."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_ends import followed

from nag.algebra.polynomial import Polynomial
from nag.tracking.compiled import compile_rows
from nag.tracking.ends import end_run, records, runs
from nag.tracking.ends.follow import States
from nag.tracking.ends.runs import powers_of_two, scale_equations
from nag.tracking.homotopy import Homotopy
from nag.tracking.settings import Settings

X, Y, Z = Polynomial.variables(3)


@pytest.mark.parametrize("power", [20, 45, 60, 90, 140])
def test_a_path_goes_on_where_all_terms_of_an_equation_leave_the_range(power: int) -> None:
    # x^7 = 2 y^7 and y = e + t: at t = e, both terms are of size e^7.
    x, y = Polynomial.variables(2)
    e = 10.0**-power
    homotopy = Homotopy(compile_rows([x**7 - 2 * y**7]), [[e, 0, -1]], [[1.0, 0, 0]])
    roots = 2 ** (1 / 7) * np.exp(2j * np.pi * np.arange(7) / 7)
    here = homotopy.normalized(np.array([[1, r * 2 * e, 2 * e] for r in roots]))
    none = np.zeros(7, dtype=bool)
    states = States.of(here, none, here, np.full(7, e))
    # What is known of small coordinates is known to their own digits.
    states.met[:], states.rough[:] = 1, 0
    runs.run(homotopy, states, np.arange(7), 2, Settings(), 1)
    assert (states.outcome == end_run.REGULAR).all()
    ends = np.array([states.point(path) for path in range(7)])
    assert np.allclose(ends[:, 1] / ends[:, 0] / e, roots, rtol=1e-14, atol=0)
    assert np.allclose(ends[:, 2] / ends[:, 0] / e, 1, rtol=1e-14, atol=0)


def test_powers_of_two_change_nothing_of_a_path(monkeypatch: pytest.MonkeyPatch) -> None:
    system = [X**2 * Y + Z - 3, Y * Z - X + 1, X**2 + Y**2 - Z]
    plain = followed(system)
    monkeypatch.setattr(
        runs, "powers_of_two", lambda h, x, known: np.tile([3, -20, 40, 7], (len(x), 1))
    )
    shifted = followed(system)
    assert (plain.status == shifted.status).all()
    assert set(plain.balls) == set(shifted.balls)
    for i, ball in plain.balls.items():
        other = shifted.balls[i]
        (u, v) = (b.centre.sum(axis=2) @ np.array([1, 1j]) for b in (ball, other))
        assert np.allclose(u / u[0], v / v[0], rtol=1e-14, atol=1e-14)


@given(st.lists(st.integers(-300, 300), min_size=4, max_size=4))
def test_each_row_is_over_the_power_of_its_largest_term(powers: list[int]) -> None:
    homotopy = Homotopy(
        compile_rows([X**3 - 5 * Y * Z, 7 * X * Y * Z - 2, Y**2 + 3 * X]), None, None
    )
    equations = records.equations(homotopy, 2, 3)
    plain = equations.record
    found = scale_equations(equations, homotopy, np.array(powers)).record
    place = 0
    for row in homotopy.rows.parts:
        shifts = [int(np.dot(e, powers)) for _, terms in row for e in sorted(terms, reverse=True)]
        for shift in shifts:
            words = slice(4 * place, 4 * place + 4)
            expected = np.ldexp(plain.value[words], shift - max(shifts))
            assert (found.value[words] == expected).all()
            place += 1
    assert 4 * place == len(found.value)
    assert len(found.jacobian) == len(plain.jacobian)


def test_what_is_nothing_but_rounding_errors_is_left_as_it_is() -> None:
    homotopy = Homotopy(compile_rows([X**3 - Y, X * Y * Z - 2, Y**2 + 3 * X]), None, None)
    point = np.zeros((1, 4, 2, 2))
    point[0, :, 0, 0] = [1, 1e-200, 0.5, 1]
    known = np.array([[True, False, True, True]])
    assert not powers_of_two(homotopy, point, known).any()
    assert powers_of_two(homotopy, point, ~known)[0].tolist() == [0, -664, 0, 0]
