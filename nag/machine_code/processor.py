"""Computers as LLVM knows them: object code for one, and object code made ready to run here."""

from __future__ import annotations

from functools import cache
from itertools import count
from typing import Any, NamedTuple

import llvmlite
from llvmlite import binding

# The function that is called from Python, see `nag.machine_code.functions`.
ENTRY = "nag_kernel"


class Processor(NamedTuple):
    """Kind of system (LLVM's target triple), name of the processor, and its features."""

    triple: str
    name: str
    features: str


@cache
def processor() -> Processor:
    """This computer; object code is for one of each."""
    try:
        features = binding.get_host_cpu_features().flatten()
    except RuntimeError:
        features = ""
    return Processor(binding.get_process_triple(), binding.get_host_cpu_name(), features)


def compiler() -> str:
    """Versions of what turns functions into object code."""
    return f"llvmlite {llvmlite.__version__}, LLVM {binding.llvm_version_info}"


@cache
def _prepare() -> None:
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()


def _machine(processor: Processor) -> binding.TargetMachine:
    _prepare()
    target = binding.Target.from_triple(processor.triple)
    # On x86, LLVM's loader knows static relocations best; elsewhere it has a choice of its own.
    relocation = "static" if target.name.startswith("x86") else "default"
    return target.create_target_machine(
        cpu=processor.name,
        features=processor.features,
        opt=1,
        reloc=relocation,
        codemodel="jitdefault",
        jit=True,
    )


def object_code(text: str, target: Processor | None = None) -> bytes:
    """Object code for a module in LLVM's language.

    Vectors are written by hand, so that loops are not looked through for more of them. Nor are they
    unrolled: most are run a few times only, which then takes a tenth longer, and compiling twice as
    long.

    Args:
        target: by default this computer; of another kind of processor only after
            `llvmlite.binding.initialize_all_targets` and ``initialize_all_asmprinters``.
    """
    target = Processor(*(target or processor()))
    module = binding.parse_assembly(text)
    module.triple = target.triple
    machine = _machine(target)
    module.data_layout = str(machine.target_data)
    options = binding.create_pipeline_tuning_options(speed_level=1)
    options.loop_vectorization = False
    options.slp_vectorization = False
    options.loop_unrolling = False
    passes = binding.create_pass_builder(machine, options)
    passes.getModulePassManager().run(module, passes)
    return machine.emit_object(module)


@cache
def _loader() -> Any:
    """LLVM's loader of object code (ORC); one serves all kernels."""
    return binding.create_lljit_compiler(_machine(Processor(*processor())))


_numbers = count()


class Loaded:
    """Object code in memory, for as long as this lives, and the ``address`` of its `ENTRY`.

    Raises:
        RuntimeError: if there is none, or a function that it needs is nowhere in this process.
    """

    def __init__(self, code: bytes) -> None:
        builder = binding.JITLibraryBuilder().add_object_img(code).add_current_process()
        builder.export_symbol(ENTRY)
        self._library: Any = builder.link(_loader(), f"kernel {next(_numbers)}")
        self.address: int = self._library[ENTRY]
