"""A command that is ended ends at once, says so, and leaves nothing behind."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

import nag

ROOT = Path(__file__).parents[1]

# What stands for a stage, in the place of `nag model`: all but the first hold the interpreter.
STAGES = {
    "Python": "time.sleep(60)",
    "FLINT": "flint.fmpz(10 ** 4000 + 7).factor()",
    "SciPy": "scipy.linalg.svd(numpy.ones((4000, 4000)))",
    "deaf": "signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT]); time.sleep(60)",
}
SCRIPT = """
import os, signal, sys, time
import nag.cli.model
# As from a terminal, also where the tests run under nohup.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)
def work(options):
    import flint, numpy, scipy.linalg
    print(os.getpid(), flush=True)
    {stage}
nag.cli.model.run = work
sys.argv = ["nag", "model", "x"]
sys.exit(nag.cli.main())
"""


def start(tmp_path: Path, stage: str) -> tuple[subprocess.Popen[str], int]:
    """A command whose work is the stage, and the process that works."""
    script = tmp_path / "run.py"
    script.write_text(SCRIPT.format(stage=stage))
    process = subprocess.Popen(
        [sys.executable, str(script)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    line = process.stdout.readline()
    assert line, process.communicate()[1]
    return process, int(line)


def is_alive(process: int) -> bool:
    """Whether a process is there that has not ended."""
    try:
        with open(f"/proc/{process}/stat", encoding="ascii") as stream:
            return stream.read().rsplit(")", 1)[1].split()[0] not in "ZX"
    except FileNotFoundError:
        return False


def is_gone(process: int) -> bool:
    """Whether a process ends: it closes its pipes before it is gone. All stages take longer."""
    return is_soon(lambda: not is_alive(process))


def is_soon(true: Callable[[], object]) -> bool:
    """Whether something comes true within seconds."""
    for _ in range(200):
        if true():
            return True
        time.sleep(0.05)
    return False


@pytest.mark.parametrize("stage", STAGES)
def test_ctrl_c_ends_what_holds_the_interpreter_and_the_child_with_it(stage, tmp_path) -> None:
    process, child = start(tmp_path, STAGES[stage])
    assert child != process.pid
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert process.returncode == 130
    assert out == "" and err.startswith("nag: interrupted after ") and err.count("\n") == 1
    assert is_gone(child)


def test_ctrl_c_while_the_program_is_being_loaded_is_one_line() -> None:
    program = """
import runpy, sys
class Interrupt:
    def find_spec(self, name, path, target=None):
        if name == "nag.cli.command_line":
            raise KeyboardInterrupt
sys.meta_path.insert(0, Interrupt())
runpy.run_module("nag", run_name="__main__")
"""
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "nag: interrupted\n")


@pytest.mark.parametrize("lines", ["['one component']", "[]"])
def test_what_is_printed_above_is_spoken_of_where_something_is(lines: str, tmp_path: Path) -> None:
    process, _ = start(tmp_path, f"options.write({lines}); sys.stdout.flush(); time.sleep(60)")
    if lines != "[]":
        assert process.stdout.readline() == "one component\n"
    time.sleep(0.2)
    process.send_signal(signal.SIGINT)
    err = process.communicate(timeout=30)[1]
    assert ("what is printed above holds" in err) is (lines != "[]")


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_other_signals_end_both_as_they_end_any_process(number, tmp_path) -> None:
    process, child = start(tmp_path, STAGES["Python"])
    process.send_signal(number)
    assert process.communicate(timeout=30) == ("", "")
    assert process.returncode == -number
    assert is_gone(child)


def test_a_signal_that_is_ignored_at_the_start_ends_nothing(tmp_path) -> None:
    ignoring = "signal.signal(signal.SIGHUP, signal.SIG_IGN)\n"
    script = tmp_path / "run.py"
    work = "sys.stdin.readline(); return nag.cli.running.CommandAnswer(['done'])"
    script.write_text(SCRIPT.format(stage=work).replace("def work", f"{ignoring}def work"))
    process = subprocess.Popen(
        [sys.executable, str(script)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    process.stdout.readline()
    process.send_signal(signal.SIGHUP)
    assert process.communicate("go on\n", timeout=30) == ("done\n", None)
    assert process.returncode == 0


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not tell of a dead parent")
def test_no_child_is_left_by_a_parent_that_is_killed(tmp_path) -> None:
    process, child = start(tmp_path, STAGES["FLINT"])
    process.kill()
    process.communicate(timeout=30)
    assert is_gone(child)


def test_a_killed_child_is_said(tmp_path) -> None:
    process, child = start(tmp_path, STAGES["Python"])
    os.kill(child, signal.SIGKILL)
    _, err = process.communicate(timeout=30)
    assert process.returncode == 128 + signal.SIGKILL
    assert err == "nag: the work was ended by SIGKILL, as when memory is short\n"


@pytest.mark.parametrize("ending", ["raise nag.NagError('no more')", "os.kill(os.getpid(), 9)"])
def test_what_was_found_before_an_error_is_said_and_left_in_its_place(ending, tmp_path) -> None:
    target = tmp_path / "a.json"
    kept = "nag.cli.running.unfinished_file(options.json)"
    stage = f"nag.cli.running.write_document({{'a': 1}}, {kept}); {ending}"
    script = SCRIPT.format(stage=stage).replace("cli.model", "cli.solve")
    words = ["nag", "solve", "x", "--json", str(target), "--quiet"]
    (tmp_path / "run.py").write_text(script.replace('["nag", "model", "x"]', repr(words)))
    ended = subprocess.run(
        [sys.executable, str(tmp_path / "run.py")], capture_output=True, text=True, timeout=60
    )
    assert ended.returncode == (2 if "raise" in ending else 128 + 9)
    said = f"nag: {target} has what was found by then, marked incomplete"
    assert ended.stderr.splitlines()[1:] == [said]
    assert target.read_text() == '{\n  "a": 1\n}\n'
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.json", "run.py"]


def katsura(n: int) -> str:
    """The equations of Katsura in n + 1 variables, a line each."""
    names = [f"u{abs(i)}" if abs(i) <= n else "0" for i in range(-2 * n, 2 * n + 1)]
    u = {i: names[i + 2 * n] for i in range(-2 * n, 2 * n + 1)}
    lines = ["+".join(u[i] for i in range(-n, n + 1)) + "-1"]
    for m in range(n):
        products = [f"{u[i]}*{u[m - i]}" for i in range(-n, n + 1) if "0" not in (u[i], u[m - i])]
        lines.append("+".join(products) + f"-u{m}")
    return "\n".join(lines) + "\n"


def limited(tmp_path: Path, *words: str) -> subprocess.CompletedProcess[str]:
    case = tmp_path / "katsura.txt"
    case.write_text(katsura(15))
    command = [sys.executable, "-m", "nag", "solve", str(case), "--threads", "1", *words]
    return subprocess.run(command, capture_output=True, text=True, timeout=100)


@pytest.mark.parametrize(
    "words, said",
    [
        (("--time-limit", "1.5"), "nag: the time limit of 1.5 s is reached after "),
        (("--memory-limit", "0.02"), "nag: the memory limit of 0.02 GB is reached after "),
    ],
)
def test_a_limit_that_is_reached_ends_with_status_1_and_keeps_what_was_found(
    words, said, tmp_path
) -> None:
    target = tmp_path / "answer.json"
    target.write_text("before")
    done = limited(tmp_path, *words, "--quiet", "--json", str(target))
    assert done.returncode == 1
    assert done.stdout == "" and done.stderr.startswith(said) and done.stderr.count("\n") == 1
    # Of the first paths the ends are written, if there were any.
    if target.read_text() != "before":
        assert not nag.read(target).complete
    assert sorted(os.listdir(tmp_path)) == ["answer.json", "katsura.txt"]


@pytest.mark.parametrize("text", ["0", "-1", "nan", "inf", "soon", "\u0661"])
def test_a_limit_is_a_positive_number(text, tmp_path) -> None:
    done = limited(tmp_path, f"--time-limit={text}")
    assert done.returncode == 2
    assert "is not a number above 0" in done.stderr and done.stderr.count("\n") == 1


PROGRAM = """
import contextlib, io, os, signal, sys, threading
from nag.cli import main
signal.signal(signal.SIGINT, signal.default_int_handler)
threading.Thread(target=threading.Event().wait, daemon=True).start()
printed = io.StringIO()
with contextlib.redirect_stdout(printed):
    status = main(sys.argv[1:])
sys.stdout.write(f"{os.getpid()} {status} {printed.getvalue().count(chr(10))}\\n")
"""


@pytest.mark.parametrize(("limit", "status"), [("100", 0), ("0.001", 1)])
def test_a_program_that_calls_a_limited_command_is_not_forked(limit, status, tmp_path) -> None:
    (tmp_path / "program.py").write_text(PROGRAM)
    (tmp_path / "lines.txt").write_text("x*y\nx - y\n")
    command = [sys.executable, str(tmp_path / "program.py"), "solve", str(tmp_path / "lines.txt")]
    process = subprocess.Popen(
        [*command, "--time-limit", limit, "--quiet"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    out, err = process.communicate(timeout=100)
    # It goes on once, in its own process, and has what was printed.
    assert out.splitlines() in (
        [f"{process.pid} {status} {n}"] for n in ([0] if status else range(5, 20))
    )
    assert err.count("\n") == status


def children_of(process: int) -> list[int]:
    """The processes that one has started."""
    with contextlib.suppress(FileNotFoundError):
        text = Path(f"/proc/{process}/task/{process}/children").read_text()
        return [int(child) for child in text.split()]
    return []


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not tell of children")
def test_an_interrupted_program_interrupts_the_command_that_it_called(tmp_path) -> None:
    (tmp_path / "program.py").write_text(PROGRAM)
    (tmp_path / "katsura.txt").write_text(katsura(13))
    words = ["solve", str(tmp_path / "katsura.txt"), "--time-limit", "60", "--quiet"]
    process = subprocess.Popen(
        [sys.executable, str(tmp_path / "program.py"), *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert is_soon(lambda: [c for child in children_of(process.pid) for c in children_of(child)])
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert out == f"{process.pid} 130 0\n" and err.startswith("nag: interrupted after ")
