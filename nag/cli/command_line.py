"""The command line's grammar, and how a command ends.

Exit status: 0 for a complete answer, 1 for an incomplete one (also where a limit of time or memory
is reached), 2 for bad input (one line on standard error), 130 after Ctrl-C. A command is imported
when it is asked for, and modules that load numpy or llvmlite by the commands that need them, so
that ``nag --help`` answers at once.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from importlib import import_module

import nag
from nag.cli.arguments import CommandHelp, CommandParser, Parser, UsageError
from nag.cli.running import run_command
from nag.cli.watched import end_with, leave_to_parent, work_in_child, work_in_new_process
from nag.errors import ComponentError, NagError

COMPLETE, INCOMPLETE, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130

FROM_COMPONENTS = (
    "The components are those of an export of `nag decompose --json`, or of a case, which is "
    "decomposed first."
)

# Each command, which is a module of this package: what it does, and more about it.
COMMANDS: tuple[tuple[str, str, str], ...] = (
    (
        "show",
        "say what a file holds and what can be asked of it",
        "Say what a case or an export holds, and which commands answer what of it. `nag FILE` does "
        "the same.",
    ),
    (
        "init",
        "write a commented case to begin with",
        "Write a commented case to be edited: of a linkage by its links, a mechanism by its "
        "joints, a framework by its bars, a loop by a table of Denavit and Hartenberg's (dh), or a "
        "system.",
    ),
    (
        "mobility",
        "say whether and how a mechanism moves at a configuration",
        "Say how a mechanism moves at a configuration: what counting predicts, the tangent and the "
        "local dimension, the components through it, and what that means.",
    ),
    (
        "motion",
        "show how a mechanism of one freedom really moves",
        "Show how a mechanism of one freedom really moves: its circuits, how far each joint turns "
        "and where it turns back; all bodies along each circuit as a table, and a page in which "
        "they move.",
    ),
    (
        "decompose",
        "find all motions of a mechanism, all solution sets of equations",
        "Find the irreducible components of a mechanism's configuration space, or of the zero set "
        "of a polynomial system, and the mobility.",
    ),
    (
        "modes",
        "find the operation modes of a parallel robot",
        "Find the operation modes of a parallel robot, the components of its platform's poses: the "
        "equations of each, what its poses have in common, and where modes meet.",
    ),
    (
        "report",
        "write all that is found of a mechanism to one page",
        "Write one page of a mechanism: how it moves, a picture in which it does, the model and "
        "why that one, all components, what they were compared with, and the answer as data.",
    ),
    (
        "plot",
        "draw real curves, joint angles, and bodies with joints",
        "Draw the real curves of components, projected to two variables; of a mechanism the angles "
        "of two joints against each other, the path of a point, or the graph of its bodies and "
        "joints. The components are those of an export of `nag decompose --json`, or of a case.",
    ),
    (
        "solve",
        "find all isolated solutions of a case",
        "Find all isolated solutions of a polynomial system, with multiplicities, by tracking "
        "paths from a solved system.",
    ),
    (
        "family",
        "solve the same equations for many values of their parameters",
        "Find the isolated solutions of a case's equations for many values of the parameters that "
        "its [family], or the table of the values, names: solved once for random ones, from where "
        "all members are tracked together.",
    ),
    (
        "certify",
        "prove the solutions or components of an export",
        "Prove that there is exactly one zero in a box about each solution of `nag solve --json`, "
        "or witness point of `nag decompose --json`, that they are distinct, and which are real.",
    ),
    (
        "local",
        "say what dimension the solutions have at a point",
        "Say what dimension the solution set has at a point: isolated, of which multiplicity, or "
        "on a component of which dimension, singular or not. Nothing is decomposed for it.",
    ),
    (
        "member",
        "say which components a point lies on",
        f"Say which components a point lies on. {FROM_COMPONENTS}",
    ),
    (
        "sample",
        "find random points of a component",
        f"Find random points of a component. {FROM_COMPONENTS}",
    ),
    (
        "singular",
        "find singular points of components, and where components meet",
        f"Find singular points of components, and where components meet. {FROM_COMPONENTS}",
    ),
    (
        "intersect",
        "find the intersection of two components",
        f"Find the intersection of two components. {FROM_COMPONENTS}",
    ),
    (
        "eliminate",
        "find exact equations of a component in some variables",
        "Find the exact equations that a component's points satisfy in some of the variables, and "
        "the maps from there to the other variables, by interpolation; prove them where possible. "
        "Of a planar linkage with a pin P, `nag eliminate CASE --onto x_P,y_P` finds the equation "
        f"of the curve that P draws. {FROM_COMPONENTS}",
    ),
    (
        "model",
        "print the polynomial system of a case",
        "Print the polynomial system that `nag decompose` decomposes.",
    ),
    (
        "check",
        "test the statements of the founding papers, on a case or all",
        "Test what the founding papers state, one by one: exactly where exact algebra decides, "
        "else numerically, with a counterexample where a statement fails; and compare the "
        "decomposition of a case with the papers' prime components.",
    ),
    (
        "bench",
        "solve the benchmark systems and measure how fast",
        "Solve the benchmark systems, check their numbers of solutions and measure the time, "
        "beside other programs if they are installed.",
    ),
    (
        "chart",
        "chart where methods fail, and speed against accuracy",
        "Run families of systems that are hard in one way each, or solve cases in many settings "
        "and arithmetics, and draw what comes of it.",
    ),
    (
        "completion",
        "print what a shell completes",
        "Print a script with which bash, zsh or fish completes the commands and their options.",
    ),
)


def _format_help(prog: str) -> argparse.HelpFormatter:
    """Help in which the longest command stands in one line with what it does."""
    formatter = argparse.HelpFormatter(prog, max_help_position=18)
    # It forgets that commands are indented, and leaves too few columns for the longest.
    formatter._action_max_length = 14
    return formatter


def parser(words: Sequence[str]) -> argparse.ArgumentParser:
    """The command line's grammar, with the options of the command that is among the words."""
    root = Parser(
        prog="nag",
        description="Numerical algebraic geometry for mechanisms: does it move, in which ways, and "
        "what are all solutions of its equations? A case is a file that describes a mechanism or "
        "equations; `nag CASE` says what can be asked of it, `nag init linkage` writes one.",
        epilog="Exit status: 0 complete answer, 1 incomplete answer, 2 bad input, 130 interrupted.",
        allow_abbrev=False,
        formatter_class=_format_help,
    )
    root.add_argument("--version", action="version", version=f"nag {nag.__version__}")
    commands = root.add_subparsers(
        dest="command", metavar="COMMAND", required=True, parser_class=CommandParser
    )
    named = next((word for word in words if not word.startswith("-")), None)
    # Behind a command's name all is for that command: the others are neither named nor listed.
    asked = [row for row in COMMANDS if words[:1] == [row[0]]]
    for name, text, description in asked or COMMANDS:
        command = commands.add_parser(
            name,
            allow_abbrev=False,
            help=text,
            description=description,
            formatter_class=CommandHelp,
        )
        if name == named:
            module = import_module(f"nag.cli.{name}")
            module.add_arguments(command)
            options = {s: (a.dest, a.default) for a in command._actions for s in a.option_strings}
            command.set_defaults(module=module, options=options)
    return root


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
    from nag.text.table import printable

    with contextlib.suppress(OSError, ValueError):
        sys.stderr.write(f"nag: {printable(message)}\n")
        sys.stderr.flush()


def _abandon_output() -> None:
    """Give standard output nowhere to go, so that the interpreter's last flush cannot fail."""
    with contextlib.suppress(OSError, ValueError):
        sink = os.open(os.devnull, os.O_WRONLY)
        os.dup2(sink, sys.stdout.fileno())
        os.close(sink)


def show_file(words: Sequence[str]) -> Sequence[str]:
    """The words of ``nag show``, if the name of a file stands where a command does."""
    first = next(iter(words), "-")
    known = first.startswith("-") or any(first == row[0] for row in COMMANDS)
    # Commands have no dots, and no folders before them.
    is_file = os.path.isfile(first) or "." in first or os.sep in first
    return ["show", *words] if is_file and not known else words


def check_command(words: Sequence[str]) -> None:
    """Refuse words that begin with no command.

    Raises:
        UsageError: with what would be right.
    """
    if not words:
        raise UsageError(
            "say what to do: `nag FILE` says what can be asked of a case, `nag init linkage` "
            "writes one, `nag --help` lists the commands"
        )
    if words[0].startswith("-") and words[0] not in ("-h", "--help", "--version"):
        option = words[0].partition("=")[0]
        raise UsageError(f"{option}: options stand behind a command: nag COMMAND ... {option}")
    known = [row[0] for row in COMMANDS]
    if not words[0].startswith("-") and words[0] not in known:
        from nag.algebra.tokens import nearest, quote

        raise UsageError(
            f"{quote(words[0])} is no command and no file{nearest(words[0], known)}; "
            "`nag --help` lists the commands"
        )


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit status.

    Args:
        argv: the words; None for those that the process was started with, which then works in a
            child. Other words are run in the calling process, or within limits of time and memory
            in a new one, for no child would have the caller's threads.
    """
    words = sys.argv[1:] if argv is None else list(argv)
    # A stream that was closed before the start is None.
    sys.stdout = sys.stdout or open(os.devnull, "w")  # noqa: SIM115
    sys.stderr = sys.stderr or open(os.devnull, "w")  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        # What a terminal's encoding cannot show is escaped; it must not end the run.
        with contextlib.suppress(AttributeError):
            stream.reconfigure(errors="backslashreplace")
    watched = False
    words = show_file(words)
    try:
        try:
            check_command(words)
            with _interrupted_afterwards():
                arguments, rest = parser(words).parse_known_args(words)
            if rest:
                where = f"(see nag {arguments.command} --help)"
                raise UsageError(f"unrecognized arguments: {' '.join(rest)} {where}")
        except SystemExit:  # after --help or --version
            _print()
            return COMPLETE
        limits = (getattr(arguments, name, None) for name in ("time_limit", "memory_limit"))
        if argv is None:
            status = work_in_child(arguments)
            if status is not None:
                return status
            watched = "tell" in arguments
        elif any(limit is not None for limit in limits):
            return work_in_new_process(words)
        return _run(arguments)
    except KeyboardInterrupt:
        if watched:
            leave_to_parent()
        _complain("interrupted")
        return INTERRUPTED
    except NagError as error:
        _complain(str(error))
        return BAD_INPUT
    finally:
        if watched:
            # What is done is not undone by an interruption of the interpreter's own end.
            signal.signal(signal.SIGINT, signal.SIG_IGN)


@contextlib.contextmanager
def _interrupted_afterwards() -> Iterator[None]:
    """Let an interruption wait: argparse undoes what it has half done only where there is none."""
    met: list[int] = []
    if (
        threading.current_thread() is not threading.main_thread()
        or signal.getsignal(signal.SIGINT) is not signal.default_int_handler
    ):
        yield
        return
    signal.signal(signal.SIGINT, lambda number, frame: met.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if met:
        raise KeyboardInterrupt


def main_for(parent: int) -> int:
    """`main` in a process that ends with the one that started it."""
    end_with(parent)
    return main()


# What options for arguments of functions are called that have another name.
OPTIONS = {"point": "at"}
# Where else an option's value is: `add_reading`.
_ELSEWHERE = {"at": "stance"}


def _is_given(option: str, arguments: argparse.Namespace) -> bool:
    """Whether the command line says something by an option; a file has keys of the same names."""
    if f"--{option}" not in arguments.options:
        return False
    place, default = arguments.options[f"--{option}"]
    values = (getattr(arguments, each, None) for each in (place, _ELSEWHERE.get(option, place)))
    return any(value not in (None, default) for value in values)


def _with_option(error: NagError, arguments: argparse.Namespace) -> str:
    """What an error says, arguments by the command's options for them, and the one that mends it.

    Texts begin with the argument that is wrong, behind the file's name where one is given.
    """
    text, file = str(error), f"{getattr(arguments, 'case', '')}: "
    head = file if text.startswith(file) else ""
    name, colon, reason = text.removeprefix(head).partition(": ")
    if colon and _is_given(OPTIONS.get(name, name), arguments):
        text = f"{head}--{OPTIONS.get(name, name)}: {reason}"
    option = OPTIONS.get(error.keyword, error.keyword)
    return f"{text} (--{option})" if option and option in arguments else text


def _run(arguments: argparse.Namespace) -> int:
    """Run the command that was parsed; returns the exit status."""
    try:
        return COMPLETE if run_command(arguments, _print) else INCOMPLETE
    except ComponentError as error:
        _complain(_with_option(error, arguments))
        return INCOMPLETE
    except NagError as error:
        _complain(_with_option(error, arguments))
        return BAD_INPUT
    except MemoryError:
        _complain("not enough memory for this case")
        return INCOMPLETE
