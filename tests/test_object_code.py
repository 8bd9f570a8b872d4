"""The kernels become object code for every kind of computer that the README names."""

from __future__ import annotations

import struct

import pytest
from llvmlite import binding

from nag.machine_code.functions import Module
from nag.machine_code.target import ENTRY, Processor, object_code
from nag.solving.start.mixed_cells import _kernel as cells
from nag.tracking.ends.end_run import KERNELS
from nag.tracking.newton_kernel import newton_lanes
from nag.tracking.straight_run import track_lanes

ALL = {
    "track": track_lanes,
    "newton": newton_lanes,
    "cells": cells,
    # In quad-double there is more of the same, which takes six times as long.
    "ends": KERNELS[2],
}
# x86-64 without fused multiplication, with it in vectors of four doubles, and of eight.
PLATFORMS = {
    "linux-x86-64-v2": Processor("x86_64-unknown-linux-gnu", "x86-64-v2", ""),
    "linux-x86-64-v3": Processor("x86_64-unknown-linux-gnu", "x86-64-v3", ""),
    "linux-x86-64-v4": Processor("x86_64-unknown-linux-gnu", "x86-64-v4", ""),
    "linux-aarch64": Processor("aarch64-unknown-linux-gnu", "generic", ""),
    "macos-arm64": Processor("arm64-apple-darwin23.0.0", "apple-m1", ""),
}
# What C libraries have, and Linux's and macOS's alone.
LIBRARY = {"cos", "exp", "exp2", "fma", "hypot", "log", "log2", "memcpy", "memset", "pow", "sin"}
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


@pytest.fixture(scope="module")
def texts() -> dict[str, str]:
    return {name: str(Module(k.function, k.modules).ir) for name, k in ALL.items()}


@pytest.mark.slow
@pytest.mark.parametrize("platform", PLATFORMS)
@pytest.mark.parametrize("kernel", ALL)
def test_kernels_need_nothing_but_the_c_library(
    kernel: str, platform: str, texts: dict[str, str]
) -> None:
    code = object_code(texts[kernel], PLATFORMS[platform])
    linux = platform.startswith("linux")
    assert code[:4] == (b"\x7fELF" if linux else struct.pack("<I", 0xFEEDFACF))
    machine, defined, needed = (elf_symbols if linux else macho_symbols)(code)
    assert machine == X86_64 if "x86" in platform else machine in AARCH64
    assert defined == {ENTRY}
    assert needed <= LIBRARY | (LINUX if linux else MACOS)
    # A fused multiplication is a call where the processor has none, and an instruction elsewhere.
    assert ("fma" in needed) == (platform.endswith("v2") and kernel not in ("track", "cells"))
