"""Zeros at which the Jacobian is of a given corank."""

from __future__ import annotations

import flint
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.algebra.expression import parse_polynomial
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose
from nag.numerics.corank import find_zero_of_corank
from nag.numerics.deflation import asks_for_more
from nag.numerics.descent import Round
from nag.numerics.digits import BITS, in_bits, log_norm, to_point
from nag.numerics.exact_system import ExactSystem
from nag.numerics.sharpening import ZERO
from nag.numerics.singular_point import Place, analyse
from nag.solving.solve import solve


def _system(variables: str, *texts: str) -> tuple[Polynomial, ...]:
    return tuple(parse_polynomial(text, variables.split()) for text in texts)


def _find(
    equations: tuple[Polynomial, ...], x: list[complex], rows: tuple[int, ...], columns: tuple
) -> list[flint.acb] | None:
    """The zero in the variables that are given: no coordinate may exceed one."""
    system = ExactSystem.of(equations, np.array(x, dtype=complex))
    assert not any(system.scales)
    found = find_zero_of_corank(system, to_point(x), Round(rows, columns))
    if found is None:
        return None
    point, left = found
    assert left < ZERO
    return point


def test_a_double_zero_is_found_to_all_digits():
    equations = _system("x y", "x - 2*y^2", "(8*y^2 - 1)^2")
    found = _find(equations, [0.25, 0.125**0.5], (0,), (0,))
    with in_bits(BITS):
        exact = [flint.acb(1) / 4, flint.acb(2).sqrt() / 4]
        assert log_norm(a - b for a, b in zip(found, exact, strict=True)) < ZERO


def test_the_nearest_zero_on_a_line_of_such_is_found():
    # On the line x = y = 0 both equations vanish twice.
    equations = _system("x y z", "x^2 + y^3*z", "x*y", "y^2 + x*z*y")
    found = _find(equations, [1e-15, -1e-15, 0.5], (), ())
    assert found is not None
    assert log_norm(found[:2]) < ZERO / 2
    assert complex(found[2]) == pytest.approx(0.5)


def test_no_zero_is_found_where_the_jacobian_is_regular():
    equations = _system("x y", "x - y^2", "4*y^2 - 1")
    assert _find(equations, [0.25, 0.5], (0,), (0,)) is None


def test_simple_zeros_close_together_are_none_of_a_corank():
    # Two of them at a distance of 1e-20.
    equations = _system("x y", "x - y^2", "(2*y - 1)^2 - 1/10^40")
    assert _find(equations, [0.25, 0.5], (0,), (0,)) is None


@given(st.integers(1, 3), st.integers(0, 3), st.integers(0, 2**32 - 1))
def test_a_zero_of_any_corank_is_found_whatever_the_coordinates(corank, regular, seed):
    rng = np.random.default_rng(seed)
    n = corank + regular
    shift = [int(c) for c in rng.integers(-15, 16, n)]
    matrix = np.eye(n, dtype=int)
    for i, j in zip(*np.nonzero(rng.integers(0, 2, (n, n))), strict=True):
        if i != j:
            matrix[i] += int(rng.integers(-1, 2)) * matrix[j]
    y = []
    for row in matrix.tolist():
        centred = Polynomial.constant(n, 0)
        for c, x, s in zip(row, Polynomial.variables(n), shift, strict=True):
            centred = centred + (x * 16 - s) * c
        y.append(centred)
    # Generic quadratic forms vanish at the origin alone; the other equations are graphs over it.
    squares = [
        sum(
            (y[j] * y[k] * int(rng.integers(1, 9)) for j in range(corank) for k in range(j + 1)),
            Polynomial.constant(n, 0),
        )
        for _ in range(corank)
    ]
    graphs = [y[corank + k] + y[0] * y[(k + 1) % n] for k in range(regular)]
    system = ExactSystem.of((*graphs, *squares), np.array(shift) / 16)
    near = np.array(shift) / 16 + 1e-14 * rng.normal(size=n)
    slopes = np.array(
        [
            [float(complex(c).real) for c in row]
            for row in system.values_at(30).jacobian(to_point(near))
        ]
    )
    columns = _independent_columns(slopes[:regular])
    found = find_zero_of_corank(system, to_point(near), Round(tuple(range(regular)), columns))
    assert found is not None
    exact = [flint.acb(s) / 16 for s in shift]
    assert log_norm(a - b for a, b in zip(found[0], exact, strict=True)) < ZERO / 2


def _independent_columns(matrix: np.ndarray) -> tuple[int, ...]:
    import scipy.linalg

    if not len(matrix):
        return ()
    *_, order = scipy.linalg.qr(matrix, pivoting=True)
    return tuple(sorted(int(j) for j in order[: len(matrix)]))


def test_a_corank_asks_for_more_zeros_than_so_many_paths():
    assert asks_for_more(2, 3)
    assert not asks_for_more(2, 4)
    assert not asks_for_more(5, None)


def test_an_end_of_one_path_on_a_curve_is_told_by_its_corank():
    # The line x = y and a point beside it.
    equations = _system("x y", "(x - y)*(x + y - 3)", "(x - y)*(x - 2*y)")
    end = analyse(equations, np.array([0.7, 0.7]), 1e-14, np.random.default_rng(0), most=1)
    assert end.place is Place.ON_COMPONENT
    assert "corank 1" in end.reason


def test_a_double_zero_of_two_paths_stays_isolated():
    equations = _system("x y", "x - y^2", "(2*y - 1)^2")
    end = analyse(equations, np.array([0.25, 0.5]), 1e-14, np.random.default_rng(0), most=2)
    assert (end.place, end.multiplicity) == (Place.ISOLATED, 2)


def test_a_zero_beside_a_node_is_not_taken_for_the_node():
    # Two lines that meet, and zeros within 1e-17 of where they do.
    e = "1/10^17"
    equations = _system(
        "x y z",
        f"(x - 1)*y*(x - 1 - {e}) + z*(x + 2*y + 3*z + 5)",
        f"(x - 1)*y*(y - 2*{e}) + z*(3*x - y + z - 7)",
        f"(x - 1)*y*(z + x - 1 + y - 3*{e}) + z*(x - 2*y + 2*z + 4)",
    )
    result = solve(PolynomialSystem(("x", "y", "z"), equations), start="total")
    assert len(result.solutions) == 7


@pytest.mark.parametrize("start", ["auto", "total"])
@pytest.mark.parametrize("power", [6, 7, 8, 11])
def test_a_zero_beside_where_three_lines_meet_is_found(power: int, start: str) -> None:
    x, y, z, e = "(x - 1)", "(y + 2*x)", "(z - 3*y)", f"1/10^{power}"
    first, second = f"{y}*({x} - {z})", f"{x}*({y} - {z})"
    third = f"{x}*{y}*({x} + {y} + {z} - 3*{e})"
    equations = _system(
        "x y z",
        f"{first} + 2*{second}",
        f"3*{first} - {second}",
        f"{third} + (x + 2)*{first} + (y - z + 1)*{second}",
    )
    result = solve(PolynomialSystem(("x", "y", "z"), equations), start=start)
    assert len(result.solutions) == 1 and result.complete and result.positive_dimensional


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("power", [14, 15, 17, 20])
def test_a_zero_nearer_to_a_line_than_doubles_tell_is_not_lost_in_silence(
    power: int, seed: int
) -> None:
    x, y, z, e = "(3*x - 1)", "(7*y - 2*x + 1)", "(z - 2)", f"1/10^{power}"
    equations = _system(
        "x y z",
        f"{x}*({x} - {e} + {y}) + {y}*(z + 3)",
        f"{x}*({y} + 2*{z}) + {y}*(x - 5)",
        f"{x}*({z} - {x} + {e}) + {y}*(y + 2*z + 1)",
    )
    answer = decompose(PolynomialSystem(("x", "y", "z"), equations), seed=seed)
    points = sum(component.dimension == 0 for component in answer.components)
    assert points == 4 or not answer.complete
