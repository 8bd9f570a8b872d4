"""Homotopy path tracking: predictor, corrector, ends in as many digits as they need.

In order of reading: `compiled` and `homotopy` (what is tracked), `taylor` (values and series of a
path) on `kernel_arrays`, `straight_run` (many paths at once in doubles), `track` (their ends
judged, with `jumps`) with `known` (what a start system says of them), `ends` (the doubtful ones, followed in
more digits), `paths` (what is known in the end).
The numbers that decide something about an end stand in `nag.thresholds`.
"""
