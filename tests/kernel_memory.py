"""The record that kernels of the tests read and write."""

from __future__ import annotations

from typing import NamedTuple

from nag.machine_code.records import Complexes, Reals, Wholes


class Memory(NamedTuple):
    """What a kernel may read and write."""

    n: int
    x: float
    flag: bool
    wholes: Wholes
    reals: Reals
    complexes: Complexes
