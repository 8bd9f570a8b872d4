"""Pictures and moving pages of cases, kept in build/gallery, named by what they are made from."""

from __future__ import annotations

import contextlib
import hashlib
import os
import signal
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "build" / "gallery"
# Seconds that one picture or motion may take.
ONE = 20.0


def make_all(
    cases: Sequence[Path], first: Path, seconds: float
) -> list[tuple[Path | None, Path | None]]:
    """The picture and the page of each case; motions as far as so many seconds reach.

    What there is of the first one is made in any case.
    """
    KEPT.mkdir(parents=True, exist_ok=True)
    _make(first, end=float("inf"))
    make = partial(_make, end=time.time() + seconds)
    # Those with short files first: they have fewer bodies, and move sooner.
    order = sorted(cases, key=lambda case: (len(case.read_bytes()), case))
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as workers:
        made = dict(zip(order, workers.map(make, order), strict=True))
    return [made[case] for case in cases]


def _make(case: Path, end: float) -> tuple[Path | None, Path | None]:
    name = _digest(case)
    picture, page, none = (KEPT / f"{name}.{kind}" for kind in ("svg", "html", "none"))
    if not picture.is_file():
        with _at_most(ONE):
            _draw(case, picture)
    left = min(ONE, end - time.time())
    if not page.is_file() and not none.is_file() and left > 1:
        began = time.time()
        with _at_most(left):
            _write_page(case, page)
        if not page.is_file() and (left == ONE or time.time() - began < left):
            none.touch()
    return picture if picture.is_file() else None, page if page.is_file() else None


def _digest(case: Path) -> str:
    """Of the case and of what draws it."""
    digest = hashlib.sha256(case.read_bytes())
    for package in ("page", "pictures", "kinematics"):
        for file in sorted((ROOT / "nag" / package).glob("*.*")):
            digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


@contextlib.contextmanager
def _at_most(seconds: float) -> Iterator[None]:
    """Leave what takes longer, or cannot be had, as a motion with two freedoms."""
    from nag import NagError

    def late(*_: object) -> None:
        raise TimeoutError

    signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        with contextlib.suppress(NagError, TimeoutError):
            yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def _draw(case: Path, picture: Path) -> None:
    import nag
    from nag.kinematics.scene import scene_of
    from nag.mechanism.problem import in_real_coordinates, problem_of
    from nag.pictures.joint_graph import draw_joint_graph

    read = nag.read_case(case)
    scene = scene_of(in_real_coordinates(problem_of(read)))
    draw_joint_graph(scene, "", str(picture))


def _write_page(case: Path, page: Path) -> None:
    import nag
    from nag.page.motion_page import motion_page

    read = nag.read_case(case)
    found = nag.motion(read, threads=1)
    if found.circuits:
        page.write_text(motion_page(found, read.title, case.name), encoding="utf-8")
