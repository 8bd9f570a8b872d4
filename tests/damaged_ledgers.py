"""Damage ledgers, and see that whoever goes on with them gives the same answer, or says why not.

    python tests/damaged_ledgers.py [--count 200] [--seed 0]

Small commands are run with ``--resume``. Of the ledger that is left, in half of the cases only some
files of it, one or more files are damaged, and the command is run again. It must write the same
JSON as a run without a ledger and print the same but for seconds, and where a file with other
content was read, say so; or it must say in one line why it cannot, with exit status 2, and write
nothing. Prints the counts of each kind of damage; exit status 1 if anything else came of it.
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import shutil
import signal
import sys
import tempfile
import traceback
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path
from unittest import mock

from killed_runs import katsura, without_seconds

from nag.cli import main as nag_main
from nag.tracking import ledger as ledgers

# A run that takes longer waits for something that does not come.
SECONDS, BYTES = 20, 2 * 10**9
SURFACES = [
    "(x^2 + y - z)^2*(x + y^4 + z) - x*y*z*w + 1",
    "(x^3 - y^2*z + w)*(z - y^3) - w^2 + 2*x",
]
SINGULAR = [
    "x^2 + y^2 + 1 + (x^2 - 2*y^2 - 1/2)^2*x",
    "(x^2 - 2*y^2 - 1/2)^2*(x + 3) + (x^2 + y^2 + 1)^2*y",
]


class HangsError(Exception):
    """A run took longer than `SECONDS`."""


@dataclass(frozen=True)
class Command:
    """A command and what it leaves.

    Attributes:
        words: without ``--json`` and ``--resume``.
        ledger: the folder that it left.
        other: what another version of the program left, for the same question.
        answer: what it wrote, ``printed``: what it printed, ``status``: with which it ended.
    """

    words: tuple[str, ...]
    ledger: Path
    other: Path
    answer: bytes
    printed: str
    status: int


@dataclass
class Tally:
    """What came of damage, by its kind; ``faults``: what should not have."""

    counts: dict[str, Counter[str]] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)


def commands(folder: Path) -> list[Command]:
    """Commands that have kept their work in folders."""
    cases = {"katsura": katsura(11), "surfaces": SURFACES, "singular": SINGULAR}
    for name, equations in cases.items():
        (folder / name).write_text("\n".join(equations) + "\n")
    export = folder / "export.json"
    asked = [
        ["solve", str(folder / "katsura")],
        ["decompose", str(folder / "surfaces")],
        ["solve", str(folder / "singular"), "--start", "total"],
        ["certify", str(export)],
    ]
    _run([*asked[0], "--json", str(export)])
    return [_kept(words, folder / f"{k}") for k, words in enumerate(asked)]


def _kept(words: Sequence[str], folder: Path) -> Command:
    plain, ledger, other = (folder / name for name in ("plain.json", "ledger", "other"))
    folder.mkdir()
    status, printed, _ = _run([*words, "--json", str(plain)])
    _run([*words, "--resume", str(ledger)])
    with mock.patch.object(ledgers, "_origin", lambda: b"another version"):
        _run([*words, "--resume", str(other)])
    return Command(tuple(words), ledger, other, plain.read_bytes(), printed, status)


def _run(words: Sequence[str]) -> tuple[int, str, str]:
    """Exit status, what is printed, and what on standard error."""
    said, complained = StringIO(), StringIO()
    with redirect_stdout(said), redirect_stderr(complained):
        status = nag_main([*words, "--quiet"])
    return status, said.getvalue(), complained.getvalue()


# --- Damage: each changes a file of a ledger, and says whether what is read there is another thing


def _cut(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    os.truncate(file, chance.randrange(file.stat().st_size))
    return True


def _flip_bits(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    content = bytearray(file.read_bytes())
    for place in chance.sample(range(len(content)), chance.choice((1, 1, 2, 100))):
        content[place] ^= 1 << chance.randrange(8)
    file.write_bytes(content)
    return True


def _empty(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    file.write_bytes(b"")
    return True


def _fill_with_random_bytes(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    size = file.stat().st_size
    file.write_bytes(chance.randbytes(chance.choice((1, 100, size, 3 * size))))
    return True


def _zero_a_page(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    content = bytearray(file.read_bytes())
    first = 4096 * chance.randrange((len(content) + 4095) // 4096)
    size = len(content[first : first + 4096])
    content[first : first + 4096] = bytes(size)
    file.write_bytes(content)
    return True


def _append(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    with file.open("ab") as stream:
        stream.write(chance.randbytes(chance.choice((1, 1000))))
    return True


def _swap(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    second = chance.choice([each for each in _blocks(folder) if each != file])
    kept = folder / "kept"
    file.rename(kept)
    second.rename(file)
    kept.rename(second)
    return True


def _copy_over(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    shutil.copy(chance.choice([each for each in _blocks(folder) if each != file]), file)
    return True


def _rename(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    name = chance.choice((chance.randbytes(32).hex(), file.stem.upper(), "x", file.stem[:-1]))
    file.rename(file.with_name(name + chance.choice((".block", ".part", ""))))
    return False


def _other_version_of_file(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    """A format that begins with another number, all else as it is."""
    content = file.read_bytes()
    head = chance.choice((b"nag block 2\n", b"nag block 0\n", b"nag block 1\r\n"))
    file.write_bytes(head + content[len(ledgers.MAGIC) :])
    return True


def _other_version(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    """What another version or processor has left: all of it beside these files."""
    file.unlink()
    for each in _blocks(other):
        shutil.copy(each, folder)
    return False


def _other_version_by_this_name(
    file: Path, folder: Path, other: Path, chance: random.Random
) -> bool:
    shutil.copy(chance.choice(_blocks(other)), file)
    return True


def _make_folder(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    file.unlink()
    file.mkdir()
    if chance.random() < 0.5:
        (file / "file").touch()
    return True


def _link(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    """To nothing, to itself, to another block, to a device."""
    second = chance.choice([each for each in _blocks(folder) if each != file])
    file.unlink()
    target = chance.choice(("nothing", file.name, second.name, "/dev/null", "/dev/zero"))
    file.symlink_to(target)
    return target != "nothing"


def _make_pipe(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    file.unlink()
    os.mkfifo(file)
    return True


def _add_others(file: Path, folder: Path, other: Path, chance: random.Random) -> bool:
    """What a kill leaves, and what does not belong there."""
    content = file.read_bytes()
    file.unlink()
    (folder / f"{file.name}.{chance.randbytes(16).hex()}.part").write_bytes(
        content[: chance.randrange(len(content))]
    )
    (folder / "notes.txt").write_text("mine")
    (folder / ("0" * 64 + ".block")).write_bytes(content)
    return False


KINDS: tuple[Callable[[Path, Path, Path, random.Random], bool], ...] = (
    _cut,
    _flip_bits,
    _empty,
    _fill_with_random_bytes,
    _zero_a_page,
    _append,
    _swap,
    _copy_over,
    _rename,
    _other_version_of_file,
    _other_version,
    _other_version_by_this_name,
    _make_folder,
    _link,
    _make_pipe,
    _add_others,
)


def _blocks(folder: Path) -> list[Path]:
    return sorted(folder.glob("*.block"))


def damage(count: int, seed: int, folder: Path) -> Tally:
    """Damage ``count`` ledgers, and go on with each."""
    tally, asked = Tally(), commands(folder)
    for number in range(count):
        chance = random.Random(f"{seed} {number}")
        command, kind = asked[number % len(asked)], KINDS[number // len(asked) % len(KINDS)]
        name = kind.__name__.strip("_").replace("_", " ")
        ledger, target = folder / "ledger", folder / "answer.json"
        shutil.copytree(command.ledger, ledger)
        made = _blocks(ledger)
        if number % 2 and len(made) > 3:
            for file in chance.sample(made, len(made) // 2):
                file.unlink()
        before, told = _blocks(ledger), False
        for file in chance.sample(before, min(chance.choice((1, 1, 2, 5)), len(before) // 2) or 1):
            if file.is_file() and not file.is_symlink():
                told |= kind(file, ledger, command.other, chance)
        signal.alarm(SECONDS)
        try:
            outcome = _go_on(command, ledger, target, told)
        except Exception as error:
            outcome = f"{type(error).__name__}: {traceback.format_exc()}"
        finally:
            signal.alarm(0)
        tally.counts.setdefault(name, Counter())[outcome.split(":")[0]] += 1
        if outcome not in ("same", "refused"):
            tally.faults.append(f"number {number}, {name}, {command.words[0]}: {outcome}")
        shutil.rmtree(ledger)
        target.unlink(missing_ok=True)
    return tally


def _go_on(command: Command, ledger: Path, target: Path, told: bool) -> str:
    """What comes of a command with a damaged ledger."""
    words = [*command.words, "--json", str(target), "--resume", str(ledger)]
    status, printed, errors = _run(words)
    if status == 2:
        refused = errors.count("\n") == 1 and not target.exists()
        return "refused" if refused else f"refused badly: {errors}"
    if status != command.status or target.read_bytes() != command.answer:
        return f"another answer: status {status}, {errors}"
    if without_seconds(printed) != without_seconds(command.printed):
        return f"other words: {printed}"
    if ("damaged" in errors) != told:
        return f"damage is {'not ' if told else ''}said: {errors}"
    if "Traceback" in errors or errors.count("\n") > 1:
        return f"many lines: {errors}"
    # Whoever asks a third time finds all blocks whole.
    _, _, errors = _run(words)
    return "same" if not errors else f"damage is left: {errors}"


def _stop(*_: object) -> None:
    raise HangsError


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    signal.signal(signal.SIGALRM, _stop)
    mapped = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (mapped + BYTES, resource.RLIM_INFINITY))
    with tempfile.TemporaryDirectory() as folder:
        tally = damage(options.count, options.seed, Path(folder))
    for name, counts in tally.counts.items():
        print(f"{name}: {', '.join(f'{n} {what}' for what, n in sorted(counts.items()))}")
    for fault in tally.faults:
        print(fault)
    print(f"{options.count} damaged ledgers, {len(tally.faults)} faults")
    return 1 if tally.faults else 0


if __name__ == "__main__":
    sys.exit(main())
