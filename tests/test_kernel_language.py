"""What cannot be compiled is refused, with its file and line."""

from __future__ import annotations

import functools
import inspect
import math
import re
from collections.abc import Callable

import pytest
from kernel_memory import Memory

from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import any_less, load, store
from nag.machine_code.values import KernelError


def _rest(a, b):
    return a % b


def divides(m: Memory) -> None:
    m.wholes[0] = _rest(5, m.n)


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


def cuts_at_a_variable(m: Memory) -> None:
    pair = m.n, m.n
    a, b = pair[m.n :]
    m.wholes[0] = a + b


def cuts_at_a_fraction(m: Memory) -> None:
    pair = m.n, m.n
    (a,) = pair[1.0:]
    m.wholes[0] = a


def joins_a_number(m: Memory) -> None:
    pair = m.n, m.n
    pair = pair + m.n
    m.wholes[0] = pair[0]


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
        (cuts_at_a_variable, "the index of a tuple must be a constant"),
        (cuts_at_a_fraction, "a tuple is cut at whole numbers"),
        (joins_a_number, "no Add of (int, int) and int"),
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
        Kernel(function, keep=False).prepare()


def test_the_line_is_that_of_the_expression() -> None:
    line = inspect.getsourcelines(divides_far_down)[1] + 3
    expected = f"{__file__}:{line}: nowhere is no number"
    with pytest.raises(KernelError, match=re.escape(expected)):
        Kernel(divides_far_down, keep=False).prepare()


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
        Kernel(function, keep=False).prepare()
