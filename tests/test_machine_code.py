"""What is compiled means what Python means, and what cannot be compiled is refused."""

from __future__ import annotations

import functools
import inspect
import math
import re
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nag.machine_code import plain
from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import any_less, load, store
from nag.machine_code.records import Complexes, Reals, Wholes
from nag.machine_code.values import KernelError

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
    plain.run(function, expected)
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


def line_of(function: Callable[[Memory], None], text: str) -> int:
    source, first = inspect.getsourcelines(function)
    return first + next(k for k, line in enumerate(source) if text in line)


@pytest.mark.parametrize("flag", [False, True])
def test_whole_numbers_divided_by_zero_are_an_error_and_nothing_follows(flag: bool) -> None:
    kernel, memory = Kernel(divides, None), _memory(0, flag=flag)
    place = line_of(divides, "5 // m.n") if flag else line_of(_rest, "a % b")
    message = f"{__file__}:{place}: division of a whole number by zero"
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
    with pytest.raises(ZeroDivisionError, match=re.escape(f"{__file__}:")):
        Kernel(function, None)(_memory(1))


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
    Kernel(truncates, None)(memory)
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


def has_else_of_for(m: Memory) -> None:
    for k in range(m.n):
        m.wholes[0] = k
    else:
        m.wholes[1] = 1


def has_else_of_while(m: Memory) -> None:
    while m.wholes[0] < m.n:
        m.wholes[0] += 1
    else:
        m.wholes[1] = 1


def changes_a_field(m: Memory) -> None:
    m.n += 1


def sets_a_field(m: Memory) -> None:
    m.n = 1


def assigns_sometimes(m: Memory) -> None:
    if m.flag:
        a = 1
    m.wholes[0] = a


def assigns_in_a_loop(m: Memory) -> None:
    for k in range(m.n):
        a = k
    m.wholes[0] = a


def goes_on_after_return(m: Memory) -> None:
    return
    m.wholes[0] = 1


def returns_a_result(m: Memory) -> int:
    return m.n


def chooses_a_number(m: Memory) -> None:
    m.wholes[0] = m.n or 5


def shifts_far(m: Memory) -> None:
    m.wholes[0] = 1 << 64


def shifts_by_a_variable(m: Memory) -> None:
    m.wholes[0] = 1 << m.n


def is_too_large(m: Memory) -> None:
    m.wholes[0] = 2**2 + 9223372036854775808


def counts_from_the_end(m: Memory) -> None:
    m.wholes[0] = m.wholes[-1]


def indexes_by_a_condition(m: Memory) -> None:
    m.wholes[m.flag] = 1


def takes_an_item_that_is_not_there(m: Memory) -> None:
    pair = m.n, m.n
    m.wholes[0] = pair[2]


def slices(m: Memory) -> None:
    m.wholes[0:2] = 1


def gives_too_many_arguments(m: Memory) -> None:
    m.reals[0] = abs(m.x, m.x)


def gives_too_few_arguments(m: Memory) -> None:
    m.reals[0] = math.atan2(m.x)


def takes_the_least_of_one(m: Memory) -> None:
    m.reals[0] = min(m.x)


def names_arguments(m: Memory) -> None:
    m.reals[0] = complex(real=m.x, imag=m.x).real


def conjugates_with_an_argument(m: Memory) -> None:
    m.complexes[0] = m.complexes[1].conjugate(1)


def ranges_over_four(m: Memory) -> None:
    for k in range(0, 1, 1, 1):
        m.wholes[0] = k


def ranges_over_nothing(m: Memory) -> None:
    for k in range():
        m.wholes[0] = k


def steps_by_a_variable(m: Memory) -> None:
    for k in range(0, 8, m.n):
        m.wholes[0] = k


def steps_by_a_fraction(m: Memory) -> None:
    for k in range(0, 8, 1.0):
        m.wholes[0] = k


def negates_a_condition(m: Memory) -> None:
    m.wholes[0] = -m.flag


def adds_arrays(m: Memory) -> None:
    m.reals[0] = (m.reals + m.reals)[0]


def squares_an_array(m: Memory) -> None:
    m.reals[0] = (m.reals**2)[0]


def calls_something_else(m: Memory) -> None:
    print(m.n)


def asserts(m: Memory) -> None:
    assert m.n > 0


def raises(m: Memory) -> None:
    raise ValueError


def annotates(m: Memory) -> None:
    a: int = m.n
    m.wholes[0] = a


def deletes(m: Memory) -> None:
    a = m.n
    del a


def nests(m: Memory) -> None:
    def inner():
        return 1

    m.wholes[0] = inner()


def collects(m: Memory) -> None:
    m.wholes[0] = [m.n for k in range(3)][0]  # noqa: RUF015


def walrus(m: Memory) -> None:
    m.wholes[0] = (a := m.n) + a


def spells(m: Memory) -> None:
    m.wholes[0] = m.n == "text"


def unpacks_too_few(m: Memory) -> None:
    a, b, c = m.n, m.n
    m.wholes[0] = a + b + c


def unpacks_the_rest(m: Memory) -> None:
    a, *_b = m.n, m.n
    m.wholes[0] = a


def is_it(m: Memory) -> None:
    m.wholes[0] = m.n is m.n


def _with_default(a, b=1):
    return a + b


def calls_with_default(m: Memory) -> None:
    m.wholes[0] = _with_default(m.n, 1)


def lacks_an_argument(m: Memory) -> None:
    m.wholes[0] = _rest(m.n)


def decides_by_a_fraction(m: Memory) -> None:
    if m.x:
        m.wholes[0] = 1


def chains_membership(m: Memory) -> None:
    m.wholes[0] = 0 < m.n in (1, 2)


def mixes_lanes_and_numbers(m: Memory) -> None:
    store(m.reals, 0, load(m.reals, 0) + m.x)


def compares_numbers_as_lanes(m: Memory) -> None:
    m.wholes[0] = any_less(m.x, m.x)


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
        (has_else_of_for, "else of a loop is not translated"),
        (has_else_of_while, "else of a loop is not translated"),
        (changes_a_field, "m.n cannot be changed"),
        (sets_a_field, "int cannot be assigned to m.n"),
        (assigns_sometimes, "a may have no value yet"),
        (assigns_in_a_loop, "a may have no value yet"),
        (goes_on_after_return, "nothing leads here"),
        (returns_a_result, "a kernel returns nothing"),
        (chooses_a_number, "m.n is int, not bool"),
        (shifts_far, "whole numbers are shifted by constants from 0 to 63"),
        (shifts_by_a_variable, "whole numbers are shifted by constants from 0 to 63"),
        (is_too_large, "9223372036854775808 does not fit in 64 bits"),
        (counts_from_the_end, "places in memory are not counted from the end"),
        (indexes_by_a_condition, "places in memory are whole numbers, not bool"),
        (takes_an_item_that_is_not_there, "(int, int) has no item 2"),
        (slices, "Slice is not translated"),
        (gives_too_many_arguments, "abs takes 1 arguments here, not 2"),
        (gives_too_few_arguments, "math.atan2 takes 2 arguments here, not 1"),
        (takes_the_least_of_one, "min takes two or more arguments here, not 1"),
        (names_arguments, "arguments must not be named"),
        (conjugates_with_an_argument, "no conjugate(1 arguments) of complex"),
        (ranges_over_four, "range takes 1 to 3 arguments, not 4"),
        (ranges_over_nothing, "range takes 1 to 3 arguments, not 0"),
        (steps_by_a_variable, "the step of a range must be a constant"),
        (steps_by_a_fraction, "the step of a range must be a constant"),
        (negates_a_condition, "no USub of bool"),
        (adds_arrays, "no Add of float*"),
        (squares_an_array, "no Mult of float*"),
        (calls_something_else, "print cannot be called"),
        (asserts, "Assert is not translated"),
        (raises, "Raise is not translated"),
        (annotates, "AnnAssign is not translated"),
        (deletes, "Delete is not translated"),
        (nests, "FunctionDef is not translated"),
        (collects, "ListComp is not translated"),
        (walrus, "NamedExpr is not translated"),
        (spells, "'text' is no number"),
        (unpacks_too_few, "(int, int) does not fit 3 targets"),
        (unpacks_the_rest, "int cannot be assigned to *_b"),
        (is_it, "no Is of int"),
        (calls_with_default, "_with_default has arguments other than plain ones"),
        (lacks_an_argument, "_rest takes 2 arguments, not 1"),
        (decides_by_a_fraction, "float is neither true nor false"),
        (chains_membership, "in is not chained"),
        (mixes_lanes_and_numbers, "no type in common: float, lanes"),
        (compares_numbers_as_lanes, "lanes are needed, not float, float"),
    ],
)
def test_what_cannot_be_compiled_is_refused_with_its_line(
    function: Callable[[Memory], None], message: str
) -> None:
    place = re.escape(__file__) + r":\d+: "
    pattern = message if ".*" in message else re.escape(message)
    with pytest.raises(KernelError, match=place + pattern):
        Kernel(function, None).prepare()


def test_the_line_is_that_of_the_expression() -> None:
    expected = f"{__file__}:{line_of(divides_far_down, 'nowhere')}: nowhere is no number"
    with pytest.raises(KernelError, match=re.escape(expected)):
        Kernel(divides_far_down, None).prepare()


def divides_far_down(m: Memory) -> None:
    m.reals[0] = max(
        m.x,
        nowhere,  # noqa: F821
    )


def _within(k: int) -> Callable[[Memory], None]:
    def inner(m: Memory) -> None:
        m.wholes[0] = k

    return inner


@functools.cache
def decorated(m: Memory) -> None:
    m.wholes[0] = 1


def has_no_type(m) -> None:
    m.wholes[0] = 1


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (_within(1), "inner needs k of the function round it"),
        (lambda m: None, "<lambda> is no function made by def"),
        (decorated.__wrapped__, "decorated is decorated"),
        (has_no_type, "has_no_type takes 1 arguments with types, not 0"),
    ],
)
def test_functions_that_are_more_than_their_own_statements_are_refused(
    function: Callable[[Memory], None], message: str
) -> None:
    with pytest.raises(KernelError, match=re.escape(__file__) + r":\d+: " + re.escape(message)):
        Kernel(function, None).prepare()


def test_kernels_that_are_kept_come_from_their_package_alone() -> None:
    message = "_rest comes from .*test_machine_code, not from nag.tracking"
    with pytest.raises(KernelError, match=re.escape(__file__) + r":\d+: " + message):
        Kernel(divides, "tracking")._compile()


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
