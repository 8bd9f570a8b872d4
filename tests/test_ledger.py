"""Finished work that is found again, or was done elsewhere: answers are the same, byte for byte."""

from __future__ import annotations

import json
import os
import pickle
import random
import shutil
import signal
import subprocess
import sys
import time
from argparse import Namespace
from collections.abc import Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from fractions import Fraction
from importlib.machinery import ModuleSpec
from pathlib import Path
from threading import Thread
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import nag
from nag.algebra.surd import Surd
from nag.cli import main
from nag.cli.arguments import UsageError
from nag.cli.watched import work_in_child
from nag.errors import InputError
from nag.files.export import export_text as decomposition_text
from nag.files.solutions_export import export_text as solutions_text
from nag.numerics.singular_point import Place, SingularEnd, analyse
from nag.solving import end_judgements
from nag.solving.certificate import certify_solutions
from nag.tracking.blocks import in_blocks, open_engine, tell_proofs_to
from nag.tracking.homotopy import Homotopy
from nag.tracking.ledger import Ledger, add_content, key_of
from nag.tracking.track import block_in_doubles

ROOT = Path(__file__).parents[1]
CYCLIC = [
    "a + b + c + d + e",
    "a*b + b*c + c*d + d*e + e*a",
    "a*b*c + b*c*d + c*d*e + d*e*a + e*a*b",
    "a*b*c*d + b*c*d*e + c*d*e*a + d*e*a*b + e*a*b*c",
    "a*b*c*d*e - 1",
]
SINGULAR = [
    "(x - 1)^2*(x^2 + y^2 + 1) + z^5 - y",
    "y^3*(y - 1)^2 - x + 1 + z*x",
    "z^3 - x*y + z*y^2",
]
SURFACES = [
    "(x^2 + y - z)^2*(x + y^4 + z) - x*y*z*w + 1",
    "(x^3 - y^2*z + w)*(z - y^3) - w^2 + 2*x",
]


def katsura(n: int) -> list[str]:
    def x(k: int) -> str:
        return f"x{abs(k)}" if abs(k) <= n else "0"

    rows = ["+".join(["x0", *(f"2*x{k}" for k in range(1, n + 1))]) + "-1"]
    for m in range(n):
        products = "+".join(f"{x(k)}*{x(m - k)}" for k in range(-n, n + 1))
        rows.append(f"{products}-x{m}")
    return rows


def solved(equations: Any, **how: Any) -> str:
    return solutions_text(nag.solve(equations, seed=2, **how), "t", "t")


def decomposed(equations: Any, **how: Any) -> str:
    return decomposition_text(nag.decompose(equations, seed=2, **how))


def blocks_in(folder: Path) -> list[Path]:
    return sorted(folder.glob("*.block"))


@pytest.mark.parametrize(
    ("ask", "equations"),
    [(solved, CYCLIC), (solved, SINGULAR), (decomposed, SURFACES), (solved, katsura(6))],
    ids=["cyclic-5", "singular", "surfaces", "katsura-6"],
)
def test_answers_are_the_same_with_a_ledger_empty_full_or_in_parts(
    ask: Any, equations: Any, tmp_path: Path
) -> None:
    plain = ask(equations)
    assert ask(equations, resume=tmp_path) == plain
    made = blocks_in(tmp_path)
    assert made and not list(tmp_path.glob("*.part"))
    assert ask(equations, resume=str(tmp_path)) == plain
    assert blocks_in(tmp_path) == made
    for lost in made[::2]:
        lost.unlink()
    assert ask(equations, resume=tmp_path, threads=2) == plain
    assert blocks_in(tmp_path) == made


def test_singular_ends_are_found_again_and_each_is_judged_by_itself(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    judged = []
    judge = end_judgements.analyse
    monkeypatch.setattr(
        end_judgements,
        "analyse",
        lambda *given, **how: judged.append(given) or judge(*given, **how),
    )
    # Two pairs of double zeros that are each other's conjugates, at which paths end.
    equations = [
        "x^2 + y^2 + 1 + (x^2 - 2*y^2 - 1/2)^2*x",
        "(x^2 - 2*y^2 - 1/2)^2*(x + 3) + (x^2 + y^2 + 1)^2*y",
    ]
    plain = solved(equations, start="total")
    alone = sorted(str(end[1]) for end in judged)
    assert len(alone) == 4
    judged.clear()
    assert solved(equations, start="total", resume=tmp_path) == plain
    assert sorted(str(end[1]) for end in judged) == alone
    judged.clear()
    assert solved(equations, start="total", resume=tmp_path) == plain
    assert not judged


@pytest.mark.parametrize("x", [[Fraction(1, 3), 0], [2**0.5, 0.1]])
def test_what_is_said_of_an_end_is_read_as_it_was_written(x: list[Any]) -> None:
    # A zero of multiplicity 6, and the cube roots of a small number beside the other.
    f = nag.system(["(3*x - 1)^3*(x^2 - 2)^3", "(y^2 - y/10)^2"]).polynomials
    end = analyse(f, np.array(x, dtype=complex), 1e-10, np.random.default_rng(1))
    again = SingularEnd.from_parts(json.loads(json.dumps(end.parts())))
    assert again.parts() == end.parts()
    assert again.place is end.place is Place.ISOLATED
    assert again.precise is not None and end.precise is not None
    assert again.precise.log_distance(end.precise) == -np.inf
    assert again.rational == end.rational


@pytest.mark.parametrize("seed", range(20))
def test_damaged_blocks_are_worked_out_again_and_said(seed: int, tmp_path: Path) -> None:
    chance = random.Random(seed)
    plain = solved(SINGULAR, resume=tmp_path)
    made = blocks_in(tmp_path)
    whole = {file: file.read_bytes() for file in made}
    damaged = chance.choice(made)
    content = bytearray(whole[damaged])
    match seed % 4:
        case 0:
            content = content[: chance.randrange(len(content))]
        case 1:
            content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
        case 2:
            content += bytes([chance.randrange(256)])
        case 3:
            # Another block under this one's name.
            content = bytearray(whole[chance.choice([f for f in made if f != damaged])])
    damaged.write_bytes(content)
    with pytest.warns(UserWarning, match="1 of these were damaged"):
        assert solved(SINGULAR, resume=tmp_path) == plain
    assert {file: file.read_bytes() for file in blocks_in(tmp_path)} == whole


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes")
@pytest.mark.parametrize("kind", ["pipe", "device", "loop"])
def test_what_is_no_file_is_not_read_and_the_block_is_worked_out_again(
    kind: str, tmp_path: Path
) -> None:
    plain = solved(CYCLIC, resume=tmp_path)
    made = blocks_in(tmp_path)
    whole = {file: file.read_bytes() for file in made}
    made[0].unlink()
    match kind:
        case "pipe":
            os.mkfifo(made[0])
        case "device":
            made[0].symlink_to("/dev/zero")
        case "loop":
            made[0].symlink_to(made[0].name)
    with pytest.warns(UserWarning, match="1 of these were damaged"):
        assert solved(CYCLIC, resume=tmp_path) == plain
    assert {file: file.read_bytes() for file in blocks_in(tmp_path)} == whole
    assert made[0].is_file() and not made[0].is_symlink()


def test_what_ended_runs_left_half_written_is_cleared_away_and_nothing_else(tmp_path) -> None:
    names = {"old": "a.block.1.part", "new": "a.block.2.part", "kept": "a.block", "other": "a.txt"}
    for name, file in names.items():
        (tmp_path / file).write_bytes(b"x")
        if name != "new":
            os.utime(tmp_path / file, (0, 0))
    Ledger.open(tmp_path)
    assert {file.name for file in tmp_path.iterdir()} == {*names.values()} - {names["old"]}


def test_a_folder_under_the_name_of_a_block_is_refused_before_any_work(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = str(ROOT / "cases" / "benchmarks" / "katsura-6.toml")
    words = ["solve", case, "--start", "total", "--resume", str(tmp_path)]
    assert main([*words, "--quiet"]) == 0
    (block,) = blocks_in(tmp_path)
    block.unlink()
    block.mkdir()
    answer = tmp_path / "answer.json"
    capsys.readouterr()
    assert main([*words, "--quiet", "--json", str(answer)]) == 2
    said = f"nag: {block}: is a folder, where a block is to be kept; remove it\n"
    assert capsys.readouterr().err == said
    assert block.is_dir() and not answer.exists()


def test_other_questions_find_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    solved(CYCLIC, resume=tmp_path)
    made = set(blocks_in(tmp_path))
    solved(CYCLIC, resume=tmp_path, settings="careful")
    more = set(blocks_in(tmp_path))
    assert more > made
    monkeypatch.setattr("nag.tracking.ledger._origin", lambda: b"another version")
    plain = solved(CYCLIC, resume=tmp_path)
    assert len(blocks_in(tmp_path)) > len(more) and plain == solved(CYCLIC)


def test_keys_tell_arguments_apart_and_do_not_depend_on_what_was_done_before() -> None:
    rows = nag.system(["x^2 - 2*y", "y^2 - x"])
    from nag.tracking.compiled import compile_rows

    one, other = (Homotopy(compile_rows(rows.polynomials)) for _ in range(2))
    starts = np.array([[1, 1, 1]], dtype=complex)
    key = key_of(block_in_doubles, (one, starts))
    _ = one.rows.tape
    assert key_of(block_in_doubles, (one, starts)) == key
    assert key_of(block_in_doubles, (other, starts.copy())) == key
    for changed in ((one, -starts), (one, starts.real.copy()), (one, starts.T), (one, [1, 1, 1])):
        assert key_of(block_in_doubles, changed) != key
    with pytest.raises(TypeError, match="no canonical bytes"):
        key_of(block_in_doubles, (object(),))


def test_all_exact_numbers_have_canonical_bytes() -> None:
    from hashlib import blake2b

    found = set()
    for text in ("1/3", "sqrt(2)", "sqrt(2) + 1", "sqrt(3)", "sin(1)", "cos(1)", "pi"):
        digest = blake2b()
        add_content(digest, nag.system([f"({text})*x"]).polynomials)
        found.add(digest.digest())
    assert len(found) == 7
    assert isinstance(next(iter(nag.system(["sqrt(2)*x"]).polynomials[0].terms.values())), Surd)


def test_a_homotopy_that_was_used_survives_a_pickle() -> None:
    from nag.tracking.compiled import compile_rows
    from nag.tracking.settings import Settings

    homotopy = Homotopy(compile_rows(nag.system(["x^2 - 2*y", "y^2 - x + 3"]).polynomials))
    starts = np.ones((3, 3), dtype=complex)
    call = starts, Settings(), True, None, None
    first = block_in_doubles(homotopy, *call)
    again = pickle.loads(pickle.dumps(homotopy))
    second = block_in_doubles(again, *call)
    assert again._cache and all(np.array_equal(first[k], second[k]) for k in first)
    assert len(pickle.dumps(homotopy)) < 3000


def test_a_ledger_that_cannot_be_kept_is_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match=r"finished work cannot be kept there: .*; name a folder"):
        Ledger.open(tmp_path / "file")
    case = str(ROOT / "cases" / "benchmarks" / "katsura-6.toml")
    assert main(["solve", case, "--resume", str(tmp_path / "file" / "x")]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    for name in ("processes", "processes:0", "processes:x", "dask:", "slurm"):
        assert main(["solve", case, "--executor", name]) == 2
        assert "write processes:N, dask://ADDRESS or mpi" in capsys.readouterr().err


def test_commands_say_what_was_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = str(ROOT / "cases" / "benchmarks" / "katsura-6.toml")
    ledger, answers = tmp_path / "ledger", [tmp_path / "1.json", tmp_path / "2.json"]
    said = []
    for answer in answers:
        words = ["solve", case, "--start", "total", "--resume", str(ledger), "--json", str(answer)]
        assert main(words) == 0
        said.append(capsys.readouterr().err)
    assert "0 blocks found, 1 worked out" in said[0]
    assert "1 blocks found, 0 worked out" in said[1]
    assert answers[0].read_bytes() == answers[1].read_bytes()


def test_members_of_a_family_are_blocks(tmp_path: Path) -> None:
    values = np.random.default_rng(0).standard_normal((2500, 2))
    asked = (["x^2 + a*x*y - 1", "y^2 + b*x - 2"], ["a", "b"], values)
    plain = nag.solve_family(*asked)
    kept = nag.solve_family(*asked, resume=tmp_path)
    found = nag.solve_family(*asked, resume=tmp_path, threads=2)
    assert len(blocks_in(tmp_path)) == 3
    with ThreadPoolExecutor(3) as pool:
        shared = nag.solve_family(*asked, executor=pool)
    for other in (kept, found, shared):
        assert np.array_equal(other.points, plain.points, equal_nan=True)
        assert np.array_equal(other.errors, plain.errors)


class Ended(Exception):
    """Stands for the end of a run."""


def test_values_of_a_sweep_are_found_again_after_a_run_that_was_ended(tmp_path: Path) -> None:
    def end_after_two(swept: list[Any]) -> None:
        if len(swept) == 2:
            raise Ended

    # For b = 1 the components fall apart, which is found without following.
    asked = (ROOT / "cases" / "rhombus.toml", "b", ["1/2", 1, "3/2", 2])
    plain = nag.sweep_parameter(*asked)
    with pytest.raises(Ended):
        nag.sweep_parameter(*asked, resume=tmp_path, found=end_after_two)
    with open_engine(tmp_path, None) as engine:
        resumed = nag.sweep_parameter(*asked)
    assert engine is not None and engine.ledger is not None
    # That of a general value, and two of the four.
    assert (engine.ledger.found, engine.ledger.kept) == (3, 2)
    assert resumed == plain
    for one, other in zip(resumed, plain, strict=True):
        text, expected = (decomposition_text(each.decomposition) for each in (one, other))
        assert text == expected
    assert [each.decomposition.algebraic for each in resumed] == [
        each.decomposition.algebraic for each in plain
    ]
    other = nag.sweep_parameter(*asked, resume=tmp_path, settings="careful")
    assert {each.decomposition.settings for each in other} == {"careful"}


class Unreliable(Executor):
    """Loses its workers after some blocks."""

    def __init__(self, good: int) -> None:
        self.good = good

    def submit(self, function: Any, /, *given: Any, **named: Any) -> Future:
        future: Future = Future()
        self.good -= 1
        if self.good < -1:
            raise BrokenProcessPool("no more workers")
        if self.good < 0:
            future.set_exception(BrokenProcessPool("a worker ended"))
        else:
            future.set_result(function(*given, **named))
        return future


@pytest.fixture(scope="module")
def pool() -> Iterator[Executor]:
    from nag.tracking.executor import open_executor

    with open_executor("processes:2") as opened:
        assert opened is not None
        yield opened


EQUATIONS, BLOCKS = katsura(11), 2


@pytest.fixture(scope="module")
def expected() -> str:
    return solved(EQUATIONS)


def test_processes_give_the_same_answer(pool: Executor, expected: str) -> None:
    assert solved(EQUATIONS, executor=pool) == expected
    assert decomposed(SURFACES, executor=pool) == decomposed(SURFACES)


@pytest.mark.parametrize("good", [0, 1])
def test_blocks_of_lost_workers_are_worked_out_here(good: int, expected: str) -> None:
    assert solved(EQUATIONS, executor=Unreliable(good)) == expected


class LastFirst(Executor):
    """Does what was given to it last first, and loses a worker over its second task."""

    def __init__(self) -> None:
        self.waiting: list[tuple[Future, Any, tuple[Any, ...], dict[str, Any]]] = []
        self.order: list[int] = []

    def submit(self, function: Any, /, *given: Any, **named: Any) -> Future:
        future: Future = Future()
        self.waiting.append((future, function, given, named))
        if len(self.waiting) == BLOCKS:
            Thread(target=self.work).start()
        return future

    def work(self) -> None:
        for k in reversed(range(BLOCKS)):
            future, function, given, named = self.waiting[k]
            assert future.set_running_or_notify_cancel()
            self.order.append(k)
            if k == BLOCKS - 2:
                future.set_exception(BrokenProcessPool("a worker ended"))
            else:
                # As to another process and back.
                sent = pickle.loads(pickle.dumps((function, given, named)))
                future.set_result(pickle.loads(pickle.dumps(sent[0](*sent[1], **sent[2]))))


def test_an_executor_of_any_make_may_work_in_any_order_and_lose_a_worker(expected: str) -> None:
    executor = LastFirst()
    assert solved(EQUATIONS, executor=executor) == expected
    assert executor.order == list(reversed(range(BLOCKS)))


@pytest.mark.parametrize("installed", [False, True])
def test_mpi_that_has_no_workers_is_one_line(
    installed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    module = ModuleSpec("mpi4py", None) if installed else None
    monkeypatch.setattr("nag.tracking.executor.find_spec", lambda name: module)
    monkeypatch.delitem(sys.modules, "mpi4py.MPI", raising=False)
    how = "start with `mpiexec" if installed else "pip install mpi4py"
    with pytest.raises(InputError, match=f"^executor: mpi .*{how}"):
        nag.solve("x^2 = 2", executor="mpi")


def test_a_process_of_mpi_is_not_forked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mpi4py.MPI", ModuleType("mpi4py.MPI"))
    monkeypatch.setattr(os, "fork", None)
    assert work_in_child(Namespace(time_limit=None, memory_limit=None)) is None
    for option in ("time_limit", "memory_limit"):
        limits = {"time_limit": None, "memory_limit": None, option: 1.0}
        with pytest.raises(UsageError, match=f"^--{option.replace('_', '-')}: .*mpiexec"):
            work_in_child(Namespace(**limits))


def test_commands_work_under_mpi(tmp_path: Path, expected: str) -> None:
    pytest.importorskip("mpi4py", reason="MPI is not needed by anything else")
    if shutil.which("mpiexec") is None:
        pytest.skip("there is no mpiexec")
    system, answer = tmp_path / "katsura.txt", tmp_path / "answer.json"
    system.write_text("\n".join(EQUATIONS) + "\n")
    words = ["solve", str(system), "--executor", "mpi", "--seed", "2", "--json", str(answer)]
    mine = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    # More workers than processors: by Open MPI 4 and by 5.
    mine |= {"OMPI_MCA_rmaps_base_oversubscribe": "1"}
    mine |= {"PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"}
    command = ["mpiexec", "-n", "3", sys.executable, "-m", "mpi4py.futures", "-m", "nag", *words]
    subprocess.run(command, cwd=ROOT, env=mine, check=True, capture_output=True, timeout=60)
    found, known = json.loads(answer.read_text()), json.loads(expected)
    assert found["solutions"] == known["solutions"]


def test_executorlib_gives_the_same_answer(expected: str) -> None:
    executorlib = pytest.importorskip("executorlib", reason="it is given by who has it")
    with executorlib.SingleNodeExecutor(max_workers=2, block_allocation=True) as executor:
        assert solved(EQUATIONS, executor=executor) == expected


def test_only_missing_blocks_are_given_away(tmp_path: Path, expected: str) -> None:
    assert solved(EQUATIONS, resume=tmp_path) == expected

    class Refusing(Executor):
        def submit(self, *given: Any, **named: Any) -> Future:
            raise AssertionError("all is known")

    assert solved(EQUATIONS, resume=tmp_path, executor=Refusing()) == expected


def test_errors_of_the_work_are_raised(tmp_path: Path) -> None:
    class Failing(Executor):
        def submit(self, *given: Any, **named: Any) -> Future:
            future: Future = Future()
            future.set_exception(ZeroDivisionError("a kernel divided by zero"))
            return future

    with pytest.raises(ZeroDivisionError, match="a kernel"):
        solved(EQUATIONS, executor=Failing())


def test_an_engine_ends_with_its_block(tmp_path: Path) -> None:
    with pytest.raises(KeyError), open_engine(tmp_path, None):
        assert in_blocks()
        raise KeyError
    assert not in_blocks()


def test_dask_gives_the_same_answer(expected: str) -> None:
    distributed = pytest.importorskip("distributed", reason="dask is an extra")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, processes=True
    ) as cluster:
        address = cluster.scheduler_address.removeprefix("tcp://")
        assert solved(EQUATIONS, executor=f"dask://{address}") == expected


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="there is no kill -9")
@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in range(1, 10))]
)
def test_a_run_that_is_killed_goes_on_to_the_same_answer(seed: int, tmp_path: Path) -> None:
    system = tmp_path / "katsura.txt"
    system.write_text("\n".join(katsura(11)) + "\n")
    ledger, plain, answer = (tmp_path / name for name in ("ledger", "plain.json", "answer.json"))
    words = [sys.executable, "-m", "nag", "solve", str(system), "--quiet", "--threads", "1"]
    began = time.monotonic()
    subprocess.run([*words, "--json", str(plain)], cwd=ROOT, check=True, capture_output=True)
    took = time.monotonic() - began
    words += ["--resume", str(ledger), "--json", str(answer)]
    chance = random.Random(seed)
    for _ in range(2):
        process = subprocess.Popen(
            words, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, process_group=0
        )
        time.sleep(chance.uniform(0.2, 1.0) * took)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    subprocess.run(words, cwd=ROOT, check=True, capture_output=True)
    assert answer.read_bytes() == plain.read_bytes()
    shutil.rmtree(ledger)


def test_certificates_are_found_again_block_by_block(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr("nag.numerics.krawczyk.MOST_POINTS", 8)
    result = nag.solve(katsura(5))
    told: list[tuple[str, int, int]] = []

    def proved() -> dict[str, Any]:
        return certify_solutions(result).document()

    plain = proved()
    for found, kept in ((0, 8), (8, 0)):
        with open_engine(tmp_path, None, lambda *step: told.append(step)) as engine:
            assert proved() == plain
        assert engine is not None and engine.ledger is not None
        assert (engine.ledger.found, engine.ledger.kept) == (found, kept)
    for begin, stage in ((0, "proving boxes"), (4, "proving errors")):
        assert told[begin : begin + 4] == [(stage, 8 * k, 32) for k in range(1, 5)]
    alone: list[tuple[str, int, int]] = []
    with tell_proofs_to(lambda *step: alone.append(step)):
        assert proved() == plain
    assert alone == told[:8]


def test_what_is_proved_of_an_export_is_kept(tmp_path: Path, capsys) -> None:
    export, ledger = tmp_path / "katsura.json", tmp_path / "ledger"
    export.write_text(solved(katsura(11)))
    told = ["certify", str(export), "--resume", str(ledger), "--json", "-"]
    answers = []
    for found in (False, True):
        assert main(told) == 0
        answer = capsys.readouterr()
        assert (": 0 blocks found" in answer.err) is not found
        assert ("0 worked out" in answer.err) is found
        answers.append(answer.out)
    assert answers[0] == answers[1]
