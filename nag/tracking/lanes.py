"""Eight doubles at a time: a numba type for the vector registers that carry eight paths.

Work arrays are flat, with the lane (the path) as the last and fastest index, so that vector ``k``
of an array ``a`` is ``a[8 * k : 8 * k + 8]``. Every operation acts on each lane alone, hence a
path's result does not depend on the paths beside it. No operation may be reassociated.
"""

from __future__ import annotations

import operator
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.typing.templates import AbstractTemplate, ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, models, register_model

LANES = 8
ALIGNMENT = 64
_VECTOR = ir.VectorType(ir.DoubleType(), LANES)


class LaneType(types.Type):
    """Type of a register with one double for each of eight paths."""

    def __init__(self) -> None:
        super().__init__(name="Lanes")


lanes = LaneType()


@register_model(LaneType)
class _LaneModel(models.PrimitiveModel):
    def __init__(self, dmm: Any, fe_type: LaneType) -> None:
        super().__init__(dmm, fe_type, _VECTOR)


def _binary(function: Any, method: str) -> None:
    class Template(ConcreteTemplate):
        cases = (signature(lanes, lanes, lanes),)

    infer_global(function)(Template)

    @lower_builtin(function, lanes, lanes)
    def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return getattr(builder, method)(*args)


for _function, _method in (
    (operator.add, "fadd"),
    (operator.sub, "fsub"),
    (operator.mul, "fmul"),
    (operator.truediv, "fdiv"),
):
    _binary(_function, _method)


class PointerType(types.Type):
    """Type of a bare pointer: unlike an array it is one word, and passing it counts nothing."""

    def __init__(self, dtype: types.Type) -> None:
        self.dtype = dtype
        super().__init__(name=f"Pointer({dtype})")


@register_model(PointerType)
class _PointerModel(models.PrimitiveModel):
    def __init__(self, dmm: Any, fe_type: PointerType) -> None:
        element = dmm.lookup(fe_type.dtype).get_data_type()
        super().__init__(dmm, fe_type, element.as_pointer())


@intrinsic
def pointer(typingctx: Any, array: Any) -> Any:
    """Pointer to the first entry of a contiguous array, which must outlive it."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return cgutils.create_struct_proxy(sig.args[0])(context, builder, args[0]).data

    return PointerType(array.dtype)(array), codegen


@infer_global(operator.getitem)
class _GetItem(AbstractTemplate):
    def generic(self, args: Any, kws: Any) -> Any:
        if isinstance(args[0], PointerType) and isinstance(args[1], types.Integer):
            return signature(args[0].dtype, args[0], types.intp)
        return None


@infer_global(operator.setitem)
class _SetItem(AbstractTemplate):
    def generic(self, args: Any, kws: Any) -> Any:
        if isinstance(args[0], PointerType) and isinstance(args[1], types.Integer):
            return signature(types.none, args[0], types.intp, args[0].dtype)
        return None


@lower_builtin(operator.getitem, PointerType, types.intp)
def _lower_getitem(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return builder.load(builder.gep(args[0], [args[1]]))


@lower_builtin(operator.setitem, PointerType, types.intp, types.Any)
def _lower_setitem(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    builder.store(args[2], builder.gep(args[0], [args[1]]))
    return context.get_dummy_value()


def _address(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    data = builder.bitcast(args[0], _VECTOR.as_pointer())
    return builder.gep(data, [args[1]])


@intrinsic
def load(typingctx: Any, data: Any, index: Any) -> Any:
    """Vector ``index`` at a pointer that is aligned to 64 bytes."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.load(_address(context, builder, sig, args), align=ALIGNMENT)

    return lanes(data, types.intp), codegen


@intrinsic
def store(typingctx: Any, data: Any, index: Any, value: Any) -> Any:
    """Write ``value`` to vector ``index`` at a pointer that is aligned to 64 bytes."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        builder.store(args[2], _address(context, builder, sig, args), align=ALIGNMENT)
        return context.get_dummy_value()

    return types.none(data, types.intp, lanes), codegen


def _splat(builder: Any, scalar: Any) -> Any:
    vector = builder.insert_element(
        ir.Constant(_VECTOR, ir.Undefined), scalar, ir.Constant(ir.IntType(32), 0)
    )
    zeros = ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES)
    return builder.shuffle_vector(vector, ir.Constant(_VECTOR, ir.Undefined), zeros)


@intrinsic
def splat(typingctx: Any, value: Any) -> Any:
    """The same number in every lane."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return _splat(builder, args[0])

    return lanes(types.float64), codegen


def _multiply_add(builder: Any, a: Any, b: Any, c: Any) -> Any:
    function = cgutils.get_or_insert_function(
        builder.module,
        ir.FunctionType(_VECTOR, [_VECTOR] * 3),
        f"llvm.fmuladd.v{LANES}f64",
    )
    return builder.call(function, [a, b, c])


@intrinsic
def fma(typingctx: Any, a: Any, b: Any, c: Any) -> Any:
    """``a * b + c``, fused where the machine can."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return _multiply_add(builder, *args)

    return lanes(lanes, lanes, lanes), codegen


@intrinsic
def fnma(typingctx: Any, a: Any, b: Any, c: Any) -> Any:
    """``c - a * b``, fused where the machine can."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return _multiply_add(builder, builder.fneg(args[0]), args[1], args[2])

    return lanes(lanes, lanes, lanes), codegen


@intrinsic
def select_less(typingctx: Any, a: Any, b: Any, x: Any, y: Any) -> Any:
    """``x`` in the lanes where ``a < b``, ``y`` elsewhere."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.select(builder.fcmp_ordered("<", args[0], args[1]), args[2], args[3])

    return lanes(lanes, lanes, lanes, lanes), codegen


@intrinsic
def any_less(typingctx: Any, a: Any, b: Any) -> Any:
    """Whether ``a < b`` in at least one lane."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        mask = builder.fcmp_ordered("<", args[0], args[1])
        bits = builder.bitcast(mask, ir.IntType(LANES))
        return builder.icmp_unsigned("!=", bits, ir.Constant(ir.IntType(LANES), 0))

    return types.boolean(lanes, lanes), codegen


@intrinsic
def square_root(typingctx: Any, a: Any) -> Any:
    """The square root, lane by lane."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        function = cgutils.get_or_insert_function(
            builder.module, ir.FunctionType(_VECTOR, [_VECTOR]), f"llvm.sqrt.v{LANES}f64"
        )
        return builder.call(function, args)

    return lanes(lanes), codegen


@intrinsic
def lane(typingctx: Any, a: Any, index: Any) -> Any:
    """The number in one lane."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.extract_element(
            args[0], builder.trunc(args[1], ir.IntType(32)) if args[1].type.width > 32 else args[1]
        )

    return types.float64(lanes, types.intp), codegen


def aligned(vectors: int) -> np.ndarray:
    """A flat array of zeros for ``vectors`` vectors, aligned to 64 bytes."""
    raw = np.zeros(vectors * LANES + ALIGNMENT // 8)
    offset = (-raw.ctypes.data % ALIGNMENT) // 8
    return raw[offset : offset + vectors * LANES]
