"""While something is worked out linear algebra has one thread, and as many as before after it."""

from __future__ import annotations

import subprocess
import sys

# Where tests run in several processes the environment may hold all of them to one thread.
CODE = """
import os
for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "2"
import nag, threadpoolctl
from nag.numerics.linear_algebra_threads import limit_scipy, one_thread
from nag.tracking.run import takes_run


def threads():
    return {d["num_threads"] for d in threadpoolctl.threadpool_info() if d["user_api"] == "blas"}


@takes_run
def work(run=nag.Run()):
    before = threads()
    import scipy.linalg

    limit_scipy()
    return before, threads(), inner(run=run), threads()


@takes_run
def inner(run=nag.Run()):
    return threads()


import numpy

assert threads() == {2}, threads()
assert work(seed=1) == ({1}, {1}, {1}, {1}), work(seed=1)
assert threads() == {2}, threads()
try:
    takes_run(lambda run=None: 1 / 0)(seed=1)
except ZeroDivisionError:
    pass
assert threads() == {2}, threads()
"""


def test_linear_algebra_has_one_thread_inside_of_a_call_and_all_behind_it() -> None:
    subprocess.run([sys.executable, "-c", CODE], check=True, timeout=60)
