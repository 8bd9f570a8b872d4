"""Damage files of every format that is read, and see that each is read or refused in one line.

    python tests/fuzzed_inputs.py [--formats toml,urdf] [--count 100000] [--seed 0] [--keep DIR]

Files are good ones with pieces changed, cut out, repeated, exchanged or taken from others. Half of
them are given to ``nag show``, half are read as what they were before. Each must end within two
seconds of the processor and one gigabyte, with an answer or with one line. Prints the counts of
each format and what fell through, which is kept in DIR; exit status 1 if anything did.
"""

from __future__ import annotations

import argparse
import faulthandler
import random
import re
import resource
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path

from foreign_files import FILES
from test_complex_coefficients import CASE as COMPLEX_CASE
from test_formats import BERTINI, JULIA, MACAULAY2, PHC, SINGULAR
from test_robots import BAR, BAR_CASE, DELTA, FOUR_BAR, HEXAPOD, SCARA, SRS, UR5

from nag.cli import main
from nag.cli.show import _describe_case
from nag.errors import NagError
from nag.files.cases import read_case
from nag.files.formats.writing import write_system

FORMATS = ("toml", "bertini", "phc", "m2", "singular", "hc", "text", "urdf", "mjcf", "robot")
SECONDS, BYTES = 2.0, 10**9
CASES = Path(__file__).parent.parent / "cases"
# Cases longer than this are no good start: most of what is changed is far from what is read first.
LONGEST = 4_000

_TOKEN = re.compile(r"[A-Za-z_]\w*|[0-9.]+|\s+|.", re.DOTALL)
ODD = (
    *("0", "-1", "1e400", "1e-400", "9" * 400, "0.1e", "nan", "inf", "1/0", "0/0", "2^999999999"),
    *("sqrt(-1)", "sqrt(2)", "cos(pi/7)", "I", "i", "1+2*I", "x", "x^1000", "(x+y+z+1)^99"),
    *("", " ", "\n", "\r", "\t", "\0", "\ufeff", "\u2028", "é", "²", "½", "\U0001f600", "\x1b[31m"),
    *("=", "==", ";", ",", ".", "..", "[", "]", "{", "}", "(", ")", "<", ">", "&", '"', "'", "#"),
    *("[[", "]]", '"""', "%", "//", "/*", "*/", "--", "<!--", "-->", "<![CDATA[", "&#0;", "\\"),
    *("true", "null", "[1, 2]", "{ a = 1 }", "1979-05-27", "function", "ideal", "ring", "END;"),
)

NUMBERS = ("0", "1", "-1", "2", "3", "7", "0.5", "-0.0", "1e300", "1e-300", "12345678901234567890")


@dataclass
class Tally:
    """What came of the files of a format.

    Attributes:
        counts: read, refused, and what fell through.
        slowest: seconds of the processor that the slowest file took.
        faults: the first number of each kind of what fell through, and what it was.
    """

    counts: Counter[str] = field(default_factory=Counter)
    slowest: float = 0.0
    faults: dict[str, tuple[int, str]] = field(default_factory=dict)


class TooSlowError(BaseException):
    """A file took longer than `SECONDS`."""


def good_files(format: str) -> list[str]:
    """Files of a format that are read."""
    if format == "toml":
        texts = [path.read_text() for path in sorted(CASES.rglob("*.toml"))]
        return [*(text for text in texts if len(text) < LONGEST), COMPLEX_CASE]
    if format == "robot":
        return [BAR_CASE]
    if format in ("urdf", "mjcf"):
        return [UR5, SRS, SCARA] if format == "urdf" else [FOUR_BAR, HEXAPOD, DELTA]
    own = {
        "bertini": [BERTINI],
        "phc": [PHC],
        "m2": [MACAULAY2],
        "singular": [SINGULAR],
        "hc": [JULIA],
    }
    return [*own.get(format, []), *FILES.get(format, []), *_written(format)]


def _written(format: str) -> Iterator[str]:
    for path in sorted(CASES.rglob("*.toml")):
        text = path.read_text()
        if 'kind = "system"' not in text or len(text) > LONGEST:
            continue
        case = read_case(path)
        try:
            yield write_system(case.system, format, case.title)
        except NagError:  # rational numbers only
            continue


# --- Damage


def damaged(files: Sequence[str], rng: random.Random) -> bytes:
    """One of the files, changed in one to six places."""
    text = rng.choice(files)
    for _ in range(rng.choice((1, 1, 1, 2, 3, 6))):
        text = rng.choice(CHANGES)(text, files, rng)
    content = text.encode("utf-8", "surrogatepass")
    if rng.random() < 0.05 and content:
        at = rng.randrange(len(content))
        content = content[:at] + bytes([rng.randrange(256)]) + content[at + 1 :]
    return content


def _cut(text: str, files: Sequence[str], rng: random.Random) -> str:
    start, end = _span(text, rng)
    return text[:start] + text[end:]


def _truncate(text: str, files: Sequence[str], rng: random.Random) -> str:
    return text[: rng.randrange(len(text) + 1)]


def _insert(text: str, files: Sequence[str], rng: random.Random) -> str:
    at = rng.randrange(len(text) + 1)
    return text[:at] + rng.choice(ODD) + text[at:]


def _replace_word(text: str, files: Sequence[str], rng: random.Random) -> str:
    words = _TOKEN.findall(text)
    if not words:
        return text
    other = _TOKEN.findall(rng.choice(files)) if rng.random() < 0.3 else words
    new = rng.choice(ODD) if rng.random() < 0.5 else rng.choice(other)
    words[rng.randrange(len(words))] = new
    return "".join(words)


def _replace_number(text: str, files: Sequence[str], rng: random.Random) -> str:
    places = list(re.finditer(r"[0-9.]+", text))
    if not places:
        return text
    place = rng.choice(places)
    new = rng.choice(ODD if rng.random() < 0.3 else NUMBERS)
    return text[: place.start()] + new + text[place.end() :]


def _rename(text: str, files: Sequence[str], rng: random.Random) -> str:
    """One word for another everywhere."""
    words = sorted(set(re.findall(r"\w+", text)))
    if not words:
        return text
    old, new = rng.choice(words), rng.choice([*words, *ODD])
    return re.sub(rf"\b{re.escape(old)}\b", lambda _: new, text)


def _exchange(text: str, files: Sequence[str], rng: random.Random) -> str:
    (a, b), (c, d) = sorted((_span(text, rng), _span(text, rng)))
    if b > c:
        return text
    return text[:a] + text[c:d] + text[b:c] + text[a:b] + text[d:]


def _repeat(text: str, files: Sequence[str], rng: random.Random) -> str:
    start, end = _span(text, rng)
    times = rng.choice((2, 2, 3, 10, 200, 3_000))
    return text[:start] + text[start:end] * min(times, 600_000 // (end - start + 1)) + text[end:]


def _splice(text: str, files: Sequence[str], rng: random.Random) -> str:
    other = rng.choice(files)
    start, end = _span(other, rng)
    at = rng.randrange(len(text) + 1)
    return text[:at] + other[start:end] + text[at:]


def _change_lines(text: str, files: Sequence[str], rng: random.Random) -> str:
    lines = text.split("\n")
    at, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    kind = rng.randrange(4)
    if kind == 0:
        del lines[at]
    elif kind == 1:
        lines.insert(other, lines[at])
    elif kind == 2:
        lines[at], lines[other] = lines[other], lines[at]
    else:
        lines.insert(at, rng.choice(rng.choice(files).split("\n")))
    return "\n".join(lines)


def _nest(text: str, files: Sequence[str], rng: random.Random) -> str:
    start, end = _span(text, rng)
    opening, closing = rng.choice(("()", "[]", "{}", ("<b>", "</b>"), ("<frame>", "</frame>")))
    deep = rng.choice((1, 2, 60, 2_000))
    closed = closing * (deep if rng.random() < 0.7 else 0)
    return text[:start] + opening * deep + text[start:end] + closed + text[end:]


def _span(text: str, rng: random.Random) -> tuple[int, int]:
    """Two places, mostly near to each other."""
    start = rng.randrange(len(text) + 1)
    length = rng.choice((1, 1, 3, 10, 40, len(text)))
    return start, min(len(text), start + rng.randrange(length + 1))


CHANGES: tuple[Callable[[str, Sequence[str], random.Random], str], ...] = (
    _cut,
    _truncate,
    _insert,
    _insert,
    _replace_word,
    _replace_word,
    _replace_number,
    _replace_number,
    _rename,
    _exchange,
    _repeat,
    _splice,
    _change_lines,
    _change_lines,
    _nest,
)


# --- What becomes of it


def ask(path: Path, format: str | None) -> str:
    """Read a file: ``read``, ``refused``, or what is wrong with the way that it ended."""
    out, err = StringIO(), StringIO()
    if format is not None:
        try:
            _describe_case(read_case(path, format=format))
        except NagError as error:
            return _refused([str(error)])
        return "read"
    with redirect_stdout(out), redirect_stderr(err):
        status = main(["show", str(path)])
    lines = err.getvalue().split("\n")[:-1]
    if status == 0:
        return "read" if not lines else "wrote to standard error"
    if status != 2 or out.getvalue():
        return f"exit status {status}"
    return _refused(lines)


def _refused(lines: list[str]) -> str:
    (first, *others) = lines or [""]
    if others or not first.strip() or "\n" in first:
        return f"{len(lines)} lines of refusal"
    if not first.isprintable():
        return "a refusal that cannot be printed"
    return "refused" if len(first) < 1_000 else "a refusal of more than 1000 characters"


def run(format: str, count: int, seed: int, keep: Path | None = None) -> Tally:
    """Damage and read ``count`` files of a format."""
    files, tally = good_files(format), Tally()
    with tempfile.TemporaryDirectory() as folder:
        # A case of a robot names its file.
        in_toml = format in ("toml", "robot")
        path = Path(folder) / ("case.toml" if in_toml else "case")
        (path.parent / "bar.urdf").write_text(BAR)
        for number in range(count):
            content = damaged(files, random.Random(f"{format} {seed} {number}"))
            path.write_bytes(content)
            began = time.process_time()
            outcome, said = _within_limits(
                path, None if number % 2 else "toml" if in_toml else format
            )
            tally.slowest = max(tally.slowest, time.process_time() - began)
            tally.counts[outcome] += 1
            if outcome not in ("read", "refused") and outcome not in tally.faults:
                tally.faults[outcome] = number, said
                if keep is not None:
                    keep.mkdir(parents=True, exist_ok=True)
                    (keep / f"{format}-{seed}-{number}").write_bytes(content)
    return tally


def _within_limits(path: Path, format: str | None) -> tuple[str, str]:
    """What becomes of a file, and the traceback if it ended in one."""
    faulthandler.dump_traceback_later(300 * SECONDS, exit=True)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    try:
        return ask(path, format), ""
    except TooSlowError:
        return f"more than {SECONDS} s in {_place()}", traceback.format_exc()
    except Exception as error:
        return f"{type(error).__name__} in {_place()}", traceback.format_exc()
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        faulthandler.cancel_dump_traceback_later()


def _place() -> str:
    """The last place of the program in the traceback of the exception that is handled."""
    frames = [f for f in traceback.extract_tb(sys.exc_info()[2]) if "/nag/" in f.filename]
    return f"{frames[-1].filename.rpartition('/nag/')[2]}:{frames[-1].name}" if frames else "?"


def _stop(*_: object) -> None:
    raise TooSlowError


def limit_memory() -> None:
    """Let nothing take more than `BYTES` beyond what is mapped now."""
    mapped = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (mapped + BYTES, resource.RLIM_INFINITY))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--formats", default=",".join(FORMATS))
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep", type=Path)
    options = parser.parse_args()
    signal.signal(signal.SIGPROF, _stop)
    fell = 0
    for name in options.formats.split(","):
        run(name, 20, -1)  # what is imported first
        limit_memory()
        started = time.perf_counter()
        tally = run(name, options.count, options.seed, options.keep)
        counts = ", ".join(f"{n} {what}" for what, n in sorted(tally.counts.items()))
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
        print(
            f"{name}: {counts}; slowest {tally.slowest:.2f} s, peak {peak:.2f} GB, "
            f"{time.perf_counter() - started:.0f} s in all",
            flush=True,
        )
        for what, (number, said) in tally.faults.items():
            print(f"  number {number}: {what}\n{said}", flush=True)
        fell += len(tally.faults)
    sys.exit(1 if fell else 0)
