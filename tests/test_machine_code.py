"""What is compiled means what Python means."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from kernel_memory import Memory

from nag.machine_code import plain
from nag.machine_code.kernel import Kernel

NUMBERS = st.floats(-1e50, 1e50)
FACTOR = 3


def _memory(n: int = 0, x: float = 0.0, flag: bool = False) -> Memory:
    return Memory(
        n, x, flag, np.zeros(16, np.int64), np.zeros(16), np.zeros(16, dtype=np.complex128)
    )


def _same(function: Callable[[Memory], None], memory: Memory) -> None:
    """The function leaves the same behind whether compiled or not."""
    expected = Memory(*(v.copy() if isinstance(v, np.ndarray) else v for v in memory))
    plain.run(function, expected)
    Kernel(function, keep=False)(memory)
    for name in ("wholes", "reals", "complexes"):
        assert getattr(memory, name).tobytes() == getattr(expected, name).tobytes(), name


def whole_numbers(m: Memory) -> None:
    a, b = m.wholes[0], m.wholes[1]
    m.wholes[2] = a // b
    m.wholes[3] = a % b
    m.wholes[4] = a * b - FACTOR
    m.wholes[5] = abs(a) + (1 << 3)
    m.wholes[6] = min(a, b, 0)
    m.wholes[7] = -a
    m.reals[0] = a / b


_whole_numbers = Kernel(whole_numbers, keep=False)


@given(st.integers(-(2**30), 2**30), st.integers(-(2**30), 2**30).filter(bool))
def test_whole_numbers_are_divided_as_in_python(a: int, b: int) -> None:
    memory = _memory()
    memory.wholes[:2] = a, b
    _whole_numbers(memory)
    assert memory.wholes[2:8].tolist() == [
        a // b,
        a % b,
        a * b - FACTOR,
        abs(a) + 8,
        min(a, b, 0),
        -a,
    ]
    assert memory.reals[0] == a / b


def _turned(values: tuple[int, int, float]) -> tuple[int, float, int]:
    return values[1:] + values[:1]


def several_at_once(m: Memory) -> None:
    values = m.n, m.n + 1, m.x
    six = _turned(values) + _turned(_turned(values))
    m.wholes[0], m.reals[0], m.wholes[1], m.reals[1], m.wholes[2], m.wholes[3] = six
    m.wholes[4], m.wholes[5] = six[::5]


def test_tuples_are_cut_and_joined_as_in_python() -> None:
    memory = _memory(7, 0.5)
    _same(several_at_once, memory)
    assert memory.wholes[:6].tolist() == [8, 7, 7, 8, 8, 8]
    assert memory.reals[:2].tolist() == [0.5, 0.5]


def complex_numbers(m: Memory) -> None:
    a, b = m.complexes[0], m.complexes[1]
    m.complexes[2] = a + b
    m.complexes[3] = a - b
    m.complexes[4] = a * b
    m.complexes[5] = -a.conjugate()
    m.complexes[6] = complex(a.imag, b.real)
    m.reals[0] = abs(a)
    if b != 0:
        m.complexes[7] = a / b


_complex_numbers = Kernel(complex_numbers, keep=False)


@given(NUMBERS, NUMBERS, NUMBERS, NUMBERS)
def test_complex_numbers_are_pythons(a: float, b: float, c: float, d: float) -> None:
    memory = _memory()
    x, y = complex(a, b), complex(c, d)
    memory.complexes[:2] = x, y
    _complex_numbers(memory)
    found = memory.complexes[2:7].tolist()
    assert found == [x + y, x - y, x * y, -x.conjugate(), complex(b, c)]
    assert math.isclose(memory.reals[0], abs(x), rel_tol=1e-15)
    if y:
        assert memory.complexes[7] == x / y


def real_numbers(m: Memory) -> None:
    a = m.reals[0]
    m.reals[1] = max(a, m.x)
    m.reals[2] = a**2 + abs(a) ** 0.5
    m.reals[3] = math.cos(a) * math.sin(a)
    m.reals[4] = a if 0 < a < m.x else -a
    m.reals[5] = np.rint(a)
    m.wholes[0] = int(a)
    m.wholes[1] = a != a
    m.wholes[2] = not a < m.x
    m.wholes[3] = (a > 1.0 and m.flag) or a < -1.0
    m.wholes[4] = m.n in (1, 2, 3)


@pytest.mark.parametrize("a", [0.0, 0.25, -2.5, 2.5, 7.0, -1e5])
@pytest.mark.parametrize("flag", [False, True])
def test_real_numbers_and_conditions_are_pythons(a: float, flag: bool) -> None:
    memory = _memory(2, 3.0, flag)
    memory.reals[0] = a
    _same(real_numbers, memory)


def loops(m: Memory) -> None:
    for i in range(m.n):
        if i % 2 == 0:
            continue
        if i == 7:
            break
        m.wholes[0] += i
    for i in range(m.n - 1, -1, -2):
        m.wholes[1] = 10 * m.wholes[1] + i
    k = 0
    while True:
        k += 1
        while k < 5:
            k += 1
        if k * k > m.n:
            break
    m.wholes[2] = k
    a, b = 0, 1
    for _ in range(10):
        a, b = b, a + b
    m.wholes[3] = a
    m.wholes[4], m.wholes[3] = m.wholes[3], m.wholes[4]


@pytest.mark.parametrize("n", [0, 1, 6, 12])
def test_loops_are_pythons(n: int) -> None:
    _same(loops, _memory(n))


def _sorted_pair(a, b):
    if a > b:
        return b, a
    return a, b


def _first_square_above(n):
    k = 0
    while True:
        if k * k > n:
            return k
        k += 1


def calls(m: Memory) -> None:
    m.wholes[0], m.wholes[1] = _sorted_pair(m.n, 4)
    m.reals[0], m.reals[1] = _sorted_pair(m.x, 0.5)
    pair = _sorted_pair(2, 1)
    m.wholes[2] = pair[1]
    m.wholes[3] = _first_square_above(m.n)


@pytest.mark.parametrize("n", [-3, 0, 4, 99])
def test_functions_are_compiled_for_the_types_they_are_called_with(n: int) -> None:
    _same(calls, _memory(n, float(n)))


def division_by_zero(m: Memory) -> None:
    m.reals[0] = m.x / 0.0
    m.reals[1] = -m.x / 0.0


def test_division_by_zero_gives_infinity() -> None:
    memory = _memory(x=1.0)
    Kernel(division_by_zero, keep=False)(memory)
    assert memory.reals[:2].tolist() == [math.inf, -math.inf]


def divides(m: Memory) -> None:
    m.wholes[0] = 1
    if m.flag:
        m.wholes[1] = 5 // m.n
    else:
        m.wholes[1] = _rest(5, m.n)
    m.wholes[2] = 1


def _rest(a, b):
    return a % b


def divides_by_a_constant(m: Memory) -> None:
    m.wholes[0] = 5 // 0


def divides_into_a_fraction(m: Memory) -> None:
    m.reals[0] = m.n / (m.n - m.n)


def divides_in_place(m: Memory) -> None:
    m.wholes[0] //= m.wholes[1]


@pytest.mark.parametrize("flag", [False, True])
def test_whole_numbers_divided_by_zero_are_an_error_and_nothing_follows(flag: bool) -> None:
    kernel, memory = Kernel(divides, keep=False), _memory(0, flag=flag)
    place = "divides" if flag else "_rest"
    message = f"{__file__}, {place}: division of a whole number by zero in "
    message += "5 // m.n" if flag else "a % b"
    with pytest.raises(ZeroDivisionError, match=re.escape(message)):
        kernel(memory)
    assert memory.wholes[:3].tolist() == [1, 0, 0]
    with pytest.raises(ZeroDivisionError):
        plain.run(divides, _memory(0, flag=flag))
    again = _memory(3, flag=flag)
    kernel(again)
    assert again.wholes[:3].tolist() == [1, 1 if flag else 2, 1]


@pytest.mark.parametrize(
    "function", [divides_by_a_constant, divides_into_a_fraction, divides_in_place]
)
def test_every_division_of_whole_numbers_is_checked(function: Callable[[Memory], None]) -> None:
    with pytest.raises(ZeroDivisionError, match=re.escape(f"{__file__}, {function.__name__}: ")):
        Kernel(function, keep=False)(_memory(1))


@pytest.mark.parametrize("a", [-(2**63), -7, 0, 7, 2**63 - 1])
def test_dividing_by_minus_one_wraps_round(a: int) -> None:
    memory = _memory()
    memory.wholes[:2] = a, -1
    _whole_numbers(memory)
    assert memory.wholes[2] == (-a if a != -(2**63) else a)
    assert memory.wholes[3] == 0


def truncates(m: Memory) -> None:
    m.wholes[0] = int(m.x)


@pytest.mark.parametrize(
    ("x", "expected"),
    [(-2.9, -2), (1e300, 2**63 - 1), (-math.inf, -(2**63)), (math.nan, 0)],
)
def test_doubles_become_the_nearest_whole_number_towards_zero(x: float, expected: int) -> None:
    memory = _memory(x=x)
    Kernel(truncates, keep=False)(memory)
    assert memory.wholes[0] == expected


def stops_at_the_first_that_does_not_hold(m: Memory) -> None:
    m.wholes[0] = 0 < m.n < 10 // m.n
    m.wholes[1] = m.n != 0 and 10 // m.n > 3
    m.wholes[2] = m.n == 0 or 10 // m.n > 3
    m.wholes[3] = 1 if m.flag and not m.n else 0


@pytest.mark.parametrize("n", [0, 2, 5])
@pytest.mark.parametrize("flag", [False, True])
def test_what_does_not_count_any_more_is_not_evaluated(n: int, flag: bool) -> None:
    _same(stops_at_the_first_that_does_not_hold, _memory(n, flag=flag))


@pytest.mark.parametrize("wrong", [1.5, "1", None])
def test_fields_of_whole_numbers_take_nothing_else(wrong: object) -> None:
    with pytest.raises(TypeError):
        _whole_numbers(_memory()._replace(n=wrong))


@pytest.mark.parametrize(
    "wrong", [np.zeros(16, dtype=np.float32), np.zeros(32)[::2], np.zeros(16, dtype=np.int64)]
)
def test_arrays_of_another_layout_are_refused(wrong: np.ndarray) -> None:
    with pytest.raises(TypeError, match=r"Memory\.reals is no contiguous array of float64"):
        _whole_numbers(_memory()._replace(reals=wrong))


def small_products(m: Memory) -> None:
    m.reals[2] = m.reals[0] * m.reals[0]
    m.reals[3] = m.reals[1] + m.reals[1]
    m.reals[4] = m.reals[0] * 4.0


def test_numbers_below_the_normal_ones_are_zero_in_a_kernel_and_only_there() -> None:
    memory = _memory()
    memory.reals[:2] = 1e-160, 5e-324
    Kernel(small_products, keep=False)(memory)
    assert memory.reals[2:5].tolist() == [0.0, 0.0, 4e-160]
    small = memory.reals[:2]
    assert (small * small)[0] == 1e-320
    assert float(small[1]) + float(small[1]) == 1e-323
