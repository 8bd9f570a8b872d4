"""Divisions of whole numbers by zero in kernels: what happened, and where, gets back to Python.

The last argument of every function points to a word that is zero as long as all goes well. A
division by zero writes the address of its message there and returns at once, and so does every
function on the way up to Python.
"""

from __future__ import annotations

import ctypes
from typing import Any

from llvmlite import ir

from nag.machine_code.records import INT
from nag.machine_code.values import BYTE, WORD, Value, convert


def _message(module: ir.Module, text: str) -> ir.GlobalVariable:
    name = f"message.{text}"
    if name in module.globals:
        return module.globals[name]
    data = bytearray(text.encode() + b"\0")
    kind = ir.ArrayType(BYTE, len(data))
    message = ir.GlobalVariable(module, kind, name)
    message.linkage = "internal"
    message.global_constant = True
    message.initializer = ir.Constant(kind, data)
    return message


def check_divisor(function: ir.Function, builder: ir.IRBuilder, divisor: Value, text: str) -> None:
    """Return with ``text`` where a whole number is zero."""
    code = convert(builder, divisor, INT).code
    zero, after = (function.append_basic_block() for _ in range(2))
    builder.cbranch(builder.icmp_signed("==", code, ir.Constant(WORD, 0)), zero, after)
    builder.position_at_end(zero)
    message = _message(function.module, text)
    builder.store(builder.ptrtoint(message, WORD), function.args[-1])
    builder.ret_void()
    builder.position_at_end(after)


def check_call(function: ir.Function, builder: ir.IRBuilder) -> None:
    """Return where the function called just now failed."""
    failed, after = (function.append_basic_block() for _ in range(2))
    state = builder.load(function.args[-1])
    builder.cbranch(builder.icmp_signed("==", state, ir.Constant(WORD, 0)), after, failed)
    builder.position_at_end(failed)
    builder.ret_void()
    builder.position_at_end(after)


def message(address: Any) -> str:
    """The message at an address that a kernel wrote."""
    return ctypes.string_at(address).decode()
