"""One run of a command: it starts, tells how far it is, writes its answer and prints it."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

from nag.cli.arguments import UsageError, settle_stance
from nag.numerics.linear_algebra_threads import VARIABLES
from nag.text.progress import stage_name
from nag.text.progress_line import ERASE, INTERVAL, ProgressLine, can_erase, progress_line

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.text.table import Block, Row
    from nag.tracking.run import Run

# Options that name a file to be written, with their endings, and what stands for standard output.
TARGETS = {
    "json": (".json",),
    "csv": (".csv",),
    "html": (".html",),
    "points": (".npz", ".parquet"),
}
STANDARD_OUTPUT = "-"
Progress = Callable[[str, int, int], None]

# What is told where a stage has no steps yet.
WORKING = "working"


# No dataclass: loading those takes a fifth of the time of `nag --help`.
class CommandAnswer(NamedTuple):
    """What a command hands back.

    Attributes:
        lines: what is printed.
        complete: whether the answer is complete.
        document: makes what ``--json`` writes: a JSON object, or its text.
        proof: works out what is printed after that, labelled texts, and whether all is proved.
    """

    lines: Sequence[str]
    complete: bool = True
    document: Callable[[], dict[str, Any] | str] | None = None
    proof: Callable[[], tuple[Sequence[Row], bool]] | None = None


def answer_of(
    options: argparse.Namespace,
    case: tuple[str, str],
    blocks: Sequence[Block],
    tail: Sequence[Row],
    fields: dict[str, Any],
    complete: bool,
    *,
    rests_on: Sequence[str] = ("seed", "settings"),
    said: str = "",
    width: int = 0,
) -> CommandAnswer:
    """An answer whose document begins, and whose lines end, as those of all commands do.

    Args:
        case: its title, and the name of its file without the folder.
        blocks: what is printed below the title.
        tail: labelled texts below that, above the line of the run.
        fields: of the document: its ``format``, and what follows its head.
        complete: whether the answer is complete.
        rests_on: options that the answer depends on.
        said: in the line of the run as well.
        width: of labels, at least.
    """
    from nag.text.table import sheet

    document = answer_document(options, case, fields, complete, rests_on)
    lines = sheet(case[0], *blocks, [*tail, run_row(options, rests_on, said)], width=width)
    if lines[: len(options.said)] == options.said:
        lines = lines[len(options.said) :]
    return CommandAnswer(lines, complete, lambda: document)


def answer_document(
    options: argparse.Namespace,
    case: tuple[str, str],
    fields: dict[str, Any],
    complete: bool,
    rests_on: Sequence[str] = ("seed", "settings"),
) -> dict[str, Any]:
    """The document of an answer, or of what is known of it by now; arguments as of `answer_of`."""
    chosen = {name: getattr(options, name) for name in rests_on}
    return document_head(fields["format"], case) | chosen | {"complete": complete} | fields


def say_first(
    options: argparse.Namespace, case: tuple[str, str], *blocks: Block, width: int
) -> None:
    """Print the first lines of an answer as soon as they are known; they are not printed again.

    Args:
        blocks: what is printed below the title.
        width: of labels, the same as of the whole answer.
    """
    from nag.text.table import sheet

    lines = sheet(case[0], *blocks, width=width)
    if lines[: len(options.said)] != options.said:
        return
    if options.progress is not None:
        options.progress.erase()
    options.write(lines[len(options.said) :])
    options.said = lines
    if options.progress is not None:
        options.progress(WORKING, 0, 0)


def document_head(name: str, case: tuple[str, str] | None) -> dict[str, Any]:
    """How the document of a format begins, for a case by its title and file."""
    named = None if case is None else {"title": case[0], "file": case[1]}
    return {"format": name, "version": 1, "case": named}


def name_case(case: Case) -> tuple[str, str]:
    """Title and file, without its folder, of a case."""
    return case.title, os.path.basename(case.path)


def run_command(options: argparse.Namespace, write: Callable[[Sequence[str]], None]) -> bool:
    """Run a command, write its document and print its answer.

    The answer is printed even if its document cannot be written.

    Args:
        options: what was parsed, with the command's ``module``.
        write: prints lines.

    Returns:
        Whether the answer is complete.

    Raises:
        UsageError: for a document that cannot be written; before any work if that is seen by then.
        nag.NagError: as the command does.
    """
    begin(options)
    settle_stance(options)
    forget_unfinished(options)
    told, tell = write, getattr(options, "tell", None)
    if getattr(options, "json", None) == STANDARD_OUTPUT:
        # The document is all that is written there.
        write = _write_nothing
    elif tell is not None:
        write = tell.tell_of_lines(write)
    options.write, options.said = write, list[str]()
    with show_progress(options) as options.progress, shared_work(options):
        answer = options.module.run(options)
    try:
        if answer.document is not None and options.json == STANDARD_OUTPUT:
            document = answer.document()
            text = document if isinstance(document, str) else "".join(_document_parts(document))
            told(text.splitlines())
        elif answer.document is not None and options.json is not None:
            write_document(answer.document(), options.json)
        forget_unfinished(options)
    finally:
        write(answer.lines)
    if answer.proof is None:
        return answer.complete
    from nag.text.table import label_lines

    with show_progress(options) as options.progress, shared_work(options):
        rows, proved = answer.proof()
    write(["", *label_lines(rows)])
    return answer.complete and proved


def begin(options: argparse.Namespace) -> None:
    """Start the clock, and refuse a file that the answer could not be written to.

    NumPy's linear algebra gets one thread, unless the environment says otherwise: the matrices are
    small, threads of its own would wait for each other, and sums would be in another order.

    Raises:
        UsageError: for such a file.
    """
    from nag.files.written_file import check_ending

    options.started = time.perf_counter()
    for name in VARIABLES:
        os.environ.setdefault(name, "1")
    source = getattr(options, "case", None) or getattr(options, "export", "")
    written: dict[str, str] = {}
    for name, endings in TARGETS.items():
        target = getattr(options, name, None)
        if target is not None and (name, target) != ("json", STANDARD_OUTPUT):
            if target == STANDARD_OUTPUT:
                raise UsageError(
                    f"--{name}: name a file; only --json writes to standard output, as -"
                )
            check_option_target(name, target, source if isinstance(source, str) else "")
            with writing_to(name):
                check_ending(target, getattr(options, f"{name}_endings", endings))
            file = os.path.realpath(target)
            # Devices and pipes are not replaced.
            if file in written and (os.path.isfile(file) or not os.path.exists(file)):
                raise UsageError(f"--{name}: {target}: --{written[file]} names this file too")
            written[file] = name


@contextlib.contextmanager
def show_progress(options: argparse.Namespace) -> Iterator[ProgressLine | TellParent | None]:
    """Tell on standard error what a command that tracks paths does; the progress callback.

    Where a parent watches, it is told, quiet or not: it says how far the work was that it ends.
    """
    if "quiet" not in options:
        yield None
        return
    tell = getattr(options, "tell", None)
    if tell is not None:
        tell(WORKING, 0, 0)
        with compilation_notice(sys.stderr, options.quiet):
            try:
                yield tell
            finally:
                tell.erase()
        return
    with (
        compilation_notice(sys.stderr, options.quiet),
        progress_line(sys.stderr, options.quiet) as progress,
    ):
        yield progress


@contextlib.contextmanager
def shared_work(options: argparse.Namespace) -> Iterator[None]:
    """Keep finished work in the folder of ``--resume``, and have it done by ``--executor``.

    Raises:
        nag.errors.InputError: if either cannot be had.
    """
    resume, executor = (getattr(options, name, None) for name in ("resume", "executor"))
    if resume is None and executor is None and options.progress is None:
        yield
        return
    from nag.tracking.blocks import open_engine, tell_proofs_to

    with (
        tell_proofs_to(options.progress),
        open_engine(resume, executor, options.progress) as engine,
    ):
        yield
    if engine is None or engine.ledger is None or not (engine.ledger.damaged or engine.ledger.used):
        return
    if engine.ledger.damaged or not options.quiet:
        if options.progress is not None:
            options.progress.erase()
        sys.stderr.write(f"nag: {resume}: {engine.ledger.text}\n")


def chosen_run(
    options: argparse.Namespace, document_of: Callable[[Any], dict[str, Any] | None] | None = None
) -> Run:
    """How whatever tracks paths is to be worked out.

    Args:
        document_of: the document of an answer that is not complete yet, None where it is none of
            what is asked; it is kept beside the file of ``--json``, for when the work is ended.
    """
    from nag.tracking.run import Run

    found = None
    if document_of is not None and keeps_unfinished(options):

        def found(answer: Any) -> None:
            document = document_of(answer)
            if document is not None:
                write_document(document, options.json, file=unfinished_file(options.json))

    return Run(options.seed, options.threads, options.settings, options.progress, found)


def keeps_unfinished(options: argparse.Namespace) -> bool:
    """Whether answers that are not complete yet are kept: in a file, where a parent watches."""
    target = getattr(options, "json", None)
    watched = getattr(options, "tell", None) is not None
    special = target is None or (os.path.exists(target) and not os.path.isfile(target))
    return watched and target != STANDARD_OUTPUT and not special


def unfinished_file(target: str) -> str:
    """Where an answer that is not complete yet is kept."""
    return f"{target}.unfinished"


def take_unfinished(target: str | None) -> bool:
    """Put what was kept in the place of the document; whether there was anything."""
    if target is None or not os.path.isfile(unfinished_file(target)):
        return False
    with contextlib.suppress(OSError):
        os.replace(unfinished_file(target), target)
        return True
    return False


def forget_unfinished(options: argparse.Namespace) -> None:
    """Remove what was kept, once the document is there, or of a run before this one."""
    target = getattr(options, "json", None)
    if target not in (None, STANDARD_OUTPUT):
        with contextlib.suppress(OSError):
            os.remove(unfinished_file(target))


def run_row(
    options: argparse.Namespace,
    rests_on: Sequence[str] = ("seed", "settings"),
    said: str = "",
    places: int = 1,
) -> Row:
    """The line of the run: options that the answer rests on, what is said besides, seconds."""
    texts = [f"{name} {getattr(options, name)}" for name in rests_on]
    time_text = f"{time.perf_counter() - options.started:.{places}f} s"
    return "run", ", ".join([*texts, *filter(None, [said]), time_text])


@contextlib.contextmanager
def writing_to(option: str) -> Iterator[None]:
    """Write the file that an option names inside the block.

    Raises:
        UsageError: if it cannot be written.
    """
    from nag.files.written_file import TargetError

    try:
        yield
    except TargetError as error:
        raise UsageError(f"--{option}: {error}") from None


def write_document(
    document: dict[str, Any] | str | bytes,
    target: str,
    option: str = "json",
    file: str | None = None,
) -> None:
    """Write a JSON object, a text, or bytes to the file that an option names.

    Args:
        file: a file that is written in place of the one that is named, and that errors do not name.

    Raises:
        UsageError: if the file cannot be written.
    """
    from nag.files.written_file import write_target

    with writing_to(option):
        written = document if isinstance(document, bytes | str) else _document_parts(document)
        write_target(file or target, written, named=target)


def write_arrays(arrays: dict[str, Any], target: str, option: str) -> None:
    """Write arrays by name to the file that an option names, one after the other.

    Raises:
        UsageError: if the file cannot be written.
    """
    import numpy as np

    from nag.files.written_file import write_target

    with writing_to(option):
        write_target(target, lambda stream: np.savez(stream, **arrays))


def check_tables(option: str) -> None:
    """Refuse a table where nothing that writes such is installed, before anything is worked out.

    Raises:
        UsageError: if pandas or pyarrow is not.
    """
    from importlib.util import find_spec

    missing = [name for name in ("pandas", "pyarrow") if find_spec(name) is None]
    if missing:
        names = " ".join(missing)
        raise UsageError(
            f"--{option}: .parquet is written by pandas with pyarrow; pip install {names}, or name "
            "a file .npz"
        )


def write_table(columns: dict[str, Any], target: str, option: str) -> None:
    """Write columns of equal length by name to the Parquet file that an option names.

    Raises:
        UsageError: if the file cannot be written.
    """
    from nag.files.written_file import write_target
    from nag.text.table import data_frame

    with writing_to(option):
        write_target(target, lambda stream: data_frame(columns).to_parquet(stream))


def _document_parts(document: dict[str, Any]) -> Iterator[str]:
    """A JSON object as it is written, part by part."""
    from nag.text.json_text import lay_out_parts

    yield from lay_out_parts(document)
    yield "\n"


def _write_nothing(lines: Sequence[str]) -> None:
    """Lines that are not printed."""


def check_option_target(option: str, target: str, source: str = "") -> None:
    """Refuse a file that an option names and that could not be written.

    Args:
        source: the file that is read, which it must not be.

    Raises:
        UsageError: if it could not.
    """
    from nag.files.written_file import check_target

    with writing_to(option):
        check_target(target)
    if os.path.exists(target) and os.path.exists(source) and os.path.samefile(target, source):
        raise UsageError(f"--{option}: {target}: is the case file; name another file")


# What a child tells when it has printed something of its answer.
PRINTED = "\t"


class TellParent:
    """Tells the process that watches this one what `ProgressLine` is to show.

    A stage is told at once, further steps of it not more often than they can be read.
    """

    def __init__(self, telling: int, acknowledged: int) -> None:
        self._telling, self._acknowledged = telling, acknowledged
        self._last, self._stage = 0.0, ""

    def __call__(self, stage: str, done: int, total: int) -> None:
        now = time.monotonic()
        if stage_name(stage) == self._stage and now - self._last < INTERVAL and done != total:
            return
        self._last, self._stage = now, stage_name(stage)
        name = stage.replace("\n", " ").replace("\t", " ")
        self._write(f"{name}\t{int(done)}\t{int(total)}\n")

    def erase(self) -> None:
        """Have the line taken off the terminal, and wait until it is."""
        self._write("\n")
        os.read(self._acknowledged, 1)

    def tell_of_lines(
        self, write: Callable[[Sequence[str]], None]
    ) -> Callable[[Sequence[str]], None]:
        """The same writing of lines, of which the other process is told."""

        def tell_and_write(lines: Sequence[str]) -> None:
            write(lines)
            if lines:
                self._write(f"{PRINTED}\n")

        return tell_and_write

    def _write(self, text: str) -> None:
        # Without the parent there is no one to work for.
        try:
            os.write(self._telling, text.encode(errors="replace"))
        except OSError:
            os._exit(1)


@contextlib.contextmanager
def compilation_notice(stream: TextIO, quiet: bool = False) -> Iterator[None]:
    """Say so on ``stream``, once, when a kernel is compiled inside the block.

    Kernels that are loaded from the cache are not compiled, so the line appears only when there is
    a wait.
    """
    if quiet:
        yield
        return
    from nag.machine_code.kernel import compilations

    given: list[str] = []

    def notice(name: str) -> None:
        if not given:
            start = ERASE if can_erase(stream) else ""
            stream.write(f"{start}compiling the run, once; this takes a few seconds ...\n")
            stream.flush()
        given.append(name)

    with compilations(notice):
        yield
