"""What commands are asked: bad input, the options that they share, reading a case."""

from __future__ import annotations

import argparse
import contextlib
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NoReturn

from nag.errors import NagError, unreadable
from nag.mechanism import FORMULATIONS, PLATFORM_ALONE

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.mechanism.problem import Problem

CASE_GROUP = "how the case is read"
SETTINGS = ("fast", "default", "careful")
MOST_THREADS, MOST_SECONDS = 256, 1_000_000
LARGEST_SEED = 2**63 - 1


class UsageError(NagError):
    """Bad input; the message is one line for the user."""


def error_in_file(file: str, error: Exception) -> UsageError:
    """The error of what a file says, which the same argument mends."""
    return UsageError(f"{file}: {error}").mended_by(getattr(error, "keyword", ""))


class Parser(argparse.ArgumentParser):
    """A parser whose errors are bad input like any other."""

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message} (see {self.prog} --help)")


NEGATIVE_NUMBER = re.compile(r"-(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")


class CommandParser(Parser):
    """A parser whose options may stand before, between and behind what has no dashes."""

    _is_apart = False

    def __init__(self, *given: Any, **named: Any) -> None:
        super().__init__(*given, **named)
        # So that -1e-3 is a value as -0.001 is, and no option.
        self._negative_number_matcher = NEGATIVE_NUMBER

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """As of `argparse.ArgumentParser`: options first, then all else together.

        What a command's name stands before is that command's.
        """
        if self._is_apart or self._subparsers is not None:
            return super().parse_known_args(args, namespace)
        self._is_apart = True
        try:
            return self.parse_known_intermixed_args(args, namespace)
        finally:
            self._is_apart = False


class CommandHelp(argparse.HelpFormatter):
    """Help whose first line names what must be given; what may be is listed below it."""

    def _format_usage(
        self,
        usage: str | None,
        actions: Iterable[argparse.Action],
        groups: Iterable[Any],
        prefix: str | None,
    ) -> str:
        if usage is not None:
            # What was made of it here before.
            return super()._format_usage(usage.strip(), actions, groups, prefix)
        needed = [action for action in actions if action.required or not action.option_strings]
        text = super()._format_usage(usage, needed, (), prefix)
        return text.replace("%(prog)s", self._prog).replace(
            f" {self._prog}", f" {self._prog} [OPTION ...]", 1
        )


def _of_the_case(parser: argparse.ArgumentParser) -> argparse._ActionsContainer:
    """The options that say how the case is read, behind those of the command's own."""
    for group in parser._action_groups:
        if group.title == CASE_GROUP:
            return group
    return parser.add_argument_group(CASE_GROUP)


def whole(text: str, least: int, most: int) -> int:
    """A whole number on the command line, from ``least`` to ``most``."""
    digits = text.strip()
    if not (digits.isascii() and digits.isdigit() and len(digits) < 30):
        raise argparse.ArgumentTypeError(f"{text[:30]!r} is not a whole number from {least} up")
    value = int(digits)
    if not least <= value <= most:
        raise argparse.ArgumentTypeError(f"{value} is not between {least} and {most}")
    return value


def budget_seconds(text: str) -> float:
    """A number of seconds on the command line, up to so many; a whole one as it was written."""
    try:
        value = float(text) if text.isascii() else -1.0
    except ValueError:
        value = -1.0
    if not 0 <= value <= MOST_SECONDS:
        raise argparse.ArgumentTypeError(
            f"{text[:30]!r} is not a number of seconds from 0 to {MOST_SECONDS}, as 10 or 0.5"
        )
    return int(value) if value.is_integer() else value


def _seed(text: str) -> int:
    return whole(text, 0, LARGEST_SEED)


def _threads(text: str) -> int:
    return whole(text, 1, MOST_THREADS)


def _positive(text: str) -> float:
    try:
        value = float(text) if text.isascii() else 0.0
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text[:30]!r} is not a number above 0")
    return value


def _available_threads() -> int:
    if hasattr(os, "sched_getaffinity"):
        return min(len(os.sched_getaffinity(0)), MOST_THREADS)
    return min(os.cpu_count() or 1, MOST_THREADS)


def _setting(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not (name.strip() and equals and value.strip()):
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is not of the form NAME=VALUE")
    return name.strip(), value.strip()


def add_case(
    parser: argparse.ArgumentParser,
    at: str = "",
    format_option: str = "--format",
    *,
    exports: bool = False,
) -> None:
    """The case file, how it is read as of `add_reading`, and the formulation of its model.

    Args:
        at, format_option: as of `add_reading`.
        exports: whether an export stands for the equations that it answers, as of `read_problem`.
    """
    answered = (
        "; or, for the equations that it answers, an export of `nag decompose` or `nag solve`"
    )
    parser.add_argument(
        "case",
        metavar="CASE",
        help="case file (TOML); or a system in a file of Bertini, PHCpack, Macaulay2, Singular or "
        "HomotopyContinuation.jl, or of one polynomial a line; or a robot in URDF or MJCF"
        + answered
        * exports,
    )
    add_formulation(parser)
    add_reading(parser, at, format_option)


def add_reading(
    parser: argparse.ArgumentParser, at: str = "", format_option: str = "--format"
) -> None:
    """How a file is read, the same for every command that takes one: see `read_given_case`.

    Args:
        at: what ``--at`` gives where the file is no robot, in words; without them nothing.
        format_option: what the file's format is called where ``--format`` is that of another.
    """
    from nag.files.formats import READ

    group = _of_the_case(parser)
    group.add_argument(
        "--set",
        action="append",
        default=[],
        type=_setting,
        metavar="NAME=VALUE",
        help="another value of a parameter of the case, a number or an expression; of a system in "
        "another program's format, a value of an unknown; may be repeated",
    )
    group.add_argument(
        format_option,
        dest="format",
        choices=("auto", *READ),
        default="auto",
        help="format of the file (default: told by its content)",
    )
    group.add_argument(
        "--hold",
        metavar="LINK",
        action="append",
        default=[],
        help="of a robot in URDF or MJCF: this link is fixed to the ground; may be repeated",
    )
    (parser if at else group).add_argument(
        "--at",
        dest="at" if at else "stance",
        metavar="VALUES",
        action=_Joined,
        help=f"{at}{'; ' if at else ''}of a robot in URDF or MJCF where its joints stand, "
        "'J = pi/3, K = 0.2' in radians and lengths, the others at 0; may be repeated",
    )


class _Joined(argparse.Action):
    """An option whose texts are parts of one list with commas."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option: str | None = None,
    ) -> None:
        before = getattr(namespace, self.dest)
        setattr(namespace, self.dest, values if before is None else f"{before}, {values}")


def settle_stance(options: argparse.Namespace) -> None:
    """Where the file is a robot, let ``--at`` say where its joints stand, and no point."""
    if getattr(options, "at", None) is None or "hold" not in options:
        return
    from nag.files.cases import is_robot

    # Of a file that cannot be read the command says so.
    with contextlib.suppress(OSError):
        if is_robot(options.case, options.format):
            options.stance, options.at = options.at, None


def _joint_values(text: str | None) -> dict[str, str] | None:
    """The values of a robot's joints that ``--at`` gives.

    Raises:
        UsageError: if it is no list of names and values.
    """
    if text is None:
        return None
    values: dict[str, str] = {}
    for part in text.split(","):
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals or name in values:
            raise UsageError(f"--at: {part.strip()[:40]!r}: write 'JOINT = value', each joint once")
        values[name] = value
    return values


def refuse_reading(options: argparse.Namespace, refused: Sequence[str] | None = None) -> None:
    """Refuse what is said of how a case is read, where an export is given.

    Args:
        refused: the options that are; all of them by default.

    Raises:
        UsageError: if any is given.
    """
    given = {
        "--formulation": getattr(options, "formulation", None) is not None,
        "--set": bool(options.set),
        "--format": options.format != "auto",
        "--hold": bool(options.hold),
        "--at": getattr(options, "stance", None) is not None,
    }
    for option, is_given in given.items():
        if is_given and (refused is None or option in refused):
            raise UsageError(f"{options.case}: is an export; {option} is for cases")


# Circuits that may be asked for by their number.
MOST_CIRCUITS = 100_000


def parse_circuit(text: str) -> str | int:
    """Which circuits of a motion are meant: ``"reference"``, ``"all"`` or a number."""
    if text in ("reference", "all"):
        return text
    try:
        return whole(text, 1, MOST_CIRCUITS)
    except argparse.ArgumentTypeError:
        raise argparse.ArgumentTypeError(
            f"{text[:30]!r} is none; write reference, all, or a circuit's number"
        ) from None


class StoreOnce(argparse.Action):
    """An option that makes no sense twice."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option: str | None = None,
    ) -> None:
        if getattr(namespace, self.dest) is not None:
            raise argparse.ArgumentError(self, "is given twice; one is looked at at a time")
        setattr(namespace, self.dest, values)


def add_formulation(parser: argparse.ArgumentParser) -> None:
    """The formulation of a mechanism's model."""
    _of_the_case(parser).add_argument(
        "--formulation",
        choices=(*FORMULATIONS, PLATFORM_ALONE),
        help="model of a mechanism (default: the one with the fewest paths): "
        + "; ".join(f"{name} {text}" for name, text in FORMULATIONS.items())
        + f"; {PLATFORM_ALONE} the poses of a robot's platform, which `nag decompose` takes by "
        + "itself where these have very many paths",
    )


def add_start(parser: argparse.ArgumentParser, text: str) -> None:
    """The start system of paths to isolated solutions; ``text`` says which one is meant."""
    from nag.solving.start import ASKED_FOR

    parser.add_argument("--start", choices=(*ASKED_FOR, "parameter"), default="auto", help=text)


def add_running(parser: argparse.ArgumentParser) -> None:
    """The options of every command that tracks paths and exports its answer."""
    add_tracking(parser)
    add_json(parser)


def add_json(parser: argparse.ArgumentParser) -> None:
    """The option of every command that exports its answer."""
    parser.add_argument(
        "--json",
        metavar="FILE",
        help="write the answer to FILE as JSON; - for standard output alone",
    )


def add_tracking(parser: argparse.ArgumentParser) -> None:
    """The options of every command that tracks paths, behind those of its own."""
    group = parser.add_argument_group("how it is worked out")
    group.add_argument(
        "--seed", type=_seed, default=0, help="seed of the random numbers (default: 0)"
    )
    group.add_argument(
        "--threads",
        type=_threads,
        default=_available_threads(),
        help="threads; the answer is the same for any number (default: one a processor)",
    )
    group.add_argument(
        "--settings",
        choices=SETTINGS,
        default="default",
        help="how carefully paths are tracked (default: default)",
    )
    add_sharing(group)
    add_quiet(group)


def add_sharing(parser: argparse._ActionsContainer) -> None:
    """The options of the commands whose work falls into blocks."""
    parser.add_argument(
        "--resume",
        metavar="DIR",
        help="keep finished work in the folder DIR, and find there what an earlier run has done",
    )
    parser.add_argument(
        "--executor",
        metavar="NAME",
        help="where the work is done: processes:N, dask://ADDRESS or mpi (default: threads here)",
    )


def add_quiet(parser: argparse._ActionsContainer) -> None:
    """The options of the commands that may take long: what is told, and when they are to end."""
    parser.add_argument("--quiet", action="store_true", help="no progress on standard error")
    parser.add_argument(
        "--time-limit",
        type=_positive,
        metavar="SECONDS",
        help="end after so many seconds, incomplete",
    )
    parser.add_argument(
        "--memory-limit",
        type=_positive,
        metavar="GB",
        help="end when so many gigabytes are in use, incomplete",
    )


def add_certify(parser: argparse.ArgumentParser) -> None:
    """The option of the commands that find points."""
    parser.add_argument(
        "--certify",
        action="store_true",
        help="prove a zero in a box about each point found, as `nag certify` does of an export; "
        "the answer is complete only if all are proved",
    )
    parser.add_argument(
        "--certify-paths",
        action="store_true",
        help="the same, and prove that no path jumped, as `nag certify --paths` does",
    )


def read_case_file(
    path: str,
    values: Sequence[tuple[str, str]] = (),
    format: str = "auto",
    hold: Sequence[str] = (),
    at: Mapping[str, str] | None = None,
) -> Case:
    """The case in a file of some format, ``values`` given to its parameters."""
    from nag.files.cases import read_case

    try:
        return read_case(path, dict(values), format=format, hold=hold, at=at)
    except OSError as error:
        raise UsageError(unreadable(path, error)) from None


def read_given_case(options: argparse.Namespace, *, exports: bool = False) -> Case:
    """The case that the options of `add_reading` give.

    Args:
        exports: whether an export stands for the equations that it answers.
    """
    if exports and is_json(options.case):
        from nag.files.export_case import case_of_export

        refuse_reading(options, ("--set", "--format", "--hold", "--at"))
        return case_of_export(options.case)
    return read_case_file(
        options.case,
        options.set,
        options.format,
        options.hold,
        _joint_values(getattr(options, "stance", None)),
    )


def is_json(path: str) -> bool:
    """Whether a file is JSON, by its first character; case files cannot begin like that."""
    return _head_of(path)[:1] == b"{"


def has_components(path: str) -> bool:
    """Whether a file is an export, and none of solutions, by how it begins."""
    from nag.files.case_table import format_of_export

    head = _head_of(path)
    return head[:1] == b"{" and format_of_export(head) != "nag-solutions"


def _head_of(path: str) -> bytes:
    """How a file begins; empty if it cannot be read."""
    try:
        with open(path, "rb") as file:
            return file.read(256).lstrip()
    except (OSError, ValueError):
        return b""


def read_problem(arguments: argparse.Namespace, *, exports: bool = True) -> tuple[Case, Problem]:
    """The case, and the problem that it describes in the formulation that is asked for.

    Args:
        exports: whether an export stands for the equations that it answers.
    """
    case = read_given_case(arguments, exports=exports)
    tell = getattr(arguments, "progress", None)
    if tell is not None:
        tell("choosing the model", 0, 0)
    return case, problem_of_case(case, arguments.formulation or "auto")


# What to do with an arm.
CLOSE_A_LOOP = (
    'hold its hand to close one: `--hold LINK` of a robot\'s file, a joint of type "rigid" from '
    "the hand to the ground of a case"
)


def problem_of_case(case: Case, formulation: str = "auto", no_loop: str = "") -> Problem:
    """The problem that a case describes.

    Args:
        no_loop: what to do where a mechanism has no loop, if there is more than to close one.

    Raises:
        UsageError: if it has no such formulation, or nothing to decompose.
    """
    from nag.errors import MechanismError
    from nag.mechanism.parts import FormulationError
    from nag.mechanism.path_estimates import NoLoopError
    from nag.mechanism.problem import problem_of

    try:
        return problem_of(case, formulation=formulation)
    except FormulationError:
        raise only_assembled(case, "--formulation") from None
    except NoLoopError as error:
        raise UsageError(f"{case.path}: {error}; {no_loop or CLOSE_A_LOOP}") from None
    except MechanismError as error:
        raise UsageError(f"{case.path}: {error}") from None


def only_assembled(case: Case, option: str) -> UsageError:
    """The error that an option is for mechanisms in a reference configuration."""
    what = "is a polynomial system"
    if case.kind != "system":
        what = f'is of kind "{case.kind}", whose parts are not assembled'
    return UsageError(f"{case.path}: {what}; {option} is for assembled mechanisms")
