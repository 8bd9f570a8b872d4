"""What is compiled means what Python means, and what cannot be compiled is refused."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nag.machine_code.kernel import Kernel
from nag.machine_code.records import Complexes, Reals, Wholes

NUMBERS = st.floats(-1e50, 1e50)
FACTOR = 3


class Memory(NamedTuple):
    """What the functions below read and write."""

    n: int
    x: float
    flag: bool
    wholes: Wholes
    reals: Reals
    complexes: Complexes


def _memory(n: int = 0, x: float = 0.0, flag: bool = False) -> Memory:
    return Memory(
        n, x, flag, np.zeros(16, np.int64), np.zeros(16), np.zeros(16, dtype=np.complex128)
    )


def _same(function: Callable[[Memory], None], memory: Memory) -> None:
    """The function leaves the same behind whether compiled or not."""
    expected = Memory(*(v.copy() if isinstance(v, np.ndarray) else v for v in memory))
    function(expected)
    Kernel(function, None)(memory)
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


_whole_numbers = Kernel(whole_numbers, None)


@settings(deadline=None)
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


_complex_numbers = Kernel(complex_numbers, None)


@settings(deadline=None)
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
    Kernel(division_by_zero, None)(memory)
    assert memory.reals[:2].tolist() == [math.inf, -math.inf]


def changes_type(m: Memory) -> None:
    total = 0
    total = total + m.x
    m.reals[0] = total


def calls_itself(m: Memory) -> None:
    calls_itself(m)


def unknown_name(m: Memory) -> None:
    m.reals[0] = nowhere  # noqa: F821


def unknown_field(m: Memory) -> None:
    m.reals[0] = m.y


def iterates(m: Memory) -> None:
    for x in m.reals:
        m.reals[0] = x


def narrows(m: Memory) -> None:
    m.wholes[0] = m.x


def _sometimes(a):
    if a > 0:
        return a


def lacks_a_result(m: Memory) -> None:
    m.wholes[0] = _sometimes(m.n)


def compares_complex(m: Memory) -> None:
    m.wholes[0] = m.complexes[0] < m.complexes[1]


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (changes_type, "total is int and cannot become float"),
        (calls_itself, "calls_itself calls itself"),
        (unknown_name, "nowhere is no number"),
        (unknown_field, "Memory has no field y"),
        (iterates, "for needs range(..)"),
        (narrows, "float does not convert to int"),
        (lacks_a_result, "_sometimes.* may end without a result"),
        (compares_complex, "no Lt of complex"),
    ],
)
def test_what_cannot_be_compiled_is_refused_with_its_line(
    function: Callable[[Memory], None], message: str
) -> None:
    from nag.machine_code.values import KernelError

    place = re.escape(__file__) + r":\d+: "
    pattern = message if "*" in message else re.escape(message)
    with pytest.raises(KernelError, match=place + pattern):
        Kernel(function, None).prepare()


@pytest.mark.parametrize(
    "wrong", [np.zeros(16, dtype=np.float32), np.zeros(32)[::2], np.zeros(16, dtype=np.int64)]
)
def test_arrays_of_another_layout_are_refused(wrong: np.ndarray) -> None:
    with pytest.raises(TypeError, match=r"Memory\.reals is no contiguous array of float64"):
        _whole_numbers(_memory()._replace(reals=wrong))
