"""The register that tells the processor what to do with numbers smaller than normal doubles.

Doubles below 2.2e-308 have fewer digits than others, and every operation on them is handed to
microcode, which takes a hundred times as long. They are nothing but the rounding errors of zeros:
Taylor coefficients of a coordinate that stands still are products of them. A kernel takes them for
zero, and leaves the register as it was.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from llvmlite import ir

from nag.machine_code.values import BYTE, WORD

_HALF = ir.IntType(32)


class _Register(NamedTuple):
    """LLVM's functions that read and write it, the bits that flush, and its type.

    Attributes:
        in_memory: whether the functions take an address, and not the register's content.
    """

    read: str
    write: str
    flushing: int
    kind: ir.IntType
    in_memory: bool


# By how the names of processors begin. Results and operands are flushed, for which x86 has two
# bits and ARM has one.
_REGISTERS = {
    ("x86_64", "amd64", "i686"): _Register(
        "llvm.x86.sse.stmxcsr", "llvm.x86.sse.ldmxcsr", 0x8040, _HALF, True
    ),
    ("aarch64", "arm64"): _Register(
        "llvm.aarch64.get.fpcr", "llvm.aarch64.set.fpcr", 1 << 24, WORD, False
    ),
}


def call_flushing(builder: ir.IRBuilder, triple: str, function: Any, arguments: Any) -> None:
    """Call a function so that it takes numbers below the normal ones for zero.

    On processors that are not known here it takes them as they are.

    Args:
        triple: LLVM's name of the kind of system.
    """
    register = next((r for names, r in _REGISTERS.items() if triple.startswith(names)), None)
    if register is None:
        builder.call(function, arguments)
        return
    place = builder.alloca(register.kind, 2)
    given, chosen = place, builder.gep(place, [ir.Constant(_HALF, 1)])
    _read(builder, register, given)
    flushing = builder.or_(builder.load(given), ir.Constant(register.kind, register.flushing))
    builder.store(flushing, chosen)
    _write(builder, register, chosen)
    builder.call(function, arguments)
    _write(builder, register, given)


def _read(builder: ir.IRBuilder, register: _Register, place: Any) -> None:
    if register.in_memory:
        _call(builder, register.read, ir.VoidType(), builder.bitcast(place, BYTE.as_pointer()))
    else:
        builder.store(_call(builder, register.read, register.kind), place)


def _write(builder: ir.IRBuilder, register: _Register, place: Any) -> None:
    if register.in_memory:
        argument = builder.bitcast(place, BYTE.as_pointer())
    else:
        argument = builder.load(place)
    _call(builder, register.write, ir.VoidType(), argument)


def _call(builder: ir.IRBuilder, name: str, result: ir.Type, *arguments: Any) -> Any:
    function = builder.module.globals.get(name)
    if function is None:
        kind = ir.FunctionType(result, [a.type for a in arguments])
        function = ir.Function(builder.module, kind, name)
    return builder.call(function, arguments)
