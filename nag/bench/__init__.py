"""Benchmarks: systems, times, and other programs beside ours.

Read `measure` (solving), `decomposition`, then `peers` (other programs) and `table`.
"""
