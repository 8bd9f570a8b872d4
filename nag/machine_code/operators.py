"""Operators of Python on the values in kernels, with Python's meaning.

Only the division of whole numbers raises, see `nag.machine_code.failures`; other divisions by zero
give an infinity or NaN, and powers that are not real NaN. Whole numbers wrap round at 64 bits. No
operation on floating-point numbers is reassociated or contracted.
"""

from __future__ import annotations

import ast
import sys
from typing import Any

from llvmlite import ir

from nag.machine_code.records import BOOL, COMPLEX, INT, LANES, NUMBERS, REAL
from nag.machine_code.values import (
    WORD,
    KernelError,
    Value,
    common,
    complex_of,
    constant,
    convert,
    parts,
)

_FLOATING = {ast.Add: "fadd", ast.Sub: "fsub", ast.Mult: "fmul", ast.Div: "fdiv"}
_WHOLE = {ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul"}
_SHIFTS = {ast.LShift: "shl", ast.RShift: "ashr"}
_HYPOT = "_hypot" if sys.platform == "win32" else "hypot"
_COMPARE = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}


def intrinsic(builder: ir.IRBuilder, name: str, *arguments: Any) -> Any:
    """Call a function of LLVM or of C; all arguments and the result have one type."""
    function = builder.module.globals.get(name)
    if function is None:
        kind = ir.FunctionType(arguments[0].type, [a.type for a in arguments])
        function = ir.Function(builder.module, kind, name)
    return builder.call(function, arguments)


def divides_whole_numbers(operator: ast.operator, left: Value, right: Value) -> bool:
    """Whether ``left operator right`` is an error where ``right`` is zero."""
    whole = left.type in (BOOL, INT) and right.type in (BOOL, INT)
    return whole and isinstance(operator, ast.Div | ast.FloorDiv | ast.Mod)


def binary(builder: ir.IRBuilder, operator: ast.operator, left: Value, right: Value) -> Value:
    """``left operator right``; whole numbers are divided by one that is not zero.

    Raises:
        KernelError: if the types have no such operator.
    """
    kind = type(operator)
    if kind is ast.Pow:
        return _power(builder, left, right)
    if kind in _SHIFTS:
        return _shift(builder, kind, left, right)
    if kind is ast.Div and left.type in (BOOL, INT):
        left = convert(builder, left, REAL)
    left, right = common(builder, [left, right])
    if left.type == BOOL:
        left, right = convert(builder, left, INT), convert(builder, right, INT)
    a, b = left.code, right.code
    if left.type in (REAL, LANES) and kind in _FLOATING:
        return Value(left.type, getattr(builder, _FLOATING[kind])(a, b))
    if left.type == INT and kind in _WHOLE:
        return Value(INT, getattr(builder, _WHOLE[kind])(a, b))
    if left.type == INT and kind in (ast.FloorDiv, ast.Mod):
        return _floor(builder, kind, a, b)
    if left.type == COMPLEX and kind in _FLOATING:
        return _complex(builder, kind, left, right)
    raise KernelError(f"no {kind.__name__} of {left.type}")


def _floor(builder: ir.IRBuilder, kind: type, a: Any, b: Any) -> Value:
    zero, one = ir.Constant(WORD, 0), ir.Constant(WORD, 1)
    # The smallest number divided by -1 has no result in 64 bits, and processors stop there.
    inverts = builder.icmp_signed("==", b, ir.Constant(WORD, -1))
    divisor = builder.select(inverts, one, b)
    rest = builder.srem(a, divisor)
    signs = builder.icmp_signed("<", builder.xor(rest, b), zero)
    off = builder.and_(builder.icmp_signed("!=", rest, zero), signs)
    if kind is ast.Mod:
        return Value(INT, builder.add(rest, builder.select(off, b, zero)))
    quotient = builder.sub(builder.sdiv(a, divisor), builder.zext(off, WORD))
    return Value(INT, builder.select(inverts, builder.neg(a), quotient))


def _shift(builder: ir.IRBuilder, kind: type, left: Value, right: Value) -> Value:
    if left.type != INT or right.type != INT:
        raise KernelError(f"no {kind.__name__} of {left.type} and {right.type}")
    known = isinstance(right.code, ir.Constant)
    if not known or not 0 <= right.code.constant < WORD.width:
        raise KernelError("whole numbers are shifted by constants from 0 to 63")
    return Value(INT, getattr(builder, _SHIFTS[kind])(left.code, right.code))


def _power(builder: ir.IRBuilder, left: Value, right: Value) -> Value:
    if right.type == INT:
        if not isinstance(right.code, ir.Constant) or right.code.constant != 2:
            raise KernelError("the only whole exponent is 2")
        return binary(builder, ast.Mult(), left, left)
    if left.type not in (INT, REAL) or right.type != REAL:
        raise KernelError(f"no Pow of {left.type} and {right.type}")
    left = convert(builder, left, REAL)
    return Value(REAL, intrinsic(builder, "llvm.pow.f64", left.code, right.code))


def _complex(builder: ir.IRBuilder, kind: type, left: Value, right: Value) -> Value:
    (a, b), (c, d) = parts(builder, left), parts(builder, right)
    if kind in (ast.Add, ast.Sub):
        method = getattr(builder, _FLOATING[kind])
        return complex_of(builder, method(a, c), method(b, d))
    if kind is ast.Mult:
        re = builder.fsub(builder.fmul(a, c), builder.fmul(b, d))
        return complex_of(builder, re, builder.fadd(builder.fmul(a, d), builder.fmul(b, c)))
    # Smith's division (1962), as in CPython, without a branch: the larger part of the divisor
    # divides the smaller one.
    real = builder.fcmp_ordered(">=", absolute(builder, c), absolute(builder, d))
    large, small = builder.select(real, c, d), builder.select(real, d, c)
    first, second = builder.select(real, a, b), builder.select(real, b, a)
    ratio = builder.fdiv(small, large)
    divisor = builder.fadd(large, builder.fmul(small, ratio))
    re = builder.fdiv(builder.fadd(first, builder.fmul(second, ratio)), divisor)
    cross = builder.fmul(first, ratio)
    im = builder.select(real, builder.fsub(second, cross), builder.fsub(cross, second))
    return complex_of(builder, re, builder.fdiv(im, divisor))


def absolute(builder: ir.IRBuilder, code: Any) -> Any:
    """``|code|``, of a double."""
    return intrinsic(builder, "llvm.fabs.f64", code)


def unary(builder: ir.IRBuilder, operator: ast.unaryop, value: Value) -> Value:
    """``-value`` or ``+value``."""
    if isinstance(operator, ast.UAdd) and value.type in (INT, REAL, COMPLEX, LANES):
        return value
    if isinstance(operator, ast.USub):
        if value.type in (REAL, LANES):
            return Value(value.type, builder.fneg(value.code))
        if value.type == INT:
            if isinstance(value.code, ir.Constant):
                return constant(-value.code.constant)
            return Value(INT, builder.neg(value.code))
        if value.type == COMPLEX:
            re, im = parts(builder, value)
            return complex_of(builder, builder.fneg(re), builder.fneg(im))
    raise KernelError(f"no {type(operator).__name__} of {value.type}")


def compare(builder: ir.IRBuilder, operator: ast.cmpop, left: Value, right: Value) -> Any:
    """Whether ``left operator right``, a bit."""
    left, right = common(builder, [left, right])
    sign = _COMPARE.get(type(operator))
    a, b = left.code, right.code
    if left.type in (BOOL, INT) and sign:
        method = builder.icmp_unsigned if left.type == BOOL else builder.icmp_signed
        return method(sign, a, b)
    if left.type == REAL and sign:
        method = builder.fcmp_unordered if sign == "!=" else builder.fcmp_ordered
        return method(sign, a, b)
    if left.type == COMPLEX and sign in ("==", "!="):
        (a, b), (c, d) = parts(builder, left), parts(builder, right)
        same = builder.and_(builder.fcmp_ordered("==", a, c), builder.fcmp_ordered("==", b, d))
        return same if sign == "==" else builder.not_(same)
    raise KernelError(f"no {type(operator).__name__} of {left.type}")


def magnitude(builder: ir.IRBuilder, value: Value) -> Value:
    """``abs(value)``."""
    if value.type == COMPLEX:
        return Value(REAL, intrinsic(builder, _HYPOT, *parts(builder, value)))
    if value.type == REAL:
        return Value(REAL, absolute(builder, value.code))
    code = convert(builder, value, INT).code
    negative = builder.icmp_signed("<", code, ir.Constant(WORD, 0))
    return Value(INT, builder.select(negative, builder.neg(code), code))


def truncated(builder: ir.IRBuilder, value: Value) -> Value:
    """``int(value)``: towards zero; the nearest there is for what has more than 64 bits, 0 for NaN.

    Raises:
        KernelError: if it is no real number.
    """
    if value.type == REAL:
        name = "llvm.fptosi.sat.i64.f64"
        function = builder.module.globals.get(name)
        if function is None:
            kind = ir.FunctionType(WORD, [value.code.type])
            function = ir.Function(builder.module, kind, name)
        return Value(INT, builder.call(function, [value.code]))
    return convert(builder, value, INT)


def extreme(builder: ir.IRBuilder, sign: str, values: list[Value]) -> Value:
    """``min`` (sign ``<``) or ``max`` (sign ``>``): the first one that no other one exceeds.

    Raises:
        KernelError: if they are no numbers.
    """
    if any(v.type not in NUMBERS for v in values):
        raise KernelError(f"no order of {', '.join(str(v.type) for v in values)}")
    result, *rest = common(builder, values)
    operator = ast.Lt() if sign == "<" else ast.Gt()
    for value in rest:
        better = compare(builder, operator, value, result)
        result = Value(result.type, builder.select(better, value.code, result.code))
    return result
