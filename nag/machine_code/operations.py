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


def _function(name: str) -> Callable[..., Value]:
    """A function of doubles that LLVM or C provides."""

    def emit(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
        codes = [convert(builder, a, REAL).code for a in arguments]
        return Value(REAL, operators.intrinsic(builder, name, *codes))

    return emit


def _complex(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
    re, im = (convert(builder, a, REAL).code for a in arguments)
    return complex_of(builder, re, im)


def _on_lanes(emit: Callable[..., Any]) -> Callable[..., Value]:
    def checked(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
        if any(a.type != LANES for a in arguments):
            raise KernelError(f"lanes are needed, not {', '.join(str(a.type) for a in arguments)}")
        return Value(LANES, emit(builder, *(a.code for a in arguments)))

    return checked


def _address(builder: ir.IRBuilder, data: Value, index: Value) -> Any:
    if data.type != Pointer("float*", REAL):
        raise KernelError(f"lanes are in memory of doubles, not at {data.type}")
    vectors = builder.bitcast(data.code, VECTOR.as_pointer())
    return builder.gep(vectors, [convert(builder, index, INT).code])


def _load(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
    return Value(LANES, builder.load(_address(builder, *arguments), align=lanes.ALIGNMENT))


def _store(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
    data, index, value = arguments
    if value.type != LANES:
        raise KernelError(f"lanes are needed, not {value.type}")
    builder.store(value.code, _address(builder, data, index), align=lanes.ALIGNMENT)
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
    a, b = (v.code for v in arguments)
    bits = builder.bitcast(builder.fcmp_ordered("<", a, b), ir.IntType(WIDTH))
    return Value(BOOL, builder.icmp_unsigned("!=", bits, ir.Constant(ir.IntType(WIDTH), 0)))


def _multiply_add(builder: ir.IRBuilder, a: Any, b: Any, c: Any) -> Any:
    return operators.intrinsic(builder, f"llvm.fmuladd.v{WIDTH}f64", a, b, c)


def _shifted(builder: ir.IRBuilder, arguments: list[Value]) -> Value:
    data, index = arguments
    return Value(data.type, builder.gep(data.code, [convert(builder, index, INT).code]))


OPERATIONS: dict[Any, Callable[..., Value]] = {
    abs: lambda builder, a: operators.magnitude(builder, a[0]),
    bool: lambda builder, a: Value(BOOL, truth(builder, a[0])),
    complex: _complex,
    float: lambda builder, a: convert(builder, a[0], REAL),
    int: lambda builder, a: operators.truncated(builder, a[0]),
    max: lambda builder, a: operators.extreme(builder, ">", a),
    min: lambda builder, a: operators.extreme(builder, "<", a),
    math.atan2: _function("atan2"),
    math.cos: _function("llvm.cos.f64"),
    math.exp: _function("llvm.exp.f64"),
    math.log: _function("llvm.log.f64"),
    math.log2: _function("llvm.log2.f64"),
    math.sin: _function("llvm.sin.f64"),
    math.sqrt: _function("llvm.sqrt.f64"),
    np.rint: _function("llvm.rint.f64"),
    lanes.any_less: _any_less,
    lanes.fma: _on_lanes(_multiply_add),
    lanes.fnma: _on_lanes(lambda builder, a, b, c: _multiply_add(builder, builder.fneg(a), b, c)),
    lanes.fused: _on_lanes(
        lambda builder, *a: operators.intrinsic(builder, f"llvm.fma.v{WIDTH}f64", *a)
    ),
    lanes.load: _load,
    lanes.select_less: _on_lanes(_less),
    lanes.shifted: _shifted,
    lanes.splat: _splat,
    lanes.square_root: _on_lanes(
        lambda builder, a: operators.intrinsic(builder, f"llvm.sqrt.v{WIDTH}f64", a)
    ),
    lanes.store: _store,
}
