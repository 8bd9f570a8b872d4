"""The command ``nag``.

Exit status: 0 for a complete answer, 1 for an incomplete one, 2 for bad input (one line on
standard error), 130 after Ctrl-C. Modules that load numpy or llvmlite are imported by the commands
that need them, so that ``nag --help`` answers at once.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, NoReturn

import nag

if TYPE_CHECKING:
    from nag.cases import Case
    from nag.mechanism.model import Model

COMPLETE, INCOMPLETE, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130

SETTINGS = ("fast", "default", "careful")
MOST_THREADS = 256
LARGEST_SEED = 2**63 - 1
MOST_STARTS = 10**6


class UsageError(ValueError):
    """Bad input; the message is one line for the user."""


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message} (see {self.prog} --help)")


def _whole(text: str, least: int, most: int) -> int:
    digits = text.strip()
    if not (digits.isascii() and digits.isdigit() and len(digits) < 30):
        raise argparse.ArgumentTypeError(f"{text[:30]!r} is not a whole number from {least} up")
    value = int(digits)
    if not least <= value <= most:
        raise argparse.ArgumentTypeError(f"{value} is not between {least} and {most}")
    return value


def _seed(text: str) -> int:
    return _whole(text, 0, LARGEST_SEED)


def _threads(text: str) -> int:
    return _whole(text, 1, MOST_THREADS)


def _starts(text: str) -> int:
    return _whole(text, 1, MOST_STARTS)


def _available_threads() -> int:
    if hasattr(os, "sched_getaffinity"):
        return min(len(os.sched_getaffinity(0)), MOST_THREADS)
    return min(os.cpu_count() or 1, MOST_THREADS)


def parser() -> argparse.ArgumentParser:
    """The command line's grammar."""
    root = _Parser(
        prog="nag",
        description="Numerical algebraic geometry for mechanisms.",
        epilog="Exit status: 0 complete answer, 1 incomplete answer, 2 bad input.",
        allow_abbrev=False,
    )
    root.add_argument("--version", action="version", version=f"nag {nag.__version__}")
    commands = root.add_subparsers(dest="command", metavar="COMMAND", required=True)

    case = argparse.ArgumentParser(add_help=False)
    case.add_argument("case", metavar="CASE", help="case file (TOML)")
    case.add_argument(
        "--formulation",
        choices=("E", "H"),
        help="model of a mechanism: E Euler parameters, H half angles (default: the smaller one)",
    )

    running = argparse.ArgumentParser(add_help=False)
    running.add_argument(
        "--seed", type=_seed, default=0, help="seed of the random numbers (default: 0)"
    )
    running.add_argument(
        "--threads",
        type=_threads,
        default=_available_threads(),
        help="threads; the answer is the same for any number (default: one a processor)",
    )
    running.add_argument("--json", metavar="FILE", help="write the answer to FILE as JSON")
    running.add_argument(
        "--settings",
        choices=SETTINGS,
        default="default",
        help="how carefully paths are tracked (default: default)",
    )
    running.add_argument("--quiet", action="store_true", help="no progress on standard error")

    decompose = commands.add_parser(
        "decompose",
        parents=[case, running],
        allow_abbrev=False,
        help="find the irreducible components of a case",
        description="Find the irreducible components of a mechanism's configuration space, or of "
        "the zero set of a polynomial system, and the mobility.",
    )
    decompose.add_argument(
        "--expand",
        action="store_true",
        help="list every component, not one of each orbit of the system's symmetries",
    )
    decompose.add_argument(
        "--method",
        choices=("complete", "sampling"),
        default="complete",
        help="find all components, or those that Newton's method reaches from random points, for "
        "systems that are too large; that is never complete (default: complete)",
    )
    decompose.add_argument(
        "--starts",
        type=_starts,
        metavar="N",
        help="with --method sampling: number of random points (default: 100)",
    )
    decompose.set_defaults(run=_decompose)

    from nag.report import (
        bench_command,
        intersect_command,
        member_command,
        sample_command,
        solve_command,
    )

    for module, name, text in (
        (member_command, "member", "say which components a point lies on"),
        (sample_command, "sample", "find random points of a component"),
        (intersect_command, "intersect", "find the intersection of two components"),
    ):
        command = commands.add_parser(
            name,
            parents=[running],
            allow_abbrev=False,
            help=text,
            description=f"{text[0].upper()}{text[1:]}. The components are those of an export of "
            "`nag decompose --json`, or of a case, which is decomposed first.",
        )
        module.add_arguments(command)
        command.set_defaults(run=_with_components, module=module)

    solve = commands.add_parser(
        "solve",
        parents=[case, running],
        allow_abbrev=False,
        help="find the isolated solutions of a case",
        description="Find all isolated solutions of a polynomial system, with multiplicities, by "
        "tracking paths from a solved system.",
    )
    solve_command.add_arguments(solve)
    solve.set_defaults(run=_solve)

    bench = commands.add_parser(
        "bench",
        allow_abbrev=False,
        help="solve the benchmark systems and measure how fast",
        description="Solve the benchmark systems, check their numbers of solutions and measure "
        "the time, beside other programs if they are installed.",
    )
    bench_command.add_arguments(bench)
    bench.set_defaults(run=_bench)

    model = commands.add_parser(
        "model",
        parents=[case],
        allow_abbrev=False,
        help="print the polynomial system of a case",
        description="Print the polynomial system that `nag decompose` decomposes.",
    )
    model.set_defaults(run=_model)
    return root


def _read(arguments: argparse.Namespace) -> tuple[Case, Model | None]:
    """The case, and its model if it is a mechanism."""
    from nag.cases import CaseError, read_case

    try:
        case = read_case(arguments.case)
    except CaseError as error:
        raise UsageError(str(error)) from None
    except OSError as error:
        raise UsageError(f"{arguments.case}: {error.strerror or error}") from None
    if case.mechanism is None:
        if arguments.formulation is not None:
            raise UsageError(
                f"{arguments.case}: is a polynomial system; --formulation is for mechanisms"
            )
        return case, None

    from nag.mechanism.model import ModelError, model

    try:
        return case, model(case.mechanism, arguments.formulation or "auto")
    except ModelError as error:
        raise UsageError(f"{arguments.case}: {error}") from None


def _check_json(target: str, case: str) -> None:
    """Refuse, before any work is done, a file that the answer could not be written to."""
    from nag.report.target import TargetError, check_target

    try:
        check_target(target)
    except TargetError as error:
        raise UsageError(f"--json: {error}") from None
    if os.path.exists(target) and os.path.exists(case) and os.path.samefile(target, case):
        raise UsageError(f"--json: {target}: is the case file; name another file")


def _decompose(arguments: argparse.Namespace) -> int:
    started = time.perf_counter()
    if arguments.starts is not None and arguments.method != "sampling":
        raise UsageError("--starts: is for --method sampling")
    if arguments.json is not None:
        _check_json(arguments.json, arguments.case)
    case, model = _read(arguments)

    from nag.report.progress import compilation_notice, progress_line

    with (
        compilation_notice(sys.stderr, arguments.quiet),
        progress_line(sys.stderr, arguments.quiet) as progress,
    ):
        from nag.decomposition import decompose
        from nag.decomposition.expansion import expanded
        from nag.report.answer import symmetries_of, system_of, through_points

        if arguments.method == "sampling":
            from nag.decomposition import by_sampling

            decomposition = by_sampling(
                system_of(case, model),
                seed=arguments.seed,
                threads=arguments.threads,
                settings=arguments.settings,
                progress=progress,
                symmetries=symmetries_of(case, model),
                **({} if arguments.starts is None else {"starts": arguments.starts}),
            )
        else:
            decomposition = decompose(
                system_of(case, model),
                seed=arguments.seed,
                threads=arguments.threads,
                settings=arguments.settings,
                progress=progress,
                symmetries=symmetries_of(case, model),
            )
        if arguments.expand:
            decomposition = expanded(decomposition)
        points = through_points(decomposition, case, model, arguments.threads)

    from nag.report.answer import accounted, answer_lines, origin
    from nag.report.export import write_decomposition
    from nag.report.target import TargetError

    decomposition = accounted(decomposition, points)
    failure = None
    if arguments.json is not None:
        try:
            write_decomposition(decomposition, arguments.json, origin(case, model))
        except TargetError as error:
            failure = UsageError(f"--json: {error}")
    seconds = time.perf_counter() - started
    _print(answer_lines(decomposition, case, model, points, seconds))
    if failure is not None:
        raise failure
    return COMPLETE if decomposition.complete else INCOMPLETE


def _with_components(arguments: argparse.Namespace) -> int:
    from nag.report.witness_input import WitnessInputError, is_export

    if arguments.json is not None:
        _check_json(arguments.json, arguments.case)
    source = None if is_export(arguments.case) else _read(arguments)
    try:
        lines, complete = arguments.module.run(arguments, source)
    except WitnessInputError as error:
        raise UsageError(str(error)) from None
    _print(lines)
    return COMPLETE if complete else INCOMPLETE


def _solve(arguments: argparse.Namespace) -> int:
    from nag.report import solve_command

    if arguments.json is not None:
        _check_json(arguments.json, arguments.case)
    case, model = _read(arguments)
    try:
        lines, complete = solve_command.run(arguments, case, model)
    except solve_command.SolveError as error:
        raise UsageError(str(error)) from None
    _print(lines)
    return COMPLETE if complete else INCOMPLETE


def _bench(arguments: argparse.Namespace) -> int:
    from nag.report import bench_command

    if arguments.json is not None:
        _check_json(arguments.json, "")
    try:
        lines, right = bench_command.run(arguments)
    except bench_command.BenchError as error:
        raise UsageError(str(error)) from None
    _print(lines)
    return COMPLETE if right else INCOMPLETE


def _model(arguments: argparse.Namespace) -> int:
    from nag.report.answer import model_lines

    _print(model_lines(*_read(arguments)))
    return COMPLETE


def _print(lines: Sequence[str] = ()) -> None:
    """Write lines to standard output; a reader who has gone away is no error."""
    try:
        sys.stdout.write("".join(f"{line}\n" for line in lines))
        sys.stdout.flush()
    except BrokenPipeError:
        _abandon_output()
    except OSError as error:
        _abandon_output()
        raise UsageError(f"standard output cannot be written: {error.strerror}") from None


def _complain(message: str) -> None:
    from nag.report.table import printable

    with contextlib.suppress(OSError, ValueError):
        sys.stderr.write(f"nag: {printable(message)}\n")
        sys.stderr.flush()


def _abandon_output() -> None:
    """Give standard output nowhere to go, so that the interpreter's last flush cannot fail."""
    with contextlib.suppress(OSError, ValueError):
        sink = os.open(os.devnull, os.O_WRONLY)
        os.dup2(sink, sys.stdout.fileno())
        os.close(sink)


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    # A stream that was closed before the start is None.
    sys.stdout = sys.stdout or open(os.devnull, "w")  # noqa: SIM115
    sys.stderr = sys.stderr or open(os.devnull, "w")  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        # What a terminal's encoding cannot show is escaped; it must not end the run.
        with contextlib.suppress(AttributeError):
            stream.reconfigure(errors="backslashreplace")
    try:
        try:
            arguments = parser().parse_args(argv)
        except SystemExit:  # after --help or --version
            _print()
            return COMPLETE
        return arguments.run(arguments)
    except UsageError as error:
        _complain(str(error))
        return BAD_INPUT
    except KeyboardInterrupt:
        _complain("interrupted")
        return INTERRUPTED
    except MemoryError:
        _complain("not enough memory for this case")
        return INCOMPLETE
