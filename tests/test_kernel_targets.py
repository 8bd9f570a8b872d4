"""Kernels are sources for whatever LLVM knows: nothing in them is of one processor alone."""

from __future__ import annotations

import re
import shutil
import subprocess
from importlib.metadata import PackageNotFoundError, files
from pathlib import Path

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


def find_ptx_assembler() -> str:
    """Nvidia's assembler of PTX, from its package or where programs are looked for."""
    try:
        parts = files("nvidia-cuda-nvcc-cu12") or []
    except PackageNotFoundError:
        parts = []
    packaged = next((str(part.locate()) for part in parts if part.name == "ptxas"), None)
    found = packaged or shutil.which("ptxas")
    if found is None:
        pytest.skip("no ptxas is installed")
    return found


def test_the_tracker_is_a_function_of_ptx() -> None:
    text = assemble("nvptx64-nvidia-cuda", "sm_80")
    assert ".target sm_80" in text
    assert "fma.rn.f64" in text
    assert len(re.findall(r"^\.visible \.func nag_kernel", text, re.M)) == 1
    called = set(re.findall(r"^\.extern \.func .*?(\w+)$", text, re.M))
    assert called == {"__nv_exp", "__nv_sin", "__nv_cos", "__nv_pow"}


@pytest.mark.parametrize("name", ["sm_80", "sm_90"])
def test_the_tracker_is_assembled_for_a_graphics_processor(name: str, tmp_path: Path) -> None:
    source, target = tmp_path / "tracker.ptx", tmp_path / "tracker.o"
    source.write_text(assemble("nvptx64-nvidia-cuda", name))
    command = [find_ptx_assembler(), "--compile-only", f"--gpu-name={name}", "-o", target, source]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    code = target.read_bytes()
    # The number of Nvidia's processors among those of executable files.
    assert code[:4] == b"\x7fELF"
    assert int.from_bytes(code[18:20], "little") == 190
    assert b"nag_kernel" in code


@pytest.mark.parametrize("triple", ["aarch64-unknown-linux-gnu", "x86_64-unknown-linux-gnu"])
def test_the_tracker_is_assembled_for_other_processors(triple: str) -> None:
    assert "nag_kernel" in assemble(triple, "")
