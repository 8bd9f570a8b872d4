"""Numerical algebraic geometry for mechanisms."""

from importlib import import_module
from typing import Any

__version__ = "0.1.0"

# Public names by the module that defines them. They are imported on first use, so that
# `import nag` and `nag --help` load neither numpy nor llvmlite.
_HOME = {
    "Case": "nag.files.cases",
    "CaseError": "nag.files.cases",
    "Decomposition": "nag.witness.witness",
    "LocalDimension": "nag.numerics.local_dimension",
    "Mechanism": "nag.mechanism.graph",
    "MobilityReport": "nag.mechanism.mobility_report",
    "Polynomial": "nag.algebra.polynomial",
    "PolynomialSystem": "nag.algebra.system",
    "Slice": "nag.witness.witness",
    "SolveResult": "nag.solving.solutions",
    "Solution": "nag.solving.solutions",
    "Status": "nag.witness.witness",
    "WitnessSet": "nag.witness.witness",
    "decompose": "nag.decomposition",
    "local_dimension": "nag.numerics.local_dimension",
    "gruebler_kutzbach": "nag.mechanism.mobility",
    "mobility": "nag.mechanism.mobility_report",
    "model": "nag.mechanism.model",
    "read_case": "nag.files.cases",
    "read_decomposition": "nag.files.export",
    "read_solutions": "nag.files.solutions_export",
    "solve": "nag.solving.solve",
    "write_decomposition": "nag.files.export",
    "write_solutions": "nag.files.solutions_export",
}

__all__ = [*sorted(_HOME), "__version__"]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'nag' has no attribute {name!r}")
    value = getattr(import_module(_HOME[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOME})
