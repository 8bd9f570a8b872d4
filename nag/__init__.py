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
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    # What `__getattr__` finds, for programs that check types.
    from nag.algebra.from_python import system as system
    from nag.algebra.polynomial import Polynomial as Polynomial
    from nag.algebra.symmetry import SignedPermutation as SignedPermutation
    from nag.algebra.system import PolynomialSystem as PolynomialSystem
    from nag.errors import ComponentError as ComponentError
    from nag.errors import EquationError as EquationError
    from nag.errors import InputError as InputError
    from nag.errors import MechanismError as MechanismError
    from nag.errors import NagError as NagError
    from nag.errors import StartError as StartError
    from nag.files.case_table import CaseError as CaseError
    from nag.files.cases import Case as Case
    from nag.files.cases import read_case as read_case
    from nag.files.export import read_decomposition as read_decomposition
    from nag.files.export import write_decomposition as write_decomposition
    from nag.files.solutions_export import read_solutions as read_solutions
    from nag.files.solutions_export import write_solutions as write_solutions
    from nag.kinematics.driven_motion import driven_motion as driven_motion
    from nag.kinematics.motion import motion as motion
    from nag.mechanism.dh import DHLoop as DHLoop
    from nag.mechanism.framework import Framework as Framework
    from nag.mechanism.framework import framework_of_graph as framework_of_graph
    from nag.mechanism.graph import Body as Body
    from nag.mechanism.graph import Joint as Joint
    from nag.mechanism.graph import Mechanism as Mechanism
    from nag.mechanism.linkage import Linkage as Linkage
    from nag.mechanism.loops import gruebler_kutzbach as gruebler_kutzbach
    from nag.mechanism.mobility_at import mobility as mobility
    from nag.mechanism.mobility_report import MobilityReport as MobilityReport
    from nag.mechanism.model import model as model
    from nag.mechanism.operation_modes import modes as modes
    from nag.mechanism.problem import decompose as decompose
    from nag.mechanism.problem import solve as solve
    from nag.numerics.local_dimension import LocalDimension as LocalDimension
    from nag.numerics.local_dimension import local_dimension as local_dimension
    from nag.questions import Certified as Certified
    from nag.questions import certify as certify
    from nag.questions import eliminate as eliminate
    from nag.questions import intersect as intersect
    from nag.questions import local as local
    from nag.questions import member as member
    from nag.questions import plot as plot
    from nag.questions import read as read
    from nag.questions import sample as sample
    from nag.questions import singular as singular
    from nag.questions import write as write
    from nag.real.curve import RealCurve as RealCurve
    from nag.real.find_curve import find_real_curve as find_real_curve
    from nag.real.real_pieces import RealPieces as RealPieces
    from nag.real.real_pieces import find_real_points as find_real_points
    from nag.solving.family_members import FamilySolutions as FamilySolutions
    from nag.solving.family_members import solve_family as solve_family
    from nag.solving.solutions import Solution as Solution
    from nag.solving.solutions import SolveResult as SolveResult
    from nag.tracking.run import Run as Run
    from nag.witness.constraints import Constraints as Constraints
    from nag.witness.witness import Decomposition as Decomposition
    from nag.witness.witness import Slice as Slice
    from nag.witness.witness import Status as Status
    from nag.witness.witness import WitnessSet as WitnessSet

__version__ = "0.1.0"

# Public names by the module that defines them. They are imported on first use, so that
# `import nag` and `nag --help` load neither numpy nor llvmlite.
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
    "decompose": "nag.mechanism.problem",
    "eliminate": "nag.questions",
    "framework_of_graph": "nag.mechanism.framework",
    "find_real_curve": "nag.real.find_curve",
    "find_real_points": "nag.real.real_pieces",
    "local_dimension": "nag.numerics.local_dimension",
    "intersect": "nag.questions",
    "local": "nag.questions",
    "member": "nag.questions",
    "gruebler_kutzbach": "nag.mechanism.loops",
    "mobility": "nag.mechanism.mobility_at",
    "model": "nag.mechanism.model",
    "modes": "nag.mechanism.operation_modes",
    "driven_motion": "nag.kinematics.driven_motion",
    "motion": "nag.kinematics.motion",
    "plot": "nag.questions",
    "read": "nag.questions",
    "read_case": "nag.files.cases",
    "read_decomposition": "nag.files.export",
    "read_solutions": "nag.files.solutions_export",
    "sample": "nag.questions",
    "singular": "nag.questions",
    "solve": "nag.mechanism.problem",
    "solve_family": "nag.solving.family_members",
    "system": "nag.algebra.from_python",
    "write": "nag.questions",
    "write_decomposition": "nag.files.export",
    "write_solutions": "nag.files.solutions_export",
}

# Those whose first argument may be the name of a file as well; the modules that define them know
# nothing of files.
_TAKING_FILES = {
    "decompose",
    "driven_motion",
    "mobility",
    "model",
    "modes",
    "motion",
    "solve",
}

__all__ = [*sorted(_HOME), "__version__"]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'nag' has no attribute {name!r}")
    value = getattr(import_module(_HOME[name]), name)
    if name in _TAKING_FILES:
        value = import_module("nag.questions").taking_files(value)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOME})
