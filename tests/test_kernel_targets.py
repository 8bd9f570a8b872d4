"""Kernels are sources for whatever LLVM knows: nothing in them is of one processor alone."""

from __future__ import annotations

import re

import llvmlite.binding as llvm
import pytest

from nag.machine_code.functions import Module
from nag.tracking.straight_run import track_lanes

# What Nvidia's own library of functions, libdevice, has by these names.
IN_LIBDEVICE = re.compile(r"llvm\.(exp|sin|cos|pow)\.f64")


def assemble(triple: str, name: str) -> str:
    """The tracker in doubles as assembly text."""
    text = str(Module(track_lanes.function, track_lanes.constants, triple=triple).ir)
    text = text.replace('target triple = ""', f'target triple = "{triple}"')
    if triple.startswith("nvptx"):
        text = IN_LIBDEVICE.sub(r"__nv_\1", text)
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    try:
        target = llvm.Target.from_triple(triple)
    except RuntimeError:
        pytest.skip(f"this LLVM knows no {triple}")
    machine = target.create_target_machine(cpu=name, opt=1)
    return machine.emit_assembly(llvm.parse_assembly(text))


def test_the_tracker_is_assembled_for_a_graphics_processor() -> None:
    text = assemble("nvptx64-nvidia-cuda", "sm_70")
    assert ".target sm_70" in text
    assert "fma.rn.f64" in text
    assert len(re.findall(r"^\.visible \.func nag_kernel", text, re.M)) == 1
    called = set(re.findall(r"^\.extern \.func .*?(\w+)$", text, re.M))
    assert called == {"__nv_exp", "__nv_sin", "__nv_cos", "__nv_pow"}


@pytest.mark.parametrize("triple", ["aarch64-unknown-linux-gnu", "x86_64-unknown-linux-gnu"])
def test_the_tracker_is_assembled_for_other_processors(triple: str) -> None:
    assert "nag_kernel" in assemble(triple, "")
