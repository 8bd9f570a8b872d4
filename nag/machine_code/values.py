"""Values in kernels as LLVM knows them, and conversions between the types of numbers."""

from __future__ import annotations

from typing import Any, NamedTuple

from llvmlite import ir

from nag.machine_code.records import (
    BOOL,
    COMPLEX,
    INT,
    LANES,
    NUMBERS,
    REAL,
    Pointer,
    Record,
    Tuple,
    Type,
)

WORD = ir.IntType(64)
DOUBLE = ir.DoubleType()
BIT = ir.IntType(1)
BYTE = ir.IntType(8)
WIDTH = 8
VECTOR = ir.VectorType(DOUBLE, WIDTH)
_SIMPLE = {
    BOOL: BIT,
    INT: WORD,
    REAL: DOUBLE,
    COMPLEX: ir.LiteralStructType([DOUBLE, DOUBLE]),
    LANES: VECTOR,
}


class KernelError(Exception):
    """A function cannot be compiled; the message says where and why."""


class LocatedError(KernelError):
    """A `KernelError` that says where."""


class Value(NamedTuple):
    """A value of a type, computed by LLVM's ``code``."""

    type: Type
    code: Any


def llvm_type(kind: Type) -> ir.Type:
    """The type that LLVM has for ``kind``."""
    if isinstance(kind, Pointer):
        return llvm_type(kind.element).as_pointer()
    if isinstance(kind, Tuple):
        return ir.LiteralStructType([llvm_type(item) for item in kind.items])
    if isinstance(kind, Record):
        return WORD.as_pointer()
    return _SIMPLE[kind]


def constant(value: bool | int | float | complex) -> Value:
    """A number that is known.

    Raises:
        KernelError: if it is a whole number of more than 64 bits.
    """
    if isinstance(value, bool):
        return Value(BOOL, ir.Constant(BIT, value))
    if isinstance(value, int):
        if not -(2**63) <= value < 2**63:
            raise KernelError(f"{value} does not fit in 64 bits")
        return Value(INT, ir.Constant(WORD, int(value)))
    if isinstance(value, float):
        return Value(REAL, ir.Constant(DOUBLE, float(value)))
    parts = [ir.Constant(DOUBLE, value.real), ir.Constant(DOUBLE, value.imag)]
    return Value(COMPLEX, ir.Constant.literal_struct(parts))


def convert(builder: ir.IRBuilder, value: Value, kind: Type) -> Value:
    """``value`` as another type, which must be able to hold every value of its own.

    Raises:
        KernelError: if it is not.
    """
    if value.type == kind:
        return value
    if value.type not in NUMBERS or kind not in NUMBERS:
        raise KernelError(f"{value.type} is no {kind}")
    if NUMBERS.index(value.type) > NUMBERS.index(kind):
        raise KernelError(f"{value.type} does not convert to {kind}")
    code = value.code
    if value.type == BOOL:
        code = builder.zext(code, WORD)
    if kind == INT:
        return Value(INT, code)
    if value.type != REAL:
        code = builder.sitofp(code, DOUBLE)
    if kind == REAL:
        return Value(REAL, code)
    return complex_of(builder, code, ir.Constant(DOUBLE, 0.0))


def common(builder: ir.IRBuilder, values: list[Value]) -> list[Value]:
    """The values converted to the type of one of them that can hold all."""
    kinds = {v.type for v in values}
    if len(kinds) == 1:
        return values
    if not kinds <= set(NUMBERS):
        raise KernelError(f"no type in common: {', '.join(sorted(map(str, kinds)))}")
    widest = max(kinds, key=NUMBERS.index)
    return [convert(builder, v, widest) for v in values]


def truth(builder: ir.IRBuilder, value: Value) -> Any:
    """Whether a number is not zero."""
    if value.type == BOOL:
        return value.code
    if value.type == INT:
        return builder.icmp_signed("!=", value.code, ir.Constant(WORD, 0))
    raise KernelError(f"{value.type} is neither true nor false")


def complex_of(builder: ir.IRBuilder, re: Any, im: Any) -> Value:
    """The complex number with these parts."""
    empty = ir.Constant(_SIMPLE[COMPLEX], ir.Undefined)
    return Value(COMPLEX, builder.insert_value(builder.insert_value(empty, re, 0), im, 1))


def parts(builder: ir.IRBuilder, value: Value) -> tuple[Any, Any]:
    """Real and imaginary part of a complex number."""
    return builder.extract_value(value.code, 0), builder.extract_value(value.code, 1)
