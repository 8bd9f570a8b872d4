"""Every run of the tests is the same: examples come from no seed, and nothing has a deadline."""

from __future__ import annotations

from hypothesis import settings

settings.register_profile("nag", derandomize=True, deadline=None)
settings.load_profile("nag")
