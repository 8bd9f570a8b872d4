"""The kernels become object code for every kind of computer that the README names."""

from __future__ import annotations

import math
import struct
from functools import cache
from typing import Any

import numpy as np
import pytest
from kernel_memory import Memory
from llvmlite import binding

from nag.machine_code import lanes
from nag.machine_code.functions import Module
from nag.machine_code.kernel import Kernel
from nag.machine_code.operations import OPERATIONS
from nag.machine_code.processor import ENTRY, Processor, object_code
from nag.solving.start.mixed_cells import _kernel as cells
from nag.tracking.ends import end_run
from nag.tracking.newton_kernel import newton_lanes
from nag.tracking.straight_run import track_lanes


def language(m: Memory) -> None:
    """Every operation that kernels know, and every operator."""
    a, b, k = m.reals[0], m.x, m.wholes[0]
    m.wholes[1] = abs(k) // m.n + k % m.n - (k << 3) * (k >> 2)
    m.wholes[2] = int(a) + bool(k) + (k in (1, 2) or (m.flag and not 0 < k < m.n))
    m.reals[1] = max(a, b) - min(a, b, 0) / m.n + float(k) + abs(a) ** 0.5 + a**2
    m.reals[2] = math.cos(a) + math.sin(a) + math.atan2(a, b) + math.exp(a) + 0.5**a + 2.0**a
    m.reals[3] = math.log(a) + math.log2(a) + math.sqrt(a) + np.rint(a) + 10.0**b
    y, z = complex(a, b), m.complexes[0]
    m.complexes[1] = (y + z - y * z) / z.conjugate() if y != -z else y
    m.reals[4] = abs(z) + z.imag
    p, q = lanes.load(m.reals, 1), lanes.splat(a)
    for i in range(2, m.n):
        q = q + p / lanes.fused(p, q, p) - p * lanes.load(m.reals, i)
        if lanes.any_less(p, q):
            p = lanes.fma(p, q, lanes.fnma(p, q, lanes.square_root(q)))
        lanes.store(m.reals, i, lanes.select_less(p, q, q, -p))


KERNELS = {
    "language": Kernel(language, keep=False),
    "newton": newton_lanes,
    "cells": cells,
    "track": track_lanes,
    # In quad-double there is more of the same, which takes six times as long.
    "ends": end_run.KERNELS[2],
}
# x86-64 without fused multiplication, with it in vectors of four doubles, and of eight.
PLATFORMS = {
    "linux-x86-64-v2": Processor("x86_64-unknown-linux-gnu", "x86-64-v2", ""),
    "linux-x86-64-v3": Processor("x86_64-unknown-linux-gnu", "x86-64-v3", ""),
    "linux-x86-64-v4": Processor("x86_64-unknown-linux-gnu", "x86-64-v4", ""),
    "linux-aarch64": Processor("aarch64-unknown-linux-gnu", "generic", ""),
    "macos-arm64": Processor("arm64-apple-darwin23.0.0", "apple-m1", ""),
}
# The two largest kernels have no other operations than these have, and are compiled for this
# computer by whatever tracks paths.
COMPILED = [(k, p) for k in ("language", "newton", "cells") for p in PLATFORMS]
COMPILED += [("track", "linux-aarch64"), ("ends", "macos-arm64")]
# What C libraries have, and Linux's and macOS's alone.
LIBRARY = {"atan2", "cos", "exp", "exp2", "fma", "hypot", "log", "log2", "memcpy", "memset"}
LIBRARY |= {"pow", "sin"}
LINUX = {"sincos"}
MACOS = {"__bzero", "__sincos_stret", "bzero", "memset_pattern16"}
# Processors as the two formats number them.
X86_64, AARCH64 = 62, (183, 0x0100000C)


def elf_symbols(code: bytes) -> tuple[int, set[str], set[str]]:
    """Machine, symbols defined for others, and symbols needed, of an ELF file of 64 bits."""
    machine = struct.unpack_from("<H", code, 18)[0]
    (start,) = struct.unpack_from("<Q", code, 40)
    size, count = struct.unpack_from("<HH", code, 58)
    sections = [struct.unpack_from("<IIQQQQIIQQ", code, start + size * k) for k in range(count)]
    (table,) = (s for s in sections if s[1] == 2)
    names = sections[table[6]][4]
    defined, needed = set(), set()
    for place in range(table[4] + 24, table[4] + table[5], 24):
        name, info, _, section = struct.unpack_from("<IBBH", code, place)
        text = code[names + name : code.index(b"\0", names + name)].decode()
        if section == 0:
            needed.add(text)
        elif info >> 4 == 1:
            defined.add(text)
    return machine, defined, needed


def macho_symbols(code: bytes) -> tuple[int, set[str], set[str]]:
    """The same of a Mach-O file; names there begin with an underscore."""
    machine = struct.unpack_from("<I", code, 4)[0]
    place = 32
    while struct.unpack_from("<I", code, place)[0] != 2:
        place += struct.unpack_from("<I", code, place + 4)[0]
    table, count, names, _ = struct.unpack_from("<IIII", code, place + 8)
    defined, needed = set(), set()
    for k in range(count):
        name, kind, section = struct.unpack_from("<IBB", code, table + 16 * k)
        text = code[names + name : code.index(b"\0", names + name)].decode()
        assert text.startswith("_") or not kind & 1
        if kind & 1:
            (defined if section else needed).add(text[1:])
    return machine, defined, needed


@pytest.fixture(scope="module", autouse=True)
def targets() -> None:
    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()


@cache
def text(kernel: str, architecture: str) -> str:
    """In LLVM's language, for all systems with processors of a kind."""
    made = KERNELS[kernel]
    return str(Module(made.function, made.constants, architecture).ir)


def test_the_language_is_here_with_every_operation(monkeypatch: pytest.MonkeyPatch) -> None:
    met = set()
    for function, (count, emit) in list(OPERATIONS.items()):

        def noted(*arguments: Any, function: Any = function, emit: Any = emit) -> Any:
            met.add(function)
            return emit(*arguments)

        monkeypatch.setitem(OPERATIONS, function, (count, noted))
    Module(language)
    assert met == set(OPERATIONS)


@pytest.mark.slow
@pytest.mark.parametrize(("kernel", "platform"), COMPILED)
def test_kernels_need_nothing_but_the_c_library(kernel: str, platform: str) -> None:
    target = PLATFORMS[platform]
    code = object_code(text(kernel, target.triple.partition("-")[0]), target)
    linux = platform.startswith("linux")
    assert code[:4] == (b"\x7fELF" if linux else struct.pack("<I", 0xFEEDFACF))
    machine, defined, needed = (elf_symbols if linux else macho_symbols)(code)
    assert machine == X86_64 if "x86" in platform else machine in AARCH64
    assert defined == {ENTRY}
    assert needed <= LIBRARY | (LINUX if linux else MACOS)
    # A fused multiplication is a call where the processor has none, and an instruction elsewhere.
    assert ("fma" in needed) == (platform.endswith("v2") and kernel not in ("track", "cells"))
