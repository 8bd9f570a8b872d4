"""Types of the public names, for programs that check types and for editors.

What functions take is wider than one class: each alias says what may stand for the same thing.
"""

import os
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from decimal import Decimal
from fractions import Fraction
from typing import Any, Literal, Protocol, TypeAlias, TypedDict, Unpack, overload

import networkx
import numpy as np

from nag.algebra.number import Irrational
from nag.algebra.polynomial import Polynomial as Polynomial
from nag.algebra.surd import Surd
from nag.algebra.symmetry import SignedPermutation as SignedPermutation
from nag.algebra.system import PolynomialSystem as PolynomialSystem
from nag.check.statement import CheckedStatements
from nag.decomposition.singular_members import SingularParameters
from nag.decomposition.singular_points import SingularLocus
from nag.decomposition.sweep import Sweep
from nag.errors import ComponentError as ComponentError
from nag.errors import EquationError as EquationError
from nag.errors import InputError as InputError
from nag.errors import MechanismError as MechanismError
from nag.errors import NagError as NagError
from nag.errors import StartError as StartError
from nag.errors import TimeLimitError as TimeLimitError
from nag.files.case_table import CaseError as CaseError
from nag.files.cases import Case as Case
from nag.files.export import Origin
from nag.files.solutions_export import SolutionsExport
from nag.interpolation.image_ideal import ImageIdeal
from nag.kinematics.driven_motion import DrivenMotion
from nag.kinematics.motion import Motion
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.dh import DHLoop as DHLoop
from nag.mechanism.framework import Framework as Framework
from nag.mechanism.graph import Body as Body
from nag.mechanism.graph import Joint as Joint
from nag.mechanism.graph import Mechanism as Mechanism
from nag.mechanism.linkage import Linkage as Linkage
from nag.mechanism.mobility_report import MobilityReport as MobilityReport
from nag.mechanism.mode_decomposition import ModesAnswer
from nag.mechanism.model import Model
from nag.mechanism.modes_report import OperationModes
from nag.mechanism.problem import Problem as Problem
from nag.numerics.local_dimension import LocalDimension as LocalDimension
from nag.page.mechanism_report import MechanismReport
from nag.pictures.plot import Picture
from nag.questions import Certified as Certified
from nag.real.curve import RealCurve as RealCurve
from nag.real.real_pieces import RealPieces as RealPieces
from nag.solving.family_members import FamilySolutions as FamilySolutions
from nag.solving.solutions import Solution as Solution
from nag.solving.solutions import SolveResult as SolveResult
from nag.tracking.run import Found, Progress
from nag.tracking.run import Run as Run
from nag.tracking.settings import Settings
from nag.witness.constraints import Constraints as Constraints
from nag.witness.membership import PointMembership
from nag.witness.sampling import Samples
from nag.witness.witness import Decomposition as Decomposition
from nag.witness.witness import Slice as Slice
from nag.witness.witness import Status as Status
from nag.witness.witness import WitnessSet as WitnessSet

__version__: str
__all__: list[str]

class SympyExpression(Protocol):
    """What sympy has: expressions, equations and symbols."""

    @property
    def free_symbols(self) -> Any: ...
    def subs(self, *arguments: Any, **named: Any) -> Any: ...

class Table(Protocol):
    """What pandas and others have: columns by their names."""

    def keys(self) -> Any: ...
    def __getitem__(self, name: Any, /) -> Any: ...

class RunOptions(TypedDict, total=False):
    """A `Run`, or its fields one by one."""

    run: Run
    seed: int
    threads: int
    settings: Settings | Literal["fast", "default", "careful"]
    progress: Progress | bool | None
    found: Found | None
    resume: File | None
    executor: Executor | str | None
    time_limit: float | None

class FileOptions(TypedDict, total=False):
    """How a file is read, as for `read`."""

    set: Mapping[str, AnyNumber] | Table | None
    format: Literal[
        "auto", "toml", "bertini", "phc", "m2", "singular", "hc", "text", "urdf", "mjcf"
    ]
    hold: Sequence[str]
    at: Mapping[str, RealNumber] | Table | None

class EquationOptions(TypedDict, total=False):
    """How equations are read, as for `problem`."""

    variables: Names | None
    imaginary: str | None

class Options(RunOptions, FileOptions, total=False):
    """Both."""

class QuestionOptions(Options, EquationOptions, total=False):
    """All three."""

File: TypeAlias = str | os.PathLike[str]
# Exact: text as "5/6" or "sqrt(2)", floats as their shortest decimals.
RealNumber: TypeAlias = str | float | Fraction | Decimal | Surd | Irrational | SympyExpression
AnyNumber: TypeAlias = RealNumber | complex
Equation: TypeAlias = str | Polynomial | SympyExpression
Equations: TypeAlias = Equation | Iterable[Equation]
# Texts of names with commas or blanks between, names, or sympy's symbols.
Names: TypeAlias = str | Iterable[str | SympyExpression]
Parts: TypeAlias = Framework | Linkage | DHLoop | AssemblyModel
# A mechanism, or what describes one.
Moving: TypeAlias = File | Case | Mechanism | Model | Parts | Problem
# What has equations, an answer to them too, or what has components.
Solvable: TypeAlias = Moving | PolynomialSystem | Equations | Decomposition | SolveResult
# What is written as JSON; the first are read back.
Exported: TypeAlias = (
    Decomposition
    | SolveResult
    | Samples
    | SingularLocus
    | SingularParameters
    | MobilityReport
    | LocalDimension
    | PointMembership
    | FamilySolutions
    | Sweep
    | OperationModes
    | ModesAnswer
    | ImageIdeal
    | Motion
    | DrivenMotion
    | CheckedStatements
    | Certified
    | RealCurve
)
# What is written to a file.
Writable: TypeAlias = (
    Exported | Case | Mechanism | Model | Parts | Problem | PolynomialSystem | Equations | File
)
# Of the members of a family, by rows, of one parameter by numbers, or by columns with names.
Values: TypeAlias = (
    Sequence[Sequence[complex]]
    | Sequence[complex]
    | np.ndarray
    | Mapping[str, Sequence[complex] | np.ndarray]
    | Table
    | File
)
Decomposed: TypeAlias = Solvable | WitnessSet
# The name of a point, or its coordinates by name or in order.
Point: TypeAlias = (
    str | Mapping[str, complex | RealNumber] | Sequence[complex | RealNumber] | np.ndarray
)
Formulation: TypeAlias = Literal["auto", "E", "H", "S", "P"]
# How paths begin: a start system, or the loops of a family.
Start: TypeAlias = Literal[
    "auto", "total", "multihomogeneous", "polyhedral", "monodromy", "parameter"
]
Circuits: TypeAlias = Literal["reference", "all"] | int
Drives: TypeAlias = tuple[str, RealNumber] | Mapping[str, RealNumber] | Table
Placements: TypeAlias = Mapping[str, Sequence[RealNumber] | np.ndarray] | Table

def certify(
    given: Decomposed,
    paths: bool = False,
    *,
    formulation: Formulation = "auto",
    **options: Unpack[QuestionOptions],
) -> Certified: ...
def decompose(
    system: Solvable,
    variables: Names | None = None,
    *,
    imaginary: str | None = None,
    formulation: Formulation = "auto",
    method: Literal["complete", "sampling"] = "complete",
    starts: int | None = None,
    coordinates: Literal["joint", "euler"] | None = None,
    expand: bool = False,
    symmetries: Iterable[SignedPermutation | Mapping[str, str] | Sequence[int]] | None = None,
    **options: Unpack[Options],
) -> Decomposition: ...
def driven_motion(
    mechanism: Moving,
    coordinate: str,
    values: Sequence[RealNumber] | np.ndarray,
    *,
    samples: int = 360,
    formulation: Formulation = "auto",
    drive: Drives | None = None,
    pose: Placements | None = None,
    **options: Unpack[Options],
) -> DrivenMotion: ...
def eliminate(
    given: Decomposed,
    onto: Names | None = None,
    component: int | None = None,
    *,
    point: Point | None = None,
    degree: int | None = None,
    polynomial: bool = False,
    formulation: Formulation = "auto",
    **options: Unpack[QuestionOptions],
) -> ImageIdeal: ...
def find_real_curve(
    given: Decomposed,
    component: int | None = None,
    *,
    formulation: Formulation = "auto",
    **options: Unpack[QuestionOptions],
) -> RealCurve: ...
def find_real_points(
    given: Decomposed,
    component: int | None = None,
    *,
    formulation: Formulation = "auto",
    **options: Unpack[QuestionOptions],
) -> RealPieces: ...
def framework_of_graph(graph: networkx.Graph, dimension: int = 2) -> Framework: ...
def gruebler_kutzbach(mechanism: Moving, **options: Unpack[FileOptions]) -> int: ...
def intersect(
    given: Decomposed,
    first: int,
    second: int,
    *,
    formulation: Formulation = "auto",
    **options: Unpack[QuestionOptions],
) -> Decomposition: ...
def local(
    given: Solvable,
    point: Point | None = None,
    *,
    formulation: Formulation = "auto",
    **options: Unpack[QuestionOptions],
) -> LocalDimension: ...
def local_dimension(
    system: PolynomialSystem,
    point: Sequence[AnyNumber] | np.ndarray,
    *,
    accuracy: float | None = None,
    seed: int = 0,
) -> LocalDimension: ...
def member(
    given: Decomposed,
    point: Point | None = None,
    *,
    formulation: Formulation = "auto",
    **options: Unpack[QuestionOptions],
) -> PointMembership: ...
def mobility(
    mechanism: Moving,
    point: Sequence[RealNumber] | Mapping[str, RealNumber] | np.ndarray | None = None,
    *,
    formulation: Formulation = "auto",
    detail: Literal["local", "through", "components", "curves"] = "through",
    budget: float = 10,
    of: str | None = None,
    tolerance: float | None = None,
    **options: Unpack[Options],
) -> MobilityReport: ...
@overload
def model(
    mechanism: Mechanism | Model,
    formulation: Formulation = "auto",
    modes: Iterable[tuple[str, int]] = (),
    space: Literal["planar", "spherical", "spatial"] | None = None,
    **options: Unpack[FileOptions],
) -> Model: ...
@overload
def model(
    mechanism: Parts, formulation: Formulation = "auto", **options: Unpack[FileOptions]
) -> AssemblyModel: ...
@overload
def model(
    mechanism: PolynomialSystem,
    formulation: Formulation = "auto",
    **options: Unpack[FileOptions],
) -> Problem: ...
@overload
def model(
    mechanism: File | Case | Problem | Equations,
    formulation: Formulation = "auto",
    modes: Iterable[tuple[str, int]] = (),
    space: Literal["planar", "spherical", "spatial"] | None = None,
    *,
    variables: Names | None = None,
    imaginary: str | None = None,
    **options: Unpack[FileOptions],
) -> Model | AssemblyModel | Problem: ...
def modes(
    mechanism: File | Case | Mechanism | Model | Problem,
    platform: str | None = None,
    *,
    budget: float = 60,
    **options: Unpack[Options],
) -> OperationModes: ...
def motion(
    mechanism: Moving,
    *,
    circuit: Circuits = "reference",
    samples: int = 360,
    formulation: Formulation = "auto",
    drive: Drives | None = None,
    pose: Placements | None = None,
    **options: Unpack[Options],
) -> Motion: ...
def plot(
    given: Decomposed,
    path: File,
    *,
    onto: Names | None = None,
    joints: Sequence[str] | str | None = None,
    point: str | None = None,
    graph: bool = False,
    mechanism: bool = False,
    tree: bool = False,
    component: int | None = None,
    circuit: Circuits = "reference",
    formulation: Formulation = "auto",
    **options: Unpack[QuestionOptions],
) -> Picture: ...
def problem(
    given: Solvable,
    variables: Names | None = None,
    *,
    imaginary: str | None = None,
    formulation: Formulation = "auto",
    **options: Unpack[FileOptions],
) -> Problem: ...
def read(
    path: File,
    *,
    set: Mapping[str, AnyNumber] | Table | None = None,
    format: str = "auto",
    hold: Sequence[str] = (),
    at: Mapping[str, RealNumber] | Table | None = None,
) -> (
    Case
    | Decomposition
    | SolveResult
    | Samples
    | SingularLocus
    | SingularParameters
    | dict[str, Any]
): ...
def read_case(
    path: File,
    set: Mapping[str, AnyNumber] | Table | None = None,
    *,
    format: str = "auto",
    hold: Sequence[str] = (),
    at: Mapping[str, RealNumber] | Table | None = None,
) -> Case: ...
def read_decomposition(path: File) -> Decomposition: ...
def read_solutions(path: File) -> SolutionsExport: ...
def sample(
    given: Decomposed,
    component: int = 1,
    *,
    count: int = 10,
    real: bool = False,
    formulation: Formulation = "auto",
    **options: Unpack[QuestionOptions],
) -> Samples: ...
@overload
def singular(
    given: Decomposed,
    component: int | None = None,
    *,
    free: None = None,
    formulation: Formulation = "auto",
    **options: Unpack[QuestionOptions],
) -> SingularLocus: ...
@overload
def singular(
    given: File | Case | Problem | Equations, *, free: Names, **options: Unpack[QuestionOptions]
) -> SingularParameters: ...
@overload
def singular(
    given: Decomposed,
    component: int | None = None,
    *,
    free: Names | None = None,
    formulation: Formulation = "auto",
    **options: Unpack[QuestionOptions],
) -> SingularLocus | SingularParameters: ...
def solve(
    system: Solvable,
    variables: Names | None = None,
    *,
    imaginary: str | None = None,
    formulation: Formulation = "auto",
    start: Start = "auto",
    **options: Unpack[Options],
) -> SolveResult: ...
def solve_family(
    equations: Solvable,
    parameters: Names | None = None,
    values: Values | None = None,
    variables: Names | None = None,
    *,
    imaginary: str | None = None,
    formulation: Formulation = "auto",
    start: Start = "auto",
    count: int | None = None,
    known: tuple[Sequence[complex] | np.ndarray, np.ndarray] | None = None,
    **options: Unpack[Options],
) -> FamilySolutions: ...
def system(
    equations: PolynomialSystem | Equations,
    variables: Names | None = None,
    *,
    parameters: Mapping[str, AnyNumber] | Mapping[SympyExpression, AnyNumber] | None = None,
    nonzero: Equations = (),
    groups: Iterable[Iterable[str | int | SympyExpression]] = (),
    imaginary: str | None = None,
) -> PolynomialSystem: ...
def check_statements(
    given: Moving | PolynomialSystem | None = None, **options: Unpack[QuestionOptions]
) -> CheckedStatements: ...
def sweep_parameter(
    given: File | Case,
    parameter: str,
    values: Sequence[RealNumber],
    *,
    formulation: Formulation = "auto",
    **options: Unpack[Options],
) -> Sweep: ...
def decompose_modes(
    mechanism: File | Case | Mechanism,
    *,
    formulation: Formulation = "auto",
    coordinates: Literal["joint", "euler"] | None = None,
    **options: Unpack[Options],
) -> ModesAnswer: ...
def write_report(
    given: Moving,
    path: File,
    *,
    formulation: Formulation = "auto",
    **options: Unpack[Options],
) -> MechanismReport: ...
def write(
    result: Writable,
    path: File,
    *,
    format: str = "auto",
    title: str = "",
) -> None: ...
def write_decomposition(
    decomposition: Decomposition, path: File, origin: Origin | None = None
) -> None: ...
def write_solutions(
    result: SolveResult, path: File, title: str | None = None, file: str | None = None
) -> None: ...
