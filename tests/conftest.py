"""Every run of the tests is the same: examples come from no seed, and nothing has a deadline."""

from __future__ import annotations

import gc

from hypothesis import settings

settings.register_profile("nag", derandomize=True, deadline=None, max_examples=20)
settings.load_profile("nag")


def pytest_collection_finish() -> None:
    """What was collected stays to the end; the collector of garbage need not look through it.

    Nor need it look at every few hundred objects: a test makes thousands, which go with it.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(10_000)
