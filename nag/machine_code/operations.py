"""What kernels may call besides functions of their own: Python's, the standard library's, lanes'.

Each entry of `OPERATIONS` takes LLVM's builder and the values of the arguments.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir

from nag.machine_code import lanes, operators
from nag.machine_code.records import BOOL, INT, LANES, NONE, REAL, Pointer
from nag.machine_code.values import (
    VECTOR,
    WIDTH,
    KernelError,
    Value,
    complex_of,
    convert,
    truth,
)

_WORD32 = ir.IntType(32)


Emit = Callable[[ir.IRBuilder, list[Value]], Value]


def _function(name: str) -> Emit:
    """A function of doubles that LLVM or C provides."""

    def emit(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
        codes = [convert(builder, a, REAL).code for a in arguments]
        return Value(REAL, operators.intrinsic(builder, name, *codes))

    return emit


def _complex(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
    re, im = (convert(builder, a, REAL).code for a in arguments)
    return complex_of(builder, re, im)


def _lanes(arguments: list[Value]) -> list[Any]:
    if any(a.type != LANES for a in arguments):
        raise KernelError(f"lanes are needed, not {', '.join(str(a.type) for a in arguments)}")
    return [a.code for a in arguments]


def _on_lanes(emit: Callable[..., Any]) -> Emit:
    return lambda builder, arguments: Value(LANES, emit(builder, *_lanes(arguments)))


def index(builder: ir.IRBuilder, value: Value) -> Any:
    """A place in memory; only what is known to be negative is refused, the rest is trusted.

    Raises:
        KernelError: if it is no whole number, or a negative constant.
    """
    if value.type != INT:
        raise KernelError(f"places in memory are whole numbers, not {value.type}")
    if isinstance(value.code, ir.Constant) and value.code.constant < 0:
        raise KernelError("places in memory are not counted from the end")
    return value.code


def _address(builder: ir.IRBuilder, data: Value, place: Value) -> Any:
    if data.type != Pointer("float*", REAL):
        raise KernelError(f"lanes are in memory of doubles, not at {data.type}")
    vectors = builder.bitcast(data.code, VECTOR.as_pointer())
    return builder.gep(vectors, [index(builder, place)])


def _load(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
    return Value(LANES, builder.load(_address(builder, *arguments), align=lanes.ALIGNMENT))


def _store(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
    data, place, value = arguments
    (code,) = _lanes([value])
    builder.store(code, _address(builder, data, place), align=lanes.ALIGNMENT)
    return Value(NONE, None)


def _splat(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
    scalar = convert(builder, arguments[0], REAL).code
    if isinstance(scalar, ir.Constant):
        return Value(LANES, ir.Constant(VECTOR, [scalar.constant] * WIDTH))
    empty = ir.Constant(VECTOR, ir.Undefined)
    vector = builder.insert_element(empty, scalar, ir.Constant(_WORD32, 0))
    zeros = ir.Constant(ir.VectorType(_WORD32, WIDTH), [0] * WIDTH)
    return Value(LANES, builder.shuffle_vector(vector, empty, zeros))


def _less(builder: ir.IRBuilder, a: Any, b: Any, x: Any, y: Any) -> Any:
    return builder.select(builder.fcmp_ordered("<", a, b), x, y)


def _any_less(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
    a, b = _lanes(arguments)
    bits = builder.bitcast(builder.fcmp_ordered("<", a, b), ir.IntType(WIDTH))
    return Value(BOOL, builder.icmp_unsigned("!=", bits, ir.Constant(ir.IntType(WIDTH), 0)))


def _multiply_add(builder: ir.IRBuilder, a: Any, b: Any, c: Any) -> Any:
    return operators.intrinsic(builder, f"llvm.fmuladd.v{WIDTH}f64", a, b, c)


def _multiply_and_add(builder: ir.IRBuilder, a: Any, b: Any, c: Any) -> Any:
    return operators.intrinsic(builder, f"llvm.fma.v{WIDTH}f64", a, b, c)


def _square_root(builder: ir.IRBuilder, a: Any) -> Any:
    return operators.intrinsic(builder, f"llvm.sqrt.v{WIDTH}f64", a)


# What may be called: how many arguments it takes, None for two or more, and what it becomes.
OPERATIONS: dict[Any, tuple[int | None, Emit]] = {
    abs: (1, lambda builder, a: operators.magnitude(builder, a[0])),
    bool: (1, lambda builder, a: Value(BOOL, truth(builder, a[0]))),
    complex: (2, _complex),
    float: (1, lambda builder, a: convert(builder, a[0], REAL)),
    int: (1, lambda builder, a: operators.truncated(builder, a[0])),
    max: (None, lambda builder, a: operators.extreme(builder, ">", a)),
    min: (None, lambda builder, a: operators.extreme(builder, "<", a)),
    math.atan2: (2, _function("atan2")),
    math.cos: (1, _function("llvm.cos.f64")),
    math.exp: (1, _function("llvm.exp.f64")),
    math.log: (1, _function("llvm.log.f64")),
    math.log2: (1, _function("llvm.log2.f64")),
    math.sin: (1, _function("llvm.sin.f64")),
    math.sqrt: (1, _function("llvm.sqrt.f64")),
    np.rint: (1, _function("llvm.rint.f64")),
    lanes.any_less: (2, _any_less),
    lanes.fma: (3, _on_lanes(_multiply_add)),
    lanes.fnma: (3, _on_lanes(lambda b, x, y, z: _multiply_add(b, b.fneg(x), y, z))),
    lanes.fused: (3, _on_lanes(_multiply_and_add)),
    lanes.load: (2, _load),
    lanes.select_less: (4, _on_lanes(_less)),
    lanes.splat: (1, _splat),
    lanes.square_root: (1, _on_lanes(_square_root)),
    lanes.store: (3, _store),
}


def operation(function: Any) -> tuple[int | None, Emit] | None:
    """What a function of Python becomes; None for what is none of `OPERATIONS`."""
    try:
        return OPERATIONS.get(function)
    except TypeError:
        return None
