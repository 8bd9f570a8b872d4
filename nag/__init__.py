"""Numerical algebraic geometry for mechanisms.

From a graph to the curve of a mechanism's configurations, and from equations to their solutions:

>>> import nag, networkx
>>> G = networkx.MultiGraph()
>>> G.add_edge("base", "left", "A", type="revolute", axis=(0, 0, 1), point=(0, 0, 0))
'A'
>>> G.add_edge("left", "top", "B", type="revolute", axis=(0, 0, 1), point=(0, 1, 0))
'B'
>>> G.add_edge("top", "right", "C", type="revolute", axis=(0, 0, 1), point=(2, 1, 0))
'C'
>>> G.add_edge("right", "base", "D", type="revolute", axis=(0, 0, 1), point=(2, 0, 0))
'D'
>>> answer = nag.decompose(nag.Mechanism.from_graph(G, ground="base"))
>>> [(c.dimension, c.degree) for c in answer.components]
[(1, 2), (1, 2)]
>>> curve = answer.components[0]
>>> curve.contains(curve.sample(0, 1)[0])
True
>>> len(nag.solve(["x^2 + y^2 - 1", "x - y"]).real)
2

Each name says more: ``help(nag.decompose)``. `nag.decomposition` has more to do with components.

Where to add something: a type of joint in `nag.mechanism`, a start system in `nag.solving.start`, a
method of decomposition in `nag.decomposition`, a command in `nag.cli`; the docstring of each says
how, and in which order to read its files. "Bottom-up" is first what the others import, "top-down"
first what imports the others; "`x` on `y`" says that x imports y.
"""

from importlib import import_module
from typing import Any

__version__ = "0.1.0"

# Public names by the module that defines them; `__init__.pyi` has their types. They are imported
# on first use, so that `import nag` and `nag --help` load neither numpy nor llvmlite.
_HOME = {
    "Case": "nag.files.cases",
    "CaseError": "nag.files.case_table",
    "ComponentError": "nag.errors",
    "EquationError": "nag.errors",
    "InputError": "nag.errors",
    "Certified": "nag.questions",
    "Decomposition": "nag.witness.witness",
    "Body": "nag.mechanism.graph",
    "DHLoop": "nag.mechanism.dh",
    "Framework": "nag.mechanism.framework",
    "Joint": "nag.mechanism.graph",
    "Linkage": "nag.mechanism.linkage",
    "LocalDimension": "nag.numerics.local_dimension",
    "Mechanism": "nag.mechanism.graph",
    "MechanismError": "nag.errors",
    "NagError": "nag.errors",
    "StartError": "nag.errors",
    "TimeLimitError": "nag.errors",
    "MobilityReport": "nag.mechanism.mobility_report",
    "Polynomial": "nag.algebra.polynomial",
    "PolynomialSystem": "nag.algebra.system",
    "SignedPermutation": "nag.algebra.symmetry",
    "RealCurve": "nag.real.curve",
    "RealPieces": "nag.real.real_pieces",
    "Run": "nag.tracking.run",
    "Slice": "nag.witness.witness",
    "FamilySolutions": "nag.solving.family_members",
    "SolveResult": "nag.solving.solutions",
    "Solution": "nag.solving.solutions",
    "Status": "nag.witness.witness",
    "WitnessSet": "nag.witness.witness",
    "Constraints": "nag.witness.constraints",
    "certify": "nag.questions",
    "check_statements": "nag.questions",
    "decompose": "nag.questions",
    "decompose_modes": "nag.questions",
    "eliminate": "nag.questions",
    "framework_of_graph": "nag.mechanism.framework",
    "find_real_curve": "nag.questions",
    "find_real_points": "nag.questions",
    "local_dimension": "nag.numerics.local_dimension",
    "intersect": "nag.questions",
    "local": "nag.questions",
    "member": "nag.questions",
    "gruebler_kutzbach": "nag.questions",
    "mobility": "nag.mechanism.mobility_at",
    "model": "nag.questions",
    "modes": "nag.mechanism.operation_modes",
    "driven_motion": "nag.kinematics.driven_motion",
    "motion": "nag.kinematics.motion",
    "plot": "nag.questions",
    "Problem": "nag.mechanism.problem",
    "problem": "nag.questions",
    "read": "nag.questions",
    "read_case": "nag.files.cases",
    "read_decomposition": "nag.files.export",
    "read_solutions": "nag.files.solutions_export",
    "sample": "nag.questions",
    "singular": "nag.questions",
    "solve": "nag.questions",
    "solve_family": "nag.questions",
    "sweep_parameter": "nag.questions",
    "system": "nag.algebra.from_python",
    "write": "nag.questions",
    "write_report": "nag.questions",
    "write_decomposition": "nag.files.export",
    "write_solutions": "nag.files.solutions_export",
}

# Those whose first argument may be the name of a file as well; the modules that define them know
# nothing of files.
_TAKING_FILES = {
    "driven_motion",
    "mobility",
    "modes",
    "motion",
}

__all__ = [*sorted(_HOME), "__version__"]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'nag' has no attribute {name!r}")
    value = getattr(import_module(_HOME[name]), name)
    if name in _TAKING_FILES:
        value = import_module("nag.questions").takes_mechanisms(value)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    hidden = {"Any", "import_module", "annotations", "TYPE_CHECKING"}
    return sorted({*globals(), *_HOME} - hidden)
