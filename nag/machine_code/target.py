"""This computer as LLVM knows it: object code for it, and object code made ready to run."""

from __future__ import annotations

from functools import cache
from typing import Any

import llvmlite
from llvmlite import binding


@cache
def processor() -> tuple[str, str, str]:
    """Kind of system, name of the processor, and its features; object code is for one of each."""
    try:
        features = binding.get_host_cpu_features().flatten()
    except RuntimeError:
        features = ""
    return binding.get_process_triple(), binding.get_host_cpu_name(), features


def compiler() -> str:
    """Versions of what turns functions into object code."""
    return f"llvmlite {llvmlite.__version__}, LLVM {binding.llvm_version_info}"


@cache
def _prepare() -> None:
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()


def _machine() -> binding.TargetMachine:
    _prepare()
    triple, name, features = processor()
    target = binding.Target.from_triple(triple)
    # On x86, LLVM's loader knows static relocations best; elsewhere it has a choice of its own.
    relocation = "static" if target.name.startswith("x86") else "default"
    return target.create_target_machine(
        cpu=name, features=features, opt=1, reloc=relocation, codemodel="jitdefault", jit=True
    )


def object_code(text: str) -> bytes:
    """Object code for a module in LLVM's language.

    Vectors are written by hand, so that loops are not looked through for more of them.
    """
    module = binding.parse_assembly(text)
    module.triple = processor()[0]
    machine = _machine()
    module.data_layout = str(machine.target_data)
    options = binding.create_pipeline_tuning_options(speed_level=1)
    options.loop_vectorization = False
    options.slp_vectorization = False
    passes = binding.create_pass_builder(machine, options)
    passes.getModulePassManager().run(module, passes)
    return machine.emit_object(module)


class Loaded:
    """Object code in memory."""

    def __init__(self, code: bytes) -> None:
        self._engine: Any = binding.create_mcjit_compiler(binding.parse_assembly(""), _machine())
        self._engine.add_object_file(binding.ObjectFileRef.from_data(code))
        self._engine.finalize_object()

    def address(self, name: str) -> int:
        """Address of a function; 0 if there is none of that name."""
        return self._engine.get_function_address(name)
